"""Reads results of bielle-mechanism: times, nodes, joints, elements, energies, as numpy arrays with their units.

Only the rows of `/time` count: after an interruption other datasets may be longer. In both layouts of the file a quantity of
an entry is known by the same name, `joints/main/coordinate`. Beside what is recorded, nodes have `rotation_vector`, `bryant` and
`euler`, made of their `rotation` and continuous over turns: `nodes/pin/bryant`.
"""

import contextlib
import functools
import os

import h5py
import numpy as np

from ..messages import InputError, counted, limited_reading, note
from .rotations import ROTATION_QUANTITIES, made_of, rotation_quantity
from .stacked_layout import StackedLayout

# Dimensions after the rows of the datasets that the tools use; None: any number.
SHAPES = {("nodes", "position"): (3,), ("nodes", "rotation"): (4,), ("nodes", "velocity"): (6,),
          ("joints", "coordinate"): (None,), ("joints", "rate"): (None,), ("joints", "drive_force"): (None,),
          ("joints", "reaction"): (6,), ("joints", "reaction_inertial"): (6,),
          ("elements", "frame"): (7,), ("elements", "coordinates"): (None,), ("elements", "rotation"): (None, 4),
          ("elements", "position"): (None, 3), ("elements", "resultants"): (None, 6)}
LARGEST = 1e100  # no quantity is larger
WITHOUT_ROWS = ("eigen", "campbell", "frequency_response", "state_space")  # analyses that record nothing over time
# Purpose of other files of Bielle.
OF_ENTRIES = ("nodes", "joints", "elements", "supports", "contacts")  # sections with a group for each entry
OTHERS = {"bielle superelement": "'bielle-reduce --inspect {0}' describes it",
          "bielle cut body": "'bielle-reduce --inspect {0}' describes it",
          "bielle matrices": "'bielle-exchange {0} OUT' writes them in another format",
          "bielle study": "'bielle-plot {0} --quantity ..' draws its runs, which are the groups /runs/1, /runs/2, ..."}
WORDS = {"bielle superelement": "a superelement", "bielle cut body": "a body in pieces", "bielle study": "a study",
         "bielle matrices": "matrices of another program",
         "bielle results": "results of bielle-mechanism"}


@contextlib.contextmanager
def reading(path, what):
    """Converts errors of the HDF5 library on a damaged file, and inconsistencies in it, to one sentence.
    @raises InputError"""
    try:
        with limited_reading():
            yield
    except (AttributeError, IndexError, KeyError, MemoryError, OSError, OverflowError, RuntimeError, TypeError, ValueError) as error:
        reason = "there is not enough memory for it" if isinstance(error, MemoryError) else "it is damaged"
        raise InputError(f"'{path}': '{what}' cannot be read: {reason}") from None


def _told(method):
    """Decorates a method whose first argument is a place in the file: a place that cannot be read is reported."""
    @functools.wraps(method)
    def reads(self, place, *arguments, **options):
        with reading(self.path, place):
            return method(self, place, *arguments, **options)
    return reads


class Results:
    """An open results file, or one analysis of it. It is a context manager."""

    def __init__(self, path, analysis=None, group=""):
        """analysis: number of one analysis (1, 2, ...); None: each group from the last analysis that wrote it; group: of the run in
        the file of a study, `runs/3`."""
        self.path, self.group = os.path.abspath(path), group
        self._opened = open_hdf5(path, "bielle study", "a study") if group else open_hdf5(path, "bielle results", "results of bielle-mechanism")
        with reading(self.path, group or "/"):
            self.file = self._opened[group] if group else self._opened
        self.root = self.file
        self._warned, self._names, self._analyses = set(), {}, {}
        with reading(self.path, "/"):
            if analysis is not None:
                if f"analysis_{analysis}" not in self.file:
                    known = ", ".join(sorted(name[9:] for name in self.file if name.startswith("analysis_"))) or "none"
                    raise InputError(f"'{path}' holds no analysis {analysis} (it has {known})")
                self.root = self.file[f"analysis_{analysis}"]
            self._stacked = StackedLayout(self.root) if _text(self.file.attrs.get("layout", "named")) == "stacked" else None
            other = any(name in self.root for name in WITHOUT_ROWS)
            complete = bool(np.all(self.file.attrs.get("complete", True)))
        self.time = self._times()
        if not len(self.time) and not other:
            raise InputError(f"'{path}' holds no results yet: the run ended before its first step was recorded")
        with reading(self.path, "/"):
            self.kind = self._kind()
            self.static = self.kind == "static"  # then `time` is the load factor
        if not complete:
            note(f"{path}: the run was not completed; {counted(len(self.time), 'recorded time')} of it can be shown")

    def _times(self):
        with reading(self.path, "time"):
            if "time" not in self.root:
                return np.zeros(0)
            time = np.asarray(self.root["time"])
            if time.ndim != 1 or time.dtype.kind not in "fiu":
                raise TypeError
        if not np.all(np.abs(time) < LARGEST):
            raise InputError(f"'{self.path}': 'time' holds values that are no times: the file is damaged")
        return time.astype(float)

    def _kind(self):
        """Type of the analysis whose time this is."""
        for name, analysis in self.file.items():
            if name.startswith("analysis_") and isinstance(analysis, h5py.Group) and "time" in analysis and "time" in self.root \
                    and analysis["time"] == self.root["time"]:
                return _text(analysis.attrs.get("type", ""))
        return ""

    @property
    def stacked(self):
        """Tells whether the file has the stacked layout."""
        return self._stacked is not None

    @property
    def axis(self):
        """Label of the horizontal axis of a figure over the rows."""
        return "load factor" if self.static else "time [s]"

    def moment(self, row):
        """`t = 0.1230 s`: describes a row. A model that was only checked has no time."""
        if self.kind == "check":
            return ""
        return f"load factor {self.time[row]:.4g}" if self.static else f"t = {self.time[row]:.4f} s"

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for one in self._analyses.values():
            one.__exit__()
        self._opened.close()

    def analysis(self, number):
        """One analysis of the file, open as long as these results. @raises InputError if there is none"""
        if number not in self._analyses:
            self._analyses[number] = Results(self.path, number, self.group)
        return self._analyses[number]

    @property
    def title(self):
        """Name of the mechanism, or of the file."""
        return self.text("/", "name") or os.path.splitext(os.path.basename(self.path))[0]

    @property
    def created_by(self):
        """Name, version and commit of the program that computed the results; empty if the file does not tell."""
        return self.text("/", "created_by")

    @_told
    def names(self, section):
        """Names under `nodes`, `joints`, `elements`, ...; empty if there are none. Names of entries may contain `/`."""
        stacked = self._stacked and self._stacked.names(section)
        if stacked is not None:
            return stacked
        if section not in self._names:
            group = self.root[section] if section in self.root else {}
            self._names[section] = list(_entries(group)) if section in OF_ENTRIES else \
                [name for name in group if group.get(name, getclass=True) is h5py.Group or section == "measures"]
        return list(self._names[section])

    @_told
    def has(self, place):
        _, place = made_of(place)
        found = self._found(place)
        return place in self.root if found is None else self._stacked.has(found)

    @_told
    def array(self, place):
        """A complete dataset that is not over time."""
        found = self._found(place)
        return self._judged(place, np.asarray(self.root[place])) if found is None else self._stacked.value(found)

    @_told
    def shape(self, place):
        """Shape of a dataset over time, (nt,...)."""
        quantity, place = made_of(place)
        found = self._found(place)
        shape = self.root[place].shape if found is None else self._stacked.shape(found)
        return (*shape[:-1], 3) if quantity else shape

    @_told
    def datasets(self, place):
        """Names of the datasets in a group, and of what is made of them; empty where it is none."""
        found = self._found(place)
        if found is not None:
            names = self._stacked.datasets(found) if self._stacked.has(found) else []
        else:
            group = self.root[place]
            names = [name for name in group if group.get(name, getclass=True) is h5py.Dataset] if hasattr(group, "keys") else []
        made = place.strip("/").startswith("nodes/") and "rotation" in names
        return names + [name for name in ROTATION_QUANTITIES if made and name not in names]

    def _found(self, place):
        """Place in the stacked layout of the dataset that the layout by names calls `place`; None if it exists under
        its name."""
        return self._stacked.split(place) if self._stacked else None

    @_told
    def text(self, place, attribute):
        """A text attribute of a group or dataset; empty when there is none."""
        quantity, source = made_of(place)
        if quantity:
            return ROTATION_QUANTITIES[quantity].get(attribute, "") if self.has(source) else ""
        found = self._found(place)
        if found is not None:
            return _text(self._stacked.text(found, attribute)) if found else ""
        return _text(self.root[place].attrs.get(attribute, "") if place in self.root else "")

    def analyses_with_rows(self):
        """Numbers of the analyses of the file that recorded something over time, or a state."""
        with reading(self.path, "/"):
            found = [(name, self.file[name]) for name in self.file if name.startswith("analysis_") and name[9:].isdigit()]
            return [int(name[9:]) for name, group in found if "time" in group and len(group["time"])]

    def text_of(self, name):
        """A text at the root, `input`; empty if there is none."""
        with reading(self.path, name):
            return _text(self.file[name][()]) if name in self.file else ""

    def entry_of(self, element):
        """The element of the mechanism file: for the piece `blade.2` of a body it is `blade`."""
        return element.rpartition(".")[0] if self.text(f"elements/{element}", "group") else element

    @_told
    def rows(self, place, index=None):
        """A dataset over time, clipped to the rows that count; `index` picks rows. A value that is no number, or is beyond all bounds, is nan."""
        quantity, source = made_of(place)
        if quantity:
            values = rotation_quantity(quantity, self.rows(source))
            return values if index is None else values[index]
        found = self._found(place)
        if found == ():
            raise KeyError(place)
        data = self.root[place] if found is None else self._stacked.dataset(found)
        if not isinstance(data, h5py.Dataset) or data.dtype.kind not in "fiu":
            raise InputError(f"'{self.path}': '{place}' holds no numbers")
        shape = self.shape(place)
        if not shape:
            raise InputError(f"'{self.path}': '{place}' is no quantity over time")
        words = place.strip("/").split("/")
        expected = SHAPES.get((words[0], words[-1])) if len(words) > 2 else () if words[0] in ("energy", "solver") else None
        if shape[0] < len(self.time) or expected is not None and (
                len(shape) != 1 + len(expected) or any(want not in (None, have) for want, have in zip(expected, shape[1:]))):
            each = " x ".join("n" if size is None else str(size) for size in expected or ())
            raise InputError(f"'{self.path}': '{place}' is damaged: it has the shape {shape}, not {len(self.time)} rows"
                             + (f" of {each}" if each else ""))
        if 8 * np.prod(shape, dtype=float) > max(2.0**30, 1000 * os.path.getsize(self.path)):
            raise InputError(f"'{self.path}': '{place}' is damaged: it is larger than the file")
        if found is not None:
            return self._judged(place, self._stacked.read(found, slice(0, len(self.time)) if index is None else index))
        return self._judged(place, np.asarray(data[:len(self.time)] if index is None else data[index]))

    def _judged(self, place, values):
        """Replaces values that cannot be used. Reports once that there are some."""
        if values.dtype.kind != "f":
            return values
        bad = ~(np.abs(values) < LARGEST)
        if not bad.any():
            return values
        # These are intended: nodes without stress, modes that were lost or have no sense of whirl.
        if place not in self._warned and not place.endswith(("von_mises", "stress", "strain")) and not place.startswith("campbell/"):
            self._warned.add(place)
            note(f"{self.path}: '{place}' holds values that are no numbers, or larger than {LARGEST:g}: they are left out")
        return np.where(bad, np.nan, values)

    def note_once(self, text):
        """Prints a note for the user, the first time alone: many pictures are made of one file."""
        if text not in self._warned:
            self._warned.add(text)
            note(text)

    def units(self, place):
        return self.text(place, "units")

    def elements_with(self, *datasets):
        """Elements that record all of these: `frame` is a superelement, `rotation` a beam."""
        return [name for name in self.names("elements") if all(self.has(f"elements/{name}/{d}") for d in datasets)]

    def frames(self, every=None, count=None, span=(None, None)):
        """Row numbers of every `every`-th time, or of about `count` evenly spaced ones, within span = (from, to) [s]."""
        begin, end = (-np.inf if span[0] is None else span[0], np.inf if span[1] is None else span[1])
        rows = np.flatnonzero((self.time >= begin) & (self.time <= end))
        if not len(self.time):
            return rows
        if not len(rows):
            what, unit = ("load factor", "") if self.static else ("time", " s")
            raise InputError(f"'{self.path}' has no {what} from {begin:g} to {end:g}{unit}; it has {self.time[0]:g} to "
                             f"{self.time[-1]:g}{unit}")
        if every:
            return rows[::every]
        if count is None or len(rows) <= count:
            return rows
        wanted = np.linspace(self.time[rows[0]], self.time[rows[-1]], count)
        return np.unique(rows[np.abs(self.time[rows, None] - wanted[None, :]).argmin(axis=0)])


def _entries(group, before="", known=None):
    """Names of the entries of a section in the layout by names: groups with datasets or a type. That of `left` may hold
    that of `left/arm`. known: addresses of the groups so far, since a damaged file may lead back to them"""
    known = set() if known is None else known
    for name in group:
        if group.get(name, getclass=True) is not h5py.Group:
            continue
        inner = group[name]
        address = h5py.h5o.get_info(inner.id).addr
        if address in known:
            continue
        known.add(address)
        kinds = {inner.get(each, getclass=True) for each in inner}
        if h5py.Dataset in kinds or "type" in inner.attrs:
            yield before + name
        if h5py.Group in kinds:
            yield from _entries(inner, f"{before}{name}/", known)


def modes_to_show(results):
    """` (--mode 1 shows one of its 6 modes)` if there are modes."""
    if not isinstance(results, Results) or not results.has("eigen/frequency"):
        return ""
    return f"; it has {counted(len(results.array('eigen/frequency')), 'mode')}: --mode 1 shows the first"


def open_hdf5(path, expected, meaning):
    """Opens an HDF5 file whose attribute `format` must be `expected`. @raises InputError"""
    if not os.path.exists(path):
        raise InputError(f"'{path}' does not exist")
    if not os.path.isfile(path):
        raise InputError(f"'{path}' is a folder or a device, not a file with {meaning}")
    if not os.access(path, os.R_OK):
        raise InputError(f"'{path}' cannot be read: Permission denied")
    try:
        with limited_reading():
            file = h5py.File(path, "r")
    except (OSError, RuntimeError, ValueError):
        raise InputError(f"'{path}' does not hold {meaning}: it is {_what_it_is(path)}") from None
    with reading(path, "/"):
        found = _text(file.attrs.get("format", ""))
    if found != expected:
        file.close()
        advice = OTHERS.get(found, "").format(path)
        raise InputError(f"'{path}' does not hold {meaning}" + (f" but {WORDS.get(found, repr(found))}" if found else "")
                         + (f": {advice}" if advice else ""))
    return file


def _what_it_is(path):
    """Describes a file that HDF5 does not open."""
    with open(path, "rb") as file:
        head = file.read(4096)
    if not head:
        return "empty"
    if head.startswith(b"\x89HDF\r\n\x1a\n"):
        return "a damaged or truncated HDF5 file"
    try:
        text = head.decode("utf-8")
    except UnicodeDecodeError:
        return "no HDF5 file"
    keys = {line.split(":")[0].strip() for line in text.splitlines() if line[:1].isalpha() and ":" in line}
    if keys & {"nodes", "elements", "joints", "analysis", "mechanism"}:
        return "no HDF5 file but text, a mechanism file: 'bielle-mechanism' makes results of it"
    if keys & {"geometry", "interfaces", "materials"}:
        return "no HDF5 file but text, a body file: 'bielle-reduce' makes a superelement of it"
    return "no HDF5 file but text" if text.isprintable() or "\n" in text else "no HDF5 file"


def _text(value):
    return value.decode() if isinstance(value, bytes) else str(value)
