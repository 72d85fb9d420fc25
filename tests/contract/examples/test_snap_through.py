"""Tests that Lee's frame in mechanism/examples/snap_through.yaml passes both limit loads.

The reference is Reissner's rod (shear factor 5/6) by shooting in long double with pseudo-arclength continuation,
accurate to 1e-9.
"""

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
MODEL = os.path.join(REPOSITORY, "mechanism", "examples", "snap_through.yaml")


class SnapThrough(unittest.TestCase):
    def test_the_path_passes_both_limit_loads_to_its_end(self):
        with tempfile.TemporaryDirectory() as folder:
            target = os.path.join(folder, "run.h5")
            done = subprocess.run([PROGRAM, MODEL, "-o", target], capture_output=True, text=True, timeout=100)
            self.assertEqual(done.returncode, 0, done.stderr)
            limits = [float(line.split()[-1]) for line in done.stdout.splitlines() if "limit point" in line]
            np.testing.assert_allclose(limits, [1854.4527094, -939.2489640], rtol=1e-4)
            results = Results(target)
            load, moved = results.rows("time"), results.rows("nodes/load/position") - [0.24, 1.2, 0]
            results.file.close()
        first = int(np.argmax(load[:len(load) // 2]))
        np.testing.assert_allclose(moved[first], [0.268783276643, -0.487542403802, 0], atol=1e-4)
        self.assertAlmostEqual(load[first], limits[0], places=4)
        self.assertAlmostEqual(moved[-1, 1], -0.9, places=11)
        self.assertLess(np.abs(moved[:, 2]).max(), 1e-9)  # no force acts out of the plane

    def test_load_steps_alone_end_at_the_first_limit_load(self):
        with tempfile.TemporaryDirectory() as folder:
            with open(MODEL) as file:
                text = file.read()
            model = os.path.join(folder, "steps.yaml")
            with open(model, "w") as file:
                file.write(text[:text.index("analysis:")].replace("[0, -1, 0]}", "[0, -1900, 0]}")
                           + "analysis:\n  - {type: static, steps: 20}\n")
            done = subprocess.run([PROGRAM, model, "--quiet"], capture_output=True, text=True, timeout=100)
            self.assertEqual(done.returncode, 2)
            self.assertIn("no equilibrium found at load factor 0.97", done.stderr)  # 1854 of 1900 N
            self.assertIn("largest residual", done.stderr)


if __name__ == "__main__":
    unittest.main()
