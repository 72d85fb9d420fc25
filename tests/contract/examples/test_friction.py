"""Compares sticking, slipping, holding and sliding in mechanism/examples/friction.yaml with closed forms."""

import math
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
MODEL = os.path.join(REPOSITORY, "mechanism", "examples", "friction.yaml")


class Friction(unittest.TestCase):
    def test_example(self):
        with tempfile.TemporaryDirectory() as folder:
            target = os.path.join(folder, "run.h5")
            done = subprocess.run([PROGRAM, MODEL, "-o", target], capture_output=True, text=True, timeout=120)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("displacement sticks", done.stdout)
            results = Results(target)
            # The mass breaks loose at mu_s m g, and its spring force oscillates about mu_k m g.
            friction = np.array(results.rows("joints/contact/friction"))[:, 0]
            self.assertAlmostEqual(friction.max(), 0.4 * 9.81, delta=0.05)
            place = np.array(results.rows("nodes/crate/position"))[:, 0]
            middle, loose = 0.25 * 9.81 / 100, 0.4 * 9.81 / 100
            self.assertAlmostEqual(place.max(), middle + math.hypot(loose - middle, 0.1 / 10), delta=1e-4)
            # The jacks.
            flat, steep = (np.array(results.rows(f"joints/{jack}/coordinate")) for jack in ("flat", "steep"))
            self.assertLess(abs(flat).max(), 1e-12)
            lead, radius, mass, inertia = 0.04 / (2 * math.pi), 0.02, 200, 2
            c = math.hypot(radius, lead)
            equations = np.array([[mass * lead, -(radius + 0.15 * lead) / c],
                                  [inertia, (lead * radius - 0.15 * radius ** 2) / c]])
            acceleration, _ = np.linalg.solve(equations, [-mass * 9.81, 0])
            self.assertAlmostEqual(steep[-1, 1] / (0.5 * acceleration * 16), 1, delta=1e-6)
            # The sign hangs at rest; the friction of the bearing holds it at its angle from the vertical.
            angle, rate = (np.array(results.rows(f"joints/bearing/{what}"))[-1, 0] for what in ("coordinate", "rate"))
            self.assertLess(abs(rate), 1e-3)
            self.assertLess(abs(math.cos(angle)), 0.6 * 0.15 / 0.4)
            results.file.close()


if __name__ == "__main__":
    unittest.main()
