"""A pendulum of 1 kg and 1 m that is released from the horizontal, with gravity 9.81 m/s^2, by Jacobi's elliptic
functions with 30 digits: sin(angle/2) = k sn(K - w t), k^2 = 1/2.

The angle is measured from the lowest position and positive at the start.
"""
import mpmath
from mpmath import mpf, sqrt

import table

g = mpf("9.81")


def fill(rows):
    mpmath.mp.dps = 30
    m = mpf(1) / 2
    K, w = mpmath.ellipk(m), sqrt(mpf("9.81"))

    def place(t):
        half = sqrt(m) * mpmath.ellipfun("sn", K - w * t, m=m)
        angle = 2 * mpmath.asin(half)
        return -mpmath.sin(angle), -mpmath.cos(angle)

    # The closed form satisfies angle'' = -g sin(angle), since cos(angle) angle' = -xdot with angle'^2 = 2 g cos(angle).
    t = mpf("0.3")
    x, y = place(t)
    if abs(mpmath.diff(lambda s: place(s)[0], t)**2 - 2 * g * (-y) * y * y) > mpf("1e-12"):
        raise ArithmeticError("the closed form does not keep the energy")
    for t in (1, 5):
        rows.add_vector(f"{t}", place(mpf(t)), 1e-14, f"place at {t} s [m]", "xy")
    rows.add("tension_10", -3 * g * place(mpf(10))[1], 1e-12, "tension of the rod at 10 s [N]")


if __name__ == "__main__":
    table.run(fill, __file__)
