"""Arrays of NumPy (.npz): the way from Python to a body.

| key | shape | content |
|---|---|---|
| K, M, C | n, n | stiffness, mass, and viscous damping (may be absent); also sparse, as scipy.sparse's K.data, K.indices, K.indptr |
| positions | N, 3 | of the nodes |
| nodes | N | their numbers; default 1, 2, .. |
| axes | N, 3, 3 | columns: directions of each node's axes; default: those of the body |
| unknown_nodes | n | number of the node of each unknown; 0: a scalar coordinate |
| unknown_components | n | 0 to 5: x y z rx ry rz; of scalar coordinates: any |
| interface_names, interface_nodes | k | names and numbers of nodes that are interfaces; default: the user names them |
| mass, centre, inertia | (), 3, 3 x 3 | mass properties, inertia about the centre; default: those of the matrices |
| inertia_components | 6, n, n | S_11 S_22 S_33 S_23 S_13 S_12 of the superelement file; default: found or estimated |
| points, displacement | p, 3; 3p, n | points inside, and x y z of each as functions of the unknowns; may be absent |
| point_numbers, point_masses | p | their numbers (default 1, 2, ..), and masses that sum up to the body's |
| stress, stress_points | 6s, n; s | xx yy zz yz xz xy, body axes, at points, and their numbers; may be absent |
| quantity.NAME.matrix, .rows, .units | k, n; k; k | a recovered quantity, names of its rows (default: row_1 ..) and their units (Pa, m/m of strain, N, N m, m, rad, -) |
| length_unit, mass_unit | | texts; default: as the command says |

Without unknown_nodes and unknown_components, the rows are x y z (rx ry rz if they are enough) of all nodes in order,
then scalar coordinates.
"""

import os
import re
import zipfile
import zlib

import numpy as np
import scipy.sparse

from ..messages import InputError, counted, did_you_mean
from . import recovery
from .job_files import stem
from .matrix_set import MassProperties, MatrixSet, Shapes, sparse

MATRICES = {"K": "stiffness", "M": "mass", "C": "damping"}
PARTS = ("data", "indices", "indptr")
KEYS = [*MATRICES, *(f"{name}.{part}" for name in MATRICES for part in PARTS), "positions", "nodes", "axes", "unknown_nodes",
        "unknown_components", "interface_names", "interface_nodes", "mass", "centre", "inertia", "inertia_components",
        "points", "displacement", "point_numbers", "point_masses", "stress", "stress_points", "length_unit", "mass_unit", "name"]
QUANTITY = re.compile(r"quantity\.(\w+)\.(matrix|rows|units)").fullmatch
FAULTS = (ValueError, OSError, EOFError, zipfile.BadZipFile, zlib.error, KeyError, TypeError, NotImplementedError,
          RuntimeError, MemoryError, SyntaxError, OverflowError, IndexError, AttributeError)


def load(path, wanted=None):
    """The arrays of an .npz file by name, without those of Python objects, whose reading could run any code. @raises InputError"""
    try:
        if os.path.isfile(path) and not os.path.getsize(path):
            raise InputError(f"'{path}': is empty")
        with open(path, "rb") as stream, np.load(stream, allow_pickle=False) as file:
            return {name: file[name] for name in file.files if wanted is None or name in wanted}
    except (FileNotFoundError, IsADirectoryError, PermissionError) as error:
        raise InputError(f"cannot read '{path}': {error.strerror}") from None
    except FAULTS as error:
        raise InputError(f"'{path}': is no readable .npz file: "
                         f"{str(error).splitlines()[0] if str(error) else type(error).__name__}") from None


def names_in(path):
    """Names of the arrays in a file; none if it is damaged."""
    try:
        with zipfile.ZipFile(path) as file:
            return [name.removesuffix(".npy") for name in file.namelist()]
    except FAULTS:
        return []


def recognises(path):
    """Whether the file holds a stiffness K, or is damaged."""
    names = names_in(path)
    return not names or "massMatrixReduced" not in names


def read(path, options):
    """@raises InputError"""
    return matrices_of(path, load(path), options.name, f"arrays, {os.path.basename(path)}")


def matrices_of(path, arrays, name, source):
    """A MatrixSet of arrays with the keys above. @param path: for messages; name: of the body; empty: as the arrays or the file say
    @raises InputError"""
    for key in arrays:
        if key not in KEYS and not QUANTITY(key):
            raise InputError(f"'{path}': there is no key '{key}'{did_you_mean(key, KEYS)}")
    arrays = {key: np.asarray(array) for key, array in arrays.items()}
    matrices = {attribute: _matrix(path, arrays, key) for key, attribute in MATRICES.items()}
    for key in ("K", "M", "positions"):
        if key not in arrays and f"{key}.data" not in arrays:
            raise InputError(f"'{path}': the array '{key}' is missing")
    size = matrices["stiffness"].shape[0]
    positions = _numbers(path, arrays, "positions", (-1, 3))
    count = len(positions)
    numbers = _whole_numbers(path, arrays, "nodes", (count,), np.arange(1, count + 1))
    if len(set(numbers.tolist())) < count or count and numbers.min() < 1:
        raise InputError(f"'{path}': 'nodes' must be numbers from 1, each once")
    nodes, components = _unknowns(path, arrays, numbers, size)
    interfaces = _interfaces(path, arrays, numbers)
    axes = _numbers(path, arrays, "axes", (count, 3, 3)) if "axes" in arrays else None
    return MatrixSet(name=name or _text(arrays, "name") or stem(path), source=source, numbers=numbers, positions=positions,
                     axes=axes, unknown_nodes=nodes, unknown_components=components, **matrices,
                     interfaces=interfaces, **_inside(path, arrays, size), quantities=_quantities(path, arrays, size),
                     length_unit=_text(arrays, "length_unit"), mass_unit=_text(arrays, "mass_unit"))


def _interfaces(path, arrays, numbers):
    """Rows of the interface nodes by name."""
    names = [str(name) for name in arrays.get("interface_names", np.array([], str)).reshape(-1)]
    labels = _whole_numbers(path, arrays, "interface_nodes", (len(names),), np.zeros(len(names), int))
    name_of = {}
    for name, label in zip(names, labels.tolist()):
        if names.count(name) > 1:
            raise InputError(f"'{path}': 'interface_names' holds '{name}' more than once")
        if label == 0:
            raise InputError(f"'{path}': 'interface_nodes' gives '{name}' the node 0; nodes are numbered from 1")
        if label in name_of:
            raise InputError(f"'{path}': the interfaces '{name_of[label]}' and '{name}' are both node {label}; each interface "
                             "needs a node of its own")
        name_of[label] = name
    return dict(zip(names, _rows(path, "interface_nodes", labels, numbers).tolist()))


def _inside(path, arrays, size):
    """Mass properties, S_kl and points, if the file has them."""
    found = {}
    if any(key in arrays for key in ("mass", "centre", "inertia")):
        mass, centre, inertia = (_numbers(path, arrays, key, shape) for key, shape in (("mass", ()), ("centre", (3,)), ("inertia", (3, 3))))
        found["mass_properties"] = MassProperties(float(mass), centre, inertia)
    if "inertia_components" in arrays:
        found["inertia_components"] = _numbers(path, arrays, "inertia_components", (6, size, size))
    if "points" in arrays or "displacement" in arrays:
        points = _numbers(path, arrays, "points", (-1, 3))
        count = len(points)
        numbers = _whole_numbers(path, arrays, "point_numbers", (count,), np.arange(1, count + 1))
        found["shapes"] = Shapes(numbers, points, _numbers(path, arrays, "displacement", (3 * count, size)),
                                 masses=_numbers(path, arrays, "point_masses", (count,)) if "point_masses" in arrays else None,
                                 **_stress(path, arrays, numbers, size))
    elif "stress" in arrays or "stress_points" in arrays:
        raise InputError(f"'{path}': 'stress' belongs to 'points' with their 'displacement', which are missing")
    return found


def _stress(path, arrays, numbers, size):
    """Stress at points and their rows, if the file has it."""
    if "stress" not in arrays and "stress_points" not in arrays:
        return {}
    labels = _whole_numbers(path, arrays, "stress_points", (-1,))
    place = {int(number): row for row, number in enumerate(numbers)}
    for label in labels:
        if int(label) not in place:
            raise InputError(f"'{path}': 'stress_points' names the point {label}, which 'point_numbers' does not")
    return {"stress": _numbers(path, arrays, "stress", (6 * len(labels), size)), "stress_points": np.array([place[int(label)] for label in labels], np.int64)}


def _quantities(path, arrays, size):
    """Recovered quantities by name."""
    found = {}
    for name in dict.fromkeys(match[1] for match in map(QUANTITY, arrays) if match):
        key = f"quantity.{name}"
        matrix = _numbers(path, arrays, f"{key}.matrix", (-1, size))
        rows = [str(row) for row in arrays.get(f"{key}.rows", [f"row_{k + 1}" for k in range(len(matrix))])]
        units = [str(unit) for unit in np.ravel(arrays.get(f"{key}.units", recovery.UNKNOWN))]
        found[name] = recovery.Quantity(rows, units * len(matrix) if len(units) == 1 else units, matrix)
        if not recovery.is_name(name):
            raise InputError(f"'{path}': '{name}' is no name of a quantity: {recovery.NAME} are expected")
        try:
            recovery.check(name, found[name], size)
        except InputError as error:
            raise InputError(f"'{path}': {error}") from None
    return found


def _text(arrays, name):
    return str(arrays[name]) if name in arrays else None


def _numbers(path, arrays, name, shape, default=None):
    """An array of finite numbers. @param shape: -1: any count"""
    array = arrays.get(name, default)
    if array is None:
        raise InputError(f"'{path}': the array '{name}' is missing")
    if array.dtype.kind not in "iuf" or len(array.shape) != len(shape) or any(w not in (-1, k) for w, k in zip(shape, array.shape)):
        told = " x ".join("n" if each == -1 else str(each) for each in shape)
        raise InputError(f"'{path}': '{name}' is {array.dtype} of shape {array.shape}; {told} numbers are expected")
    if not np.isfinite(array).all():
        raise InputError(f"'{path}': '{name}' holds numbers that are not finite")
    return np.asarray(array, float)


def _whole_numbers(path, arrays, name, shape, default=None):
    """An array of integers, which may be stored as floating-point numbers."""
    array = _numbers(path, arrays, name, shape, default)
    wrong = array[(array != np.rint(array)) | (np.abs(array) > 2**53)]
    if len(wrong):
        raise InputError(f"'{path}': '{name}' holds {wrong[0]:g}; whole numbers are expected")
    return array.astype(np.int64)


def _matrix(path, arrays, name):
    """scipy.sparse, None if there is none."""
    if f"{name}.data" in arrays:
        data = _numbers(path, arrays, f"{name}.data", (-1,))
        indices, indptr = (_whole_numbers(path, arrays, f"{name}.{part}", (-1,)) for part in PARTS[1:])
        size = len(indptr) - 1
        try:
            matrix = scipy.sparse.csr_matrix((data, indices, indptr), shape=(size, size))
            matrix.check_format(full_check=True)
        except (ValueError, IndexError) as error:
            raise InputError(f"'{path}': '{name}.indices' and '{name}.indptr' make no sparse matrix: {error}") from None
        return sparse(matrix)
    if name not in arrays:
        return None
    array = _numbers(path, arrays, name, (-1, -1))
    if array.shape[0] != array.shape[1]:
        raise InputError(f"'{path}': '{name}' has {counted(array.shape[0], 'row')} and "
                         f"{counted(array.shape[1], 'column')}")
    return sparse(array)


def _unknowns(path, arrays, numbers, size):
    """Row of the node (-1: scalar) and component of each unknown."""
    if "unknown_nodes" in arrays or "unknown_components" in arrays:
        labels, components = (_whole_numbers(path, arrays, name, (size,)) for name in ("unknown_nodes", "unknown_components"))
        nodes = _rows(path, "unknown_nodes", labels, numbers)
        wrong = (nodes >= 0) & ((components < 0) | (components > 5))
        if wrong.any():
            raise InputError(f"'{path}': 'unknown_components' holds {components[wrong][0]}; 0 to 5 are x y z rx ry rz")
        return nodes, np.where(nodes < 0, np.cumsum(nodes < 0) - 1, components)
    count = len(numbers)
    each = 6 if size >= 6 * count else 3
    if size < 3 * count:
        raise InputError(f"'{path}': {counted(count, 'node')} with 3 unknowns each need {3 * count} rows, 'K' has "
                         f"{size}; give 'unknown_nodes' "
                         "and 'unknown_components'")
    scalars = size - each * count
    return (np.concatenate([np.repeat(np.arange(count), each), np.full(scalars, -1)]),
            np.concatenate([np.tile(np.arange(each), count), np.arange(scalars)]))


def _rows(path, name, labels, numbers):
    """Rows of numbers of nodes; -1 for 0."""
    place = {int(number): row for row, number in enumerate(numbers)} | {0: -1}
    for label in labels:
        if label not in place:
            raise InputError(f"'{path}': '{name}' names node {label:g}, which 'nodes' does not")
    return np.array([place[int(label)] for label in labels], np.int64)


def write(matrices, path, options):
    """Writes the keys above. @returns the path, in a list"""
    labels = np.where(matrices.unknown_nodes < 0, 0, matrices.numbers[matrices.unknown_nodes] if len(matrices.numbers) else 0)
    arrays = {"positions": matrices.positions, "nodes": matrices.numbers, "unknown_nodes": labels,
              "unknown_components": matrices.unknown_components, "name": matrices.name}
    for name, attribute in MATRICES.items():
        if getattr(matrices, attribute) is not None:
            matrix = sparse(getattr(matrices, attribute))
            arrays |= {f"{name}.{part}": getattr(matrix, part) for part in PARTS}
    if matrices.axes is not None:
        arrays["axes"] = matrices.axes
    if matrices.interfaces:
        arrays["interface_names"] = np.array(list(matrices.interfaces))
        arrays["interface_nodes"] = matrices.numbers[list(matrices.interfaces.values())]
    if matrices.mass_properties is not None:
        arrays |= {name: getattr(matrices.mass_properties, name) for name in ("mass", "centre", "inertia")}
    if matrices.inertia_components is not None:
        arrays["inertia_components"] = matrices.inertia_components
    if matrices.shapes is not None:
        shapes = matrices.shapes
        arrays |= {"points": shapes.points, "displacement": shapes.displacement, "point_numbers": shapes.numbers}
        arrays |= {"point_masses": shapes.masses} if shapes.masses is not None else {}
        arrays |= {"stress": shapes.stress, "stress_points": shapes.numbers[shapes.stress_points]} if shapes.stress is not None else {}
    for name, quantity in matrices.quantities.items():
        arrays |= {f"quantity.{name}.{part}": np.array(getattr(quantity, part)) for part in ("matrix", "rows", "units")}
    arrays |= {name: getattr(matrices, name) for name in ("length_unit", "mass_unit") if getattr(matrices, name)}
    np.savez(path, **arrays)
    return [path]
