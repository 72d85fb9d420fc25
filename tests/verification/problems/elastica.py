"""A cantilever under a dead load at its tip, and rolled up by a moment."""

import bielle
import numpy as np
from harness import Problem, Quantity, Study, vector


def tip(elements, load, section, moment=0.0):
    """x, y and the rotation of the tip about z of a cantilever of length 1."""
    session = bielle.read({
        "nodes": {"root": {"position": [0, 0, 0], "fixed": True}, "tip": {"position": [1, 0, 0]}},
        "elements": {"beam": {"type": "beam", "nodes": ["root", "tip"], "elements": elements, "section": section}},
        "loads": {"load": {"node": "tip", "force": [0, load, 0], "moment": [0, 0, moment]}}}).session()
    session.statics(steps=10, newton={"tolerance": 1e-11}, record=False)
    x, y, _ = session["nodes/tip/position"]
    return np.array([x, y, session["nodes/tip/rotation_vector"][2]])


REISSNER = {"EA": 1200, "GAy": 1000 / 2.6, "GAz": 1, "GJ": 1, "EIy": 1, "EIz": 1}
SHOOTING = ("Reissner's rod by shooting (tests/references/elastica.py); its inextensible limit is K. Mattiasson, "
            "IJNME 17 (1981) 145")


def bent(load):
    return lambda elements: {"tip": tip(elements, load, REISSNER)}


def rolled(elements):
    """Half a circle, by the moment pi EI/L: u = -L, w = 2 L/pi."""
    return {"tip": tip(elements, 0, REISSNER, np.pi * 0.999999)[:2]}


HALF = np.pi * 0.999999
PROBLEM = Problem(
    title="Cantilever: elastica and roll-up",
    subject="Beams at rest",
    source="K. Mattiasson, Numerical results from large deflection beam and frame problems analysed by means of "
           "elliptic integrals, IJNME 17 (1981) 145",
    model="A straight cantilever, L = EI = 1, EA = 1200, GA = 5/6 EA/2.6, under a transverse dead load P = 1 or 10 at "
          "its tip (slope up to 82 degrees), in ten steps; "
          "or under an end moment that bends it into half a circle. One beam, meshes of equal elements.",
    quick=True,
    studies=[
        Study("P L^2/EI = 1", bent(1), [16, 32, 64, 128], [
            Quantity("tip", "x, y [m] and slope [rad] of the tip", "m, rad",
                     **vector("elastica", "reissner_1", components="xyz"), source=SHOOTING, tolerance=1e-7,
                     reason="elements of constant strain have (1/128)^2/48 = 1.3e-6; the residual flexibility leaves "
                            "less than a tenth", order=2),
        ], parameter="elements", by="elements"),
        Study("P L^2/EI = 10", bent(10), [32, 64, 128, 256], [
            Quantity("tip", "x, y [m] and slope [rad] of the tip", "m, rad",
                     **vector("elastica", "reissner_10", components="xyz"), source=SHOOTING, tolerance=1e-6,
                     reason="likewise: (1/256)^2/48 times the square of the largest curvature, 4.2 1/m, is 6e-6",
                     order=2),
        ], parameter="elements", by="elements"),
        Study("Half a circle by an end moment", rolled, [2, 4, 8], [
            Quantity("tip", "x, y of the tip", "m", [np.sin(HALF) / HALF, (1 - np.cos(HALF)) / HALF],
                     source="x = L sin(f)/f, y = L (1 - cos f)/f, f = M L/EI",
                     tolerance=1e-9, reason="constant curvature is exact for any mesh: Newton's tolerance"),
        ], parameter="elements", by="elements"),
    ])
