"""The stiff flyball governor of the IFToMM library."""

import numpy as np
from harness import Problem, Quantity, Study, row
from harness.motions import moved

BAR, CUBE = 0.3, 3.0  # masses [kg]
SPIN = 2 * np.pi


def model():
    """Arms on both sides of the shaft, at 60 degrees from the downward vertical, z of their nodes along the arm."""
    arm = {"type": "rigid_body", "solid": {"box": [0.01, 0.01, 1], "density": 3000}}
    nodes = {"shaft": {"position": [0, 0, 0.5], "angular_velocity": [0, 0, SPIN]},
             "slider": {"position": [0, 0, 0.5], "angular_velocity": [0, 0, SPIN]}}
    elements = {"shaft": {**arm, "node": "shaft"}, "slider": {"type": "rigid_body", "node": "slider",
                                                              "solid": {"box": [0.1, 0.1, 0.1], "density": 3000}}}
    joints = {"shaft": {"type": "hinge", "nodes": ["ground", "shaft"], "axis": [0, 0, 1], "position": [0, 0, 0]},
              "slider": {"type": "prismatic", "nodes": ["shaft", "slider"], "axis": [0, 0, 1]}}
    for name, side in (("right", 1), ("left", -1)):
        along = np.array([side * np.sin(np.pi / 3), 0, -np.cos(np.pi / 3)])
        pivot = np.array([0.05 * side, 0, 1])
        middle, end, turning = pivot + 0.5 * along, pivot + along, np.array([0, 0, SPIN])
        tilt = {"axes": {"z": along, "y": [0, 1, 0]}}
        own = np.array([np.cross([0, 1, 0], along), [0, 1, 0], along]) @ turning
        nodes[name] = {"position": middle, **tilt, "velocity": np.cross(turning, middle), "angular_velocity": own}
        nodes[f"{name}_ball"] = {"position": end, "carried_by": name}
        elements[name] = {**arm, "node": name}
        elements[f"{name}_ball"] = {"type": "point_mass", "node": f"{name}_ball", "mass": 5}
        elements[f"{name}_rod"] = {"type": "spring_damper", "nodes": [name, "slider"],
                                   "at": [[0, 0, 0], [0.05 * side, 0, 0]], "stiffness": 8e5, "damping": 4e4,
                                   "length": 0.5}
        joints[name] = {"type": "hinge", "nodes": ["shaft", name], "axis": [0, 1, 0], "position": pivot}
    return {"gravity": [0, 0, -9.81], "nodes": nodes, "elements": elements, "joints": joints}


def govern(duration):
    """Study.compute: place of the slider, angle of the shaft."""
    def compute(step):
        session = moved(model(), duration, step)
        return {"slider": session["nodes/slider/position"][2], "turn": session.measure("shaft.angle")}
    return compute


EXACT = "three coordinates, momentum of the turn conserved, DOP853 (tests/references/flyball_governor.py)"


def quantities(name, slider, turn):
    return [
        Quantity("slider", "place s of the slider", "m", **row("flyball_governor", f"{name}.s"), source=EXACT,
                 tolerance=slider, order=2,
                 reason="(w h)^2/4 per radian, w = 6.3 rad/s at 1.25 ms, of a swing of 0.1 m"),
        Quantity("turn", "angle of the shaft", "rad", **row("flyball_governor", f"{name}.turn"), source=EXACT,
                 tolerance=turn, order=2, reason="the same share of a swing of 0.5 rad"),
    ]


PROBLEM = Problem(
    title="A05 Stiff flyball governor",
    subject="Rigid mechanisms",
    source="IFToMM library of computational benchmark problems, A05; M. Gonzalez et al., Multibody Syst. Dyn. 16 "
           "(2006) 179; data as restated by L. Tagliapietra et al., "
           "MBS benchmarks in OpenSim",
    model="A shaft that turns freely with 1 rev/s carries two arms of 1 m with balls of 5 kg, 60 degrees from the "
          "downward vertical. Their middles are connected to a slider of 3 kg "
          "on the shaft by springs of 8e5 N/m with dampers of 4e4 N s/m in place of rods, whose rates are 50 to 27 "
          "000 1/s: the problem is stiff. Rigid bodies, hinges, a "
          "prismatic joint, rho = 0.8.",
    studies=[Study("1 s", govern(1), [1e-2, 5e-3, 2.5e-3, 1.25e-3], quantities("1", 1e-4, 5e-4)),
             Study("10 s", govern(10), [1e-2, 5e-3, 2.5e-3, 1.25e-3], quantities("10", 1e-3, 5e-3), accuracy="slider")])
