"""Tests mechanism/examples/latch.yaml: the effect of its events, and the angular momentum that the latch conserves."""

import math
import unittest

import numpy as np

from example import ExampleTest

LOWER, UPPER = 2.0, 1.2  # [kg]
BOX = (1 + 0.04 ** 2) / 12 * LOWER, (1 + 0.03 ** 2) / 12 * UPPER  # [kg m^2] about the centres


class Latch(ExampleTest):
    model = "latch.yaml"

    def momentum(self):
        """Returns the angular momentum about the base, positive when the mast rises."""
        total = 0
        for name, mass, inertia in (("lower", LOWER, BOX[0]), ("upper", UPPER, BOX[1])):
            x, v = (self.rows(f"nodes/{name}/{of}") for of in ("position", "velocity"))
            total = total + mass * (x[:, 0] * v[:, 2] - x[:, 2] * v[:, 0]) - inertia * v[:, 4]
        return total

    def test_events_and_their_actions_are_listed_in_their_order(self):
        self.assertEqual([name for name, _ in self.events()],
                         ["event 'let_go': releases 'sling'", "event 'latched': locks 'knee'",
                          "event 'upright': locks 'base', sets 'lamp' to 1"])
        self.assertAlmostEqual(self.events()[0][1], 0.2, delta=1e-9)

    def test_the_latch_and_the_freed_base_keep_the_momentum_about_the_base(self):
        after = int(np.searchsorted(self.time, self.events()[1][1]))
        before = after - 1
        self.assertEqual(self.rows("joints/base/rate")[before], 0)
        # The row after the event is up to one step later; the springs change the momentum by 1 % in this time.
        momentum = self.momentum()
        self.assertAlmostEqual(momentum[after + 1] / momentum[before], 1, delta=0.03)
        mast = LOWER / 4 + BOX[0] + UPPER * 2.25 + BOX[1]
        self.assertAlmostEqual(self.rows("joints/base/rate")[after + 1] * mast / momentum[before], 1, delta=0.03)
        np.testing.assert_allclose(self.rows("joints/knee/coordinate")[after + 1:], math.pi, atol=1e-8)

    def test_it_stands_upright_in_the_end(self):
        self.assertAlmostEqual(self.rows("joints/base/coordinate")[-1], math.pi / 2, delta=1e-8)
        self.assertEqual(self.rows("measures/lamp")[-1], 1)
        self.assertEqual(self.rows("measures/tension")[-1], 0)
        self.assertGreater(self.rows("measures/tension")[0], 0)
        self.assertAlmostEqual(self.rows("measures/waiting")[-1], self.time[-1] - self.events()[1][1], delta=1e-9)

    def test_energy_balance_closes(self):
        self.assertLess(np.abs(self.rows("energy/balance")).max(), 2e-3 * self.rows("energy/elastic")[0])


if __name__ == "__main__":
    unittest.main()
