"""The simple pendulum of the IFToMM library."""

from harness import Problem, Quantity, Study, row, vector
from harness.motions import EnergyDrift, moved

MODEL = """
gravity: [0, -9.81, 0]
nodes: {bob: {position: [-1, 0, 0]}}
elements: {bob: {type: rigid_body, node: bob, mass: 1, inertia: [1e-12, 1e-12, 1e-12]}}
joints: {pivot: {type: hinge, nodes: [ground, bob], axis: [0, 0, 1], position: [0, 0, 0]}}
"""
EXACT = "closed form by Jacobi's elliptic functions with 30 digits (tests/references/simple_pendulum.py)"


def at_10(step):
    drift = EnergyDrift()
    session = moved(MODEL, 10, step, drift, rho=0.9)
    force = session["joints/pivot/reaction"][:3]
    return {"tension": float((force @ force) ** 0.5), "drift": drift.largest}


def at_5(step):
    return {"place": moved(MODEL, 5, step, rho=0.9)["nodes/bob/position"][:2]}


PROBLEM = Problem(
    title="A01 Simple pendulum",
    subject="Rigid mechanisms",
    source="IFToMM library of computational benchmark problems, A01; M. Gonzalez, D. Dopico, U. Lugris, J. Cuadrado, "
           "A benchmarking system for MBS "
           "simulation software, Multibody Syst. Dyn. 16 (2006) 179",
    model="A mass of 1 kg on a massless rod of 1 m, hinged at the origin, gravity 9.81 m/s^2; released at rest from "
          "the horizontal, for 10 s. "
          "A rigid body with a hinge to the ground, generalised-alpha with rho = 0.9.",
    quick=True,
    studies=[
        Study("Place of the mass at 5 s", at_5, [4e-3, 2e-3, 1e-3, 5e-4], [
            Quantity("place", "x, y at 5 s", "m", **vector("simple_pendulum", "5", components="xy"), source=EXACT,
                     tolerance=2e-5, order=2,
                     reason="period error of (w h)^2/12 to (w h)^2/6, w up to 4.4 rad/s, h = 0.5 ms: 1e-6 of a way of "
                            "10 m"),
        ]),
        Study("Energy and tension of the rod, as the library asks", at_10, [4e-3, 2e-3, 1e-3, 5e-4], [
            Quantity("drift", "largest drift of the energy within 10 s", "J", 0.0, source="conservation of energy",
                     tolerance=5e-5, order=2,
                     reason="the library's condition for processor times, as restated by the examples of Exudyn"),
            Quantity("tension", "tension at 10 s", "N", **row("simple_pendulum", "tension_10"), source=EXACT,
                     tolerance=3e-4, order=2,
                     reason="1e-5 of the largest tension 3 m g"),
        ], accuracy="drift"),
    ])
