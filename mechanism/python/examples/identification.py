#!/usr/bin/python3
"""Parameter identification: stiffness and damping of a joint from a measured free vibration, by scipy.optimize.

    PYTHONPATH=build/release/python mechanism/python/examples/identification.py
"""

import numpy as np
from scipy.optimize import least_squares

import bielle

INERTIA, START = 0.5, 0.2  # [kg m^2], [rad]
MODEL = f"""\
mechanism: a wheel on a torsion spring
parameters: {{stiffness: 10, damping: 0.1}}
nodes: {{wheel: {{}}}}
elements: {{wheel: {{type: rigid_body, node: wheel, mass: 1, inertia: [0.3, 0.3, {INERTIA}]}}}}
joints:
  axle: {{type: hinge, nodes: [ground, wheel], axis: [0, 0, 1], stiffness: stiffness, damping: damping, start: {START}}}
"""
TIMES = np.linspace(0, 2, 101)


def measured(stiffness=37.0, damping=0.4, noise=1e-3):
    """The signal of a sensor [rad]: the closed form of such a vibration, and noise."""
    decay, omega = damping / (2 * INERTIA), np.sqrt(stiffness / INERTIA)
    damped = np.sqrt(omega**2 - decay**2)
    angle = START * np.exp(-decay * TIMES) * (np.cos(damped * TIMES) + decay / damped * np.sin(damped * TIMES))
    return angle + noise * np.random.default_rng(1).standard_normal(len(TIMES))


def computed(stiffness, damping):
    session = bielle.read(MODEL, {"stiffness": stiffness, "damping": damping}).session()
    with session.record(times=TIMES[1:]) as recording:
        session.dynamics(TIMES[-1], 2e-3, scheme="newmark").finish()
    return recording[0]["joints/axle/coordinate"][:, 0]


def identify(angle):
    """Stiffness [N m/rad] and damping [N m s/rad] with which the model fits the angle best, and their standard deviations."""
    fit = least_squares(lambda p: computed(*p) - angle, x0=[25, 0.1], bounds=([1, 0], [200, 10]), x_scale=[10, 0.1])
    variance = 2 * fit.cost / (len(angle) - len(fit.x))
    return fit.x, np.sqrt(variance * np.diag(np.linalg.inv(fit.jac.T @ fit.jac)))


if __name__ == "__main__":
    values, deviations = identify(measured())
    for name, value, deviation in zip(("stiffness", "damping"), values, deviations):
        print(f"{name} {value:.4f} +- {deviation:.4f}")
