"""The rotor with two blades: its Floquet exponents under gravity, from the nonlinear equations of three unknowns."""

import math

import numpy as np
from bielle_tools.gallery.machine import Check, Machine, Picture
from bielle_tools.results import Results
from scipy.integrate import solve_ivp

G, RATE = 9.81, 6.0
STANDING, SUPPORT_STIFFNESS, SUPPORT_DAMPING = 420.0, 7.26e4, 50.0      # support and hub [kg], [N/m], [N s/m]
BLADE, LENGTH, OFFSET, HINGE_STIFFNESS, HINGE_DAMPING = 30.0, 4.0, 0.4, 9000.0, 20.0
TO_CENTRE, INERTIA = LENGTH / 2, BLADE * LENGTH**2 / 12
FLOQUET = "monodromy matrix of the nonlinear equations about their periodic solution"


def rates(t, state, rate):
    """Rates of (y, a_1, a_2) and of their rates. The centre of mass of a blade is at
        (y + e cos psi + r cos(psi + a), e sin psi + r sin(psi + a)),    psi = rate t, or half a turn more,
    in the plane of y and z. Lagrange's equations: the accelerations without those of y and a are f, and the virtual motions are
    (1, 0) of y and r (-sin, cos)(psi + a) of a."""
    y, swing, y_rate, swing_rate = state[0], state[1:3], state[3], state[4:]
    psi = rate * t + np.array([0, math.pi])
    cosine, sine, turning = np.cos(psi + swing), np.sin(psi + swing), rate + swing_rate
    f = -np.array([OFFSET * rate**2 * np.cos(psi) + TO_CENTRE * turning**2 * cosine,
                   OFFSET * rate**2 * np.sin(psi) + TO_CENTRE * turning**2 * sine])
    M = np.diag([STANDING + 2 * BLADE, *2 * [INERTIA + BLADE * TO_CENTRE**2]])
    M[0, 1:] = M[1:, 0] = -BLADE * TO_CENTRE * sine
    force = np.concatenate([[-SUPPORT_STIFFNESS * y - SUPPORT_DAMPING * y_rate - BLADE * f[0].sum()],
                            -HINGE_STIFFNESS * swing - HINGE_DAMPING * swing_rate
                            - BLADE * TO_CENTRE * (-sine * f[0] + cosine * (f[1] + G))])
    return np.concatenate([state[3:], np.linalg.solve(M, force)])


def exponents(rate):
    """The periodic solution at the azimuth 0, by Newton's method, and its Floquet exponents [1/s], whose imaginary parts are
    known up to multiples of the rate."""
    def after_a_turn(state):
        return solve_ivp(rates, (0, 2 * math.pi / rate), state, args=(rate,), rtol=1e-10, atol=1e-12, method="DOP853").y[:, -1]

    state, step = np.zeros(6), 1e-5
    for _ in range(20):
        monodromy = np.column_stack([(after_a_turn(state + step * e) - after_a_turn(state - step * e)) / (2 * step) for e in np.eye(6)])
        change = np.linalg.solve(monodromy - np.eye(6), state - after_a_turn(state))
        state = state + change
        if np.abs(change).max() < 1e-9:
            return state, np.log(np.linalg.eigvals(monodromy).astype(complex)) * rate / (2 * math.pi)
    raise ValueError(f"there is no periodic motion at {rate} rad/s")


def nearest(value, found, rate):
    """That one of the exponents that is nearest to a value, with the multiple of the rate by which it is nearest."""
    turned = [each + 1j * rate * round((value.imag - each.imag) / rate) for each in found]
    return min(turned, key=lambda each: abs(each - value))


def modes(path):
    """Exponents of the modes of a run that are not rigid."""
    with Results(path) as results:
        kinds, values = results.array("eigen/kind"), results.array("eigen/eigenvalue")
    return [complex(*value) for kind, value in zip(kinds, values) if kind.decode() != "rigid"]


def check(paths):
    _, found = exponents(RATE)
    checks = []
    for number, value in enumerate(modes(paths["modes"]), 1):
        own = nearest(value, found, RATE)
        checks += [Check(f"frequency of mode {number}", "Hz", value.imag / (2 * math.pi), own.imag / (2 * math.pi), 1e-6,
                         "harmonics that are left out", FLOQUET),
                   Check(f"decay of mode {number}", "1/s", -value.real, -own.real, 1e-5, "the same", FLOQUET)]
    return checks


MACHINE = Machine(
    title="Rotor with two blades on a flexible support",
    teaches="Two blades have no axes in which the equations of a rotor on a flexible support are constant. Its modes "
            "are Floquet's, about the periodic motion into which gravity brings the blades.",
    runs={"modes": ["two_blades.yaml"]},
    pictures=[Picture("modes", ["--mode", "2", "--view", "x", "--frames", "3", "--size", "640x480"])],
    page="modes",
    check=check)
