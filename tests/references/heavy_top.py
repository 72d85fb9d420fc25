"""The heavy top of O. Bruls, A. Cardona, M. Arnold, Mech. Mach. Theory 48 (2012) 121, by Euler and Poinsot's equations.

The top has 15 kg, its centre 1 m from the pivot along its y axis, J = diag(0.234375, 0.46875, 0.234375) kg m^2 about
the centre, and Omega(0) = (0, 150, -4.61538) rad/s; gravity is 9.81 m/s^2 along -z. DOP853 integrates with quaternions.
"""
import numpy as np

import motion
import table

m, g = 15, 9.81
arm = np.array([0, 1, 0])
J = np.diag([0.234375 + m, 0.46875, 0.234375 + m])  # about the pivot


def acceleration(q, Omega):
    weight = motion.rotation(q).T @ [0, 0, -m * g]
    return np.linalg.solve(J, np.cross(arm, weight) - np.cross(Omega, J @ Omega))


def rate(_, z):
    q, Omega = z[:4], z[4:]
    return np.concatenate([motion.quaternion_rate(q, Omega), acceleration(q, Omega)])


def energy(z):
    return 0.5 * z[4:] @ J @ z[4:] + m * g * (motion.rotation(z[:4]) @ arm)[2]


def fill(rows):
    start = np.array([1, 0, 0, 0, 0, 150, -4.61538])
    rows.add("energy", energy(start), 1e-10, "kinetic energy and height at the start [J]")
    times = [0.1, 0.5, 1, 1.5, 2]
    for time, z in zip(times, motion.integrate(rate, start, times)):
        if abs(energy(z) / energy(start) - 1) > 1e-11:
            raise ArithmeticError("the top does not keep its energy")
        q, Omega = z[:4], z[4:]
        R = motion.rotation(q)
        rows.add_vector(f"{time}.centre", R @ arm, 1e-9, f"centre at {time} s [m]")
        rows.add_vector(f"{time}.Omega", Omega, 1e-8, f"angular velocity in the body's axes at {time} s [rad/s]")
        if time not in (1, 2):
            continue
        a = R @ (np.cross(acceleration(q, Omega), arm) + np.cross(Omega, np.cross(Omega, arm)))
        rows.add_vector(f"{time}.force", m * (a + [0, 0, g]), 2e-6, f"force of the pivot on the top at {time} s [N]")


if __name__ == "__main__":
    table.run(fill, __file__)
