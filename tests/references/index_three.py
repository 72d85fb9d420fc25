"""Errors of integrators of index 3 on a pendulum and on the heavy top, without corrected start values.

Generalised-alpha on a Lie group (M. Arnold, O. Bruls, Multibody Sys. Dyn. 18 (2007) 185) with A_0 = a_0: q + h v +
h^2 ((1/2 - beta) A_0 + beta A), v + h ((1 - gamma) A_0 + gamma A), (1 - alpha_m) A + alpha_m A_0 = (1 - alpha_f) a +
alpha_f a_0, M a = f - B^T lambda, constraints at the end of the step. References: the closed form of the pendulum,
Euler and Poinsot's equations of the top.
"""
import mpmath
import numpy as np

import heavy_top
import motion
import rods
import table


class Scheme:
    def __init__(self, alpha_m, alpha_f, beta=None):
        self.alpha_m, self.alpha_f = alpha_m, alpha_f
        self.gamma = 0.5 + alpha_f - alpha_m
        self.beta = 0.25 * (0.5 + self.gamma)**2

    @staticmethod
    def chung_hulbert(rho):
        return Scheme((2 * rho - 1) / (rho + 1), rho / (rho + 1))


NEWMARK = Scheme(0, 0)
HHT = Scheme(0, 0.1 / 1.9)


class Integrator:
    """@param system  has `moved(q, d)`, `accelerations(q, v, multipliers)`, `gap(q)`, `size` of velocities, `rows`"""

    def __init__(self, system, scheme, h, q, v, a):
        self.system, self.scheme, self.h = system, scheme, h
        self.q, self.v, self.a, self.A = q, v, a, a.copy()
        self.multipliers = np.zeros(system.rows)

    def end(self, u):
        """All at the end of a step, of accelerations and multipliers in columns."""
        h, s, n = self.h, self.scheme, self.system.size
        a, multipliers = u[:n], u[n:]
        A = ((1 - s.alpha_f) * a + (s.alpha_f * self.a - s.alpha_m * self.A)[:, None]) / (1 - s.alpha_m)
        d = h * self.v[:, None] + h * h * ((0.5 - s.beta) * self.A[:, None] + s.beta * A)
        v = self.v[:, None] + h * ((1 - s.gamma) * self.A[:, None] + s.gamma * A)
        return self.system.moved(self.q, d), v, a, A, multipliers

    def step(self):
        system, h = self.system, self.h
        # Units of which Newton's steps are parts: of accelerations, and of forces.
        u = np.concatenate([self.a, self.multipliers])

        def residual(u):
            q, v, a, _, multipliers = self.end(u)
            return np.vstack([a - system.accelerations(q, v, multipliers), system.gap(q) / (h * h)])
        u = rods.newton(residual, u, system.units)
        q, v, a, A, multipliers = (f[..., 0] for f in self.end(u[:, None]))
        self.q, self.v, self.a, self.A, self.multipliers = q, v, a, A, multipliers


class Pendulum:
    """1 kg at 1 m, gravity 9.81 m/s^2, constraint (x^2 + y^2 - 1)/2."""
    size, rows, units = 2, 1, 10.0

    def moved(self, q, d):
        return q[:, None] + d

    def accelerations(self, q, v, multipliers):
        return np.array([-multipliers[0] * q[0], -9.81 - multipliers[0] * q[1]])

    def gap(self, q):
        return 0.5 * (q[:1]**2 + q[1:]**2 - 1)


def pendulum_errors(scheme, h):
    """Errors of place, velocity and tension at 1 s, released from (1, 0)."""
    run = Integrator(Pendulum(), scheme, h, np.array([1.0, 0]), np.zeros(2), np.array([0, -9.81]))
    for _ in range(round(1 / h)):
        run.step()
    K = mpmath.ellipk(0.5)
    half = mpmath.sqrt(0.5) * mpmath.ellipfun("sn", K - mpmath.sqrt(9.81), m=0.5)
    angle = float(2 * mpmath.asin(half))
    x, y = np.sin(angle), -np.cos(angle)
    speed = np.sqrt(-2 * 9.81 * y)
    v = speed * np.array([y, -x])  # on its first way to the other side
    return (np.hypot(run.q[0] - x, run.q[1] - y), np.linalg.norm(run.v - v), abs(run.multipliers[0] + 3 * 9.81 * y))


class Top:
    """Returns centre and rotation (12 numbers) of the top, whose tip stays at the origin."""
    size, rows, units = 6, 3, 1e3
    m, J = 15, np.array([0.234375, 0.46875, 0.234375])[:, None]
    arm = np.array([0, 1, 0])

    def moved(self, q, d):
        x, R = q[:3, None] + d[:3], q[3:].reshape(3, 3)
        # Uses Rodrigues' formula, since the angle of a step is neither zero nor large.
        p = d[3:]
        angle = np.sqrt((p * p).sum(0))
        S = np.array([[0 * p[0], -p[2], p[1]], [p[2], 0 * p[0], -p[0]], [-p[1], p[0], 0 * p[0]]])
        turn = np.eye(3)[:, :, None] + np.sin(angle) / angle * S \
            + (1 - np.cos(angle)) / angle**2 * np.einsum("ijn,jkn->ikn", S, S)
        return np.concatenate([x, np.einsum("ij,jkn->ikn", R, turn).reshape(9, -1)])

    def gap(self, q):
        return q[:3] - q[3:].reshape(3, 3, -1)[:, 1]

    def accelerations(self, q, v, multipliers):
        """The pivot applies the force -multipliers to the tip."""
        R = q[3:].reshape(3, 3, -1)
        force = -multipliers
        own = np.einsum("ijn,in->jn", R, force)
        arm = np.zeros_like(own)
        arm[1] = -1  # position of the tip relative to the centre
        Omega = v[3:]
        spin = (np.cross(arm, own, axis=0) - np.cross(Omega, self.J * Omega, axis=0)) / self.J
        return np.concatenate([force / self.m - np.array([[0], [0], [9.81]]), spin])


def top_run(scheme, h, end):
    """Returns errors of x, v, Omega and the multipliers, one row per step, without the start."""
    start = np.array([1, 0, 0, 0, 0, 150, -4.61538])
    steps = round(end / h)
    exact = motion.integrate(heavy_top.rate, start, h * np.arange(1, steps + 1), rtol=1e-12, agree=1e-8)

    def at(z):
        R, Omega = motion.rotation(z[:4]), z[4:]
        O_dot, arm = heavy_top.acceleration(z[:4], Omega), Top.arm
        a = R @ (np.cross(O_dot, arm) + np.cross(Omega, np.cross(Omega, arm)))
        return R @ arm, R @ np.cross(Omega, arm), Omega, -15 * (a + [0, 0, 9.81]), np.concatenate([a, O_dot])
    x, v, Omega, force, a = at(start)
    run = Integrator(Top(), scheme, h, np.concatenate([x, np.eye(3).ravel()]), np.concatenate([v, Omega]), a)
    run.multipliers = force
    errors = []
    for z in exact:
        run.step()
        x, v, Omega, force, _ = at(z)
        errors.append([np.linalg.norm(run.q[:3] - x), np.linalg.norm(run.v[:3] - v), np.linalg.norm(run.v[3:] - Omega),
                       np.linalg.norm(run.multipliers - force)])
    return np.array(errors)


def share(error, part):
    """Returns a part of an error, rounded to one digit."""
    return float(f"{error * part:.0e}")


def fill(rows):
    mpmath.mp.dps = 30
    schemes = {"newmark": NEWMARK, "hht": HHT} | {f"rho_{rho}": Scheme.chung_hulbert(rho) for rho in (0.9, 0.8, 0.5)}
    for name, scheme in schemes.items():
        for h in (0.01, 0.0025):
            for what, error in zip(("q", "v", "lambda"), pendulum_errors(scheme, h)):
                # Newmark's multipliers contain the remainder of Newton's method.
                loose = name == "newmark" and what == "lambda"
                rows.add(f"pendulum.{name}.{h}.{what}", error, share(error, 2e-3 if loose else 5e-6), "error at 1 s")
    for name, h in (("rho_0.9", 1e-3), ("rho_0.9", 5e-4), ("rho_0.9", 2.5e-4), ("rho_0.8", 1e-3), ("hht", 1e-3)):
        errors = top_run(schemes[name], h, 1)
        for what, error in zip(("x", "Omega", "lambda"), errors[-1, [0, 2, 3]]):
            rows.add(f"top.{name}.{h}.{what}", error, share(error, 2e-5), "error at 1 s")
        if name == "rho_0.8":
            for what, error in (("x", errors[:, 0]), ("v", np.hypot(errors[:, 1], errors[:, 2])),
                                ("lambda", errors[:, 3])):
                largest = error.max()
                rows.add(f"top.{name}.{h}.largest_{what}", largest, share(largest, 2e-5), "largest within 1 s")
    for h in (1e-3, 5e-4, 2.5e-4):
        largest = top_run(schemes["rho_0.9"], h, 0.1)[:, 3].max()
        rows.add(f"top.transient.{h}", largest, share(largest, 2e-5), "of the multipliers within 0.1 s")


if __name__ == "__main__":
    table.run(fill, __file__)
