"""A rotating bar as one superelement with geometric stiffness."""

import bielle
import numpy as np
from harness import Problem, Quantity, Study, vector
from harness.bodies import STEEL, box, grid, reduced

SIDE = 0.02
UNIT = np.sqrt(STEEL["young"] * SIDE**2 / 12 / STEEL["density"])  # sqrt(EI/(m L^4)) [rad/s]


def rotating(speed):
    """Frequencies in the plane of rotation and across, and the extension, at eta = speed."""
    path = reduced("bar", box(1, SIDE, SIDE) + grid((32, 1, 1)), mesh={"order": 2, "cells": "hexahedra", "size": 1},
                   modes={"count": 8},
                   interfaces={"root": {"surface": "root", "tie": "average"},
                               "tip": {"surface": "tip", "tie": "average"}})
    rate = speed * UNIT
    results = bielle.read({
        "nodes": {"root": {"fixed": ["x", "y", "z", "rx", "ry"], "motion": {"rz": f"{rate!r}*t"}},
                  "tip": {"position": [1, 0, 0]}},
        "elements": {"bar": {"type": "superelement", "file": path, "nodes": {"root": "root", "tip": "tip"}}},
    }).session().modes(count=2, rotation={"rate": float(rate), "axis": [0, 0, 1]})
    tip = list(results["eigen/nodes"]).index("tip")
    shapes = np.abs(results["eigen/displacement"][:, tip] @ [1, 1j])
    across = int(np.argmax(shapes[:, 2]))
    mu = 2 * np.pi * np.array(results["eigen/damped_frequency"]) / UNIT
    exact = EXACT[speed]
    extension = np.linalg.norm(results["eigen/position"][tip]) - 1
    return {"flap": mu[across] / exact, "lag": mu[1 - across] / np.sqrt(exact**2 - speed**2),
            "extension": extension / (STEEL["density"] * rate**2 / (3 * STEEL["young"]))}


EXACT = dict(zip((1, 3, 6), vector("rotating_beam", "1.flap_1", "3.flap_1", "6.flap_1")["reference"]))
SERIES = "Bernoulli beam by power series of 60 digits (tests/references/rotating_beam.py)"
PROBLEM = Problem(
    title="Rotating superelement",
    subject="Solids and superelements",
    source="A. Wright, C. Smith, R. Thresher, J. Wang, J. Appl. Mech. 49 (1982) 197; A. Cardona, M. Geradin, "
           "Modelling of superelements in mechanism analysis, IJNME 32 "
           "(1991) 1565; "
           "subject of A. Cardona, An Integrated Approach to Mechanism Analysis, thesis, Liege 1989, ch. 4",
    model="A solid steel bar of 1 m, 0.02 m square, as one superelement that turns about an axis through its root, "
          "eta = Omega sqrt(m L^4/EI) = 1, 3, 6. A linear body without "
          "geometric stiffness has no stiffness left in the plane at eta = 3.5; the superelement carries that of its "
          "centrifugal forces.",
    studies=[Study("Frequencies and extension", rotating, [1, 3, 6], [
        Quantity("flap", "first frequency across, over its reference", "-", 1.0, source=SERIES, tolerance=2e-3,
                 known_to=1e-10,
                 reason="shear, rotary inertia and the mesh: 4e-4; the shape under tension is one of eight modes and "
                        "constraint modes"),
        Quantity("lag", "first frequency in the plane, over its reference", "-", 1.0, source=SERIES, tolerance=4e-3,
                 known_to=1e-10,
                 reason="the error across, times up to mu^2/(mu^2 - eta^2) = 3"),
        Quantity("extension", "extension over rho Omega^2 L^3/3E", "-", 1.0,
                 source="bar under its centrifugal force, of first order in rho Omega^2 L^2/E", tolerance=1e-3,
                 reason="contraction of the ends and the second order, 1e-4"),
    ], parameter="eta", by="")])
