"""Files of columns of numbers: CSV with one header line, or Parquet. Numbers in CSV have the shortest form that reads back
to the bit."""

import contextlib
import csv
import os
import sys

import numpy as np

from ..messages import InputError
from ..output_file import replacing

ROWS_AT_ONCE = 1 << 16


@contextlib.contextmanager
def output(path, inputs, mode="w"):
    """An open file that replaces `path` when it is complete; `-` is the standard output, devices are written directly.
    @raises InputError if it cannot be made, or would replace an input or another HDF5 file"""
    kind = {} if "b" in mode else {"newline": "", "encoding": "utf-8", "errors": "surrogateescape"}
    if path == "-":
        if "b" in mode:
            raise InputError("a binary file is not written to the standard output: say a name")
        sys.stdout.reconfigure(errors="surrogateescape")  # names of damaged files
        yield sys.stdout
    elif os.path.exists(path) and not os.path.isfile(path):
        if os.path.isdir(path):
            raise InputError(f"cannot write '{path}': it is a folder")
        with open(path, mode, **kind) as file:
            yield file
    else:
        if "b" not in mode and is_parquet(path):
            raise InputError(f"'{path}': this table has texts and is written as CSV, not as Parquet")
        _check(path, inputs)
        with replacing(path) as partial, open(partial, mode, **kind) as file:
            yield file


def _check(path, inputs):
    if not os.path.exists(path):
        return
    if any(os.path.samefile(path, given) for given in inputs):
        raise InputError(f"'{path}' is an input, which would be replaced: say another name")
    try:
        with open(path, "rb") as file:
            if file.read(4) == b"\x89HDF":
                raise InputError(f"'{path}' is an HDF5 file, which would be replaced: say another name")
    except OSError as error:
        raise InputError(f"cannot write '{path}': {error.strerror}") from None


def write_columns(path, columns, inputs=()):
    """Writes columns [(header, values)] as CSV, or as Parquet to a name that ends so; cells of shorter columns and of
    values that are no numbers are empty. inputs: files that may not be replaced"""
    if is_parquet(path):
        _write_parquet(path, columns, inputs)
        return
    with output(path, inputs) as file:
        csv.writer(file, lineterminator="\n").writerow([header for header, _ in columns])
        longest = max((len(values) for _, values in columns), default=0)
        for begin in range(0, longest, ROWS_AT_ONCE):
            count = min(ROWS_AT_ONCE, longest - begin)
            cells = [_texts(values[begin:begin + count], count) for _, values in columns]
            file.writelines(",".join(row) + "\n" for row in zip(*cells))


def is_parquet(path):
    """Tells whether the name of a file asks for Parquet."""
    return path.lower().endswith(".parquet")


def _write_parquet(path, columns, inputs):
    try:
        import pyarrow
        import pyarrow.parquet
    except ImportError:
        raise InputError(f"'{path}': Parquet needs the Python package pyarrow, which Debian does not have: install it for "
                         "/usr/bin/python3, or write CSV, which pandas and the like convert") from None
    longest = max((len(values) for _, values in columns), default=0)
    padded = [np.pad(np.asarray(values, float), (0, longest - len(values)), constant_values=np.nan) for _, values in columns]
    table = pyarrow.Table.from_arrays([pyarrow.array(values, mask=np.isnan(values)) for values in padded], names=[name for name, _ in columns])
    with output(path, inputs, "wb") as file:
        pyarrow.parquet.write_table(table, file)


def _texts(values, count):
    texts = [repr(value) for value in np.asarray(values, float).tolist()]
    for row in np.flatnonzero(np.isnan(values)):
        texts[row] = ""
    return texts + [""] * (count - len(texts))


def header(label, unit):
    """`main.angle [rad]`; without brackets if there is no unit."""
    return f"{label} [{unit}]" if unit and unit != "-" else label
