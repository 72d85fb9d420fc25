"""Runs one model for every row of a table of parameters and gathers the results in one HDF5 file.

    /               attrs: format = "bielle study", version, model, complete;   /input  text of the model
            created_by: names, versions and commits of the programs that made the runs
    /parameters/<name> (runs)  values as written in the table, as text
    /status (runs)  exit status of each run: 0 done, 1 wrong input, 2 failed; -1 not run yet
    /message (runs) what a failed run said
    /gathered/<name> (runs)    single numbers of the results, not a number where a run has none; attrs: of (what it is), units
    /identity (runs) by which a later study knows runs that it need not make again
    /runs/<k>/...   k = 1, 2, ...: the groups kept of that run's results, as bielle-mechanism wrote them

A CSV table of parameters, status and gathered numbers is written next to it. Until all runs are finished, they are kept
as files (runs.py) in a folder, <name>.runs-XXXXXXXX (folder.py).
"""

import concurrent.futures
import csv
import dataclasses
import os

import h5py
import numpy as np

from ..messages import InputError, note
from ..output_file import replacing
from ..results.results_file import Results
from .folder import OF_RUNS, discard, forget_runs, work_folder
from .gather import Missing
from .outputs import check_outputs, table_path
from .plan import read_model
from .runs import copy_results, facts, is_done, make_run, run_path


@dataclasses.dataclass
class Collected:
    """Data of all runs: status (-1: not run yet), messages, and gathered numbers by name, with units."""

    status: np.ndarray
    messages: list
    numbers: dict
    units: dict

    @property
    def done(self):
        return int(np.count_nonzero(self.status == 0))

    @property
    def missing(self):
        return int(np.count_nonzero(self.status < 0))


def run_study(plan, *, jobs=1, fresh=False, report=print):
    """Makes all missing runs, `jobs` at a time, and gathers them. @returns Collected. @raises InputError"""
    check_outputs(plan)
    with work_folder(plan.output) as folder:
        prepare(plan, folder, fresh)
        todo = pending(plan, folder)
        if len(todo) < len(set(plan.identities)):
            report(f"{len(set(plan.identities)) - len(todo)} of {len(set(plan.identities))} runs are there from before")
        try:
            _run_all(plan, folder, todo, jobs, report)
        except KeyboardInterrupt:
            note(f"interrupted: finished runs are kept in '{folder}'; the same command goes on with the others")
            raise
        except InputError:
            if not any((facts(run_path(folder, identity)) or {}).get("status") == 0 for identity in plan.identities):
                discard(folder)
            raise
        collected = collect(plan, folder)
        discard(folder)
    return collected


def prepare(plan, folder, fresh=False):
    """Makes the folder of the runs, with the plan and the runs of an earlier study of this name. @raises InputError"""
    if fresh and os.path.isdir(folder):
        forget_runs(folder)
    try:
        plan.write(folder)
    except OSError as error:
        raise InputError(f"cannot write '{plan.output}': '{folder}': {error.strerror}") from None
    for name in os.listdir(folder):
        if name.endswith(".part") and OF_RUNS.fullmatch(name):  # left by a study that was killed
            os.remove(os.path.join(folder, name))
    if not fresh and os.path.exists(plan.output):
        _take_over(plan, folder)


def _take_over(plan, folder):
    """Converts the runs of the study file to files again."""
    with h5py.File(plan.output, "r") as study:
        if "identity" not in study:
            return
        wanted = set(plan.identities)
        for number, identity in enumerate(study["identity"].asstr()[:], start=1):
            path = run_path(folder, identity)
            if identity not in wanted or os.path.exists(path) or f"runs/{number}" not in study:
                continue
            group = study[f"runs/{number}"]
            if group.attrs.get("study_status", 1) != 0:
                continue
            with h5py.File(path + ".part", "w") as file:
                copy_results(group, file, ["all"])
            os.replace(path + ".part", path)


def pending(plan, folder):
    """Numbers, from 0, of the runs to make: one for each identity."""
    first = {}
    for index, identity in enumerate(plan.identities):
        if first.setdefault(identity, index) != index:
            note(f"run {index + 1} has the values of run {first[identity] + 1}: it is not run by itself")
    return [index for index in first.values() if not is_done(plan, folder, index)]


def _run_all(plan, folder, todo, jobs, report):
    checked = False
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        started = {pool.submit(make_run, plan, folder, index): index for index in todo}
        try:
            for count, future in enumerate(concurrent.futures.as_completed(started), start=1):
                index = started[future]
                status, message = future.result()
                report(f"[{count}/{len(todo)}] {told(plan, index, status, message)}")
                check_no_parameter(message)
                if status == 0 and not checked:
                    check_gather(plan, folder, index)
                    checked = True
        except BaseException:
            pool.shutdown(cancel_futures=True)
            raise


def told(plan, index, status, message):
    """`run 3: speed = 1: done`"""
    return f"run {index + 1}: {plan.values(index)}: " + ("done" if status == 0 else f"FAILED: {message}")


def check_no_parameter(message):
    """@raises InputError if a run reports that the model has no such parameter: no run can succeed then"""
    if "has no parameter" in message:
        raise InputError(message.rpartition("error: ")[2])


def check_gather(plan, folder, index):
    """Checks the gathered names with the first run, so that a wrong name is found early. @raises InputError"""
    for each in plan.wanted:
        try:
            with Results(run_path(folder, plan.identities[index])) as results:
                each.value(results)
        except Missing:
            pass
        except InputError as error:
            raise InputError(f"gather: {each.name}: {error} (in run {index + 1}; finished runs are kept)") from None


def collect(plan, folder):
    """Writes the study's file and table from the finished runs. @returns Collected"""
    check_outputs(plan)
    with replacing(plan.output) as partial:
        try:
            study = h5py.File(partial, "w")
        except OSError as error:
            raise InputError(f"cannot write '{plan.output}': {os.strerror(error.errno) if error.errno else error}") from None
        with study:
            status, messages, numbers, units = _write(study, plan, folder)
    if plan.wanted:
        _write_table(plan, status, numbers)
    return Collected(status, messages, numbers, units)


def _write(study, plan, folder):
    runs = len(plan.rows)
    study.attrs.update({"format": "bielle study", "version": 1, "model": plan.model, "complete": False})
    _text(study, "input", read_model(plan.model))
    for column, name in enumerate(plan.names):
        _text(study, f"parameters/{name}", [row[column] for row in plan.rows])
    status, messages = np.full(runs, -1), [""] * runs
    numbers, units = {each.name: np.full(runs, np.nan) for each in plan.wanted}, {}
    made_by = []
    for index, identity in enumerate(plan.identities):
        path = run_path(folder, identity)
        about = facts(path)
        if about is None:
            messages[index] = "not run yet"
            continue
        status[index], messages[index] = about["status"], about["message"]
        with h5py.File(path, "r") as run:
            made_by += {str(run.attrs.get("created_by", "unknown"))} - set(made_by) if len(run) else ()
            if len(run):
                copy_results(run, study.create_group(f"runs/{index + 1}"), ["all"])
        if status[index] == 0:
            _gather(plan, path, index, numbers, units)
    study["status"] = status
    study["status"].attrs["description"] = "exit status of each run: 0 done, 1 wrong input, 2 failed; -1 not run yet"
    _text(study, "message", messages)
    _text(study, "identity", plan.identities)
    for each in plan.wanted:
        study[f"gathered/{each.name}"] = numbers[each.name]
        study[f"gathered/{each.name}"].attrs.update({"of": each.words, "units": units.get(each.name, "")})
    study.attrs["created_by"] = ", ".join(made_by)
    study.attrs["complete"] = bool(np.all(status >= 0))
    return status, messages, numbers, units


def _gather(plan, path, index, numbers, units):
    for each in plan.wanted:
        try:
            with Results(path) as results:
                numbers[each.name][index] = each.value(results)
                if each.name not in units:
                    units[each.name] = units_of(each, results)
        except (Missing, InputError) as error:
            note(f"run {index + 1}: {plan.values(index)}: {each.name} is missing: {error}")


def units_of(gathered, results):
    """Units of a gathered number."""
    if gathered.place is None:
        return ""
    if (gathered.take or "").startswith("time_of_"):
        return "-" if results.static else "s"
    if gathered.analysis:
        with Results(results.path, gathered.analysis) as one:
            return gathered.units(one)
    return gathered.units(results)


def _write_table(plan, status, numbers):
    with replacing(table_path(plan)) as path, open(path, "w", newline="", encoding="utf-8", errors="surrogatepass") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["run", *plan.names, "status", *numbers])
        for index, row in enumerate(plan.rows):
            values = [numbers[name][index] for name in numbers]
            writer.writerow([index + 1, *row, status[index], *("" if np.isnan(value) else repr(float(value)) for value in values)])


def _text(file, name, value):
    file.create_dataset(name, data=value, dtype=h5py.string_dtype())
