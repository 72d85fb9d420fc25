"""A thin disk that rolls on a plane: 1 kg, radius 0.5 m, 110 degrees of lean, 4 rad/s about its own axis.

The equations are Newton's and Euler's in inertial axes. Rolling, v = omega x a u, eliminates the contact force; u
points from the contact to the centre. The centre is integrated as well.
"""
import numpy as np

import motion
import table

m, a, g = 1, 0.5, 9.81
J = np.diag([m * a * a / 4, m * a * a / 4, m * a * a / 2])
up = np.array([0, 0, 1])


def rim(R):
    """Returns u, and du/dt as a function of the axis's rate."""
    n = R[:, 2]
    p = up - n[2] * n
    length = np.linalg.norm(p)
    u = p / length

    def rate(ndot):
        pdot = -ndot[2] * n - n[2] * ndot
        return (pdot - (u @ pdot) * u) / length
    return u, rate


def forces(q, Omega):
    """Returns the force of the plane on the disk, and the angular acceleration in its axes."""
    R = motion.rotation(q)
    omega = R @ Omega
    u, u_rate = rim(R)
    udot = u_rate(np.cross(omega, R[:, 2]))
    # vdot = omegadot x a u + omega x a udot; F = m (vdot + g up); I omegadot + omega x I omega = -a u x F.
    I, U = R @ J @ R.T, motion.cross_matrix(a * u)
    known = m * (np.cross(omega, a * udot) + g * up)
    omegadot = np.linalg.solve(I - m * U @ U, -np.cross(omega, I @ omega) - U @ known)
    return known - m * U @ omegadot, R.T @ omegadot


def rate(_, z):
    q, Omega = z[:4], z[4:7]
    R = motion.rotation(q)
    u, _ = rim(R)
    return np.concatenate([motion.quaternion_rate(q, Omega), forces(q, Omega)[1], np.cross(R @ Omega, a * u)])


def energy(z):
    R, Omega = motion.rotation(z[:4]), z[4:7]
    u, _ = rim(R)
    v = np.cross(R @ Omega, a * u)
    return 0.5 * m * v @ v + 0.5 * Omega @ J @ Omega + m * g * a * u[2]


def fill(rows):
    lean = np.radians(110)
    q = np.array([np.cos(lean / 2), np.sin(lean / 2), 0, 0])
    u, _ = rim(motion.rotation(q))
    start = np.concatenate([q, [0, 0, 4], a * u])
    end = motion.integrate(rate, start, [1])[0]
    if abs(energy(end) / energy(start) - 1) > 1e-11:
        raise ArithmeticError("the disk does not keep its energy")
    rows.add_vector("centre", end[7:], 1e-9, "centre at 1 s [m]")
    rows.add_vector("axis", motion.rotation(end[:4])[:, 2], 1e-9, "axis at 1 s")
    rows.add_vector("force", forces(end[:4], end[4:7])[0], 1e-7, "force of the plane at 1 s [N]")
    rows.add("energy", energy(start), 1e-11, "kinetic energy and height [J]")


if __name__ == "__main__":
    table.run(fill, __file__)
