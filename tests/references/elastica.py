"""The cantilever of length 1 and EI = 1 under a dead load alpha across its tip, by shooting.

One cantilever is inextensible (K. Mattiasson, Int. J. Numer. Methods Eng. 17 (1981) 145), the other one is Reissner's
rod of EA = 1200, GA = 1000/2.6.
"""
import numpy as np

import rods
import table


def tip(alpha, EA, GA):
    """Returns position and slope of the tip."""
    rod = rods.Plane(1, EA, GA)

    def end(m):
        zero = 0 * m[0]
        return rod.advance(np.array([zero, zero, zero, m[0]]), (0, alpha), 1, steps=40)

    moment = [0.0]
    for load in np.linspace(0, alpha, 11)[1:]:
        moment = rods.newton(lambda m, P=load: rod.advance(np.array([0 * m[0], 0 * m[0], 0 * m[0], m[0]]), (0, P), 1,
                                                           steps=40)[3:], moment)
    return end(moment[:, None])[:3, 0]


def fill(rows):
    for alpha in (1, 2, 5, 10):
        x, y, slope = tip(alpha, np.inf, np.inf)
        rows.add(f"inextensible_{alpha}.shortening", 1 - x, 1e-11, "of the length")
        rows.add(f"inextensible_{alpha}.deflection", y, 1e-11, "of the length")
        rows.add(f"inextensible_{alpha}.slope", slope, 1e-11, "[rad]")
    for alpha in (1, 10):
        x, y, slope = tip(alpha, 1200, 1000 / 2.6)
        rows.add_vector(f"reissner_{alpha}", [x, y, slope], 1e-11, "position and slope of the tip")


if __name__ == "__main__":
    table.run(fill, __file__)
