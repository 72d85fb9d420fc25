"""The mesh of a superelement, and displacement and stress of every node as functions of its reduced coordinates.

points(row) = x_0 + R_0 (X + U q), with the body's frame (x_0, R_0) and its reduced coordinates q from the results, and
the recovery matrix U from the superelement file. Stress is linear in q: S q, six components per node. A single time
reads whole matrices for a few operations per number; several times together (`blocks`) take little longer than one.
"""

import os

import numpy as np

from ..mesh.cells import BY_GMSH, SOLIDS, boundary_faces, permutation, solid_faces
from ..messages import InputError, counted
from ..results.results_file import LARGEST, open_hdf5, reading
from ..results.rotations import rotation_matrices
from .stress_invariants import von_mises


class NoSurface(InputError):
    """The file of a superelement is complete, but has no cells whose surface could be drawn."""


class SuperelementBody:
    """points (p,3) as meshed; cells {meshio type: (n,k)} in VTK's order, none of matrices without cells; results at times through `at`."""

    def __init__(self, path, group=""):
        """group: group of a piece in the file of a cut body ("/pieces/2"). @raises InputError, NoSurface"""
        self.path = path
        with _open(path, group) as opened, reading(path, group or "/"):
            file = opened[group] if group else opened
            if "mesh" not in file or "recovery/displacement" not in file:
                raise NoSurface(f"'{path}' keeps no mesh or no displacements: set 'recovery: {{displacement: all}}' in its "
                                 "body file and reduce it again to see it move")
            with reading(path, "mesh"):
                self._read_mesh(file)
            with reading(path, "recovery"):
                self._read_recovery(file["recovery"])

    def _read_mesh(self, file):
        self.points = _matrix(file["mesh/points"], 3)
        self.cells = {}
        for name, cells in file["mesh/cells"].items() if "mesh/cells" in file else ():
            cell = BY_GMSH[int(name)]
            cells = np.asarray(_matrix(cells, cell.nodes), np.int64)
            _check_numbers(cells, len(self.points))
            self.cells[cell.name] = cells[:, permutation(cell.name, "gmsh", "vtk")]
        if "mesh/cells" in file and not any(len(cells) for cells in self.cells.values()):
            raise ValueError

    def _read_recovery(self, recovery):
        self.displacement = _matrix(recovery["displacement"])
        self.displaced = _node_numbers(recovery, "displacement_nodes", len(self.displacement) / 3, len(self.points))
        self.stress, self.stressed = None, np.zeros(0, np.int64)
        if "stress" in recovery:
            self.stress = _matrix(recovery["stress"], self.displacement.shape[1])
            self.stressed = _node_numbers(recovery, "stress_nodes", len(self.stress) / 6, len(self.points))
        self._read_elasticity(recovery)

    def _read_elasticity(self, recovery):
        """elasticity (k,6,6) stress over engineering strain, and the material (s) of each stress, if the file has them."""
        self.elasticity, self.stress_materials = None, None
        if self.stress is not None and "elasticity" in recovery and "stress_materials" in recovery:
            elasticity = np.asarray(recovery["elasticity"], float)
            materials = np.asarray(recovery["stress_materials"], np.int64)
            _check_numbers(materials, len(elasticity))
            if elasticity.shape[1:] != (6, 6) or materials.shape != self.stressed.shape or not np.all(np.abs(elasticity) < LARGEST):
                raise ValueError
            self.elasticity, self.stress_materials = elasticity, materials

    def surface(self):
        """Boundary faces {type: (n,k)}, outward: at least one. @raises NoSurface without cells; InputError for cells that leave none"""
        if not self.cells:
            raise NoSurface(f"'{self.path}' has no surface, since its matrices have no cells: those of a deck with the same nodes give one "
                            "(`matrices: {nodes: DECK}` in the body file)")
        solids = {kind: cells for kind, cells in self.cells.items() if kind in SOLIDS}
        faces = boundary_faces(solid_faces(solids)) if solids else self.cells  # a file that keeps the skin alone
        if not any(len(block) for block in faces.values()):
            raise InputError(f"'{self.path}' is damaged: the cells of its mesh have no surface, since each face belongs to several of them")
        return faces

    def local_displacement(self, q):
        """(...,p,3) displacement of every node in the body's frame [m]; nodes without recovery stay at rest. q: (...,n)."""
        u = np.zeros(q.shape[:-1] + self.points.shape)
        u[..., self.displaced, :] = (q @ self.displacement.T).reshape(q.shape[:-1] + (-1, 3))
        return u

    def von_mises(self, q):
        """(...,p) [Pa], not a number if no stress was kept; None without stress recovery. q: (...,n)."""
        if self.stress is None:
            return None
        value = np.full(q.shape[:-1] + (len(self.points),), np.nan)
        value[..., self.stressed] = von_mises((q @ self.stress.T).reshape(q.shape[:-1] + (-1, 6)))
        return value

    def blocks(self, rows):
        """Divides the rows into blocks of some 100 MB whose fields are recovered together."""
        numbers = len(self.displacement) + (0 if self.stress is None else len(self.stress))
        together = int(np.clip(100e6 / (8 * max(numbers, 1)), 1, 64))
        return [rows[begin:begin + together] for begin in range(0, len(rows), together)]

    def at(self, frame, q, scale=1.0):
        """Positions (p,3) and elastic displacements (p,3), inertial, with the latter magnified by `scale` in the positions.

        frame: (7) x y z and quaternion w x y z of the body's frame; q: reduced coordinates (n).
        """
        return self.placed(frame, self.local_displacement(q), scale)

    def placed(self, frame, u, scale=1.0):
        """Returns positions and elastic displacements from displacements (p,3) in the body's frame."""
        R = rotation_matrices(frame[3:])
        return frame[:3] + (self.points + scale * u) @ R.T, u @ R.T


def interfaces_of(path, group=""):
    """[(name, kept directions (6), rotation matrix: interface axes -> body axes)] in the order of the coordinates."""
    with _open(path, group) as opened, reading(path, "interface"):
        found = (opened[group] if group else opened)["interface"]
        names, dofs, rotations = found["names"].asstr()[:], np.asarray(found["dofs"]) != 0, np.asarray(found["rotations"], float)
        if dofs.shape != (len(names), 6) or rotations.shape != (len(names), 3, 3):
            raise ValueError
        return list(zip(names, dofs, rotations))


def interface_motions(path, group=""):
    """Positions of the interfaces (k,3), body axes [m], and their displacements (k,3,n) per coordinate, with zeros for directions that are no
    coordinates. @raises InputError"""
    interfaces = interfaces_of(path, group)
    with _open(path, group) as opened, reading(path, "interface/positions"):
        file = opened[group] if group else opened
        positions, count = _matrix(file["interface/positions"], 3), len(file["reduced/stiffness"])
        if len(positions) != len(interfaces) or sum(int(kept.sum()) for _, kept, _ in interfaces) > count:
            raise ValueError
    displacements, first = np.zeros((len(positions), 3, count)), 0
    for displacement, (_, kept, axes) in zip(displacements, interfaces):
        translations = np.flatnonzero(kept[:3])
        displacement[:, first:first + len(translations)] = axes[:, translations]
        first += int(kept.sum())
    return positions, displacements


def mass_centre(path, group=""):
    """Returns the centre of mass (3) in body axes [m]. @raises InputError"""
    with _open(path, group) as opened, reading(path, "mass_properties"):
        centre = np.asarray((opened[group] if group else opened)["mass_properties/centre"], float)
        if centre.shape != (3,) or not np.all(np.abs(centre) < LARGEST):
            raise ValueError
        return centre


def decoded(name):
    """Returns the name of a load, point or group in the file, since HDF5 reserves some letters."""
    return name.replace("%2F", "/").replace("%2E", ".").replace("%25", "%")


def _open(path, group):
    if not group:
        return open_hdf5(path, "bielle superelement", "a superelement of bielle-reduce")
    file = open_hdf5(path, "bielle cut body", "the pieces of a body")
    with reading(path, group):
        found = group in file
    if not found:
        file.close()
        raise InputError(f"'{path}' has no piece '{group}', which the results name: was it reduced again with other cuts?")
    return file


def _matrix(dataset, columns=None):
    """@raises ValueError if a dataset is no matrix of finite numbers, or of another width"""
    values = np.asarray(dataset)
    if values.ndim != 2 or columns not in (None, values.shape[1]) or not np.all(np.abs(values) < LARGEST):
        raise ValueError
    return values


def _check_numbers(numbers, points):
    """@raises ValueError for numbers of nodes that the mesh does not have"""
    if numbers.size and not 0 <= numbers.min() <= numbers.max() < points:
        raise ValueError


def _node_numbers(recovery, name, count, points):
    if name in recovery:
        numbers = np.asarray(recovery[name], np.int64)
        _check_numbers(numbers, points)
        if numbers.shape != (count,):
            raise ValueError
        return numbers
    if count != points:
        raise InputError(f"the recovery has {counted(f'{count:g}', 'node')}, the mesh {points}, and '{name}' is missing")
    return np.arange(points)


def superelement_of(results, element, given):
    """Returns the superelement of an element of the results, or one piece of a body. given: as in find_superelement."""
    body = SuperelementBody(find_superelement(results, element, given), results.text(f"elements/{element}", "group"))
    check_coordinates(results, element, body.path, body.displacement.shape[1])
    return body


def check_coordinates(results, element, path, needed):
    """@raises InputError if the results of an element do not have as many coordinates as its superelement"""
    place = f"elements/{element}/coordinates"
    recorded = results.shape(place)[-1:] if results.has(place) else ()
    if recorded != (needed,):
        raise InputError(f"'{path}' is not the superelement of '{element}': it has {counted(needed, 'coordinate')}, "
                         f"'{place}' of the results {recorded[0] if recorded else 'none'}. Was it reduced again after the run?")


def find_superelement(results, element, given):
    """Returns the path of the superelement file of an element of the results.

    given: {element: path} from the command line, where an element stands for all its pieces. Otherwise the attribute `file` of
    the element; a file of that name next to the results or in the current folder serves as well, so that results and
    superelements can be moved together.
    """
    for name in (element, results.entry_of(element)):
        if name in given:
            return given[name]
    written = results.text(f"elements/{element}", "file")
    name = os.path.basename(written)
    for path in (written, os.path.join(os.path.dirname(results.path), name), name):
        if name and os.path.isfile(path):
            return path
    raise InputError(f"the superelement file of '{element}' ({written or 'not named in the results'}) was not found; "
                     f"say where it is: --superelement {results.entry_of(element)}=PATH")
