"""Components of quantities, `.x`, `[3]`, `.norm`, `.max`: the numbers of each row that they take, with names and units.

An axis is the list of the names of its columns. The first axes count places, points of a body or elements of a beam;
the last one has components, unless each place has one number.
"""

import re

import numpy as np

from ..messages import InputError, did_you_mean
from ..results.columns import names_in, units_in
from .rainflow import stress_signal

VECTOR = ["x", "y", "z", "rx", "ry", "rz"]
VECTORS = ("position", "velocity", "acceleration", "reaction", "reaction_inertial", "point", "force", "moment",
           "deformation", "centre", "momentum", "angular_momentum", "displacement", "resultants", "interface_force",
           "rotation_vector", "deflection", "section")
STRESS = ["xx", "yy", "zz", "yz", "xz", "xy"]
OF_SECTION = ["xx", "xy", "xz"]  # stresses in the section of a beam
QUATERNION = ["w", "x", "y", "z"]
OVER_ALL = {"max": np.fmax.reduce, "min": np.fmin.reduce,
            "abs": lambda values, axis: np.fmax.reduce(np.abs(values), axis=axis)}
SUFFIX = re.compile(r"\.([A-Za-z_]\w*)|\[([^\[\]]*)\]")


def words_of(text, where):
    """`.x[3].max` -> ["x", "[3]", "max"]. @raises InputError"""
    words, end = [], 0
    for found in SUFFIX.finditer(text):
        if found.start() != end:
            break
        words.append(found[1] if found[1] else f"[{found[2].strip()}]")
        end = found.end()
    if end != len(text):
        raise InputError(f"{where}: '{text[end:]}' is not understood; components are written '.x', '[3]', '.norm', "
                         "'.max'")
    return words


class Columns:
    """The columns of a quantity, and the operations that lead to them. `apply` computes them from rows (nt, ...)."""

    def __init__(self, place, shape, units, description):
        """shape: of a row"""
        field = place.rpartition("/")[2]
        self.place, self.numbers = place, int(np.prod(shape, dtype=float))
        self.axes = [[str(k + 1) for k in range(size)] for size in shape]
        self.units = units_in(units, shape[-1]) if shape else [units]
        six = bool(shape) and shape[-1] == 6
        of_rows = bool(shape) and all(re.fullmatch(r"[A-Za-z_]\w*", name) for name in names_in(description, shape[-1]))  # names of its own
        self.is_stress = six and ("stress" in field or "strain" in field) and "," not in units and not of_rows
        along = place.startswith("joints/") and field == "force"  # those of a gear are on coordinates, one each
        if along:
            description = description.rpartition(" on ")[2]
        named = names_in(description, shape[-1]) if shape else ["1"]
        unnamed = all(name.isdigit() for name in named)
        self.is_strain = "strain" in field
        self.is_vector = six and len(set(self.units)) == 2 and field not in ("rosette", "strain") or \
            bool(shape) and shape[-1] in (3, 6) and field in VECTORS and not along
        if shape:
            as_vector = (self.is_vector or six and field == "strain") and (unnamed or field in VECTORS)
            self.axes[-1] = list(STRESS) if self.is_stress else VECTOR[:shape[-1]] if as_vector else named
            if field == "rotation" and shape[-1] == 4:
                self.axes[-1] = list(QUATERNION)
        if field in ("stress", "von_mises") and len(shape) == (3 if field == "stress" else 2):  # beams have stress points
            self.axes[1] = [f"p{k + 1}" for k in range(shape[1])]
            self.axes[2:] = [list(OF_SECTION)] if shape[2:] == (3,) else self.axes[2:]
        self.steps = []
        self.words = ""  # the components as written

    def take(self, word):
        """Restricts the columns by one component. @raises InputError"""
        if word.startswith("["):
            self._index(word[1:-1])
        elif word in OVER_ALL:
            self._over_all(word)
        elif any(word in axis for axis in self.axes):
            axis = max(k for k, names in enumerate(self.axes) if word in names)
            self._pick(axis, self.axes[axis].index(word))
        elif self.is_vector and word in ("norm", "force", "moment"):
            self._norm(word)
        elif self.is_stress and word in self._invariants():
            self._of_stress(word)
        else:
            raise InputError(f"'{self.place}{self.words}' has no component '{word}'{did_you_mean(word, self.known())}")
        self.words += word if word.startswith("[") else "." + word

    def known(self):
        """The words that may follow."""
        names = [name for axis in reversed(self.axes) for name in axis if not name.isdigit()]
        norms = ["norm", "force", "moment"][:3 if len(self.axes[-1]) == 6 else 1] if self.is_vector else []
        over_all = list(OVER_ALL) if len(set(self.units)) == 1 else []
        return names + norms + self._invariants() * self.is_stress + over_all

    def _invariants(self):
        """Scalars of a symmetric tensor: a strain has no equivalent that all agree on."""
        return ["principal"] if self.is_strain else ["von_mises", "principal"]

    def _index(self, inside):
        if not self.axes:
            raise InputError(f"'{self.place}{self.words}' is one number at each time: leave [{inside}] out")
        words = [word.strip() for word in inside.split(",")]
        if len(words) == 1 and not words[0].isdigit() and words[0] in self.axes[-1]:
            self._pick(len(self.axes) - 1, self.axes[-1].index(words[0]))
            return
        if len(words) > len(self.axes):
            raise InputError(f"'{self.place}{self.words}' has {self.size()} numbers at each time: [{inside}] are too "
                             "many")
        for word in words:
            names = self.axes[0]
            if not re.fullmatch(r"[1-9]\d*", word) or int(word) > len(names):
                raise InputError(f"'{self.place}{self.words}' has no column '{word}': they count from 1 to "
                                 f"{len(names)}")
            self._pick(0, int(word) - 1)

    def _pick(self, axis, number):
        self.steps.append(lambda values: np.take(values, number, axis=1 + axis))
        if axis == len(self.axes) - 1:
            self._drop_components(self.units[number:number + 1] or self.units[:1])
        else:
            del self.axes[axis]

    def _norm(self, word):
        first = 3 if word == "moment" else 0
        if word != "norm" and len(self.axes[-1]) == 3:
            raise InputError(f"'{self.place}{self.words}' is one vector: its length is '.norm'")
        self.steps.append(lambda values: np.linalg.norm(values[..., first:first + 3], axis=-1))
        self._drop_components(self.units[first:first + 1])

    def _of_stress(self, word):
        factors = [1, 1, 1, 0.5, 0.5, 0.5] if self.is_strain else np.ones(6)  # strains have engineering shears

        def signal(values):
            return stress_signal((values * factors).reshape(-1, 6), word).reshape(values.shape[:-1])

        self.steps.append(signal)
        self._drop_components(self.units[:1])

    def _drop_components(self, units):
        del self.axes[-1]
        self.units, self.is_vector, self.is_stress = units, False, False

    def _over_all(self, word):
        if len(set(self.units)) > 1:
            raise InputError(f"'{self.place}{self.words}' has columns in {' and '.join(dict.fromkeys(self.units))}: "
                             f".{word} takes those of one unit; there are {', '.join(self.known())}")
        if not all(self.axes):
            raise InputError(f"'{self.place}{self.words}' has no columns")
        self.steps.append(lambda values: OVER_ALL[word](values.reshape(len(values), -1), axis=1))
        self.axes, self.units, self.is_vector, self.is_stress = [], self.units[:1], False, False

    def size(self):
        """` x `-separated numbers of columns."""
        return " x ".join(str(len(axis)) for axis in self.axes) or "1"

    def labels(self):
        """Names of the columns behind that of the quantity: `.x`, `[3]`, `[2].x`; one empty one for a single number."""
        texts = [""]
        if all(len(axis) == 1 for axis in self.axes):
            return texts
        for axis in self.axes:
            ends = [f"[{k + 1}]" if name.isdigit() else f".{name}" for k, name in enumerate(axis)]
            texts = [text + end for text in texts for end in ends]
        return texts

    def all_units(self):
        """Units of the columns, one each."""
        count = len(self.labels())
        return self.units * (count // len(self.units)) if self.units else []

    def apply(self, values):
        """(nt, columns) of rows (nt, ...)."""
        for step in self.steps:
            values = step(values)
        return values.reshape(len(values), -1)
