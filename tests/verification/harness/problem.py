"""The description of a problem: models that are computed at several steps or meshes, and the values that they should
have."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np


def numbers(value):
    """The value as an array of numbers; without any if it holds something else."""
    try:
        return np.asarray(value, dtype=float)
    except (TypeError, ValueError):
        return np.zeros(0)


@dataclass
class Quantity:
    """A computed quantity with its reference.

    name: key of the quantity in the dictionary that Study.compute returns, a number or an array.
    reference: its exact or published value; error: the norm of the difference, in `unit`, or relative to the norm of
    the reference.
    source: origin of the reference, a closed form, a publication or a script of tests/references.
    tolerance: largest accepted error at the last level; reason: grounds for it.
    known_to: uncertainty of the reference, in its unit. Levels whose error is below three times this are left out of
    the fit of the order.
    order: expected order of convergence, None if there is none to observe; order_within: accepted deviation;
    order_at_least: larger orders are accepted as well; order_reason: grounds for another order than that of the
    scheme, or for a wider interval.
    """

    name: str
    meaning: str
    unit: str
    reference: float | Sequence[float]
    source: str
    tolerance: float
    reason: str
    known_to: float = 0.0
    relative: bool = False
    order: float | None = None
    order_within: float = 0.1
    order_at_least: bool = False
    order_reason: str = ""

    def __post_init__(self):
        reference = numbers(self.reference)
        if not (reference.size and np.all(np.isfinite(reference))):
            raise ValueError(f"'{self.name}': the reference is no finite number")
        if not (math.isfinite(self.tolerance) and self.tolerance > 0 and self.reason and self.source):
            raise ValueError(f"'{self.name}': a quantity has a positive tolerance with its reason, and a source")
        scale = np.linalg.norm(reference) if self.relative else 1.0
        if scale == 0:
            raise ValueError(f"'{self.name}': the error cannot be relative to a reference of zero")
        if not self.known_to / scale < self.tolerance:
            raise ValueError(f"'{self.name}': the tolerance is smaller than the uncertainty of the reference")

    def error(self, value):
        """The error of a computed value; not a number if the value has another shape or is not finite."""
        reference, value = np.asarray(self.reference, dtype=float), numbers(value)
        if value.shape != reference.shape or not np.all(np.isfinite(value)):
            return math.nan
        return float(np.linalg.norm(value - reference) / (np.linalg.norm(reference) if self.relative else 1.0))

    @property
    def error_unit(self):
        """Unit of the error."""
        return "relative" if self.relative else self.unit


@dataclass
class Study:
    """One model at several levels of refinement, coarsest first.

    compute: takes a level and returns the values of the quantities by name. Its processor time is reported.
    levels: steps [s], or numbers of elements, or the names of single runs.
    parameter: name and unit of the level, such as "step [s]".
    by: "step" if the errors fall with the level, "elements" if they fall with its inverse, "" if levels are not a
    refinement: each level is then held to the tolerance.
    accuracy: name of the quantity that a submission to the IFToMM library states as its accuracy; empty without one.
    """

    title: str
    compute: Callable
    levels: Sequence
    quantities: list[Quantity]
    parameter: str = "step [s]"
    by: str = "step"
    accuracy: str = ""

    def __post_init__(self):
        if self.accuracy and self.accuracy not in [quantity.name for quantity in self.quantities]:
            raise ValueError(f"'{self.title}': accuracy = '{self.accuracy}' is none of its quantities")
        if self.by not in ("step", "elements", "") or not self.levels or not self.quantities:
            raise ValueError(f"'{self.title}': a study has levels, quantities, and by = 'step', 'elements' or ''")
        sizes = [self.size(level) for level in self.levels]
        if self.by and any(fine >= coarse for coarse, fine in zip(sizes, sizes[1:])):
            raise ValueError(f"'{self.title}': levels are listed from the coarsest to the finest")
        if not self.by and any(quantity.order is not None for quantity in self.quantities):
            raise ValueError(f"'{self.title}': an order needs levels of refinement")

    def size(self, level):
        """The step, or the length of an element relative to that of the whole; 1 without refinement."""
        return float(level) if self.by == "step" else 1.0 / level if self.by == "elements" else 1.0


@dataclass
class Problem:
    """A problem of the report.

    subject: heading under which it stands; source: publication of the problem; model: the model in words.
    quick: whether `--quick` computes it (a second or two); long: whether it is started first, because it takes longest.
    """

    title: str
    subject: str
    source: str
    model: str
    studies: list[Study] = field(default_factory=list)
    quick: bool = False
    long: bool = False
