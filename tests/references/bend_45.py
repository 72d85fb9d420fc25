"""The 45-degree bend (K.-J. Bathe, S. Bolourchi, Int. J. Numer. Methods Eng. 14 (1979) 961), by shooting.

The arc has the radius 100 in the plane x-y, and runs from the origin along y to (29.29, 70.71, 0). The section is 1 x
1, E = 1e7, nu = 0. A dead load acts along z at the tip.
"""
import numpy as np

import rods
import table

E, G, I = 1e7, 5e6, 1 / 12
length = 25 * np.pi
# The tangent of the arc is along y, the normal to its centre along x, and the third axis along -z, about which the arc
# is curved.
root = np.array([[0, 1, 0], [1, 0, 0], [0, 0, -1]], float)
CASES = {"polar": (G / 6, 1), "reduced_shear": (G / 6, 5 / 6), "own": (G * rods.saint_venant(1, 1), 5 / 6)}


def tips(GJ, shear, loads):
    """Returns the positions of the tip under ascending loads."""
    rod = rods.Space(GJ, E * I, E * I, E, shear * G, shear * G)
    moment, P, found = np.zeros(3), 0, []

    def end(m, load):
        force = np.array([[0], [0], [load]])
        return rod.advance(rods.start([0, 0, 0], root, m), force, length, curvature=(0, 0, 0.01), steps=30)

    for target in loads:
        for load in np.linspace(P, target, max(2, int((target - P) / 50) + 1))[1:]:
            moment = rods.newton(lambda m, load=load: end(m, load)[12:], moment, size=3e4)
        P = target
        found.append(end(moment[:, None], target)[:3, 0].real)
    return found


def fill(rows):
    loads = (300, 450, 600, 3000)
    for name, (GJ, shear) in CASES.items():
        for load, tip in zip(loads, tips(GJ, shear, loads)):
            rows.add_vector(f"{name}.{load}", tip, 1e-8, f"tip under {load}")


if __name__ == "__main__":
    table.run(fill, __file__)
