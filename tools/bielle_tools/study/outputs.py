"""Output files of a study: none may replace an input or a file that is no study."""

import os

import h5py

from ..messages import InputError


def table_path(plan):
    """The path is that of the table of gathered values."""
    return os.path.splitext(plan.output)[0] + "-table.csv"


def check_outputs(plan):
    """@raises InputError if the study would overwrite an input, or a file that is no study"""
    _check_study(plan.output)
    outputs = [("the file of the study", plan.output)] + ([("the table of what is gathered", table_path(plan))] if plan.wanted else [])
    for what, path in outputs:
        for given in plan.inputs:
            if _same(path, given):
                raise InputError(f"{what}, '{path}', would replace an input of the study: say another name with -o")
    if plan.wanted:
        _check_table(table_path(plan))


def _same(path, other):
    if os.path.realpath(path) == os.path.realpath(other):
        return True
    try:
        return os.path.samefile(path, other)  # by another name (a hard link)
    except OSError:
        return False


def _check_study(path):
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


def _check_table(path):
    """A table of an earlier study begins with the column `run` and has a column for the status."""
    if not os.path.exists(path):
        return
    known = False
    if os.path.isfile(path):
        with open(path, encoding="utf-8", errors="replace") as file:
            columns = file.readline(1 << 16).rstrip("\n").split(",")
        known = columns[0] == "run" and "status" in columns
    if not known:
        raise InputError(f"'{path}' exists and is no table of a study, which would replace it: say another name with -o, or move it")
