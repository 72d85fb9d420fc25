"""The matrix file: the form of HDF5 in which `bielle-reduce` takes the matrices of other programs.

Root attributes: `format` ("bielle matrices"), `version` (1), `name`, `source`, and `length_unit`, `mass_unit` if they
are known. reduce/matrices/README.md lists the datasets.
"""

import h5py
import numpy as np
import scipy.sparse

from ..results.results_file import open_hdf5, reading
from .matrix_set import MassProperties, MatrixSet, Shapes
from .recovery import Quantity

PARTS_OF_SHAPES = ("numbers", "points", "displacement", "rotation", "masses", "inertias", "stress", "stress_points")
FORMAT, VERSION = "bielle matrices", 1
MATRICES = {"stiffness": "stiffness", "mass": "mass", "damping": "damping", "geometric_stiffness": "geometric_stiffness"}


def write(matrices, path, _options=None):
    """Writes a MatrixSet. @returns list of the path"""
    matrices.check()
    with h5py.File(path, "w") as file:
        attributes = {"format": FORMAT, "version": VERSION, "name": matrices.name, "source": matrices.source,
                      "length_unit": matrices.length_unit, "mass_unit": matrices.mass_unit}
        file.attrs.update({key: value for key, value in attributes.items() if value is not None})
        file["nodes/numbers"] = np.asarray(matrices.numbers, np.int64)
        file["nodes/positions"] = matrices.positions
        if matrices.axes is not None:
            file["nodes/axes"] = matrices.axes
        file["unknowns/nodes"] = np.asarray(matrices.unknown_nodes, np.int64)
        file["unknowns/components"] = np.asarray(matrices.unknown_components, np.int64)
        for group, attribute in MATRICES.items():
            _write_sparse(file, group, getattr(matrices, attribute))
        if matrices.interfaces:
            file["interfaces/names"] = list(matrices.interfaces)
            file["interfaces/nodes"] = np.asarray(list(matrices.interfaces.values()), np.int64)
        if matrices.inertia_components is not None:
            file["inertia_components"] = matrices.inertia_components
        if matrices.mass_properties is not None:
            for name in ("mass", "centre", "inertia"):
                file[f"mass_properties/{name}"] = getattr(matrices.mass_properties, name)
        if matrices.shapes is not None:
            _write_shapes(file, matrices.shapes)
        _write_cells(file, "nodes/cells", matrices.cells)
        for name, quantity in matrices.quantities.items():
            file[f"quantities/{name}/rows"], file[f"quantities/{name}/units"] = list(quantity.rows), list(quantity.units)
            file[f"quantities/{name}/matrix"] = quantity.matrix
    return [path]


def recognises(path):
    """Tells whether a file is a matrix file rather than another file of HDF5."""
    try:
        with h5py.File(path) as file:
            return file.attrs.get("format") == FORMAT
    except (OSError, RuntimeError, ValueError):
        return False


def read(path, _options=None):
    """A MatrixSet that `write` wrote. @raises InputError for a damaged file"""
    with open_hdf5(path, FORMAT, "matrices of another program") as file, reading(path, "/"):
        def array(name):
            return file[name][()] if name in file else None

        names = file["interfaces/names"].asstr()[()] if "interfaces" in file else []
        return MatrixSet(
            name=file.attrs["name"], source=file.attrs["source"], numbers=array("nodes/numbers"), positions=array("nodes/positions"),
            axes=array("nodes/axes"), unknown_nodes=array("unknowns/nodes"), unknown_components=array("unknowns/components"),
            interfaces=dict(zip(names, array("interfaces/nodes") if len(names) else [])),
            inertia_components=array("inertia_components"),
            mass_properties=MassProperties(*(array(f"mass_properties/{name}") for name in ("mass", "centre", "inertia")))
            if "mass_properties" in file else None,
            shapes=_read_shapes(file) if "shapes" in file else None, cells=_read_cells(file, "nodes/cells"),
            quantities={name: Quantity(list(group["rows"].asstr()[()]), list(group["units"].asstr()[()]), group["matrix"][()])
                        for name, group in file.get("quantities", {}).items()},
            length_unit=file.attrs.get("length_unit"), mass_unit=file.attrs.get("mass_unit"),
            **{attribute: _read_sparse(file, group) for group, attribute in MATRICES.items()})


def _write_sparse(file, name, matrix):
    if matrix is None:
        return
    entries = scipy.sparse.coo_matrix(matrix)
    file[f"{name}/rows"] = entries.row.astype(np.int64)
    file[f"{name}/columns"] = entries.col.astype(np.int64)
    file[f"{name}/values"] = entries.data


def _read_sparse(file, name):
    if name not in file:
        return None
    group, n = file[name], len(file["unknowns/nodes"])
    return scipy.sparse.csr_matrix((group["values"][()], (group["rows"][()], group["columns"][()])), shape=(n, n))


def _write_shapes(file, shapes):
    for name in PARTS_OF_SHAPES:
        if getattr(shapes, name) is not None:
            file[f"shapes/{name}"] = getattr(shapes, name)
    _write_cells(file, "shapes/cells", shapes.cells)


def _read_shapes(file):
    group = file["shapes"]
    found = {name: group[name][()] if name in group else None
             for name in PARTS_OF_SHAPES}
    return Shapes(**found, cells=_read_cells(file, "shapes/cells"))


def _write_cells(file, path, cells):
    for kind, block in cells.items():
        file[f"{path}/{kind}"] = np.asarray(block, np.int64)


def _read_cells(file, path):
    return {int(kind): block[()] for kind, block in file.get(path, {}).items()}
