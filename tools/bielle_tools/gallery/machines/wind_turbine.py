"""The wind turbine: a frequency of its Campbell diagram against Rayleigh's quotient, and its speed."""

import math

import numpy as np
from bielle_tools.gallery.machine import Check, Machine, Picture, Rows
from bielle_tools.results import Results

HEIGHT, ARM, OUTER, INNER, YOUNG, DENSITY = 39, 1, 0.95, 0.92, 2.1e11, 7850  # the tower; ARM: from its top to the shaft


def blade_mass():
    """Mass of a blade [kg]: a box that tapers from 1.6 x 0.45 m to 0.5 x 0.1 m."""
    s = (np.arange(4000) + 0.5) / 4000
    width, height, wall = 1.6 - 1.1 * s, 0.45 - 0.35 * s, 0.02 - 0.014 * s
    return np.mean(1900 * (width * height - (width - 2 * wall) * (height - 2 * wall))) * 18.5


def tower_sideways():
    """Frequency [Hz] of the tower across the shaft, by the deflection under a force at its top."""
    inertia, area = math.pi / 4 * (OUTER**4 - INNER**4), math.pi * (OUTER**2 - INNER**2)
    z = (np.arange(4000) + 0.5) / 4000
    tilt = 1.5 / HEIGHT
    moved = 1 + tilt * ARM
    kinetic = DENSITY * area * HEIGHT * np.mean(((3 * z**2 - z**3) / 2)**2) + (9000 + 3 * blade_mass()) * moved**2
    kinetic += 7000 / 12 * (2**2 + 2**2) * tilt**2
    return math.sqrt(3 * YOUNG * inertia / HEIGHT**3 / kinetic) / (2 * math.pi)


def check(paths):
    with Results(paths["campbell"]) as results:
        frequencies = results.array("campbell/damped_frequency")[0]
    expected = tower_sideways()
    frequency = frequencies[np.argmin(np.abs(frequencies - expected))]
    rows = Rows(paths["run_up"])
    return [Check("tower across the shaft, at rest", "Hz", frequency, expected, 0.015,
                  "the quotient is an upper bound", "Rayleigh's quotient"),
            Check("angle at the end of the run-up", "rad", rows("joints/shaft/coordinate")[-1], math.pi * (10 - 6 / 2),
                  1e-4,
                  "the shaft is driven", "speed times (time less half the run-up)")]


MACHINE = Machine(
    title="Wind turbine with its Campbell diagram",
    teaches="One blade is written once and placed three times. While the rotor turns and the tower stands still, "
            "multiblade coordinates give the modes over the speed: the flap of the blades splits into whirls, and "
            "critical speeds are where 1P and 3P meet a mode.",
    runs={"run_up": ["wind_turbine.yaml"], "campbell": ["wind_turbine_modes.yaml"]},
    pictures=[Picture("run_up", ["--view", "iso", "--from", "6", "--to", "7", "--frames", "3"]),
              Picture("campbell", tool="bielle-plot", figure="campbell.png")],
    page="run_up",
    check=check)
