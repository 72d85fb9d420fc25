"""Base class of tests of an example of mechanism/examples, which is run once for all tests of a class."""

import os
import shutil
import subprocess
import sys
import tempfile
import unittest

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from in_folder import REPOSITORY  # noqa: E402

sys.path.insert(0, os.path.join(REPOSITORY, "tools"))
from bielle_tools.gallery import catalogue  # noqa: E402
from bielle_tools.results import Results  # noqa: E402

PROGRAM = os.path.join(os.environ["BIELLE_PROGRAMS"], "bielle-mechanism")
EXAMPLES = os.path.join(REPOSITORY, "mechanism", "examples")


def gallery_checks(name, paths):
    """Returns the checks of a machine of the gallery. @param paths  {run: path of its results}"""
    return catalogue.chosen(catalogue.FOLDER, [name])[name].check(paths)


class ExampleTest(unittest.TestCase):
    """`results` and `time` are those of the run of `model`; `superelement` is the name in the model for
    BIELLE_SUPERELEMENT."""

    model = ""
    superelement = ""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = folder.name
        path = os.path.join(EXAMPLES, cls.model)
        if cls.superelement:
            path = shutil.copy(path, cls.folder)
            os.symlink(os.environ["BIELLE_SUPERELEMENT"], os.path.join(cls.folder, cls.superelement))
        target = os.path.join(cls.folder, "run.h5")
        done = subprocess.run([PROGRAM, path, "-o", target, "--quiet"], capture_output=True, text=True, timeout=600)
        if done.returncode:
            raise AssertionError(done.stderr)
        cls.path = target
        cls.results = Results(target)
        cls.addClassCleanup(cls.results.file.close)
        cls.time = cls.results.time

    def rows(self, name):
        """Returns the rows of a dataset, without dimensions of length one."""
        return np.squeeze(self.results.rows(name))

    def events(self):
        """Returns names and times of the events of the first analysis in order of time."""
        names = self.results.file["crossings"][()].decode().splitlines()
        group = self.results.file["analysis_1/events"]
        return [(names[int(k)], float(time)) for k, time in zip(group["crossing"][:], group["time"][:])]

    def assert_gallery_checks(self, name, paths):
        """Asserts the checks of a machine of the gallery. @param paths  {run: path of its results}"""
        checks = gallery_checks(name, paths)
        self.assertGreater(len(checks), 0)
        for check in checks:
            with self.subTest(check.quantity):
                self.assertTrue(check.passed, f"{check.value} is not {check.reference} within {check.within}")
