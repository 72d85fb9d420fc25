"""Critical loads out of the plane after in-plane bending: a cantilever strip and right-angle frames, by shooting.

Frames have axial and shear strain, strips do not. The equations out of the plane are linear about the bent shape; the
determinant of the conditions at the far end is zero at a critical load.
"""
import numpy as np
from scipy.optimize import brentq

import rods
import table

QUARTER = np.array([[0, 1, 0], [-1, 0, 0], [0, 0, 1]], float)  # the second leg is rotated by -90 degrees about z


def upright(angle):
    """Returns axes: the first one at an angle in the plane x-y, the third one along z."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])


class Cantilever:
    """Two legs of equal length are clamped at the root, with a dead load P (x, y) at the tip.

    The unknowns are the moments at the root; those at the tip are zero.
    """

    def __init__(self, rod, length, legs, angle, direction):
        self.rod, self.length, self.legs, self.angle = rod, length, legs, angle
        self.direction = np.array([[direction[0]], [direction[1]], [0]], float)
        # Returns the arm of the load about the root at rest, for a first guess.
        tip = length * sum(upright(angle - k * np.pi / 2)[:, 0] for k in range(legs))
        self.moment = tip[0] * direction[1] - tip[1] * direction[0]

    def end(self, P, m):
        z = rods.start([0, 0, 0], upright(self.angle), m)
        for leg in range(self.legs):
            if leg:
                z = rods.turned(z, QUARTER)
            z = self.rod.advance(z, P * self.direction, self.length, steps=12)
        return z[12:]

    def determinant(self, P):
        m = rods.newton(lambda u: self.end(P, np.vstack([0 * u, 0 * u, u]))[2:], [self.moment * P])
        _, J = rods.with_jacobian(lambda m: self.end(P, m), [0, 0, m[0]])
        return np.linalg.det(J[:2, :2])


class Hinged:
    """Two legs run from the left over the apex to the right.

    Moments M and -M about z act at the ends, which can only slide along x and rotate about z. The unknowns out of the
    plane are the force along z and the moments about x and y at the left end; z and the rotations about x and y are
    zero at the right end. The legs are arcs in the plane; by symmetry, the left leg has the angle of 45 degrees at the
    apex.
    """

    def __init__(self, rod, length, sign):
        self.rod, self.length, self.sign = rod, length, sign

    def end(self, M, u):
        zero = 0 * u[0]
        bent = self.sign * M / self.rod.bending[2] * self.length
        # The section has the load at the left end with the opposite sign.
        m = np.array([u[1], u[2], zero - self.sign * M])
        z = rods.start([0, 0, 0], upright(np.pi / 4 + bent), m)
        force = np.array([zero, zero, u[0]])
        z = self.rod.advance(z, force, self.length, steps=12)
        z = self.rod.advance(rods.turned(z, QUARTER), force, self.length, steps=12)
        R = z[3:12].reshape(3, 3, -1)
        # The load is linear in the rotations about x and y, which move the axis along z.
        return np.array([z[2] / self.length, R[2][0], R[2][1]])

    def determinant(self, M):
        r, J = rods.with_jacobian(lambda u: self.end(M, u), np.zeros(3))
        if np.abs(r).max() > 1e-12:
            raise ArithmeticError("the plane motion leaves its plane")
        return np.linalg.det(J)


def critical(model, begin, step):
    """Returns the first load at which the determinant changes its sign."""
    before = model.determinant(begin)
    while True:
        after = model.determinant(begin + step)
        if before * after < 0:
            return brentq(model.determinant, begin, begin + step, xtol=1e-13 * begin, rtol=1e-13)
        begin, before = begin + step, after


def fill(rows):
    for ratio in (1e-3, 1e-2, 0.05, 0.1):
        # L = GJ = EI_w = 1, and the load acts along -y, the stiff direction of the strip.
        strip = Cantilever(rods.Space(1, 1, 1 / ratio), 1, 1, 0, (0, -1))
        rows.add(f"strip_{ratio:g}", critical(strip, 3, 0.25), 1e-9, "P L^2/sqrt(EI_w GJ)")
    E, G = 73e9, 73e9 / 2.6
    aluminium = rods.Space(G * rods.saint_venant(0.1, 0.01), E * 0.1 * 0.01**3 / 12, E * 0.01 * 0.1**3 / 12)
    rows.add("aluminium", critical(Cantilever(aluminium, 1, 1, 0, (0, -1)), 2500, 100), 1e-5, "tip load [N]")

    E, G, a, b = 71240, 71240 / 2.62, 0.6, 30
    for name, torsion in (("saint_venant", rods.saint_venant(a, b)), ("thin", b * a**3 / 3)):
        leg = rods.Space(G * torsion, E * b * a**3 / 12, E * a * b**3 / 12, E * a * b, 5 / 6 * G * a * b,
                         5 / 6 * G * a * b)
        for direction, sign in (("away", 1), ("towards", -1)):
            frame = Cantilever(leg, 240, 2, np.pi / 2, (0, sign))
            rows.add(f"{name}.{direction}", critical(frame, 0.3, 0.05), 1e-9, "load along the first leg")
        for direction, sign in (("second_towards", -1), ("second_away", 1)):
            frame = Cantilever(leg, 240, 2, np.pi / 2, (sign, 0))
            rows.add(f"{name}.{direction}", critical(frame, 0.3, 0.05), 1e-8, "load along the second leg")
        for direction, sign in (("opening", 1), ("closing", -1)):
            rows.add(f"{name}.{direction}", critical(Hinged(leg, 240, sign), 550, 10), 1e-6, "moments at the ends")


if __name__ == "__main__":
    table.run(fill, __file__)
