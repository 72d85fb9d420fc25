"""Columns of datasets over time: their values, names and units."""


def column_names(results, place, count=None):
    """Names of a dataset's columns: its description if it lists as many (`displacement, angle`, also after a colon), or
    1, 2, ... count: their number, if it is known"""
    count = len(columns_of(results, place)) if count is None else count
    names = [name.strip() for name in results.text(place, "description").split(": ")[-1].split(",")]
    return names if len(names) == count else [str(k + 1) for k in range(count)]


def column_units(results, place):
    """Units of a dataset's columns: one for all, or `m, rad` one for each; empty if the dataset is missing."""
    count = len(columns_of(results, place))
    units = [unit.strip() for unit in results.units(place).split(",")]
    return units if len(units) == count else [results.units(place)] * count


def columns_of(results, place):
    """Columns of a dataset over time, as a list of vectors; empty if the dataset is missing or not over time."""
    if not results.has(place):
        return []
    values = results.rows(place)
    return [values] if values.ndim == 1 else list(values.T) if values.ndim == 2 else []
