"""A model that was only checked, by `bielle-mechanism MODEL --check -o RESULTS.h5`: its only row is the position that was assembled or drawn."""

from dataclasses import dataclass

import h5py
import numpy as np

from .results_file import reading


@dataclass(frozen=True)
class Check:
    """assembled; failure: why not, a sentence; redundant: entries with constraints that were set aside, `joints/main`."""
    assembled: bool
    failure: str
    redundant: tuple

    @property
    def sentences(self):
        """Sentences for people: whether it is assembled, and the redundant entries."""
        said = ["The model is assembled."] if self.assembled else \
            ["The model cannot be assembled, and is shown as it is drawn" + (f": {self.failure.rstrip('.')}." if self.failure else ".")]
        return said + ([f"Constraints are redundant, and set aside: {', '.join(self.redundant)}."] if self.redundant else [])


def check_of(results):
    """The Check whose row open results show, or None if they are others."""
    if getattr(results, "kind", "") != "check":
        return None
    with reading(results.path, "/"):
        group = next(group for name, group in results.file.items() if name.startswith("analysis_") and isinstance(group, h5py.Group)
                     and _text(group.attrs.get("type", "")) == "check")
        redundant = np.asarray(results.file["redundant"]).ravel() if "redundant" in results.file else ()
        return Check(bool(np.all(group.attrs.get("assembled", 1))), _text(group.attrs.get("failure", "")).strip(), tuple(_text(name) for name in redundant))


def _text(value):
    return value.decode(errors="replace") if isinstance(value, bytes) else str(value)
