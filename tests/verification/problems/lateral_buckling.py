"""Lateral buckling of a strip and of right-angle frames."""

import bielle
import numpy as np
from harness import Problem, Quantity, Study, row

SHOOTING = "geometrically exact rod by shooting, with the bending before buckling (tests/references/buckling.py)"
THIN = 31 / 100  # Poisson's ratio of the frame
YOUNG, WIDTH, THICKNESS = 71240, 30, 0.6
SHEAR = YOUNG / (2 * (1 + THIN))
FRAME_SECTION = {"EA": YOUNG * WIDTH * THICKNESS, "GAy": SHEAR * WIDTH * THICKNESS, "GAz": SHEAR * WIDTH * THICKNESS,
                 "GJ": SHEAR * WIDTH * THICKNESS**3 / 3,
                 "EIy": YOUNG * WIDTH * THICKNESS**3 / 12, "EIz": YOUNG * WIDTH**3 * THICKNESS / 12}


def critical(model, load, steps):
    """The first critical load. The model's load is `load`."""
    found = bielle.read(model).session().statics(steps=steps).numbers["critical_points"]
    return load * found[0] if found else np.nan


def strip(ratio):
    """Study.compute for EI_w/EI_stiff = GJ/EI_stiff = ratio, with EI_w = GJ = 1 and L = 1."""
    def compute(elements):
        return {"load": critical({
            "nodes": {"root": {"position": [0, 0, 0], "fixed": True}, "tip": {"position": [1, 0, 0]}},
            "elements": {"strip": {"type": "beam", "nodes": ["root", "tip"], "orientation": [0, 1, 0],
                                   "elements": elements,
                                   "section": {"EA": 1e7, "GAy": 1e7, "GAz": 1e7, "GJ": 1, "EIy": 1,
                                               "EIz": 1 / ratio}}},
            "loads": {"p": {"node": "tip", "force": [0, -6, 0]}}}, 6, 6)}
    return compute


def frame(load):
    """Study.compute for a dead load along the first leg, positive away from the clamp."""
    def compute(elements):
        leg = {"type": "beam", "elements": elements, "section": FRAME_SECTION}
        return {"load": abs(critical({
            "nodes": {"root": {"position": [0, 0, 0], "fixed": True}, "corner": {"position": [0, 240, 0]},
                      "tip": {"position": [240, 240, 0]}},
            "elements": {"first": {**leg, "nodes": ["root", "corner"], "orientation": [1, 0, 0]},
                         "second": {**leg, "nodes": ["corner", "tip"], "orientation": [0, 1, 0]}},
            "loads": {"p": {"node": "tip", "force": [0, load, 0]}}}, load, 6))}
    return compute


def quantity(meaning, name, tolerance, reason):
    return [Quantity("load", meaning, "-", **row("buckling", name), source=SHOOTING, tolerance=tolerance,
                     relative=True, order=2, reason=reason)]


PROBLEM = Problem(
    title="Lateral buckling",
    subject="Beams at rest",
    source="S. Timoshenko, J. Gere, Theory of Elastic Stability, 6.4; J. Argyris et al., Finite element method - the "
           "natural approach, CMAME 17/18 (1979) 1: 1.088 and 0.680",
    model="A cantilever strip under a dead load at its tip in its stiff plane, EI_w = GJ = EI_stiff/100. A "
          "right-angle frame of two legs of 240, section 30 x 0.6, E = 71240, "
          "nu = 0.31, clamped at one end, loaded at the other along the first leg, in both directions. Beams; load "
          "factors at which the statics finds a motion of "
          "negative stiffness.",
    studies=[
        Study("Strip, P L^2/sqrt(EI_w GJ)", strip(0.01), [8, 16, 32], quantity("critical load", "strip_0.01", 1e-3,
                                                                               "(1/32)^2/2 = 5e-4"),
              parameter="elements", by="elements"),
        Study("Right-angle frame, load away from the clamp", frame(1.5), [8, 16, 32],
              quantity("critical load", "thin.away", 1e-3, "(1/32)^2/2 = 5e-4"),
              parameter="elements of a leg", by="elements"),
        Study("Right-angle frame, load towards the clamp", frame(-1.0), [8, 16, 32],
              quantity("critical load", "thin.towards", 1e-3, "(1/32)^2/2 = 5e-4"),
              parameter="elements of a leg", by="elements"),
    ])
