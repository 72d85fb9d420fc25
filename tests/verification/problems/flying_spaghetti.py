"""The flying spaghetti, in the plane and in space."""

import bielle
import numpy as np
from harness import Problem, Quantity, Study, row, vector
from harness.motions import moved

EXACT = "spectral element in space, Runge-Kutta in time, several meshes (tests/references/flying_spaghetti.py)"


def model(elements, EI, peak, moments):
    """A force T/10 along x and moments of T about y and z at the end A. @param moments  factors of T"""
    T = f"if(t < 2.5, {peak / 2.5}*t, if(t < 5, {peak / 2.5}*(5 - t), 0))"
    return {"nodes": {"a": {"position": [6, 0, 0]}, "b": {"position": [0, 8, 0]}},
            "elements": {"s": {"type": "beam", "nodes": ["a", "b"], "elements": elements,
                               "section": {"EA": 1e4, "GAy": 1e4, "GAz": 1e4, "GJ": EI, "EIy": EI, "EIz": EI,
                                           "mass_per_length": 1, "Jx": 10, "Jy": 10, "Jz": 10}}},
            "loads": {"l": {"node": "a", "force": [f"({T})/10", 0, 0],
                            "moment": [0, *(f"{factor}*({T})" for factor in moments)]}}}


def plane(elements):
    """Step 0.32/elements: both are refined together."""
    session = moved(model(elements, 100, 80, (0, -1)), 10, 0.32 / elements, rho=0.9)
    energy = session.energy
    return {"ends": [session["nodes/a/position"][:2], session["nodes/b/position"][:2]],
            "energy": energy["kinetic"] + energy["elastic"]}


def space(elements):
    """Step 0.16/elements."""
    session = moved(model(elements, 500, 200, (-0.5, -1)), 5, 0.16 / elements, rho=0.9)
    return {"ends": [session["nodes/a/position"], session["nodes/b/position"]]}


def rows(name, components):
    found = vector("flying_spaghetti", f"{name}.a", f"{name}.b", components=components)
    return {"reference": np.reshape(found["reference"], (2, -1)), "known_to": found["known_to"]}


PROBLEM = Problem(
    title="Flying spaghetti",
    subject="Beams in motion",
    source="J. Simo, L. Vu-Quoc, J. Appl. Mech. 53 (1986) 855 (plane), CMAME 66 (1988) 125 (space)",
    model="A free beam of 10 m at rest from (6, 0, 0) to (0, 8, 0), EA = GA = 1e4, mass 1 and mass moments 10 per "
          "length. A force T/10 along x and moments of T act at one end, "
          "T rises to its peak at 2.5 s and is zero after 5 s. Plane: EI = 100, peak 80, moment -T about z. Space: EI "
          "= GJ = 500, peak 200, moments -T/2 about y and -T about z. "
          "Beam elements, rho = 0.9; step and elements are halved together.",
    long=True,
    studies=[
        Study("In the plane, 10 s", plane, [16, 32, 64], [
            Quantity("ends", "x, y of both ends", "m", **rows("plane_100.10", "xy"), source=EXACT, tolerance=2e-2,
                     order=2, order_within=0.15,
                     reason="bending waves of 10 rad/s: (w h)^2/12 of a way of 20 m at h = 5 ms"),
            Quantity("energy", "energy after the loads have gone", "J", **row("flying_spaghetti", "plane_100.energy"),
                     source=EXACT, tolerance=1e-3, relative=True,
                     reason="1e-3: the scheme removes energy of high modes, and the loads do work at the end's "
                            "velocity"),
        ], parameter="elements (step 0.32 s/elements)", by="elements"),
        Study("In space, 5 s", space, [16, 32, 64], [
            Quantity("ends", "x, y, z of both ends", "m", **rows("space.5", "xyz"), source=EXACT, tolerance=2e-2,
                     order=2, order_within=0.15,
                     reason="likewise at h = 2.5 ms, with forces 2.5 times as large"),
        ], parameter="elements (step 0.16 s/elements)", by="elements"),
    ])
