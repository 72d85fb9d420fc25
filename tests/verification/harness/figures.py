"""Log-log figures of errors, as SVG text."""

import io
import math

from bielle_tools.figures.plot_style import COLOURS, plt
from matplotlib.ticker import FuncFormatter, LogLocator, NullLocator


def convergence(study):
    """The figure of a study: errors over the level, and over processor time, each relative to its tolerance.

    @returns SVG text, empty if there is no error to draw
    """
    drawn = [(quantity, points(study, quantity)) for quantity in study["quantities"]]
    drawn = [(quantity, found) for quantity, found in drawn if len(found) > 1]
    if not drawn:
        return ""
    fig, (left, right) = plt.subplots(1, 2, figsize=(9.0, 2.9), sharey=True, layout="none")
    fig.subplots_adjust(left=0.08, right=0.68, bottom=0.18, top=0.95,
                        wspace=0.08)  # a layout that is searched takes a second
    for k, (quantity, found) in enumerate(drawn):
        colour = COLOURS[k % len(COLOURS)]
        levels, times, errors = zip(*found)
        left.loglog(levels, errors, "o-", color=colour, markersize=4, label=quantity["meaning"])
        right.loglog(times, errors, "o-", color=colour, markersize=4)
        if quantity["expected_order"] is not None:
            slope = quantity["expected_order"] * (1 if study["by"] == "step" else -1)
            left.loglog(levels, [errors[-1] * (level / levels[-1])**slope for level in levels], "--", color=colour,
                        linewidth=0.8)
    plain = FuncFormatter(lambda value, _: f"{value:g}")  # exponents as mathematics take most of the time of a figure
    for axes in (left, right):
        for axis in (axes.xaxis, axes.yaxis):
            low, high = axis.get_data_interval()
            axis.set_major_locator(LogLocator(subs=(1, 2, 5) if high < 30 * low else (1,)))
            axis.set_major_formatter(plain)
            axis.set_minor_locator(NullLocator())
        axes.axhline(1.0, color="#888888", linewidth=0.9, linestyle=":")
    left.set_xticks([level["level"] for level in study["levels"]])
    left.set_xlabel(study["parameter"])
    left.set_ylabel("error / tolerance")
    if study["by"] == "step":
        left.invert_xaxis()
    right.set_xlabel("processor time [s]")
    right.legend(*left.get_legend_handles_labels(), loc="upper left", bbox_to_anchor=(1.0, 1.0), borderaxespad=0.3)
    return svg(fig)


def points(study, quantity):
    """(level, processor time, error over tolerance) of the levels with an error that logarithms can show."""
    errors = [float(error) for error in quantity["errors"]]
    return [(float(level["level"]), max(level["processor_time"], 1e-4), error / quantity["tolerance"])
            for level, error in zip(study["levels"], errors) if math.isfinite(error) and error > 0]


def svg(fig):
    """The text of a figure, without the parts that only a file of its own needs."""
    text = io.StringIO()
    with plt.rc_context({"svg.fonttype": "none", "font.family": "sans-serif", "svg.hashsalt": "bielle"}):
        fig.savefig(text, format="svg", metadata={"Date": None, "Creator": None})
    plt.close(fig)
    return text.getvalue()[text.getvalue().index("<svg"):]
