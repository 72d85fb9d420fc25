"""The integration schemes: error constants on an index-3 pendulum, spectral radius of an oscillator, energy."""

import bielle
import numpy as np
from harness import Problem, Quantity, Study, row, vector
from harness.motions import EnergyDrift, moved

PENDULUM = """
gravity: [0, -9.81, 0]
nodes: {bob: {position: [1, 0, 0]}}
elements: {bob: {type: rigid_body, node: bob, mass: 1, inertia: [1e-12, 1e-12, 1e-12]}}
joints: {pivot: {type: hinge, nodes: [ground, bob], axis: [0, 0, 1], position: [0, 0, 0]}}
"""
OSCILLATOR = """
nodes: {{m: {{position: [1, 0, 0], fixed: [y, z, rx, ry, rz]}}}}
elements:
  m: {{type: point_mass, node: m, mass: 1}}
  s: {{type: spring_damper, nodes: [ground, m], stiffness: {}, length: 0}}
"""
SCHEMES = {"hht": {"scheme": "hht", "alpha": 0.1 / 1.9}, "rho_0.9": {"rho": 0.9},
           "rho_0.5": {"rho": 0.5}}
X, Y = vector("simple_pendulum", "1.x", "1.y")["reference"]
PLACE = np.array([-X, Y])  # released from the other side than the table's
SPEED = np.sqrt(2 * 9.81 * -Y)
VELOCITY = SPEED * np.array([Y, X])


def pendulum(scheme):
    """Study.compute: errors at 1 s, and the force of the rod."""
    def compute(step):
        session = moved(PENDULUM, 1, step, constraints="position", **SCHEMES[scheme])
        node = session.node("bob")
        force = np.linalg.norm(session["joints/pivot/reaction"][:3])
        return {"place": node.position[:2], "velocity": node.velocity[:2], "force": force,
                "constant": np.linalg.norm(node.position[:2] - PLACE) / step**2}
    return compute


def orders(scheme, constant):
    """@param constant  error of the place over h^2 of the independent implementation at h = 2.5 ms"""
    return [
        Quantity("place", "place at 1 s", "m", PLACE, known_to=1e-14,
                 source="Jacobi's elliptic functions (tests/references/simple_pendulum.py)", order=2, order_within=0.05,
                 tolerance=1.2 * constant * 2.5e-3**2,
                 reason="the error of the independent implementation, and a fifth for the start"),
        Quantity("velocity", "velocity at 1 s", "m/s", VELOCITY, known_to=1e-13, source="conservation of energy",
                 order=2, order_within=0.05, tolerance=4e-4,
                 reason="errors of the place times 5 rad/s"),
        Quantity("force", "force of the rod at 1 s", "N", 3 * 9.81 * -Y, known_to=1e-12, source="3 m g |y|", order=2,
                 order_within=0.15, tolerance=6e-3,
                 reason="errors of the place times 6 m g, and of the scheme's own multipliers"),
        Quantity("constant", "error of the place over h^2", "m/s^2", constant, known_to=5e-5, relative=True,
                 tolerance=1e-3,
                 source="another implementation, without corrected start values (tests/references/index_three.py)",
                 reason="it starts at rest, where a corrected start changes terms of higher order alone"),
    ]


def radius(scheme):
    """Study.compute: spectral radius of an oscillator at w h = level, from its motion, over theory."""
    def compute(frequency):
        session = bielle.read(OSCILLATOR.format(frequency**2)).session()
        motion = session.dynamics(200, 1.0, **SCHEMES[scheme])
        states = []
        for _ in motion:
            node = session.node("m")
            states.append([node.position[0], node.velocity[0]])
        return {"radius": dominant(np.array(states[5:60])) / theory(scheme, frequency)}
    return compute


def dominant(states):
    """The largest magnitude of the eigenvalues of the recurrence of third order that a sequence obeys, by least
    squares."""
    scale = np.abs(states).max(axis=0)
    q = states[:, 0] / scale[0]
    columns = np.column_stack([q[2:-1], q[1:-2], q[:-3]])
    factors = np.linalg.lstsq(columns, q[3:], rcond=None)[0]
    return np.abs(np.roots([1, *-factors])).max()


def theory(scheme, frequency):
    """Spectral radius of generalised-alpha at w h = frequency, of the amplification matrix of (q, h v, h^2 A)."""
    if scheme == "hht":
        alpha_m, alpha_f = 0, 0.1 / 1.9
    else:
        rho = SCHEMES[scheme]["rho"]
        alpha_m, alpha_f = (2 * rho - 1) / (rho + 1), rho / (rho + 1)
    gamma = 0.5 + alpha_f - alpha_m
    beta = 0.25 * (0.5 + gamma)**2
    w2 = frequency**2
    # (1 - alpha_m) A1 + alpha_m A0 = -w^2 ((1 - alpha_f) q1 + alpha_f q0)
    left = np.array([[1, 0, -beta], [0, 1, -gamma], [(1 - alpha_f) * w2, 0, 1 - alpha_m]])
    right = np.array([[1, 1, 0.5 - beta], [0, 1, 1 - gamma], [-alpha_f * w2, 0, -alpha_m]])
    return np.abs(np.linalg.eigvals(np.linalg.solve(left, right))).max()


def drift(step):
    energy = EnergyDrift()
    moved(PENDULUM, 100, step, energy, rho=1.0)
    return {"drift": energy.largest}


def study(scheme, title):
    constant = row("index_three", f"pendulum.{scheme}.0.0025.q")["reference"] / 2.5e-3**2
    return Study(f"Pendulum, index 3: {title}", pendulum(scheme), [1e-2, 5e-3, 2.5e-3], orders(scheme, constant))


PROBLEM = Problem(
    title="Integration schemes",
    subject="Integration in time",
    source="J. Chung, G. Hulbert, J. Appl. Mech. 60 (1993) 371; M. Arnold, O. Bruls, Convergence of the "
           "generalized-alpha scheme for constrained mechanical systems, Multibody Syst. "
           "Dyn. 18 (2007) 185; A. Cardona, M. Geradin, Comput. Struct. 33 (1989) 801; "
           "subject of A. Cardona, An Integrated Approach to Mechanism Analysis, thesis, Liege 1989, ch. 6",
    model="The pendulum of 1 kg and 1 m released from the horizontal, with its constraint of position alone; an "
          "oscillator at several w h.",
    quick=True,
    studies=[
        study("rho_0.9", "generalised-alpha, rho = 0.9"), study("rho_0.5", "generalised-alpha, rho = 0.5"),
        study("hht", "HHT, alpha = 0.1/1.9"),
        Study("Spectral radius: generalised-alpha, rho = 0.5", radius("rho_0.5"), [0.3, 1, 3, 10], [
            Quantity("radius", "decay per step over theory", "-", 1.0,
                     source="eigenvalues of the amplification matrix", tolerance=1e-6,
                     reason="Newton's tolerance and the least squares"),
        ], parameter="w h", by=""),
        Study("Spectral radius: HHT", radius("hht"), [0.3, 1, 3, 10], [
            Quantity("radius", "decay per step over theory", "-", 1.0,
                     source="eigenvalues of the amplification matrix", tolerance=1e-6, reason="likewise"),
        ], parameter="w h", by=""),
        Study("Energy of the pendulum over 100 s, without dissipation (rho = 1)", drift, [1e-2, 5e-3, 2.5e-3], [
            Quantity("drift", "largest drift of the energy", "J", 0.0, source="conservation of energy", tolerance=2e-2,
                     order=2,
                     reason="it oscillates by (w h)^2/4 of 20 J, 6e-4, and grows with the phase"),
        ]),
    ])
