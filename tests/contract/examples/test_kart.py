"""Tests mechanism/examples/kart.yaml: the tyres carry the kart within their friction, steer it, and hold it on the
slope."""

import math
import unittest

import numpy as np

from example import ExampleTest

TYRES = ("front_left", "front_right", "rear_left", "rear_right")
G, SLOPE, MASS, TRACK, RADIUS = 9.81, 0.08, 150 + 2 * 1 + 4 * 4, 1.1, 0.13
# The centre of mass of the chassis is at a height of 0.2 m, those of knuckles and wheels at the height of the hubs.
HEIGHT = (150 * 0.2 + 18 * (RADIUS - 3.6e-3)) / MASS


class Kart(ExampleTest):
    model = "kart.yaml"

    def forces(self):
        """Returns the sum of the forces of the tyres on the wheels, in inertial axes."""
        return sum(self.rows(f"joints/{tyre}.tyre/reaction_inertial")[:, :3] for tyre in TYRES)

    def loads(self):
        return {tyre: self.rows(f"joints/{tyre}.tyre/normal_force") for tyre in TYRES}

    def test_the_tyres_carry_the_weight(self):
        # The mean is taken while the kart rolls straight, since it heaves on its tyres by some thousandths.
        straight = (self.time > 0.2) & (self.time < 1)
        mean = sum(self.loads().values())[straight].mean()
        self.assertAlmostEqual(mean / (MASS * G * math.cos(SLOPE)), 1, delta=1e-3)

    def test_no_tyre_has_more_than_its_friction(self):
        for tyre, load in self.loads().items():
            force = np.linalg.norm(self.rows(f"joints/{tyre}.tyre/tyre_force"), axis=1)
            self.assertLess((force / (0.9 * load)).max(), 1.001)

    def test_the_outer_tyres_carry_the_moment_of_the_turn(self):
        # In the steady left turn, m a h = (N_right - N_left) w/2 with a = speed times rate of the heading.
        row = np.argmin(abs(self.time - 2.8))
        load, velocity = self.loads(), self.rows("nodes/chassis/velocity")[row]
        centripetal = math.hypot(velocity[0], velocity[1]) * velocity[5]
        heading = math.atan2(velocity[1], velocity[0])
        downhill = G * math.sin(SLOPE) * math.sin(-heading)  # axis to the left of the kart
        moved = (load["front_right"] + load["rear_right"] - load["front_left"] - load["rear_left"])[row] * TRACK / 2
        self.assertGreater(centripetal, 4)
        # Wheels that rotate with the kart add their gyroscopic moments I w Omega.
        spin = math.hypot(velocity[0], velocity[1]) / RADIUS
        expected = MASS * (centripetal - downhill) * HEIGHT + 4 * 0.02 * spin * velocity[5]
        self.assertAlmostEqual(moved / expected, 1, delta=0.02)

    def test_the_brakes_slow_it_by_their_torque(self):
        # The rear wheels brake with brake/radius. Rolling resistance acts on all wheels, whose rotation must stop as
        # well.
        speed = self.rows("measures/velocity")
        early, late = (np.argmin(abs(self.time - t)) for t in (5, 7))
        slowed = (speed[early] - speed[late]) / 2
        heading = math.atan2(*self.rows("nodes/chassis/velocity")[late][[1, 0]])
        inertia = 4 * 0.02 / RADIUS**2
        braking = 2 * 30 / RADIUS + 0.015 * MASS * G - MASS * G * math.sin(SLOPE) * math.cos(heading)
        self.assertAlmostEqual(slowed / (braking / (MASS + inertia)), 1, delta=0.02)

    def test_it_stands_on_the_slope_and_does_not_creep(self):
        last = self.time > 9.5
        position = self.rows("nodes/chassis/position")[last]
        self.assertLess(np.ptp(position, axis=0).max(), 1e-4)
        force = self.forces()[-1]
        self.assertAlmostEqual(force[0] / (-MASS * G * math.sin(SLOPE)), 1, delta=0.02)
        self.assertLess(abs(force[1]), 0.02 * abs(force[0]))


if __name__ == "__main__":
    unittest.main()
