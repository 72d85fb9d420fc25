"""All analyses of a model, one after the other."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from . import _core
from .models import Model, Parameters, load, read
from .results import Event, NothingKept, Results
from .views import View, view


def run(model: Model | str | os.PathLike | Mapping[str, Any], output: str | os.PathLike | None = None, *,
        parameters: Parameters | None = None, restart: str | os.PathLike | None = None, threads: int = 1,
        progress: bool = False, memory: bool = True) -> Run:
    """Runs all analyses of a model as `bielle-mechanism` does: the numbers are the same to the last bit.

    model: a Model, the path of a model file, or a dictionary (see `read`).
    output: a results file to write as well; without it no file is written.
    parameters: as for `load`; not for a Model, which was read with its own.
    restart: a results file to continue; with `output` only. Earlier rows are in the file alone.
    threads: number of threads for costly components; results do not depend on it.
    progress: shows a bar on standard error.
    memory: rows are kept in memory, not only written to `output`; set it to False for results that are larger than the
    memory.
    Raises InputError, ComputationError; the file then contains all rows so far, but none are in memory (a session that
    records keeps them: Session.record). Ctrl-C ends the run after the current step.
    """
    if isinstance(model, Model):
        if parameters:
            raise _core.InputError("parameters: the model has been read with its own; give them to load or read")
    elif isinstance(model, Mapping):
        model = read(model, parameters)
    elif isinstance(model, str) and "\n" in model:
        raise _core.InputError("model: this is a text, and a name of a file was expected; bielle.read reads texts")
    else:
        model = load(model, parameters)
    recorder, found, notes = _core.run(model._core, "" if output is None else os.fspath(output),
                                       "" if restart is None else os.fspath(restart), threads, progress, memory)
    return Run(model, recorder, found, notes, None if output is None else os.path.abspath(os.fspath(output)))


class Run(Sequence):
    """The records of the analyses of a run: `run[0]` is the first, `run.analyses` are all.

    `run["nodes/pin/position"]`, `run.time` and `run.events` are those of the last analysis.
    """

    def __init__(self, model: Model, recorder: _core.Recorder, found: list[tuple], notes: list[str],
                 output: str | None = None):
        self.model: Model = model
        self.output: str | None = output
        """The results file that the run wrote, if any."""
        first = len(model.analyses) - len(found)  # a run that goes on begins later
        self.analyses: list[Results] = [
            Results(recorder, k, each) if len(recorder) else Results(NothingKept(model.analyses[first + k]), 0, each)
            for k, each in enumerate(found)]
        self.notes: list[str] = notes
        """Sentences that the user should read."""

    def __getitem__(self, which):
        if isinstance(which, str):
            return self.analyses[-1][which]
        return self.analyses[which]

    def __len__(self) -> int:
        return len(self.analyses)

    def __iter__(self) -> Iterator[Results]:
        return iter(self.analyses)

    @property
    def time(self) -> np.ndarray:
        """Times of the last analysis [s]; for a static one the load factors."""
        return self.analyses[-1].time

    @property
    def events(self) -> list[Event]:
        """Events of the last analysis."""
        return self.analyses[-1].events

    @property
    def summary(self) -> str:
        """The text that the program prints for all analyses."""
        return "".join(each.summary for each in self.analyses)

    def show(self, height: int = 640, frames: int = 500) -> View:
        """The machine in motion, as `bielle-view` shows it: the value of a cell of a notebook, or `show().save("machine.html")`.

        height: of the picture in a notebook [pixels]; frames: largest number of times. The run must have written a results file:
        run(model, output="run.h5"). It needs Debian's libjs-three and libjs-chart.js.
        """
        if self.output is None:
            raise _core.Error("show: the run wrote no results file; run(model, output='run.h5') does")
        return view(self.output, height=height, frames=frames)

    def __repr__(self) -> str:
        return f"<bielle.Run of {self.model!r}: {', '.join(each.type for each in self.analyses)}>"
