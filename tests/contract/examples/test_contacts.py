"""Tests mechanism/examples/contacts.yaml: the ball rolls, falls, hits the tile, and the tile falls on its face."""

import unittest

import numpy as np

from example import ExampleTest

GRAVITY, RADIUS, SLOPE = 9.81, 0.02, 0.35


class Contacts(ExampleTest):
    model = "contacts.yaml"

    def test_the_ball_rolls_down_the_ramp(self):
        # A ball that rolls from rest has the acceleration 5/7 g sin(slope).
        row = np.searchsorted(self.time, 0.3)
        along = self.results.rows("nodes/ball/velocity")[row, :3] @ [np.cos(SLOPE), 0, -np.sin(SLOPE)]
        self.assertAlmostEqual(along, 5 / 7 * GRAVITY * np.sin(SLOPE) * self.time[row], delta=0.01)

    def test_the_tile_stands_until_it_is_hit_and_then_falls_on_its_face(self):
        height = self.results.rows("nodes/tile/position")[:, 2]
        np.testing.assert_allclose(height[self.time < 0.3], 0.06, atol=1e-4)
        self.assertAlmostEqual(height[-1], 0.01, delta=2e-3)

    def test_the_contact_tells_what_touches(self):
        state, gap = self.results.rows("contacts/touch/state"), self.results.rows("contacts/touch/gap")
        force = self.results.rows("contacts/touch/force")
        np.testing.assert_array_equal(state > 0, gap < 0)
        np.testing.assert_allclose(force.sum(axis=1), 0, atol=1e-9 * np.abs(force).max())

    def test_the_books_close(self):
        dissipated = self.results.rows("energy/dissipated")
        self.assertGreaterEqual(np.diff(dissipated).min(), -1e-9)
        self.assertLess(np.abs(self.results.rows("energy/balance")).max(), 0.01 * dissipated[-1])


if __name__ == "__main__":
    unittest.main()
