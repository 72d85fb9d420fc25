"""The beam of the Princeton experiments (E. Dowell, J. Traybar, AMS Report 1194, Princeton University (1975)), by
shooting.

A cantilever of aluminium along x has 0.508 m, a section of 12.377 x 3.2024 mm, E = 71.7 GPa, nu = 0.31, and a downward
dead load (-z) at the tip. The wide side of the section is vertical at the angle 0; otherwise the section is rotated
about x by the angle. Data as in O. Bauchau et al., Multibody Syst. Dyn. 37 (2016) 29. Torsion by Saint-Venant's series,
shear factor 5/6.
"""
import numpy as np

import rods
import table

E, G, LENGTH = 71.7e9, 71.7e9 / 2.62, 0.508
WIDE, THIN = 12.377e-3, 3.2024e-3
LOADS, ANGLES = (4.448, 8.896, 13.345), (15, 30, 45, 60, 75)


def tip(angle, loads):
    """Returns the position of the tip under the last of ascending loads. The section's y axis is along its thin
    side."""
    A, c, s = WIDE * THIN, np.cos(np.radians(angle)), np.sin(np.radians(angle))
    rod = rods.Space(G * rods.saint_venant(WIDE, THIN), E * A * WIDE**2 / 12, E * A * THIN**2 / 12, E * A,
                     5 / 6 * G * A, 5 / 6 * G * A)
    root = np.array([[1, 0, 0], [0, c, -s], [0, s, c]], float)  # columns: along x, the thin side, the wide side
    moment = np.zeros(3)

    def end(m, load):
        return rod.advance(rods.start([0, 0, 0], root, m), np.array([[0], [0], [-load]]), LENGTH, steps=30)

    for load in loads:
        moment = rods.newton(lambda m, load=load: end(m, load)[12:], moment, size=1.0)
    return end(moment[:, None], loads[-1])[:3, 0].real


def fill(rows):
    for load in LOADS:
        for angle in ANGLES:
            rows.add_vector(f"{load}.{angle}", tip(angle, np.linspace(0, load, 13)[1:]), 1e-10,
                            f"tip under {load} N at {angle} degrees [m]")


if __name__ == "__main__":
    table.run(fill, __file__)
