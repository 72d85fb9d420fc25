"""Comments by which a deck that Bielle writes names a recovered quantity and its rows:

    $ OTM1: gauges
    $ row 1: front [Pa]
    $ row 2: rear [Pa]

Nastran has no card for such names. They are read again, so that a quantity comes back whole.
"""

import re
from dataclasses import dataclass

from ..text_lines import lines_of
from .recovery import EXPONENTS, UNKNOWN, is_name

QUANTITY = re.compile(r"\$ (OTM\d+): (\w+)\s*").fullmatch
ROW = re.compile(r"\$ row (\d+): (\w+) \[([^]]+)\]\s*").fullmatch


@dataclass
class Told:
    """Names that comments give to a quantity, its rows, and their units."""

    name: str
    rows: list
    units: list


def comments_of(matrix, name, quantity):
    """Lines that name a quantity and its rows."""
    rows = [f"$ row {row + 1}: {label} [{unit}]" for row, (label, unit) in enumerate(zip(quantity.rows, quantity.units))]
    return [line.encode("ascii", "replace").decode() for line in (f"$ {matrix}: {name}", *rows)]


def told_quantities(path):
    """Returns the Told of each matrix by its name. Comments in any other form are ignored."""
    found, last = {}, None
    for line in lines_of(path):
        head, row = QUANTITY(line), ROW(line)
        if head and is_name(head[2]):
            last = found[head[1]] = Told(head[2], [], [])
        elif row and last and int(row[1]) == len(last.rows) + 1 and is_name(row[2]) and (row[3] in EXPONENTS or row[3] == UNKNOWN):
            last.rows.append(row[2])
            last.units.append(row[3])
        else:
            last = None
    return {matrix: told for matrix, told in found.items() if told.rows and len(set(told.rows)) == len(told.rows)}
