"""The landing gear: its touch-down and its stroke at rest, against free fall and the law of its gas."""

import math

import numpy as np
from bielle_tools.gallery.machine import Check, Machine, Picture, Rows

G, MASS, SINK = 9.81, 2400, 2.5
AREA, PRECHARGE, VOLUME, AMBIENT, EXPONENT = 6e-3, 1.3e6, 2.5e-3, 101325, 1.1
LEG = 7850 * math.pi * (0.07**2 - 0.06**2) * 0.6  # [kg]
RADIUS, SPEED, INERTIA, FRICTION = 0.32, 50, 1.1, 0.7


def check(paths):
    drop, rest = Rows(paths["drop"], 1), Rows(paths["drop"], 2)
    weight = (MASS + LEG) * G
    stroke = VOLUME / AREA * (1 - (PRECHARGE / (weight / AREA + AMBIENT))**(1 / EXPONENT))
    # Until the wheel rolls, the moment of friction takes its momentum. Friction acts in the middle of the depth.
    rolls = int(np.argmax(drop("measures/slip") > -1)) + 1
    moment = FRICTION * drop("measures/load") * (RADIUS + drop("nodes/wheel/position")[:, 2]) / 2
    impulse = np.trapz(moment[:rolls], drop.time[:rolls])
    momentum = INERTIA * (drop("nodes/wheel/velocity")[rolls - 1, 4] + SPEED / RADIUS)
    return [Check("fall until touch-down", "s", drop.event("touch_down") - 0.1, SINK / G, 2e-3,
                  "the strut hangs 0.4 mm into its stop",
                  "sink speed over g"),
            Check("stroke at rest", "m", rest("joints/strut/coordinate")[-1], stroke, 1e-5, "equilibrium",
                  "polytropic law of the gas under the weight"),
            Check("moment of friction over the spin-up", "N m s", impulse, momentum, 0.01,
                  "trapezoidal rule over the rows",
                  "change of the wheel's momentum")]


MACHINE = Machine(
    title="Landing gear at touch-down",
    teaches="A drop test: the fall, the strut with its gas spring and its oil, and a wheel that the floor drags "
            "up to speed. The leg bends aft while the wheel slips and springs back when it rolls. Steps shorten "
            "for the impact and lengthen after it.",
    runs={"drop": ["landing_gear.yaml"]},
    pictures=[Picture("drop", ["--analysis", "1", "--view", "iso", "--from", "0", "--to", "0.6", "--frames", "3",
                      "--hide", "joints/*", "--hide", "ground"]),
              Picture("drop", ["--analysis", "1", "--quantity", "load, drag"], tool="bielle-plot",
                      figure="load+drag.png")],
    page="drop",
    check=check)
