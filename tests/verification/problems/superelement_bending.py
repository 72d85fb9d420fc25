"""Large bending of a solid bar as superelements in a row."""

import bielle
from harness import Problem, Quantity, Study, vector
from harness.bodies import STEEL, box, grid, reduced

SIDE = 0.01


def bent(pieces):
    path = reduced("bar", box(1, SIDE, SIDE) + grid((64, 1, 1)), mesh={"order": 2, "cells": "hexahedra", "size": 1},
                   modes={"count": 0},
                   interfaces={"root": {"surface": "root", "tie": "average"},
                               "tip": {"surface": "tip", "tie": "average"}},
                   pieces={"planes": {"axis": "x", "at": [k / pieces for k in range(1, pieces)]}, "tie": "average",
                           "compare": False})
    force = STEEL["young"] * SIDE**4 / 12
    session = bielle.read({"nodes": {"root": {"fixed": True}, "tip": {"position": [1, 0, 0]}},
                           "elements": {"bar": {"type": "superelement", "file": path,
                                                "nodes": {"root": "root", "tip": "tip"}}},
                           "loads": {"p": {"node": "tip", "force": [0, force, 0]}}}).session()
    session.statics(steps=4, record=False)
    x, y, _ = session["nodes/tip/position"]
    return {"tip": [1 - x, y]}


PROBLEM = Problem(
    title="Large bending of superelements in a row",
    subject="Solids and superelements",
    source="K. Mattiasson, IJNME 17 (1981) 145; A. Cardona, M. Geradin, Modelling of superelements in mechanism "
           "analysis, IJNME 32 (1991) 1565; "
           "subject of A. Cardona, An Integrated Approach to Mechanism Analysis, thesis, Liege 1989, ch. 4",
    model="A solid steel cantilever of 1 m, 0.01 m square, cut by bielle-reduce into 2, 4 or 8 superelements, each "
          "linear in its own frame; a dead load P L^2/EI = 1 "
          "deflects its tip by 0.30 m.",
    studies=[Study("Place of the tip", bent, [2, 4, 8], [
        Quantity("tip", "shortening and deflection of the tip", "m", **vector("elastica", "inextensible_1.shortening",
                                                                              "inextensible_1.deflection"),
                 relative=True, tolerance=1e-3,
                 source="elastica (tests/references/elastica.py)",
                 reason="the mesh of 64 bricks and the ends in the mean: 2e-4; shear, extension: 1e-4; pieces that "
                        "bend by 0.06 rad: 0.006 of its square"),
    ], parameter="superelements", by="elements")])
