"""The weak instability of Newmark's rule: growth of the force's error per revolution, and its cure."""

import math

import numpy as np
from bielle_tools.gallery.machine import Check, Machine, Picture, Rows

FORCE = 4 * math.pi**2  # [N] m L omega^2


def errors(path):
    """Largest error of the pivot's force [N] in each of four revolutions of 1 s."""
    rows = Rows(path)
    force = np.linalg.norm(rows("joints/pivot/reaction")[:, :3], axis=1)
    turn = np.minimum(rows.time.astype(int), 3)
    return [np.abs(force - FORCE)[turn == k].max() for k in range(4)], force[-1]


def check(paths):
    growing, _ = errors(paths["newmark"])
    _, force = errors(paths["hht"])
    return [Check("exponent of the growth per revolution", "-", math.log(growing[2] / growing[0]) / 2, 2 * math.pi,
                  0.01,
                  "envelopes by whole revolutions", "2 pi (Cardona and Geradin, 1989)"),
            Check("force of the pivot with dissipation", "N", force, FORCE, 0.005, "error of the scheme, (omega h)^2",
                  "m L omega^2")]


MACHINE = Machine(
    title="Weak instability of Newmark's rule",
    teaches="A mass on a circle needs a constant force. Newmark's rule without dissipation lets the smallest "
            "error of the constraint force grow 535 times with each revolution while the motion looks right. A "
            "little dissipation, or the default form of the constraints, prevents it.",
    runs={"newmark": ["weak_instability.yaml"], "hht": ["weak_instability.yaml", "--set", "alpha=0.1"]},
    pictures=[Picture("newmark", ["--quantity", "pivot.reaction.norm"], tool="bielle-plot",
                      figure="pivot.reaction.norm.png")],
    page="newmark",
    check=check)
