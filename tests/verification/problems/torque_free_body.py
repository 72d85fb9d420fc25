"""A free body that spins about its intermediate axis."""

import numpy as np
from harness import Problem, Quantity, Study, vector
from harness.motions import axes, moved

MODEL = """
nodes: {body: {angular_velocity: [0.01, 5, 0.01]}}
elements: {body: {type: rigid_body, node: body, mass: 1, inertia: [1, 2, 3]}}
"""
EXACT = ("Jacobi's elliptic functions with 40 digits (tests/references/torque_free_body.py); L. D. Landau, E. M. "
         "Lifshitz, Mechanics, section 37")


def tumble(step):
    session = moved(MODEL, 10, step, rho=0.9)
    Omega = session.node("body").angular_velocity
    return {"Omega": Omega, "momentum": axes(session, "body") @ (np.array([1, 2, 3]) * Omega)}


def flips(step):
    """Times between which the spin about the second axis changes its sign, by straight lines between steps."""
    times, last = [], [0.0, 0.0]

    def look(session):
        spin = session.node("body").angular_velocity[1]
        if last[1] * spin < 0:
            times.append(last[0] + (session.time - last[0]) * last[1] / (last[1] - spin))
        last[:] = session.time, spin

    moved(MODEL, 9, step, look, rho=0.9)
    return {"flips": [times[0], times[1] - times[0]] if len(times) == 2 else [np.nan, np.nan]}


PROBLEM = Problem(
    title="Free body about its intermediate axis (Dzhanibekov)",
    subject="Rigid mechanisms",
    source="L. Poinsot (1834); L. D. Landau, E. M. Lifshitz, Mechanics, section 37",
    model="A free rigid body, J = diag(1, 2, 3) kg m^2, spins with (0.01, 5, 0.01) rad/s about its intermediate axis "
          "and turns over every 5.03 s. "
          "One rigid body without a joint; the instability magnifies errors by e^(Omega t/sqrt 3). Generalised-alpha, "
          "rho = 0.9.",
    quick=True,
    studies=[
        Study("State at 10 s, after two flips", tumble, [4e-3, 2e-3, 1e-3, 5e-4], [
            Quantity("Omega", "angular velocity", "rad/s", **vector("torque_free_body", "10.Omega", components="xyz"),
                     source=EXACT, tolerance=1e-5, order=2,
                     reason="2e-6 of 5 rad/s; at 10 s the axis is nearly at rest in the body, and errors of time "
                            "hardly count"),
            Quantity("momentum", "angular momentum in space", "N m s", [0.01, 10, 0.03], source="it is constant",
                     tolerance=2e-4, order=2,
                     reason="2e-5 of 10 N m s"),
        ]),
        Study("Times of the flips", flips, [8e-3, 4e-3, 2e-3, 1e-3], [
            Quantity("flips", "first flip, and from it to the second", "s",
                     **vector("torque_free_body", "first_flip", "between_flips"), source=EXACT,
                     tolerance=1e-4, order=2, reason="a tenth of a step"),
        ]),
    ])
