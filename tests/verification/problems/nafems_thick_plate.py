"""NAFEMS benchmark of natural frequencies: a thick plate on simple supports, as a solid."""

import bielle
import h5py
import numpy as np
from harness import Problem, Quantity, Study, vector
from harness.bodies import box, grid, reduced

SIDE, HEIGHT = 10, 1
PUBLISHED = [45.897, 109.44, 109.44, 167.89]
EXACT = vector("elastic_bodies", *(f"plate_{k}" for k in range(1, 7)))
EDGES = """
Physical Surface("left") = Surface In BoundingBox {-0.01, -5.01, -1, 10.01, -4.99, 1};
Physical Surface("right") = Surface In BoundingBox {-0.01, 4.99, -1, 10.01, 5.01, 1};
"""


def held(place):
    """Directions of a node of the edges that are fixed: the height, and along the edge."""
    on_x = abs(place[0]) < 1e-9 or abs(place[0] - SIDE) < 1e-9
    on_y = abs(abs(place[1]) - SIDE / 2) < 1e-9
    return ["z", "rx", "ry", "rz"] + ["y"] * on_x + ["x"] * on_y


def plate(bricks):
    """The six lowest frequencies. Every mesh node of the edges is a node of the mechanism."""
    path = reduced("plate", box(SIDE, SIDE, HEIGHT) + grid((bricks, bricks, 2)) + EDGES,
                   mesh={"order": 2, "cells": "hexahedra", "size": 20}, modes={"count": 40},
                   materials={"steel": {"young": 200e9, "poisson": 0.3, "density": 8000}},
                   interfaces={"edges": {"surface": ["root", "tip", "left", "right"], "tie": "free"}},
                   recovery={"displacement": "none", "stress": "none"})
    with h5py.File(path) as file:
        names, places = file["interface/names"].asstr()[:], file["interface/positions"][:]
    session = bielle.read({
        "nodes": {f"n{k}": {"position": place.tolist(), "fixed": held(place)} for k, place in enumerate(places)},
        "elements": {"plate": {"type": "superelement", "file": path,
                               "nodes": {name: f"n{k}" for k, name in enumerate(names)}}}}).session()
    found = np.array(session.modes(count=6, shapes=False)["eigen/frequency"])
    return {"exact": found, "published": found[[0, 1, 2, 5]]}


PROBLEM = Problem(
    title="NAFEMS FV52: simply supported thick plate",
    subject="Solids and superelements",
    source="NAFEMS, The Standard NAFEMS Benchmarks (1990), test FV52; NAFEMS R0015, Selected benchmarks for natural "
           "frequency analysis",
    model="A plate of 10 x 10 x 1 m, E = 200 GPa, nu = 0.3, 8000 kg/m^3. NAFEMS holds the height of the lower edges, "
          "lines on which the displacement of a solid grows without limit as the mesh is refined. Here the whole edges "
          "keep their height and do not slide along themselves, for which exact elasticity has a solution. Quadratic "
          "bricks, reduced by bielle-reduce to every mesh node of the edges and 40 modes.",
    long=True,
    studies=[Study("Six lowest frequencies", plate, [4, 6], [
        Quantity("exact", "frequencies", "Hz", **EXACT, relative=True, tolerance=1e-2,
                 source="waves of Lamb and of shear between the edges (tests/references/elastic_bodies.py)",
                 reason="(k h)^4/240 for quadratic bricks, k h = 2 pi/6 in the modes (1,2) and (2,2): 5e-3; the modes "
                        "left out change the shear waves by a third of it"),
        Quantity("published", "frequencies (1,1), (1,2), (2,1), (2,2)", "Hz", PUBLISHED, relative=True, known_to=0.8,
                 tolerance=1.5e-2, source="NAFEMS FV52, target values",
                 reason="held along the lower edges the plate has frequencies lower by 0.2 % to 0.6 %, and bricks "
                        "raise them by 0.5 %"),
    ], parameter="bricks along an edge", by="elements")])
