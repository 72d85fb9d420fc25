"""Tests mechanism/examples/gearbox.yaml: the clutch accelerates the drum, the freewheel releases it, and loaded teeth
have a transmission error from their compliance."""

import math
import unittest

import numpy as np

from example import ExampleTest


class Gearbox(ExampleTest):
    model = "gearbox.yaml"

    def joint(self, name):
        """Returns the rows of a dataset of a joint, with one column for each value."""
        return self.results.rows("joints/" + name).reshape(len(self.time), -1)

    def test_the_clutch_slips_by_its_plates_and_engages_after_the_time_of_the_inertias(self):
        sticks = self.joint("plates/clutch_sticks")[:, 0]
        slips = (self.time > 0.0405) & (sticks == 0)
        np.testing.assert_allclose(self.joint("plates/clutch_force")[slips, 0], 3000 * 0.3 * 0.08 * 2, rtol=1e-12)
        inertia = 1e-2 + 2e-2 / 2.5 ** 2 + 3.05 / 7.5 ** 2  # inertia reduced to the input, which reaches 60 rad/s
        engaged = self.time[np.argmax(sticks == 1)]
        self.assertAlmostEqual(engaged, 0.025 + inertia * 60 / 144, delta=2e-3)  # 25 ms: half of the ramp

    def test_the_drum_runs_on_when_the_engine_slows_down(self):
        free = self.time > 0.45
        drum = self.joint("output/rate")[free, 0] + self.joint("freewheel/rate")[free, 0]
        np.testing.assert_allclose(drum, drum[0], rtol=1e-9)
        # The drum has the rate by the ratio, or a faster one after an impact of rattling teeth.
        self.assertGreater(drum[0], 60 / 7.5)
        self.assertEqual(self.joint("freewheel/one_way_holds")[-1, 0], 0)
        driven = (self.time > 0.045) & (self.time < 0.05)
        self.assertGreater(self.joint("freewheel/one_way_force")[driven, 0].mean(), 0)

    def test_loaded_teeth_err_by_their_compliance(self):
        # The error consists of -F/k for 1 to 1.6 pairs of teeth, half of the play, profile errors of up to 11 um, and
        # the effect of damping.
        sticks = self.joint("plates/clutch_sticks")[:, 0]
        loaded = (self.time > 0.045) & (sticks == 0)
        error, force = self.joint("first/transmission_error")[loaded, 0], self.joint("first/force")[loaded, 0]
        self.assertAlmostEqual(force.mean() / (144 / (0.025 * math.cos(math.pi / 9))), 1, delta=0.2)
        yielded = -(error + 2.5e-5)
        self.assertGreater(yielded.min(), force.min() / 1.6 / 1.4e8 - 15e-6)
        self.assertLess(yielded.max(), force.max() / 1.4e8 + 15e-6)


if __name__ == "__main__":
    unittest.main()
