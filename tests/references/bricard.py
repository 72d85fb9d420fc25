"""Bricard's mechanism of the IFToMM library (A04): five rods and the ground, six hinges, one degree of freedom
although the constraints are redundant.

The rods are along edges of a cube at the start: from the origin along x, -y, z, -x, y to (0, 0, 1); the axes of the
hinges are y, z, x, y, z, x. The rods have 1 m, 1 kg and a square section of 0.1 m; gravity is 9.81 m/s^2 along -y, and
the start is at rest. The chain of five rods has the relative angles q. Five equations B qdot = 0 of rank four connect
its end with the ground. The motion along their null vector n follows from n^T (M qddot + h) = 0.
"""
import numpy as np

import motion
import table

EX, EY, EZ = np.eye(3)
AXES, RODS = [EY, EZ, EX, EY, EZ], [EX, -EY, EZ, -EX, EY]
CLOSING, PLACE = EX, np.array([0.0, 0.0, 1.0])  # axis and position of the sixth hinge
GRAVITY = np.array([0, -9.81, 0])
LENGTHWAYS, ACROSS = 0.02 / 12, 1.01 / 12       # moments of inertia of a rod about its own axis and across


def turn(axis, angle):
    """Returns a rotation about one of the coordinate axes."""
    K = motion.cross_matrix(axis)
    return np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * K @ K


class Chain:
    """Returns mass matrix, forces, closing equations and positions of the hinges of the open chain at (q, qdot)."""

    def __init__(self, q, qdot):
        R, p, omega, alpha, a = np.eye(3), np.zeros(3), np.zeros(3), np.zeros(3), np.zeros(3)
        self.M, self.h, self.energy, self.hinges = np.zeros((5, 5)), np.zeros(5), 0.0, [p]
        axes, starts = np.zeros((3, 5)), np.zeros((3, 5))
        for k in range(5):
            axes[:, k], starts[:, k] = R @ AXES[k], p
            alpha = alpha + np.cross(omega, axes[:, k] * qdot[k])
            omega = omega + axes[:, k] * qdot[k]
            R = R @ turn(AXES[k], q[k])
            rod = R @ RODS[k]
            J = R @ np.diag(np.where(np.abs(RODS[k]) > 0.5, LENGTHWAYS, ACROSS)) @ R.T
            W = axes * (np.arange(5) <= k)
            V = np.cross(W.T, (p + 0.5 * rod - starts.T)).T
            a_centre = a + np.cross(alpha, 0.5 * rod) + np.cross(omega, np.cross(omega, 0.5 * rod))
            self.M += V.T @ V + W.T @ J @ W
            self.h += V.T @ (a_centre - GRAVITY) + W.T @ (J @ alpha + np.cross(omega, J @ omega))
            v = V @ qdot
            self.energy += 0.5 * (v @ v + omega @ J @ omega) - GRAVITY @ (p + 0.5 * rod)
            a = a + np.cross(alpha, rod) + np.cross(omega, np.cross(omega, rod))
            p = p + rod
            self.hinges.append(p)
        axis = R @ CLOSING
        axis_rate = np.cross(axes.T, axis).T
        axis_bias = np.cross(alpha, axis) + np.cross(omega, np.cross(omega, axis))
        self.gap = np.concatenate([p - PLACE, axis[1:]])
        self.B = np.vstack([np.cross(axes.T, p - starts.T).T, axis_rate[1:]])
        self.bias = np.concatenate([a, axis_bias[1:]])

    def acceleration(self):
        U, s, Vt = np.linalg.svd(self.B)
        if s[3] < 1e-3 * s[0]:
            raise ArithmeticError("a position with more than one degree of freedom")
        particular = -Vt[:4].T @ ((U[:, :4].T @ self.bias) / s[:4])
        n = Vt[4]
        return particular - n * (n @ (self.M @ particular + self.h)) / (n @ self.M @ n)


def fill(rows):
    def rate(_, z):
        return np.concatenate([z[5:], Chain(z[:5], z[5:]).acceleration()])

    times = [1.0, 4.0, 9.0]
    states = motion.integrate(rate, np.zeros(10), times, agree=1e-7, rtol=1e-12, atol=1e-13)
    start = Chain(np.zeros(5), np.zeros(5)).energy
    for t, z in zip(times, states):
        chain = Chain(z[:5], z[5:])
        if np.abs(chain.gap).max() > 1e-8 or abs(chain.energy - start) > 1e-8:
            raise ArithmeticError(f"at {t} s the chain is open by {np.abs(chain.gap).max():g}, its energy wrong by "
                                  f"{chain.energy - start:g} J")
        rows.add_vector(f"{t:g}.place", chain.hinges[3], 1e-7, f"hinge of rods 3 and 4 at {t:g} s [m]")
    rows.add("energy", start, 1e-12, "potential energy at the start [J]")


if __name__ == "__main__":
    table.run(fill, __file__)
