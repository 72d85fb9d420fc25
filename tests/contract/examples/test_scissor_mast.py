"""Tests that the bays of mechanism/examples/scissor_mast.yaml unfold equally, by the kinematics of rigid bars."""

import os
import subprocess
import unittest

import numpy as np

from example import EXAMPLES, PROGRAM, ExampleTest
from bielle_tools.results import Results

BAYS, BAR = 6, 1.0


class ScissorMast(ExampleTest):
    model = "scissor_mast.yaml"

    def test_bays_are_rectangles_whose_diagonals_are_the_bars(self):
        """width^2 + height^2 = bar^2, up to the bending of the bars."""
        for k in range(1, BAYS + 1):
            foot, head, far = (self.rows(f"nodes/bay_{k}.{node}/position") for node in ("a0", "b0", "b2"))
            diagonal = np.hypot(np.linalg.norm(head - foot, axis=1), np.linalg.norm(far - foot, axis=1))
            self.assertAlmostEqual(diagonal[0], BAR, delta=1e-12)
            self.assertLess(np.abs(diagonal - BAR).max(), 0.05 * BAR)  # at the stop of the mast with its dish
            self.assertLess(np.abs(diagonal - BAR).mean(), 0.01 * BAR)

    def test_it_comes_to_rest_where_the_springs_are_slack(self):
        tip = self.rows(f"nodes/bay_{BAYS}.a2/position")[:, 0]
        self.assertAlmostEqual(tip[self.time > 3.5].mean(), BAYS * np.sqrt(BAR ** 2 - 0.5 ** 2), delta=0.05)

    def test_energy_balance_closes(self):
        self.assertLess(np.abs(self.rows("energy/balance")).max(), 0.005 * self.rows("energy/elastic")[0])

    def test_any_number_of_bays(self):
        for bays in (1, 8):
            target = os.path.join(self.folder, f"{bays}.h5")
            done = subprocess.run([PROGRAM, os.path.join(EXAMPLES, self.model), "--set", f"bays={bays}", "-o", target, "--quiet"],
                                  capture_output=True, text=True, timeout=300)
            self.assertEqual(done.returncode, 0, done.stderr)
            results = Results(target)
            tip = np.array(results.rows(f"nodes/bay_{bays}.a2/position"))[:, 0]
            self.assertGreater(tip.max(), 0.8 * bays)
            results.file.close()


if __name__ == "__main__":
    unittest.main()
