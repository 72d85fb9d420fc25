#!/usr/bin/python3
"""Optimisation: the links of a four-bar whose coupler point runs through given places, by scipy.optimize.

    PYTHONPATH=build/release/python mechanism/python/examples/optimisation.py

The crank turns once and its angle is given at each place (a synthesis with prescribed timing). Nothing has mass: the
analysis is kinematic. The model is a dictionary, made anew for each set of lengths, since these determine the places of
the joints.

                 coupler point
                 o
               /   \\
         B o---------o C
          /           \\
       A o . . . . . . o D      AB crank, BC coupler, CD rocker, AD ground (1 m)
"""

import numpy as np
from scipy.optimize import least_squares

import bielle

PLACES = 24  # on a turn of the crank
NAMES = ["crank", "coupler", "rocker", "along", "across"]  # [m]; the last two: of the coupler point from B, along and across BC
START = [0.25, 0.9, 0.9, 0.5, 0.2]
LIMITS = [0.1, 0.75, 0.75, 0.0, 0.0], [0.4, 1.5, 1.5, 1.5, 1.0]  # within them the crank can turn round


def closing(B, D, coupler, rocker):
    """The point C above the line BD, at these distances from its ends."""
    span = np.linalg.norm(D - B)
    e = (D - B) / span
    x = (span**2 + coupler**2 - rocker**2) / (2 * span)
    return B + x * e + np.sqrt(coupler**2 - x**2) * np.array([-e[1], e[0]])


def coupler_path(crank, coupler, rocker, along, across, angles):
    """The path of the coupler point in closed form, (n,2) [m]."""
    places = []
    for angle in angles:
        B = crank * np.array([np.cos(angle), np.sin(angle)])
        e = (closing(B, np.array([1.0, 0.0]), coupler, rocker) - B) / coupler
        places.append(B + along * e + across * np.array([-e[1], e[0]]))
    return np.array(places)


def four_bar(crank, coupler, rocker, along, across):
    """The model, drawn with the crank along x. Each link is a node; the node of the coupler is at the coupler point."""
    B, D = np.array([crank, 0.0]), np.array([1.0, 0.0])
    C = closing(B, D, coupler, rocker)
    e = (C - B) / coupler
    point = B + along * e + across * np.array([-e[1], e[0]])

    def hinge(first, second, place):
        return {"type": "hinge", "nodes": [first, second], "position": [*place, 0], "axis": [0, 0, 1]}

    return {
        "mechanism": "a four-bar",
        "nodes": {"crank": {"position": [*B, 0]}, "coupler": {"position": [*point, 0]}, "rocker": {"position": [*C, 0]}},
        "joints": {"A": hinge("ground", "crank", [0, 0]), "B": hinge("crank", "coupler", B), "C": hinge("coupler", "rocker", C),
                   "D": hinge("ground", "rocker", D)},
        "drives": {"motor": {"joint": "A", "angle": "2*pi*t"}},
    }


def computed(lengths):
    """Path of the coupler point (PLACES,2) [m]."""
    turn = bielle.read(four_bar(*lengths)).session().kinematics(duration=1, step=1 / PLACES)
    return turn["nodes/coupler/position"][:PLACES, :2]


def synthesise(wanted, start=START):
    """Lengths whose path is nearest to the places (PLACES,2) [m], and the largest remaining distance [m]."""
    fit = least_squares(lambda lengths: (computed(lengths) - wanted).ravel(), start, bounds=LIMITS, x_scale=0.1, xtol=1e-12, ftol=1e-12,
                        gtol=1e-12)
    return fit.x, np.linalg.norm(fit.fun.reshape(-1, 2), axis=1).max()


if __name__ == "__main__":
    target = coupler_path(0.32, 1.05, 0.85, 0.6, 0.45, 2 * np.pi * np.arange(PLACES) / PLACES)
    found, missed = synthesise(target)
    print(", ".join(f"{name} {length:.6f}" for name, length in zip(NAMES, found)) + f" [m]; within {missed:.1g} m of all places")
