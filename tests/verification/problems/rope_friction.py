"""Ropes that slip over a drum: the capstan equation."""

import numpy as np
from harness import Problem, Quantity, Study
from harness.motions import moved

GRAVITY, FRICTION, LIGHT, HEAVY = 9.81, 0.3, 1.0, 10.0
CAPSTAN = np.exp(FRICTION * np.pi)
ACCELERATION = GRAVITY * (HEAVY - CAPSTAN * LIGHT) / (HEAVY + CAPSTAN * LIGHT)
TIME = 0.3


def model(first, second):
    """Two masses on a rope over half of a drum of 0.1 m that is held."""
    free = {"fixed": ["x", "y", "rx", "ry", "rz"]}
    return {"gravity": [0, 0, -GRAVITY],
            "nodes": {"a": {"position": [-0.1, 0, -1], **free}, "drum": {"fixed": True},
                      "b": {"position": [0.1, 0, -1], **free}},
            "elements": {"a": {"type": "point_mass", "node": "a", "mass": first},
                         "b": {"type": "point_mass", "node": "b", "mass": second}},
            "joints": {"rope": {"type": "cable", "nodes": ["a", "drum", "b"], "radii": [0, 0.1, 0], "axis": [0, 1, 0],
                                "EA": 1e6, "damping": 1e-3, "friction": FRICTION}}}


def slip(side):
    """Mean ratio of the tensions after the first oscillations of the rope, and the way that it has slipped."""
    masses, node = ((LIGHT, HEAVY), "a") if side == "a" else ((HEAVY, LIGHT), "b")
    ratios = []

    def look(session):
        if session.time > 0.1:
            tensions = session["joints/rope/tension"]
            ratios.append(max(tensions) / min(tensions))

    session = moved(model(*masses), TIME, 1e-3, look)
    return {"ratio": [min(ratios), max(ratios)], "way": session.node(node).position[2] + 1}


PROBLEM = Problem(
    title="Rope that slips over a drum",
    subject="Hydraulics and friction",
    source="L. Euler (1762), J. A. Eytelwein (1808): T2 = exp(mu theta) T1",
    model="A rope over half of a fixed drum, mu = 0.3, carries 1 kg on one side and 10 kg on the other, and slips "
          "from rest for 0.3 s, to either side. EA = 1e6 N.",
    quick=True,
    studies=[Study("Tensions and way", slip, ["a", "b"], [
        Quantity("ratio", "smallest and largest ratio of the tensions after 0.1 s", "-", [CAPSTAN, CAPSTAN],
                 source="exp(mu pi)", tolerance=1e-4,
                 reason="the resistance that makes the slip unique, 1e-10 s/m EA = 1e-4 N s/m at 1 m/s, adds 1e-5 for "
                        "each of the two values"),
        Quantity("way", "way of the light mass", "m", 0.5 * ACCELERATION * TIME**2,
                 source="m2 (g - a) = exp(mu pi) m1 (g + a)", tolerance=3e-4,
                 reason="the rope becomes longer by 1e-4 m under its loads, and oscillates about this"),
    ], parameter="side of the light mass", by="")])
