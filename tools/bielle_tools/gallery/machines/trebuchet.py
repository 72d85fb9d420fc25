"""The trebuchet: speed and time of the throw against the equations of a rigid one without play, and the flight against
a parabola."""

import math

import numpy as np
from bielle_tools.gallery.machine import Check, Machine, Picture, Rows
from scipy.integrate import solve_ivp

G, AXLE, SHORT, LONG, LOW, SLING, HANGER, RADIUS = 9.81, 3.2, 1.0, 4.0, 0.4, 3.6, 1.3, 0.12
BEAM, WEIGHT, STONE = 150.0, 2500.0, 20.0  # masses [kg]
BEAM_INERTIA = BEAM * ((5**2 + 0.25**2) / 12 + ((LONG - SHORT) / 2)**2)  # about the axle
WEIGHT_INERTIA = WEIGHT / 6
HOOK, PULLED = math.radians(-45), 0.1


def long_end(angle):
    return np.array([-LONG * math.cos(angle), AXLE - LONG * math.sin(angle)])


def accelerations(y, on_trough):
    """Second derivatives of y = (angle of the beam, of the hanger, x, z of the stone, and their rates), and multipliers
    of the sling and of the trough: Lagrange's equations of the first kind."""
    beam, hanger, x, z, beam_rate, hanger_rate, u, v = y
    sine, cosine = math.sin(beam), math.cos(beam)
    by_beam, by_hanger = SHORT * np.array([-sine, cosine]), HANGER * np.array([math.cos(hanger), math.sin(hanger)])
    coupled = WEIGHT * by_beam @ by_hanger
    mass = np.diag([BEAM_INERTIA + WEIGHT * SHORT**2, WEIGHT_INERTIA + WEIGHT * HANGER**2, STONE, STONE])
    mass[0, 1] = mass[1, 0] = coupled
    turning = -SHORT * np.array([cosine, sine]) * beam_rate**2
    turning += HANGER * np.array([-math.sin(hanger), math.cos(hanger)]) * hanger_rate**2
    force = -WEIGHT * (np.array([0, G]) + turning)
    loads = [force @ by_beam + BEAM * G * (LONG - SHORT) / 2 * cosine, force @ by_hanger, 0, -STONE * G]
    sling, end_rate = long_end(beam) - [x, z], LONG * np.array([sine, -cosine])
    relative = end_rate * beam_rate - [u, v]
    rows = [[sling @ end_rate, 0, -sling[0], -sling[1]]]
    right = [-relative @ relative - sling @ (LONG * np.array([cosine, sine])) * beam_rate**2]
    if on_trough:
        rows.append([0, 0, 0, 1])
        right.append(0)
    matrix = np.block([[mass, np.array(rows).T], [np.array(rows), np.zeros((len(rows), len(rows)))]])
    solution = np.linalg.solve(matrix, np.r_[loads, right])
    return solution[:4], solution[4:]


def throw():
    """Time [s] from the trigger to the release, and speed of the stone [m/s] there."""
    start = math.asin((AXLE - LOW) / LONG)
    y = np.array([start, 0, long_end(start)[0] + math.sqrt(SLING**2 - (LOW - RADIUS)**2), RADIUS, 0, 0, 0, 0])

    def lifted(_, y):
        return accelerations(y, True)[1][1]

    def hooked(_, y):
        away = y[2:4] - long_end(y[0])
        cosine, sine = math.cos(y[0]), math.sin(y[0])
        return math.atan2(away @ [-sine, cosine], -(away @ [cosine, sine])) - HOOK

    lifted.terminal = hooked.terminal = True
    hooked.direction = 1
    time = 0.0
    for on_trough, end in ((True, lifted), (False, hooked)):
        found = solve_ivp(lambda _, y, on=on_trough: np.r_[y[4:], accelerations(y, on)[0]], (time, time + 3), y,
                          events=end, rtol=1e-8, atol=1e-10)
        time, y = found.t[-1], found.y[:, -1]
    return time, math.hypot(y[6], y[7])


def check(paths):
    rows, flight = Rows(paths["throw"], 1), Rows(paths["throw"], 2)
    released = rows.event("thrown")
    time, speed = throw()
    row = int(np.searchsorted(rows.time, released + 1e-9))
    (x, _, z), (u, _, v) = rows("nodes/stone/position")[row], rows("nodes/stone/velocity")[row, :3]
    landing = x + u / G * (v + math.sqrt(v**2 + 2 * G * (z - RADIUS)))
    return [Check("time from the trigger to the release", "s", released - PULLED, time, 5e-3, "the play of the axle",
                  "Lagrange's equations without play"),
            Check("speed of the stone at the release", "m/s",
                  math.sqrt(u * u + (v + G * (rows.time[row] - released))**2), speed, 0.01,
                  "the play of the axle", "Lagrange's equations without play"),
            Check("place of the landing", "m", flight("nodes/stone/position")[-1, 0], landing, 1e-5, "steps",
                  "parabola from the release")]


MACHINE = Machine(
    title="Trebuchet with play in its axle",
    teaches="A clearance out of which the weight lifts the axle after the throw, a trough that the stone leaves, "
            "and events that pull the trigger, let go of the sling and end the run at the landing. Play and "
            "impacts cost little of the throw: the speed is that of the ideal machine within one per cent.",
    runs={"throw": ["trebuchet.yaml"]},
    pictures=[Picture("throw", ["--analysis", "1", "--view=-y", "--to", "0.96", "--frames", "6", "--hide", "contact",
                      "--hide", "trigger"])],
    page="throw",
    check=check)
