"""Tests mechanism/examples/servo.yaml: the arm is at rest, is lifted within the limit of its motor, and falls when
released."""

import unittest

import numpy as np

from example import ExampleTest

MASS, LENGTH, LIFT, MOST, GRAVITY = 4.0, 0.8, 0.8, 28.0, 9.81


class Servo(ExampleTest):
    model = "servo.yaml"

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.angle = cls.results.rows("joints/shoulder/coordinate")[:, 0]
        cls.torque = cls.results.rows("joints/shoulder/drive_force")[:, 0]

    def test_the_arm_stands_still_until_it_is_told_to_move(self):
        before = self.time < 0.199
        weight = MASS * GRAVITY * LENGTH / 2
        np.testing.assert_allclose(self.angle[before], 0, atol=1e-7)
        np.testing.assert_allclose(self.torque[before], weight, rtol=1e-5)
        np.testing.assert_allclose(self.results.rows("measures/sensed")[before], 0, atol=1e-7)

    def test_the_motor_gives_what_it_has_and_lifts_the_arm(self):
        driven = (self.time > 0.2) & (self.time < 1.999)
        self.assertAlmostEqual(self.torque[driven].max(), MOST, delta=1e-9)
        self.assertGreaterEqual(self.torque[driven].min(), -MOST)
        late = (self.time > 1.9) & (self.time < 1.999)
        np.testing.assert_allclose(self.angle[late], LIFT, atol=2e-3)
        np.testing.assert_allclose(self.torque[late], MASS * GRAVITY * LENGTH / 2 * np.cos(LIFT), rtol=1e-2)
        self.assertLess(self.angle.max(), 1.1 * LIFT)

    def test_the_arm_that_is_let_go_falls_freely(self):
        free = self.time > 2.001
        np.testing.assert_array_equal(self.torque[free], 0)
        energy = self.results.rows("energy/kinetic") + self.results.rows("energy/gravity")
        np.testing.assert_allclose(energy[free], energy[free][0], atol=1e-3)
        self.assertLess(self.angle[-1], 0.2)

    def test_the_arrival_is_an_event(self):
        file = self.results.file
        names = file["crossings"][()].decode().splitlines()
        met = [names[int(which)] for which in file["events/crossing"][()]]
        self.assertEqual(met, ["event 'arrived'"])


if __name__ == "__main__":
    unittest.main()
