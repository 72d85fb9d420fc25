"""Figures of a study: lines over a parameter, families of lines over two, contours over two.

    peak over speed                      a line; other parameters that vary need `by` or `where`
    peak over speed by height            a line for each height
    peak over speed and height           contours; every pair of values has to be there
    peak over speed where height = 1.2   the others held
"""

import dataclasses
import os
import re

import numpy as np

from ..messages import InputError, did_you_mean, note

FORM = "NAME over PARAMETER [by PARAMETER] [and PARAMETER] [where PARAMETER = VALUE, ..]"
FORM_PATTERN = re.compile(r"\s*(?P<name>\S+)\s+over\s+(?P<over>\S+)(?:\s+by\s+(?P<by>\S+)|\s+and\s+(?P<second>\S+))?"
                          r"(?:\s+where\s+(?P<where>.+))?\s*")
MOST_CURVES = 14


@dataclasses.dataclass
class Figure:
    """over, by: a line for each value of `by`; over, second: contours; where: {parameter: text}"""

    name: str
    over: str
    by: str = None
    second: str = None
    where: dict = dataclasses.field(default_factory=dict)

    @property
    def file(self):
        parts = [self.name, "over", self.over, *(["by", self.by] if self.by else []), *(["and", self.second] if self.second else []),
                 *(f"{name}={value}" for name, value in self.where.items())]
        return re.sub(r"[^\w.=+-]+", "_", "_".join(parts))


def read_figures(plan):
    """Reads the entries of `draw`. @raises InputError"""
    return [_read(text, plan) for text in plan.draw or ()]


def _read(text, plan):
    found = FORM_PATTERN.fullmatch(text)
    if not found:
        raise InputError(f"draw: '{text}' is not understood; expected {FORM}")
    gathered = list(dict.fromkeys([*(each.name for each in plan.wanted), *(each.base for each in plan.wanted)]))
    if found["name"] not in gathered:
        raise InputError(f"draw: nothing of the name '{found['name']}' is gathered{did_you_mean(found['name'], gathered)}")
    where = {}
    for part in (found["where"] or "").split(",") if found["where"] else ():
        name, equals, value = (word.strip() for word in part.partition("="))
        if not equals or not value:
            raise InputError(f"draw: '{part.strip()}' in '{text}': expected PARAMETER = VALUE")
        where[name] = value
    figure = Figure(found["name"], found["over"], found["by"], found["second"], where)
    used = [name for name in (figure.over, figure.by, figure.second) if name]
    for name in [*used, *where]:
        if name not in plan.names:
            raise InputError(f"draw: '{name}' is no parameter of the study{did_you_mean(name, plan.names)}")
    if len(set([*used, *where])) < len([*used, *where]):
        raise InputError(f"draw: '{text}' names a parameter twice")
    for name, value in where.items():
        column = {row[plan.names.index(name)] for row in plan.rows}
        if value not in column:
            raise InputError(f"draw: no run has {name} = {value}{did_you_mean(value, sorted(column))}")
    chosen = _chosen(plan, figure)
    for name in plan.names:
        if name not in used and len({plan.rows[k][plan.names.index(name)] for k in chosen}) > 1:
            raise InputError(f"draw: '{text}' leaves open which {name}: add 'by {name}' or 'where {name} = ..'")
    return figure


def suggested(plan):
    """Default figures: of all gathered numbers, over the parameters that vary, if these are one or two."""
    varying = [name for k, name in enumerate(plan.names) if len({row[k] for row in plan.rows}) > 1]
    if not 1 <= len(varying) <= 2:
        if len(varying) > 2 and plan.wanted:
            note(f"{len(varying)} parameters vary: say what to draw, '{FORM}'")
        return []
    counts = {name: len({row[plan.names.index(name)] for row in plan.rows}) for name in varying}
    varying.sort(key=lambda name: -counts[name])  # the longer one along the axis
    figures = [Figure(base, *varying) for base in dict.fromkeys(each.base for each in plan.wanted)]
    if len(varying) == 2 and min(counts.values()) >= 3 and counts[varying[0]] * counts[varying[1]] == len({tuple(row) for row in plan.rows}):
        figures += [Figure(each.name, varying[0], second=varying[1]) for each in plan.wanted]
    return figures


def _chosen(plan, figure):
    """Numbers, from 0, of the runs that a figure shows."""
    return [k for k, row in enumerate(plan.rows)
            if all(row[plan.names.index(name)] == value for name, value in figure.where.items())]


def draw(plan, collected, folder, extension="png"):
    """Draws the figures. @returns paths"""
    figures = read_figures(plan) if plan.draw is not None else suggested(plan)
    if not figures:
        return []
    try:
        from ..figures import plot_style as style
    except ImportError:  # a node of a cluster may have none
        note("nothing is drawn: Debian's python3-matplotlib is missing")
        return []
    os.makedirs(folder, exist_ok=True)
    written = []
    for figure in figures:
        chosen = [k for k in _chosen(plan, figure) if collected.status[k] == 0]
        curves = [each for each in plan.wanted if figure.name in (each.name, each.base)]
        if not any(np.isfinite(collected.numbers[each.name][chosen]).any() for each in curves):
            note(f"nothing to draw of '{figure.name}': no run has it")
            continue
        paint = _contours if figure.second else _lines
        fig = paint(style, plan, collected, figure, chosen, curves)
        if fig is not None:
            written.append(style.save(fig, os.path.join(folder, f"{figure.file}.{extension}")))
    return written


def numbers_of(texts):
    """Values of a parameter as numbers; None if some are formulas, which are then drawn in their order."""
    try:
        values = [float(text) for text in texts]
    except ValueError:
        return None
    return values if np.all(np.isfinite(values)) else None


def _axis(texts):
    """Positions of values on an axis, and labels if they are no numbers."""
    numbers = numbers_of(texts)
    if numbers is not None:
        return np.array(numbers), None
    order = list(dict.fromkeys(texts))
    return np.array([order.index(text) for text in texts], float), order


def _label(panel, side, name, labels):
    getattr(panel, f"set_{side}label")(name)
    if labels:
        getattr(panel, f"set_{side}ticks")(range(len(labels)), labels)


def _column(plan, name, chosen):
    return [plan.rows[k][plan.names.index(name)] for k in chosen]


def _title(plan, figure):
    held = ", ".join(f"{name} = {value}" for name, value in figure.where.items())
    return os.path.splitext(os.path.basename(plan.output))[0] + (f": {held}" if held else "")


def _lines(style, plan, collected, figure, chosen, curves):
    places, labels = _axis(_column(plan, figure.over, chosen))
    families = _column(plan, figure.by, chosen) if figure.by else [None] * len(chosen)
    with style.curves_of(len(set(places))):
        fig, axes = style.figure(1, _title(plan, figure), height=4.0)
        panel, count = axes[0, 0], 0
        for family in sorted(set(families), key=lambda text: (numbers_of([text]) or [0])[0] if text else 0):
            of_family = np.array([k for k, text in enumerate(families) if text == family])
            order = of_family[np.argsort(places[of_family], kind="stable")]
            for each in curves:
                name = each.name if len(curves) > 1 else ""
                text = ", ".join(filter(None, [name, f"{figure.by} = {family}" if family else ""]))
                values = collected.numbers[each.name][np.array(chosen)[order]]
                if count < MOST_CURVES:
                    panel.plot(places[order], values, label=text or None,
                               linestyle=("-", "--", ":")[count // len(style.COLOURS) % 3])
                count += 1
        if count > MOST_CURVES:
            note(f"'{figure.file}' shows {MOST_CURVES} of {count} lines; 'where' chooses others")
        _label(panel, "x", figure.over, labels)
        panel.set_ylabel(style.label(figure.name, collected.units.get(curves[0].name, "")))
        panel.set_title(curves[0].words if len(curves) == 1 else "")
        style.legend(panel)
    return fig


def _contours(style, plan, collected, figure, chosen, curves):
    each = curves[0]
    across, x_labels = _axis(_column(plan, figure.over, chosen))
    up, y_labels = _axis(_column(plan, figure.second, chosen))
    x, y = np.unique(across), np.unique(up)
    if min(len(x), len(y)) < 2:
        note(f"'{figure.file}' has no contours: they need two values of each parameter at least")
        return None
    table = np.full((len(y), len(x)), np.nan)
    table[np.searchsorted(y, up), np.searchsorted(x, across)] = collected.numbers[each.name][chosen]
    if not np.isfinite(table).all():
        note(f"'{figure.file}' has holes: {np.count_nonzero(~np.isfinite(table))} of {table.size} pairs of values have no number")
    fig, axes = style.figure(1, _title(plan, figure), height=5.0)
    panel = axes[0, 0]
    shown = np.ma.masked_invalid(table)
    if np.ptp(shown) > 0:
        filled = panel.contourf(x, y, shown, levels=14)
        panel.contour(x, y, shown, levels=filled.levels, colors="#00000055", linewidths=0.5)
    else:
        filled = panel.pcolormesh(x, y, shown, shading="nearest")
    panel.plot(across, up, ".", color="#00000066", markersize=2)
    fig.colorbar(filled, ax=panel, label=style.label(each.name, collected.units.get(each.name, "")))
    _label(panel, "x", figure.over, x_labels)
    _label(panel, "y", figure.second, y_labels)
    panel.set_title(each.words)
    return fig
