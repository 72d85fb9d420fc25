"""A block on an incline: Coulomb's friction, viscous friction, and the drift of bristles."""

import numpy as np
from harness import Problem, Quantity, Study
from harness.motions import moved

MASS, GRAVITY, ANGLE = 2.0, 9.81, np.arctan(0.2)
NORMAL, PULL = MASS * GRAVITY * np.cos(ANGLE), MASS * GRAVITY * np.sin(ANGLE)
BRISTLES = {"model": "lugre", "bristle_stiffness": 2e4, "bristle_damping": 300}
SLIDES = GRAVITY * (np.sin(ANGLE) - 0.15 * np.cos(ANGLE))  # with mu = 0.15 [m/s^2]
LAG = 1 / (0.1 * GRAVITY * np.cos(ANGLE))                  # with a viscous coefficient of 0.1 s/m [s]
UP = GRAVITY * (np.sin(ANGLE) + 0.3 * np.cos(ANGLE))       # deceleration uphill with mu = 0.3 [m/s^2]
SWING, DRIFTING = 1.5 / np.cos(ANGLE), 0.29                # a slow force along the slope [N], mu


def model(friction, speed=0.0, swing=False):
    """A block whose slope falls to the right by 0.2. @param speed  down the slope"""
    down = [np.cos(ANGLE), 0, -np.sin(ANGLE)]
    loads = {"loads": {"swing": {"node": "block", "force": ["1.5*sin(2*t)", 0, "-0.3*sin(2*t)"]}}} if swing else {}
    return {"gravity": [0, 0, -GRAVITY],
            "nodes": {"block": {"velocity": [speed * each for each in down]}},
            "elements": {"block": {"type": "rigid_body", "node": "block", "mass": MASS, "inertia": [0.1, 0.1, 0.1]}},
            "joints": {"slope": {"type": "prismatic", "nodes": ["ground", "block"], "axis": [1, 0, -0.2],
                                 "friction": friction}}, **loads}


def slope(session):
    return [session["joints/slope/coordinate"][0], session["joints/slope/rate"][0]]


def sliding(step):
    return {"motion": slope(moved(model({"model": "stick_slip", "coefficient": 0.15}), 2, step))}


def viscous(step):
    return {"motion": slope(moved(model({"model": "stick_slip", "coefficient": 0.15, "viscous": 0.1}), 2, step))}


def thrown(step):
    friction = {"model": "stick_slip", "coefficient": 0.3, "static": 0.4}
    return {"motion": slope(moved(model(friction, speed=-1.5), 2, step))}


def creep(steps):
    """Way of bristles in each of the third and fourth periods of the force. @param steps  in a period"""
    places = []

    def look(session):
        places.append(session["joints/slope/coordinate"][0])

    moved(model({**BRISTLES, "coefficient": DRIFTING}, swing=True), 4 * np.pi, np.pi / steps, look)
    return {"drift": 1e6 * (places[4 * steps] - places[2 * steps]) / 2}


def viscous_motion():
    speed = SLIDES * LAG * (1 - np.exp(-2 / LAG))
    return [LAG * (2 * SLIDES - speed), speed]


def drift():
    """Way in a period by the law's own hysteresis [1e-6 m]."""
    low, high = (PULL - SWING) / (DRIFTING * NORMAL), (PULL + SWING) / (DRIFTING * NORMAL)
    return 1e6 * DRIFTING / 2e4 * (np.log((1 - low) / (1 - high)) - np.log((1 + high) / (1 + low)))


EXACT = "constant accelerations are integrated exactly: rounding and Newton's tolerance"

PROBLEM = Problem(
    title="Friction on an incline",
    subject="Hydraulics and friction",
    source="C. A. Coulomb (1785); C. Canudas de Wit et al., IEEE Trans. Automatic Control 40 (1995) 419 (LuGre); "
           "P. Dupont et al., IEEE Trans. Automatic Control 47 (2002) 787 (its drift)",
    model="A block of 2 kg on a slope of 0.2 slides with mu = 0.15, also with viscous friction, is thrown uphill with "
          "1.5 m/s against mu = 0.3, 0.4 at rest, and stays. With bristles (LuGre) and mu = 0.29 a slow force of "
          "1.53 N about the weight's share moves it in each period by the hysteresis of the law. rho = 0.8.",
    quick=True,
    studies=[
        Study("Sliding, 2 s", sliding, [2e-2], [
            Quantity("motion", "way and speed", "m, m/s", [2 * SLIDES, 2 * SLIDES], source="a t^2/2, a t",
                     tolerance=1e-9, reason=EXACT)], by=""),
        Study("Thrown uphill: it stops and stays", thrown, [1.3e-2], [
            Quantity("motion", "way and speed at 2 s", "m, m/s", [-1.5**2 / (2 * UP), 0.0], source="-v^2/(2 a)",
                     tolerance=1e-8, reason=EXACT + "; the stop is an event")], by=""),
        Study("Sliding with viscous friction, 2 s", viscous, [4e-2, 2e-2, 1e-2], [
            Quantity("motion", "way and speed", "m, m/s", viscous_motion(), source="v = a tau (1 - exp(-t/tau))",
                     tolerance=2e-5, order=2, reason="(h/tau)^2/12, tau = 1.04 s, of 1 m: 8e-6")]),
        Study("Bristles under a slow force", creep, [250, 500, 1000], [
            Quantity("drift", "way in a period", "1e-6 m", drift(), source="hysteresis of the law, for a slow force",
                     relative=True, tolerance=1e-2,
                     reason="the inertia of the block and the damping of the bristles, at 2 rad/s: m w^2 / (N sigma_0) "
                            "is 2e-5, sigma_1 w/sigma_0 is 3 %, in the second order of it 1e-3")],
              parameter="steps in a period", by="elements"),
    ])
