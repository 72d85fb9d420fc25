"""The double pendulum of two masses of 1 kg on rods of 1 m, which is released from the horizontal.

DOP853 integrates Lagrange's equations in the angles of the rods from the vertical.
"""
import numpy as np

import motion
import table

g = 9.81


def rate(_, z):
    upper, lower, u, w = z
    c, s = np.cos(upper - lower), np.sin(upper - lower)
    acceleration = np.linalg.solve([[2, c], [c, 1]],
                                   [-s * w * w - 2 * g * np.sin(upper), s * u * u - g * np.sin(lower)])
    return [u, w, *acceleration]


def fill(rows):
    states = motion.integrate(rate, [np.pi / 2, np.pi / 2, 0, 0], [1, 2])
    for time, (upper, lower, _, _) in zip((1, 2), states):
        rows.add(f"upper_at_{time}", upper, 1e-10, f"angle of the upper rod at {time} s [rad]")
        rows.add(f"lower_at_{time}", lower, 1e-10, f"angle of the lower rod at {time} s [rad]")


if __name__ == "__main__":
    table.run(fill, __file__)
