"""Tests mechanism/examples/belt_and_brake.yaml: the belt slips at its limit of friction, and the band brake stops the
drum."""

import math
import unittest

import numpy as np

from example import ExampleTest


class BeltAndBrake(ExampleTest):
    model = "belt_and_brake.yaml"

    def rows(self, name):
        return np.array(self.results.rows(name))

    def test_the_belt_slips_on_the_small_pulley_until_the_fan_runs_with_the_motor(self):
        slips, wrap = self.rows("joints/belt/slips"), self.rows("joints/belt/wrap")
        limit = math.exp(0.3 * (math.pi - 2 * math.asin(0.1 / 0.5)))
        np.testing.assert_allclose(wrap[:, 0], math.pi - 2 * math.asin(0.2), rtol=1e-9)
        tension = self.rows("joints/belt/tension")
        ratio = tension.max(axis=1) / tension.min(axis=1)
        slipping = slips[:, 0] == 1
        np.testing.assert_allclose(ratio[slipping], limit, rtol=1e-5)
        self.assertLess(ratio.max(), limit * (1 + 1e-5))
        # The belt slips from the start, and sticks at the end, when the fan turns at a third of the motor's speed.
        self.assertTrue(slipping[1:20].all())
        self.assertFalse(slipping[-20:].any())
        motor, fan = (self.rows(f"joints/{each}_bearing/rate")[-1, 0] for each in ("motor", "fan"))
        self.assertAlmostEqual(fan / motor, 1 / 3, delta=1e-3)

    def test_the_band_stops_the_drum_with_the_torque_of_the_capstan_equation(self):
        rate = self.rows("joints/drum_bearing/rate")[:, 0]
        torque = 0.15 * (math.exp(0.3 * math.pi) - 1) * 50
        for t in (0.5, 1.0, 1.5):
            self.assertAlmostEqual(rate[np.argmin(abs(self.time - t))], 40 - torque * t / 0.5, delta=0.1)
        self.assertGreater(40 * 0.5 / torque, 1.5)
        self.assertLess(abs(rate[-1]), 0.5)


if __name__ == "__main__":
    unittest.main()
