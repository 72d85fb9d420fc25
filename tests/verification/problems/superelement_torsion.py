"""Torsion of a round bar, which is exact in three dimensions."""

import h5py
import numpy as np
from harness import Problem, Quantity, Study
from harness.bodies import STEEL, cylinder, reduced


def torsion(size):
    """The fixed-boundary mode between the first and the second bending mode, at 210 and 1056 Hz."""
    path = reduced("cylinder", cylinder(1, 0.15), mesh={"order": 2, "size": size},
                   interfaces={"root": {"surface": "root"}}, modes={"count": 4})
    with h5py.File(path) as file:
        frequencies = file["modes/frequencies"][:]
    found = frequencies[(frequencies > 400) & (frequencies < 1000)]
    return {"frequency": found[0] if len(found) == 1 else np.nan}


EXACT = np.sqrt(STEEL["young"] / 2.6 / STEEL["density"]) / 4
PROBLEM = Problem(
    title="Torsional vibration of a round bar",
    subject="Solids and superelements",
    source="A. E. H. Love, A Treatise on the Mathematical Theory of Elasticity (1927), art. 200: torsion of a "
           "circular cylinder is exact in three dimensions",
    model="A steel cylinder of 1 m and radius 0.15 m, one end held by a rigid tie, which does not hinder torsion. "
          "Quadratic tetrahedra of gmsh; fixed-boundary modes of "
          "bielle-reduce.",
    studies=[Study("First torsional frequency", torsion, [0.1, 0.07, 0.05], [
        Quantity("frequency", "frequency", "Hz", EXACT, source="sqrt(G/rho)/(4 L)", relative=True, tolerance=1e-4,
                 order=4, order_within=1,
                 reason="0.1 Hz of 804 Hz, far below what a tolerance of the radius changes in a bending frequency",
                 order_reason="meshes of tetrahedra are no refinements of each other, and facets of the curved "
                              "surface change with them"),
    ], parameter="size of the mesh [m]")])
