"""Orifices, valves, accumulators and a transmission, against closed forms."""

import numpy as np
from harness import Problem, Quantity, Study
from harness.motions import moved

AREA, COEFFICIENT, DENSITY, VISCOSITY = 1e-5, 0.7, 850.0, 0.04
NARROW = {"area": AREA, "transition_pressure": 10}
FLUID = {"ambient_pressure": 0, "fluid": {"bulk_modulus": 1.4e9, "density": DENSITY, "viscosity": VISCOSITY}}


def orifice(difference, share=1.0):
    """Flow of the orifice formula [m^3/s]."""
    return COEFFICIENT * share * AREA * np.sqrt(2 * difference / DENSITY)


# Keys of the line, pressures on both sides and of the pilot [Pa], flow [m^3/s].
LINES = {
    "orifice": ({"orifice": NARROW}, 5e6, 1e6, orifice(4e6)),
    "spool valve, 40 % open": ({"valve": {**NARROW, "command": 0.4}}, 5e6, 1e6, orifice(4e6, 0.4)),
    "check valve": ({"check": NARROW}, 5e6, 1e6, orifice(4e6)),
    "relief valve, half open": ({"relief": {**NARROW, "pressure": 4e6, "range": 2e6, "vented": True}}, 5e6, 1e6,
                                orifice(4e6, 0.5)),
    "counterbalance valve, half open": ({"counterbalance": {**NARROW, "pressure": 10e6, "range": 2e6, "pilot": "x",
                                                            "pilot_ratio": 3}}, 5e6, 1e6, orifice(4e6, 0.5)),
    "laminar line": ({"laminar": {"length": 2, "diameter": 0.004}}, 2e6, 1e6,
                     np.pi * 0.004**4 / (128 * VISCOSITY * 2) * 1e6),
}


def flow(line):
    keys, first, second, exact = LINES[line]
    supplies = {"a": {"pressure": first}, "b": {"pressure": second}, "x": {"pressure": 2e6}}
    session = moved({"hydraulics": {**FLUID, "supplies": supplies, "lines": {"it": {"from": "a", "to": "b", **keys}}}},
                    1, 0.1)
    return {"flow": float(session["hydraulics/it/flow"]) / exact}


def spool(step):
    """Opening of a spool of 30 Hz, zeta = 0.4, after 20 ms of a command of 0.5."""
    session = moved({"hydraulics": {
        **FLUID, "supplies": {"a": {"pressure": 1e6}, "b": {"pressure": 0}},
        "lines": {"it": {"from": "a", "to": "b", "valve": {"area": 1e-6, "command": "if(t > 0, 0.5, 0)",
                                                           "frequency": 30, "damping": 0.4}}}}}, 0.02, step)
    return {"opening": float(session["hydraulics/it/opening"])}


def opening():
    w, zeta, t = 2 * np.pi * 30, 0.4, 0.02
    damped = w * np.sqrt(1 - zeta**2)
    return 0.5 * (1 - np.exp(-zeta * w * t) * (np.cos(damped * t) + zeta * w / damped * np.sin(damped * t)))


def accumulator(step):
    """Pressure of a gas accumulator that takes 0.1 l of nearly incompressible oil."""
    session = moved({"hydraulics": {
        "fluid": {"bulk_modulus": 1e13}, "volumes": {"v": {"volume": 1e-6, "pressure": 5e6}},
        "supplies": {"pump": {"to": "v", "flow": 1e-4}},
        "accumulators": {"store": {"at": "v", "gas_volume": 1e-3, "precharge": 4e6, "exponent": 1.4}}}}, 1, step)
    return {"pressure": float(session["hydraulics/v/pressure"]) / 1e6}


def gas_pressure():
    volume = 1e-3 * (4 / 5)**(1 / 1.4)
    return 5 * (volume / (volume - 1e-4))**1.4


PROBLEM = Problem(
    title="Orifices, valves and accumulators",
    subject="Hydraulics and friction",
    source="H. E. Merritt, Hydraulic Control Systems (1967), ch. 3, 5; G. Hagen, J. L. M. Poiseuille, laminar flow",
    model="Single lines between given pressures; a spool that follows its command as an oscillator of 30 Hz; an "
          "accumulator of 1 l, precharged with 4 MPa, into which 0.1 l are pumped at 5 MPa.",
    quick=True,
    studies=[
        Study("Steady flow over its closed form", flow, list(LINES), [
            Quantity("flow", "flow over its closed form", "-", 1.0,
                     source="Q = Cd A sqrt(2 dp/rho), pi d^4 dp/(128 mu L)", tolerance=1e-9,
                     reason="below a transition at 10 Pa orifices are laminar: (10 Pa/4 MPa)^2/4")],
              parameter="line", by=""),
        Study("Spool after 20 ms", spool, [4e-4, 2e-4, 1e-4], [
            Quantity("opening", "opening", "-", opening(), source="oscillator with zeta = 0.4, closed form", order=2,
                     tolerance=1e-4, reason="(w h)^2/12 to (w h)^2/4, w = 188/s at 0.1 ms, of w t 0.5: 6e-5 to 2e-4, "
                                            "less the decay")]),
        Study("Accumulator", accumulator, [1e-2], [
            Quantity("pressure", "pressure", "MPa", gas_pressure(), source="p V^n is constant", tolerance=1e-4,
                     reason="oil of 0.5 l at B = 1e13 Pa gives by 1e-7 of its volume")], by=""),
    ])
