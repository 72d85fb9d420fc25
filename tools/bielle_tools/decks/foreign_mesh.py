"""Reads meshes of foreign formats: Abaqus, CalculiX and Nastran by Bielle's own readers, all others through meshio.

If a format has no named sets, its numbers become names: Nastran properties `property_3`, Medit references `ref_3`,
integer arrays of VTK files `<array>_3`. MED families give the names of their groups.
"""

import contextlib
import io
import os
import re

import numpy as np

from ..mesh.meshio_library import meshio_library
from ..mesh.solid_mesh import RawMesh
from ..messages import InputError
from .abaqus_file import read_abaqus
from .nastran_cards import read_cards
from .nastran_file import read_extras
from .nastran_mesh import read_mesh

READ_BY_GMSH = (".geo", ".step", ".stp", ".brep", ".iges", ".igs", ".msh", ".unv")
NASTRAN = (".bdf", ".nas", ".fem")
MANY_PROGRAMS = (".dat",)
# Arrays whose integers are references to groups, and the prefix of their names.
REFERENCES = {"medit:ref": "ref"}
MOST_GROUPS = 200  # an integer array with more values numbers things and names no groups


def read_foreign(path):
    """@returns RawMesh. @raises InputError with one sentence."""
    if not os.path.isfile(path):
        raise InputError(f"'{path}' does not exist" if not os.path.exists(path) else f"'{path}' is not a file")
    extension = os.path.splitext(path)[1].lower()
    if extension in READ_BY_GMSH:
        raise InputError(f"'{path}': {extension} needs no conversion, bielle-reduce reads it")
    if extension == ".inp":
        return read_abaqus(path)
    if extension in MANY_PROGRAMS:
        return _nastran_mesh(path) if is_nastran(path) else read_abaqus(path)
    if extension in NASTRAN:
        return _nastran_mesh(path)
    mesh = _read(path)
    _check_points(mesh, path)
    return _raw_mesh(mesh)


def _check_points(mesh, path):
    if np.ndim(mesh.points) != 2 or not len(mesh.points):
        raise InputError(f"'{path}' holds no points: it is no mesh of the format that '{os.path.splitext(path)[1]}' stands for")


def _read(path, shown=None, file_format=None):
    """Reads meshio's mesh; its output, its exceptions and its calls of exit become one sentence."""
    meshio = meshio_library()

    said = io.StringIO()
    try:
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
            return meshio.read(path, file_format)
    except (Exception, SystemExit) as error:
        reason = str(error) if not isinstance(error, SystemExit) else ""
        reason = " ".join((said.getvalue() + " " + reason).split()) or type(error).__name__
        raise InputError(f"meshio cannot read '{shown or path}': {reason}") from None


def with_path(path, work):
    """The result of `work`, whose sentences get the path if they have none."""
    try:
        return work()
    except InputError as error:
        text = str(error)
        raise InputError(text if path in text else f"'{path}' {text}") from None


def _nastran_mesh(path):
    """The mesh with the sets, and the notes on other contents."""
    before = []
    cards = read_cards(path, before)
    raw, grids = read_mesh(cards)
    if not len(raw.points):
        raise InputError(f"'{path}' holds no GRID: it is no Nastran bulk data")
    extras = read_extras(cards, grids, before)
    raw.point_sets.update(extras.point_sets)
    raw.notes += extras.notes
    return raw


def is_nastran(path):
    """Tells whether a file with a name that several programs use is Nastran's."""
    with open(path, encoding="utf-8", errors="replace") as file:
        for line in file:
            if re.match(r"\s*(BEGIN\s+BULK|GRID\b|GRID\*|CTETRA|SOL\s+\d|INCLUDE\s)", line, re.IGNORECASE):
                return True
            if line.lstrip().startswith("*"):
                return False
    return False


def _raw_mesh(mesh):
    points = np.asarray(mesh.points, dtype=float)
    if points.shape[1] == 2:
        points = np.column_stack([points, np.zeros(len(points))])
    raw = RawMesh(points, [(block.type, block.data) for block in mesh.cells])
    for name, parts in mesh.cell_sets.items():
        if not name.startswith("gmsh:"):
            raw.cell_sets[name] = [np.asarray([] if p is None else p, np.int64) for p in parts]
    for name, nodes in mesh.point_sets.items():
        raw.point_sets[name] = np.asarray(nodes, np.int64)

    families = {"cell_tags": getattr(mesh, "cell_tags", {}), "point_tags": getattr(mesh, "point_tags", {})}
    for key, arrays in mesh.cell_data.items():
        arrays = [np.asarray(a) for a in arrays]
        for name, values in _names(key, np.unique(np.concatenate([a.ravel() for a in arrays])), arrays[0].dtype, families, raw):
            raw.cell_sets[name] = [np.flatnonzero(np.isin(a, values)) for a in arrays]
    for key, array in mesh.point_data.items():
        array = np.asarray(array)
        if array.ndim == 1:
            for name, values in _names(key, np.unique(array), array.dtype, families, raw):
                raw.point_sets[name] = np.flatnonzero(np.isin(array, values))
    return raw


def _names(key, values, dtype, families, raw):
    """Groups that an array defines: pairs of name and values."""
    if not np.issubdtype(dtype, np.integer) or not len(values):
        return []
    if families.get(key):
        groups = {}
        for family, names in families[key].items():
            for name in names:
                groups.setdefault(name.strip("\x00 "), []).append(family)
        return list(groups.items())
    if key in ("cell_tags", "point_tags"):
        return []
    if len(values) > MOST_GROUPS:
        raw.notes.append(f"the array '{key}' has {len(values)} different values: it is not read as groups")
        return []
    marked = values[values >= 0]
    parts = key.split("-")  # meshio joins the names of the sets that it writes into an array
    if len(parts) > 1 and np.array_equal(marked, np.arange(len(parts))):
        return [(part, [value]) for part, value in zip(parts, marked)]
    prefix = REFERENCES.get(key, key.replace(":", "_"))
    return [(f"{prefix}_{value}", [value]) for value in marked if value or len(values) > 1]
