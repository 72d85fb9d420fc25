"""Water hammer in a pipe whose end is closed: Joukowsky's rise of pressure."""

import numpy as np
from harness import Problem, Quantity, Study
from harness.motions import moved

LENGTH, DIAMETER, WALL, YOUNG, BULK, DENSITY, SPEED, START = 10.0, 0.02, 0.002, 2e11, 2.2e9, 1000.0, 0.5, 2e6
SOUND = np.sqrt(BULK / DENSITY / (1 + BULK * DIAMETER / (YOUNG * WALL)))  # Korteweg's speed [m/s]
AREA = np.pi * DIAMETER**2 / 4
BEGIN, CLOSING = 0.3, 5e-4
PASSAGE = LENGTH / SOUND


def model(cells):
    """A reservoir, a pipe and an outlet whose flow comes to 0.5 m/s within 0.2 s and is stopped within 0.5 ms."""
    outflow = f"-{SPEED * AREA!r}*step(t, 0, 0.2) + {SPEED * AREA!r}*step(t, {BEGIN}, {BEGIN + CLOSING})"
    return {"hydraulics": {
        "ambient_pressure": 0, "fluid": {"bulk_modulus": BULK, "density": DENSITY, "viscosity": 1e-6},
        "junctions": ["end"],
        "supplies": {"reservoir": {"pressure": START}, "out": {"to": "end", "flow": outflow}},
        "lines": {"main": {"from": "reservoir", "to": "end",
                           "pipe": {"length": LENGTH, "diameter": DIAMETER, "cells": cells, "pressure": START,
                                    "wall": {"thickness": WALL, "young": YOUNG}}}}}}


def hammer(cells):
    """Rises of the pressure at the closed end, means while the first wave and its reflection are on the way."""
    times, rises = [], []

    def look(session):
        times.append((session.time - BEGIN - CLOSING) / PASSAGE)
        rises.append(session["hydraulics/end/pressure"] - START)

    moved(model(cells), BEGIN + 4 * PASSAGE, 2.5e-4 * 40 / cells, look, rho=0.6)
    times, rises = np.array(times), np.array(rises)
    means = [rises[(times > low) & (times < high)].mean() for low, high in ((0.3, 1.7), (2.4, 3.6))]
    return {"rises": np.array(means) / (DENSITY * SOUND * SPEED)}


PROBLEM = Problem(
    title="Water hammer",
    subject="Hydraulics and friction",
    source="N. Joukowsky (1898); D. J. Korteweg (1878), for the elastic wall; E. B. Wylie, V. L. Streeter, Fluid "
           "Transients in Systems (1993), ch. 1: method of characteristics",
    model="Water flows with 0.5 m/s through 10 m of steel pipe, 20 mm, wall 2 mm, and is stopped at the end within "
          "0.5 ms. The pressure there rises by rho a w, until the reflection of the reservoir comes back after 2 L/a, "
          "and falls by as much below that of the reservoir for the next 2 L/a: the characteristics without friction. "
          "A pipe of cells, rho = 0.6.",
    studies=[Study("Rise and fall at the closed end, over rho a w", hammer, [50, 100, 200], [
        Quantity("rises", "mean of the rise in the first 2 L/a, and in the second", "-", [1.0, -1.0],
                 source="rho a w, -rho a w", tolerance=5e-3,
                 reason="friction at a viscosity of 1e-6 m^2/s: lambda L/d w/(2 a) with lambda = 0.03 is 2.7e-3 for "
                        "each passage; waves behind the front average out"),
    ], parameter="cells of the pipe", by="elements")])
