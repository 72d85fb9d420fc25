"""Tests mechanism/examples/landing_gear.yaml: it falls freely, friction spins up its wheel, its leg springs back, and
it comes to rest."""

import unittest

import numpy as np

from example import ExampleTest

UNSPRUNG = (16 + 22) * 9.81  # [N]


class LandingGear(ExampleTest):
    model = "landing_gear.yaml"

    def setUp(self):
        self.drop, self.rest = self.results.analysis(1), self.results.analysis(2)

    def rows(self, name):
        return np.squeeze(self.drop.rows(name))

    def test_it_touches_down_at_its_sink_speed(self):
        before = int(np.argmax(self.rows("measures/load") > 0)) - 1
        time = self.drop.time[before]
        self.assertAlmostEqual(self.rows("nodes/carriage/velocity")[before, 2], -9.81 * (time - 0.1), delta=0.02)
        self.assertLess(self.rows("nodes/carriage/velocity")[:, 2].min(), -2.5)

    def test_the_wheel_spins_up_and_the_leg_springs_back(self):
        slip, drag, aft = (self.rows("measures/" + name) for name in ("slip", "drag", "aft"))
        self.assertAlmostEqual(slip[0], -50, delta=1e-9)
        self.assertLess(np.abs(slip[self.drop.time > 1.5]).max(), 0.05)
        self.assertAlmostEqual(drag.min() / self.rows("measures/load")[np.argmin(drag)], -0.7, delta=1e-3)
        bent = int(np.argmax(aft))
        self.assertGreater(aft[bent], 2e-3)
        self.assertLess(aft[bent:].min(), -2e-3)

    def test_the_strut_stays_within_its_stroke(self):
        stroke = self.rows("joints/strut/coordinate")
        self.assertGreater(stroke.min(), -1e-3)
        self.assertTrue(0.3 < stroke.max() < 0.35)

    def test_the_floor_bears_the_weight_in_the_end(self):
        leg = 7850 * np.pi * (0.07**2 - 0.06**2) * 0.6 * 9.81
        load = float(np.squeeze(self.rest.rows("measures/load"))[()])
        self.assertAlmostEqual(load, 2400 * 9.81 + leg + UNSPRUNG, delta=1e-3)

    def test_energy_balance_closes(self):
        # The error decreases with the tolerance: 147, 68, 32 and 7 J with 1e-4, 3e-5, 1e-5 and 1e-6.
        self.assertLess(np.abs(self.rows("energy/balance")).max(), 2e-3 * self.rows("energy/dissipated")[-1])


if __name__ == "__main__":
    unittest.main()
