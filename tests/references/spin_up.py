"""Flexible arms that are spun up about their roots: deflection of the tip relative to the line of the root.

J. Simo, L. Vu-Quoc, J. Appl. Mech. 53 (1986) 855; S.-C. Wu, E. Haug, Int. J. Numer. Methods Eng. 26 (1988) 2211. The
root rotates by psi = Om/Ts (t^2/2 + (Ts/2 pi)^2 (cos(2 pi t/Ts) - 1)) up to Ts = 15 s, then at the rate Om. One model
is a geometrically exact rod by a spectral element in axes that rotate with the root, with Gauss' collocation in time.
The other one is the linear beam with the tension m Om^2 (L^2 - x^2)/2 of rotation, by Ritz's method.
"""
import numpy as np
from numpy.polynomial import Legendre, Polynomial
from scipy.interpolate import BarycentricInterpolator

import dynamic_rods
import table

Ts = 15


class Arm:
    def __init__(self, L, EA, GA, EI, m, J, Om, nodes=12):
        self.L, self.Om = L, Om
        self.rod = dynamic_rods.PlaneRod(L, nodes, EA, GA, EI, m, J)
        self.rest = self.rod.straight()
        self.extension = np.tan(np.sqrt(m / EA) * Om * L) / (np.sqrt(m / EA) * Om) - L

    def turn(self, t):
        """Returns rate and acceleration of the root."""
        w = 2 * np.pi / Ts
        return (self.Om / Ts * np.where(t < Ts, t - np.sin(w * t) / w, Ts),
                self.Om / Ts * np.where(t < Ts, 1 - np.cos(w * t), 0))

    def full(self, free):
        """Returns all nodes: the first one is fixed in the axes of the root."""
        q = np.zeros((len(free), *self.rest.shape), free.dtype)
        q[..., 1:] = free.reshape(len(free), 3, -1)
        return q

    def acceleration(self, t, free, rates):
        """Returns accelerations relative to the rotating axes."""
        a = (self.rod.forces(self.full(free)) / self.rod.mass)[..., 1:]
        q, v = free.reshape(a.shape), rates.reshape(a.shape)
        w, wdot = (f[:, None] for f in self.turn(t))
        a[:, 0] += 2 * w * v[:, 1] + w * w * q[:, 0] + wdot * q[:, 1]
        a[:, 1] += -2 * w * v[:, 0] + w * w * q[:, 1] - wdot * q[:, 0]
        a[:, 2] -= wdot
        return a.reshape(free.shape)

    def run(self, end, h=0.01):
        """Returns the deflections of the tip at the ends of steps."""
        solver = dynamic_rods.Gauss(self.acceleration, h, 1e-8)
        q = self.rest[:, 1:].ravel()
        v = 0 * q
        times, across = [0.0], [0.0]
        for k in range(round(end / h)):
            q, v = solver.step(k * h, q, v)
            times.append((k + 1) * h)
            across.append(q.reshape(3, -1)[1, -1])
        return np.array(times), np.array(across)


def linear(arm, end, h=0.01, count=8):
    """Returns the deflections of the tip of the linear beam with tension at the ends of steps."""
    x, weight = np.polynomial.legendre.leggauss(40)
    x, weight = 0.5 * arm.L * (x + 1), 0.5 * arm.L * weight
    clamped = Polynomial([0, 0, 1 / arm.L**2])
    basis = [clamped * Legendre.basis(k, domain=[0, arm.L]).convert(kind=Polynomial) for k in range(count)]
    w, slope, curvature = (np.array([f.deriv(order)(x) if order else f(x) for f in basis]) for order in (0, 1, 2))
    m, EI = arm.rod.mass[0].sum() / arm.L, arm.rod.EI
    M = m * (w * weight) @ w.T
    K = EI * (curvature * weight) @ curvature.T
    # This is the stiffness per squared rate, from the tension and from the centrifugal force on the deflection.
    G = m * (slope * weight * (arm.L**2 - x**2) / 2) @ slope.T - M
    inverse, pushed = np.linalg.inv(M), m * w @ (weight * x)

    def acceleration(t, q, _):
        rate, change = arm.turn(t)
        return -(q @ K + rate[:, None]**2 * (q @ G) + np.outer(change, pushed)) @ inverse
    solver = dynamic_rods.Gauss(acceleration, h, 1e-8)
    q, v = np.zeros(count), np.zeros(count)
    tip = np.array([f(arm.L) for f in basis])
    found = [0.0]
    for k in range(round(end / h)):
        q, v = solver.step(k * h, q, v)
        found.append(tip @ q)
    return h * np.arange(len(found)), np.array(found)


def lowest(times, values):
    """The minimum is that of a polynomial through eleven points around the lowest one."""
    k = values.argmin()
    near = slice(k - 5, k + 6)
    fine = np.linspace(times[k - 1], times[k + 1], 20001)
    curve = BarycentricInterpolator(times[near], values[near])(fine)
    return curve.min(), fine[curve.argmin()]


def fill(rows):
    for name, arm in (("simo_vu_quoc", (10, 2.8e7, 1e7, 1.4e4, 1.2, 6e-4, 6)),
                      ("wu_haug", (8, 5.03132e6, 2e6, 566.7, 0.201878, 566.7 / 5.03132e6 * 0.201878, 4))):
        model = Arm(*arm)
        times, across = model.run(20)
        least, when = lowest(times, across)
        rows.add(f"{name}.least", least, 1e-7, "largest deflection [m]")
        rows.add(f"{name}.time", when, 1e-3, "when it is reached [s]")
        rows.add(f"{name}.linear_least", lowest(*linear(model, 8))[0], 1e-6, "of the linear beam with tension [m]")
        for t in (5, 10):
            rows.add(f"{name}.at_{t}", across[round(t / 0.01)], 1e-7, f"deflection at {t} s [m]")
        rows.add(f"{name}.swing", np.abs(across[times > Ts]).max(), 2e-5, "largest deflection of the steady turn [m]")
        rows.add(f"{name}.extension", model.extension, 1e-12, "tan(k L)/k - L with k^2 = m Om^2/EA [m]")


if __name__ == "__main__":
    table.run(fill, __file__)
