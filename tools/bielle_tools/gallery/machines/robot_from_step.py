"""The robot arm from a STEP file: its torque at rest, and the work of its motors, against closed forms."""

import math

import numpy as np
from bielle_tools.gallery.machine import Check, Machine, Picture, Rows

G, UPPER, LOWER, MOTOR, PAYLOAD, DENSITY = 9.81, 0.6, 0.5, 3, 5, 2700


def mass(length, height, boss, bore, margin, slot, width):
    """Mass [kg] of a link: a plate with two bosses, two bores and a slot with round ends."""
    # Area of a boss within the plate.
    within = height / 2 * math.sqrt(boss**2 - height**2 / 4) + boss**2 * math.asin(height / 2 / boss)
    cut = 2 * math.pi * bore**2 + (length - 2 * margin) * 2 * slot + math.pi * slot**2
    return DENSITY * width * (length * height + 2 * (math.pi * boss**2 - within) - cut)


UPPER_MASS = mass(UPPER, 0.08, 0.06, 0.025, 0.13, 0.024, 0.05)
LOWER_MASS = mass(LOWER, 0.06, 0.045, 0.018, 0.105, 0.017, 0.04)


def moment(upper, lower):
    """Moment of the weights [N m] about the shoulder, for the shares of the links' lengths that lie across gravity."""
    return G * (UPPER_MASS * UPPER / 2 * upper + MOTOR * UPPER * upper
                + LOWER_MASS * (UPPER * upper + LOWER / 2 * lower) + PAYLOAD * (UPPER * upper + (LOWER + 0.1) * lower))


def check(paths):
    rows = Rows(paths["robot"])
    joints = [f"joints/robot.{joint}" for joint in ("base", "shoulder", "elbow")]
    power = sum(rows(joint + "/drive_force") * rows(joint + "/rate") for joint in joints)
    lifted = moment(math.sin(math.radians(45)), -math.sin(math.radians(15)))
    return [Check("torque of the shoulder at rest", "N m", rows("joints/robot.shoulder/drive_force")[0], -moment(1, 1),
                  1e-4,
                  "the mesh cuts the round bosses off by little", "weights of the drawn solids times their arms"),
            Check("work of the motors", "J", np.trapz(power, rows.time), lifted, 5e-3,
                  "the arm still vibrates at the end",
                  "weights times the lifts of their centres")]


MACHINE = Machine(
    title="Robot arm from a STEP file, and its rigid twin",
    teaches="Two solids of one STEP file become flexible links, their bores interfaces. The twin with rigid "
            "links, made by the same part of the model, makes the same motion: the measures are the deviations of "
            "the tool, a few millimetres on the way and in the vibration after the stop.",
    bodies=["robot_upper_arm", "robot_forearm"],
    runs={"robot": ["robot_from_step.yaml"]},
    pictures=[Picture("robot", ["--view", "iso", "--from", "0", "--to", "0.8", "--frames", "3"]),
              Picture("robot", ["--quantity", "along, across, droop"], tool="bielle-plot",
                      figure="along+across+droop.png")],
    page="robot",
    check=check)
