"""Dictionaries of arrays that NumPy stores in .npz files as pickled objects, read without running code of the file.

A pickle names the functions that build its objects. NumPy's own names stand for plain records here, from which the arrays are
made afterwards; any other name is refused, so that a file can call nothing.
"""

import pickle
import re
import zipfile

import numpy as np

from ..messages import InputError
from .npz_matrices import FAULTS

ARRAY = {("numpy", "ndarray"), ("numpy.core.multiarray", "_reconstruct"), ("numpy._core.multiarray", "_reconstruct")}
DTYPE = ("numpy", "dtype")
OBJECT = "O"
NUMBER = re.compile("f[248]|[iu][1248]").fullmatch


class UnknownObject(Exception):
    """The pickle names an object that is neither a part of an array nor known."""


class _Array:
    """Record of an array: state is (version, shape, dtype, Fortran's order, bytes or list of objects)."""

    def __init__(self, *_):
        self.state = None

    def __setstate__(self, state):
        self.state = state


class _Dtype:
    """Record of a type of numbers: its name such as f8, and the order of bytes."""

    def __init__(self, text, *_):
        self.text, self.order = text, "="

    def __setstate__(self, state):
        self.order = state[1]


class _Enumerator:
    """Record of a value of an enumeration: its number."""

    value = None

    def __setstate__(self, value):
        self.value = value


def load_dictionary(path, name, enumerations=()):
    """The dictionary under the name of an array, with numbers of enumerators as integers; None if the file has no such array.

    @param enumerations: names of enumerations that the dictionary may hold
    @raises InputError for a damaged file, UnknownObject"""
    try:
        with zipfile.ZipFile(path) as file:
            if name + ".npy" not in file.namelist():
                return None
            with file.open(name + ".npy") as stream:
                header = {(1, 0): np.lib.format.read_array_header_1_0, (2, 0): np.lib.format.read_array_header_2_0}
                _, _, kind = header[np.lib.format.read_magic(stream)](stream)
                if kind.kind != OBJECT:
                    raise ValueError(f"it is an array of {kind}, and no dictionary")
                found = _plain(_Unpickler(stream, enumerations).load())
        if not isinstance(found, dict):
            raise ValueError("it is no dictionary")
        return found
    except (*FAULTS, pickle.UnpicklingError, RecursionError) as error:
        told = str(error).splitlines()[0] if str(error) else type(error).__name__
        raise InputError(f"'{path}': '{name}' cannot be read: {told}") from None


class _Unpickler(pickle.Unpickler):
    """Builds records in place of objects."""

    def __init__(self, stream, enumerations):
        super().__init__(stream)
        self.enumerations = enumerations

    def find_class(self, module, name):
        if (module, name) in ARRAY:
            return _Array
        if (module, name) == DTYPE:
            return _Dtype
        if name in self.enumerations:
            return _Enumerator
        raise UnknownObject(f"{module}.{name}")

    def persistent_load(self, pid):
        raise UnknownObject("a reference to another file")


def _plain(value):
    """The dictionary, the array or the number that a record stands for."""
    if isinstance(value, dict):
        return {key: _plain(each) for key, each in value.items()}
    if isinstance(value, _Enumerator):
        return value.value
    if not isinstance(value, _Array):
        return value
    _, shape, dtype, fortran, content = value.state
    kind = str(dtype.text).lstrip("<>=|")
    if kind.startswith(OBJECT):
        return _plain(content[0]) if len(content) == 1 else [_plain(each) for each in content]
    if not NUMBER(kind):
        raise ValueError(f"it holds an array of {kind}")
    numbers = np.frombuffer(content, np.dtype(dtype.order.replace("|", "=") + kind))
    return numbers.reshape(shape, order="F" if fortran else "C")
