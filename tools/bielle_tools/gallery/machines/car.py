"""The car: the load of its front axle against statics, and its ride frequencies against a plane car with the rates of
its wishbones."""

import math

import numpy as np
from bielle_tools.gallery.machine import Check, Machine, Picture, Rows
from bielle_tools.results import Results
from scipy.linalg import eig
from scipy.optimize import brentq

G, CHASSIS, PITCH, CENTRE, WHEELBASE = 9.81, 1200, 1500, 0.1, 2.6
LOWER, UPPER, WHEEL = 4, 2, 30
SPRING, DAMPER, FREE, TYRE, TYRE_DAMPING = 60e3, 4e3, 0.62, 200e3, 300
PIVOTS = np.array([[0.4, 0.22], [0.45, 0.45]])  # y, z of the hinges of the lower and the upper wishbone
BALLS, HUB = np.array([[0.7, 0.2], [0.66, 0.44]]), np.array([0.75, 0.32])
SEAT, TURRET = np.array([0.6, 0.207]), np.array([0.45, 0.75])


def turned(point, centre, angle):
    c, s = math.cos(angle), math.sin(angle)
    return centre + np.array([[c, -s], [s, c]]) @ (point - centre)


def corner(angle):
    """Height of the hub and length of the strut as the lower wishbone turns by an angle, the chassis being held."""
    lower = turned(BALLS[0], PIVOTS[0], angle)
    height = np.linalg.norm(BALLS[1] - BALLS[0])

    def gap(other):
        return np.linalg.norm(turned(BALLS[1], PIVOTS[1], other) - lower) - height

    upper = turned(BALLS[1], PIVOTS[1], brentq(gap, angle - 0.6, angle + 1.2))
    was, now = BALLS[1] - BALLS[0], upper - lower
    camber = math.atan2(now[1], now[0]) - math.atan2(was[1], was[0])
    hub = lower + turned(HUB - BALLS[0], np.zeros(2), camber)
    return hub[1], np.linalg.norm(turned(SEAT, PIVOTS[0], angle) - TURRET)


def wheel_rates(load):
    """Stiffness [N/m] and damping [N s/m] of a wheel relative to the chassis under a load [N] at the hub."""
    heights, lengths = np.array([corner(angle) for angle in np.linspace(-0.2, 0.2, 401)]).T
    ratio = np.gradient(lengths, heights)
    force = SPRING * (lengths - FREE) * ratio  # by which the strut presses the wheel down
    here = np.interp(load, force, heights)
    return np.interp(here, heights, np.gradient(force, heights)), DAMPER * np.interp(here, heights, ratio)**2


def ride():
    """Frequencies [Hz], sizes of the eigenvalues, of the two slowest modes of a plane car on its front and rear wheels."""
    a, b = WHEELBASE / 2 - CENTRE, WHEELBASE / 2 + CENTRE
    unsprung = 2 * (WHEEL + LOWER / 3 + UPPER / 3)
    mass = np.diag([CHASSIS, PITCH, unsprung, unsprung])
    stiffness, damping = np.zeros((4, 4)), np.zeros((4, 4))
    for wheel, arm, share in ((2, -a, b), (3, b, a)):
        k, c = wheel_rates(CHASSIS * G * share / WHEELBASE / 2)
        travel = np.zeros(4)
        travel[[0, 1, wheel]] = 1, arm, -1
        stiffness += 2 * k * np.outer(travel, travel)
        damping += 2 * c * np.outer(travel, travel)
        stiffness[wheel, wheel] += 2 * TYRE
        damping[wheel, wheel] += 2 * TYRE_DAMPING
    zero, one = np.zeros((4, 4)), np.eye(4)
    values = eig(np.block([[zero, one], [-stiffness, -damping]]), np.block([[one, zero], [zero, mass]]), right=False)
    return np.sort(np.abs(values[values.imag > 1]))[:2] / (2 * math.pi)


def check(paths):
    drive = Rows(paths["drive"], 1)
    front = -sum(drive(f"elements/front_{side}.tyre/force")[0] for side in ("left", "right"))
    expected = G * (CHASSIS * (WHEELBASE / 2 + CENTRE) / WHEELBASE + 2 * (LOWER + UPPER + WHEEL))
    with Results(paths["drive"]) as results:
        found = results.array("eigen/frequency")[:2]
    return [Check("load of the front tyres at rest", "N", front, expected, 2e-3, "the tyres stand at a small angle",
                  "moments of the weights"),
            *(Check(f"ride frequency {k + 1}", "Hz", value, closed, 0.03, "the plane car leaves out camber and scrub",
                    "plane car with the rates of its wishbones")
              for k, (value, closed) in enumerate(zip(found, ride())))]


MACHINE = Machine(
    title="Car on four double wishbones over a bump",
    teaches="One corner is written once and placed four times, the right ones as mirror images. The left wheels "
            "pass a bump one after the other; the car heaves, pitches and rolls, and comes to rest.",
    runs={"drive": ["car.yaml"]},
    pictures=[Picture("drive", ["--view", "iso", "--from", "0.4", "--to", "0.9", "--frames", "3"])],
    page="drive",
    check=check)
