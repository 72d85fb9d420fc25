"""The wing: its twist and bend by the equations of a uniform rod, and its speed of flutter by Ritz's method."""

import math

import numpy as np
from bielle_tools.gallery.machine import Check, Machine, Picture, Rows
from bielle_tools.results import Results
from numpy.polynomial import Polynomial
from scipy.integrate import quad
from scipy.optimize import brentq

SPAN, CHORD, AHEAD, THICKNESS, INCIDENCE, SPEED, AIR = 3, 0.8, 0.16, 0.06, math.radians(3), 30, 1.225
YOUNG, SHEAR, DENSITY, DAMPING = 4.2e9, 1.5e8, 160, 5e-4
SLOPE, DRAG = 1.15192 / math.radians(12), 0.008  # coefficients of the polar: lift [1/rad], drag
EI = YOUNG * CHORD * THICKNESS**3 / 12
# Saint-Venant's constant of a rectangle, by the usual approximation (W. Young, R. Budynas, Roark's Formulas, table 10.1).
GJ = SHEAR * CHORD * THICKNESS**3 * (1 / 3 - 0.21 * THICKNESS / CHORD * (1 - (THICKNESS / CHORD)**4 / 12))
MASS, INERTIA = DENSITY * CHORD * THICKNESS, DENSITY * CHORD * THICKNESS * (CHORD**2 + THICKNESS**2) / 12
SLOW, FAST = 36, 38  # [m/s] on both sides of the flutter
SHAPES = 5


def pressure(speed):
    """Dynamic pressure times chord [N/m]."""
    return AIR * speed**2 / 2 * CHORD


def loaded(speed):
    """Twist [rad] and bend [m] of the tip. GJ theta'' + q c e k (incidence + theta) = 0 with theta(0) = 0, theta'(L) = 0 has the
    angle of attack incidence cos(lambda (L - x))/cos(lambda L); the lift bends the wing and shears it."""
    wave = math.sqrt(pressure(speed) * AHEAD * SLOPE / GJ)

    def attack(x):
        return INCIDENCE * math.cos(wave * (SPAN - x)) / math.cos(wave * SPAN)

    def moved(x):
        lift = pressure(speed) * SLOPE * attack(x)
        return lift * (x**2 * (3 * SPAN - x) / (6 * EI) + x / (5 / 6 * SHEAR * CHORD * THICKNESS))

    return attack(SPAN) - INCIDENCE, quad(moved, 0, SPAN)[0]


def growth(speed):
    """Real part [1/s] of the fastest growing oscillation. Bend w = sum a_i x^(i+2) and twist theta = sum b_i x^(2i+1), x from 0 to
    1, in the equations of virtual work of
        m w'' + EI (w + d w')'''' = l,    I theta'' - GJ (theta + d theta')'' = e l - pi/16 rho c^3 U theta'
    (primes of time and place) with quasi-steady lift l = q c [k theta - (k + cd) (w' - (c/2 - e) theta')/U], the angle of attack
    at the three-quarter chord."""
    bends = [Polynomial([0] * (i + 2) + [1]) for i in range(SHAPES)]
    twists = [Polynomial([0] * (2 * i + 1) + [1]) for i in range(SHAPES)]

    def products(first, second):
        integrals = [[(a * b).integ() for b in second] for a in first]
        return np.array([[one(1) - one(0) for one in row] for row in integrals])

    bb, bt, tt = (SPAN * products(*pair) for pair in ((bends, bends), (bends, twists), (twists, twists)))
    bending = EI / SPAN**3 * products(*2 * [[each.deriv(2) for each in bends]])
    torsion = GJ / SPAN * products(*2 * [[each.deriv() for each in twists]])
    q, none = pressure(speed), np.zeros((SHAPES, SHAPES))
    rate, behind = (SLOPE + DRAG) * q / speed, CHORD / 2 - AHEAD
    M = np.block([[MASS * bb, none], [none, INERTIA * tt]])
    K = np.block([[bending, -q * SLOPE * bt], [none, torsion - q * SLOPE * AHEAD * tt]])
    C = np.block([[DAMPING * bending + rate * bb, -rate * behind * bt],
                  [AHEAD * rate * bt.T,
                   DAMPING * torsion + (math.pi / 16 * AIR * CHORD**3 * speed - AHEAD * rate * behind) * tt]])
    size = 2 * SHAPES
    A = np.block([[np.zeros((size, size)), np.eye(size)], [-np.linalg.solve(M, K), -np.linalg.solve(M, C)]])
    exponents = np.linalg.eigvals(A)
    return exponents[exponents.imag > 1].real.max()


def flutter():
    """The speed [m/s] at which an oscillation begins to grow."""
    return brentq(growth, 20, 60)


def grown(path):
    """Real part [1/s] of the fastest growing mode of a run."""
    with Results(path) as results:
        return results.array("eigen/eigenvalue")[:, 0].max()


def check(paths):
    rows = Rows(paths["wing"], 1)
    twist, bend = loaded(SPEED)
    slow, fast = grown(paths["slow"]), grown(paths["fast"])
    return [Check("twist of the tip at 30 m/s", "rad", rows("measures/twist")[-1], twist, 2e-3,
                  "drag twists the wing that is bent", "incidence (1/cos(lambda span) - 1)"),
            Check("bend of the tip at 30 m/s", "m", rows("measures/bend")[-1], bend, 2e-3, "12 elements; the same",
                  "lift of this twist on a cantilever"),
            Check("speed of flutter", "m/s", SLOW + (FAST - SLOW) * slow / (slow - fast), flutter(), 0.01,
                  "the reference is about the straight wing, and without shear", "Ritz's method with ten shapes")]


MACHINE = Machine(
    title="Wing in a gust",
    teaches="A polar by table gives the lift of a wing that bends and twists. The twist increases the lift. Below "
            "37 m/s the air damps the answer to a gust; above it, bending and torsion draw energy from the wind.",
    runs={"wing": ["wing.yaml"], "flutter": ["wing.yaml", "--set", "speed=42"],
          "slow": ["wing.yaml", "--set", f"speed={SLOW}"], "fast": ["wing.yaml", "--set", f"speed={FAST}"]},
    pictures=[Picture("flutter", ["--view", "x", "--from", "0.26", "--to", "0.39", "--frames", "2", "--scale", "3", "--size", "640x480"]),
              Picture("wing", ["--analysis", "3", "--quantity", "twist, bend"], tool="bielle-plot", figure="twist+bend.png"),
              Picture("flutter", ["--analysis", "3", "--quantity", "twist, bend"], tool="bielle-plot", figure="twist+bend.png")],
    page="flutter",
    check=check)
