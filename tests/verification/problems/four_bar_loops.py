"""The N-loop four-bar of the IFToMM library, which passes singular positions."""

import numpy as np
from harness import Problem, Quantity, Study, vector
from harness.motions import EnergyDrift, axes, moved


def bar(start, end, **rates):
    start, end = np.array(start, float), np.array(end, float)
    along = end - start
    return {"position": 0.5 * (start + end), "rotation_vector": [0, 0, np.arctan2(along[1], along[0])], **rates}


def model(loops):
    nodes, joints = {}, {}

    def hinge(name, first, second, at):
        joints[name] = {"type": "hinge", "nodes": [first, second], "axis": [0, 0, 1], "position": at}

    for k in range(loops + 1):
        crank, top = f"crank{k}", [k, 1, 0]
        nodes[crank] = bar([k, 0, 0], top, velocity=[0.5, 0, 0], angular_velocity=[0, 0, -1])
        hinge(f"foot{k}", "ground", crank, [k, 0, 0])
        if k:
            nodes[f"coupler{k}"] = bar([k - 1, 1, 0], top, velocity=[1, 0, 0])
            hinge(f"left{k}", f"crank{k - 1}", f"coupler{k}", [k - 1, 1, 0])
            hinge(f"right{k}", f"coupler{k}", crank, top)
    body = {"type": "rigid_body", "mass": 1, "inertia": [1e-4, 1 / 12, 1 / 12]}
    return {"gravity": [0, -9.81, 0], "nodes": nodes, "elements": {name: {**body, "node": name} for name in nodes},
            "joints": joints}


def loops(count):
    """Study.compute for a number of loops."""
    def compute(step):
        drift, skew = EnergyDrift(), [0.0]

        def look(session):
            drift(session)
            skew[0] = max(skew[0], *(np.abs(axes(session, f"crank{k}")[:, 0] - axes(session, "crank0")[:, 0]).max()
                                     for k in range(1, count + 1)))

        session = moved(model(count), 10, step, look, rho=0.9)
        top = session["nodes/crank0/position"] + 0.5 * axes(session, "crank0")[:, 0]
        return {"top": top[:2], "drift": drift.largest, "skew": skew[0]}
    return compute


def quantities(count, energy):
    return [
        Quantity("top", "end B0 of the first crank at 10 s", "m", **vector("four_bar", f"loops_{count}.top",
                                                                           components="xy"), tolerance=1e-3, order=2,
                 source="reduced equation of one angle, DOP853 (tests/references/four_bar.py)",
                 reason="five turns with a period error of (w h)^2/12, w up to 7 rad/s: 4e-6 of 31 m at 1 ms, 16e-6 "
                        "at 2 ms"),
        Quantity("drift", "largest drift of the energy within 10 s", "J", 0.0, source="conservation of energy",
                 tolerance=1e-3 * energy, order=2,
                 reason="1e-3 of the initial energy"),
        Quantity("skew", "largest difference of directions between cranks", "-", 0.0,
                 source="the motion stays on the branch of parallelograms", tolerance=1e-6,
                 reason="cranks on another branch would differ by 1"),
    ]


PROBLEM = Problem(
    title="A02 N four-bars",
    subject="Rigid mechanisms",
    source="IFToMM library of computational benchmark problems, A02; M. Gonzalez et al., Multibody Syst. Dyn. 16 "
           "(2006) 179",
    model="N + 1 vertical cranks and N couplers, thin bars of 1 m and 1 kg, in a row of N parallelograms; the top "
          "moves with 1 m/s. Whenever all bars lie in one "
          "line, the mechanism has N + 1 degrees of freedom for an instant. Rigid bodies with hinges, 3 (N + 1) "
          "redundant constraints and more, rho = 0.9.",
    long=True,
    studies=[
        Study("Two loops", loops(2), [4e-3, 2e-3, 1e-3], quantities(2, 35.835), accuracy="drift"),
        Study("Forty loops", loops(40), [4e-3, 2e-3], quantities(40, 620.3383), accuracy="drift"),
    ])
