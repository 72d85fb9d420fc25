"""The spatial rigid slider-crank of the IFToMM library, whose only coordinate is the angle th of the crank.

The crank has 0.08 m and 0.12 kg and rotates about x at A = (0, 0.1, 0.12) m. The rod has 0.3 m and 0.5 kg, a spherical
joint at the crank and a universal joint at the slider, whose arms are x and x cross rod. The slider of 2 kg moves along
x; gravity is along -z. The motion starts from th = 0 (upwards) with 6 rad/s. Kinetic energy M(th) th'^2/2, potential
V(th): M th'' = -M' th'^2/2 - V', by DOP853; M', V' by complex steps. Data: library of computational benchmark problems,
as restated by the Exudyn examples.
"""
import numpy as np

import motion
import table

A, CRANK, ROD, g = np.array([0, 0.1, 0.12]), 0.08, 0.3, 9.81
M_CRANK, M_ROD, M_SLIDER = 0.12, 0.5, 2.0
J_CRANK, J_AXIAL, J_ACROSS = 1e-4 + M_CRANK * (CRANK / 2)**2, 4e-4, 4e-3


def slider(th):
    """Returns the position of the slider along x [m]."""
    B = ball(th)
    return np.sqrt(ROD**2 - B[1]**2 - B[2]**2)


def ball(th):
    return A + CRANK * np.array([0, -np.sin(th), np.cos(th)])


def inertia(th):
    """Returns M(th) [kg m^2]."""
    B, B_th = ball(th), CRANK * np.array([0, -np.cos(th), -np.sin(th)])
    x = slider(th)
    C_th = np.array([-(B[1] * B_th[1] + B[2] * B_th[2]) / x, 0, 0])
    r, r_th = (np.array([x, 0, 0]) - B) / ROD, (C_th - B_th) / ROD
    # The rate about x times r_x is the spin about the rod.
    turning = (r[1] * r_th[2] - r[2] * r_th[1]) / (r[1]**2 + r[2]**2)
    middle = 0.5 * (B_th + C_th)
    return (J_CRANK + M_SLIDER * C_th[0]**2 + M_ROD * (middle @ middle) + J_ACROSS * (r_th @ r_th)
            + J_AXIAL * (turning * r[0])**2)


def potential(th):
    return g * (M_CRANK * 0.5 * (A[2] + ball(th)[2]) + M_ROD * 0.5 * ball(th)[2])


def rate(_, z):
    th = z[0] + 1e-30j
    M, M_th, V_th = inertia(z[0]), np.imag(inertia(th)) / 1e-30, np.imag(potential(th)) / 1e-30
    return [z[1], -(0.5 * M_th * z[1]**2 + V_th) / M]


def energy(z):
    return 0.5 * inertia(z[0]) * z[1]**2 + potential(z[0])


def fill(rows):
    start = np.array([0.0, 6.0])
    times = [1, 5]
    states = motion.integrate(rate, start, times, agree=1e-10)
    if max(abs(energy(z) - energy(start)) for z in states) > 1e-11:
        raise ArithmeticError("the energy drifts")
    rows.add("energy", energy(start), 1e-12, "kinetic and potential energy [J]")
    for time, z in zip(times, states):
        rows.add(f"{time}.angle", z[0], 1e-9, f"angle of the crank at {time} s [rad]")
        rows.add(f"{time}.rate", z[1], 1e-8, f"rate of the crank at {time} s [rad/s]")
        rows.add(f"{time}.slider", slider(z[0]), 1e-10, f"place of the slider at {time} s [m]")


if __name__ == "__main__":
    table.run(fill, __file__)
