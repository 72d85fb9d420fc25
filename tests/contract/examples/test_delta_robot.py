"""Compares the angles and torques of the motors of mechanism/examples/delta_robot.yaml with closed forms."""

import math
import unittest

import numpy as np

from example import ExampleTest

BASE, PLATFORM, ARM, ROD, DROOP = 0.2, 0.05, 0.25, 0.6, math.radians(30)


def motor_angle(place, azimuth):
    """Returns the angle below the horizontal of the upper arm for a position of the platform.

    It solves |(X - ARM cos q, y, z + ARM sin q)| = ROD in the plane of the arm, with X = x + PLATFORM - BASE.
    """
    x, y, z = place
    along, across = x * math.cos(azimuth) + y * math.sin(azimuth), y * math.cos(azimuth) - x * math.sin(azimuth)
    X = along + PLATFORM - BASE
    K = (X ** 2 + across ** 2 + z ** 2 + ARM ** 2 - ROD ** 2) / (2 * ARM)
    return math.atan2(-z, X) - math.acos(K / math.hypot(X, z))


class DeltaRobot(ExampleTest):
    model = "delta_robot.yaml"

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.place = np.array(cls.results.rows("nodes/platform/position"))

    def test_motors_follow_the_closed_form(self):
        for k in range(3):
            expected = [motor_angle(place, 2 * math.pi / 3 * k) - DROOP for place in self.place]
            angle = np.squeeze(self.results.rows(f"joints/arm_{k + 1}.motor/coordinate"))
            self.assertGreater(np.ptp(angle), 0.1)
            np.testing.assert_allclose(angle, expected, atol=1e-12)

    def test_the_platform_goes_once_round_and_keeps_its_orientation(self):
        np.testing.assert_allclose(self.place[-1], self.place[0], atol=1e-12)
        np.testing.assert_allclose(np.hypot(self.place[:, 0], self.place[:, 1] - 0.08), 0.08, atol=1e-12)
        rotation = np.array(self.results.rows("nodes/platform/rotation"))
        np.testing.assert_allclose(rotation, np.broadcast_to(rotation[0], rotation.shape), atol=1e-12)

    def test_torques_hold_the_weights_at_rest(self):
        """The virtual work of the three motors balances that of the weights of the platform (1 kg) and of the upper
        arms (0.6 kg)."""
        z, step = self.place[0, 2], 1e-6
        turn = (motor_angle((0, 0, z + step), 0) - motor_angle((0, 0, z - step), 0)) / (2 * step)  # dq/dz
        torque = -9.81 * (1 / (3 * turn) - 0.6 * ARM / 2 * math.cos(DROOP)) * -1
        for k in range(3):
            force = np.squeeze(self.results.rows(f"joints/arm_{k + 1}.motor/drive_force"))
            for row in (0, -1):
                self.assertAlmostEqual(force[row], torque, delta=1e-6 * abs(torque))


if __name__ == "__main__":
    unittest.main()
