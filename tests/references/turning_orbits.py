"""Periodic motions of rotors under gravity and out of balance, and the Floquet exponents of small motions about them.

Three rotors in a plane, by Lagrange's equations of the whole motion:

- `blades`: blades with lag hinges (springs, dampers) on a hub that turns at a given rate about a horizontal axis; the
  hub stands, or moves on springs. Gravity drives the blades once per turn.
- `unbalance`: a mass out of the axis of a rotor that turns freely in a hub on springs.

The periodic motion is found by shooting over one turn (Newton's method); the exponents are ln(multipliers)/T of the
monodromy matrix of the variational equations, whose Jacobian is a complex step. Runge-Kutta's method of order 8.
"""
import numpy as np
from scipy.integrate import solve_ivp

import table

GRAVITY = 9.81


class Blades:
    """States: displacements of the hub (if it moves), lag angles; then their rates."""
    mass, radius, inertia = 2.0, 0.4, 0.06

    def __init__(self, count, spring, damper, hub=None, rate=6.0, hinge=0.2):
        self.count, self.spring, self.damper, self.hub, self.rate, self.hinge = count, spring, damper, hub, rate, hinge
        self.size = count + (2 if hub else 0)

    def __call__(self, t, z):
        m, r, e, rate = self.mass, self.radius, self.hinge, self.rate
        q, v = z[:self.size], z[self.size:]
        first = 2 if self.hub else 0
        M, f = np.zeros((self.size, self.size), z.dtype), np.zeros(self.size, z.dtype)
        if self.hub:
            M[0, 0] = M[1, 1] = self.hub["mass"] + self.count * m
            f[:2] = -np.array(self.hub["spring"]) * q[:2] - np.array(self.hub["damper"]) * v[:2]
            f[1] -= GRAVITY * (self.hub["mass"] + self.count * m)
        for b in range(self.count):
            i, alpha = first + b, rate * t + 2 * np.pi * b / self.count
            theta, omega = alpha + q[i], rate + v[i]
            # The acceleration of the mass without lag and hub accelerations.
            inner = -e * rate**2 * np.array([np.cos(alpha), np.sin(alpha)])
            own = inner - r * omega**2 * np.array([np.cos(theta), np.sin(theta)])
            along = r * np.array([-np.sin(theta), np.cos(theta)])
            M[i, i] = self.inertia + m * r**2
            f[i] = -m * along @ inner - m * GRAVITY * along[1] - self.spring * q[i] - self.damper * v[i]
            if self.hub:
                M[i, :2] = M[:2, i] = m * along
                f[:2] -= m * own
        return np.concatenate([v, np.linalg.solve(M, f)])


class Unbalance:
    """States: displacements of the hub, angle of the rotor beyond rate t; then their rates."""
    rest, mass, radius, inertia, rate = 10.0, 1.0, 0.5, 0.3, 7.0
    springs = np.array([1000.0, 1500.0])
    size = 3

    def __call__(self, t, z):
        m, r = self.mass, self.radius
        q, v = z[:3], z[3:]
        phi, omega = self.rate * t + q[2], self.rate + v[2]
        out, along = r * np.array([np.cos(phi), np.sin(phi)]), r * np.array([-np.sin(phi), np.cos(phi)])
        M = np.zeros((3, 3), z.dtype)
        M[0, 0] = M[1, 1] = self.rest + m
        M[2, 2] = self.inertia + m * r**2
        M[2, :2] = M[:2, 2] = m * along
        f = np.concatenate([-self.springs * q[:2] + m * omega**2 * out, [0]])
        return np.concatenate([v, np.linalg.solve(M, f)])


def jacobian(system, t, z):
    step = 1e-30
    columns = []
    for k in range(len(z)):
        moved = z.astype(complex)
        moved[k] += 1j * step
        columns.append(system(t, moved).imag / step)
    return np.array(columns).T


def turn(system, z):
    """State and monodromy matrix after a turn."""
    n = len(z)

    def whole(t, y):
        state, phi = y[:n], y[n:].reshape(n, n)
        return np.concatenate([system(t, state), (jacobian(system, t, state) @ phi).ravel()])

    begin = np.concatenate([z, np.eye(n).ravel()])
    end = solve_ivp(whole, (0, 2 * np.pi / system.rate), begin, method="DOP853", rtol=1e-13, atol=1e-15).y[:, -1]
    return end[:n], end[n:].reshape(n, n)


def orbit(system):
    z = np.zeros(2 * system.size)
    for _ in range(30):
        end, phi = turn(system, z)
        step = np.linalg.lstsq(phi - np.eye(len(z)), z - end, rcond=1e-9)[0]
        z = z + step
        if np.linalg.norm(step) < 1e-13:
            break
    else:
        raise RuntimeError("no periodic motion")
    return z, turn(system, z)[1]


def exponents(system, phi):
    """Exponents with imaginary parts from 0 to half of the rate."""
    s = np.log(np.linalg.eigvals(phi).astype(complex)) * system.rate / (2 * np.pi)
    return sorted((each for each in s if each.imag >= -1e-12), key=lambda each: (each.imag, each.real))


def add(rows, name, system, meaning):
    start, phi = orbit(system)
    for k in range(system.size):
        rows.add(f"{name}.start_{k + 1}", start[k], 1e-9, f"coordinate {k + 1} at azimuth 0 of {meaning}")
        rows.add(f"{name}.rate_{k + 1}", start[system.size + k], 1e-9, "its rate")
    for k, s in enumerate(exponents(system, phi)):
        rows.add(f"{name}.real_{k + 1}", s.real, 1e-9, f"real part of exponent {k + 1} of {meaning} (1/s)")
        rows.add(f"{name}.imaginary_{k + 1}", s.imag, 1e-9, "imaginary part (modulo the rate and up to its sign)")


def fill(rows):
    add(rows, "blade", Blades(1, 60.0, 0.3), "a blade under gravity")
    add(rows, "soft_blade", Blades(1, 20.0, 0.3), "a soft blade under gravity")
    hub = {"mass": 20.0, "spring": [9000.0, 14000.0], "damper": [30.0, 50.0]}
    add(rows, "two_blades", Blades(2, 60.0, 0.3, hub), "two blades under gravity on a hub on springs")
    add(rows, "slow_blades", Blades(3, 60.0, 0.3, hub, 1.0), "three blades under gravity at 1 rad/s")
    # Twice the frequency of the blade: gravity changes its stiffness once per turn (Mathieu's equation).
    add(rows, "resonant_blade", Blades(1, 60.0, 0.01, None, 25.13, 0.0), "a blade in parametric resonance")
    system = Unbalance()
    phi = orbit(system)[1]
    oscillating = [s for s in exponents(system, phi) if s.imag > 1e-3]
    for k, s in enumerate(oscillating):
        rows.add(f"unbalance.imaginary_{k + 1}", s.imag, 1e-8, "imaginary part modulo the rate and up to its sign (1/s)")


if __name__ == "__main__":
    table.run(fill, __file__)
