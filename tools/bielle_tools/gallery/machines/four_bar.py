"""The four-bar linkage: the swing of its rocker, and the torque of its motor, against the linkage with rigid links."""

import math

import numpy as np
from bielle_tools.gallery.machine import Check, Machine, Picture, Rows

CRANK, COUPLER, ROCKER, BASE = 0.12, 0.4, 0.3, 0.35
G, DENSITY, TOOL, PIN = 9.81, 2700, 0.5, (0.15, 0.16)
ROCKER_MASS, CRANK_INERTIA = DENSITY * 0.012 * 0.025 * ROCKER, 5 * 0.15**2 / 2


def plate():
    """Mass, centre and moment of inertia of the coupler, from a raster of its drawing: discs, bars and bores."""
    d = 5e-4
    x, y = np.meshgrid(np.arange(-0.03, 0.43, d) + d / 2, np.arange(-0.03, 0.19, d) + d / 2)
    pins = [(0, 0, 0.025, 0.012), (COUPLER, 0, 0.025, 0.012), (*PIN, 0.02, 0.008)]
    solid = np.zeros(x.shape, bool)
    bars = (pins[0], pins[1], 0.026), (pins[0], pins[2], 0.022), (pins[2], pins[1], 0.022)
    for (x0, y0, _, _), (x1, y1, _, _), width in bars:
        length = math.hypot(x1 - x0, y1 - y0)
        along = ((x - x0) * (x1 - x0) + (y - y0) * (y1 - y0)) / length
        across = ((y - y0) * (x1 - x0) - (x - x0) * (y1 - y0)) / length
        solid |= (along > 0) & (along < length) & (np.abs(across) < width / 2)
    for x0, y0, boss, _ in pins:
        solid |= np.hypot(x - x0, y - y0) < boss
    for x0, y0, _, bore in pins:
        solid &= np.hypot(x - x0, y - y0) > bore
    part = DENSITY * 0.012 * d * d
    mass, cx, cy = part * solid.sum(), x[solid].mean(), y[solid].mean()
    return mass, cx, cy, part * np.sum((x[solid] - cx)**2 + (y[solid] - cy)**2)


def places(theta):
    """Centre of the coupler, tool, and angles of coupler and rocker at crank angles: rows of an array."""
    _, cx, cy, _ = plate()
    ax, ay = CRANK * np.cos(theta), CRANK * np.sin(theta)
    across = np.hypot(BASE - ax, ay)
    phi = np.arctan2(-ay, BASE - ax) + np.arccos((COUPLER**2 + across**2 - ROCKER**2) / (2 * COUPLER * across))
    psi = np.arctan2(ay + COUPLER * np.sin(phi), ax + COUPLER * np.cos(phi) - BASE)
    c, s = np.cos(phi), np.sin(phi)
    tool = ax + PIN[0] * c - PIN[1] * s, ay + PIN[0] * s + PIN[1] * c
    return np.array([ax + cx * c - cy * s, ay + cx * s + cy * c, *tool, phi, psi])


def torque(rate):
    """Torque of the motor [N m] over a turn of rigid links at a constant rate: the derivative of their energy."""
    theta = np.linspace(0, 2 * np.pi, 4001)
    mass, _, _, inertia = plate()
    q = places(theta)
    q[4:] = np.unwrap(q[4:])
    d = np.gradient(q, theta, axis=1, edge_order=2)
    kinetic = rate**2 / 2 * (CRANK_INERTIA + mass * (d[0]**2 + d[1]**2) + TOOL * (d[2]**2 + d[3]**2) + inertia * d[4]**2
                             + ROCKER_MASS * ROCKER**2 / 3 * d[5]**2)
    height = G * (mass * q[1] + TOOL * q[3] + ROCKER_MASS * ROCKER / 2 * np.sin(q[5]))
    return np.gradient(kinetic + height, theta, edge_order=2)


def check(paths):
    rows = Rows(paths["four_bar"])
    steady = rows.time > 0.4

    def dead(reach):  # angle of the rocker where crank and coupler are in line
        return math.degrees(math.acos((ROCKER**2 + BASE**2 - reach**2) / (2 * ROCKER * BASE)))

    swing = math.degrees(np.ptp(rows("joints/pivot/coordinate")[steady, 0]))
    rms = math.sqrt(np.mean(rows("joints/main/drive_force")[steady]**2))
    return [Check("swing of the rocker", "deg", swing, dead(CRANK + COUPLER) - dead(COUPLER - CRANK), 3e-4,
                  "the rocker bends",
                  "law of cosines at the dead centres"),
            Check("torque of the motor, root of the mean square", "N m", rms,
                  math.sqrt(np.mean(torque(2 * np.pi * 4)[:-1]**2)), 0.01,
                  "flexible links vibrate", "derivative of the energy of rigid links")]


MACHINE = Machine(
    title="Four-bar linkage with a coupler from an Abaqus deck",
    teaches="Mesh, material and the couplings of the pins come from the deck of another program, in mm and "
            "tonnes. A tool sits on the third interface. The joints leave one degree of freedom without being "
            "redundant.",
    bodies=["coupler"],
    runs={"four_bar": ["four_bar.yaml"]},
    pictures=[Picture("four_bar", ["--view=z", "--from", "0.5", "--to", "0.7", "--frames", "3", "--scale", "50"])],
    page="four_bar",
    check=check)
