"""Curves of quantities: over time or over another quantity, their envelope, their spectra and orders."""

import dataclasses

import numpy as np

from ..messages import InputError, note, require
from .table_file import header

MOST_BINS = 400


@dataclasses.dataclass
class Curve:
    """label: of the quantity, of the run, or both; name: of the quantity alone; axis: of x, with its unit"""

    label: str
    name: str
    unit: str
    axis: str
    x: np.ndarray
    y: np.ndarray


def curves(runs, names, select, against=None):
    """A curve for each column of each quantity in each run. against: name of the quantity of the horizontal axis.
    @raises InputError"""
    found = []
    read = {name: [run.quantities.read(name, select) for run in runs] for name in names}
    alone = all(len(quantity.labels) == 1 for quantity in read[names[0]]) and len(names) == 1
    across = [run.quantities.read(against, select) for run in runs] if against else [None] * len(runs)
    for name in names:
        for run, quantity, other in zip(runs, read[name], across):
            x, axis = quantity.time, quantity.axis
            if other is not None:
                x, axis = other.one, header(other.name, other.units[0])
            if len(x) != len(quantity.time):
                raise InputError(f"'{name}' has {len(quantity.time)} rows, '{against}' {len(x)}: they are of different "
                                 "analyses")
            for label, unit, values in zip(quantity.labels, quantity.units, quantity.values.T):
                text = (run.label or label) if alone else f"{label}, {run.label}" if run.label else label
                found.append(Curve(text, label, unit, axis, x, values))
                if not np.isfinite(values).any():
                    note(f"{text}: there is nothing to draw: it has no value that is a number")
    return found


def with_gaps(curve):
    """The curve with a gap wherever its time goes back, as it does at a new analysis."""
    back = np.flatnonzero(np.diff(curve.x) < 0) + 1
    return dataclasses.replace(curve, x=np.insert(curve.x, back, np.nan), y=np.insert(curve.y, back, np.nan))


def spectra(found, kind):
    """Curves over the frequency. kind: `amplitude` or `psd`. Notes tell the resolution, and what was done to a
    signal."""
    require("scipy")
    from .spectra import amplitude_spectrum, power_density  # SciPy takes a while
    results = []
    for curve in found:
        if curve.axis != "time [s]":
            raise InputError(f"{curve.label} is over the {curve.axis}: a spectrum is of a signal over time")
        spectrum = (amplitude_spectrum if kind == "amplitude" else power_density)(curve.x, curve.y, curve.label)
        note("; ".join([f"{curve.label}: resolution {spectrum.resolution:.4g} Hz", *spectrum.remarks]))
        if not np.any(np.nan_to_num(np.diff(curve.y)) != 0):
            note(f"{curve.label} does not change: its spectrum is zero")
        unit = curve.unit if kind == "amplitude" else density(curve.unit)
        results.append(dataclasses.replace(curve, unit=unit, axis="frequency [Hz]", x=spectrum.x, y=spectrum.values))
    return results


def density(unit):
    """Unit of a power spectral density: `m^2/Hz`, `(m/s)^2/Hz`."""
    if unit in ("", "-", "1"):
        return "1/Hz"
    return f"{unit}^2/Hz" if unit.isalpha() else f"({unit})^2/Hz"


def orders(runs, names, select, speed):
    """[(Curve, Orders)] over the quantity `speed` [rad/s]. @raises InputError"""
    require("scipy")
    from .spectra import order_analysis  # SciPy takes a while
    results = []
    for run in runs:
        turning = run.quantities.read(speed, select)
        if turning.units != ["rad/s"]:
            raise InputError(f"--orders {speed}: an angular speed [rad/s] is expected; this is in "
                             f"{', '.join(dict.fromkeys(turning.units)) or '-'}")
        for curve in curves([run], names, select):
            if len(curve.x) != len(turning.time):
                raise InputError(f"'{curve.name}' and '{speed}' are of different analyses")
            found = order_analysis(curve.x, curve.y, turning.one, curve.label)
            note(f"{curve.label}: resolution {found.resolution:.4g} orders, {len(found.speed)} speeds")
            results.append((curve, found))
    return results


def envelopes(found):
    """[(Curve of the least values, Curve of the largest)] of all runs of each quantity, in intervals of the horizontal
    axis."""
    results = []
    for name in dict.fromkeys(curve.name for curve in found):
        those = [curve for curve in found if curve.name == name]
        x, least, largest = envelope([(curve.x, curve.y) for curve in those])
        results.append([dataclasses.replace(those[0], label=f"{name}, {text}", x=x, y=y)
                        for text, y in (("least", least), ("largest", largest))])
    return results


def envelope(pairs):
    """Middle of intervals, least and largest value of all polygons (x, y) in them; empty intervals have no numbers."""
    pairs = [(x[keep], y[keep]) for x, y in pairs for keep in [np.isfinite(x) & np.isfinite(y)]]
    rows = [len(x) for x, _ in pairs if len(x)]
    if not rows:
        return np.zeros(0), np.zeros(0), np.zeros(0)
    begin, end = min(x.min() for x, _ in pairs if len(x)), max(x.max() for x, _ in pairs if len(x))
    edges = np.linspace(begin, end, 1 + max(1, min(MOST_BINS, min(rows) - 1)))
    least, largest = np.full(len(edges) - 1, np.inf), np.full(len(edges) - 1, -np.inf)

    def add(place, y):
        np.minimum.at(least, place, y)
        np.maximum.at(largest, place, y)

    for x, y in pairs:
        add(np.clip(np.searchsorted(edges, x, "right") - 1, 0, len(least) - 1), y)
        if len(x) > 1 and np.all(np.diff(x) > 0):  # the polygon between its rows
            inside = (edges >= x[0]) & (edges <= x[-1])
            at, place = np.interp(edges[inside], x, y), np.flatnonzero(inside)
            add(np.minimum(place, len(least) - 1), at)
            add(np.maximum(place - 1, 0), at)
    empty = largest < least
    least[empty] = largest[empty] = np.nan
    return (edges[:-1] + edges[1:]) / 2, least, largest


def columns_of_curves(found):
    """[(header, values)] of a table: the horizontal axis once for curves that share it."""
    columns, last = [], None
    several = len({id(curve.x) for curve in found}) > 1
    for curve in found:
        if last is None or not np.array_equal(curve.x, last, equal_nan=True):
            columns.append((f"{curve.axis} of {curve.label}" if several and columns else curve.axis, curve.x))
            last = curve.x
        columns.append((header(curve.label, curve.unit), curve.y))
    return columns


def columns_of_orders(found):
    """[(header, values)] of a table with a line for each speed and order."""
    columns = []
    for curve, orders_ in found:
        shape = orders_.amplitude.shape
        columns += [(f"speed of {curve.label} [rad/s]", np.repeat(orders_.speed, shape[1])),
                    ("order", np.tile(orders_.order, shape[0])),
                    (header(f"amplitude of {curve.label}", curve.unit), orders_.amplitude.ravel())]
    return columns
