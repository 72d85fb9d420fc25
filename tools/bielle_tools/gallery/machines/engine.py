"""The engine: harmonics of the piston's acceleration against the series of the slider-crank."""

import numpy as np
from bielle_tools.gallery.machine import Check, Machine, Picture, Rows

R, RATIO, SPEED = 0.05, 0.25, 2 * np.pi * 50  # crank radius [m], crank over rod, angular velocity [rad/s]


def check(paths):
    rows = Rows(paths["engine"])
    period = 2 * np.pi / SPEED
    window = rows.time > rows.time[-1] - 3 * period - 1e-9
    time, angle = rows.time[window], rows("joints/main/coordinate")[window]
    acceleration = rows("nodes/piston/acceleration")[window, 0]
    first, second = (-2 / (3 * period) * np.trapz(acceleration * np.cos(k * angle), time) for k in (1, 2))
    series = RATIO + RATIO**3 / 4 + 15 * RATIO**5 / 128
    return [Check("first harmonic of the piston", "m/s^2", first, R * SPEED**2, 0.01, "the gas pushes shaft and rod",
                  "r omega^2"),
            Check("second harmonic of the piston", "m/s^2", second, R * SPEED**2 * series, 0.05,
                  "the gas has this order as well",
                  "r omega^2 (c + c^3/4 + 15 c^5/128), c = r/l")]


MACHINE = Machine(
    title="Engine with a flexible connecting rod",
    teaches="A solid part becomes a superelement between two bearings, a crankshaft is a beam. The stress of the "
            "rod follows from its own inertia and from the gas. One degree of freedom is left: the count of the "
            "joints is in the comments of the model.",
    bodies=["conrod"],
    runs={"engine": ["slider_crank.yaml"]},
    pictures=[Picture("engine", ["--view=z", "--from", "0.146", "--to", "0.156", "--frames", "3", "--scale", "50"])],
    page="engine",
    check=check)
