"""The spatial rigid slider-crank of the IFToMM library."""

import numpy as np
from harness import Problem, Quantity, Study, row
from harness.motions import EnergyDrift, moved

MIDDLE_A, BALL, SLIDER = np.array([0, 0.1, 0.16]), np.array([0, 0.1, 0.2]), np.array([0.2, 0, 0])
ROD = (SLIDER - BALL) / 0.3
ARM = np.cross([1, 0, 0], ROD) / np.linalg.norm(np.cross([1, 0, 0], ROD))
TURNING = np.array([1.92, -0.96, 0.48])  # angular velocity of the rod: 1.92 about x and -1.0733 about the arm [rad/s]
OWN = np.array([ROD, ARM, np.cross(ROD, ARM)])


def model():
    """The crank turns about x, with its inertia about its middle; x of the rod is along it."""
    return {
        "gravity": [0, 0, -9.81],
        "nodes": {"crank": {"position": MIDDLE_A, "velocity": [0, -0.24, 0], "angular_velocity": [6, 0, 0]},
                  "rod": {"position": 0.5 * (BALL + SLIDER), "axes": {"x": ROD, "y": ARM},
                          "velocity": [0.12, -0.24, 0], "angular_velocity": OWN @ TURNING},
                  "slider": {"position": SLIDER, "velocity": [0.24, 0, 0]}},
        "elements": {"crank": {"type": "rigid_body", "node": "crank", "mass": 0.12, "inertia": [1e-4, 1e-4, 1e-5]},
                     "rod": {"type": "rigid_body", "node": "rod", "mass": 0.5, "inertia": [4e-4, 4e-3, 4e-3]},
                     "slider": {"type": "rigid_body", "node": "slider", "mass": 2, "inertia": [1e-4, 1e-4, 1e-4]}},
        "joints": {"main": {"type": "hinge", "nodes": ["ground", "crank"], "axis": [1, 0, 0],
                            "position": [0, 0.1, 0.12]},
                   "ball": {"type": "spherical", "nodes": ["crank", "rod"], "position": BALL},
                   "cross": {"type": "universal", "nodes": ["slider", "rod"], "axis": [1, 0, 0], "second_axis": ARM,
                             "position": SLIDER},
                   "guide": {"type": "prismatic", "nodes": ["ground", "slider"], "axis": [1, 0, 0]}}}


def turn(duration):
    """Study.compute: angle of the crank, place of the slider, drift of the energy."""
    def compute(step):
        drift = EnergyDrift()
        session = moved(model(), duration, step, drift, rho=0.9)
        return {"angle": session["joints/main/coordinate"][0], "slider": session["nodes/slider/position"][0],
                "drift": drift.largest}
    return compute


EXACT = "equation of motion of the crank's angle, DOP853 (tests/references/spatial_slider_crank.py)"


def quantities(time, angle, reason):
    return [
        Quantity("angle", "angle of the crank", "rad", **row("spatial_slider_crank", f"{time}.angle"), source=EXACT,
                 tolerance=angle, order=2, reason=reason),
        Quantity("slider", "place of the slider", "m", **row("spatial_slider_crank", f"{time}.slider"), source=EXACT,
                 tolerance=0.08 * angle, order=2, reason="the radius of the crank times the error of its angle"),
        Quantity("drift", "largest drift of the energy", "J", 0.0, source="conservation of energy", tolerance=5e-5,
                 order=2, reason="(w h)^2/4 of the 0.8 J that are exchanged, w = 36 rad/s, the third harmonic of the "
                                 "fastest turning, h = 0.25 ms: 1.6e-5"),
    ]


PROBLEM = Problem(
    title="Spatial rigid slider-crank",
    subject="Rigid mechanisms",
    source="IFToMM library of computational benchmark problems, 'Spatial rigid slider-crank mechanism'; data as "
           "restated by the examples of Exudyn",
    model="A crank of 0.08 m turns about x; a rod of 0.3 m leads from its ball joint to a universal joint on a slider "
          "of 2 kg, which moves along x, at right angles to the plane of the crank. From 6 rad/s in gravity for 5 s. "
          "Rigid bodies, hinge, spherical, universal and prismatic joint, rho = 0.9.",
    studies=[
        Study("1 s", turn(1), [1e-3, 5e-4, 2.5e-4], quantities(
            1, 2e-4, "(w h)^2/12 to (w h)^2/4, w = 36 rad/s at 0.25 ms, of 11 rad: 7e-5 to 2.2e-4")),
        Study("5 s", turn(5), [1e-3, 5e-4, 2.5e-4], quantities(5, 1e-3, "five times the way"), accuracy="drift"),
    ])
