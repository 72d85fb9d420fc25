"""The winch: teeth that its lever winds up per turn, lift, and the angle to which it lifts before it falls back."""

import math

from bielle_tools.gallery.machine import Check, Machine, Picture, Rows

G, LOAD, RADIUS, LEVER, CRANK, AWAY, PITCH = 9.81, 100, 0.15, 0.5, 0.12, 0.7, 2 * math.pi / 30
CLUTCH, ROPE = 5e4, 5e5  # stiffness of the clutch [N m/rad], EA of the rope [N]
TURNS = 5


def swing():
    """Angle [rad] between the dead centres of the lever. There the rod and the crank are in line, so that the eye is at the
    length of the rod more or less the crank from the crank's axis: the law of cosines gives the lever's angle."""
    rod, base = AWAY - CRANK, math.hypot(AWAY, LEVER)
    angles = [math.acos((LEVER**2 + base**2 - far**2) / (2 * LEVER * base)) for far in (rod + CRANK, rod - CRANK)]
    return angles[0] - angles[1]


def teeth():
    """Teeth of one turn: whole ones alone are kept, also of the swing less the twist of the loaded clutch."""
    return math.floor((swing() - LOAD * G * RADIUS / CLUTCH) / PITCH)


def check(paths):
    rows = Rows(paths["run"])
    wound = TURNS * teeth() * PITCH
    # The hanging rope becomes shorter, and its elongation with it.
    lift = wound * RADIUS * (1 + LOAD * G / ROPE)
    largest = (TURNS - 1) * teeth() * PITCH + swing() - LOAD * G * RADIUS / CLUTCH
    return [Check("angle of the drum after five turns", "rad", rows("joints/drum/coordinate")[-1], wound, 1e-6,
                  "the pawl is rigid", "whole teeth of the swing of a four-bar"),
            Check("lift of the load", "m", rows("measures/lift")[-1], lift, 1e-4, "the load still swings on its rope",
                  "radius times angle, less elongation"),
            Check("largest angle of the drum", "rad", rows("joints/drum/coordinate").max(), largest, 1e-3,
                  "the load swings, and twists the clutch", "swing of a four-bar, twist of the clutch")]


MACHINE = Machine(
    title="Winch with a ratchet",
    teaches="A crank swings a lever. A one-way clutch takes the drum along in one direction, and a ratchet holds it on "
            "the way back: each turn winds up the whole teeth of the swing.",
    runs={"run": ["winch.yaml"]},
    pictures=[Picture("run", ["--view=-y", "--from", "0", "--to", "1.2", "--frames", "2", "--size", "640x480"]),
              Picture("run", ["--quantity", "lift, drum.angle"], tool="bielle-plot", figure="lift+drum.angle.png")],
    page="run",
    check=check)
