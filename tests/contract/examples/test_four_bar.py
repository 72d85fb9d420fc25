"""Tests that mechanism/examples/four_bar.yaml moves like rigid links, up to the deformation of coupler and rocker."""

import unittest

import numpy as np

from example import ExampleTest

CRANK, COUPLER, ROCKER, BASE, PIN = 0.12, 0.4, 0.3, 0.35, (0.15, 0.16)


class FourBar(ExampleTest):
    model = "four_bar.yaml"
    superelement = "coupler.h5"

    def test_the_tool_follows_the_closed_form(self):
        angle = self.results.rows("joints/main/coordinate")[:, 0]
        x, y = CRANK * np.cos(angle), CRANK * np.sin(angle)
        across = np.hypot(BASE - x, y)
        tilt = np.arctan2(-y, BASE - x) + np.arccos((COUPLER**2 + across**2 - ROCKER**2) / (2 * COUPLER * across))
        tool = np.stack([x + PIN[0] * np.cos(tilt) - PIN[1] * np.sin(tilt), y + PIN[0] * np.sin(tilt) + PIN[1] * np.cos(tilt)], axis=1)
        place = self.results.rows("nodes/coupler.P/position")
        self.assertLess(np.abs(place[:, :2] - tool).max(), 2e-4)
        self.assertGreater(np.ptp(tool[:, 0]), 0.15)
        self.assertLess(np.abs(place[:, 2]).max(), 1e-6)  # no force acts out of the plane

    def test_the_motor_reaches_its_speed(self):
        rate = self.results.rows("joints/main/rate")[:, 0]
        np.testing.assert_allclose(rate[self.time > 0.25], 8 * np.pi, rtol=1e-8)

    def test_energy_balance_closes(self):
        stored = self.results.rows("energy/kinetic")
        self.assertLess(np.abs(self.results.rows("energy/balance")).max(), 5e-3 * stored.max())


if __name__ == "__main__":
    unittest.main()
