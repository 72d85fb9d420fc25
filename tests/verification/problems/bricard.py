"""Bricard's mechanism of the IFToMM library, whose constraints are redundant all the way."""

import numpy as np
from harness import Problem, Quantity, Study, vector
from harness.motions import EnergyDrift, axes, moved

RODS = [[1, 0, 0], [0, -1, 0], [0, 0, 1], [-1, 0, 0], [0, 1, 0]]
HINGES = ["y", "z", "x", "y", "z", "x"]
AXES = {"x": [1, 0, 0], "y": [0, 1, 0], "z": [0, 0, 1]}


def model():
    """Nodes are the middles of the rods, with inertial axes at the start."""
    nodes, elements, joints, place = {}, {}, {}, np.zeros(3)
    for k, rod in enumerate(np.array(RODS, float)):
        name = f"rod{k + 1}"
        nodes[name] = {"position": place + 0.5 * rod}
        inertia = np.where(np.abs(rod) > 0.5, 0.02 / 12, 1.01 / 12)
        elements[name] = {"type": "rigid_body", "node": name, "mass": 1, "inertia": inertia}
        joints[f"h{k + 1}"] = {"type": "hinge", "nodes": [f"rod{k}" if k else "ground", name], "axis": AXES[HINGES[k]],
                               "position": place}
        place = place + rod
    joints["h6"] = {"type": "hinge", "nodes": ["rod5", "ground"], "axis": AXES[HINGES[5]], "position": place}
    return {"gravity": [0, -9.81, 0], "nodes": nodes, "elements": elements, "joints": joints}


def swing(duration):
    """Study.compute: place of the hinge between rods 3 and 4, drift of the energy."""
    def compute(step):
        drift = EnergyDrift()
        session = moved(model(), duration, step, drift, rho=0.9)
        return {"place": session["nodes/rod3/position"] + axes(session, "rod3") @ [0, 0, 0.5], "drift": drift.largest}
    return compute


EXACT = ("chain of relative angles, projected on the one motion that the closing equations leave, DOP853 "
         "(tests/references/bricard.py)")


def quantities(name, tolerance, reason):
    return [
        Quantity("place", "hinge of rods 3 and 4", "m", **vector("bricard", f"{name}.place", components="xyz"),
                 source=EXACT, tolerance=tolerance, order=2, reason=reason),
        Quantity("drift", "largest drift of the energy", "J", 0.0, source="conservation of energy", tolerance=1e-4,
                 order=2, reason="(w h)^2/12 to (w h)^2/4 of 30 J: 2e-5 to 7e-5"),
    ]


PROBLEM = Problem(
    title="A04 Bricard's mechanism",
    subject="Rigid mechanisms",
    source="IFToMM library of computational benchmark problems, A04; M. Gonzalez et al., Multibody Syst. Dyn. 16 "
           "(2006) 179; R. Bricard (1897)",
    model="Five rods of 1 m and 1 kg, 0.1 m square, and the ground form a loop along edges of a cube, with six hinges "
          "of alternating directions; released at rest in gravity. "
          "Thirty constraints for thirty degrees of freedom leave one motion, in every position. Rigid bodies with "
          "hinges, rho = 0.9.",
    studies=[
        Study("1 s", swing(1), [4e-3, 2e-3, 1e-3], quantities("1", 1e-5,
                                                              "(w h)^2/12 to (w h)^2/4, w = 3 rad/s at 1 ms, of a way "
                                                              "of 3 m: 2e-6 to 7e-6")),
        Study("9 s", swing(9), [4e-3, 2e-3, 1e-3], quantities("9", 1e-4, "nine times the way"), accuracy="drift"),
    ])
