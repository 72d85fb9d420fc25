"""Geometrically exact rods under dead loads at rest, by shooting.

Strains are linear (E. Reissner, J. Appl. Math. Phys. 23 (1972) 795; J. C. Simo, Comput. Methods Appl. Mech. Eng. 49
(1985) 55): with the section's rotation R, force n and moment m on it in inertial components, s the reference's length,
    x' = R (e_1 + C_n^-1 R^T n),   R' = R skew(K_0 + C_m^-1 R^T m),   m' = -x' x n,   n' = 0.
Formulas are analytic, so that derivatives by an imaginary step are exact. Arrays have one column per solution.
"""
import numpy as np
from scipy.integrate import DOP853
from scipy.optimize import brentq


def advance(rate, z, length, steps):
    """Integrates z over a length by steps of Dormand and Prince's method of order 8. @param rate  dz/ds of z"""
    h, A, B = length / steps, DOP853.A, DOP853.B
    k = np.empty((DOP853.n_stages, z.size), complex if np.iscomplexobj(z) else float)
    for _ in range(steps):
        for i in range(DOP853.n_stages):
            k[i] = rate(z + (h * (A[i, :i] @ k[:i])).reshape(z.shape)).ravel()
        z = z + (h * (B @ k)).reshape(z.shape)
    return z


def with_jacobian(function, u):
    """Returns values and derivatives of a function of columns."""
    e = 1e-40
    columns = np.asarray(u, float)[:, None] + np.hstack([np.zeros((len(u), 1)), 1j * e * np.eye(len(u))])
    values = function(columns)
    return values[:, 0].real, values[:, 1:].imag / e


def newton(function, u, size=1.0, iterations=40):
    """Returns the zero near u. @param size  size of the unknowns, one for each or one for all"""
    u = np.array(u, float)
    for _ in range(iterations):
        r, J = with_jacobian(function, u)
        step = np.linalg.solve(J, -r)
        u += step
        if np.abs(step / size).max() < 1e-9:  # the next correction would be its square
            return u
    raise ArithmeticError("Newton's method does not converge")


class Plane:
    """A rod in the plane with x, y, angle and moment along it. @param EA,GA  infinite: no such strain"""

    def __init__(self, EI, EA=np.inf, GA=np.inf):
        self.EI, self.EA, self.GA = EI, EA, GA

    def advance(self, z, force, length, curvature=0, steps=20):
        """@param force  (x, y) on the sections ahead, of the part ahead @param curvature  at rest"""
        Fx, Fy = force

        def rate(z):
            c, s = np.cos(z[2]), np.sin(z[2])
            stretch, shear = 1 + (Fx * c + Fy * s) / self.EA, (Fy * c - Fx * s) / self.GA
            x, y = stretch * c - shear * s, stretch * s + shear * c
            return np.array([x, y, curvature + z[3] / self.EI, y * Fx - x * Fy])
        return advance(rate, z, length, steps)


class Path:
    """Follows the curve r(u) = 0, which has one equation fewer than unknowns, by its arc length in units of `size`.

    Points are [u, scaled tangent, length to the next].
    """

    def __init__(self, function, size, start, towards, length, step):
        """@param towards  unknown that grows at first"""
        self.function, self.size = function, np.asarray(size, float)
        direction = np.zeros(len(self.size))
        direction[towards] = 1
        self.points = [[np.array(start, float), self.tangent(start, direction), 0]]
        gone, longest = 0, step
        while gone < length:
            last = self.points[-1]
            try:
                with np.errstate(all="ignore"):  # the step may have been too long
                    u = self.at(last, step, iterations=6)
            except ArithmeticError:
                step /= 3
                continue
            last[2] = step
            self.points.append([u, self.tangent(u, last[1]), 0])
            gone += step
            step = min(2 * step, longest)

    def at(self, point, s, iterations=20):
        """Returns the point of the curve in the plane normal to the tangent at the length s."""
        u, tangent, _ = point
        guess = u + s * tangent * self.size

        def closed(columns):
            return np.vstack([self.function(columns), (tangent / self.size) @ (columns - guess[:, None])])
        return newton(closed, guess, self.size, iterations)

    def tangent(self, u, towards):
        _, J = with_jacobian(self.function, u)
        t = np.linalg.svd(J * self.size)[2][-1]
        return t if t @ towards > 0 else -t

    def zeros(self, value):
        """Returns all points at which value(u, tangent) changes its sign."""
        found, values = [], [value(u, t) for u, t, _ in self.points]

        def at(point, s):
            u = self.at(point, s)
            return value(u, self.tangent(u, point[1]))
        for point, before, after in zip(self.points, values, values[1:]):
            if before * after < 0:
                # Rounding of the ends must not hide a zero next to them.
                reach = 1e-6 * point[2]
                s = brentq(lambda s, point=point: at(point, s), -reach, point[2] + reach, xtol=1e-14)
                found.append(self.at(point, s))
        return found


def cross(a, b):
    return np.array([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


class Space:
    """A rod in space. Its 15 rows are x, the columns of R, and the moment along it."""

    def __init__(self, GJ, EI_y, EI_z, EA=np.inf, GA_y=np.inf, GA_z=np.inf):
        self.bending = np.array([GJ, EI_y, EI_z])
        self.stretch = np.array([EA, GA_y, GA_z])

    def advance(self, z, force, length, curvature=(0, 0, 0), steps=20):
        """@param curvature  K_0 in the section's axes"""
        K_0 = np.asarray(curvature, float)[:, None]

        def rate(z):
            R, m = z[3:12].reshape(3, 3, -1), z[12:]  # R[k] is the k-th axis
            n = force + 0 * m
            along = [1 + (R[0] * n).sum(0) / self.stretch[0], (R[1] * n).sum(0) / self.stretch[1],
                     (R[2] * n).sum(0) / self.stretch[2]]
            dx = along[0] * R[0] + along[1] * R[1] + along[2] * R[2]
            K = K_0 + np.array([(R[k] * m).sum(0) / self.bending[k] for k in range(3)])
            dR = [R[1] * K[2] - R[2] * K[1], R[2] * K[0] - R[0] * K[2], R[0] * K[1] - R[1] * K[0]]
            return np.concatenate([dx, *dR, -cross(dx, n)])
        return advance(rate, z, length, steps)


def start(x, R, m):
    """Returns the start of a rod in space: position and rotation, with moments in columns."""
    m = np.asarray(m)
    columns = m.shape[1]
    head = np.concatenate([np.asarray(x, float), np.asarray(R, float).T.ravel()])
    return np.concatenate([np.repeat(head[:, None], columns, axis=1) + 0 * m[:1], m])


def turned(z, Q):
    """Rotates the state at a corner: the axes of the next rod are those of the previous one times Q."""
    R = z[3:12].reshape(3, 3, -1)
    after = [sum(Q[i, k] * R[i] for i in range(3)) for k in range(3)]
    return np.concatenate([z[:3], *after, z[12:]])


def saint_venant(width, height):
    """Returns the torsion constant of a rectangle (S. Timoshenko, J. Goodier, Theory of Elasticity, art. 109)."""
    a, b = sorted((width, height))
    series = sum(np.tanh(n * np.pi * b / (2 * a)) / n**5 for n in range(1, 400, 2))
    return b * a**3 / 3 * (1 - 192 * a / (np.pi**5 * b) * series)
