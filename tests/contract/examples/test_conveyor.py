"""Tests mechanism/examples/conveyor.yaml: a crate slides on the belt, moves with it, and is stopped at the end of the
belt."""

import math
import unittest

import numpy as np

from example import ExampleTest

G, SLOPE, FRICTION, MASS = 9.81, math.radians(8), 0.4, 40
SLIDING = 1.5 / (G * (FRICTION * math.cos(SLOPE) - math.sin(SLOPE)))  # [s]


class Conveyor(ExampleTest):
    model = "conveyor.yaml"

    def test_times_ways_and_work_are_those_of_coulombs_law(self):
        self.assert_gallery_checks("conveyor", {"run": self.path})

    def test_the_belt_pushes_with_its_friction_and_then_with_the_weight(self):
        push = self.rows("measures/push")
        sliding, carried = self.time < 0.9 * SLIDING, self.time > 1.5 * SLIDING
        sliding &= self.time > 0.05
        self.assertAlmostEqual(push[sliding].mean() / (FRICTION * MASS * G * math.cos(SLOPE)), 1, delta=1e-3)
        self.assertAlmostEqual(push[carried].mean() / (MASS * G * math.sin(SLOPE)), 1, delta=1e-3)

    def test_heat_is_friction_times_the_sliding_way(self):
        # The belt moves by speed^2/(2 a) relative to the crate, and the crate moves by the same distance.
        row = np.searchsorted(self.time, 1.2 * SLIDING)
        heat = FRICTION * MASS * G * math.cos(SLOPE) * 1.5 * SLIDING / 2
        self.assertAlmostEqual(self.rows("energy/dissipated")[row] / heat, 1, delta=5e-3)

    def test_the_light_barrier_stops_the_run(self):
        self.assertEqual([name for name, _ in self.events()], ["event 'carried'", "event 'arrived'"])
        self.assertAlmostEqual(self.time[-1], self.events()[1][1], delta=1e-9)
        self.assertAlmostEqual(self.rows("measures/way")[-1], 3, delta=1e-6)

    def test_energy_balance_closes(self):
        self.assertLess(np.abs(self.rows("energy/balance")).max(), 1e-4 * self.rows("energy/input")[-1])


if __name__ == "__main__":
    unittest.main()
