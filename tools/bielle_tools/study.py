"""Runs one model for every row of a table of parameters and gathers the results in one HDF5 file.

    /               attrs: format = "bielle study", version, model, complete;   /input  text of the model
    /parameters/<name> (runs)  values as written in the table, as text
    /status (runs)  exit status of each run: 0 done, 1 wrong input, 2 failed
    /message (runs) what a failed run said
    /runs/<k>/...   k = 1, 2, ...: the groups kept of that run's results, as bielle-mechanism wrote them
"""

import concurrent.futures
import csv
import os
import re
import subprocess
import sys
import tempfile

import h5py
import numpy as np

from .messages import InputError, counted, note

KEPT = ["joints", "measures", "energy", "events", "peaks", "eigen"]
GROUPS = [*KEPT, "nodes", "elements", "solver", "validity", "all"]  # what may be kept


def read_table(path):
    """@returns names and rows of texts of a CSV file with a header line. @raises InputError with file and line"""
    try:
        with open(path, newline="", encoding="utf-8-sig") as file:
            rows = [(number, [cell.strip() for cell in row]) for number, row in enumerate(csv.reader(file), start=1)]
    except OSError as error:
        raise InputError(f"cannot read '{path}': {error.strerror}") from None
    except (UnicodeDecodeError, csv.Error):
        raise InputError(f"'{path}' is no table: text is expected, its columns separated by commas") from None
    rows = [(number, row) for number, row in rows if any(row) and not row[0].startswith("#")]
    if not rows:
        raise InputError(f"'{path}' is empty; its first line names parameters of the model, each further line is a run")
    number, names = rows[0]
    if len(names) == 1 and len(re.split(r"[;\s]+", names[0])) > 1:
        raise InputError(f"{path}:{number}: columns are separated by commas; found '{names[0]}'")
    for name in names:
        if not name or names.count(name) > 1:
            raise InputError(f"{path}:{number}: the column name '{name}' is " + ("missing" if not name else "there twice"))
    for number, row in rows[1:]:
        if len(row) != len(names) or not all(row):
            raise InputError(f"{path}:{number}: "
                             f"{counted(len([c for c in row if c]), 'value')} for {counted(len(names), 'parameter')}")
    if len(rows) == 1:
        raise InputError(f"'{path}' has a header but no runs")
    first = {}
    for run, (_, row) in enumerate(rows[1:], start=1):
        if first.setdefault(tuple(row), run) != run:
            note(f"{path}: run {run} has the values of run {first[tuple(row)]}")
    return names, [row for _, row in rows[1:]]


def run_study(program, model, names, rows, output, *, jobs=1, keep=None, report=print):
    """Runs all rows, `jobs` at a time. @returns number of runs that failed. @raises InputError"""
    try:
        with open(model, encoding="utf-8") as file:
            text = file.read()
    except OSError as error:
        raise InputError(f"cannot read '{model}': {error.strerror}") from None
    _check_output(output)
    partial = output + ".part"
    try:
        study = h5py.File(partial, "w")
    except OSError as error:
        raise InputError(f"cannot write '{output}': {os.strerror(error.errno) if error.errno else error}") from None
    try:
        failed = _run_all(study, program, model, text, names, rows, jobs, keep or KEPT, report)
    except BaseException:
        os.remove(partial)
        raise
    os.replace(partial, output)
    return failed


def _check_output(path):
    """@raises InputError where something stands that is no study"""
    folder = os.path.dirname(path) or "."
    if not os.path.isdir(folder):
        raise InputError(f"cannot write '{path}': there is no folder '{folder}'")
    if not os.path.exists(path):
        return
    if not os.path.isfile(path):
        raise InputError(f"cannot write '{path}': it is a folder or a device")
    try:
        with h5py.File(path, "r") as file:
            known = file.attrs.get("format") == "bielle study"
    except (OSError, RuntimeError):
        known = False
    if not known:
        raise InputError(f"'{path}' exists and is no study: say with -o where the results of this one shall go, or remove it")


def _run_all(study, program, model, text, names, rows, jobs, keep, report):
    """@returns number of runs that failed"""
    failed = 0
    with study, tempfile.TemporaryDirectory(prefix="bielle-study-") as folder:
        study.attrs.update({"format": "bielle study", "version": 1, "model": os.path.abspath(model), "complete": False})
        _text(study, "input", text)
        for column, name in enumerate(names):
            _text(study, f"parameters/{name}", [row[column] for row in rows])
        status, messages = np.full(len(rows), -1), [""] * len(rows)

        def run(index):
            target = os.path.join(folder, f"{index}.h5")
            settings = [word for name, value in zip(names, rows[index]) for word in ("--set", f"{name}={value}")]
            done = subprocess.run([program, model, "-o", target, "--quiet", "--threads", "1", *settings],
                                  capture_output=True, text=True, check=False)
            said = done.stderr.strip()
            if done.returncode < 0:
                said += f" ended by signal {-done.returncode}"
            return target, done.returncode, said.strip()

        with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
            pending = {pool.submit(run, index): index for index in range(len(rows))}
            for count, future in enumerate(concurrent.futures.as_completed(pending), start=1):
                index = pending[future]
                target, status[index], messages[index] = future.result()
                if "has no parameter" in messages[index]:  # no run can succeed
                    pool.shutdown(cancel_futures=True)
                    raise InputError(messages[index].rpartition("error: ")[2])
                if os.path.exists(target):
                    _keep(study, index + 1, target, keep)
                    os.remove(target)
                failed += status[index] != 0
                values = ", ".join(f"{name} = {value}" for name, value in zip(names, rows[index]))
                said = "done" if status[index] == 0 else f"FAILED: {messages[index]}"
                report(f"[{count}/{len(rows)}] run {index + 1}: {values}: {said}")
        study["status"] = status
        study["status"].attrs["description"] = "exit status of each run: 0 done, 1 wrong input, 2 failed"
        _text(study, "message", messages)
        study.attrs["complete"] = True
    return failed


def find_program():
    """bielle-mechanism of BIELLE_BIN, of this repository's build, beside an installed tool, or on the PATH."""
    tools = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    folders = [os.environ.get("BIELLE_BIN", ""), os.path.join(tools, "..", "build", "release", "bin"),
               os.path.join(tools, "..", "..", "..", "bin"), *os.environ.get("PATH", "").split(os.pathsep)]
    for folder in filter(None, folders):
        path = os.path.join(folder, "bielle-mechanism")
        if os.access(path, os.X_OK):
            return path
    raise InputError("bielle-mechanism is not built: run 'cmake --preset release && cmake --build build/release', "
                     "or say where it is with BIELLE_BIN=FOLDER")


def _keep(study, number, path, keep):
    try:
        with h5py.File(path, "r") as results:
            group = study.create_group(f"runs/{number}")
            for key, value in results.attrs.items():
                group.attrs[key] = value
            names = list(results) if keep == ["all"] else ["time", *keep, *(["crossings"] if "events" in keep else [])]
            for name in names:
                link = results.get(name, getlink=True)
                if keep == ["all"] and isinstance(link, h5py.SoftLink):
                    group[name] = h5py.SoftLink(f"{group.name}{link.path}")
                elif name in results and name != "input":
                    results.copy(name, group, expand_soft=True)
    except (OSError, RuntimeError, KeyError) as error:
        print(f"run {number} left no readable results: {error}", file=sys.stderr)


def _text(file, name, value):
    file.create_dataset(name, data=value, dtype=h5py.string_dtype())
