"""An animation (GIF) and a sheet of still pictures of a mechanism in motion."""

import numpy as np
from matplotlib.animation import FuncAnimation, PillowWriter

from .messages import InputError
from .plot_style import plt
from .render import Scene
from .results_file import modes_to_show


def sheet(results, path, view=None, scale=1.0, span=(None, None), superelements=None, pictures=6):
    """Writes `pictures` moments of the motion side by side."""
    scene, rows = _scene(results, view, scale, span, superelements, pictures)
    columns = min(3, len(rows))
    lines = -(-len(rows) // columns)
    width, height = scene.limits[1] - scene.limits[0]
    size = 4.2
    fig, axes = plt.subplots(lines, columns, figsize=(size * columns, (size * min(height / width, 1.2) + 0.4) * lines),
                             squeeze=False)
    coloured = None
    for panel in axes.flat[len(rows):]:
        panel.set_axis_off()
    for panel, row in zip(axes.flat, rows):
        coloured = scene.draw(panel, row) or coloured
        panel.set_title(results.moment(row))
    _colour_bar(fig, results, coloured, axes)
    fig.suptitle(_title(results, scale), x=0.01, ha="left", fontsize=12, fontweight="bold")
    fig.savefig(path)
    plt.close(fig)
    return path


def movie(results, path, view=None, scale=1.0, span=(None, None), superelements=None, pictures=60, seconds=6.0):
    """Writes an animated GIF of about `pictures` pictures that plays for `seconds`."""
    scene, rows = _scene(results, view, scale, span, superelements, pictures)
    width, height = scene.limits[1] - scene.limits[0]
    fig, panel = plt.subplots(figsize=(7.2, 7.2 * min(max(height / width, 0.35), 1.2) + 0.5), dpi=90)
    coloured = scene.draw(panel, rows[0])
    _colour_bar(fig, results, coloured, panel)
    fig.suptitle(_title(results, scale), x=0.01, ha="left", fontsize=11, fontweight="bold")

    def paint(row):
        panel.clear()
        scene.draw(panel, row)
        panel.set_title(results.moment(row), fontsize=10)

    FuncAnimation(fig, paint, frames=rows).save(path, writer=PillowWriter(fps=max(1, round(len(rows) / seconds))))
    plt.close(fig)
    return path


def _scene(results, view, scale, span, superelements, pictures):
    if len(results.time) < 2:
        raise InputError(f"'{results.path}' holds no motion to show" + modes_to_show(results))
    scene = Scene(results, view, scale, superelements)
    if not (scene.bodies or scene.beams or scene.nodes):
        raise InputError(f"'{results.path}' records no nodes, beams or superelements")
    rows = np.asarray(results.frames(count=pictures, span=span))
    scene.prepare(rows)
    return scene, rows


def _title(results, scale):
    return results.title + (f" (deformation x {scale:g})" if scale != 1 else "")


def _colour_bar(fig, results, coloured, axes):
    if coloured is not None:
        fig.colorbar(coloured, ax=axes, shrink=0.7, label=getattr(results, "stress_label", "von Mises [MPa]"))
