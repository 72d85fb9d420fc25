"""Reads results of bielle-mechanism: times, nodes, joints, elements, energies, as numpy arrays with their units.

Only the rows of `/time` count: after an interruption other datasets may be longer. In both layouts of the file a quantity of
an entry is known by the same name, `joints/main/coordinate`.
"""

import os

import h5py
import numpy as np

from .messages import InputError, note
from .stacked_layout import StackedLayout


class Results:
    """An open results file, or one analysis of it. Use as a context manager."""

    def __init__(self, path, analysis=None):
        """analysis: number of one analysis (1, 2, ...); None: each group as the last analysis that has it left it."""
        self.path = os.path.abspath(path)
        self.file = open_hdf5(path, "bielle results", "results of bielle-mechanism")
        self.root = self.file
        if analysis is not None:
            if f"analysis_{analysis}" not in self.file:
                known = ", ".join(sorted(name[9:] for name in self.file if name.startswith("analysis_"))) or "none"
                raise InputError(f"'{path}' holds no analysis {analysis} (it has {known})")
            self.root = self.file[f"analysis_{analysis}"]
        self._stacked = StackedLayout(self.root) if _text(self.file.attrs.get("layout", "named")) == "stacked" else None
        if "time" not in self.root and "eigen" not in self.root and "frequency_response" not in self.root:
            raise InputError(f"'{path}' holds no results yet: the run ended before its first step was recorded")
        self.time = np.asarray(self.root["time"]) if "time" in self.root else np.zeros(0)
        self.static = self._kind() == "static"  # then `time` is the load factor
        if not self.file.attrs.get("complete", True):
            note(f"{path}: the run was not completed; its {len(self.time)} recorded times are shown")

    def _kind(self):
        """Type of the analysis whose time this is."""
        for name, analysis in self.file.items():
            if name.startswith("analysis_") and "time" in analysis and "time" in self.root \
                    and analysis["time"] == self.root["time"]:
                return _text(analysis.attrs.get("type", ""))
        return ""

    @property
    def axis(self):
        """What the horizontal axis of a figure over the rows is called."""
        return "load factor" if self.static else "time [s]"

    def moment(self, row):
        """`t = 0.1230 s`: which row it is, in words."""
        return f"load factor {self.time[row]:.4g}" if self.static else f"t = {self.time[row]:.4f} s"

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.file.close()

    @property
    def title(self):
        """Name of the mechanism, or of the file."""
        return self.text("/", "name") or os.path.splitext(os.path.basename(self.path))[0]

    def names(self, section):
        """Names under `nodes`, `joints`, `elements`, ...; empty when there are none."""
        stacked = self._stacked and self._stacked.names(section)
        if stacked is not None:
            return stacked
        return list(self.root[section]) if section in self.root else []

    def has(self, place):
        found = self._found(place)
        return place in self.root if found is None else self._stacked.has(found)

    def array(self, place):
        """A dataset that is not over time, whole."""
        found = self._found(place)
        return np.asarray(self.root[place]) if found is None else self._stacked.value(found)

    def shape(self, place):
        """Of a dataset over time, (nt,...)."""
        found = self._found(place)
        return self.root[place].shape if found is None else self._stacked.shape(found)

    def datasets(self, place):
        """Names of the datasets in a group; empty where it is none."""
        found = self._found(place)
        if found is not None:
            return self._stacked.datasets(found) if self._stacked.has(found) else []
        group = self.root[place]
        return [name for name in group if hasattr(group[name], "shape")] if hasattr(group, "keys") else []

    def _found(self, place):
        """Where the stacked layout has what the layout by names calls `place`; None where it stands under its name."""
        return self._stacked.split(place) if self._stacked else None

    def text(self, place, attribute):
        """A text attribute of a group or dataset; empty when there is none."""
        found = self._found(place)
        if found is not None:
            return _text(self._stacked.text(found, attribute)) if found else ""
        return _text(self.root[place].attrs.get(attribute, "") if place in self.root else "")

    def entry_of(self, element):
        """The element of the mechanism file: of the piece `blade.2` of a body it is `blade`."""
        return element.rpartition(".")[0] if self.text(f"elements/{element}", "group") else element

    def rows(self, place, index=None):
        """A dataset over time, clipped to the rows that count; `index` picks rows."""
        found = self._found(place)
        if found is not None:
            return self._stacked.read(found, slice(0, len(self.time)) if index is None else index)
        data = self.root[place]
        return np.asarray(data[:len(self.time)] if index is None else data[index])

    def units(self, place):
        return self.text(place, "units")

    def elements_with(self, *datasets):
        """Elements that record all of these: `frame` is a superelement, `rotation` a beam."""
        return [name for name in self.names("elements") if all(self.has(f"elements/{name}/{d}") for d in datasets)]

    def frames(self, every=None, count=None, span=(None, None)):
        """Row numbers of every `every`-th time, or of about `count` evenly spaced ones, within span = (from, to) [s]."""
        begin, end = (-np.inf if span[0] is None else span[0], np.inf if span[1] is None else span[1])
        rows = np.flatnonzero((self.time >= begin) & (self.time <= end))
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


def open_hdf5(path, expected, meaning):
    """Opens an HDF5 file whose attribute `format` must be `expected`. @raises InputError"""
    if not os.path.isfile(path):
        raise InputError(f"'{path}' does not exist")
    try:
        file = h5py.File(path, "r")
    except OSError:
        raise InputError(f"'{path}' is no HDF5 file, or it is damaged") from None
    found = _text(file.attrs.get("format", ""))
    if found != expected:
        file.close()
        raise InputError(f"'{path}' does not hold {meaning}" + (f" but '{found}'" if found else ""))
    return file


def _text(value):
    return value.decode() if isinstance(value, bytes) else str(value)


def rotation_matrices(quaternions):
    """(...,4) unit quaternions w x y z -> (...,3,3) matrices R: body -> inertial."""
    w, x, y, z = np.moveaxis(np.asarray(quaternions, float), -1, 0)
    return np.stack([1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),
                     2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
                     2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)], axis=-1).reshape(*w.shape, 3, 3)
