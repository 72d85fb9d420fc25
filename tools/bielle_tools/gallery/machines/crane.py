"""The crane: the force that holds its jib, and the swing of its load, against statics and a pendulum on its tip."""

import numpy as np
from bielle_tools.gallery.machine import Check, Machine, Picture, Rows
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline

G, ROPE, TIP = 9.81, 0.8, 0.7  # length of the rope, distance from the middle of the jib to its end [m]


def swing(time, tip):
    """Angles [rad] of a pendulum whose pivot moves along `tip`, at rest at the start."""
    moved = CubicSpline(time, tip).derivative(2)

    def rates(t, y):
        a = moved(t)
        return [y[1], -((G + a[1]) * np.sin(y[0]) + a[0] * np.cos(y[0])) / ROPE]

    return solve_ivp(rates, (time[0], time[-1]), [0, 0], t_eval=time, rtol=1e-8, atol=1e-10, max_step=0.02).y[0]


def check(paths):
    rows = Rows(paths["crane"])
    middle, turn, load = rows("nodes/jib/position"), rows("nodes/jib/rotation"), rows("nodes/load/position")
    angle = 2 * np.arctan2(turn[:, 2], turn[:, 0])
    tip = middle[:, [0, 2]] + TIP * np.stack([np.cos(angle), -np.sin(angle)], axis=1)
    run = np.arctan2(load[:, 0] - tip[:, 0], tip[:, 1] - load[:, 2])
    expected = swing(rows.time, tip)
    largest = int(np.argmax(np.abs(expected)))
    # The jack of the jib: from the lug at 2.2 m to a point 0.15 m behind and 0.3 m below the hinge at 3 m.
    along = np.array([0.65, -0.3]) / np.hypot(0.65, 0.3)
    arm = -0.15 * along[1] + 0.3 * along[0]
    return [Check("force of the jib's cylinder at rest", "N", rows("elements/fold/force")[0],
                  G * (60 * 0.7 + 300 * 1.4) / arm, 5e-3,
                  "the boom bends", "moments about the hinge of the jib"),
            Check("largest angle of the swinging load", "rad", run[largest], expected[largest], 2e-3,
                  "accelerations of recorded places",
                  "equation of a pendulum on the moved tip")]


MACHINE = Machine(
    title="Hydraulic crane with a swinging load",
    teaches="A flexible boom, two cylinders and one circuit with pump, accumulator, relief, counterbalance and "
            "servo-valves. Trapped oil is a spring; commands that stop the boom let the load swing.",
    bodies=["boom"],
    runs={"crane": ["crane.yaml"]},
    pictures=[Picture("crane", ["--view=-y", "--from", "0", "--to", "4", "--frames", "3"])],
    page="crane",
    check=check)
