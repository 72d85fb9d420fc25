"""Periodic motions of rotors under gravity and out of balance, the Floquet exponents of small motions about them, and their responses to
small harmonic forces.

Three rotors in a plane, by Lagrange's equations of the whole motion:

- `blades`: blades with lag hinges (springs, dampers) on a hub that turns at a given rate about a horizontal axis; the
  hub stands, or moves on springs. Gravity drives the blades once per turn.
- `unbalance`: a mass out of the axis of a rotor that turns freely in a hub on springs.

The periodic motion is found by shooting over one turn (Newton's method); the exponents are ln(multipliers)/T of the
monodromy matrix of the variational equations, whose Jacobian is a complex step. Runge-Kutta's method of order 8.

A force F exp(s t) moves the variational equations by p(t) exp(s t), p of the period of the rotation; the response of an output is the mean
over a turn of its part of p, divided by F.
"""
import numpy as np
from scipy.integrate import solve_ivp

import table

GRAVITY = 9.81


class Blades:
    """States are the displacements of the hub (if it moves), the lag angles, and their rates."""
    mass, radius, inertia = 2.0, 0.4, 0.06

    def __init__(self, count, spring, damper, hub=None, rate=6.0, hinge=0.2, first=1.0):
        self.count, self.spring, self.damper, self.hub, self.rate, self.hinge = count, spring, damper, hub, rate, hinge
        self.first = first  # mass of the first blade relative to the others
        self.size = count + (2 if hub else 0)

    def place(self, t, z, blade, direction):
        """Returns the derivatives of a displacement of the mass of a blade, or of the hub (-1), by the coordinates."""
        row = np.zeros(self.size, z.dtype)
        if self.hub:
            row[direction] = 1
        if blade >= 0:
            i = (2 if self.hub else 0) + blade
            theta = self.rate * t + 2 * np.pi * blade / self.count + z[i]
            row[i] = self.radius * (-np.sin(theta), np.cos(theta))[direction]
        return row

    def __call__(self, t, z):
        r, e, rate = self.radius, self.hinge, self.rate
        masses = [self.mass * (self.first if b == 0 else 1) for b in range(self.count)]
        q, v = z[:self.size], z[self.size:]
        first = 2 if self.hub else 0
        M, f = np.zeros((self.size, self.size), z.dtype), np.zeros(self.size, z.dtype)
        if self.hub:
            M[0, 0] = M[1, 1] = self.hub["mass"] + sum(masses)
            f[:2] = -np.array(self.hub["spring"]) * q[:2] - np.array(self.hub["damper"]) * v[:2]
            f[1] -= GRAVITY * (self.hub["mass"] + sum(masses))
        for b in range(self.count):
            m, i, alpha = masses[b], first + b, rate * t + 2 * np.pi * b / self.count
            theta, omega = alpha + q[i], rate + v[i]
            # This is the acceleration of the mass without accelerations of lag and hub.
            inner = -e * rate**2 * np.array([np.cos(alpha), np.sin(alpha)])
            own = inner - r * omega**2 * np.array([np.cos(theta), np.sin(theta)])
            along = r * np.array([-np.sin(theta), np.cos(theta)])
            M[i, i] = self.inertia * m / self.mass + m * r**2
            f[i] = -m * along @ inner - m * GRAVITY * along[1] - self.spring * q[i] - self.damper * v[i]
            if self.hub:
                M[i, :2] = M[:2, i] = m * along
                f[:2] -= m * own
        return np.concatenate([v, np.linalg.solve(M, f + self.force(t, z))])

    def force(self, t, z):
        """`respond` sets a small force."""
        return 0


class Unbalance:
    """States are the displacements of the hub, the angle of the rotor relative to rate t, and their rates."""
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
        return np.concatenate([v, np.linalg.solve(M, f + self.force(t, z))])

    def force(self, t, z):
        """`respond` sets a small force."""
        return 0

    def place(self, t, z, coordinate):
        return np.eye(3)[coordinate]


def jacobian(system, t, z):
    step = 1e-30
    columns = []
    for k in range(len(z)):
        moved = z.astype(complex)
        moved[k] += 1j * step
        columns.append(system(t, moved).imag / step)
    return np.array(columns).T


def turn(system, z):
    """Returns state and monodromy matrix after a turn."""
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


def respond(system, start, s, forces, outputs):
    """Returns the responses of the outputs (rows) to forces (columns). Both are rows of derivatives by the coordinates,
    as functions of t and the state."""
    n, T, tiny = len(start), 2 * np.pi / system.rate, 1e-30
    columns = n + len(forces)

    def push(t, z, forced):
        system.force = lambda t, z: 1j * tiny * forced(t, z)
        pushed = system(t, z.astype(complex)).imag / tiny
        del system.force
        return pushed

    def whole(t, y):
        z, phi = y[:n].real, y[n:n + n * columns].reshape(n, columns)
        rates = jacobian(system, t, z) @ phi - s * phi
        for k, forced in enumerate(forces):
            rates[:, n + k] += push(t, z, forced)
        seen = np.array([row(t, z) for row in outputs]) @ phi[:n // 2]
        return np.concatenate([system(t, z), rates.ravel(), seen.ravel() / T])

    begin = np.concatenate([start, np.eye(n, columns).ravel(), np.zeros(len(outputs) * columns)]).astype(complex)
    end = solve_ivp(whole, (0, T), begin, method="DOP853", rtol=1e-11, atol=1e-13).y[:, -1]
    phi, mean = end[n:n + n * columns].reshape(n, columns), end[n + n * columns:].reshape(-1, columns)
    return mean @ np.vstack([np.linalg.solve(np.eye(n) - phi[:, :n], phi[:, n:]), np.eye(len(forces))])


def add_responses(rows, name, system, forces, outputs, frequencies):
    """@param forces, outputs  rows by name"""
    start = orbit(system)[0]
    for frequency in frequencies:
        found = respond(system, start, 2j * np.pi * frequency, list(forces.values()), list(outputs.values()))
        for k, force in enumerate(forces):
            within = 1e-8 * max(abs(found[:, k]))
            for output, value in zip(outputs, found[:, k]):
                rows.add(f"{name}.{frequency}.{force}.{output}.real", value.real, within, f"displacement or rotation of {output} by a force on {force} at {frequency} Hz")
                rows.add(f"{name}.{frequency}.{force}.{output}.imaginary", value.imag, within, "its imaginary part")


def exponents(system, phi):
    """Returns the exponents with imaginary parts from 0 to half of the rate."""
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
    # The rate is twice the frequency of the blade: gravity changes the stiffness once per turn (Mathieu's equation).
    add(rows, "resonant_blade", Blades(1, 60.0, 0.01, None, 25.13, 0.0), "a blade in parametric resonance")
    for name, system in (("two_blades", Blades(2, 60.0, 0.3, hub)), ("unequal_blades", Blades(3, 60.0, 0.3, hub, first=1.3))):
        last = system.count - 1
        forces = {"hub": lambda t, z, to=system: to.place(t, z, -1, 0), "b0": lambda t, z, to=system: to.place(t, z, 0, 1)}
        outputs = {"hub": forces["hub"], "up": lambda t, z, to=system: to.place(t, z, -1, 1), f"b{last}": lambda t, z, to=system, b=last: to.place(t, z, b, 0)}
        add_responses(rows, name, system, forces, outputs, (0.4, 2.1))
    system = Unbalance()
    add_responses(rows, "unbalance", system, {"hub": lambda t, z: system.place(t, z, 0), "rotor": lambda t, z: system.place(t, z, 2)},
                  {"hub": lambda t, z: system.place(t, z, 0), "rotor": lambda t, z: system.place(t, z, 2)}, (0.5, 2.5))
    phi = orbit(system)[1]
    oscillating = [s for s in exponents(system, phi) if s.imag > 1e-3]
    for k, s in enumerate(oscillating):
        rows.add(f"unbalance.imaginary_{k + 1}", s.imag, 1e-8, "imaginary part modulo the rate and up to its sign (1/s)")


if __name__ == "__main__":
    table.run(fill, __file__)
