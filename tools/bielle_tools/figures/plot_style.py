"""A common style for all figures: readable sizes, quiet grid, colours that colour-blind readers can distinguish."""

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

# Okabe and Ito's palette (Color Universal Design, 2008), without its yellow, which is faint on white.
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#000000"]

plt.rcParams.update({
    "figure.constrained_layout.use": True, "figure.dpi": 120, "savefig.dpi": 120,
    "font.size": 10, "axes.titlesize": 11, "axes.titlelocation": "left", "legend.fontsize": 9, "legend.frameon": False,
    "axes.grid": True, "grid.color": "#dddddd", "grid.linewidth": 0.6, "axes.axisbelow": True,
    "axes.spines.top": False, "axes.spines.right": False,
    "axes.prop_cycle": plt.cycler(color=COLOURS) + plt.cycler(linestyle=["-"] * len(COLOURS)), "lines.linewidth": 1.3,
    "axes.formatter.limits": (-3, 4), "axes.formatter.use_mathtext": True, "image.cmap": "YlOrRd",
})


def figure(rows, title, width=9.0, height=2.6, columns=1, **options):
    """A figure of `rows` x `columns` panels that share their time axes."""
    fig, axes = plt.subplots(rows, columns, figsize=(width, height * rows + 0.5), squeeze=False, sharex="col", **options)
    fig.suptitle(title, x=0.01, ha="left", fontsize=12, fontweight="bold")
    return fig, axes


def curves_of(points):
    """A context in which curves of few points have markers."""
    return plt.rc_context({"lines.marker": "o", "lines.markersize": 4} if points <= 25 else {})


def label(quantity, units):
    """`angle [rad]`; without brackets if there is no unit."""
    return f"{quantity} [{units}]" if units and units not in ("1", "-") else quantity


def legend(axes):
    """A legend beside the panel, never over the curves; none for a single unnamed curve."""
    handles, _ = axes.get_legend_handles_labels()
    if handles:
        axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), borderaxespad=0.3)


def save(fig, path):
    fig.savefig(path)
    plt.close(fig)
    return path
