"""Recovered quantities: rows of numbers that are linear in the unknowns, such as the stress of gauges (output
transformation matrices).

Each row has the SI name of its unit, by which its numbers are converted. A row of an unknown unit keeps the file's.
"""

from dataclasses import dataclass, replace

import numpy as np

from ..messages import InputError, counted, did_you_mean

# Unit of each kind that a user may name, and exponents of length, mass and time in it. Strain is m/m, so that verification knows it from
# other pure numbers: it vanishes in rigid motions.
KINDS = {"stress": "Pa", "strain": "m/m", "force": "N", "moment": "N m", "displacement": "m", "rotation": "rad", "number": "-"}
EXPONENTS = {"Pa": (-1, 1, -2), "m/m": (0, 0, 0), "-": (0, 0, 0), "N": (1, 1, -2), "N m": (2, 1, -2), "m": (1, 0, 0), "rad": (0, 0, 0)}
UNKNOWN = "unit of the file"
STRESS = ("xx", "yy", "zz", "yz", "xz", "xy")
NAME = "letters, digits and _"


@dataclass
class Quantity:
    """Rows that a file recovers from the unknowns."""

    rows: list           # (k) names of the rows
    units: list          # (k) keys of EXPONENTS, or UNKNOWN
    matrix: np.ndarray   # (k,n)


@dataclass(frozen=True)
class Request:
    """A quantity that the user names: the matrix of the file, and its kind."""

    matrix: str
    kind: str


def read_requests(text, option="--quantities"):
    """Requests of a text such as gauges=OTM1:stress,bars=MEF1:force. @returns dict by name @raises InputError"""
    requests = {}
    for part in filter(None, (part.strip() for part in text.split(","))):
        name, separator, rest = part.partition("=")
        matrix, _, kind = rest.partition(":")
        if not separator or not matrix or not kind:
            raise InputError(f"{option} '{part}': NAME=MATRIX:KIND is expected, such as gauges=OTM1:stress")
        if not is_name(name):
            raise InputError(f"{option} '{part}': '{name}' is no name: {NAME} are expected")
        if name in requests:
            raise InputError(f"{option}: there are two quantities '{name}'")
        if kind not in KINDS:
            raise InputError(f"{option} '{part}': there is no kind '{kind}'{did_you_mean(kind, KINDS)}; known ones: {', '.join(KINDS)}")
        requests[name] = Request(matrix, kind)
    return requests


def is_name(text):
    """Tells whether a text can be the name of a quantity or of a row."""
    return bool(text) and text.isascii() and text.replace("_", "a").isalnum() and not text[0].isdigit()


def check(name, quantity, size):
    """@raises InputError if the parts of a quantity do not fit together"""
    count = len(quantity.rows)
    if np.shape(quantity.matrix) != (count, size) or len(quantity.units) != count or not count:
        raise InputError(f"the quantity '{name}' has {counted(count, 'row')}, {counted(len(quantity.units), 'unit')} and a matrix of "
                         f"{' x '.join(map(str, np.shape(quantity.matrix)))} for {counted(size, 'unknown')}")
    if len(set(quantity.rows)) < count:
        twice = next(row for row in quantity.rows if quantity.rows.count(row) > 1)
        raise InputError(f"the quantity '{name}' has two rows '{twice}'")
    unnamed = next((row for row in quantity.rows if not is_name(row)), None)
    if unnamed is not None:
        raise InputError(f"the quantity '{name}' has a row '{unnamed}', which is no name: {NAME} are expected")
    strange = next((unit for unit in quantity.units if unit not in EXPONENTS and unit != UNKNOWN), None)
    if strange is not None:
        hint = f": that of {strange} is {KINDS[strange]}" if strange in KINDS else did_you_mean(strange, EXPONENTS)
        raise InputError(f"the quantity '{name}' has the unit '{strange}'{hint}; known ones: {', '.join(EXPONENTS)}")
    if not np.isfinite(quantity.matrix).all():
        raise InputError(f"the quantity '{name}' holds numbers that are not finite")


def converted_quantity(quantity, unknowns, factors):
    """@param unknowns: factor of each unknown @param factors: of length, mass and time"""
    scales = np.array([np.prod(np.power(factors, EXPONENTS.get(unit, (0, 0, 0)))) for unit in quantity.units])
    return replace(quantity, matrix=scales[:, None] * quantity.matrix / unknowns)


def with_columns(quantities, columns):
    """Quantities of other unknowns. @param columns: (n,m) old unknowns by the new ones"""
    return {name: replace(quantity, matrix=quantity.matrix @ columns) for name, quantity in quantities.items()}
