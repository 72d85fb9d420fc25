"""The kart on four tyres: loads in its turn and deceleration by its brakes, against momentum."""

import math

import numpy as np
from bielle_tools.gallery.machine import Check, Machine, Picture, Rows

G, SLOPE, MASS, TRACK, RADIUS = 9.81, 0.08, 150 + 2 * 1 + 4 * 4, 1.1, 0.13
TYRES = ("front_left", "front_right", "rear_left", "rear_right")
HEIGHT = (150 * 0.2 + 18 * (RADIUS - 3.6e-3)) / MASS  # height of the centre of mass [m]
SPIN, BRAKE, RESISTANCE = 0.02, 30, 0.015             # inertia of a wheel about its axle; torque; force over load


def check(paths):
    run = Rows(paths["run"], 1)
    load = {tyre: run(f"joints/{tyre}.tyre/normal_force") for tyre in TYRES}
    velocity, at = run("nodes/chassis/velocity"), lambda t: int(np.argmin(abs(run.time - t)))
    turning, early, late = at(2.8), at(5), at(7)
    v = velocity[turning]
    speed, heading = math.hypot(v[0], v[1]), math.atan2(v[1], v[0])
    moved = (load["front_right"] + load["rear_right"] - load["front_left"] - load["rear_left"])[turning] * TRACK / 2
    sideways = speed * v[5] + G * math.sin(SLOPE) * math.sin(heading)
    slowed = (np.linalg.norm(velocity[early, :2]) - np.linalg.norm(velocity[late, :2])) / 2
    heading = math.atan2(velocity[late, 1], velocity[late, 0])
    brakes = 2 * BRAKE / RADIUS + RESISTANCE * MASS * G - MASS * G * math.sin(SLOPE) * math.cos(heading)
    held = sum(run(f"joints/{tyre}.tyre/reaction_inertial")[-1, 0] for tyre in load)
    moment = MASS * sideways * HEIGHT + 4 * SPIN * speed / RADIUS * v[5]
    return [Check("moment of the tyres' loads in the turn", "N m", moved, moment, 0.02,
                  "the kart slides outwards and leans a little",
                  "centrifugal force at the centre of mass, gyroscopic moments"),
            Check("deceleration by the brakes", "m/s^2", slowed, brakes / (MASS + 4 * SPIN / RADIUS**2), 0.02,
                  "the rolling radius is less than that of the unloaded tyre",
                  "torque over radius, slope, rolling resistance"),
            Check("force of the standing tyres along the slope", "N", held, -MASS * G * math.sin(SLOPE), 0.02,
                  "the last swing on the treads", "component of the weight")]


MACHINE = Machine(
    title="Kart that turns, brakes and stands on a slope",
    teaches="Four tyres are all that holds a kart on its road: their slip makes it turn, the outer ones bear more, "
            "the brakes slow it until the wheels stand, and the treads hold it on the slope without creeping.",
    runs={"run": ["kart.yaml"]},
    pictures=[Picture("run", ["--view", "iso", "--from", "1", "--to", "3.4", "--frames", "3",
                              "--follow", "chassis", "--size", "640x480", "--hide", "joints/*_kingpin"]),
              Picture("run", ["--quantity", ", ".join(f"load.{tyre}" for tyre in TYRES)], tool="bielle-plot",
                      figure="+".join(f"load.{tyre}" for tyre in TYRES) + ".png")],
    page="run",
    check=check)
