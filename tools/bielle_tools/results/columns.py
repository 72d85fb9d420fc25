"""Columns of datasets over time: their values, names and units."""

import re


def names_in(description, count):
    """Names of columns: those of a description if it lists as many (`displacement, angle`, also after a colon or
    "along"), or 1, 2, ..."""
    names = [name.strip() for name in re.split(": | along ", description)[-1].split(",")]
    return names if len(names) == count else [str(k + 1) for k in range(count)]


def units_in(units, count):
    """Units of columns: one for all; `m, rad` one for each; of vectors with forces and moments (`N, N m`) one for the
    first three columns, one for the others."""
    each = [unit.strip() for unit in units.split(",")]
    if len(each) == count:
        return each
    return [each[0]] * 3 + [each[1]] * (count - 3) if len(each) == 2 and count > 3 else [units] * count


def column_names(results, place, count=None):
    """Names of a dataset's columns, by its description. count: their number, if it is known"""
    return names_in(results.text(place, "description"), len(columns_of(results, place)) if count is None else count)


def column_units(results, place):
    """Units of a dataset's columns; empty if the dataset is missing."""
    return units_in(results.units(place), len(columns_of(results, place)))


def columns_of(results, place):
    """Columns of a dataset over time, as a list of vectors; empty if the dataset is missing or not over time."""
    if not results.has(place):
        return []
    values = results.rows(place)
    return [values] if values.ndim == 1 else list(values.T) if values.ndim == 2 else []
