"""Numbers of the tables in tests/references, which scripts compute apart from Bielle."""

import csv
import functools
import os

FOLDER = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", "..", "references"))


@functools.lru_cache(maxsize=None)
def _table(subject):
    """{name: (value, within)} of a table."""
    with open(os.path.join(FOLDER, subject + ".csv"), newline="", encoding="utf-8") as file:
        return {line["name"]: (float(line["value"]), float(line["within"])) for line in csv.DictReader(file)}


def row(subject, name):
    """Arguments of a Quantity from one row of a table: the reference and its uncertainty."""
    value, within = _table(subject)[name]
    return {"reference": value, "known_to": within}


def vector(subject, *names, components=""):
    """The same from several rows, or from the rows name.x, name.y .. of each name for components="xy"."""
    rows = [f"{name}.{each}" for name in names for each in components] if components else names
    found = [_table(subject)[name] for name in rows]
    return {"reference": [value for value, _ in found], "known_to": max(within for _, within in found)}
