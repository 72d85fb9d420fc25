"""Four-bar linkages of thin bars of 1 kg/m under gravity.

The first one has ground 1, crank 0.3, coupler 0.9 and rocker 0.7 m, is released with its crank at 60 degrees, and is
computed in Cartesian coordinates. N loops of 1 m are computed by their reduced equation I th'' = G sin(th), I = (N+1)/3
+ N, G = g ((N+1)/2 + N).
"""
import numpy as np

import linkage
import motion
import table

g = 9.81


def released(rows):
    linkage_ = linkage.Linkage(g)
    lengths = [0.3, 0.9, 0.7]
    crank, coupler, rocker = (linkage_.body(l, l**3 / 12) for l in lengths)
    linkage_.pin(None, [0, 0], crank, [-0.15, 0])
    linkage_.pin(crank, [0.15, 0], coupler, [-0.45, 0])
    linkage_.pin(coupler, [0.45, 0], rocker, [0.35, 0])
    linkage_.pin(rocker, [-0.35, 0], None, [1, 0])
    angle = np.pi / 3
    # The rocker is on the upper side of the diagonal.
    B = 0.3 * np.array([np.cos(angle), np.sin(angle)])
    across = np.array([1, 0]) - B
    d = np.linalg.norm(across)
    a = (0.9**2 - 0.7**2 + d * d) / (2 * d)
    C = B + a / d * across + np.sqrt(0.81 - a * a) / d * np.array([-across[1], across[0]])
    z = []
    for p, q in ((np.zeros(2), B), (B, C), (np.array([1., 0.]), C)):
        z += [*(0.5 * (p + q)), np.arctan2(*(q - p)[::-1])]
    z = linkage_.assembled(z, keep=[2])
    positions, _ = linkage_.move(z, np.zeros(9), [1])
    end = positions[0]
    tip = linkage_.point(end, rocker, np.array([0.35, 0]))
    rows.add("released.crank", end[2], 1e-9, "angle of the crank at 1 s [rad]")
    rows.add_vector("released.tip", tip, 1e-9, "end of the rocker at 1 s [m]", "xy")


def loops(rows, n):
    I, G = (n + 1) / 3 + n, g * ((n + 1) / 2 + n)
    angle = motion.integrate(lambda _, z: [z[1], G / I * np.sin(z[0])], [0, 1], [10])[0][0]
    rows.add_vector(f"loops_{n}.top", [np.sin(angle), np.cos(angle)], 1e-10, "end of the first crank at 10 s [m]", "xy")


def fill(rows):
    released(rows)
    for n in (1, 2, 40):
        loops(rows, n)


if __name__ == "__main__":
    table.run(fill, __file__)
