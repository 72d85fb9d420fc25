"""One run of a study, and the file in which it is kept until the others are finished: <folder>/<identity>.h5.

The file is one of results (bielle_tools/results/results_file.py), cut down to what the study keeps, with these attributes in addition:
study_status (exit status of the program), study_message (what a failed run said), study_kept; and the text /study_said, what the program
printed, where that is gathered from. It takes its name when it is complete.
"""

import json
import os
import re
import subprocess
import tempfile
import threading

import h5py

from ..messages import InputError
from ..quantities.quantities import Quantities
from ..results.results_file import Results
from .plan import GROUPS

PROGRESS = re.compile(r"\s*(?:\w+ \.\.\.|\w+: [\d.]+ m?s)\s*")  # lines of a program that is not asked to be quiet


def run_path(folder, identity):
    return os.path.join(folder, f"{identity}.h5")


def is_done(plan, folder, index):
    """Tells whether the run has succeeded before, and the data that the study needs were kept."""
    about = facts(run_path(folder, plan.identities[index]))
    return about is not None and about["status"] == 0 and covers(about, plan)


def facts(path):
    """Status, message and kept data of a finished run; None if there is none."""
    if not os.path.isfile(path):
        return None
    try:
        with h5py.File(path, "r") as file:
            return _facts_of(file)
    except (OSError, RuntimeError, KeyError, ValueError):  # it is made anew
        return None


def _facts_of(group):
    return {"status": int(group.attrs["study_status"]), "message": str(group.attrs["study_message"]),
            "kept": json.loads(group.attrs["study_kept"]), "said": "study_said" in group}


def covers(about, plan):
    """Tells whether the kept data of a run are sufficient for the plan."""
    kept = set(about["kept"])
    enough = "all" in kept or all(need in kept or need.split("/")[0] in kept for need in plan.needed)
    return enough and (about["said"] or not plan.needs_text)


def make_run(plan, folder, index):
    """Runs the program and writes the run's file. @returns status, message"""
    with tempfile.TemporaryDirectory(prefix="bielle-study-") as scratch:
        target = os.path.join(scratch, "results.h5")
        settings = [word for name, value in zip(plan.names, plan.rows[index]) for word in ("--set", f"{name}={value}")]
        quiet = [] if plan.needs_text else ["--quiet"]
        try:
            done = subprocess.run([plan.program, plan.model, "-o", target, *quiet, "--threads", "1", *settings], stdin=subprocess.DEVNULL,
                                  capture_output=True, text=True, errors="replace", check=False)
        except (OSError, ValueError) as error:  # ValueError: a null character among the arguments
            raise InputError(f"'{plan.program}' cannot be run: {getattr(error, 'strerror', None) or error}") from None
        said = "\n".join(line for line in done.stderr.splitlines() if quiet or not PROGRESS.fullmatch(line)).strip()
        if done.returncode < 0:
            said = f"{said} ended by signal {-done.returncode}".strip()
        _write_run(plan, run_path(folder, plan.identities[index]), target, done.returncode, said,
                   done.stdout if plan.needs_text else None)
    return done.returncode, said


def _write_run(plan, path, results, status, message, said):
    partial = f"{path}.{os.getpid()}.{threading.get_ident()}.part"
    try:
        with h5py.File(partial, "w") as file:
            kept = plan.needed
            if os.path.exists(results):
                try:
                    with h5py.File(results, "r") as source:
                        copy_results(source, file, _datasets(source, results, kept))
                except (OSError, RuntimeError, KeyError) as error:
                    if status == 0:
                        status, message = 2, f"left no readable results: {error}"
            file.attrs.update({"study_status": status, "study_message": message, "study_kept": json.dumps(kept)})
            if said is not None:
                file.create_dataset("study_said", data=said, dtype=h5py.string_dtype())
        os.replace(partial, path)
    except BaseException:
        if os.path.exists(partial):
            os.remove(partial)
        raise


def _datasets(source, path, kept):
    """The kept names as they are in the file: quantities (`main.reaction.norm`) become the datasets of which they are made."""
    named = [name for name in kept if name not in source and name not in GROUPS]
    if not named:
        return kept
    found = []
    with Results(path) as results:
        quantities = Quantities(results)
        for name in kept:
            try:
                found += quantities.needs(name) if name in named and not results.has(name) else [name]
            except InputError:  # the study reports it with the first run
                found.append(name)
    return list(dict.fromkeys(found))


def copy_results(source, group, kept):
    """Copies the attributes of results and the kept groups; all: with the analyses to which links lead."""
    for key, value in source.attrs.items():
        group.attrs[key] = value
    everything = "all" in kept
    names = list(source) if everything else dict.fromkeys(
        ["time", "parameters", *kept, *(["crossings"] if "events" in kept else []),
         *(f"{need.split('/')[0]}/time" for need in kept if need.startswith("analysis_"))])
    for name in names:
        link = source.get(name, getlink=True) if name in source else None
        if everything and isinstance(link, h5py.SoftLink):
            group[name] = h5py.SoftLink(f"{'' if group.name == '/' else group.name}/{link.path[len(source.name.rstrip('/')):].lstrip('/')}")
        elif name == "input" and not everything:
            continue
        elif name in source:
            if name not in group:
                _copy(source, group, name)
        elif "/" in name and name.split("/")[0] in source:  # dataset of the stacked layout, which has no name of its
                                                            # own
            parts = name.split("/")
            section = "/".join(parts[:2]) if parts[0].startswith("analysis_") else parts[0]
            if section in source and section not in group:
                _copy(source, group, section)
    for name in {name.split("/")[0] for name in names if name.startswith("analysis_")} & set(source) if not everything else ():
        for key, value in source[name].attrs.items():
            group[name].attrs[key] = value


def _copy(source, group, name):
    folder, _, last = name.rpartition("/")
    into = group.require_group(folder) if folder else group
    if folder:
        for key, value in source[folder].attrs.items():
            into.attrs[key] = value
    source.copy(source[name], into, name=last, expand_soft=True)
