"""Quantities over time as users name them: `main.reaction.norm`, `arm.von_mises.max`, `nodes/pin/position.x`,
`crank.angle`.

NAME[COMPONENTS], with the names of places.py and the components of columns.py: `.x .y .z .rx .ry
.rz`, names of the columns, `[3]` (counted from 1; `[3,1]` or `[3].x` of elements with components), `.norm` (of six
components: of the first three), `.force`, `.moment`, `.max`, `.min`, `.abs` over all columns; `.von_mises` and
`.principal` of a stress. `analysis_2/NAME` is the quantity in one analysis of several.
"""

import dataclasses
import re

import numpy as np

from ..messages import InputError
from ..results.rotations import made_of
from .bodies import MADE, Bodies
from .columns import Columns, words_of
from .places import Places

AT_ONCE = 2**27  # bytes of rows that are read together
ALONG_COORDINATES = ("drive_force", "spring_force", "stop_force", "lock_force", "rate")
ARGUMENT = re.compile(r"\s*(?:'([^']*)'\s*|([^,)]*))([,)])")
OF_ANALYSIS = re.compile(r"analysis_([1-9]\d*)[/.](.+)", re.DOTALL)


@dataclasses.dataclass
class Quantity:
    """values (nt, columns) over time (nt); labels and units of each column; place: its dataset. axis: label of the
    times"""

    name: str
    place: str
    description: str
    labels: list
    units: list
    time: np.ndarray
    values: np.ndarray
    axis: str

    @property
    def one(self):
        """The values of a quantity with one column. @raises InputError for several"""
        if len(self.labels) != 1:
            raise InputError(f"'{self.name}' has {len(self.labels)} columns: say which, '{self.labels[0]}' "
                             f"(.. '{self.labels[-1]}'), or .max, .min, .abs")
        return self.values[:, 0]


class Quantities:
    """Finds and reads quantities of open results. superelements: {element: path} of --superelement"""

    def __init__(self, results, superelements=None):
        self.results, self.places, self.bodies = results, Places(results), Bodies(results, superelements)
        self.superelements, self._analyses = superelements, {}

    def _analysis(self, number):
        if number not in self._analyses:
            self._analyses[number] = Quantities(self.results.analysis(number), self.superelements)
        return self._analyses[number]

    def needs(self, text):
        """The datasets of which a quantity is made. @raises InputError for an unknown name"""
        of_one = OF_ANALYSIS.fullmatch(text.strip())
        if of_one:
            return [f"analysis_{of_one[1]}/{place}" for place in self._analysis(int(of_one[1])).needs(of_one[2])]
        place, _, _ = self.places.find(text)
        if place in self.places.made:
            return self.bodies.needs(*place.partition("/")[2].rpartition("/")[::2])
        return [made_of(place)[1]]

    def read(self, text, select=None):
        """A quantity at all rows that count, or at the ascending rows that `select` gives for its Results.
        @raises InputError"""
        of_one = OF_ANALYSIS.fullmatch(text.strip())
        if of_one:
            found = self._analysis(int(of_one[1])).read(of_one[2], select)
            before = f"analysis_{of_one[1]}/"
            return dataclasses.replace(found, name=before + found.name, place=before + found.place,
                                       labels=[before + label for label in found.labels])
        place, columns, description, read = self._found(text.strip())
        name = text.strip()
        rows = np.arange(len(self.results.time)) if select is None else select(self.results)
        block = len(rows) if made_of(place)[0] else max(1, AT_ONCE // (8 * max(1, columns.numbers)))
        values = _values(columns, read, rows, block)
        return Quantity(name, place, description, [name + label for label in columns.labels()], columns.all_units(),
                        self.results.time[rows], values, self.results.axis)

    def described(self, place):
        """Shape of a row, units and description of a quantity by its place; the shape is None if a superelement would
        have to be read."""
        if place in self.places.made:
            return (None, *MADE[place.rpartition("/")[2]])
        return self.results.shape(place)[1:], self.results.units(place), self.results.text(place, "description")

    def _found(self, text):
        """Place, Columns, description, and the function that reads rows."""
        place, column, rest = self.places.find(text)
        _, units, description = self.described(place)
        if place in self.places.made:
            element, _, field = place.partition("/")[2].rpartition("/")
            arguments, rest = arguments_of(rest)
            count = self.bodies.columns(element, field)
            shape = () if count == 1 and field != "von_mises" else (count,)

            def read(rows):
                return self.bodies.read(element, field, rows, arguments)
        else:
            shape = self.results.shape(place)[1:]

            def read(rows):
                return self.results.rows(place, rows)
        columns = Columns(place, shape, units, self._names_of_columns(place, description))
        for word in ([] if column is None else [f"[{column + 1}]"]) + words_of(rest, text):
            columns.take(word)
        return place, columns, description, read

    def _names_of_columns(self, place, description):
        """The description that names the columns: forces along the coordinates of a joint have the names of these."""
        folder, _, field = place.rpartition("/")
        along = place.startswith("joints/") and field in ALONG_COORDINATES
        return self.results.text(f"{folder}/coordinate", "description") if along else description


def _values(columns, read, rows, block):
    """Reads ascending rows in blocks, so that the fields of a body need not fit into memory at once."""
    parts = [np.zeros((0, len(columns.labels())))]
    for begin in range(0, len(rows), block or 1):
        some = rows[begin:begin + block]
        span = np.asarray(read(slice(int(some[0]), int(some[-1]) + 1)), float)  # picking rows by a list is slow in HDF5
        parts.append(columns.apply(span if len(span) == len(some) else span[some - some[0]]))
    return np.concatenate(parts)


def arguments_of(rest):
    """The words between brackets at the start of a text, and the text after them. Words with commas stand in quotes."""
    if not rest.startswith("("):
        return (), rest
    words, end = [], 1
    while found := ARGUMENT.match(rest, end):
        words.append((found[1] if found[1] is not None else found[2]).strip())
        end = found.end()
        if found[3] == ")":
            return tuple(words), rest[end:]
    raise InputError(f"'{rest}': a bracket is not closed")


def split_names(text):
    """`a.x, b.deflection(p, q, r), 'c,d'.y` -> the names between commas outside of brackets and quotes.
    @raises InputError if there is none"""
    names, depth, quoted = [""], 0, False
    for letter in text:
        quoted ^= letter == "'"
        depth += 0 if quoted else (letter in "([") - (letter in ")]")
        if letter == "," and depth <= 0 and not quoted:
            names.append("")
        else:
            names[-1] += letter
    names = [name.strip() for name in names]
    if not all(names):
        raise InputError(f"'{text}': the name of a quantity is missing")
    return names
