"""Results of an analysis, in memory."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import NamedTuple

import numpy as np

from . import _core, rotations

ROTATION_QUANTITIES = ("rotation_vector", "bryant", "euler")


class Dataset(NamedTuple):
    """Shape and units of a dataset."""

    shape: tuple[int, ...]  # shape of one row, or of the whole dataset if it has no rows
    units: str
    description: str
    rows: bool  # whether it has one entry per row


class Event(NamedTuple):
    """A crossing that a motion has passed: the end of a contact, an event of the model."""

    time: float  # [s]
    name: str


def made_of(name: str) -> tuple[str, str]:
    """Which quantity is made of which dataset: ("bryant", "nodes/pin/rotation") of "nodes/pin/bryant"; ("", name) of others."""
    node, _, quantity = name.rpartition("/")
    if not node.startswith("nodes/") or quantity not in ROTATION_QUANTITIES:
        return "", name
    return quantity, f"{node}/rotation"


class NothingKept:
    """Stands in place of the results of an analysis whose rows are not in memory."""

    def __init__(self, type_: str):
        self._type = type_

    def type(self, _: int) -> str:
        return self._type

    def rows(self, _: int) -> int:
        return 0

    def read(self, _: int, name: str) -> np.ndarray:
        raise _core.InputError(f"'{name}' was not kept in memory: that was not asked for")

    def datasets(self, _: int) -> dict:
        return {}

    def events(self, _: int) -> list:
        return []


class Results(Mapping):
    """The records of one analysis, by the names of a results file: results["joints/main/coordinate"].

    Datasets over time have one row per recorded instant: "time" (rows), "nodes/pin/position" (rows, 3). They are arrays of
    NumPy that are not to be written: views of the recorded numbers, without a copy. (While the analysis is still under way,
    they are copies of what there is so far.) Others are arrays or numbers, "peaks/rod/all/von_mises/value", or lists of texts,
    "eigen/nodes".

    If "nodes/pin/rotation" is recorded, (rows, 3) "nodes/pin/rotation_vector", "nodes/pin/bryant" and "nodes/pin/euler"
    [rad] can be read too, continuous over turns (`bielle.rotations.continuous`). They are computed on demand, and not listed.
    """

    def __init__(self, recorder: _core.Recorder | NothingKept, number: int, found: tuple[str, dict, int] | None = None):
        self._recorder = recorder
        self._number = number
        self._summary, self._numbers = (found[0], found[1]) if found else ("", {})

    @property
    def type(self) -> str:
        """The type as in a model: "dynamic"."""
        return self._recorder.type(self._number)

    @property
    def time(self) -> np.ndarray:
        """(rows) [s]; for a static analysis the load factors."""
        return self["time"]

    @property
    def summary(self) -> str:
        """The text that the program prints for the analysis. It is empty for motions that were stepped by the
        caller."""
        return self._summary

    @property
    def numbers(self) -> dict[str, list[float]]:
        """The numbers of the summary: "steps", "load_factor", "limit_points"."""
        return self._numbers

    @property
    def events(self) -> list[Event]:
        """The crossings in the order of time."""
        return [Event(*event) for event in self._recorder.events(self._number)]

    @property
    def datasets(self) -> dict[str, Dataset]:
        """The datasets besides "time": shapes and units by name."""
        return {name: Dataset(*about) for name, about in self._recorder.datasets(self._number).items()}

    def __getitem__(self, name: str) -> np.ndarray | float | list[str]:
        """A dataset. Raises InputError with the nearest name."""
        quantity, source = made_of(name) if isinstance(name, str) else ("", name)
        if not quantity:
            return self._recorder.read(self._number, name)
        values = rotations.continuous(quantity, rotations.convert(self._recorder.read(self._number, source), "quaternion", quantity))
        values.flags.writeable = False
        return values

    def __contains__(self, name: object) -> bool:
        source = made_of(name)[1] if isinstance(name, str) else name
        return source == "time" or source in self._recorder.datasets(self._number)

    def __iter__(self) -> Iterator[str]:
        return iter(["time", *self._recorder.datasets(self._number)])

    def __len__(self) -> int:
        return 1 + len(self._recorder.datasets(self._number))

    def __repr__(self) -> str:
        return f"<bielle.Results of an analysis '{self.type}': {self._recorder.rows(self._number)} rows>"
