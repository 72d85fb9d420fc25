"""Two free flywheels are connected by a universal joint with an angle of 30 degrees; the first one starts with 10
rad/s.

The energy J_1 omega_1^2 + J_2 omega_2^2, with omega_2/omega_1 = cos b/(1 - sin^2 b cos^2 theta_1), gives theta_1'.
"""
import numpy as np

import motion
import table

b, J_1, J_2 = np.pi / 6, 0.01, 0.02


def ratio(theta):
    return np.cos(b) / (1 - (np.sin(b) * np.cos(theta))**2)


def speed(theta):
    return 10 * np.sqrt((J_1 + J_2 * ratio(0)**2) / (J_1 + J_2 * ratio(theta)**2))


def fill(rows):
    theta = motion.integrate(lambda _, z: [speed(z[0])], [0], [2])[0][0]
    rows.add("angle", theta, 1e-10, "angle of the first shaft at 2 s [rad]")
    rows.add("first_rate", speed(theta), 1e-10, "rate of the first shaft at 2 s [rad/s]")
    rows.add("second_rate", speed(theta) * ratio(theta), 1e-10, "rate of the second shaft at 2 s [rad/s]")


if __name__ == "__main__":
    table.run(fill, __file__)
