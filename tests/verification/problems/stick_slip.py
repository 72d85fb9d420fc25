"""A mass on a moving belt, held by a spring: it sticks and slips."""

import numpy as np
from harness import Problem, Quantity, Study
from harness.motions import moved

MASS, STIFFNESS, BELT, STATIC, KINETIC, GRAVITY = 1.0, 100.0, 0.1, 0.4, 0.25, 9.81
MODEL = """
gravity: [0, 0, -9.81]
nodes:
  belt: {position: [0, 0, 0], velocity: [0.1, 0, 0]}
  anchor: {position: [-5, 0, 0], fixed: true}
  block: {position: [0, 0, 0], velocity: [0.1, 0, 0]}
elements:
  block: {type: rigid_body, node: block, mass: 1, inertia: [0.1, 0.1, 0.1]}
  spring: {type: spring_damper, nodes: [anchor, block], stiffness: 100}
joints:
  rail: {type: prismatic, nodes: [ground, belt], axis: [1, 0, 0]}
  contact: {type: prismatic, nodes: [belt, block], axis: [1, 0, 0],
            friction: {model: stick_slip, coefficient: 0.25, static: 0.4}}
drives: {belt: {joint: rail, displacement: "0.1*t"}}
"""


def exact(t):
    """Place and velocity at a time. It sticks until k x = mu_s m g, then swings about mu_k m g/k until it has the
    belt's velocity again."""
    w = np.sqrt(STIFFNESS / MASS)
    x_s, x_k = STATIC * MASS * GRAVITY / STIFFNESS, KINETIC * MASS * GRAVITY / STIFFNESS
    first = x_s / BELT
    if t < first:
        return np.array([BELT * t, BELT])
    slips, sticks = 2 * (np.pi - np.arctan((x_s - x_k) * w / BELT)) / w, 2 * (x_s - x_k) / BELT
    t = (t - first) % (slips + sticks)
    if t > slips:
        return np.array([2 * x_k - x_s + BELT * (t - slips), BELT])
    return np.array([x_k + (x_s - x_k) * np.cos(w * t) + BELT / w * np.sin(w * t),
                     -(x_s - x_k) * w * np.sin(w * t) + BELT * np.cos(w * t)])


def slide(step):
    worst = np.zeros(2)

    def look(session):
        node = session.node("block")
        worst[:] = np.maximum(worst, np.abs([node.position[0], node.velocity[0]] - exact(session.time)))

    moved(MODEL, 4.4, step, look)
    return {"place": worst[0], "velocity": worst[1]}


PROBLEM = Problem(
    title="Stick-slip on a belt",
    subject="Hydraulics and friction",
    source="J. P. Den Hartog, Mechanical Vibrations (1956), 7.4; closed form with different coefficients at rest and "
           "in sliding",
    model="A mass of 1 kg on a belt of 0.1 m/s, held by a spring of 100 N/m, mu = 0.25, at rest 0.4: it moves with "
          "the belt until the spring pulls it off, five times within 4.4 s. "
          "A prismatic joint with exact stick-slip friction, whose transitions are events; rho = 0.8.",
    quick=True,
    studies=[Study("Five periods", slide, [8e-3, 4e-3, 2e-3, 1e-3], [
        Quantity("place", "largest error of the place", "m", 0.0,
                 source="closed form: harmonic while it slips, straight while it sticks", tolerance=2e-5, order=2,
                 order_within=0.15,
                 reason="5e-4 of the amplitude 0.04 m at h = 1 ms"),
        Quantity("velocity", "largest error of the velocity", "m/s", 0.0, source="likewise", tolerance=2e-4, order=2,
                 order_within=0.15, reason="w = 10 rad/s times the error of the place"),
    ])])
