"""Single numbers of a run's results: `max joints/main/coordinate[angle]`, `measures/power at 0.5`, `eigen/frequency[1]`.

    [TAKE] DATASET[COLUMN] [at T] [from T] [to T] [in analysis N]
    text "limit point at load factor"[1]

In place of DATASET[COLUMN] stands any quantity (quantities.py), `main.reaction.norm`. Columns count from 1 or have the
names in the results; `[1:4]` makes four columns of the table; the largest and least values of several columns are those
of all. `text` is a number that follows these words in the program's output, for values that the results do not contain.
"""

import re

import numpy as np

from ..messages import InputError, check_names, did_you_mean
from ..quantities.quantities import Quantities
from ..results.columns import column_names, units_in
from ..results.results_file import Results
from ..results.rotations import made_of

TAKES = ["last", "first", "min", "max", "absmax", "mean", "rms", "peak_to_peak", "time_of_min", "time_of_max", "time_of_absmax"]
WITHOUT_ROWS = ("eigen", "peaks", "validity", "frequency_response", "events")
NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
PLACE = re.compile(r"(?P<place>[^\s\[\]\"]+/[^\s\[\]\"]+|time)(?:\[(?P<column>[^\]]*)\])?")
QUANTITY = re.compile(r"[^\"]*[A-Za-z_'][^\"]*[.(][^\"]*")
WORD = re.compile(r"(?:\([^()]*\)|'[^']*'|\S)+")  # brackets and quotes may hold spaces
OVER_ALL = {"min": ".min", "max": ".max", "absmax": ".abs",
            "time_of_min": ".min", "time_of_max": ".max", "time_of_absmax": ".abs"}
TEXT = re.compile(r'\s*text\s+"(?P<words>[^"]+)"\s*(?:\[(?P<number>\d+)\])?\s*')


class Missing(Exception):
    """This run does not contain the requested value."""


class Gathered:
    """One column of the table. name, words: as given."""

    def __init__(self, name, words):
        self.name, self.words, self.base = name, words, name
        self.take = self.at = self.begin = self.end = self.analysis = self.place = self.quantity = self.printed = None
        self.columns = []
        found = TEXT.fullmatch(words)
        if found:
            self.printed, self.number = " ".join(found["words"].split()), int(found["number"] or 1)
            if self.number < 1:
                self._refuse("numbers of a text count from 1")
            return
        self._read(words)

    def _refuse(self, what):
        raise InputError(f"gather: {self.name}: {what}")

    def _read(self, words):
        rest = WORD.findall(words)
        if rest and rest[0] in TAKES:
            self.take = rest.pop(0)
        elif len(rest) > 1 and "/" in rest[1] and not rest[1].startswith("["):
            self._refuse(f"'{rest[0]}' is nothing to take{did_you_mean(rest[0], TAKES)}")
        word = rest.pop(0) if rest else ""
        found = PLACE.fullmatch(word)
        if not found and (QUANTITY.fullmatch(word) or self.take and re.fullmatch(r"[A-Za-z_]\w*", word)):
            self.place = self.quantity = word
        elif not found:
            self._refuse(f"'{words}' names no dataset of the results; expected [TAKE] DATASET[COLUMN] [at T] [from T] [to T], "
                         "\"max joints/main/coordinate[1]\"")
        else:
            self.place, self.quantity = found["place"].strip("/"), word.strip("/")
            self.columns = [column.strip() for column in (found["column"] or "").split(",") if column.strip()]
        while rest:
            word = rest.pop(0)
            if word == "in" and len(rest) > 1 and rest[0] == "analysis" and re.fullmatch(r"[1-9]\d*", rest[1]):
                self.analysis, rest = int(rest[1]), rest[2:]
            elif word in ("at", "from", "to") and rest and re.fullmatch(NUMBER, rest[0]):
                setattr(self, {"at": "at", "from": "begin", "to": "end"}[word], float(rest.pop(0)))
            else:
                self._refuse(f"'{word}' is not understood; after the dataset stands 'at T', 'from T', 'to T' or 'in analysis N'")
        if self.at is not None and (self.take or self.begin is not None or self.end is not None):
            self._refuse("'at' gives the value at a time; it goes with nothing else to take")
        if self.begin is not None and self.end is not None and self.begin >= self.end:
            self._refuse(f"from {self.begin:g} to {self.end:g} is no span of time")
        if self.rows and self.take is None and self.at is None:
            self._refuse(f"what shall be taken of '{self.place}' over time? One of {', '.join(TAKES)}, or 'at T'")
        if not self.rows and (self.take or self.at is not None or self.begin is not None or self.end is not None):
            self._refuse(f"'{self.place}' is not over time: pick a number, '{self.place}[1]'")

    @property
    def rows(self):
        return self.place is not None and self.place.split("/")[0] not in WITHOUT_ROWS

    @property
    def needs(self):
        """The dataset or quantity that a run must keep; none for texts, which are always kept."""
        if self.place is None:
            return None
        _, place = made_of(self.place)
        return f"analysis_{self.analysis}/{place}" if self.analysis else place

    def value(self, results):
        """The number. @raises Missing, with the reason; InputError if the results have no such dataset. results: an
        open run"""
        if self.printed is not None:
            return self._printed(results)
        if self.analysis:
            return self._value(results.analysis(self.analysis))
        return self._value(results)

    def _printed(self, results):
        text = " ".join(results.text_of("study_said").split())
        numbers = re.findall(re.escape(self.printed) + rf"[\s:=]*({NUMBER})", text)
        if len(numbers) < self.number:
            raise Missing(f"what the program printed has '{self.printed}' with a number {len(numbers)} times")
        return float(numbers[self.number - 1])

    def _value(self, results):
        if not self.rows:
            self._check_dataset(results)
            return self._picked(results.array(self.place), results)
        values = self._column(results) if self._is_one_column(results) else self._of_quantity(results).one
        time = results.time
        if self.at is not None:
            if not time[0] <= self.at <= time[-1]:
                raise Missing(f"there is no time {self.at:g}: the results have {time[0]:g} to {time[-1]:g}")
            return float(np.interp(self.at, time, values))
        time, values = window(time, values, self.begin, self.end)
        return take(self.take, time, values)

    def _is_one_column(self, results):
        """Tells whether the number is taken from one column of a dataset, which the words pick; otherwise it is taken
        from any quantity."""
        return results.has(self.place) and (bool(self.columns) or self.take not in OVER_ALL)

    def _of_quantity(self, results):
        """A quantity; of several columns their largest or least values, if these are to be taken. @raises InputError"""
        quantities = Quantities(results)
        try:
            quantities.needs(self.quantity)
        except InputError:
            self._check_dataset(results)
            raise
        return quantities.read(self.quantity + OVER_ALL.get(self.take, ""))

    def units(self, results):
        """Units of the values that the words take from; empty if they differ."""
        if not self.rows:
            return results.units(self.place)
        if self._is_one_column(results):
            units = units_in(results.units(self.place), len(column_names(results, self.place)))
        else:
            units = self._of_quantity(results).units
        return units[0] if units and len(set(units)) == 1 else ""

    def _check_dataset(self, results):
        """@raises InputError with the nearest name if the results have no dataset of this name"""
        if "/" in self.place and not results.has(self.place):
            section, _, rest = self.place.partition("/")
            if section == "events":
                raise Missing("there were no events")
            names = results.names(section)
            entry = rest.split("/")[0]
            if rest and names and entry in names:
                check_names("dataset", [self.place], [f"{section}/{entry}/{name}" for name in results.datasets(f"{section}/{entry}")])
            known = [f"{section}/{name}{rest[len(entry):]}" for name in names]
            if section in results.root:
                known += [f"{section}/{name}" for name in results.datasets(section)]
            check_names("dataset", [self.place], known or list(results.root))

    def _column(self, results):
        values = results.rows(self.place)
        if values.ndim == 1:
            if self.columns:
                raise InputError(f"'{self.place}' has one column only: leave [{','.join(self.columns)}] out")
            return values
        if values.ndim == 2 and values.shape[1] == 1 and not self.columns:
            return values[:, 0]
        names = column_names(results, self.place)
        if values.ndim == 2 and len(self.columns) == 1 and self.columns[0] in names:
            return values[:, names.index(self.columns[0])]
        if values.ndim == 2 and values.shape[1] in (3, 6) and self.columns and self.columns[0] in _axes(values.shape[1]):
            return values[:, _axes(values.shape[1]).index(self.columns[0])]
        return np.array([self._picked(row, results) for row in values]) if values.ndim > 2 else self._of_columns(values, names)

    def _of_columns(self, values, names):
        if len(self.columns) == 1 and re.fullmatch(r"[1-9]\d*", self.columns[0]) and int(self.columns[0]) <= values.shape[1]:
            return values[:, int(self.columns[0]) - 1]
        known = [str(k + 1) for k in range(values.shape[1])] + [name for name in names if not name.isdigit()]
        if not self.columns:
            raise InputError(f"'{self.place}' has {values.shape[1]} columns: say which, '{self.place}[1]' (there are: {', '.join(known)})")
        raise InputError(f"'{self.place}' has no column '{','.join(self.columns)}'{did_you_mean(self.columns[0], known)}")

    def _picked(self, values, results):
        """A number of an array by as many columns as it has dimensions."""
        values = np.asarray(values)
        if values.size == 1 and not self.columns:
            return float(values.reshape(-1)[0])
        if len(self.columns) != values.ndim or not all(re.fullmatch(r"[1-9]\d*", column) for column in self.columns):
            shape = " x ".join(map(str, values.shape))
            raise InputError(f"'{self.place}' has {shape} numbers: pick one, '{self.place}[{','.join(['1'] * max(values.ndim, 1))}]'")
        place = tuple(int(column) - 1 for column in self.columns)
        if any(k >= n for k, n in zip(place, values.shape)):
            raise Missing(f"'{self.place}' has {' x '.join(map(str, values.shape))} numbers")
        return float(values[place])


def _axes(width):
    return ["x", "y", "z", "rx", "ry", "rz"][:width]


def window(time, values, begin, end):
    """The part of a polygon between two times, with values at its ends. @raises Missing"""
    if begin is None and end is None:
        return time, values
    begin, end = time[0] if begin is None else begin, time[-1] if end is None else end
    if begin < time[0] or end > time[-1] or begin >= end:
        raise Missing(f"there is no span from {begin:g} to {end:g}: the results have {time[0]:g} to {time[-1]:g}")
    inside = (time > begin) & (time < end)
    ends = np.interp([begin, end], time, values)
    return np.concatenate([[begin], time[inside], [end]]), np.concatenate([ends[:1], values[inside], ends[1:]])


def take(what, time, values):
    """@returns a number of a signal. @raises Missing if the signal has values that are no numbers"""
    if not np.all(np.isfinite(values)):
        raise Missing("the signal has values that are no numbers")
    if what.startswith("time_of_"):
        signal = {"min": -values, "max": values, "absmax": np.abs(values)}[what[8:]]
        return float(time[int(np.argmax(signal))])
    if what in ("mean", "rms"):
        span, steps, a, b = time[-1] - time[0], np.diff(time), values[:-1], values[1:]
        if span == 0:  # one row
            return float(values[-1]) if what == "mean" else float(abs(values[-1]))
        if what == "mean":
            return float((steps * (a + b)).sum() / (2 * span))
        return float(np.sqrt((steps * (a * a + a * b + b * b)).sum() / (3 * span)))
    return float({"last": lambda: values[-1], "first": lambda: values[0], "min": values.min, "max": values.max,
                  "absmax": lambda: np.abs(values).max(), "peak_to_peak": lambda: np.ptp(values)}[what]())


def read_gather(entries):
    """[(name, words)] -> Gathered; a range of columns makes one of each, `f_1`, `f_2`. @raises InputError"""
    found = []
    for name, words in entries:
        if not re.fullmatch(r"[A-Za-z_][\w.-]*", name):
            raise InputError(f"gather: '{name}' is no name: letters, digits, '_', '.' and '-' are")
        span = re.search(r"\[([1-9]\d*):([1-9]\d*)\]", words)
        if not span:
            found.append(Gathered(name, words))
            continue
        if not int(span[1]) <= int(span[2]) <= int(span[1]) + 999:
            raise InputError(f"gather: {name}: '{span[0]}' is no range of columns")
        for number in range(int(span[1]), int(span[2]) + 1):
            found.append(Gathered(f"{name}_{number}", words.replace(span[0], f"[{number}]")))
            found[-1].base = name
    names = [each.name for each in found]
    for name in names:
        if names.count(name) > 1:
            raise InputError(f"gather: '{name}' is there twice")
    return found
