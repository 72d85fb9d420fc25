"""Whirl and critical speeds of rotors."""

import bielle
import numpy as np
from harness import Problem, Quantity, Study

POLAR, ACROSS, MASS, TILT = 0.035, 0.02, 5.0, 800.0
SPEEDS = (30.0, 100.0, 1000.0)


def disc(speed):
    """A disc on an axle whose bearing resists tilting: Jt w^2 -+ Jp Omega w - k = 0."""
    results = bielle.read(f"""
nodes: {{hub: {{position: [0, 0, 0]}}, disc: {{position: [0, 0, 0], angular_velocity: [0, 0, {speed}]}}}}
elements: {{disc: {{type: rigid_body, node: disc, mass: {MASS}, inertia: [{ACROSS}, {ACROSS}, {POLAR}]}}}}
joints:
  mount: {{type: bushing, nodes: [ground, hub], stiffness: [1e5, 2e5, 3e5, {TILT}, {TILT}, 500]}}
  axle: {{type: hinge, nodes: [hub, disc], position: [0, 0, 0], axis: [0, 0, 1]}}
""").session().modes(count=5)
    found = 2 * np.pi * np.array(results["eigen/damped_frequency"])
    forward, backward = whirl(speed)
    # The other modes are translations: each tilting mode is the one next to its exact value.
    return {"whirl": [found[np.argmin(abs(found - forward))] / forward,
                      found[np.argmin(abs(found - backward))] / backward]}


def whirl(speed):
    """Frequencies of forward and backward tilting [rad/s]."""
    a = POLAR * speed / (2 * ACROSS)
    root = np.sqrt(a * a + TILT / ACROSS)
    return root + a, root - a


def jeffcott(elements):
    """A disc in the middle of a light shaft of steel on two pins: the critical speed sqrt(48 EI/(m L^3))."""
    young, radius, length = 2.1e11, 0.01, 1.0
    section = f"{{circle: {radius}, young: {young}, poisson: 0.3, density: 0.01, shear_factors: [1e6, 1e6]}}"
    results = bielle.read(f"""
parameters: {{speed: 100}}
nodes:
  left: {{position: [0, 0, 0]}}
  disc: {{position: [0, 0, 0.5]}}
  right: {{position: [0, 0, 1], fixed: [x, y]}}
elements:
  a: {{type: beam, nodes: [left, disc], elements: {elements}, section: {section}}}
  b: {{type: beam, nodes: [disc, right], elements: {elements}, section: {section}}}
  disc: {{type: rigid_body, node: disc, mass: 5, inertia: [0.02, 0.02, 0.03]}}
joints: {{pin: {{type: spherical, nodes: [ground, left], position: [0, 0, 0]}}}}
""").session().campbell({"from": 20, "to": 200, "count": 10}, rotation={"axis": [0, 0, 1]}, modes=2)
    exact = np.sqrt(48 * young * np.pi * radius**4 / 4 / (5 * length**3))
    speeds = np.array(results.numbers.get("critical_speed", []))
    return {"critical": speeds[np.argmin(abs(speeds - exact))] / exact if len(speeds) else np.nan}


PROBLEM = Problem(
    title="Whirl and critical speeds",
    subject="Beams in motion",
    source="G. Genta, Dynamics of Rotating Systems (2005), ch. 4; H. H. Jeffcott, Phil. Mag. 37 (1919) 304",
    model="A rigid disc on an axle whose elastic bearing lets it tilt, at 30, 100 and 1000 rad/s: modes of the "
          "spinning disc. A disc of 5 kg in the middle of a light steel shaft of 1 m "
          "and 20 mm diameter on two pins: Campbell diagram of the rotor as a whole.",
    quick=True,
    studies=[
        Study("Tilting of a spinning disc", disc, SPEEDS, [
            Quantity("whirl", "forward and backward frequency over the closed form", "-", [1, 1],
                     source="Jt w^2 -+ Jp Omega w - k = 0", tolerance=1e-9, reason="rounding")],
              parameter="speed [rad/s]", by=""),
        Study("Jeffcott's rotor", jeffcott, [2, 4], [
            Quantity("critical", "critical speed over sqrt(48 EI/(m L^3))", "-", 1.0,
                     source="beam under a force in its middle", tolerance=1e-5,
                     reason="static bending is exact; the shaft's mass and the search of the crossing")],
              parameter="elements of each half", by="elements"),
    ])
