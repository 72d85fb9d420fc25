"""Tests mechanism/examples/wind_turbine.yaml: three copies of one blade rotate at the speed of the motor, and their
bearings hold them."""

import math
import unittest

import numpy as np

from example import ExampleTest

SPEED, ROOT, TIP, DENSITY = math.pi, 1.5, 20, 1900


def area(s):
    """Returns the area of the box section, whose dimensions vary linearly along the blade."""
    width, height, wall = 1.6 - 1.1 * s, 0.45 - 0.35 * s, 0.02 - 0.014 * s
    return width * height - (width - 2 * wall) * (height - 2 * wall)


class WindTurbine(ExampleTest):
    model = "wind_turbine.yaml"

    def test_blades_stand_at_a_third_of_a_turn(self):
        start = [self.rows(f"nodes/blade_{k}.tip/position")[0] for k in (1, 2, 3)]
        angles = sorted(math.atan2(-place[1], place[2]) for place in start)
        np.testing.assert_allclose(np.diff(angles), 2 * math.pi / 3, atol=5e-3)  # the blades bend under their weight

    def test_the_motor_brings_it_to_speed(self):
        rate = self.rows("joints/shaft/rate")
        np.testing.assert_allclose(rate[self.time > 6], SPEED, rtol=1e-9)

    def test_bearings_carry_the_centrifugal_forces(self):
        """The mean force along a blade over one turn is the integral of rho A omega^2 r."""
        s = (np.arange(4000) + 0.5) / 4000
        r = ROOT + (TIP - ROOT) * s
        expected = DENSITY * SPEED ** 2 * np.mean(area(s) * r) * (TIP - ROOT)
        turn = (self.time > 8 - 1e-9) & (self.time < 10 - 1e-3)
        for k in (1, 2, 3):
            reaction = self.rows(f"joints/blade_{k}.bearing/reaction")[turn]
            self.assertAlmostEqual(abs(reaction[:, 2].mean()) / expected, 1, delta=0.01)

    def test_energy_balance_closes(self):
        self.assertLess(np.abs(self.rows("energy/balance")).max(), 1e-3 * self.rows("energy/input").max())


if __name__ == "__main__":
    unittest.main()
