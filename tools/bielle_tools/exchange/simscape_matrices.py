"""Simscape Multibody's block Reduced Order Flexible Solid: its matrices as variables of a .mat file.

`origins` (k,3) are the positions of the interface frames, K, M and C the stiffness, mass and damping; rows are x y z rx
ry rz of each frame in axes of the body, then amplitudes of modes. A script FILE.m next to it sets the parameters of a
block. (MathWorks, "Reduced Order Flexible Solid".)
"""

import multiprocessing
import os
import re
import zlib
from concurrent.futures import ProcessPoolExecutor, TimeoutError
from concurrent.futures.process import BrokenProcessPool

import numpy as np
import scipy.io

from ..messages import InputError, counted
from .axes import in_body_axes
from .job_files import frames_first, stem
from .matrix_set import MatrixSet, sparse

FAULTS = (ValueError, TypeError, OSError, EOFError, KeyError, IndexError, NotImplementedError, zlib.error, OverflowError, MemoryError,
          AttributeError, AssertionError, UnboundLocalError, ArithmeticError, scipy.io.matlab.MatReadError)
ORIGINS = ("origins", "P")
LONGEST = 600  # [s] of reading


def read(path, options):
    """@raises InputError"""
    variables = _load(path)
    name = next((each for each in ORIGINS if each in variables), None)
    if name is None:
        raise InputError(f"'{path}': the variable 'origins' (k,3) is missing")
    origins = _numbers(path, variables, name)
    count = len(origins)
    if origins.shape[1] != 3 or not count:
        raise InputError(f"'{path}': 'origins' has {origins.shape[0]} x {origins.shape[1]} numbers; three columns x, "
                         "y, z are expected")
    matrices = {each: _numbers(path, variables, each) for each in ("K", "M")}
    if "C" in variables:
        matrices["C"] = _numbers(path, variables, "C")
    size = len(matrices["K"])
    for each, matrix in matrices.items():
        if matrix.shape != (size, size) or size < 6 * count:
            raise InputError(f"'{path}': '{each}' has {matrix.shape[0]} x {matrix.shape[1]} numbers; "
                             f"{counted(count, 'frame')} need 6 rows each")
    scalars = size - 6 * count
    return MatrixSet(
        name=options.name or stem(path), source="Simscape reduced order solid, "
                                                f"{os.path.basename(path)}", numbers=np.arange(1, count + 1),
        positions=origins, unknown_nodes=np.concatenate([np.repeat(np.arange(count), 6), np.full(scalars, -1)]),
        unknown_components=np.concatenate([np.tile(np.arange(6), count), np.arange(scalars)]), stiffness=sparse(matrices["K"]),
        mass=sparse(matrices["M"]), damping=sparse(matrices["C"]) if "C" in matrices else None)


def _load(path):
    """The variables of a file, or the fields of its only structure. SciPy crashes on some damaged files: it reads in a process
    of its own."""
    if not os.path.isfile(path):
        raise InputError(f"cannot read '{path}': there is no such file")
    with ProcessPoolExecutor(1, multiprocessing.get_context("fork")) as pool:
        try:
            variables = pool.submit(_loaded, path).result(LONGEST)
        except (BrokenProcessPool, TimeoutError):
            raise InputError(f"'{path}': is a damaged .mat file") from None
    if len(variables) == 1:
        only = next(iter(variables.values()))
        if getattr(only, "dtype", None) is not None and only.dtype.names and only.size == 1:
            return {name: only.flat[0][name] for name in only.dtype.names}
    return variables


def _loaded(path):
    """The variables of a file. @raises InputError"""
    try:
        return {name: value for name, value in scipy.io.loadmat(path).items() if not name.startswith("__")}
    except NotImplementedError:
        raise InputError(f"'{path}': is a .mat file of version 7.3: save it with '-v7'") from None
    except FAULTS as error:
        told = str(error).splitlines()[0] if str(error) else type(error).__name__
        raise InputError(f"'{path}': is no readable .mat file: {told}") from None


def _numbers(path, variables, name):
    """@raises InputError"""
    if name not in variables:
        raise InputError(f"'{path}': the variable '{name}' is missing")
    value = variables[name]
    if hasattr(value, "toarray"):
        value = value.toarray()
    if not isinstance(value, np.ndarray) or value.ndim != 2 or value.dtype.kind not in "iuf" or not np.isfinite(value).all():
        raise InputError(f"'{path}': '{name}' must be a matrix of finite numbers")
    return value.astype(float)


def write(matrices, path, options):
    """Writes the .mat file and a script. @returns their paths. @raises InputError when a node lacks some of its six unknowns"""
    body = in_body_axes(matrices)
    order = frames_first(body, "Simscape")
    variables = {"origins": body.positions}
    for name, matrix in (("K", body.stiffness), ("M", body.mass), ("C", body.damping)):
        if matrix is not None:
            variables[name] = matrix.toarray()[np.ix_(order, order)]
    scipy.io.savemat(path, variables)
    script = os.path.join(os.path.dirname(path), re.sub(r"\W", "_", stem(path)) + "_block.m")
    with open(script, "w", encoding="utf-8") as file:
        file.write(_script(body, os.path.basename(path), len(order) - 6 * len(body.numbers)))
    return [path, script]


def _script(body, name, modes):
    units = f"{body.length_unit or 'the length unit of the file'}, {body.mass_unit or 'its mass unit'}"
    return (f"% {body.name}: a body for the block Reduced Order Flexible Solid, units {units}.\n"
            f"% {counted(len(body.numbers), 'frame')} ({', '.join(body.interfaces) or 'in the order of the nodes'}) "
            f"and {counted(modes, 'mode')}.\n"
            f"body = load('{name}');\n"
            "% Parameters of the block:\n"
            "%   Interface frames, origins: body.origins; orientations: those of the body\n"
            "%   Stiffness matrix: body.K\n%   Mass matrix: body.M\n" +
            ("%   Damping: Damping matrix, body.C\n" if body.damping is not None else "") +
            "assert(norm(body.K - body.K', 1) <= 1e-9 * norm(body.K, 1));\n"
            "disp(sqrt(sort(eig(body.K, body.M)))' / (2*pi));  % frequencies [Hz], six of them zero\n")
