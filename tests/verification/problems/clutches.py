"""A clutch between two flywheels and a brake, against closed forms."""

import bielle
import numpy as np
from harness import Problem, Quantity, Study
from harness.motions import moved

J1, J2, APART, CAPACITY, RAMP = 0.3, 0.5, 40.0, 60.0, 500.0
REDUCED = J1 * J2 / (J1 + J2)
COMMON = J1 * APART / (J1 + J2)                    # speed after the slip [rad/s]
SLIPS = REDUCED * APART / CAPACITY                 # time of the slip at a constant capacity [s]
ENGAGES = np.sqrt(2 * REDUCED * APART / RAMP)      # the same for a capacity RAMP t
ROUNDING = "constant accelerations are integrated exactly, and the end of the slip is an event: rounding and Newton's "\
    "tolerance"


def flywheels(capacity):
    """Two flywheels on one axis, the first turning."""
    return {"nodes": {"a": {}, "b": {}},
            "elements": {name: {"type": "rigid_body", "node": name, "mass": 1, "inertia": [1, 1, inertia]}
                         for name, inertia in (("a", J1), ("b", J2))},
            "joints": {"shaft": {"type": "hinge", "nodes": ["ground", "a"], "axis": [0, 0, 1], "start_rate": APART},
                       "between": {"type": "hinge", "nodes": ["a", "b"], "axis": [0, 0, 1], "start_rate": -APART,
                                   "clutch": {"capacity": capacity}}}}


def engaged(text, step, duration):
    """The session after the motion, and the time of the event at which the clutch sticks."""
    session, times = bielle.read(text).session(), []
    session.on_event(lambda _, time, __: times.append(time))
    session.dynamics(duration, step).finish()
    return session, times[0] if len(times) == 1 else np.nan


def constant(step):
    session, time = engaged(flywheels(CAPACITY), step, 0.5)
    return {"time": time, "speed": session["joints/shaft/rate"][0], "angle": session["joints/between/coordinate"][0],
            "lost": session.energy["dissipated"]}


def ramp(step):
    session, time = engaged(flywheels(f"{RAMP:g}*t"), step, 0.4)
    return {"time": time, "speed": session["joints/shaft/rate"][0]}


def brake(torque):
    """A wheel of 2 kg m^2 in a brake that holds 12 N m in sliding and 18 N m at rest, under a torque from rest, 1 s."""
    session = moved({"nodes": {"w": {}},
                     "elements": {"w": {"type": "rigid_body", "node": "w", "mass": 1, "inertia": [1, 1, 2]}},
                     "joints": {"axle": {"type": "hinge", "nodes": ["ground", "w"], "axis": [0, 0, 1],
                                         "clutch": {"capacity": 12, "static_ratio": 1.5}}},
                     "drives": {"load": {"joint": "axle", "torque": torque}}}, 1, 0.01)
    exact = (torque - 12) / 2 if torque > 18 else 0.0
    held = -12 if torque > 18 else -torque
    return {"rate": session["joints/axle/rate"][0] - exact, "force": session["joints/axle/clutch_force"][0] / held}


PROBLEM = Problem(
    title="Clutch and brake",
    subject="Hydraulics and friction",
    source="J. E. Shigley, Mechanical Engineering Design, ch. 16: energy and time of clutches",
    model="Flywheels of 0.3 and 0.5 kg m^2, one at 40 rad/s, the other at rest, come together by a clutch of 60 N m, "
          "and by one that is pressed little by little, 500 N m/s; a brake holds a wheel up to its torque at rest. "
          "Hinges with exact stick-slip friction; rho = 0.8.",
    quick=True,
    studies=[
        Study("Clutch of constant capacity", constant, [7e-3, 3e-3], [
            Quantity("time", "end of the slip", "s", SLIPS, source="J w0/T, J = J1 J2/(J1 + J2)", tolerance=1e-9,
                     reason=ROUNDING),
            Quantity("speed", "common speed", "rad/s", COMMON, source="J1 w0/(J1 + J2)", tolerance=1e-8,
                     reason=ROUNDING),
            Quantity("angle", "angle of the slip", "rad", -0.5 * APART * SLIPS, source="-w0 t/2", tolerance=1e-8,
                     reason=ROUNDING),
            Quantity("lost", "energy taken by the slip", "J", 0.5 * REDUCED * APART**2, source="J w0^2/2",
                     tolerance=1e-6, reason=ROUNDING),
        ], by=""),
        Study("Clutch that is pressed little by little", ramp, [8e-3, 4e-3, 2e-3], [
            Quantity("time", "end of the slip", "s", ENGAGES, source="sqrt(2 J w0/T')", tolerance=1e-9,
                     reason="speeds are integrated exactly while accelerations are linear in time: rounding and "
                            "Newton's tolerance"),
            Quantity("speed", "common speed", "rad/s", COMMON, source="conservation of the angular momentum",
                     tolerance=1e-7, reason="rounding and Newton's tolerance"),
        ]),
        Study("Brake at rest and beyond", brake, [17.9, 18.1], [
            Quantity("rate", "speed less (T - 12)/2 t, or less none", "rad/s", 0.0, source="closed form",
                     tolerance=1e-8, reason=ROUNDING),
            Quantity("force", "torque of the brake over its closed form", "-", 1.0, source="closed form",
                     tolerance=1e-9, reason=ROUNDING),
        ], parameter="torque [N m]", by=""),
    ])
