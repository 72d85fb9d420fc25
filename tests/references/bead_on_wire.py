"""A bead of 2 kg on a closed wire in space with friction, under gravity.

The equation is m (|c'| u'' + t . c'' u'^2 - g . t) = -N mu tanh(v/v_0), N = m |(I - t t^T)(c'' u'^2 - g)|. The curve c
is the periodic cubic spline through 240 points over the chord length. DOP853 integrates in steps of at most 2e-4 s,
since the third derivative of c jumps.
"""
import numpy as np
from scipy.integrate import quad
from scipy.interpolate import CubicSpline

import motion
import table

m, mu, v_0 = 2, 0.15, 0.02
gravity = np.array([0, 0, -9.81])


def wire():
    a = 2 * np.pi * np.arange(240) / 240
    points = np.column_stack([np.cos(a), 0.3 * np.sin(2 * a), 0.8 * np.sin(a)])
    points = np.vstack([points, points[:1]])
    u = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    return CubicSpline(u, points, bc_type="periodic")


def fill(rows):
    c = wire()
    first, second = c.derivative(1), c.derivative(2)

    def along(u, rate):
        """Returns the unit tangent, |c'|, the part of c'' u'^2 - g across the wire, and the part along it."""
        d = first(u)
        size = np.linalg.norm(d)
        t, pull = d / size, second(u) * rate**2 - gravity
        return t, size, pull - (t @ pull) * t, t @ pull

    def rate(_, z):
        u, udot = z[0], z[1]
        _, size, across, tangential = along(u, udot)
        friction = -np.linalg.norm(across) * mu * np.tanh(size * udot / v_0)
        return [udot, (friction - tangential) / size]

    start = np.linalg.norm([3.6, 4.8]) / np.linalg.norm(first(0))
    if np.dot([0, 3.6, 4.8], first(0)) < 0.99 * 6 * np.linalg.norm(first(0)):
        raise ArithmeticError("the bead does not begin along the wire")
    u, udot = motion.integrate(rate, [0, start], [1.5], max_step=2e-4)[0]
    knots = c.x[(c.x > 0) & (c.x < u)]
    ends = np.concatenate([[0], knots, [u]])
    arc = sum(quad(lambda s: np.linalg.norm(first(s)), p, q, epsabs=1e-14)[0] for p, q in zip(ends[:-1], ends[1:]))
    _, size, across, _ = along(u, udot)
    rows.add("arc", arc, 1e-9, "way along the wire at 1.5 s [m]")
    rows.add("rate", size * udot, 1e-9, "speed at 1.5 s [m/s]")
    rows.add("normal_force", m * np.linalg.norm(across), 1e-7, "normal force at 1.5 s [N]")


if __name__ == "__main__":
    table.run(fill, __file__)
