"""Tests mechanism/examples/trebuchet.yaml: the axle hits the limits of its play, the sling pulls, and the stone flies
in a plane."""

import unittest

import numpy as np

from example import ExampleTest


class Trebuchet(ExampleTest):
    model = "trebuchet.yaml"

    def setUp(self):
        self.throw, self.flight = self.results.analysis(1), self.results.analysis(2)

    def test_the_axle_lies_in_its_bush_and_is_lifted_after_the_throw(self):
        play = np.squeeze(self.throw.rows("measures/play"))
        trigger = 9.81 * (2500 * 1 - 150 * 1.5) / 4
        self.assertAlmostEqual(play[0], 4e-3 + ((9.81 * 2650 + trigger) / 2e9)**(2 / 3), delta=1e-7)
        self.assertLess(play[self.throw.time > 0.97].min(), 4e-3)
        force = np.linalg.norm(self.throw.rows("joints/axle/reaction")[:, :3], axis=1)
        self.assertGreater(force.max(), 4 * force[0])

    def test_the_sling_pulls_until_it_is_let_go_of(self):
        force = np.linalg.norm(self.throw.rows("joints/sling/reaction")[:, :3], axis=1)
        turned = np.squeeze(self.throw.rows("measures/sling_angle"))
        self.assertGreater(force[(self.throw.time > 0.2) & (turned < np.radians(-46))].min(), 0)
        self.assertEqual(force[-1], 0)
        self.assertEqual(np.linalg.norm(self.flight.rows("joints/sling/reaction")), 0)

    def test_the_stone_leaves_its_trough_and_lands_beyond_the_axle(self):
        height = self.throw.rows("nodes/stone/position")[:, 2]
        self.assertAlmostEqual(height[0], 0.12, delta=5e-4)
        self.assertGreater(height[-1], 5)
        place = self.flight.rows("nodes/stone/position")[-1]
        self.assertAlmostEqual(place[2], 0.12, delta=1e-6)
        # The range is below that for the whole energy of the weight, which sinks by less than twice the short arm.
        self.assertTrue(200 < place[0] < 2 * 2500 / 20 * 2)

    def test_energy_balance_closes(self):
        balance = self.results.rows("energy/balance")
        self.assertLess(np.abs(balance).max(), 0.01 * self.results.rows("energy/kinetic").max())


if __name__ == "__main__":
    unittest.main()
