"""Compares results files that must be equal to the last bit, and writes results of runs that ended early."""

import shutil

import h5py
import numpy as np


def datasets(group):
    """Returns all datasets below a group of an HDF5 file, by name."""
    found = {}
    group.visititems(lambda name, item: found.__setitem__(name, item) if isinstance(item, h5py.Dataset) else None)
    return found


def valid_values(group):
    """Returns the values of all datasets of an analysis by name. Rows that a run has not confirmed are left out."""
    rows = len(group["time"])
    return {name: item[:rows] if item.maxshape and item.maxshape[0] is None and not name.startswith("events/") else item[()]
            for name, item in datasets(group).items()}


def expect_equal_values(found, expected, message=""):
    """Asserts that both have the same names, and arrays of the same shape and type that are equal to the last bit; nan
    equals nan."""
    np.testing.assert_equal(sorted(found), sorted(expected), err_msg=message)
    for name, values in expected.items():
        one, two = np.asarray(found[name]), np.asarray(values)
        np.testing.assert_equal((one.shape, one.dtype), (two.shape, two.dtype), err_msg=f"{message} {name}")
        np.testing.assert_array_equal(one, two, err_msg=f"{message} {name}")


def expect_equal_runs(path, expected_path, message=""):
    """Asserts that both files contain complete runs with equal results."""
    with h5py.File(path) as file, h5py.File(expected_path) as other:
        np.testing.assert_equal([file.attrs["complete"], other.attrs["complete"]], [1, 1], err_msg=message)
        analyses = [name for name in other if name.startswith("analysis_")]
        np.testing.assert_equal([name for name in file if name.startswith("analysis_")], analyses, err_msg=message)
        for name in analyses:
            expect_equal_values(valid_values(file[name]), valid_values(other[name]), f"{message} {name}")


def end_at_checkpoint(whole, part, count):
    """Writes the file `part`: the run of one analysis in the file `whole` as if it had been killed after some checkpoints."""
    shutil.copy(whole, part)
    with h5py.File(part, "r+") as file:
        checkpoints = file["checkpoints/analysis_1"]
        written = len(checkpoints["rows"])
        for data in datasets(checkpoints).values():
            if data.shape and data.shape[0] == written:
                data.resize(count, axis=0)
        file.attrs["complete"] = 0
