"""A slider-crank with a flexible rod."""

import bielle
import numpy as np
from harness import Problem, Quantity, Study, row, vector

MODEL = """
nodes:
  crank: {position: [0, 0, 0], angular_velocity: [0, 0, 150]}
  pin: {position: [0.15, 0, 0]}
  a: {position: [0.15, 0, 0], velocity: [0, 22.5, 0], angular_velocity: [0, 0, -75]}
  middle: {position: [0.3, 0, 0], velocity: [0, 11.25, 0], angular_velocity: [0, 0, -75]}
  b: {position: [0.45, 0, 0], angular_velocity: [0, 0, -75]}
  slider: {position: [0.45, 0, 0]}
elements:
  crank: {type: rigid_body, node: crank, mass: 0.36, inertia: [0.0014, 0.0014, 0.002727], also: [pin]}
  slider: {type: point_mass, node: slider, mass: 0.075552}
  left: {type: beam, nodes: [a, middle], elements: ELEMENTS, section: SECTION}
  right: {type: beam, nodes: [middle, b], elements: ELEMENTS, section: SECTION}
joints:
  main: {type: hinge, nodes: [ground, crank], axis: [0, 0, 1]}
  big_end: {type: hinge, nodes: [pin, a], axis: [0, 0, 1]}
  wrist: {type: hinge, nodes: [b, slider], axis: [0, 0, 1]}
  guide: {type: prismatic, nodes: [ground, slider], axis: [1, 0, 0]}
drives: {motor: {joint: main, angle: "150*t"}}
"""
SECTION = ("{rectangle: [0.008, 0.008], young: 2e11, poisson: 0.3, density: 7870, shear_factors: [0.8333333333333333,"
           " 0.8333333333333333]}")
EXACT = "geometrically exact rod by a spectral element (tests/references/flexible_crank.py)"


TURNING = -74.9957670  # rate of the line between the rod's ends at the smooth start [rad/s]


def parabola(x, middle, end):
    """The longitudinal shape of the source, x from 0 to 1 along the rod."""
    return 4 * x * (1 - x) * middle + x * (2 * x - 1) * end


def start_smoothly(session):
    """Gives the rod the stretch and the rates of the test set, so that it hardly vibrates along its axis."""
    state = session.state
    names = ["ground", "crank", "pin", "a", "middle", "b", "slider"]
    drawn = state.positions[:, 0].copy()
    for k, place in enumerate(drawn):
        if k < len(names) and names[k] not in ("a", "middle", "b"):
            continue  # the others are inner nodes of the beams
        x = (place - 0.15) / 0.3
        stretch = parabola(x, 0.103339863e-4, 0.169327969e-4)
        rate = 0.444896105 * np.sin(np.pi * x) + 0.463434311e-2 * np.sin(2 * np.pi * x)
        slope = np.pi / 0.3 * (0.444896105 * np.cos(np.pi * x) + 2 * 0.463434311e-2 * np.cos(2 * np.pi * x))
        state.positions[k, 0] += stretch
        state.velocities[k] = [parabola(x, -0.178591076e-5, -0.268938672e-5),
                               22.5 + TURNING * (0.3 * x + stretch) + rate, 0]
        state.angular_velocities[k, 2] = TURNING + slope
    end, slider = names.index("b"), names.index("slider")
    state.positions[slider] = state.positions[end]
    state.velocities[slider] = [state.velocities[end, 0], 0, 0]
    session.state = state


def run(step, smooth=False):
    """Deflections of the middle from the line of the ends at 0.02, 0.04 .. 0.1 s, the extreme ones, and the slider at
    the end."""
    session = bielle.read(MODEL.replace("ELEMENTS", "8").replace("SECTION", SECTION)).session()
    if smooth:
        start_smoothly(session)
    motion = session.dynamics(0.1, step, rho=0.9)
    times, deflection = [], []

    def look(session):
        a, b, middle = (session[f"nodes/{name}/position"] for name in ("a", "b", "middle"))
        along = (b - a) / np.linalg.norm(b - a)
        times.append(session.time)
        deflection.append(along[0] * (middle - a)[1] - along[1] * (middle - a)[0])

    look(session)
    for _ in motion:
        look(session)
    at = [int(np.argmin(np.abs(np.array(times) - t))) for t in (0.02, 0.04, 0.06, 0.08, 0.1)]
    return {"deflection": np.array(deflection)[at], "extremes": [max(deflection), min(deflection)],
            "slider": session["nodes/slider/position"][0]}


def deflections(start):
    """Arguments of the Quantity of the five deflections."""
    return vector("flexible_crank", *(f"{start}.at_{k}" for k in range(1, 6)))


PROBLEM = Problem(
    title="Flexible slider-crank",
    subject="Beams in motion",
    source="B. Simeon, Modelling a flexible slider crank mechanism by a mixed system of DAEs and PDEs, Math. Model. "
           "Syst. 2 (1996) 1",
    model="Crank 0.15 m at 150 rad/s, steel rod 0.30 m, 8 x 8 mm, slider 0.0756 kg, without gravity, for 0.1 s. The "
          "rod vibrates by 1.6 to 1.9 mm across. Two beams of eight "
          "elements, rho = 0.9. Start: with the stretch and the rates of the test set, or straight with the "
          "velocities of a rigid rod.",
    studies=[
        Study("Smooth start: deflection of the middle, and slider", lambda step: run(step, smooth=True),
              [4e-4, 2e-4, 1e-4], [
            Quantity("deflection", "at 0.02, 0.04 .. 0.1 s", "m", **deflections("smooth_start"),
                     source=EXACT, tolerance=8e-6, order=2,
                     order_within=0.3,
                     order_reason="an axial vibration of 19 000 rad/s that is left in the start moves the deflection "
                                  "by 3e-7 m, until steps below 25 us resolve it",
                     reason="0.5 % of the amplitude: bending vibrates with 500 rad/s, (w h)^2/12 times 50 rad at h = "
                            "0.1 ms is 1e-2 of the vibration, which is a third of the amplitude"),
            Quantity("slider", "place of the slider at 0.1 s", "m", **row("flexible_crank", "smooth_start.slider"),
                     source=EXACT, tolerance=1e-6,
                     reason="bending shortens the rod by 2e-5 m at most"),
        ]),
        Study("Straight start: deflection of the middle, and slider", run, [4e-5, 2e-5], [
            Quantity("deflection", "at 0.02, 0.04 .. 0.1 s", "m", **deflections("rigid_start"),
                     source=EXACT, tolerance=1e-5,
                     reason="0.5 % of the amplitude"),
            Quantity("extremes", "largest and least", "m", **vector("flexible_crank", "rigid_start.highest",
                                                                    "rigid_start.lowest"), source=EXACT, tolerance=1e-5,
                     reason="0.5 % of the amplitude"),
            Quantity("slider", "place of the slider at 0.1 s", "m", **row("flexible_crank", "rigid_start.slider"),
                     source=EXACT, tolerance=2e-5,
                     reason="the start sets off an axial vibration of m a l/EA = 1e-5 m with 19 000 rad/s, whose "
                            "phase these steps do not keep: no order is observed"),
        ]),
    ])
