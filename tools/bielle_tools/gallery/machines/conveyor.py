"""The conveyor: time and way of the sliding crate, its creep, and the work of the belt, by Coulomb's law."""

import math

import numpy as np
from bielle_tools.gallery.machine import Check, Machine, Picture, Rows

G, SLOPE, SPEED, FRICTION, SLIP, MASS, WAY = 9.81, math.radians(8), 1.5, 0.4, 1e-3, 40, 3
ACCELERATION = G * (FRICTION * math.cos(SLOPE) - math.sin(SLOPE))
SLIDING = SPEED / ACCELERATION           # [s]
SLID = SPEED**2 / (2 * ACCELERATION)     # [m]
CREEP = SLIP * math.atanh(math.tan(SLOPE) / FRICTION)  # [m/s] of friction that is smooth near rest


def work():
    """Energy [J] from the belt: its force times its speed, while the crate slides, and while it is carried."""
    carried = (WAY - SLID) / (SPEED - CREEP)
    return MASS * G * SPEED * (FRICTION * math.cos(SLOPE) * SLIDING + math.sin(SLOPE) * carried)


def check(paths):
    rows = Rows(paths["run"])
    speed = rows("measures/speed_of_crate")
    slid = np.interp(SLIDING, rows.time, rows("measures/way"))
    return [Check("time until 99 % of the speed of the belt", "s", rows.event("carried"), 0.99 * SLIDING, 1e-3,
                  "the crate rocks a little on its corners", "mu m g cos(slope) less the component of the weight"),
            Check("way of the sliding crate", "m", slid, SLID, 1e-3, "friction falls off below 1 mm/s, and the crate rocks",
                  "speed^2/(2 a)"),
            Check("time of arrival", "s", rows.event("arrived"), SLIDING + (WAY - SLID) / (SPEED - CREEP), 2e-4,
                  "the same", "sliding and carried ways"),
            Check("creep of the carried crate", "m/s", SPEED - speed[-1], CREEP, 1e-3, "the crate is at rest on the belt",
                  "slip speed atanh(tan(slope)/mu) of the law of friction"),
            Check("energy from the belt", "J", rows("energy/input")[-1], work(), 1e-3, "the crate rocks a little",
                  "force of friction times speed of the belt")]


MACHINE = Machine(
    title="Crate on a conveyor that climbs",
    teaches="A contact surface moves its material without moving itself. The crate slides until it has the speed of "
            "the belt; half of the energy that accelerates it becomes heat. Then it is carried, against its weight.",
    runs={"run": ["conveyor.yaml"]},
    pictures=[Picture("run", ["--view=-y", "--from", "0", "--to", "2.2", "--frames", "3", "--size", "640x480"]),
              Picture("run", ["--quantity", "speed_of_crate"], tool="bielle-plot", figure="speed_of_crate.png")],
    page="run",
    check=check)
