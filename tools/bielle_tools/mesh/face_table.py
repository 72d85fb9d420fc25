"""Surface cells of a mesh of solid cells: those of its file, and the faces that its sets name."""

import numpy as np

from ..messages import InputError, counted, place
from .cells import CELLS, FLATS, SOLIDS, boundary_faces, face_keys, solid_faces


class FaceTable:
    """Surface cells of the mesh, each once: those of the file, and those faces of solid cells that sets contain."""

    def __init__(self, points, cells, notes):
        self.cells = dict(cells)
        self.sides = solid_faces({kind: block for kind, block in cells.items() if kind in SOLIDS})
        self.boundary = boundary_faces(self.sides)
        self.lookup = None
        self.moved = {}   # type in the file -> (types, numbers) of its cells in the table
        self._complete(points, notes)
        self.extra = {kind: [] for kind in FLATS}
        self.number = {}  # sorted corners -> (type, cell number)
        for kind in FLATS:
            for index, corners in enumerate(face_keys(kind, self.cells[kind]).tolist() if kind in self.cells else ()):
                self.number.setdefault(tuple(corners), (kind, index))

    def _complete(self, points, notes):
        """Gives the surface cells of the file the type and the mid-side nodes of the faces of solid cells that they are."""
        given = {kind: self.cells.pop(kind) for kind in FLATS if kind in self.cells}
        blocks, changed, alone = {}, 0, []
        for kind, block in given.items():
            kinds, rows = np.full(len(block), kind, object), block.tolist()
            mixed = any(other != kind and CELLS[other].shape == CELLS[kind].shape for other in self.sides)
            keys = face_keys(kind, block)
            if mixed:
                self._make_lookup()
                for row, key in enumerate(map(tuple, keys.tolist())):
                    flat, index = self.lookup.get(key, (kind, None))
                    if flat != kind:
                        kinds[row], changed = flat, changed + 1
                        face = self.sides[flat][index].tolist()
                        rows[row] = face if face[:2] in _runs(block[row, :CELLS[kind].corners].tolist()) else _mirrored(flat, face)
            alone += [block[row, :CELLS[kind].corners] for row in np.flatnonzero(~self._is_face(keys))]
            numbers = np.zeros(len(block), np.int64)
            for flat in sorted(set(kinds), key=FLATS.index):
                which = np.flatnonzero(kinds == flat)
                before = blocks.setdefault(flat, [])
                numbers[which] = sum(len(each) for each in before) + np.arange(len(which))
                before.append(np.array([rows[row] for row in which.tolist()], np.int64).reshape(-1, CELLS[flat].nodes))
            self.moved[kind] = kinds, numbers
        self.cells.update({kind: np.concatenate(parts) for kind, parts in blocks.items()})
        if changed:
            notes.append(f"{counted(changed, 'surface cell')} {'has' if changed == 1 else 'have'} other mid-side nodes than the face of "
                         "a solid cell "
                         "at the same place, and got those of the face")
        if alone:
            notes.append(f"{counted(len(alone), 'surface cell')} {'is' if len(alone) == 1 else 'are'} no face of a solid cell (the "
                         "first near "
                         f"{place(points[alone[0]].mean(axis=0))})")

    def _is_face(self, keys):
        """(n) whether a surface cell is a face of a solid cell, by its corners."""
        sides = np.concatenate([face_keys(flat, block) for flat, block in self.sides.items()])
        _, inverse = np.unique(np.concatenate([sides, keys]), axis=0, return_inverse=True)
        return np.isin(inverse.ravel()[len(sides):], inverse.ravel()[:len(sides)])

    def renamed(self, members):
        """The surface cells of a set, by type and number in the file, in the table."""
        found = {}
        for kind, index in members.items():
            kinds, numbers = self.moved[kind]
            for flat in set(kinds[index]):
                found.setdefault(flat, []).append(numbers[index[kinds[index] == flat]])
        return {flat: np.unique(np.concatenate(parts)) for flat, parts in found.items()}

    def of_nodes(self, nodes):
        """Boundary faces whose nodes are all in the set (their corners, if the set contains no mid-side node). A node in the
        middle of a face need not be in it."""
        wanted = set(np.asarray(nodes).tolist())
        found = {}
        for flat, faces in self.boundary.items():
            corners = CELLS[flat].corners
            width = corners + len(CELLS[flat].edges) * (CELLS[flat].order == 2)
            if width > corners and not wanted.intersection(np.unique(faces[:, corners:width]).tolist()):
                width = corners
            inside = np.isin(faces[:, :width], np.fromiter(wanted, np.int64, len(wanted))).all(axis=1)
            self._collect(found, flat, faces[inside])
        return self._finish(found)

    def of_corners(self, faces, name):
        """Surface cells with the given corner nodes, which must be faces of solid cells. Corners that are repeated, as those
        of a hexahedron that is a wedge, count once; a face with less than three has no area."""
        self._make_lookup()
        found = {}
        for corners in faces:
            corners = sorted(set(map(int, corners)))
            if len(corners) < 3:
                continue
            key = (-1, *corners) if len(corners) == 3 else tuple(corners)
            if key in self.number:
                kind, index = self.number[key]
                found.setdefault(kind, []).append(index)
                continue
            if key not in self.lookup:
                raise InputError(f"surface '{name}' holds a face that belongs to no solid cell")
            flat, index = self.lookup[key]
            self._collect(found, flat, self.sides[flat][index:index + 1])
        return self._finish(found)

    def all_cells(self):
        cells = dict(self.cells)
        for kind, faces in self.extra.items():
            if faces:
                new = np.array(faces, dtype=np.int64)
                cells[kind] = np.concatenate([cells[kind], new]) if kind in cells else new
        return cells

    def _make_lookup(self):
        if self.lookup is None:
            self.lookup = {}
            for flat, faces in self.sides.items():
                for index, key in enumerate(face_keys(flat, faces).tolist()):
                    self.lookup.setdefault(tuple(key), (flat, index))

    def _collect(self, found, flat, faces):
        start = len(self.cells[flat]) if flat in self.cells else 0
        for key, face in zip(face_keys(flat, faces).tolist(), faces.tolist()):
            if tuple(key) not in self.number:
                self.number[tuple(key)] = (flat, start + len(self.extra[flat]))
                self.extra[flat].append(face)
            kind, index = self.number[tuple(key)]
            found.setdefault(kind, []).append(index)

    @staticmethod
    def _finish(found):
        return {kind: np.unique(index) for kind, index in found.items()}


def _runs(corners):
    """Pairs of successive corners."""
    return [[a, b] for a, b in zip(corners, corners[1:] + corners[:1])]


def _mirrored(kind, nodes):
    return [nodes[k] for k in CELLS[kind].mirrored]
