"""Several runs together: files of results, and the runs of studies, each with a name that tells it from the others."""

import contextlib
import dataclasses
import os

import h5py

from ..arguments import superelement_paths
from ..messages import InputError, note
from ..results.results_file import WITHOUT_ROWS, Results, reading
from .quantities import Quantities


@dataclasses.dataclass
class Run:
    """label: the file, or the parameters by which runs of a study differ; empty if there is one run alone"""

    label: str
    results: Results
    quantities: Quantities


@contextlib.contextmanager
def open_runs(options, without_rows=False):
    """The runs of options.files, a list that is not empty. without_rows: runs of a study that recorded nothing over time count too.
    @raises InputError"""
    with contextlib.ExitStack() as stack:
        opened = []
        for path, short in zip(options.files, _short_names(options.files)):
            study = _study_runs(path)
            for group, values in study or [("", "")]:
                if not options.analysis and not _has_results(path, group, without_rows):
                    note(f"{path}: {group} ({values}) has no results and is left out")
                    continue
                results = stack.enter_context(Results(path, options.analysis, group))
                before = short if len(options.files) > 1 or not study else ""
                label = ": ".join(text for text in (before, values) if text)
                opened.append((label, results))
        if not opened:
            raise InputError(f"'{options.files[0]}' is a study without a run that has results")
        runs = []
        for label, results in opened:
            superelements = superelement_paths(options, results)
            runs.append(Run(label if len(opened) > 1 else "", results, Quantities(results, superelements)))
        yield runs


def _short_names(paths):
    """Names of files without their ending; with their folders if they are alike."""
    names = [os.path.splitext(os.path.basename(path))[0] for path in paths]
    return names if len(set(names)) == len(names) else list(paths)


def _study_runs(path):
    """[(group, `mass = 2`)] of the runs of a study that were done, by the parameters that differ; empty for another
    file."""
    if not os.path.isfile(path) or not h5py.is_hdf5(path):
        return []  # Results says what it is
    with reading(path, "/"), h5py.File(path, "r") as file:
        if file.attrs.get("format") != "bielle study":
            return []
        given = file["parameters"] if "parameters" in file else {}
        values = {name: given[name].asstr()[:] for name in given}
        status = file["status"][:]
        differing = {name: texts for name, texts in values.items() if len(set(texts)) > 1}
        named = [", ".join(f"{name} = {texts[k]}" for name, texts in differing.items()) for k in range(len(status))]
    for k in (status != 0).nonzero()[0]:
        note(f"{path}: run {k + 1} ({named[k]}) was not completed and is left out")
    return [(f"runs/{k + 1}", named[k]) for k in (status == 0).nonzero()[0]]


def _has_results(path, group, without_rows):
    if not group:
        return True
    with reading(path, group), h5py.File(path, "r") as file:
        if without_rows and group in file and any(name in file[group] for name in WITHOUT_ROWS):
            return True
        return group in file and "time" in file[group] and len(file[group]["time"]) > 0
