"""Tests mechanism/examples/digital_servo.yaml: the arm is lifted and holds its weight, and states are constant between
instants."""

import unittest

import numpy as np

from example import ExampleTest

MASS, LENGTH, LIFT, GRAVITY, PERIOD, COUNT = 1.5, 0.4, 1.0, 9.81, 1e-3, 2 * np.pi / 4096


class DigitalServo(ExampleTest):
    model = "digital_servo.yaml"

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.angle = cls.results.rows("joints/shoulder/coordinate")[:, 0]
        cls.encoder = cls.results.rows("measures/encoder").ravel()
        cls.volts = cls.results.rows("measures/volts").ravel()

    def test_the_arm_is_lifted_and_its_weight_held(self):
        late = self.time > 1.9  # the integral settles within kp/ki = 0.3 s
        np.testing.assert_allclose(self.angle[late], LIFT, atol=5e-3)
        torque = self.results.rows("measures/motor.torque").ravel()[late]
        weight = MASS * GRAVITY * LENGTH / 2 * np.sin(LIFT)
        self.assertAlmostEqual(torque.mean(), weight, delta=0.05 * weight)
        self.assertLess(self.angle.max(), 1.05 * LIFT)

    def test_the_encoder_counts_whole_steps_at_the_instants(self):
        counts = self.encoder / COUNT
        np.testing.assert_allclose(counts, np.round(counts), atol=1e-8)
        steps = np.round(self.time / (PERIOD / 2)).astype(int)
        np.testing.assert_allclose(steps * PERIOD / 2, self.time, atol=1e-12)
        # The row at an instant has the value before it; the next row has the new value.
        self.assertLess(np.abs(self.encoder[1::2] - self.angle[:-1:2]).max(), COUNT / 2 + 1e-9)
        np.testing.assert_array_equal(self.encoder[2::2], self.encoder[1::2])

    def test_the_voltage_stays_within_its_limit(self):
        self.assertLessEqual(np.abs(self.volts).max(), 24)
        self.assertGreater(np.abs(self.volts).max(), 1)


if __name__ == "__main__":
    unittest.main()
