"""The double pendulum."""

import numpy as np
from harness import Problem, Quantity, Study, vector
from harness.motions import EnergyDrift, moved

MODEL = """
gravity: [0, -9.81, 0]
nodes: {upper: {position: [1, 0, 0]}, lower: {position: [2, 0, 0]}}
elements:
  upper: {type: rigid_body, node: upper, mass: 1, inertia: [1e-12, 1e-12, 1e-12]}
  lower: {type: rigid_body, node: lower, mass: 1, inertia: [1e-12, 1e-12, 1e-12]}
joints:
  pivot: {type: hinge, nodes: [ground, upper], axis: [0, 0, 1], position: [0, 0, 0]}
  knee: {type: hinge, nodes: [upper, lower], axis: [0, 0, 1], position: [1, 0, 0]}
"""


def swing(step):
    drift = EnergyDrift()
    session = moved(MODEL, 2, step, drift, rho=0.9)
    upper, lower = session["nodes/upper/position"], session["nodes/lower/position"]
    return {"masses": [upper[:2], lower[:2]], "drift": drift.largest}


ANGLES = vector("double_pendulum", "upper_at_2", "lower_at_2")
RODS = np.array([[np.sin(angle), -np.cos(angle)] for angle in ANGLES["reference"]])

PROBLEM = Problem(
    title="Double pendulum",
    subject="Rigid mechanisms",
    source="textbook problem, e.g. L. D. Landau, E. M. Lifshitz, Mechanics, section 5",
    model="Two masses of 1 kg on massless rods of 1 m, released at rest from the horizontal, g = 9.81 m/s^2, for 2 s. "
          "Rigid bodies with hinges, rho = 0.9.",
    quick=True,
    studies=[Study("Places of the masses at 2 s", swing, [2e-3, 1e-3, 5e-4, 2.5e-4], [
        Quantity("masses", "x, y of both masses", "m", np.cumsum(RODS, axis=0), known_to=ANGLES["known_to"],
                 tolerance=6e-5, order=2,
                 source="equations of motion in two angles, DOP853 (tests/references/double_pendulum.py)",
                 reason="the lower rod whips round with up to 20 rad/s: (w h)^2/4 is 6e-6, of a way of 10 m"),
        Quantity("drift", "largest drift of the energy", "J", 0.0, source="conservation of energy", tolerance=1e-3,
                 order=2, reason="3e-5 of 3 m g L"),
    ])])
