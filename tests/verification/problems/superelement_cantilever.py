"""A solid cantilever, reduced to a superelement, against Timoshenko's beam."""

import bielle
import numpy as np
from harness import Problem, Quantity, Study, row, vector
from harness.bodies import STEEL, box, grid, reduced

SLENDER, THICK = 0.02, 0.1
EXACT = "Timoshenko's beam, shear factor 5/6 (tests/references/timoshenko_beam.py)"


def superelement(side, bricks, across, modes):
    """Both ends move as the mean of their faces, which may contract and warp."""
    return reduced("bar", box(1, side, side) + grid((bricks, across, across)),
                   mesh={"order": 2, "cells": "hexahedra", "size": 1}, modes={"count": modes},
                   interfaces={"root": {"surface": "root", "tie": "average"},
                               "tip": {"surface": "tip", "tie": "average"}})


def session(path, root, force):
    return bielle.read({"nodes": {"root": root, "tip": {"position": [1, 0, 0]}},
                        "elements": {"bar": {"type": "superelement", "file": path,
                                             "nodes": {"root": "root", "tip": "tip"}}},
                        "loads": {"p": {"node": "tip", "force": [0, force, 0]}}}).session()


def deflection(side):
    """Deflection of the tip under 0.01 N [m]."""
    young, shear = STEEL["young"], STEEL["young"] / (2 * (1 + STEEL["poisson"]))
    return 0.01 * (1 / (3 * young * side**4 / 12) + 1 / (5 / 6 * shear * side**2))


def slender(bricks):
    held = session(superelement(SLENDER, bricks, 1, 8), {"fixed": True}, 0.01)
    frequencies = 2 * np.pi * held.modes(count=4)["eigen/frequency"]
    held.statics(newton={"tolerance": 1e-12}, record=False)
    return {"frequencies": frequencies[[0, 2]], "deflection": held["nodes/tip/position"][1] / deflection(SLENDER)}


def thick(bricks):
    path = superelement(THICK, bricks, 2, 24)
    held, free = session(path, {"fixed": True}, 0), session(path, {}, 0)
    modes = free.modes(count=2)
    elastic = [w for w, kind in zip(modes["eigen/frequency"], modes["eigen/kind"]) if kind == "oscillating"]
    return {"held": held.modes(count=2)["eigen/frequency"][0], "free": elastic[0]}


PROBLEM = Problem(
    title="Solid cantilever as a superelement",
    subject="Solids and superelements",
    source="R. Craig, M. Bampton, Coupling of substructures for dynamic analyses, AIAA J. 6 (1968) 1313; S. "
           "Timoshenko, Phil. Mag. 41 (1921) 744; "
           "subject of A. Cardona, An Integrated Approach to Mechanism Analysis, thesis, Liege 1989, ch. 4",
    model="A steel bar of 1 m, meshed by bielle-reduce with quadratic bricks (one or two across), reduced to the mean "
          "motion of its two ends and 8 (24) fixed-boundary modes, and held at one end: "
          "0.02 m square, or 0.1 m square. Deflection under a force, frequencies, and those of the free bar.",
    studies=[
        Study("Slender bar, 0.02 m", slender, [8, 16, 32], [
            Quantity("deflection", "deflection of the tip over P L^3/3EI + P L/(k G A)", "-", 1.0,
                     source="Timoshenko's beam", tolerance=4e-4,
                     reason="the solid and the beam differ by the order of (height/length)^2 = 4e-4"),
            Quantity("frequencies", "first and second bending frequency", "rad/s",
                     **vector("timoshenko_beam", "slender.clamped_1", "slender.clamped_2"), source=EXACT,
                     relative=True, tolerance=2e-3,
                     reason="the second is known to (height/length)^2 times (mode number)^2 = 1.6e-3"),
        ], parameter="bricks along the bar", by="elements"),
        Study("Thick bar, 0.1 m", thick, [8, 16], [
            Quantity("held", "first frequency, one end held", "Hz", **row("timoshenko_beam", "thick.clamped_1"),
                     source=EXACT, relative=True, tolerance=3e-3,
                     reason="solids lie within 0.3 % of Timoshenko's beam in the first modes at this height"),
            Quantity("free", "first bending frequency of the free bar", "Hz", **row("timoshenko_beam", "thick.free"),
                     source=EXACT, relative=True, tolerance=3e-3, reason="likewise"),
        ], parameter="bricks along the bar", by="elements"),
    ])
