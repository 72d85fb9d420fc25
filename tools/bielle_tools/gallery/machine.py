"""The description of a machine of the gallery, and the numbers by which it is checked."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from ..results import Results


@dataclass
class Check:
    """A number of a run next to its independent value.

    quantity, unit: name of the number; value: that of the run; reference: closed form, or computed apart from Bielle.
    within: largest accepted difference, relative to the reference; reason: grounds for it.
    formula: origin of the reference in words.
    """

    quantity: str
    unit: str
    value: float
    reference: float
    within: float
    reason: str
    formula: str

    def __post_init__(self):
        self.value, self.reference = float(self.value), float(self.reference)
        if not (math.isfinite(self.reference) and self.reference):
            raise ValueError(f"'{self.quantity}': the independent value is zero or no number")
        if not (0 < self.within < 0.2 and self.reason and self.formula):
            raise ValueError(f"'{self.quantity}': a check has a tolerance below 20 %, its reason and its formula")

    @property
    def difference(self):
        """Difference relative to the reference; NaN if the value is not a number."""
        return (self.value - self.reference) / abs(self.reference)

    @property
    def passed(self):
        """Tells whether the value is near enough, which NaN is not."""
        return abs(self.difference) <= self.within


@dataclass
class Picture:
    """A picture of a run.

    run: name of the run; tool: `bielle-animate` with an output that is one PNG file, or `bielle-plot` with the figure
    `figure` of its folder; options: further words of the command.
    """

    run: str
    options: Sequence[str] = ()
    tool: str = "bielle-animate"
    figure: str = ""


@dataclass
class Machine:
    """A machine of the gallery.

    title, teaches: texts of the page, one line and a few sentences.
    bodies: body files of `meshes`, without their ending, which are reduced first.
    runs: {name: words after bielle-mechanism}, the first of which is a file of `mechanism/examples`.
    pictures: at least one; page: the run that bielle-view shows.
    check: function of the results, {name: Path of the run's results} -> list of Check.
    """

    title: str
    teaches: str
    runs: dict
    pictures: Sequence[Picture]
    page: str
    check: Callable
    bodies: Sequence[str] = field(default_factory=tuple)


class Rows:
    """Results of one analysis, from which checks read arrays."""

    def __init__(self, path, analysis=None):
        self.results = Results(path, analysis)
        self.time = self.results.time

    def __call__(self, place):
        """Rows of a dataset, without dimensions of length one behind the time."""
        values = self.results.rows(place)
        return values[:, 0] if values.ndim == 2 and values.shape[1] == 1 else values

    def event(self, words):
        """Time [s] of the first event whose name contains the words. @raises ValueError if there is none"""
        names = self.results.text_of("crossings").splitlines()
        group = self.results.root["events"]
        for kind, time in zip(group["crossing"][:], group["time"][:]):
            if words in names[int(kind)]:
                return float(time)
        raise ValueError(f"the event '{words}' did not happen")
