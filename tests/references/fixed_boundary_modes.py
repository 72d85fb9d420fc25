"""Craig and Bampton's method for Bernoulli's beam: relative errors of frequencies over the number of modes.

Boundary functions are Hermite's polynomials (statically exact), and fixed-boundary modes the exact ones of the beam
that is clamped at both ends. Integrals use Gauss' rule. Length, EI and mass per length are 1.
"""
import numpy as np
from scipy.linalg import eigh
from scipy.optimize import brentq

import table

x, weight = np.polynomial.legendre.leggauss(200)
x, weight = 0.5 * (x + 1), 0.5 * weight


def hermite():
    """Returns values and second derivatives of the four polynomials, for deflection and slope of the ends."""
    values = [1 - 3 * x**2 + 2 * x**3, x - 2 * x**2 + x**3, 3 * x**2 - 2 * x**3, x**3 - x**2]
    curvatures = [12 * x - 6, 6 * x - 4, 6 - 12 * x, 6 * x - 2]
    return values, curvatures


def clamped_mode(k):
    """Returns value and second derivative of the mode k = 0, 1, ..; growing exponentials are written from the far
    end."""
    # cos b cosh b = 1, divided by cosh b.
    guess = (k + 1.5) * np.pi
    b = brentq(lambda b: np.cos(b) - 1 / np.cosh(b), guess - 0.1, guess + 0.1, xtol=1e-15)
    r = (np.cosh(b) - np.cos(b)) / (np.sinh(b) - np.sin(b))
    # cosh - r sinh = ((1 - r) e^bx + (1 + r) e^-bx)/2.
    grows = 0.5 * (1 - r) * np.exp(b * x) if b < 30 else \
        -np.exp(b * (x - 1)) * (np.sin(b) - np.cos(b) + np.exp(-b)) / (1 - np.exp(-2 * b) - 2 * np.exp(-b) * np.sin(b))
    falls, wave = 0.5 * (1 + r) * np.exp(-b * x), np.cos(b * x) - r * np.sin(b * x)
    return grows + falls - wave, b * b * (grows + falls + wave)


def errors(boundary, modes, rigid, exact):
    """@param boundary  which of the four freedoms of the ends are kept"""
    values, curvatures = hermite()
    functions = [(values[k], curvatures[k]) for k in boundary] + [clamped_mode(k) for k in range(modes)]
    # Modes are scaled to similar size.
    functions = [(f / np.sqrt(weight @ f**2), c / np.sqrt(weight @ f**2)) for f, c in functions]
    F, C = np.array([f for f, _ in functions]), np.array([c for _, c in functions])
    omega2 = eigh((C * weight) @ C.T, (F * weight) @ F.T, eigvals_only=True)[rigid:]
    return [np.sqrt(w) / b**2 - 1 for w, b in zip(omega2, exact)]


def fill(rows):
    free = [brentq(lambda b: np.cos(b) - 1 / np.cosh(b), g - 0.1, g + 0.1, xtol=1e-15) for g in
            (np.arange(4) + 1.5) * np.pi]
    held = [brentq(lambda b: np.cos(b) + 1 / np.cosh(b), g - 0.4, g + 0.4, xtol=1e-15) for g in
            (np.arange(3) + 0.5) * np.pi]
    for name, boundary, rigid, exact, counts in (("free", (0, 1, 2, 3), 2, free, {0: 2, 1: 3, 2: 3, 4: 4, 6: 4, 8: 4}),
                                                 ("held", (2, 3), 0, held, {0: 2, 1: 3, 2: 3, 4: 3, 6: 3})):
        for k, b in enumerate(exact):
            rows.add(f"{name}.root_{k + 1}", b, 1e-11, "square root of the frequency")
        for modes, count in counts.items():
            for k, error in enumerate(errors(boundary, modes, rigid, exact)[:count]):
                rows.add(f"{name}.{modes}.error_{k + 1}", error, 1e-8, f"of {modes} modes")


if __name__ == "__main__":
    table.run(fill, __file__)
