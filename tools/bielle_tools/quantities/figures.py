"""Figures of quantities: panels by unit, all runs over each other."""

import hashlib
import os
import re

import matplotlib.pyplot as plt
import numpy as np

from ..figures import plot_style as style
from ..messages import InputError
from .curves import with_gaps

MOST_NAMED = 20  # curves in a legend
MOST_PANELS = 12
LONGEST_NAME = 100  # letters of the name of a figure
plt.rcParams["agg.path.chunksize"] = 20000  # curves of a million points


def target(options, kind, names):
    """Path of a figure in the folder of the options, or next to the first file. Figures of other quantities, kinds or files
    have other names. kind: `spectrum`, or empty; names: of the quantities"""
    folder = options.output or os.path.splitext(options.files[0])[0] + "-plots"
    os.makedirs(folder, exist_ok=True)
    others = [os.path.splitext(os.path.basename(path))[0] for path in options.files[1:]]
    over = options.against or options.orders
    words = "+".join(names) + (f"-over-{over}" if over else "") + "".join(f"-and-{name}" for name in others)
    text = "-".join(([kind] if kind else []) + [re.sub(r"[^\w.+-]+", "_", words).strip("_")])
    if len(text) > LONGEST_NAME:
        text = f"{text[:LONGEST_NAME]}-{hashlib.sha256(words.encode(errors='surrogateescape')).hexdigest()[:8]}"
    return os.path.join(folder, f"{text}.{options.format}")


def draw_curves(curves, title, path, logarithmic=False):
    """Draws curves, those of one unit in one panel. @returns the path"""
    fig, panels = _panels(curves, title)
    for unit, panel in panels.items():
        those = [with_gaps(curve) for curve in curves if curve.unit == unit]
        many = len(those) > len(style.COLOURS)
        colours = plt.get_cmap("viridis")(np.linspace(0, 0.9, len(those))) if many else style.COLOURS
        with style.curves_of(max(len(curve.x) for curve in those)):
            for curve, colour in zip(those, colours):
                panel.plot(curve.x, curve.y, label=curve.label, color=colour)
        if logarithmic and any(np.nanmax(curve.y, initial=0) > 0 for curve in those):
            panel.set_yscale("log")
        _finish(panel, those, unit)
    return style.save(fig, path)


def draw_envelopes(pairs, title, path):
    """Draws bands between least and largest values. @returns the path"""
    fig, panels = _panels([low for low, _ in pairs], title)
    for unit, panel in panels.items():
        those = [pair for pair in pairs if pair[0].unit == unit]
        for k, (low, high) in enumerate(those):
            colour = style.COLOURS[k % len(style.COLOURS)]
            panel.fill_between(low.x, low.y, high.y, color=colour, alpha=0.35, label=low.name)
        _finish(panel, [low for low, _ in those], unit)
    return style.save(fig, path)


def draw_orders(found, title, path):
    """Draws amplitudes over order and speed as colours, a panel per curve; at a constant speed their mean over the pieces.
    @returns the path"""
    if len(found) > MOST_PANELS:
        raise InputError(f"these are {len(found)} order analyses; {MOST_PANELS} panels fit into a figure: name fewer "
                         "quantities or runs")
    fig, axes = style.figure(len(found), title, height=3.5)
    for panel, (curve, orders) in zip(axes[:, 0], found):
        panel.set_title(curve.label)
        if np.ptp(orders.speed) < 0.01 * orders.speed.max():  # a plane of colours would have no height
            panel.plot(orders.order, orders.amplitude.mean(axis=0))
            panel.set_ylabel(style.label("amplitude", curve.unit))
            panel.set_title(f"{curve.label}, at {orders.speed.mean():.6g} rad/s")
            continue
        rising = np.argsort(orders.speed, kind="stable")
        mesh = panel.pcolormesh(orders.order, orders.speed[rising], orders.amplitude[rising], shading="nearest")
        fig.colorbar(mesh, ax=panel, label=style.label("amplitude", curve.unit))
        panel.set_ylabel("speed [rad/s]")
    axes[-1, 0].set_xlabel("order")
    return style.save(fig, path)


def _panels(curves, title):
    units = list(dict.fromkeys(curve.unit for curve in curves))
    if len(units) > MOST_PANELS:
        raise InputError(f"these quantities have {len(units)} units; {MOST_PANELS} panels fit into a figure")
    fig, axes = style.figure(len(units), title, height=3.2)
    axes[-1, 0].set_xlabel(curves[0].axis)
    return fig, dict(zip(units, axes[:, 0]))


def _finish(panel, curves, unit):
    names = list(dict.fromkeys(curve.name for curve in curves))
    panel.set_ylabel(style.label(names[0] if len(names) == 1 else "", unit))
    if len(curves) <= MOST_NAMED and (len(curves) > 1 or curves[0].label != curves[0].name):
        style.legend(panel)
