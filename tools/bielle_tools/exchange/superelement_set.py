"""A superelement file as a MatrixSet: interfaces are its nodes, modes its scalar coordinates."""

import os

import numpy as np

from ..results.results_file import open_hdf5, reading
from .matrix_set import MassProperties, MatrixSet, Shapes, sparse
from .recovery import Quantity


def read(path, _options=None):
    """@raises InputError for a body in pieces, and for a damaged file."""
    with open_hdf5(path, "bielle superelement", "a superelement of one piece") as file, reading(path, "/"):
        kept = file["interface/dofs"][()].astype(bool)
        nodes, components = np.nonzero(kept)
        modes = len(file["reduced/stiffness"]) - len(nodes)
        shapes = shapes_of(file) if "recovery/displacement" in file else None
        names = file["interface/names"].asstr()[()]
        return MatrixSet(
            name=file.attrs["name"], source=f"superelement, {os.path.basename(path)}",
            numbers=np.arange(1, len(names) + 1), positions=file["interface/positions"][()], axes=file["interface/rotations"][()],
            unknown_nodes=np.concatenate([nodes, np.full(modes, -1)]),
            unknown_components=np.concatenate([components, np.arange(modes)]),
            stiffness=sparse(file["reduced/stiffness"][()]), mass=sparse(file["reduced/mass"][()]),
            damping=sparse(file["reduced/damping"][()]), inertia_components=file["reduced/inertia_components"][()],
            interfaces={name: k for k, name in enumerate(names)},
            mass_properties=MassProperties(*(file[f"mass_properties/{name}"][()] for name in ("mass", "centre", "inertia"))),
            shapes=shapes, quantities=quantities_of(file), length_unit="m", mass_unit="kg", notes=notes_on(file))


def notes_on(file):
    """A note on the parts of a superelement that a MatrixSet does not hold."""
    parts = {"reduced/geometric_stiffness": "geometric stiffness of spins and loads", "loads": "load patterns", "points": "named points",
             "adequacy": "measures of its accuracy"}
    found = [told for group, told in parts.items() if group in file]
    if "recovery/stress" in file and "recovery/displacement" not in file:
        found.append("stress, whose points have no displacements")
    return [f"left out of the superelement: {', '.join(found)}"] if found else []


def shapes_of(file):
    """Displacements of the nodes of the mesh that the file keeps, and the cells whose nodes are all among them."""
    points = file["mesh/points"][()]
    kept = file["recovery/displacement_nodes"][()] if "recovery/displacement_nodes" in file else np.arange(len(points))
    row = np.full(len(points), -1)
    row[kept] = np.arange(len(kept))
    cells = {int(kind): row[block[()]] for kind, block in file.get("mesh/cells", {}).items()}
    cells = {kind: block[(block >= 0).all(axis=1)] for kind, block in cells.items()}
    stress = {}
    if "recovery/stress" in file:
        places = row[file["recovery/stress_nodes"][()]]
        stress = {"stress": file["recovery/stress"][()][np.repeat(places >= 0, 6)], "stress_points": places[places >= 0]}
    return Shapes(numbers=kept + 1, points=points[kept], displacement=file["recovery/displacement"][()], **stress,
                  cells={kind: block for kind, block in cells.items() if len(block)})


def quantities_of(file):
    """Recovered quantities by name."""
    return {name: Quantity(list(group["rows"].asstr()[()]), list(group["units"].asstr()[()]), group["matrix"][()])
            for name, group in file.get("quantities", {}).items()}
