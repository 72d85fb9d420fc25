"""Exudyn's reduced body of a floating frame (.npz, .hdf5): the file of ObjectFFRFreducedOrderInterface.SaveToFile.

modeBasis (3p,m) are the shapes at all nodes, xRef their places, and the other keys inertia integrals with the mass of
the mesh, which is equal in all directions. postProcessingModes may hold the stress xx yy zz yz xz xy of each node and
mode, (p,6m); in an .npz file it is a pickled dictionary. The writer stores all free modes at the nodes and recovery
points. (Exudyn, FEM.py, GetDictionary; A. Zwoelfer, J. Gerstmayr, "The nodal-based floating frame of reference
formulation with modal reduction", Acta Mech. 232 (2021) 835.)
"""

import os

import h5py
import numpy as np

from ..mesh.cells import BY_GMSH, SOLIDS, boundary_faces, permutation, solid_faces, triangles_of
from ..messages import InputError, note
from ..results.results_file import reading
from .free_modes import free_modes, moments
from .inertia_moments import EPSILON, Moments, components_of, inertia_about, second_moment
from .job_files import stem
from .matrix_set import MassProperties
from .modal_body import body_of_modes, rigid_mass
from .npz_matrices import load, names_in
from .pickled_arrays import UnknownObject, load_dictionary

SHAPES = {"modeBasis": 2, "massMatrixReduced": 2, "stiffnessMatrixReduced": 2, "xRef": 1, "inertiaLocal": 2, "Mtt": 2, "chiU": 1,
          "mPhitTPsi": 2, "mXRefTildePsi": 2, "mXRefTildePsiTilde": 2, "mPsiTildePsiTilde": 2}  # key: number of its dimensions


RECOVERY = "postProcessingModes"
ENUMERATION = "OutputVariableType"                # the output variables of Exudyn
STRESS = (f"{ENUMERATION}.StressLocal", 1 << 29)  # the name and the number of one of them


def recognises(path):
    """Whether the file has Exudyn's keys."""
    return _is_hdf5(path) or "massMatrixReduced" in names_in(path)


def _is_hdf5(path):
    return os.path.splitext(path)[1].lower() in (".hdf5", ".h5")


def _load(path):
    """Arrays by name, and the stress of each node, component and mode (p,6,m) or None. @raises InputError"""
    if not _is_hdf5(path):
        if "massMatrix" in names_in(path):
            _refuse_interface(path)
        return load(path, SHAPES), _stress_modes(path, _pickled(path))
    with _opened(path) as file, reading(path, "/"):
        if "massMatrix" in file:
            _refuse_interface(path)
        arrays = {name: np.asarray(file[name][()]) for name in SHAPES if isinstance(file.get(name), h5py.Dataset)}
        group = file.get(RECOVERY)
        found = {name: member[()] for name, member in group.items() if isinstance(member, h5py.Dataset)} if isinstance(group, h5py.Group) else {}
    return arrays, _stress_modes(path, found)


def _pickled(path):
    """postProcessingModes of an .npz file. @raises InputError if they are damaged"""
    try:
        return load_dictionary(path, RECOVERY, (ENUMERATION,)) or {}
    except UnknownObject as error:
        note(f"{path}: {RECOVERY} hold an object {error}, which is not read: they are left out")
        return {}


def _stress_modes(path, found):
    """The matrix of postProcessingModes; None if there is none, with a note if it is another quantity."""
    if "matrix" not in found:
        return None
    kind = found.get("outputVariableType", "")
    kind = kind.decode("utf-8", "replace") if isinstance(kind, bytes) else kind
    if not isinstance(kind, (str, int, np.integer)) or kind not in STRESS:
        note(f"{path}: {RECOVERY} are no stress: they are left out")
        return None
    return np.asarray(found["matrix"])


def _opened(path):
    try:
        return h5py.File(path, "r")
    except (OSError, RuntimeError, ValueError) as error:
        raise InputError(f"'{path}': is no readable HDF5 file: {str(error).splitlines()[0]}") from None


def _refuse_interface(path):
    raise InputError(f"'{path}': holds Exudyn's FEMinterface; reduce it, and save the "
                     "ObjectFFRFreducedOrderInterface")


def read(path, options):
    """@raises InputError"""
    arrays, stress = _load(path)
    for name, dimensions in SHAPES.items():
        array = arrays.get(name)
        if array is None:
            raise InputError(f"'{path}': the array '{name}' of Exudyn's reduced body is missing")
        if array.dtype.kind not in "iuf" or array.ndim != dimensions or not np.isfinite(array).all():
            raise InputError(f"'{path}': '{name}' must be {dimensions}-dimensional, with finite numbers")
    rows, modes = arrays["modeBasis"].shape
    wanted = {"xRef": (rows,), "massMatrixReduced": (modes, modes), "stiffnessMatrixReduced": (modes, modes), "inertiaLocal": (3, 3),
              "Mtt": (3, 3), "chiU": (3,), "mPhitTPsi": (3, modes), "mXRefTildePsi": (3, modes), "mXRefTildePsiTilde": (3, 3 * modes),
              "mPsiTildePsiTilde": (3 * modes, 3 * modes)}
    for name, shape in wanted.items():
        if arrays[name].shape != shape or rows % 3 or not modes:
            raise InputError(f"'{path}': '{name}' has the shape {arrays[name].shape}, expected {shape} for "
                             f"{rows // 3} nodes and {modes} modes")
    if stress is not None and (stress.dtype.kind not in "iuf" or stress.shape != (rows // 3, 6 * modes) or not np.isfinite(stress).all()):
        raise InputError(f"'{path}': the stress of postProcessingModes has the shape {stress.shape}; {(rows // 3, 6 * modes)} finite numbers "
                         "are expected")
    inertia = _moments(path, arrays, modes)
    shapes = np.zeros((rows // 3, 6, modes))
    shapes[:, :3] = arrays["modeBasis"].reshape(-1, 3, modes)
    coupling = np.column_stack([inertia.linear, inertia.turning()])
    mass = np.block([[rigid_mass(inertia), coupling.T], [coupling, arrays["massMatrixReduced"]]])
    body = body_of_modes(path, options, np.arange(1, rows // 3 + 1), arrays["xRef"].reshape(-1, 3), shapes,
                         arrays["stiffnessMatrixReduced"], mass, None, components_of(inertia),
                         None if stress is None else stress.reshape(-1, modes, 6).transpose(0, 2, 1))
    body.name, body.source = options.name or stem(path), f"Exudyn, {os.path.basename(path)}"
    body.mass_properties = MassProperties(inertia.mass, inertia.centre, inertia_about(inertia.inertia, -inertia.mass, inertia.centre))
    return body


def _moments(path, arrays, modes):
    mass = float(arrays["Mtt"][0, 0])
    if not mass > 0:
        raise InputError(f"'{path}': the mass is {mass:g}")
    eighth = arrays["mXRefTildePsiTilde"].reshape(3, modes, 3).transpose(1, 0, 2)
    halves = np.trace(eighth, axis1=1, axis2=2)[:, None, None] / 2 * np.eye(3)
    squares = arrays["mPsiTildePsiTilde"].reshape(modes, 3, modes, 3).transpose(0, 2, 1, 3)
    outer = np.trace(squares, axis1=2, axis2=3)[..., None, None] / 2 * np.eye(3) - squares  # (j,k): sum phi_k phi_j^T
    return Moments(mass, mass * arrays["chiU"], second_moment(arrays["inertiaLocal"]), arrays["mPhitTPsi"].T, halves - eighth,
                   outer.transpose(3, 2, 0, 1))


def write(matrices, path, options):
    """@returns the path, in a list. @raises InputError when the inertia inside the body is not known"""
    free = free_modes(matrices)
    known = moments(free)
    if known is None:
        raise InputError("the inertia inside the body is not known, which Exudyn's file needs: take the file of a "
                         "superelement")
    points = slice(free.nodes, None) if len(free.positions) > free.nodes else slice(None)
    if free.damping is not None:
        note("Exudyn's file has no damping: it is left out; the object has factors for it")
    places, shapes = free.positions[points], (free.motions[points, :3] @ free.modes).reshape(-1, free.modes.shape[1])
    values = _dictionary(known, free, places, shapes, _triangles(free.body))
    values[RECOVERY] = _stress(free)
    if _is_hdf5(path):
        with h5py.File(path, "w") as file:
            _write_dictionary(file, values)
    else:
        np.savez(path, **values)
    return [path]


def _stress(free):
    """Exudyn's postProcessingModes of the recovery points; empty if the body has no stress."""
    inside = free.body.shapes
    if inside is None or inside.stress is None:
        return {}
    modes = free.modes.shape[1]
    stress = np.zeros((len(inside.points), modes, 6))
    stress[inside.stress_points] = (inside.stress @ free.modes).reshape(-1, 6, modes).transpose(0, 2, 1)
    if len(inside.stress_points) < len(inside.points):
        note("points without stress have zeros in Exudyn's postProcessingModes")
    return {"matrix": stress.reshape(len(inside.points), -1), "outputVariableType": STRESS[0]}


def _write_dictionary(group, values):
    """Writes values as Exudyn's SaveDictToHDF5 does: each has its type as an attribute."""
    for key, value in values.items():
        if isinstance(value, dict):
            inner = group.create_group(key)
            inner.attrs["datatype"] = "dict"
            _write_dictionary(inner, value)
            continue
        value = float(value) if isinstance(value, np.floating) else value
        group[key] = value
        group[key].attrs["datatype"] = "ndarray" if isinstance(value, np.ndarray) else type(value).__name__


def _triangles(body):
    """Surface triangles (k,3) of the recovery points, for pictures."""
    if body.shapes is None or not body.shapes.cells:
        return np.zeros((0, 3), np.int64)
    cells = {BY_GMSH[kind].name: block[:, permutation(BY_GMSH[kind].name, "gmsh", "vtk")] for kind, block in body.shapes.cells.items()}
    solids = {kind: block for kind, block in cells.items() if kind in SOLIDS}
    return triangles_of(boundary_faces(solid_faces(solids))) if solids else np.zeros((0, 3), np.int64)


def _dictionary(known, free, places, shapes, triangles):
    """All keys of the file."""
    modes, eye = shapes.shape[1], np.eye(3)
    wedge = -np.einsum("abc,jc->jab", EPSILON, known.linear)  # sum phi_j~ dm
    eighth = np.trace(known.product, axis1=1, axis2=2)[:, None, None] * eye - known.product
    outer = known.square.transpose(2, 3, 1, 0)
    squares = np.trace(outer, axis1=2, axis2=3)[..., None, None] * eye - outer
    fifth = -np.einsum("abc,bcjk->jak", EPSILON, known.square)
    return {
        "modeBasis": shapes, "trigList": triangles, "massMatrixReduced": np.diag(np.diag(free.mass)),
        "stiffnessMatrixReduced": np.diag(np.diag(free.stiffness)), "infoList": np.array([modes, len(places), 3, 4, 7, 7 + modes]),
        "rigidBodyNodeType": "NodeType.RotationEulerParameters", "xRef": places.ravel(), "inertiaLocal": known.inertia,
        "Mtt": known.mass * eye, "totalMass": known.mass, "chiU": known.centre, "chiUtilde": -np.einsum("abc,c->ab", EPSILON, known.centre),
        "mPsiTildePsi": fifth.reshape(3 * modes, modes), "mPsiTildePsiTilde": squares.transpose(0, 2, 1, 3).reshape(3 * modes, 3 * modes),
        "mPhitTPsi": known.linear.T, "mPhitTPsiTilde": wedge.transpose(1, 0, 2).reshape(3, 3 * modes), "mXRefTildePsi": -known.turning().T,
        "mXRefTildePsiTilde": eighth.transpose(1, 0, 2).reshape(3, 3 * modes), "fileVersion": 1, "type": "ObjectFFRFreducedOrderInterface"}
