"""The gearbox: its ratio, the time at which its clutch engages, and its transmission error, against closed forms."""

import math

import numpy as np
from bielle_tools.gallery.machine import Check, Machine, Picture, Rows
from scipy.interpolate import CubicSpline

PAIR, PLAY = 1.4e8, 5e-5
INERTIA = 1e-2 + 2e-2 / 2.5**2 + 3.05 / 7.5**2  # seen by the input shaft [kg m^2]


def expected_error(rows, loaded, force):
    """Transmission error [m] of the first stage by its errors, half its play and its compliance."""
    turn = (rows("joints/crank/coordinate") + rows("joints/plates/coordinate"))[loaded]
    pitch = turn * 20 / (2 * math.pi) % 1
    stiffness = CubicSpline([0, 0.25, 0.45, 0.75, 1], PAIR * np.array([1.6, 1.6, 1, 1, 1.6]), bc_type="periodic")(pitch)
    errors = CubicSpline([0, 0.25, 0.75, 1], [0, 3e-6, -3e-6, 0], bc_type="periodic")(pitch)
    return errors + 8e-6 * np.sin(rows("joints/middle/coordinate")[loaded]) - PLAY / 2 - force / stiffness


def check(paths):
    rows = Rows(paths["gearbox"])
    engaged, torque = rows.event("clutch on angle engages"), 3000 * 0.3 * 0.08 * 2
    loaded = (rows.time > 0.045) & (rows.time < engaged)
    steady = (rows.time > 0.2) & (rows.time < 0.35)
    force, error = rows("joints/first/force")[loaded, 0], rows("joints/first/transmission_error")[loaded]
    ratio = rows("joints/crank/rate")[steady].mean() / rows("joints/output/rate")[steady].mean()
    return [Check("ratio", "-", ratio, 2.5 * 3, 2e-3, "teeth rattle within their play", "numbers of teeth"),
            Check("time at which the clutch engages", "s", engaged, 0.025 + INERTIA * 60 / torque, 0.01,
                  "teeth have play and yield",
                  "inertia times speed over the torque of the plates"),
            Check("mean force of the teeth, clutch slipping", "N", force.mean(), engaging_force(torque), 0.03,
                  "the teeth vibrate",
                  "torque for the inertias behind the teeth, over the base radius"),
            Check("mean transmission error of the first stage", "m", error.mean(),
                  expected_error(rows, loaded, force).mean(), 0.02,
                  "the force contains the damping of the teeth",
                  "errors, half the play, and the force over the stiffness at each angle")]


def engaging_force(torque):
    """Normal force [N] of the first pair while the clutch slips: the torque less what accelerates the input wheel."""
    return torque * (1 - 1e-2 / INERTIA) / (0.025 * math.cos(math.radians(20)))


MACHINE = Machine(
    title="Gearbox with clutch and freewheel",
    teaches="Teeth have play, errors, and a stiffness that changes with the pairs in contact: the transmission "
            "error excites the shafts. A friction clutch slips by its plates and then holds exactly; the "
            "freewheel lets the drum run on.",
    runs={"gearbox": ["gearbox.yaml"]},
    pictures=[Picture("gearbox", ["--view=z", "--from", "0.1", "--to", "0.12", "--frames", "2"]),
              Picture("gearbox", ["--quantity", "joints/first/transmission_error", "--span", "0:0.2"],
                      tool="bielle-plot",
                      figure="joints_first_transmission_error.png")],
    page="gearbox",
    check=check)
