"""Bending frequencies of Timoshenko's beam of square steel section, shear factor 5/6: E = 210 GPa, nu = 0.3.

A matrix exponential gives deflection w, rotation psi, moment and shear force along the beam. At a frequency, the
determinant of the conditions at the far end is zero.
"""
import numpy as np
from scipy.linalg import expm
from scipy.optimize import brentq

import table

E = 210e9


class Beam:
    """@param side  side of the square; the length is 1 m"""

    def __init__(self, side, density):
        A, I = side**2, side**4 / 12
        self.EI, self.GA = E * I, 5 / 6 * E / 2.6 * A
        self.mass, self.rotary = density * A, density * I

    def across(self, omega):
        """Returns the map from one end to the other, by w' = psi + V/GA, psi' = M/EI, M' = -V - J omega^2 psi, V' = -m
        omega^2 w.

        It is scaled, so that all entries have similar sizes.
        """
        w2 = omega**2
        system = np.array([[0, 1, 0, self.EI / self.GA], [0, 0, 1, 0], [0, -self.rotary * w2 / self.EI, 0, -1],
                           [-self.mass * w2 / self.EI, 0, 0, 0]])
        return expm(system)

    def roots(self, given, asked, guesses):
        """Returns frequencies [rad/s] near guesses. @param given,asked  which of w, psi, M, V are zero at the two
        ends"""
        free = [k for k in range(4) if k not in given]

        def determinant(omega):
            return np.linalg.det(self.across(omega)[np.ix_(asked, free)])
        found = []
        for guess in guesses:
            grid = guess * np.linspace(0.97, 1.03, 61)
            values = [determinant(omega) for omega in grid]
            changes = [k for k in range(60) if values[k] * values[k + 1] < 0]
            if len(changes) != 1:
                raise ArithmeticError(f"{len(changes)} frequencies near {guess}")
            found.append(brentq(determinant, grid[changes[0]], grid[changes[0] + 1], xtol=1e-10, rtol=1e-14))
        return found


def fill(rows):
    slender = Beam(0.02, 7800)
    for k, omega in enumerate(slender.roots((0, 1), (2, 3), (105.3, 658.6, 1838.6))):
        rows.add(f"slender.clamped_{k + 1}", omega, 1e-6, "side 0.02 m [rad/s]")
    for k, omega in enumerate(slender.roots((0, 2), (0, 2), (295.5, 1179.5, 2644.9))):
        rows.add(f"slender.pinned_{k + 1}", omega, 1e-6, "side 0.02 m [rad/s]")
    thick = Beam(0.1, 7800)
    for k, omega in enumerate(thick.roots((0, 1), (2, 3), (2 * np.pi * 83.2, 2 * np.pi * 498))):
        rows.add(f"thick.clamped_{k + 1}", omega / (2 * np.pi), 1e-7, "side 0.1 m [Hz]")
    for omega in thick.roots((2, 3), (2, 3), (2 * np.pi * 515,)):
        rows.add("thick.free", omega / (2 * np.pi), 1e-7, "side 0.1 m [Hz]")


if __name__ == "__main__":
    table.run(fill, __file__)
