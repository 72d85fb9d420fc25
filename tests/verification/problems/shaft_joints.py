"""Universal joint, gear pair and screw, against closed forms."""

import numpy as np
from harness import Problem, Quantity, Study, vector
from harness.motions import moved

BEND = np.pi / 6
CARDAN = f"""
nodes:
  s1: {{angular_velocity: [0, 0, 10]}}
  s2: {{angular_velocity: [{10 * np.tan(BEND):.17g}, 0, 10]}}
elements:
  w1: {{type: rigid_body, node: s1, mass: 1, inertia: [0.01, 0.01, 0.01]}}
  w2: {{type: rigid_body, node: s2, mass: 1, inertia: [0.02, 0.02, 0.02]}}
joints:
  in: {{type: hinge, nodes: [ground, s1], axis: [0, 0, 1]}}
  out: {{type: hinge, nodes: [ground, s2], axis: [{np.sin(BEND):.17g}, 0, {np.cos(BEND):.17g}]}}
  cross: {{type: universal, nodes: [s1, s2], axis: [1, 0, 0], second_axis: [0, 1, 0]}}
"""
GEARS = """
nodes: {w1: {position: [0, 0, 0]}, w2: {position: [0.07, 0, 0]}}
elements:
  b1: {type: rigid_body, node: w1, mass: 1, inertia: [1e-3, 1e-3, 1e-3]}
  b2: {type: rigid_body, node: w2, mass: 1, inertia: [1e-2, 1e-2, 2e-2]}
joints:
  h1: {type: hinge, nodes: [ground, w1], axis: [0, 0, 1]}
  h2: {type: hinge, nodes: [ground, w2], axis: [0, 0, 1]}
  mesh: {type: gear_mesh, nodes: [w1, w2], axes: [0, 0, 1], radii: [0.02, 0.05]}
drives: {motor: {joint: h1, torque: 1}, load: {joint: h2, torque: 1.5}}
"""
SCREW = """
gravity: [0, 0, -9.81]
nodes: {nut: {position: [0.3, -0.2, 0.5]}}
elements: {body: {type: rigid_body, node: nut, mass: 2, inertia: [0.02, 0.02, 0.01]}}
joints: {thread: {type: screw, nodes: [ground, nut], axis: [0, 0, 1], pitch: 0.1}}
"""
ALPHA = (1 - 1.5 / 2.5) / (1e-3 + 2e-2 / 2.5**2)       # acceleration of the first wheel [rad/s^2]
TANGENTIAL = (2e-2 * ALPHA / 2.5 + 1.5) / 0.05         # force on its teeth [N]
PITCH = 0.1 / (2 * np.pi)                              # [m/rad]
NUT = 2 * 9.81 * PITCH / (0.01 + 2 * PITCH**2)         # acceleration of the nut [rad/s^2]
CONSTANT = "constant accelerations are integrated exactly: rounding and Newton's tolerance"


def cardan(step):
    session = moved(CARDAN, 2, step)
    return {"shafts": [session["joints/in/coordinate"][0], session["joints/in/rate"][0], session["joints/out/rate"][0]]}


def gears(step):
    session = moved(GEARS, 1, step)
    bearing = session["joints/h2/reaction_inertial"]
    return {"angles": [session["joints/h1/coordinate"][0], session["joints/h2/coordinate"][0]], "bearing": bearing[:2],
            "tooth": session["joints/mesh/force"][0]}


def screw(step):
    session = moved(SCREW, 1, step)
    drop, angle = session["joints/thread/coordinate"]
    force = session["joints/thread/reaction"]
    return {"way": [drop, angle], "force": [force[2], force[5]]}


PROBLEM = Problem(
    title="Universal joint, gear pair, screw",
    subject="Rigid mechanisms",
    source="H. C. Seherr-Thoss et al., Universal Joints and Driveshafts, 2nd ed. (2006), 1.2; G. Niemann, H. Winter, "
           "Maschinenelemente 2 (2003), ch. 21; "
           "subject of A. Cardona, An Integrated Approach to Mechanism Analysis, thesis, Liege 1989, ch. 3",
    model="Two flywheels on shafts bent by 30 degrees with a universal joint, free from 10 rad/s; two spur wheels "
          "with 20 and 50 teeth of module 2 mm under torques "
          "of 1 and 1.5 N m; a nut of 2 kg that runs down a vertical screw without friction, 0.1 m per turn. Rigid "
          "bodies with these joints, rho = 0.8.",
    quick=True,
    studies=[
        Study("Universal joint, 2 s", cardan, [8e-3, 4e-3, 2e-3, 1e-3], [
            Quantity("shafts", "angle and rate of the first shaft, rate of the second", "rad, rad/s",
                     **vector("universal_joint", "angle", "first_rate", "second_rate"), tolerance=1e-3, order=2,
                     source="energy J1 w1^2 + J2 w2^2 and w2/w1 = cos b/(1 - sin^2 b cos^2 th1) "
                            "(tests/references/universal_joint.py)",
                     reason="(2 w h)^2/12 of 22 rad at h = 1 ms: 7e-4"),
        ]),
        Study("Gear pair, 1 s", gears, [0.02, 0.01], [
            Quantity("angles", "angles of the wheels", "rad", [ALPHA / 2, -ALPHA / 5], source="closed form",
                     tolerance=1e-7, reason=CONSTANT),
            Quantity("tooth", "normal force of the teeth", "N", TANGENTIAL / np.cos(np.pi / 9), source="closed form",
                     tolerance=1e-7, reason=CONSTANT),
            Quantity("bearing", "force on the second bearing", "N", [-TANGENTIAL * np.tan(np.pi / 9), -TANGENTIAL],
                     source="closed form", tolerance=1e-7,
                     reason=CONSTANT),
        ]),
        Study("Screw, 1 s", screw, [0.02, 0.01], [
            Quantity("way", "displacement and angle of the nut", "m, rad", [-NUT * PITCH / 2, -NUT / 2],
                     source="closed form", tolerance=1e-8, reason=CONSTANT),
            Quantity("force", "axial force and couple of the thread", "N, N m",
                     [2 * (9.81 - NUT * PITCH), -0.01 * NUT], source="closed form", tolerance=1e-6,
                     reason=CONSTANT),
        ]),
    ])
