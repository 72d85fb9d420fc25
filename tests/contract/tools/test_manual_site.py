"""Tests that Sphinx builds the site of the manual without a warning, in a minute. test_manual checks the links of its
sources."""

import importlib.util
import os
import subprocess
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from in_folder import REPOSITORY, InFolder  # noqa: E402


@unittest.skipIf(importlib.util.find_spec("myst_parser") is None, "Sphinx is not installed (tools/install --with-manual)")
class Site(InFolder):
    def test_site_is_built_without_warnings(self):
        command = [os.path.join(REPOSITORY, "tools", "manual"), "--no-pictures", "-o", self.path("site")]
        done = subprocess.run(command, capture_output=True, text=True, timeout=500,
                              env={**os.environ, "BIELLE_BIN": os.environ["BIELLE_PROGRAMS"]})
        self.assertEqual(done.returncode, 0, done.stderr)
        missing = [line for line in done.stderr.splitlines() if "WARNING" in line and "image file not readable" not in line]
        self.assertEqual(missing, [])
        self.assertTrue(os.path.exists(self.path("site/mechanism/manual/README.html")))


if __name__ == "__main__":
    unittest.main()
