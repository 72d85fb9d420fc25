"""The recorded quantities of a motion, for plots and for the values of an entry; up to a number of values."""

import numpy as np

from ..messages import InputError
from ..results.columns import column_names

SECTIONS = ("measures", "energy", "joints", "supports", "contacts", "elements", "nodes", "loads", "hydraulics", "solver")
MOST_VALUES, MOST_COLUMNS, MOST_ROWS = 1_200_000, 24, 1000


def quantities(results, pack):
    """{times: values over time, list: [{entry, name, units, columns, data}], left_out: number of quantities}"""
    rows = np.asarray(results.frames(count=MOST_ROWS)) if len(results.time) > 1 else np.arange(len(results.time))
    found, budget, left_out = [], MOST_VALUES, 0
    for entry, place in _places(results):
        try:
            shape = results.shape(place)
            columns = int(np.prod(shape[1:], dtype=int))
            if len(shape) < 1 or shape[0] < len(results.time) or not 0 < columns <= MOST_COLUMNS or len(shape) > 2:
                continue
            if columns * len(rows) > budget:
                left_out += 1
                continue
            values = results.rows(place)[rows].reshape(len(rows), columns)
            names = _names(results, place, columns)
            budget -= values.size
            found.append({"entry": entry, "name": place.rpartition("/")[2], "units": results.units(place), "columns": names,
                          "data": pack.add(values.T, "f4")})
        except (InputError, ValueError, KeyError):
            continue
    return {"times": pack.add(results.time[rows], "f4"), "list": found, "left_out": left_out}


def _names(results, place, count):
    """Names of columns; x y z .. of vectors and quaternions of nodes that have none."""
    names = column_names(results, place, count) if count > 1 else [""]
    plain = {3: "x y z", 4: "w x y z", 6: "x y z rx ry rz"}.get(count, "").split()
    return plain if plain and names[0] == "1" and (place.startswith(("nodes/", "supports/")) or place.endswith(("/reaction", "/reaction_inertial"))) else names


def _places(results):
    for section in SECTIONS:
        if section in ("energy", "solver"):
            yield from ((section, f"{section}/{name}") for name in (results.datasets(section) if section in results.root else []))
            continue
        for name in results.names(section):
            if section == "measures":
                yield f"measures/{name}", f"measures/{name}"
            else:
                yield from ((f"{section}/{name}", f"{section}/{name}/{each}") for each in results.datasets(f"{section}/{name}"))
