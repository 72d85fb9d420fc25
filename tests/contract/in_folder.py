"""Base class of most tests of commands and files. Each test has a folder, which is removed after it."""

import os
import tempfile
import unittest

# bielle-reduce restarts itself with settings of its libraries unless they are set; setting them halves the start of
# each run.
os.environ.setdefault("OMP_WAIT_POLICY", "passive")
os.environ.setdefault("GLIBC_TUNABLES", "glibc.malloc.hugetlb=1")

REPOSITORY = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", ".."))


class InFolder(unittest.TestCase):
    """`folder` belongs to this test alone; `path` and `write` refer to files in it."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, text, errors="strict"):
        """@returns the path"""
        with open(self.path(name), "w", encoding="utf-8", errors=errors) as file:
            file.write(text)
        return self.path(name)
