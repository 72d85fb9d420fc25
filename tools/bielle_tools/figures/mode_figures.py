"""Figures of modes: their shapes side by side, eigenvalues in the complex plane, damping ratios."""

import numpy as np

from ..messages import note
from ..results.modes import ModeMotion, Modes, ModeScenery
from . import plot_style as style

MOST_SHAPES = 12
PANEL = 640, 500  # pixels of a shape
MARKERS = {"oscillating": ("o", style.COLOURS[0]), "decaying": ("s", style.COLOURS[2]), "growing": ("^", style.COLOURS[1]),
           "rigid": ("D", style.COLOURS[6])}
RATIOS = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5]  # damping ratios whose lines are drawn in the complex plane


def draw(results, at, superelements):
    """Writes `eigenvalues` and `mode_shapes`. at: name -> path. @returns paths"""
    if not results.has("eigen/frequency") or not results.has("eigen/eigenvalue"):  # frequencies alone are a figure of their own
        return []
    modes = Modes(results)
    if not len(modes):
        return []
    written = eigenvalues(modes, at)
    if modes.displacement is None:
        return written
    scenery = ModeScenery(modes, superelements)
    try:
        return written + shapes(scenery, at)
    finally:
        scenery.close()


def eigenvalues(modes, at):
    """The complex plane (upper half), and damping ratios over frequency."""
    fig, (panel, damping) = style.plt.subplots(1, 2, figsize=(12, 4.6))
    fig.suptitle(f"{modes.results.title}: eigenvalues", x=0.01, ha="left", fontsize=12, fontweight="bold")
    upper = np.abs(modes.s.imag)
    for kind, (marker, colour) in MARKERS.items():
        chosen = np.array([k for k, each in enumerate(modes.kind) if each == kind], int)
        if len(chosen):
            panel.plot(modes.s.real[chosen], upper[chosen], marker, color=colour, label=kind, linestyle="none", markersize=5)
            damping.plot(modes.frequency[chosen], 100 * modes.damping_ratio[chosen], marker, color=colour, linestyle="none", markersize=5)
    for k in range(min(len(modes), 30)):
        panel.annotate(str(k + 1), (modes.s.real[k], upper[k]), textcoords="offset points", xytext=(5, 3), fontsize=8)
        damping.annotate(str(k + 1), (modes.frequency[k], 100 * modes.damping_ratio[k]), textcoords="offset points", xytext=(5, 3), fontsize=8)
    top = 1.08 * upper.max() or 1.0
    left = min(1.15 * modes.s.real.min(), -0.02 * top)
    right = max(1.15 * modes.s.real.max(), 0.15 * -left)
    panel.set_xlim(left, right)
    panel.set_ylim(-0.03 * top, top)
    for ratio in RATIOS:
        slope = ratio / np.sqrt(1 - ratio**2)
        if slope * top > 0.1 * -left and slope * top < 30 * -left:
            high = min(top, -left / slope)
            panel.plot([0, -slope * high], [0, high], color="#bbbbbb", linewidth=0.8, zorder=0)
            panel.annotate(f"{100 * ratio:g} %", (-slope * high, high), fontsize=8, color="#777777", ha="left", va="top", zorder=0)
    panel.axvspan(0, right, color=style.COLOURS[1], alpha=0.08, linewidth=0)
    panel.axvline(0, color="black", linewidth=0.8)
    panel.set_xlabel("Re s [1/s] (right of 0: growing)")
    panel.set_ylabel("|Im s| [1/s]")
    panel.set_title("grey: equal damping ratio")
    if panel.get_legend_handles_labels()[0]:
        panel.legend(loc="upper left", fontsize=8, frameon=True)
    damping.axhline(0, color="black", linewidth=0.8)
    damping.set_xlabel("frequency [Hz]")
    damping.set_ylabel("damping ratio [%]")
    return [style.save(fig, at("eigenvalues"))]


def shapes(scenery, at):
    """Draws a panel for each of the first modes: its largest deviation, over the state in grey."""
    from ..pictures import display
    modes = scenery.modes
    count = min(len(modes), MOST_SHAPES)
    if display.missing():
        note(f"mode_shapes is left out: {display.missing()}")
        return []
    from ..pictures import frames, shot  # VTK takes time to load
    if count < len(modes):
        note(f"mode_shapes shows {count} of {len(modes)} modes; bielle-animate --mode N shows any")
    look = shot.Look(view="iso", superelements=scenery.superelements, size=PANEL)
    motions = [ModeMotion(scenery, number + 1, pictures=24) for number in range(count)]
    if not (scenery.nodes or scenery.beams or scenery.bodies):
        return []
    images = frames.drawings(shot.Shot(motion.only(motion.farthest()), look, 1) for motion in motions)
    columns = min(4, count)
    lines = -(-count // columns)
    fig, axes = style.plt.subplots(lines, columns, figsize=(3.4 * columns, 3.0 * lines + 0.5), squeeze=False)
    fig.suptitle(f"{modes.results.title}: shapes of modes", x=0.01, ha="left", fontsize=12, fontweight="bold")
    for panel in axes.flat:
        panel.set_axis_off()
    for panel, motion, image in zip(axes.flat, motions, images):
        panel.imshow(image, interpolation="antialiased")
        panel.set_title(_title(modes, motion.number), fontsize=9)
    return [style.save(fig, at("mode_shapes"))]


def _title(modes, number):
    text = modes.named(number)
    return text if len(text) < 34 else text.replace(", damping", ",\ndamping").replace(", rigid", ",\nrigid")
