"""Tests that tools/demo, run as in the README, succeeds, and that all files that it names exist."""

import os
import re
import subprocess
import tempfile
import unittest

import h5py
import numpy as np
from PIL import Image

REPOSITORY = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", "..", ".."))


class Demo(unittest.TestCase):
    def test_from_the_solid_rod_to_pictures_of_the_engine(self):
        superelement = os.path.join(REPOSITORY, "mechanism", "examples", "conrod.h5")
        if os.path.exists(superelement):
            os.remove(superelement)  # removes the result of an earlier run, which would be reused
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run([os.path.join(REPOSITORY, "tools", "demo"), "-o", folder], text=True, capture_output=True,
                                  stdin=subprocess.DEVNULL, timeout=1500, env={**os.environ, "DISPLAY": ""})
            self.assertEqual(done.returncode, 0, done.stderr)
            named = re.findall(r"^  (\S+\.\w+)(?:, (\S+\.\w+))?  ", done.stdout, re.MULTILINE)
            names = [name for pair in named for name in pair if name]
            self.assertEqual(len(names), 8, done.stdout)
            for name in names:
                self.assertGreater(os.path.getsize(os.path.join(folder, name)), 1000, name)
            with Image.open(os.path.join(folder, "motion.gif")) as movie:
                self.assertGreaterEqual(movie.n_frames, 30)
            with h5py.File(os.path.join(folder, "slider_crank.h5")) as results:
                self.assertEqual(results.attrs["complete"], 1)
                rate = results["joints/main/rate"][len(results["time"]) - 1, 0]
                self.assertAlmostEqual(rate / (2 * np.pi * 50), 1, delta=1e-6)
        self.assertTrue(os.path.exists(superelement))


if __name__ == "__main__":
    unittest.main()
