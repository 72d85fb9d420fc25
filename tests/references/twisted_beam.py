"""The twisted beam (R. MacNeal, R. Harder, Finite Elem. Anal. Des. 1 (1985) 3): deflections under unit loads.

The beam has the length 12, a section of 1.1 x 0.32 that rotates by 90 degrees over the length, E = 29e6, nu = 0.22, and
the shear factor 5/6. By the principle of virtual forces, integrals of the section's flexibility in inertial axes give
the exact deflections of a linear rod.
"""
import numpy as np
from scipy.integrate import quad_vec

import table

L, width, height, E = 12, 0.32, 1.1, 29e6
G = E / 2.44


def flexibility(shear):
    """Returns the deflections (y, z) of the tip under unit loads (y, z). @param shear  factor of the area; infinite:
    none"""
    # The section's first axis is along y at the root, and is the direction of the width.
    bending = np.diag([1 / (E * width * height**3 / 12), 1 / (E * height * width**3 / 12)])  # about its axes y, z

    def integrand(x):
        angle = np.pi / 2 * x / L
        c, s = np.cos(angle), np.sin(angle)
        axes = np.array([[c, -s], [s, c]])
        # A load (P_y, P_z) causes the moments (-(L - x) P_z, (L - x) P_y) about y and z.
        moments = (L - x) * np.array([[0, -1], [1, 0]])
        bent = moments.T @ axes @ bending @ axes.T @ moments
        return bent + np.eye(2) / (shear * G * width * height)
    return quad_vec(integrand, 0, L, epsabs=1e-16, epsrel=1e-13)[0]


def fill(rows):
    both, bending = flexibility(5 / 6), flexibility(np.inf)
    for name, values in (("shear", both), ("bending", bending)):
        rows.add(f"{name}.y", values[0, 0], 1e-12, "deflection along y under 1 along y")
        rows.add(f"{name}.z", values[1, 1], 1e-12, "deflection along z under 1 along z")
        rows.add(f"{name}.cross", abs(values[0, 1]), 1e-12, "deflection across the load")


if __name__ == "__main__":
    table.run(fill, __file__)
