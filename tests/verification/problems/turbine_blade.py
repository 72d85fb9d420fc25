"""Frequencies of the blade of the NREL 5 MW turbine."""

import bielle
import numpy as np
from harness import Problem, Quantity, Study, vector
from harness.turbine import RATED, clamped_blade


def frequencies(elements):
    """The first five frequencies of bending at rest and at the rated speed, and those of torsion."""
    at = {}
    for name, rate in (("rest", 0.0), ("rated", float(RATED))):
        session = bielle.read(clamped_blade(rate, elements // 48)).session()
        rotation = {"rate": rate, "axis": [1, 0, 0]} if rate else None
        at[name] = np.array(session.modes(count=6, rotation=rotation)["eigen/damped_frequency"])[:6]
    return {"rest": at["rest"][:5], "rated": at["rated"][:5], "torsion": [at["rest"][5], at["rated"][5]]}


INDEPENDENT = "finite elements of degree 4 in numpy (tests/references/turbine_blade.py)"
PROBLEM = Problem(
    title="Blade of the NREL 5 MW turbine",
    subject="Beams in motion",
    source="J. Jonkman, S. Butterfield, W. Musial, G. Scott, Definition of a 5-MW reference wind turbine for offshore "
           "system development, NREL/TP-500-38060 (2009), table 2-1",
    model="The blade of 61.5 m with its 49 sections and twist, clamped in a hub of 1.5 m, at rest and at 12.1 rpm, "
          "without gravity and cone; shear is rigid. One beam with a linear taper between two stations. The tension of "
          "the rotation stretches the blade by up to 4e-4, which lowers the frequencies.",
    studies=[Study("Frequencies", frequencies, [48, 96, 192], [
        Quantity("rest", "five of bending at rest", "Hz",
                 **vector("turbine_blade", *(f"rest.{k}" for k in range(1, 6))), source=INDEPENDENT, tolerance=5e-5,
                 relative=True,
                 reason="fourth order: the fifth mode has a wave of 30 m, (2 pi 2/30)^4/720 = 4e-5 for h = 2 m"),
        Quantity("rated", "five of bending at 12.1 rpm", "Hz",
                 **vector("turbine_blade", *(f"rated.{k}" for k in range(1, 6))), source=INDEPENDENT, tolerance=1e-4,
                 relative=True, reason="likewise, and 5e-5 of the reference"),
        Quantity("torsion", "torsion at rest and at 12.1 rpm", "Hz", **vector("turbine_blade", "rest.6", "rated.6"),
                 source=INDEPENDENT, tolerance=2e-4, relative=True, order=2,
                 reason="strains of torsion are constant: (w h/c)^2/24 = 7e-5, c = sqrt(GJ/J) = 430 m/s, h = 0.5 m"),
    ], parameter="elements", by="elements")])
