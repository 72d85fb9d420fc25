"""Tests mechanism/examples/robot_arm.yaml: the tool follows its circle, and the motors alone carry and move it."""

import unittest

import numpy as np

from example import ExampleTest

RADIUS, DENSITY, GRAVITY, PAYLOAD = 0.1, 2700, 9.81, 2
UPPER = DENSITY * np.pi * (0.03 ** 2 - 0.026 ** 2) * 0.5  # [kg]
LOWER = DENSITY * np.pi * (0.02 ** 2 - 0.017 ** 2) * np.hypot(0.4, 0.2)


class RobotArm(ExampleTest):
    model = "robot_arm.yaml"

    def torque(self, joint):
        return self.results.rows(f"joints/{joint}/drive_force").reshape(-1)

    def test_the_tool_goes_round_and_its_support_gives_nothing(self):
        tool = self.results.rows("nodes/tool/position")
        np.testing.assert_allclose(np.hypot(tool[:, 1], tool[:, 2] - 0.1 - RADIUS), RADIUS, rtol=1e-12)
        np.testing.assert_allclose(tool[-1], tool[0], atol=1e-12)
        self.assertLess(np.abs(self.results.rows("supports/tool/reaction")[:, :3]).max(), 1e-6)

    def test_at_rest_the_motors_bear_the_weight(self):
        # A positive rotation about y lowers the arm; the links sag by about 1e-4 of their length.
        elbow = -GRAVITY * 0.4 * (PAYLOAD + LOWER / 2)
        shoulder = -GRAVITY * (0.8 * PAYLOAD + 0.6 * LOWER + 0.2 * UPPER)
        for row in (0, -1):
            self.assertAlmostEqual(self.torque("elbow")[row] / elbow, 1, delta=2e-3)
            self.assertAlmostEqual(self.torque("shoulder")[row] / shoulder, 1, delta=2e-3)
            self.assertAlmostEqual(self.torque("base")[row], 0, delta=1e-6)

    def test_the_motors_do_no_work_in_all_but_some_on_the_way(self):
        work = self.results.rows("energy/input")
        # The work exceeds the potential energy of the payload, since the motors lift the links as well.
        self.assertGreater(np.abs(work).max(), 2 * RADIUS * GRAVITY * PAYLOAD)
        self.assertAlmostEqual(work[-1], 0, delta=1e-3)
        self.assertLess(np.abs(self.results.rows("energy/balance")).max(), 1e-3 * np.abs(work).max())


if __name__ == "__main__":
    unittest.main()
