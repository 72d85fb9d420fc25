"""A tetrahedral mesh with named groups, checked and put into gmsh's node order.

Readers deliver a RawMesh: any cells, in VTK's node order (as meshio, Abaqus and CalculiX have it), and named sets of
cells, of cell faces and of nodes. `solid_mesh` converts it to the mesh that the reduction reads: tetrahedra and
boundary triangles of positive orientation with gmsh's node order, every set as a surface or a volume group.

Second-order tetrahedra, mid-side nodes 4..9:   VTK, Abaqus: 01 12 02 03 13 23      gmsh: 01 12 02 03 23 13
"""

from dataclasses import dataclass, field

import numpy as np

from .messages import InputError, counted

TRIANGLES = {"triangle": 3, "triangle6": 6}
FARTHEST = 1e15  # in whatever unit: no body reaches there
TETRAHEDRA = {"tetra": 4, "tetra10": 10}
# Cells that have neither volume nor surface: axes, springs, point masses, corner points.
IGNORED = ("vertex", "line", "line3", "line4")

EDGES = np.array([[0, 1], [1, 2], [0, 2], [0, 3], [1, 3], [2, 3]])  # edges of VTK's mid-side nodes
VTK_TO_GMSH = {"triangle": range(3), "triangle6": range(6), "tetra": range(4), "tetra10": [0, 1, 2, 3, 4, 5, 6, 7, 9, 8]}
# Corners of the four faces, outward for a tetrahedron of positive volume, and the mid-side nodes that follow them.
FACES = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])
FACE_MIDS = np.array([[6, 5, 4], [4, 8, 7], [5, 9, 8], [7, 9, 6]])
# The other orientation of a cell: corners 1 and 2 change places, and with them the mid-side nodes.
MIRRORED = {"triangle": [0, 2, 1], "triangle6": [0, 2, 1, 5, 4, 3], "tetra": [0, 2, 1, 3],
            "tetra10": [0, 2, 1, 3, 6, 5, 4, 7, 9, 8]}


@dataclass
class RawMesh:
    """The result of a reader. Sets may overlap; names are those of the file.

    points (p,3); cells: list of (meshio type, (n,k) node numbers from 0);
    cell_sets: name -> one index array per entry of `cells`; point_sets: name -> node numbers;
    face_sets: name -> (f,3) corner nodes of faces; notes: sentences about omitted parts.
    """

    points: np.ndarray
    cells: list
    cell_sets: dict = field(default_factory=dict)
    point_sets: dict = field(default_factory=dict)
    face_sets: dict = field(default_factory=dict)
    notes: list = field(default_factory=list)


@dataclass
class SolidMesh:
    """Points (p,3), cells by meshio type in gmsh's node order, and groups {name: {type: cell numbers}} by dimension."""

    points: np.ndarray
    cells: dict
    surfaces: dict
    volumes: dict
    notes: list


def solid_mesh(raw):
    """Checks a RawMesh and completes it. @raises InputError if it is not a mesh of tetrahedra."""
    notes = list(raw.notes)
    cells, place = _merge_blocks(raw, notes)
    _check_numbers(raw.points, cells)
    for kind in cells:
        if kind == "tetra10":
            cells[kind] = _order_mid_nodes(raw.points, cells[kind], notes)
        if kind in TETRAHEDRA:
            cells[kind] = _orient(raw.points, kind, cells[kind], notes)

    faces = _FaceTable(cells)
    volumes, surfaces = {}, {}
    for name, parts in raw.cell_sets.items():
        members = _members(parts, place, cells)
        solid = {kind: index for kind, index in members.items() if kind in TETRAHEDRA}
        flat = {kind: index for kind, index in members.items() if kind in TRIANGLES}
        if solid:
            volumes[name] = solid
        if flat:
            _add_surface(surfaces, volumes, name, flat, notes)
    for name, corners in raw.face_sets.items():
        _add_surface(surfaces, volumes, name, faces.of_corners(corners, name), notes)
    for name, nodes in raw.point_sets.items():
        members = faces.of_nodes(nodes)
        if members:
            _add_surface(surfaces, volumes, name, members, notes)
        else:
            notes.append(f"node set '{name}' ({counted(len(nodes), 'node')}) covers no boundary face and is left out")
    cells = faces.all_cells()
    points, cells = _drop_unused(raw.points, cells, notes)
    cells = {kind: block[:, VTK_TO_GMSH[kind]] for kind, block in cells.items()}
    return SolidMesh(points, cells, surfaces, volumes, notes)


def tetrahedron_faces(cells):
    """Every face of every tetrahedron of cells {type: (n,k)} in VTK's order, outward: {triangle type: (4n, 3 or 6)}."""
    faces = {}
    if "tetra" in cells:
        faces["triangle"] = cells["tetra"][:, FACES].reshape(-1, 3)
    if "tetra10" in cells:
        block = cells["tetra10"]
        faces["triangle6"] = np.concatenate([block[:, FACES], block[:, FACE_MIDS]], axis=2).reshape(-1, 6)
    return faces


def boundary_faces(faces):
    """The faces of `tetrahedron_faces` that belong to one tetrahedron only."""
    corners = np.concatenate([np.sort(block[:, :3], axis=1) for block in faces.values()])
    _, inverse, count = np.unique(corners, axis=0, return_inverse=True, return_counts=True)
    once = np.split(count[inverse.ravel()] == 1, np.cumsum([len(block) for block in faces.values()])[:-1])
    return {kind: block[alone] for (kind, block), alone in zip(faces.items(), once)}


def signed_volumes(points, tetrahedra):
    """Six times the volumes of the straight tetrahedra of the corners, positive when right-handed."""
    a, b, c, d = (points[tetrahedra[:, k]] for k in range(4))
    return np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a)


def _merge_blocks(raw, notes):
    """Joins blocks of one type. Returns cells by type, and for each block (type or None, its first cell number)."""
    parts, place = {}, []
    for kind, block in raw.cells:
        if kind in IGNORED:
            place.append((None, 0))
        elif kind in TRIANGLES or kind in TETRAHEDRA:
            before = parts.setdefault(kind, [])
            place.append((kind, sum(len(b) for b in before)))
            before.append(np.asarray(block, dtype=np.int64))
        else:
            raise InputError(f"holds {counted(len(block), 'cell')} of type '{kind}', but Bielle reduces tetrahedra of 4 or 10 "
                             "nodes: remesh the body with tetrahedra")
    if not any(kind in TETRAHEDRA for kind in parts):
        what = ", ".join(sorted({kind for kind, _ in raw.cells})) or "no cells at all"
        raise InputError(f"holds no tetrahedra ({what}); Bielle reduces solids meshed with tetrahedra of 4 or 10 nodes")
    ignored = sum(len(block) for kind, block in raw.cells if kind in IGNORED)
    if ignored:
        notes.append(f"left out: {counted(ignored, 'cell')} of points or lines")
    return {kind: np.concatenate(blocks) for kind, blocks in parts.items()}, place


def _check_numbers(points, cells):
    sound = (np.abs(points) < FARTHEST).all(axis=1)
    if not sound.all():
        first = int(np.argmin(sound))
        raise InputError(f"point {first + 1} has a coordinate that is not finite, or larger than {FARTHEST:g}: "
                         f"({', '.join(f'{x:g}' for x in points[first])})")
    for kind, block in cells.items():
        if block.min() < 0 or block.max() >= len(points):
            raise InputError(f"a cell of type '{kind}' names a node that does not exist")


def _order_mid_nodes(points, cells, notes):
    """VTK's order of the mid-side nodes, verified: each must lie nearer to the middle of its own edge than to others'."""
    middles = points[cells[:, EDGES]].mean(axis=2)  # (n,6,3)

    def misplaced(order):
        wrong = np.zeros(len(cells), bool)
        for edge, column in enumerate(order):
            distance = np.linalg.norm(points[cells[:, column]][:, None, :] - middles, axis=2)
            wrong |= distance.argmin(axis=1) != edge
        return wrong

    wrong = misplaced([4, 5, 6, 7, 8, 9])
    if wrong.mean() > 0.5 and not misplaced([4, 5, 6, 7, 9, 8]).any():
        notes.append("the last two mid-side nodes of the tetrahedra stand in gmsh's order, not the format's; read so")
        return cells[:, [0, 1, 2, 3, 4, 5, 6, 7, 9, 8]]
    if wrong.mean() > 0.01:
        first = int(np.argmax(wrong))
        raise InputError(f"mid-side nodes of {int(wrong.sum())} of {len(cells)} tetrahedra do not lie on their edges "
                         f"(the first is cell {first + 1} of its type, near {_place(points[cells[first, 0]])}): "
                         "the node order is not that of the format")
    if wrong.any():
        notes.append(f"mid-side nodes of {int(wrong.sum())} tetrahedra lie nearer to another edge than to their own")
    return cells


def _orient(points, kind, cells, notes):
    volumes = signed_volumes(points, cells)
    scale = np.ptp(points[np.unique(cells)], axis=0).max() ** 3
    flat = np.abs(volumes) <= 1e-15 * scale
    if flat.any():
        first = int(np.argmax(flat))
        raise InputError(f"holds {counted(int(flat.sum()), 'tetrahedron', 'tetrahedra')} of no volume "
                             f"(the first near {_place(points[cells[first, 0]])})")
    negative = volumes < 0
    if negative.any():
        cells = cells.copy()
        cells[negative] = cells[negative][:, MIRRORED[kind]]
        notes.append(f"{int(negative.sum())} of {len(cells)} tetrahedra were left-handed and have been turned over")
    return cells


def _place(point):
    return "(" + ", ".join(f"{x:g}" for x in point) + ")"


def _members(parts, place, cells):
    """Cell numbers by type of a set given as one index array per block of the file."""
    found = {}
    for (kind, first), index in zip(place, parts):
        index = np.asarray(index, dtype=np.int64)
        if kind is None or not len(index):
            continue
        found.setdefault(kind, []).append(index + first)
    members = {kind: np.unique(np.concatenate(index)) for kind, index in found.items()}
    for kind, index in members.items():
        if index[0] < 0 or index[-1] >= len(cells[kind]):
            raise InputError(f"a set names a cell of type '{kind}' that does not exist")
    return members


def _add_surface(surfaces, volumes, name, members, notes):
    """Adds a surface group; if its name is taken by another group, with `_surface` or a number appended."""
    if name in surfaces and _same(surfaces[name], members):
        return
    free, count = name, 1
    while free in surfaces or free in volumes:
        free = f"{name}_surface" if count == 1 else f"{name}_surface{count}"
        count += 1
    if free != name:
        notes.append(f"the name '{name}' belongs to another group too; the surface is called '{free}'")
    surfaces[free] = members


def _same(one, other):
    return one.keys() == other.keys() and all(np.array_equal(one[kind], other[kind]) for kind in one)


def _drop_unused(points, cells, notes):
    used = np.unique(np.concatenate([block.ravel() for block in cells.values()]))
    if len(used) < len(points):
        notes.append(f"left out: {counted(len(points) - len(used), 'point')} of no tetrahedron or triangle")
    number = np.full(len(points), -1, dtype=np.int64)
    number[used] = np.arange(len(used))
    return points[used], {kind: number[block] for kind, block in cells.items()}


class _FaceTable:
    """Triangles of the mesh, each once: those of the file, and those of tetrahedra that sets contain."""

    def __init__(self, cells):
        self.cells = {kind: block for kind, block in cells.items()}
        self.extra = {kind: [] for kind in TRIANGLES}
        self.number = {}  # sorted corners -> (type, cell number)
        for kind in TRIANGLES:
            for index, corners in enumerate(np.sort(cells[kind][:, :3], axis=1).tolist() if kind in cells else ()):
                self.number.setdefault(tuple(corners), (kind, index))
        self.sides = tetrahedron_faces(cells)
        self.boundary = boundary_faces(self.sides)
        self.lookup = None

    def of_nodes(self, nodes):
        """Boundary triangles whose nodes are all in the set (their corners, if the set contains no mid-side node)."""
        wanted = set(np.asarray(nodes).tolist())
        found = {}
        for flat, faces in self.boundary.items():
            width = TRIANGLES[flat]
            if flat == "triangle6" and not wanted.intersection(np.unique(faces[:, 3:]).tolist()):
                width = 3
            inside = np.isin(faces[:, :width], np.fromiter(wanted, np.int64, len(wanted))).all(axis=1)
            self._collect(found, flat, faces[inside])
        return self._finish(found)

    def of_corners(self, corners, name):
        """Triangles with the given corner nodes (f,3), which must be faces of tetrahedra."""
        if self.lookup is None:
            self.lookup = {}
            for flat, faces in self.sides.items():
                for index, key in enumerate(np.sort(faces[:, :3], axis=1).tolist()):
                    self.lookup.setdefault(tuple(key), (flat, index))
        found = {}
        for key in np.sort(corners, axis=1).tolist():
            if tuple(key) in self.number:
                kind, index = self.number[tuple(key)]
                found.setdefault(kind, []).append(index)
                continue
            if tuple(key) not in self.lookup:
                raise InputError(f"surface '{name}' holds a face that belongs to no tetrahedron")
            flat, index = self.lookup[tuple(key)]
            self._collect(found, flat, self.sides[flat][index:index + 1])
        return self._finish(found)

    def all_cells(self):
        cells = dict(self.cells)
        for kind, faces in self.extra.items():
            if faces:
                new = np.array(faces, dtype=np.int64)
                cells[kind] = np.concatenate([cells[kind], new]) if kind in cells else new
        return cells

    def _collect(self, found, flat, faces):
        start = len(self.cells[flat]) if flat in self.cells else 0
        for key, face in zip(np.sort(faces[:, :3], axis=1).tolist(), faces.tolist()):
            if tuple(key) not in self.number:
                self.number[tuple(key)] = (flat, start + len(self.extra[flat]))
                self.extra[flat].append(face)
            kind, index = self.number[tuple(key)]
            found.setdefault(kind, []).append(index)

    @staticmethod
    def _finish(found):
        return {kind: np.unique(index) for kind, index in found.items()}
