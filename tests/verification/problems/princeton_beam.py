"""The beam of the Princeton experiments."""

import bielle
import numpy as np
from harness import Problem, Quantity, Study, vector

ANGLES = (15, 30, 45, 60, 75)
SHOOTING = "geometrically exact rod by shooting (tests/references/princeton_beam.py)"


def beam(load):
    """Study.compute: tips at all angles of the section."""
    def compute(elements):
        tips = []
        for angle in np.radians(ANGLES):
            session = bielle.read({
                "nodes": {"root": {"position": [0, 0, 0], "fixed": True}, "tip": {"position": [0.508, 0, 0]}},
                "elements": {"beam": {"type": "beam", "nodes": ["root", "tip"], "elements": elements,
                                      "orientation": [0, np.cos(angle), np.sin(angle)],
                                      "section": {"rectangle": [3.2024e-3, 12.377e-3], "young": 71.7e9,
                                                  "poisson": 0.31, "shear_factors": [5 / 6, 5 / 6]}}},
                "loads": {"p": {"node": "tip", "force": [0, 0, -load]}}}).session()
            session.statics(steps=3, record=False)
            tips.append(session["nodes/tip/position"])
        return {"tips": tips}
    return compute


def study(load, tolerance):
    found = vector("princeton_beam", *(f"{load}.{angle}" for angle in ANGLES), components="xyz")
    return Study(f"{load} N", beam(load), [8, 16, 32], [
        Quantity("tips", "places of the tip at 15, 30, 45, 60 and 75 degrees", "m",
                 np.reshape(found["reference"], (-1, 3)), known_to=found["known_to"], source=SHOOTING,
                 tolerance=tolerance, order=2,
                 reason="(1/32)^2/48 times the square of the largest rotation, 0.2 to 0.7 rad, of 0.5 m")],
                 parameter="elements", by="elements")


PROBLEM = Problem(
    title="Princeton beam",
    subject="Beams at rest",
    source="E. Dowell, J. Traybar, AMS Reports 1194 and 1257, Princeton University (1975); O. Bauchau et al., "
           "Validation of flexible multibody dynamics beam formulations using "
           "benchmark problems, Multibody Syst. Dyn. 37 (2016) 29",
    model="A cantilever of aluminium, 0.508 m, 12.377 x 3.2024 mm, E = 71.7 GPa, nu = 0.31, is loaded at its tip by "
          "4.448, 8.896 or 13.345 N, with its section turned by 15 to 75 "
          "degrees: bending about both axes, which differ by 15, twists it. The exact rod with these data is the "
          "reference, not the measurements.",
    quick=True,
    studies=[study(4.448, 1e-6), study(8.896, 3e-6), study(13.345, 6e-6)])
