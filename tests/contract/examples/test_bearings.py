"""Compares mechanism/examples/bearings.yaml with closed forms: Ocvirk's of an oil film, and that of preloaded ball
bearings under axial load."""

import unittest

import numpy as np

from example import ExampleTest

SPEED, PUSH, PRELOAD = 400, 600, 300


class Bearings(ExampleTest):
    model = "bearings.yaml"

    def rows(self, name):
        return np.array(self.results.rows(name))

    def test_the_rotor_is_carried_with_the_eccentricity_and_attitude_of_a_short_bearing(self):
        diameter, length, clearance, viscosity = 0.04, 0.016, 40e-6, 0.02
        x, y = self.rows("joints/left/coordinate")[-1, :2]
        eps = np.hypot(x, y) / clearance
        root = np.sqrt(1 - eps**2)
        load = viscosity * SPEED * diameter / 2 * length**3 / (4 * clearance**2) * eps / root**4 * np.sqrt(16 * eps**2 + np.pi**2 * root**2)
        self.assertAlmostEqual(load / (16 * 9.81 / 2), 1, delta=1e-3)  # at rest to 0.1 %
        down = self.rows("nodes/rotor/position")[-1]
        self.assertAlmostEqual(np.arctan2(abs(down[0]), -down[2]) / np.arctan(np.pi * root / (4 * eps)), 1, delta=1e-3)
        spin = self.rows("joints/left/coordinate")[-1, 5]
        self.assertAlmostEqual(spin / (SPEED * self.time[-1]), 1, delta=1e-6)

    def test_the_preloaded_pair_carries_the_push_by_the_difference_of_its_bearings(self):
        upper, lower = (self.rows(f"joints/{name}/force")[:, 2] for name in ("upper", "lower"))
        self.assertAlmostEqual(upper[0] / -PRELOAD, 1, delta=1e-9)
        self.assertAlmostEqual(lower[0] / -PRELOAD, 1, delta=1e-9)
        self.assertAlmostEqual((lower[-1] - upper[-1]) / PUSH, 1, delta=1e-3)

    def test_the_unloading_of_the_lower_bearing_is_noted(self):
        names = self.results.text_of("crossings").splitlines()
        times = [time for time, which in zip(self.results.file["events/time"][:], self.results.file["events/crossing"][:]) if "unloading" in names[int(which)]]
        self.assertEqual(len(times), 1)
        # Rows are interpolated linearly.
        self.assertAlmostEqual(np.interp(times[0], self.time, self.rows("joints/lower/force")[:, 2]), -100, delta=2)


if __name__ == "__main__":
    unittest.main()
