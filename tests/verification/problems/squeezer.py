"""Andrews' squeezing mechanism of the IFToMM library."""

import numpy as np
from harness import Problem, Quantity, Study, vector
from harness.motions import axes, moved

QUARTER = np.pi / 2
START = {"beta": -0.0617138900142764496, "theta": 0.0, "gamma": 0.455279819163070380, "phi": 0.222668390165885885,
         "delta": 0.487364979543842550, "Omega": -0.222668390165885885, "epsilon": 1.23054744454982119}


def turned(angles):
    """The angle of the x axis of each body from the inertial one, by the angles of the source."""
    beta, theta, gamma, phi, delta, Omega, epsilon = angles
    return {"k1": beta, "k2": beta + theta + np.pi, "k3": gamma - QUARTER, "k4": phi + delta - QUARTER, "k5": delta,
            "k6": Omega + epsilon, "k7": epsilon - QUARTER}


def along(angle):
    return np.array([np.cos(angle), np.sin(angle), 0])


def model():
    """Each body's node stands at the joint about which it turns, with x along the body."""
    A, B, C, O = np.array([[-0.06934, -0.00227, 0], [-0.03635, 0.03273, 0], [0.014, 0.072, 0], [0, 0, 0]])
    angles = START
    P = 0.007 * along(angles["beta"])
    F = P - 0.028 * along(angles["beta"] + angles["theta"])
    G, H = A + 0.04 * along(angles["delta"]), A + 0.04 * along(angles["epsilon"] - QUARTER)
    places = {"k1": O, "k2": P, "k3": B, "k4": G, "k5": A, "k6": H, "k7": A}
    bodies = {"k1": (0.04325, 2.194e-6, 0.00092, 0), "k2": (0.00365, 4.410e-7, 0.0115, 0),
              "k3": (0.02373, 5.255e-6, 0.01874, 0.01043),
              "k4": (0.00706, 5.667e-7, 0.02 - 0.01421, 0), "k5": (0.07050, 1.169e-5, 0.02308, 0.00916),
              "k6": (0.00706, 5.667e-7, 0.02 - 0.01421, 0), "k7": (0.05498, 1.912e-5, 0.01228, 0.00449)}
    hinges = {"main": ("ground", "k1", O), "p": ("k1", "k2", P), "f3": ("k2", "k3", F), "b": ("ground", "k3", B),
              "f4": ("k2", "k4", F),
              "g": ("k4", "k5", G), "a5": ("ground", "k5", A), "f6": ("k2", "k6", F), "h": ("k6", "k7", H),
              "a7": ("ground", "k7", A)}
    elements = {name: {"type": "rigid_body", "node": name, "mass": m, "centre": [x, y, 0], "inertia": [J, J, J]}
                for name, (m, J, x, y) in bodies.items()}
    elements["spring"] = {"type": "spring_damper", "nodes": ["ground", "k3"], "at": [C, [0.018, 0.02, 0]],
                          "stiffness": 4530, "length": 0.07785}
    return {"nodes": {name: {"position": places[name], "rotation_vector": [0, 0, angle]} for name,
                      angle in turned(angles.values()).items()},
            "elements": elements,
            "joints": {name: {"type": "hinge", "nodes": [first, second], "axis": [0, 0, 1], "position": at}
                       for name, (first, second, at) in hinges.items()},
            "drives": {"motor": {"joint": "main", "torque": 0.033}}}


EXACT = {time: vector("squeezer", *(f"at_{time}_ms.{name}" for name in START)) for time in (30, 50)}
SOURCE = ("equations of motion in Cartesian coordinates of the bodies (tests/references/squeezer.py); the values of "
          "the test set agree to 1e-9")
TORQUE = 0.033


class EnergyBalance:
    """The largest deviation of kinetic and elastic energy from that of the start and the work of the motor [J]; a
    `look` of `moved`."""

    def __init__(self):
        self.first, self.largest = None, 0.0

    def __call__(self, session):
        energy = session.energy
        kept = energy["kinetic"] + energy["elastic"] - TORQUE * session["joints/main/coordinate"][0]
        self.first = kept if self.first is None else self.first
        self.largest = max(self.largest, abs(kept - self.first))


def directions(step):
    session = moved(model(), 0.03, step, rho=0.8)
    return {"directions": [axes(session, name)[:2, 0] for name in turned(START.values())]}


def library(step):
    balance = EnergyBalance()
    session = moved(model(), 0.05, step, balance, rho=0.8)
    return {"balance": balance.largest, "directions": [axes(session, name)[:2, 0] for name in turned(START.values())]}


def quantity(time, tolerance, reason):
    return Quantity("directions", "x axes of the bodies", "-",
                    [along(angle)[:2] for angle in turned(EXACT[time]["reference"]).values()],
                    known_to=EXACT[time]["known_to"], tolerance=tolerance, order=2, source=SOURCE, reason=reason)


PROBLEM = Problem(
    title="A03 Andrews' squeezing mechanism",
    subject="Rigid mechanisms",
    source="E. Hairer, G. Wanner, Solving Ordinary Differential Equations II (1996), VII.7; Test Set for IVP Solvers "
           "(Bari, CWI), problem andrews, 0.03 s; IFToMM library of computational benchmark problems, A03, 0.05 s",
    model="Seven bodies in a plane with ten hinges (three loops) and a spring; a torque of 0.033 N m drives the crank "
          "from rest for 0.03 s, up to 1140 rad/s, and for 0.05 s. The library asks for the balance of kinetic and "
          "elastic energy and work within 0.05 s. "
          "Rigid bodies in space, whose redundant constraints the program removes; generalised-alpha with rho = 0.8.",
    quick=True,
    studies=[
        Study("Directions of the seven bodies at 0.03 s", directions, [2e-5, 1e-5, 5e-6, 2.5e-6], [
            quantity(30, 5e-5, "a crank at 1140 rad/s turns by 2.9e-3 rad in the last step; (w h)^2/12 of its 2.5 "
                               "turns is 1e-5 rad")]),
        Study("Energy balance within 0.05 s, as the library asks", library, [1e-5, 5e-6, 2.5e-6], [
            Quantity("balance", "largest error of the balance of energy", "J", 0.0,
                     source="kinetic and elastic energy less the work of the motor are constant", tolerance=1e-4,
                     order=2, reason="(w h)^2/4 of the work of 1.1 J, w = 5700 rad/s, five times the crank's: 6e-5"),
            quantity(50, 2e-4, "twice as many turns as at 0.03 s, with (w h)^2/12 to (w h)^2/4"),
        ], accuracy="balance"),
    ])
