"""Tests mechanism/examples/car.yaml: corners that are placed and mirrored carry the car equally."""

import unittest

import numpy as np

from example import ExampleTest

CORNERS = ("front_left", "front_right", "rear_left", "rear_right")
G, CHASSIS, CORNER = 9.81, 1200, 36  # masses [kg]; the wishbones and the wheel of one corner


class Car(ExampleTest):
    model = "car.yaml"

    def test_tyres_carry_the_weight_at_the_start(self):
        forces = [-self.rows(f"elements/{corner}.tyre/force")[0] for corner in CORNERS]
        weight = (CHASSIS + 4 * CORNER) * G
        # The wheels move sideways by a few millimetres, so that the tyres are inclined by a small angle.
        self.assertAlmostEqual(sum(forces), weight, delta=1e-4 * weight)
        # The centre of mass is 0.1 m in front of the middle between the axles, whose distance is 2.6 m.
        front = (CHASSIS * 1.4 / 2.6 + 2 * CORNER) * G
        self.assertAlmostEqual(forces[0] + forces[1], front, delta=2e-3 * front)

    def test_right_corners_are_mirror_images(self):
        before = self.time < 0.5
        for axle in ("front", "rear"):
            for node in ("hub", "lower", "upper", "arm", "seat"):
                left = self.rows(f"nodes/{axle}_left.{node}/position")[before]
                right = self.rows(f"nodes/{axle}_right.{node}/position")[before]
                np.testing.assert_allclose(left * [1, -1, 1], right, atol=1e-12)
            # Hinges turn by equal angles, since the axis of the mirror image is reversed.
            np.testing.assert_allclose(self.rows(f"joints/{axle}_left.lower_hinge/coordinate")[before],
                                       self.rows(f"joints/{axle}_right.lower_hinge/coordinate")[before], atol=1e-12)

    def test_the_bump_lifts_the_left_wheels_one_after_the_other(self):
        for corner, begins in (("front_left", 0.5), ("rear_left", 0.5 + 2.6 / 10)):
            road, hub = self.rows(f"nodes/{corner}.road/position")[:, 2], self.rows(f"nodes/{corner}.hub/position")[:, 2]
            np.testing.assert_allclose(road[self.time <= begins], 0, atol=1e-12)
            self.assertAlmostEqual(road.max(), 0.05, delta=2e-4)
            self.assertGreater(hub.max(), hub[0] + 0.03)
        for corner in ("front_right", "rear_right"):
            np.testing.assert_allclose(self.rows(f"nodes/{corner}.road/position")[:, 2], 0, atol=1e-12)

    def test_the_car_comes_to_rest_where_it_was(self):
        position = self.rows("nodes/chassis/position")
        np.testing.assert_allclose(position[-1], position[0], atol=1e-4)
        self.assertGreater(np.abs(self.rows("measures/roll")).max(), 5e-3)
        self.assertLess(np.abs(self.rows("measures/roll")[-1]), 1e-5)


if __name__ == "__main__":
    unittest.main()
