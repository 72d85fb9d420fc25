"""Superelements of matrices that a Python program has: its own finite elements, or those of another program."""

from __future__ import annotations

import os
import shutil
import subprocess
import tempfile
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from . import _core

FOLDERS = ("../../bin", "../../../../bin")  # folders of the programs from here: in the build, installed


def superelement(output: str | os.PathLike, K: Any, M: Any, positions: Any, *, C: Any = None,
                 interfaces: Mapping[str, int] | None = None, scalars: int = 0, nodes: Sequence[int] | None = None,
                 unknowns: Sequence[tuple[int, int]] | None = None, axes: Any = None, name: str | None = None,
                 points: Any = None, displacement: Any = None, stress: Any = None,
                 quantities: Mapping[str, tuple[Any, Sequence[str], str | Sequence[str]]] | None = None, length_unit: str = "m", mass_unit: str = "kg", arguments: Sequence[str] = (),
                 program: str | os.PathLike | None = None) -> str:
    """Makes a superelement file of stiffness and mass of a free linear body: `bielle-reduce --from`.

    output: the superelement file (.h5); a name that ends in `.matrices.h5` gets the matrices alone, for bielle-reduce.
    K, M, C: stiffness, mass and viscous damping (n,n), arrays of NumPy or sparse matrices of SciPy, in force per length_unit
    with force = mass_unit length_unit / s^2.
    positions: (N,3) of the nodes. nodes: their numbers, 1 .. N unless given. axes: (N,3,3), columns: axes of each node.
    interfaces: numbers of the nodes that a mechanism uses, by name; without it, all nodes.
    unknowns: a pair (number of the node, component 0 to 5: x y z rx ry rz) for each row; node 0: a scalar coordinate, such as
    the amplitude of a mode. Without it, rows are x y z (rx ry rz, if there are as many) of the nodes in order, then `scalars`.
    points: (p,3) places inside, displacement: (3p,n), x y z of each as functions of the unknowns, stress: (6p,n), xx yy zz yz xz xy
    of each, body axes. quantities: further numbers that follow from the unknowns, such as the strain of gauges, by name:
    a matrix (k,n), names of its rows and their unit or units (Pa, m/m of strain, -, N, N m, m, rad), which mechanisms record on request.
    arguments: further ones of bielle-reduce. program: its path, unless it is installed next to this package or in PATH.
    Returns the path of the file. Raises InputError with the sentence of the program.
    """
    try:
        from bielle_tools.exchange import matrix_file, npz_matrices
        from bielle_tools.messages import InputError
    except ImportError as error:
        raise _core.Error(f"superelement: {error}; it needs python3-h5py, python3-scipy and the folder bielle_tools "
                          "of the package") from None
    try:
        matrices = npz_matrices.matrices_of("superelement", _arrays(K, M, C, positions, scalars, nodes, unknowns, axes, interfaces) |
                                            _recovery(points, displacement, stress, quantities),
                                            name or os.path.basename(os.fspath(output)).partition(".")[0], "Python")
        matrices.length_unit, matrices.mass_unit = length_unit, mass_unit
        matrices.check()
    except InputError as error:
        raise _core.InputError(str(error)) from None
    if os.fspath(output).endswith(".matrices.h5"):
        matrix_file.write(matrices, output)
        return os.fspath(output)
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "body.matrices.h5")
        matrix_file.write(matrices, path)
        command = [_program(program), "--from", path, "-o", os.fspath(output), "--quiet", *arguments]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        kind = _core.InputError if done.returncode == 1 else _core.ComputationError
        raise kind(done.stderr.strip() or f"bielle-reduce ends with the status {done.returncode}")
    return os.fspath(output)


def _arrays(K: Any, M: Any, C: Any, positions: Any, scalars: int, nodes: Any, unknowns: Any, axes: Any,
            interfaces: Mapping[str, int] | None) -> dict[str, Any]:
    """The arrays by the keys of an .npz file of matrices."""
    arrays: dict[str, Any] = {"positions": positions}
    for key, matrix in (("K", K), ("M", M), ("C", C)):
        if matrix is None:
            continue
        if hasattr(matrix, "tocsr"):
            rows = matrix.tocsr()
            arrays |= {f"{key}.data": rows.data, f"{key}.indices": rows.indices, f"{key}.indptr": rows.indptr}
        else:
            arrays[key] = matrix
    given = {"nodes": nodes, "axes": axes}
    arrays |= {key: array for key, array in given.items() if array is not None}
    if unknowns is None:
        size, count = K.shape[0] if hasattr(K, "shape") else len(K), len(positions)
        each = 6 if size - scalars == 6 * count else 3
        if size - scalars != each * count:
            raise _core.InputError(f"superelement: {size} rows are not 3 or 6 unknowns of each of {count} nodes and "
                                   f"{scalars} scalars; give "
                                   "`unknowns`")
        labels = np.arange(1, count + 1) if nodes is None else np.asarray(nodes)
        unknowns = [*((label, k) for label in labels for k in range(each)), *((0, k) for k in range(scalars))]
    pairs = np.asarray(unknowns).reshape(-1, 2)
    arrays |= {"unknown_nodes": pairs[:, 0], "unknown_components": pairs[:, 1]}
    if interfaces:
        arrays |= {"interface_names": list(interfaces), "interface_nodes": list(interfaces.values())}
    return arrays


def _recovery(points: Any, displacement: Any, stress: Any, quantities: Any) -> dict[str, Any]:
    """Recovered quantities by the keys of an .npz file of matrices."""
    given = {"points": points, "displacement": displacement, "stress": stress}
    arrays: dict[str, Any] = {key: array for key, array in given.items() if array is not None}
    if stress is not None and points is not None:
        arrays["stress_points"] = np.arange(1, len(points) + 1)
    for name, (matrix, rows, units) in (quantities or {}).items():
        arrays |= {f"quantity.{name}.matrix": matrix, f"quantity.{name}.rows": np.array(list(rows), str), f"quantity.{name}.units": np.array(units, str)}
    return arrays


def _program(given: str | os.PathLike | None) -> str:
    """Path of bielle-reduce."""
    here = os.path.dirname(os.path.abspath(__file__))
    found = [os.path.join(here, folder, "bielle-reduce") for folder in FOLDERS] if given is None else [os.fspath(given)]
    path = next((each for each in found if os.access(each, os.X_OK)), None) or (None if given else shutil.which("bielle-reduce"))
    if path is None:
        raise _core.InputError(f"superelement: there is no program {found[0] if given else 'bielle-reduce'}; "
                               "`program` gives its path")
    return path
