"""Moving geometrically exact rods, by one spectral element with nodes and quadrature of Gauss and Lobatto.

With the section's rotation R, the strains are Gamma = R^T x' - e_1 and K = axial(R^T R'), and n = R C_n Gamma, m = R
C_m K. The equations mass x'' = n' + load, d/dt (R J Omega) = m' + x' x n + load are multiplied by the nodes'
polynomials and integrated by parts. Errors decrease exponentially with the number of nodes.
"""
import numpy as np
from scipy.linalg import lu_factor, lu_solve


class Element:
    """Returns nodes s from 0 to a length, their weights, and the matrix D, which maps values at the nodes to
    derivatives there."""

    def __init__(self, length, nodes):
        p = np.polynomial.legendre.Legendre.basis(nodes - 1)
        x = np.concatenate([[-1], np.sort(p.deriv().roots().real), [1]])
        self.s = 0.5 * length * (x + 1)
        self.weight = length / (nodes * (nodes - 1)) / p(x)**2
        difference = x[:, None] - x[None, :] + np.eye(nodes)
        with np.errstate(all="ignore"):
            D = p(x)[:, None] / p(x)[None, :] / difference
        D[np.diag_indices(nodes)] = 0
        D[0, 0], D[-1, -1] = -nodes * (nodes - 1) / 4, nodes * (nodes - 1) / 4
        self.D = 2 / length * D
        self.back = -self.D.T * self.weight  # from the integration by parts

    def value(self, f, s):
        """Returns the value at a place of the polynomial with given values at the nodes."""
        near = s - self.s
        if np.abs(near).min() < 1e-14:
            return f[np.abs(near).argmin()]
        w = np.array([1 / np.prod(np.delete(self.s[k] - self.s, k) / (self.s[-1] / 4)) for k in range(len(self.s))])
        return (w / near) @ f / (w / near).sum()


class PlaneRod:
    """Rows x, y, angle, with columns of nodes.

    @param J  mass moment per length about the normal of the plane
    """

    def __init__(self, length, nodes, EA, GA, EI, mass, J):
        self.element = Element(length, nodes)
        self.EA, self.GA, self.EI = EA, GA, EI
        self.mass = np.outer([mass, mass, J], self.element.weight)

    def straight(self, origin=(0, 0), angle=0):
        s = self.element.s
        return np.array([origin[0] + s * np.cos(angle), origin[1] + s * np.sin(angle), angle + 0 * s])

    def forces(self, q):
        """Returns the forces on the nodes. More axes may precede the last two."""
        d = q @ self.element.D.T
        c, s = np.cos(q[..., 2, :]), np.sin(q[..., 2, :])
        x, y = d[..., 0, :], d[..., 1, :]
        N, Q = self.EA * (c * x + s * y - 1), self.GA * (c * y - s * x)
        n_x, n_y = c * N - s * Q, s * N + c * Q
        inner = np.stack([n_x, n_y, self.EI * d[..., 2, :]], axis=-2)
        F = inner @ self.element.back.T
        F[..., 2, :] += self.element.weight * (x * n_y - y * n_x)
        return F

    def energy(self, q, v):
        d = q @ self.element.D.T
        c, s = np.cos(q[2]), np.sin(q[2])
        strain = self.EA * (c * d[0] + s * d[1] - 1)**2 + self.GA * (c * d[1] - s * d[0])**2 + self.EI * d[2]**2
        return 0.5 * (self.element.weight @ strain + (self.mass * v**2).sum())


class SpaceRod:
    """Rod in space. States contain x (3 rows), R (9, by rows), v (3) and Omega (3, in the section's axes)."""

    def __init__(self, length, nodes, EA, GA, GJ, EI, mass, J):
        self.element = Element(length, nodes)
        self.stretch, self.bending = np.array([EA, GA, GA])[:, None], np.array([GJ, EI, EI])[:, None]
        self.mass, self.J = mass, np.asarray(J, float)[:, None]

    def straight(self, origin, R):
        n = len(self.element.s)
        z = np.zeros((18, n))
        z[:3] = np.asarray(origin)[:, None] + np.outer(R[:, 0], self.element.s)
        z[3:12] = R.reshape(9, 1)
        return z

    def strains(self, z):
        d = z[:12] @ self.element.D.T
        R, dR = z[3:12].reshape(3, 3, -1), d[3:].reshape(3, 3, -1)
        Gamma = np.einsum("ijn,in->jn", R, d[:3])
        Gamma[0] -= 1
        K = np.array([(R[:, 2] * dR[:, 1]).sum(0), (R[:, 0] * dR[:, 2]).sum(0), (R[:, 1] * dR[:, 0]).sum(0)])
        return d[:3], R, Gamma, K

    def rate(self, z, load, moment):
        """@param load,moment  at the first node, inertial"""
        dx, R, Gamma, K = self.strains(z)
        n = np.einsum("ijn,jn->in", R, self.stretch * Gamma)
        m = np.einsum("ijn,jn->in", R, self.bending * K)
        w = self.element.weight
        F, M = n @ self.element.back.T, m @ self.element.back.T + w * np.cross(dx, n, axis=0)
        F[:, 0] += load
        M[:, 0] += moment
        v, Omega = z[12:15], z[15:]
        # d/dt (R J Omega) = R (J Omegadot + Omega x J Omega).
        own = np.einsum("ijn,in->jn", R, M) / w
        Omegadot = (own - np.cross(Omega, self.J * Omega, axis=0)) / self.J
        Rdot = np.stack([R[:, 1] * Omega[2] - R[:, 2] * Omega[1], R[:, 2] * Omega[0] - R[:, 0] * Omega[2],
                         R[:, 0] * Omega[1] - R[:, 1] * Omega[0]], axis=1)
        return np.concatenate([v, Rdot.reshape(9, -1), F / (self.mass * w), Omegadot])

    def energy(self, z):
        _, _, Gamma, K = self.strains(z)
        return 0.5 * (self.element.weight * (self.stretch * Gamma**2 + self.bending * K**2
                                             + self.J * z[15:]**2 + self.mass * z[12:15]**2)).sum()


class Gauss:
    """Integrates q'' = a(t, q, q') by Gauss' collocation with three stages, which has order 6 and is stable for
    components of any frequency that are not excited."""

    r = np.sqrt(15)
    c = np.array([0.5 - r / 10, 0.5, 0.5 + r / 10])
    b = np.array([5 / 18, 4 / 9, 5 / 18])
    A = np.array([[5 / 36, 2 / 9 - r / 15, 5 / 36 - r / 30], [5 / 36 + r / 24, 2 / 9, 5 / 36 - r / 24],
                  [5 / 36 + r / 30, 2 / 9 + r / 15, 5 / 36]])

    def __init__(self, acceleration, h, tolerance):
        """@param acceleration  function of (times, rows of q, rows of v) @param tolerance  absolute, for accelerations"""
        self.a, self.h, self.tolerance, self.factor = acceleration, h, tolerance, None
        self.AA = self.A @ self.A
        self.stages = None

    def renew(self, t, q, v):
        e, n = 1e-30, len(q)
        unit, rows = 1j * e * np.eye(n), np.full(n, t)
        J = self.a(rows, q + unit, v + 0 * unit).imag.T / e
        C = self.a(rows, q + 0 * unit, v + unit).imag.T / e
        self.factor = lu_factor(np.eye(3 * n) - self.h**2 * np.kron(self.AA, J) - self.h * np.kron(self.A, C))

    def step(self, t, q, v):
        h, times = self.h, t + self.h * self.c
        a = np.zeros((3, len(q))) if self.stages is None else self.stages.copy()
        renewed, before = self.factor is None, np.inf
        if renewed:
            self.renew(t, q, v)
        for iteration in range(40):
            r = self.a(times, q + h * np.outer(self.c, v) + h * h * self.AA @ a, v + h * self.A @ a) - a
            step = lu_solve(self.factor, r.ravel()).reshape(a.shape)
            a += step
            change = np.abs(step).max()
            # Rounding of the forces ends the convergence.
            if change < self.tolerance or (before < 1e3 * self.tolerance and change > 0.3 * before):
                break
            if iteration > 2 and change > 0.1 * before and not renewed:
                self.renew(t, q, v)
                renewed, change = True, np.inf
            before = change
        else:
            raise ArithmeticError(f"a step at t = {t:g} does not converge: {change:g}")
        self.stages = a
        return q + h * v + h * h * (self.b @ self.A) @ a, v + h * self.b @ a
