"""Coefficients of the exponential of rotations, of its tangent, and of their derivatives, from closed forms.

With x = phi^2: a1 = sin(phi)/phi, a2 = (1 - cos phi)/x, a3 = (phi - sin phi)/phi^3, c1 = 2 da2/dx, c2 = 2 da3/dx,
d1 = 2 dc1/dx, d2 = 2 dc2/dx, b = (1 - phi/2 cot(phi/2))/x, bp = 2 db/dx, bpp = 2 dbp/dx. 2 d/dx = d/dphi / phi. Small
angles cancel digits by 1/phi to the 7th power, so that the computation has 250 digits.
"""
import mpmath
from mpmath import mpf

import table

NAMES = ["a1", "a2", "a3", "c1", "c2", "d1", "d2", "b", "bp", "bpp"]
ANGLES = ["1e-12", "1e-8", "1e-4", "1e-3", "0.1", "0.5", "1", "1.5", "2", "2.5", "2.9999", "3.0001",
          "3.14159265358979", "3.5", "4", "5", "6", "6.2", "7"]


def coefficients(phi):
    x, sin, cos = phi * phi, mpmath.sin(phi), mpmath.cos(phi)
    a1, a2, a3 = sin / phi, (1 - cos) / x, (phi - sin) / phi**3
    # These are d/dphi of a2 and a3 over phi, and the same again.
    c1 = (phi * sin - 2 * (1 - cos)) / phi**4
    c2 = (phi * (1 - cos) - 3 * (phi - sin)) / phi**5
    d1 = (phi * (phi * cos - sin) - 4 * (phi * sin - 2 * (1 - cos))) / phi**6
    d2 = (phi * (1 - cos + phi * sin - 3 * (1 - cos)) - 5 * (phi * (1 - cos) - 3 * (phi - sin))) / phi**7
    half = phi / 2
    # g = phi/2 cot(phi/2) and its derivatives by phi.
    cot = mpmath.cos(half) / mpmath.sin(half)
    csc2 = 1 / mpmath.sin(half)**2
    g, g1 = half * cot, cot / 2 - half * csc2 / 2
    g2 = -csc2 / 2 + half * csc2 * cot / 2
    b = (1 - g) / x
    bp = (-g1 * phi - 2 * (1 - g)) / phi**4
    # d/dphi of the numerator is -g2 phi - g1 + 2 g1.
    bpp = ((-g2 * phi + g1) * phi - 4 * (-g1 * phi - 2 * (1 - g))) / phi**6
    return [a1, a2, a3, c1, c2, d1, d2, b, bp, bpp]


def fill(rows):
    mpmath.mp.dps = 250
    for angle in ANGLES:
        # The angle is rounded to a double, as in the test.
        phi = mpf(float(angle))
        values = coefficients(phi)
        # The derivatives are compared with differences of the functions, which 250 digits allow.
        e = mpf(10)**-60
        before, after = coefficients(phi - e * phi), coefficients(phi + e * phi)
        for k, (of, is_) in enumerate(((1, 3), (2, 4), (3, 5), (4, 6), (7, 8), (8, 9))):
            slope = (after[of] - before[of]) / (2 * e * phi) / phi
            if abs(slope - values[is_]) > mpf(10)**-25 * (1 + abs(values[is_])):
                raise ArithmeticError(f"{NAMES[is_]} is not the derivative of {NAMES[of]} at {angle}")
        for name, value in zip(NAMES, values):
            rows.add(f"{angle}.{name}", value, 1e-15 * max(abs(float(value)), 0.02), "")


if __name__ == "__main__":
    table.run(fill, __file__)
