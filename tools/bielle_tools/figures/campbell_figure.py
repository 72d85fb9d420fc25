"""Campbell's diagram: damped frequencies over the speed, by mode and sense of whirl, with critical speeds."""

import numpy as np

from ..messages import InputError
from . import plot_style as style

STYLES = {"forwards": "-", "backwards": "--", "plane": ":"}
CIRCLING = 0.1  # threshold of the whirl number: below it the motion is in a plane


def sense(whirl):
    """Returns "forwards", "backwards" or "plane"; "plane" also if there is no whirl number."""
    return "forwards" if whirl > CIRCLING else "backwards" if whirl < -CIRCLING else "plane"


def draw(results, at):
    """Writes `campbell`. at: name -> path. @returns paths"""
    if not results.has("campbell/damped_frequency"):
        return []
    speed, frequency, ratio, whirl = (results.array(f"campbell/{name}")
                                      for name in ("speed", "damped_frequency", "damping_ratio", "whirl"))
    if frequency.ndim != 2 or frequency.shape[0] != len(speed) or ratio.shape != frequency.shape or whirl.shape != frequency.shape:
        raise InputError(f"'{results.path}': 'campbell' is damaged: its speeds and frequencies do not fit together")
    fig, axes = style.figure(2, f"{results.title}: frequencies over the speed", height=3.4, gridspec_kw={"height_ratios": [2.2, 1]})
    panel, damping = axes[:, 0]
    for k in range(frequency.shape[1]):
        colour = style.COLOURS[k % len(style.COLOURS)]
        for begin, end, kind in _stretches([sense(value) for value in whirl[:, k]]):
            panel.plot(speed[begin:end], frequency[begin:end, k], color=colour, linestyle=STYLES[kind])
        damping.plot(speed, 100 * ratio[:, k], color=colour)
        panel.plot([], [], color=colour, label=f"mode {k + 1}")
    for kind, line in STYLES.items():
        panel.plot([], [], color="black", linestyle=line, label={"plane": "no circle"}.get(kind, kind))
    top = 1.08 * np.nanmax(frequency, initial=0)
    _orders(results, panel, speed, top)
    panel.set_ylim(0, top or 1)
    panel.set_ylabel("damped frequency [Hz]")
    damping.set_ylabel("damping ratio [%]")
    damping.set_xlabel("speed [rad/s]")
    style.legend(panel)
    return [style.save(fig, at("campbell"))]


def _orders(results, panel, speed, top):
    """Draws multiples of the speed, and their intersections with frequencies."""
    orders = {1.0}
    if results.has("campbell/critical_speed"):
        orders |= set(results.array("campbell/critical_order").tolist())
        panel.plot(results.array("campbell/critical_speed"), results.array("campbell/critical_frequency"), "o", color="black",
                   markersize=5, markerfacecolor="white", label="critical", zorder=5)
    for order in sorted(orders):
        line = order * np.abs(speed) / (2 * np.pi)
        panel.plot(speed, line, color="#999999", linewidth=0.9)
        shown = np.flatnonzero(line <= top)
        if len(shown):
            panel.annotate(f"{order:g}x", (speed[shown[-1]], line[shown[-1]]), fontsize=8, color="#777777", ha="right", va="top")


def _stretches(kinds):
    """(begin, end, kind) of runs of equal kinds; each reaches to the beginning of the next."""
    begin = 0
    for k in range(1, len(kinds) + 1):
        if k == len(kinds) or kinds[k] != kinds[begin]:
            yield begin, min(k + 1, len(kinds)), kinds[begin]
            begin = k
