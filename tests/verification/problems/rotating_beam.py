"""Frequencies of a rotating cantilever."""

import bielle
import numpy as np
from harness import Problem, Quantity, Study, vector

SPEEDS = (1, 3, 6, 12)


def frequencies(elements):
    """First and second frequency across the plane of rotation at each speed, L = m = EI = 1, and the first one in the
    plane."""
    across, along = [], []
    for speed in SPEEDS:
        results = bielle.read({
            "nodes": {"root": {"position": [0, 0, 0], "fixed": ["x", "y", "z", "rx", "ry"],
                               "motion": {"rz": f"{speed}*t"}}, "tip": {"position": [1, 0, 0]}},
            "elements": {"beam": {"type": "beam", "nodes": ["root", "tip"], "elements": elements,
                                  "orientation": [0, 1, 0],
                                  "section": {"EA": 1e7, "GAy": 1e7, "GAz": 1e7, "GJ": 1, "EIy": 1, "EIz": 1,
                                              "mass_per_length": 1, "Jx": 1e-7, "Jy": 1e-7, "Jz": 1e-7}}},
        }).session().modes(count=4, rotation={"rate": speed, "axis": [0, 0, 1]})
        tip = list(results["eigen/nodes"]).index("tip")
        shapes = np.abs(results["eigen/displacement"][:, tip] @ [1, 1j])
        w = 2 * np.pi * np.array(results["eigen/damped_frequency"])
        flap = [w[k] for k in range(len(w)) if shapes[k, 2] > shapes[k, 1]]
        lag = [w[k] for k in range(len(w)) if shapes[k, 2] < shapes[k, 1]]
        across += flap[:2]
        along += lag[:1]
    return {"flap": across, "lag": along}


FLAP = vector("rotating_beam", *(f"{speed}.flap_{k}" for speed in SPEEDS for k in (1, 2)))
LAG = [np.sqrt(FLAP["reference"][2 * k]**2 - speed**2) for k, speed in enumerate(SPEEDS)]
EXACT = "Bernoulli beam by power series of 60 digits (tests/references/rotating_beam.py)"

PROBLEM = Problem(
    title="Frequencies of a rotating beam",
    subject="Beams in motion",
    source="A. Wright, C. Smith, R. Thresher, J. Wang, Vibration modes of centrifugally stiffened beams, J. Appl. "
           "Mech. 49 (1982) 197",
    model="A cantilever that turns about an axis through its root, eta = Omega sqrt(m L^4/EI) = 1, 3, 6, 12. "
          "Frequencies across the plane of rotation and in it, "
          "mu^2 less by eta^2. Beam elements; modes about the steady rotation with its tension. Stretch, shear and "
          "rotary inertia, which the reference leaves out, are small.",
    quick=True,
    studies=[Study("Frequencies mu = w sqrt(m L^4/EI)", frequencies, [4, 8, 16], [
        Quantity("flap", "first and second across, eta = 1, 3, 6, 12", "-", **FLAP, source=EXACT, tolerance=7e-5,
                 relative=True, order=4, order_within=0.25,
                 reason="the cubic beam's (1/16)^4 times (w^2 - tension terms) is 5e-5 at eta = 12",
                 order_reason="elements are exact in linear bending, so that the mass decides: fourth order"),
        Quantity("lag", "first in the plane", "-", LAG, source=EXACT, known_to=1e-9, tolerance=2e-4, relative=True,
                 order=4, order_within=0.25,
                 reason="six times the error across, as eta^2 is taken off", order_reason="likewise"),
    ], parameter="elements", by="elements")])
