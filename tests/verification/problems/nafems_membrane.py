"""NAFEMS benchmark of natural frequencies: a tapered membrane, as a solid."""

import bielle
import numpy as np
from harness import Problem, Quantity, Study
from harness.bodies import reduced

PUBLISHED = [44.623, 130.03, 162.70, 246.05, 379.90, 391.44]
THICKNESS = 0.2


def geometry(along, across):
    """A trapezoid, 5 m wide at the root and 1 m at the tip, 10 m long, one brick thick."""
    return f"""SetFactory("OpenCASCADE");
Point(1) = {{0, -2.5, {-THICKNESS / 2}}}; Point(2) = {{10, -0.5, {-THICKNESS / 2}}};
Point(3) = {{10, 0.5, {-THICKNESS / 2}}}; Point(4) = {{0, 2.5, {-THICKNESS / 2}}};
Line(1) = {{1, 2}}; Line(2) = {{2, 3}}; Line(3) = {{3, 4}}; Line(4) = {{4, 1}};
Curve Loop(1) = {{1, 2, 3, 4}}; Plane Surface(1) = {{1}};
Transfinite Curve {{1, 3}} = {along + 1}; Transfinite Curve {{2, 4}} = {across + 1};
Transfinite Surface {{1}}; Recombine Surface {{1}};
out[] = Extrude {{0, 0, {THICKNESS}}} {{ Surface{{1}}; Layers{{1}}; Recombine; }};
Physical Volume("body") = {{out[1]}};
Physical Surface("root") = Surface In BoundingBox {{-0.01, -3, -1, 0.01, 3, 1}};
Physical Surface("tip") = Surface In BoundingBox {{9.99, -1, -1, 10.01, 1, 1}};
"""


def membrane(along):
    """The first frequencies of modes in the plane: the tip moves in it and stays level."""
    path = reduced("membrane", geometry(along, along // 2), mesh={"order": 2, "cells": "hexahedra", "size": 5},
                   modes={"count": 60},
                   materials={"steel": {"young": 200e9, "poisson": 0.3, "density": 8000}},
                   interfaces={"root": {"surface": "root"}}, points={"tip": {"group": "tip"}})
    results = bielle.read({"nodes": {"root": {"fixed": True}}, "elements": {"membrane": {"type": "superelement",
                                                                                         "file": path,
                                                                                         "nodes": {"root": "root"}}},
                           "points": {"tip": {"element": "membrane", "point": "tip"}}}).session().modes(count=60)
    tip = list(results["eigen/nodes"]).index("tip")
    moves = np.abs(results["eigen/displacement"][:, tip] @ [1, 1j])
    turns = np.abs(results["eigen/rotation"][:, tip] @ [1, 1j])
    inside = moves[:, 0] + moves[:, 1] + turns[:, 2] > moves[:, 2] + turns[:, 0] + turns[:, 1]
    found = np.array(results["eigen/frequency"])[inside][:len(PUBLISHED)]
    return {"frequencies": found if len(found) == len(PUBLISHED) else [np.nan] * len(PUBLISHED)}


PROBLEM = Problem(
    title="NAFEMS FV32: tapered membrane",
    subject="Solids and superelements",
    source="NAFEMS, The Standard NAFEMS Benchmarks (1990), test FV32; NAFEMS R0015, Selected benchmarks for natural "
           "frequency analysis",
    model="A cantilevered membrane of 10 m, 5 m wide at the root and 1 m at the tip, E = 200 GPa, nu = 0.3, 8000 "
          "kg/m^3, vibrates in its plane. Here it is a plate 0.2 m thick of "
          "quadratic bricks, reduced by bielle-reduce to a superelement with its root and 60 modes, of which those in "
          "the plane are taken.",
    studies=[Study("Six lowest frequencies in the plane", membrane, [8, 16], [
        Quantity("frequencies", "in the plane", "Hz", PUBLISHED,
                 source="NAFEMS FV32, restated in the verification manual of OptiStruct", relative=True, known_to=5e-3,
                 tolerance=2e-3,
                 reason="the published values are those of a fine mesh to five digits; a plate of this thickness is "
                        "in plane stress to (pi 0.2/10)^2/12 = 3e-4, and the root holds "
                        "the thickness as well"),
    ], parameter="bricks along the membrane", by="elements")])
