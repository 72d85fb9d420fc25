"""A rigid slider-crank: kinematics, inverse dynamics and free motion."""

import bielle
import numpy as np
from harness import Problem, Quantity, Study, row
from harness.motions import moved

MODEL = """
nodes:
  crank: {position: [0, 0, 0], angular_velocity: [0, 0, 150]}
  pin: {position: [0.15, 0, 0]}
  rod: {position: [0.30, 0, 0], velocity: [0, 11.25, 0], angular_velocity: [0, 0, -75]}
  slider: {position: [0.45, 0, 0]}
elements:
  crank: {type: rigid_body, node: crank, mass: 0.36, inertia: [0.0014, 0.0014, 0.002727], also: [pin]}
  rod: {type: rigid_body, node: rod, mass: 0.151104, inertia: [1e-6, 0.00113328, 0.00113328]}
  slider: {type: point_mass, node: slider, mass: 0.075552}
joints:
  main: {type: hinge, nodes: [ground, crank], axis: [0, 0, 1]}
  big_end: {type: hinge, nodes: [pin, rod], axis: [0, 0, 1], position: [0.15, 0, 0]}
  wrist: {type: hinge, nodes: [rod, slider], axis: [0, 0, 1]}
  guide: {type: prismatic, nodes: [ground, slider], axis: [1, 0, 0]}
"""
DRIVEN = MODEL + "drives: {motor: {joint: main, angle: '150*t'}}\n"
EXACT = "Newton and Euler's equations of the three bodies (tests/references/slider_crank.py)"


def free(step):
    return {"slider": moved(MODEL, 0.1, step, rho=0.9)["nodes/slider/position"][0]}


def driven(degrees):
    """Inverse dynamics at one angle of the crank."""
    results = bielle.read(DRIVEN).session().inverse_dynamics(np.radians(90) / 150, np.radians(1) / 150)
    a, r, l = np.radians(degrees), 0.15, 0.3
    exact = r * np.cos(a) + np.sqrt(l * l - (r * np.sin(a))**2)
    return {"torque": results["joints/main/drive_force"][degrees, 0] / row("slider_crank",
                                                                           f"torque_{degrees}")["reference"],
            "slider": results["nodes/slider/position"][degrees, 0] / exact}


PROBLEM = Problem(
    title="Rigid slider-crank",
    subject="Rigid mechanisms",
    source="data of the problem 'crank' of the Test Set for IVP Solvers: B. Simeon, Math. Model. Syst. 2 (1996) 1",
    model="Crank 0.15 m, thin rod 0.30 m of 0.151 kg, slider 0.0756 kg, 150 rad/s, without gravity. Rigid bodies, "
          "hinges and a guide in space (redundant constraints); "
          "freely moving for 0.1 s (rho = 0.9), or driven at constant speed.",
    quick=True,
    studies=[
        Study("Free motion, 0.1 s", free, [2e-4, 1e-4, 5e-5, 2.5e-5], [
            Quantity("slider", "place of the slider", "m", **row("slider_crank", "free.slider"), source=EXACT,
                     tolerance=2e-5, order=2,
                     reason="(w h)^2/12 to (w h)^2/4 of a way of 15 rad times 0.15 m: 3e-6 to 8e-6"),
        ]),
        Study("Inverse dynamics at 150 rad/s", driven, [30, 90], [
            Quantity("slider", "place of the slider over its closed form", "-", 1.0,
                     source="x = r cos a + sqrt(l^2 - r^2 sin^2 a)", tolerance=1e-11,
                     reason="rounding and Newton's tolerance"),
            Quantity("torque", "torque of the drive over its reference", "-", 1.0, known_to=1e-10, source=EXACT,
                     tolerance=1e-8,
                     reason="no integration: rounding and Newton's tolerance"),
        ], parameter="angle of the crank [degrees]", by=""),
    ])
