"""The delta robot: the angle of a motor against the closed form of its inverse kinematics."""

import math

import numpy as np
from bielle_tools.gallery.machine import Check, Machine, Picture, Rows

BASE, PLATFORM, ARM, ROD, DROOP = 0.2, 0.05, 0.25, 0.6, math.radians(30)


def motor_angle(place):
    """Angle [rad] of the first motor below the horizontal: rods reach from its arm, in the plane y = 0, to a place."""
    x, y, z = place
    reach = x + PLATFORM - BASE
    ratio = (reach**2 + y**2 + z**2 + ARM**2 - ROD**2) / (2 * ARM)
    return math.atan2(-z, reach) - math.acos(ratio / math.hypot(reach, z))


def check(paths):
    rows = Rows(paths["delta"])
    depth = -(ARM * math.sin(DROOP) + math.sqrt(ROD**2 - (BASE + ARM * math.cos(DROOP) - PLATFORM)**2))
    s = np.clip((rows.time - 0.2) / 1, 0, 1)
    way = 2 * math.pi * (10 * s**3 - 15 * s**4 + 6 * s**5)
    expected = [motor_angle((0.08 * math.sin(phi), 0.08 * (1 - math.cos(phi)), depth)) - DROOP for phi in way]
    angle = rows("joints/arm_1.motor/coordinate")
    worst = int(np.argmax(np.abs(angle - expected)))
    largest = int(np.argmax(np.abs(expected)))
    return [Check("largest angle of a motor", "rad", angle[largest], expected[largest], 1e-9, "both are exact",
                  "inverse kinematics in closed form"),
            Check("angle where it deviates most", "rad", angle[worst] + DROOP, expected[worst] + DROOP, 1e-9,
                  "both are exact",
                  "inverse kinematics in closed form")]


MACHINE = Machine(
    title="Delta robot along a circle",
    teaches="One arm is written once and placed three times. The platform's motion is prescribed and the torques "
            "of the motors are sought: inverse dynamics of closed loops, without integration.",
    runs={"delta": ["delta_robot.yaml"]},
    pictures=[Picture("delta", ["--view", "iso", "--from", "0.4", "--to", "1", "--frames", "3"])],
    page="delta",
    check=check)
