"""The mast that latches: the time at which its knee is in line, and the speed after it, against closed forms."""

import math

from bielle_tools.gallery.machine import Check, Machine, Picture, Rows
from scipy.optimize import brentq

LOWER, UPPER, OFFSET, STIFFNESS, DAMPING, REST = 2.0, 1.2, 0.06, 6.0, 0.3, math.radians(210)
OWN = (1 + 0.04**2) / 12 * LOWER, (1 + 0.03**2) / 12 * UPPER  # moments of inertia about the centres [kg m^2]
ABOUT_KNEE = OWN[1] + UPPER * (0.25 + (OFFSET / 2)**2)


def unfolded():
    """Time [s] and rate [rad/s] at which the upper link has turned by half a turn: a damped oscillation."""
    omega, ratio = math.sqrt(STIFFNESS / ABOUT_KNEE), DAMPING / (2 * math.sqrt(STIFFNESS * ABOUT_KNEE))
    damped = omega * math.sqrt(1 - ratio**2)

    def angle(t):
        swing = math.cos(damped * t) + ratio * omega / damped * math.sin(damped * t)
        return REST - REST * math.exp(-ratio * omega * t) * swing

    time = brentq(lambda t: angle(t) - math.pi, 1e-3, math.pi / damped)
    return time, REST * math.exp(-ratio * omega * time) * omega**2 / damped * math.sin(damped * time)


def check(paths):
    rows = Rows(paths["latch"])
    time, rate = unfolded()
    # The upper link turns about the knee, 1 m from the base; as the knee latches, the momentum about the base remains.
    momentum = (OWN[1] + UPPER * (0.25 + 0.5)) * rate
    mast = LOWER / 4 + OWN[0] + UPPER * 2.25 + OWN[1]
    after = int((rows.time <= rows.event("latched")).sum())
    return [Check("time at which the knee latches", "s", rows.event("latched"), 0.2 + time, 1e-3,
                  "the sling has stretched the links",
                  "damped oscillation of the upper link"),
            Check("speed of the mast after it", "rad/s", abs(rows("joints/base/rate")[after]), momentum / mast, 0.03,
                  "the row is up to a step later", "angular momentum about the base")]


MACHINE = Machine(
    title="Mast that unfolds, latches and rises",
    teaches="Events release the sling, lock the knee when it is in line, free the base and latch it upright. An "
            "inelastic impulse at each latch keeps the momentum and takes energy, which the balance counts.",
    runs={"latch": ["latch.yaml"]},
    pictures=[Picture("latch", ["--from", "0.3", "--to", "1.4", "--frames", "3"])],
    page="latch",
    check=check)
