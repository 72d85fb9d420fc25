"""Tests mechanism/examples/weak_instability.yaml: errors of constraint forces grow by exp(2 pi) per revolution with
Newmark's scheme, but not with HHT's."""

import os
import subprocess
import sys
import tempfile
import unittest

import numpy as np

REPOSITORY = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", "..", ".."))
sys.path.insert(0, os.path.join(REPOSITORY, "tools"))
from bielle_tools.results import Results  # noqa: E402

PROGRAM = os.path.join(os.environ["BIELLE_PROGRAMS"], "bielle-mechanism")
EXAMPLES = os.path.join(REPOSITORY, "mechanism", "examples")


class WeakInstability(unittest.TestCase):
    def setUp(self):
        self._folder = tempfile.TemporaryDirectory()
        self.addCleanup(self._folder.cleanup)
        self.folder = self._folder.name

    def run_with(self, name, *settings):
        """Returns the largest errors of force and radius in each revolution."""
        target = os.path.join(self.folder, name)
        subprocess.run([PROGRAM, os.path.join(EXAMPLES, "weak_instability.yaml"), "-o", target, "--quiet", *settings],
                       check=True, timeout=120)
        with Results(target) as results:
            force = np.linalg.norm(results.rows("joints/pivot/reaction")[:, :3], axis=1)
            radius = np.linalg.norm(results.rows("nodes/mass/position"), axis=1)
            revolution = np.minimum(results.time.astype(int), 3)
            return (target, [np.abs(force - 4 * np.pi ** 2)[revolution == k].max() for k in range(4)],
                    np.abs(radius - 1).max())

    def test_the_disease_and_its_cure(self):
        newmark, sick, off = self.run_with("newmark.h5")
        hht, well, _ = self.run_with("hht.h5", "--set", "alpha=0.1")
        _, finer, _ = self.run_with("finer.h5", "--set", "h=0.005")
        for errors in (sick, finer):
            for k in range(3):
                # The envelopes are taken over whole revolutions; the nonlinear end of the last one may deviate.
                self.assertAlmostEqual(np.log(errors[k + 1] / errors[k]), 2 * np.pi, delta=0.1)
        self.assertLess(off, 1e-9)  # the motion itself has a small error
        # The error of the scheme is (omega h)^2 = 4e-3 of 39.5 N, 0.16 N, and does not grow.
        self.assertLess(max(well), 0.16)
        self.assertLess(well[3], 2 * well[0])
        figure = os.path.join(self.folder, "figure.png")
        environment = {name: value for name, value in os.environ.items() if name != "DISPLAY"}
        subprocess.run([os.path.join(EXAMPLES, "weak_instability_plot"), newmark, hht, "-o", figure], check=True,
                       timeout=120, env=environment)
        with open(figure, "rb") as file:
            self.assertEqual(file.read(8), b"\x89PNG\r\n\x1a\n")
        self.assertGreater(os.path.getsize(figure), 20000)


if __name__ == "__main__":
    unittest.main()
