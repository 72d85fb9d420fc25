"""A flexible arm that is spun up."""

import numpy as np
from harness import Problem, Quantity, Study, row
from harness.motions import moved

ARMS = {"simo_vu_quoc": {"L": 10, "EA": 2.8e7, "GA": 1e7, "EI": 1.4e4, "m": 1.2, "J": 6e-4, "speed": 6},
        "wu_haug": {"L": 8, "EA": 5.03132e6, "GA": 2e6, "EI": 566.7, "m": 0.201878, "J": 566.7 / 5.03132e6 * 0.201878,
                    "speed": 4}}
EXACT = "geometrically exact rod, spectral element in space, Runge-Kutta in time (tests/references/spin_up.py)"


def model(arm):
    return {"parameters": {"Om": arm["speed"], "Ts": 15},
            "nodes": {"root": {"position": [0, 0, 0], "fixed": ["x", "y", "z", "rx", "ry"],
                               "motion": {"rz": "if(t < Ts, Om/Ts*(t^2/2 + (Ts/(2*pi))^2*(cos(2*pi*t/Ts) - 1)), Om*(t "
                                                "- Ts/2))"}},
                      "tip": {"position": [arm["L"], 0, 0]}},
            "elements": {"arm": {"type": "beam", "nodes": ["root", "tip"], "elements": 24, "orientation": [0, 1, 0],
                                 "section": {"EA": arm["EA"], "GAy": arm["GA"], "GAz": arm["GA"], "GJ": arm["EI"],
                                             "EIy": arm["EI"], "EIz": arm["EI"],
                                             "mass_per_length": arm["m"], "Jx": 2 * arm["J"], "Jy": arm["J"],
                                             "Jz": arm["J"]}}}}


def spin(name):
    """Study.compute: deflections across the turning root at 5 and 10 s, and the largest one, by a parabola through
    three steps."""
    def compute(step):
        deflection, times = [], []

        def look(session):
            psi = session["nodes/root/rotation_vector"][2]
            x, y, _ = session["nodes/tip/position"]
            times.append(session.time)
            deflection.append(np.cos(psi) * y - np.sin(psi) * x)

        moved(model(ARMS[name]), 10, step, look, rho=0.9)
        times, v = np.array(times), np.array(deflection)
        k = int(np.argmin(v))
        bend = v[k - 1] - 2 * v[k] + v[k + 1]
        return {"at_5": v[np.argmin(abs(times - 5))], "at_10": v[-1],
                "least": v[k] - (v[k + 1] - v[k - 1])**2 / (8 * bend)}
    return compute


def quantities(name):
    return [Quantity(key, meaning, "m", **row("spin_up", f"{name}.{key}"), source=EXACT, tolerance=3e-4, order=2,
                     order_within=within, reason=reason,
                     order_reason=remark)
            for key, meaning, within, reason, remark in (
                ("at_5", "deflection at 5 s", 0.15,
                 "(w h)^2/12 of the swing with w = 4 rad/s is 1e-5; the vibration on top of it has w = 30 rad/s and 1 "
                 "mm", ""),
                ("at_10", "deflection at 10 s", 0.15, "likewise", ""),
                ("least", "largest deflection", 0.15, "likewise", ""))]


PROBLEM = Problem(
    title="Spin-up of a flexible arm",
    subject="Beams in motion",
    source="J. Simo, L. Vu-Quoc, On the dynamics of flexible beams under large overall motions, J. Appl. Mech. 53 "
           "(1986) 855; S.-C. Wu, E. Haug, IJNME 26 (1988) 2211",
    model="An arm of 10 m (8 m) clamped to a hub that turns by psi(t) up to 6 rad/s (4 rad/s) within 15 s. It lags "
          "behind by 0.57 m and is stiffened by the centrifugal "
          "force, without which it would buckle. 24 beam elements, rho = 0.9, until 10 s.",
    studies=[Study("Arm of Simo and Vu-Quoc", spin("simo_vu_quoc"), [0.02, 0.01, 0.005], quantities("simo_vu_quoc")),
             Study("Arm of Wu and Haug", spin("wu_haug"), [0.02, 0.01, 0.005], quantities("wu_haug"))])
