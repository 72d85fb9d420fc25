"""Plane mechanisms of rigid bodies in Cartesian coordinates (x, y, angle of each centre of mass): Newton and Euler's
equations with the constraints' second derivatives, M a = F + G^T l, G a = c."""
import numpy as np
from scipy.optimize import least_squares

import motion


def turned(angle, s):
    c, d = np.cos(angle), np.sin(angle)
    return np.array([c * s[0] - d * s[1], d * s[0] + c * s[1]])


class Linkage:
    """@param gravity  along -y"""

    def __init__(self, gravity=0):
        self.gravity = gravity
        self.mass = []
        self.pins = []
        self.guides = []
        self.held = []
        self.torques = {}
        self.spring = None

    def body(self, mass, inertia):
        """Adds a body with a mass and an inertia about its centre of mass. @return its number"""
        self.mass.append((mass, mass, inertia))
        return len(self.mass) - 1

    def pin(self, first, at_first, second, at_second):
        """Makes two points coincide, each given in the axes of its body from the centre of mass. Body None is the
        ground."""
        self.pins.append((first, np.asarray(at_first, float), second, np.asarray(at_second, float)))

    def guide(self, body):
        """Keeps the centre of a body on y = 0, and its angle."""
        self.guides.append(body)

    def point(self, z, body, s):
        return s if body is None else z[3 * body:3 * body + 2] + turned(z[3 * body + 2], s)

    def gaps(self, z):
        rows = [self.point(z, a, s) - self.point(z, b, t) for a, s, b, t in self.pins]
        rows += [[z[3 * body + 1], z[3 * body + 2]] for body in self.guides]
        return np.concatenate(rows)

    def constraints(self, z, v):
        """G and c."""
        rows = 2 * (len(self.pins) + len(self.guides)) + len(self.held)
        G, c = np.zeros((rows, len(z))), np.zeros(rows)
        row = 0
        for a, s, b, t in self.pins:
            for body, point, sign in ((a, s, 1), (b, t, -1)):
                if body is None:
                    continue
                arm = turned(z[3 * body + 2], point)
                G[row:row + 2, 3 * body:3 * body + 2] += sign * np.eye(2)
                G[row:row + 2, 3 * body + 2] += sign * np.array([-arm[1], arm[0]])
                c[row:row + 2] += sign * arm * v[3 * body + 2]**2
            row += 2
        for body in self.guides:
            G[row, 3 * body + 1] = G[row + 1, 3 * body + 2] = 1
            row += 2
        for body in self.held:
            G[row, 3 * body + 2] = 1
            row += 1
        return G, c

    def forces(self, z):
        F = np.zeros(len(z))
        for k, (m, _, _) in enumerate(self.mass):
            F[3 * k + 1] -= m * self.gravity
        for body, torque in self.torques.items():
            F[3 * body + 2] += torque
        if self.spring:
            anchor, body, s, stiffness, length = self.spring
            along = self.point(z, body, s) - anchor
            pull = -stiffness * (1 - length / np.linalg.norm(along)) * along
            arm = turned(z[3 * body + 2], s)
            F[3 * body:3 * body + 2] += pull
            F[3 * body + 2] += arm[0] * pull[1] - arm[1] * pull[0]
        return F

    def solve(self, z, v):
        """Returns accelerations and multipliers."""
        M = np.diag(np.concatenate(self.mass))
        G, c = self.constraints(z, v)
        n, rows = len(z), len(c)
        system = np.block([[M, -G.T], [G, np.zeros((rows, rows))]])
        solution = np.linalg.solve(system, np.concatenate([self.forces(z), c]))
        return solution[:n], solution[n:]

    def assembled(self, guess, keep):
        """Returns positions near a guess in which all joints are closed. @param keep  numbers of coordinates that are
        not changed"""
        free = [k for k in range(len(guess)) if k not in keep]
        z = np.array(guess, float)

        def gaps(x):
            z[free] = x
            return self.gaps(z)
        for _ in range(3):
            z[free] = least_squares(gaps, z[free], xtol=1e-15, ftol=1e-15, gtol=1e-15).x
        if np.abs(self.gaps(z)).max() > 1e-13:
            raise ArithmeticError("the linkage does not close")
        return z

    def velocities(self, z, coordinate, rate):
        """Returns the rates of all coordinates for a given one."""
        G, _ = self.constraints(z, np.zeros(len(z)))
        given = np.zeros(len(z))
        given[coordinate] = 1
        return np.linalg.solve(np.vstack([G, given]), np.concatenate([np.zeros(len(G)), [rate]]))

    def move(self, z, v, times, closed=1e-10, **options):
        """Returns positions and rates at the times. The integration alone must keep the joints closed within
        `closed`."""
        n = len(z)
        states = motion.integrate(lambda _, y: np.concatenate([y[n:], self.solve(y[:n], y[n:])[0]]),
                                  np.concatenate([z, v]), times, **options)
        if max(np.abs(self.gaps(y[:n])).max() for y in states) > closed:
            raise ArithmeticError("the joints have opened")
        return states[:, :n], states[:, n:]
