"""A four-bar that is released under gravity."""

import numpy as np
from harness import Problem, Quantity, Study, row, vector
from harness.motions import axes, moved

A, D, COUPLER, ROCKER = np.zeros(2), np.array([1.0, 0.0]), 0.9, 0.7
B = 0.3 * np.array([np.cos(np.pi / 3), np.sin(np.pi / 3)])


def end_of_rocker():
    """The upper one of the two points at the lengths of coupler and rocker from B and D."""
    apart = np.linalg.norm(D - B)
    along = (D - B) / apart
    a = (COUPLER**2 - ROCKER**2 + apart**2) / (2 * apart)
    return B + a * along + np.sqrt(COUPLER**2 - a**2) * np.array([-along[1], along[0]])


def model():
    C = end_of_rocker()
    nodes, elements = {}, {}
    for name, start, end in (("crank", A, B), ("coupler", B, C), ("rocker", D, C)):
        length, angle = np.linalg.norm(end - start), np.arctan2(*(end - start)[::-1])
        J = length**3 / 12
        nodes[name] = {"position": [*(0.5 * (start + end)), 0], "rotation_vector": [0, 0, angle]}
        elements[name] = {"type": "rigid_body", "node": name, "mass": length, "inertia": [1e-3 * J, J, J]}
    hinges = {"a": ("ground", "crank", A), "b": ("crank", "coupler", B), "c": ("coupler", "rocker", C),
              "d": ("ground", "rocker", D)}
    return {"gravity": [0, -9.81, 0], "nodes": nodes, "elements": elements,
            "joints": {name: {"type": "hinge", "nodes": [first, second], "axis": [0, 0, 1], "position": [*at, 0]}
                       for name, (first, second, at) in hinges.items()}}


def release(step):
    session = moved(model(), 1, step, rho=0.9)
    return {"tip": (session["nodes/rocker/position"] + 0.5 * ROCKER * axes(session, "rocker")[:, 0])[:2],
            "crank": session.measure("a.angle") + np.pi / 3}


EXACT = "equations of motion in Cartesian coordinates of the bars, DOP853 (tests/references/four_bar.py)"
PROBLEM = Problem(
    title="Four-bar released under gravity",
    subject="Rigid mechanisms",
    source="textbook problem; data: ground 1 m, crank 0.3 m, coupler 0.9 m, rocker 0.7 m",
    model="Thin bars of 1 kg/m, the crank is released from 60 degrees, g = 9.81 m/s^2, for 1 s. Rigid bodies with "
          "four hinges in space (three redundant constraints), "
          "rho = 0.9.",
    quick=True,
    studies=[Study("Position at 1 s", release, [2e-3, 1e-3, 5e-4, 2.5e-4], [
        Quantity("crank", "angle of the crank", "rad", **row("four_bar", "released.crank"), source=EXACT,
                 tolerance=2e-5, order=2,
                 reason="(w h)^2/12 to (w h)^2/4, w up to 15 rad/s, of 5.6 rad: 7e-6 to 2e-5"),
        Quantity("tip", "end of the rocker", "m", **vector("four_bar", "released.tip", components="xy"), source=EXACT,
                 tolerance=2e-5, order=2,
                 reason="it moves at most by the way of the crank"),
    ])])
