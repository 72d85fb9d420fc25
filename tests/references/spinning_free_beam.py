"""A free beam that spins about a transverse axis: growth of its bending frequencies with the spin.

Length and mass are 1, EA = 1e5, EI = 1 in the plane of spin and 1.3 across it. The tension T = Om^2 (1/4 - s^2)/2, with
s from the middle, stretches the beam by a = 1 + T/EA and stiffens it: the slope is w'/a, a deflection w has the energy
EI (w'/a)'^2/2 + T w'^2/(2 a) per length, and omega^2 is smaller by Om^2 in the plane. Ritz's method with Legendre's
polynomials, which satisfies the free ends by itself. (omega^2(Om) - omega^2(0))/Om^2 at Om = 4.
"""
import numpy as np
from numpy.polynomial import Legendre
from scipy.linalg import eigh

import table


def frequencies2(EI, Om, in_plane, count=20):
    """Returns the squares of the first two elastic frequencies."""
    x, weight = np.polynomial.legendre.leggauss(60)
    x, weight = 0.5 * x, 0.5 * weight
    basis = [Legendre.basis(k, domain=[-0.5, 0.5]) * np.sqrt(2 * k + 1) for k in range(count)]
    w, slope, curvature = (np.array([f.deriv(order)(x) if order else f(x) for f in basis]) for order in (0, 1, 2))
    tension = Om**2 * (0.25 - x**2) / 2
    a, a_rate = 1 + tension / 1e5, -Om**2 * x / 1e5
    bent = curvature / a - slope * a_rate / a**2
    K = EI * (bent * weight) @ bent.T + (slope * weight * tension / a) @ slope.T
    M = (w * weight) @ w.T
    if in_plane:
        K = K - Om**2 * M
    return np.sort(eigh(K, M, eigvals_only=True))[2:4]


def fill(rows):
    growth = {}
    for name, EI in (("in_plane", 1), ("across", 1.3)):
        growth[name] = (frequencies2(EI, 4, name == "in_plane") - frequencies2(EI, 0, False)) / 16
        for k in (0, 1):
            rows.add(f"{name}_{k + 1}", growth[name][k], 1e-4, "growth of omega^2 over Om^2")


if __name__ == "__main__":
    table.run(fill, __file__)
