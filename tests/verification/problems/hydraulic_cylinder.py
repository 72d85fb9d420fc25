"""Hydraulic cylinders that move a mass."""

import numpy as np
from harness import Problem, Quantity, Study, vector
from harness.motions import moved

GRAVITY, MASS = 9.81, 500
EXACT = ("m dv/dt = A1 p1 - A2 p2 - c v, V dp/dt = B (Q - A v), Q = Cd A sqrt(2 |dp|/rho), by DOP853 and Radau "
         "(tests/references/hydraulic_cylinder.py)")


def model(actuator, gravity=0.0, velocity=0.0):
    """A mass on z above the ground, moved by a cylinder. @param actuator  further keys"""
    return {"gravity": [0, 0, -gravity],
            "nodes": {"mass": {"position": [0, 0, 1], "fixed": ["x", "y", "rx", "ry", "rz"],
                               "velocity": [0, 0, velocity]}},
            "elements": {"load": {"type": "point_mass", "node": "mass", "mass": MASS},
                         "jack": {"type": "hydraulic_actuator", "nodes": ["ground", "mass"], "ambient_pressure": 0,
                                  "bulk_modulus": 1.4e9, "stroke": [1, 1.5], **actuator}}}


SINGLE = model({"piston_areas": [2e-3, 0], "dead_volumes": [1e-3, 0], "pressures": [MASS * GRAVITY / 2e-3],
                "friction": {"viscous": 2000},
                "supply": {"pressure": 10e6, "tank": 0},
                "valve": {"coefficient": 0.62, "density": 850, "diameter": 2e-3, "command": 1,
                          "transition_pressure": 10}}, GRAVITY)
DOUBLE = model({"piston_areas": [2e-3, 1.2e-3], "dead_volumes": [1e-3, 0.2e-3], "pressures": [6e6, 10e6],
                "leakage": 1e-12, "friction": {"viscous": 1500},
                "supply": {"pressure": 21e6, "tank": 0.1e6},
                "valve": {"coefficient": 0.62, "density": 850, "area": 5e-6, "command": "min(t/0.01, 1)",
                          "transition_pressure": 10}})


BLOCKED = model({"piston_areas": [2e-3, 1.2e-3], "dead_volumes": [1e-3, 0.2e-3], "pressures": [6e6, 10e6]},
                velocity=0.1)
PERIOD, HIGHEST, LOWEST = vector("hydraulic_cylinder", "blocked.period", "blocked.highest",
                                 "blocked.lowest")["reference"]
FILLING = {"hydraulics": {"ambient_pressure": 0, "fluid": {"bulk_modulus": 1.4e9, "density": 850},
                          "volumes": {"a": {"volume": 1e-3, "pressure": 0}},
                          "supplies": {"pump": {"pressure": 10e6}},
                          "lines": {"hole": {"from": "pump", "to": "a",
                                             "orifice": {"coefficient": 0.62, "diameter": 2e-3,
                                                         "transition_pressure": 1}}}}}
CONDUCTANCE = 0.62 * np.pi * 1e-6 * np.sqrt(2 / 850)     # K in Q = K sqrt(dp)
FULL = 2 * 1e-3 * np.sqrt(10e6) / (1.4e9 * CONDUCTANCE)  # time to fill the volume [s]


def blocked(steps):
    """Turning points of the mass on trapped oil, and the period between the first and the third. @param steps per
    period"""
    places, turns, last = [], [], [0.0, 0.0]

    def look(session):
        v = session["elements/jack/rate"]
        places.append(session["elements/jack/length"] - 1)
        if last[1] * v < 0:
            turns.append(last[0] + (session.time - last[0]) * last[1] / (last[1] - v))
        last[:] = session.time, v

    moved(BLOCKED, 2.2 * PERIOD, PERIOD / steps, look, rho=1.0)
    return {"turns": [max(places), min(places)], "period": turns[2] - turns[0] if len(turns) > 2 else np.nan}


def filling(step):
    return {"pressure": moved(FILLING, FULL / 2, FULL * step, rho=1.0)["hydraulics/a/pressure"] / 1e6}


def run(what, duration):
    """Study.compute: length [m], rate [m/s] and pressures [MPa] of the jack."""
    def compute(step):
        session = moved(what, duration, step)
        pressures = session["elements/jack/pressure"] / 1e6
        return {"motion": [session["elements/jack/length"], session["elements/jack/rate"]],
                "pressure": pressures if what is DOUBLE else pressures[0]}
    return compute


def motion(name, tolerance, reason, order=2):
    return Quantity("motion", "length and rate", "m, m/s", **vector("hydraulic_cylinder", f"{name}.length",
                                                                    f"{name}.rate"), source=EXACT, tolerance=tolerance,
                    reason=reason,
                    order=order)


def pressure(name, names, tolerance, reason, order=2):
    found = vector("hydraulic_cylinder", *(f"{name}.{each}" for each in names))
    values = [value / 1e6 for value in found["reference"]]
    return Quantity("pressure", "pressure", "MPa", values if len(values) > 1 else values[0],
                    known_to=found["known_to"] / 1e6, source=EXACT, tolerance=tolerance, reason=reason,
                    order=order)


PROBLEM = Problem(
    title="Hydraulic cylinders",
    subject="Hydraulics and friction",
    source="H. E. Merritt, Hydraulic Control Systems (1967), ch. 3 and 6; "
           "subject of A. Cardona, An Integrated Approach to Mechanism Analysis, thesis, Liege 1989, ch. 5",
    model="A mass of 500 kg on a single-acting cylinder, A = 20 cm^2, filled from 10 MPa through an orifice of 2 mm "
          "against gravity; on a double-acting one, 20 and 12 cm^2, with a "
          "servo-valve that opens to 5 mm^2 within 10 ms, supply 21 MPa, with leakage. Bulk modulus 1.4 GPa. The oil "
          "column swings with 17 to 20 Hz. rho = 0.8.",
    quick=True,
    studies=[
        Study("Single-acting, 0.1 s", run(SINGLE, 0.1), [1e-3, 5e-4, 2.5e-4, 1.25e-4], [
            motion("lifted_0.1", 2e-4, "(w h)^2/12 of 0.15 m/s times w t: w = 106/s, h = 0.125 ms: 2e-5 m/s"),
            pressure("lifted_0.1", ["pressure"], 2e-3, "the same share of the swing of 3 MPa, 4e-4"),
        ]),
        Study("Single-acting, 2 s: steady speed of the orifice formula", run(SINGLE, 2), [2e-3], [
            motion("lifted_2", 2e-5, "the steady state is exact; the start leaves (w h)^2/12 of its 4 mm", None),
            pressure("lifted_2", ["pressure"], 1e-6, "the steady state is exact to Newton's tolerance", None),
        ]),
        Study("Trapped oil: swing of the mass", blocked, [100, 200, 400, 800], [
            Quantity("period", "period", "s", PERIOD, known_to=1e-10,
                     source="p = p0 - B ln(V/V0) has a potential: quadrature (tests/references/hydraulic_cylinder.py)",
                     tolerance=2e-6,
                     order=2, reason="(2 pi/800)^2/12 of 0.049 s: 2.5e-7"),
            Quantity("turns", "turning points", "m", [HIGHEST, LOWEST], known_to=1e-13, source="likewise",
                     tolerance=5e-8, reason="a step misses them by up to (pi/800)^2/2 of 8e-4 m: 6e-9"),
        ], parameter="steps per period", by="elements"),
        Study("Rigid volume through an orifice, half the time to fill", filling, [0.01, 0.005, 0.0025], [
            Quantity("pressure", "pressure", "MPa", 7.5, source="p = ps - (sqrt(ps) - B K t/2V)^2", tolerance=1e-5,
                     order=2, reason="(1/400)^2/12 of 10 MPa: 5e-6"),
        ], parameter="step/time to fill"),
        Study("Double-acting, 0.1 s", run(DOUBLE, 0.1), [5e-4, 2.5e-4, 1.25e-4], [
            motion("opened_0.1", 5e-4, "(w h)^2/12 of 0.5 m/s times w t: w = 127/s, h = 0.125 ms: 1.3e-4 m/s"),
            pressure("opened_0.1", ["pressure_1", "pressure_2"], 5e-3, "the same share of a swing of 5 MPa, 1.3e-3"),
        ]),
    ])
