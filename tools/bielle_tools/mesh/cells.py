"""All types of cells: their nodes, edges and faces, and the orders in which programs write their nodes.

Cells have meshio's names and, inside the tools, its node order, which is VTK's. The corners stand in the same order in
all programs; a node after them is the middle of an edge, of a face or of the cell. An order is therefore a list of
edges (pairs of corners) and of faces, and the permutation from one order to another follows from two such lists.

References: VTK, vtkCell.h and the classes of quadratic cells; Gmsh reference manual, "Node ordering"; MSC Nastran Quick
Reference Guide, CHEXA, CPENTA, CPYRAM, CTETRA; Abaqus Elements Guide, "Three-dimensional solid element library";
CalculiX manual, "Element types". The edges and faces of gmsh are those of reduce/mesh/cell_type.cpp.
"""

from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise

import numpy as np

_TRIANGLE, _QUADRILATERAL = ((0, 1), (1, 2), (2, 0)), ((0, 1), (1, 2), (2, 3), (3, 0))
_BOTTOM, _TOP, _UP = ((0, 1), (1, 2), (2, 3), (3, 0)), ((4, 5), (5, 6), (6, 7), (7, 4)), ((0, 4), (1, 5), (2, 6), (3, 7))
_BELOW, _ABOVE, _BETWEEN = ((0, 1), (1, 2), (2, 0)), ((3, 4), (4, 5), (5, 3)), ((0, 3), (1, 4), (2, 5))
_TETRAHEDRON = ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))
_PYRAMID = _BOTTOM + ((0, 4), (1, 4), (2, 4), (3, 4))
# Edges of each shape in the order of the mid-side nodes. Orders that are not named are those of VTK.
_EDGES = {
    "triangle": {"vtk": _TRIANGLE},
    "quad": {"vtk": _QUADRILATERAL},
    "tetra": {"vtk": _TETRAHEDRON, "gmsh": ((0, 1), (1, 2), (2, 0), (3, 0), (2, 3), (3, 1))},
    "hexahedron": {"vtk": _BOTTOM + _TOP + _UP, "nastran": _BOTTOM + _UP + _TOP,
                   "gmsh": ((0, 1), (0, 3), (0, 4), (1, 2), (1, 5), (2, 3), (2, 6), (3, 7), (4, 5), (4, 7), (5, 6), (6, 7))},
    "wedge": {"vtk": _BELOW + _ABOVE + _BETWEEN, "nastran": _BELOW + _BETWEEN + _ABOVE,
              "gmsh": ((0, 1), (0, 2), (0, 3), (1, 2), (1, 4), (2, 5), (3, 4), (3, 5), (4, 5))},
    "pyramid": {"vtk": _PYRAMID, "gmsh": ((0, 1), (0, 3), (0, 4), (1, 2), (1, 4), (2, 3), (2, 4), (3, 4))},
}
# Corners of the faces, outward, in the order of Abaqus' S1, S2, ..; CalculiX has the same.
SIDES = {
    "triangle": (), "quad": (),
    "tetra": ((0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)),
    "hexahedron": ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (0, 4, 7, 3)),
    "wedge": ((0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (0, 3, 5, 2)),
    "pyramid": ((0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (0, 4, 3)),
}
_CELL = ((0, 1, 2, 3, 4, 5, 6, 7),)
# The nodes of a hexahedron of 27 after its edges: faces and cell, as corners.
_INSIDE = {
    "vtk": ((0, 3, 4, 7), (1, 2, 5, 6), (0, 1, 4, 5), (2, 3, 6, 7), (0, 1, 2, 3), (4, 5, 6, 7)) + _CELL,
    "gmsh": ((0, 1, 2, 3), (0, 1, 4, 5), (0, 3, 4, 7), (1, 2, 5, 6), (2, 3, 6, 7), (4, 5, 6, 7)) + _CELL,
    "abaqus": _CELL + SIDES["hexahedron"],
}
# Corners of the reference cells: simplices with the corners 0 and the unit vectors; quadrilaterals and hexahedra
# [-1, 1]^d; wedges, a triangle times [-1, 1]; pyramids over [-1, 1]^2 with the apex (0, 0, 1).
_SQUARE = ((-1, -1), (1, -1), (1, 1), (-1, 1))
_REFERENCE = {
    "triangle": ((0, 0), (1, 0), (0, 1)), "quad": _SQUARE,
    "tetra": ((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)),
    "hexahedron": tuple((*x, z) for z in (-1, 1) for x in _SQUARE),
    "wedge": tuple((*x, z) for z in (-1, 1) for x in ((0, 0), (1, 0), (0, 1))),
    "pyramid": tuple((*x, 0) for x in _SQUARE) + ((0, 0, 1),),
}
# The other orientation of a shape: corners that change places.
_SWAPPED = {"triangle": ((1, 2),), "quad": ((1, 3),), "tetra": ((1, 2),), "hexahedron": ((1, 3), (5, 7)), "wedge": ((1, 2), (4, 5)),
            "pyramid": ((1, 3),)}
_PLURAL = {"triangle": "triangles", "quad": "quadrilaterals", "tetra": "tetrahedra", "hexahedron": "hexahedra", "wedge": "wedges",
           "pyramid": "pyramids"}
_SINGULAR = {"triangle": "triangle", "quad": "quadrilateral", "tetra": "tetrahedron", "hexahedron": "hexahedron", "wedge": "wedge",
             "pyramid": "pyramid"}


@dataclass(frozen=True)
class Cell:
    """One type. `faces`: (meshio type, its nodes among those of the cell, corners first, running round outward)."""

    name: str         # meshio's
    shape: str        # name of the type of order 1
    gmsh: int         # gmsh's number
    nodes: int
    corners: int
    dimension: int
    order: int        # 1: nodes at the corners only
    edges: tuple      # pairs of corners, in VTK's order
    middles: tuple    # corners whose middle is node `corners` + k, in VTK's order
    faces: tuple
    reference: np.ndarray  # (nodes, dimension) places of the nodes in the reference cell
    mirrored: tuple   # columns of the cell with the other orientation

    @property
    def plural(self):
        return _PLURAL[self.shape]

    @property
    def singular(self):
        return _SINGULAR[self.shape]


def _middles(shape, nodes, program):
    """Corners whose middle each node after the corners is."""
    corners = len(_REFERENCE[shape])
    if nodes == corners:
        return ()
    edges = _EDGES[shape].get(program, _EDGES[shape]["vtk"])
    if nodes == corners + len(edges):
        return edges
    return edges + (((0, 1, 2, 3),) if shape == "quad" else _INSIDE.get(program, _INSIDE["vtk"]))


def _make(name, shape, gmsh, nodes):
    middles, corners = _middles(shape, nodes, "vtk"), len(_REFERENCE[shape])
    place = {frozenset(each): corners + k for k, each in enumerate(middles)}
    reference = np.array(_REFERENCE[shape], float)
    reference = np.concatenate([reference, *(reference[list(each)].mean(axis=0)[None] for each in middles)])
    swap = {a: b for pair in _SWAPPED[shape] for a, b in (pair, pair[::-1])}
    mirrored = [swap.get(a, a) for a in range(corners)] + [place[frozenset(swap.get(a, a) for a in each)] for each in middles]
    faces = []
    for side in SIDES[shape]:
        on_face = list(side)
        if middles:
            on_face += [place[frozenset(pair)] for pair in pairwise((*side, side[0]))]
            on_face += [place[frozenset(side)]] if frozenset(side) in place else []
        faces.append(({3: "triangle", 6: "triangle6", 4: "quad", 8: "quad8", 9: "quad9"}[len(on_face)], tuple(on_face)))
    return Cell(name, shape, gmsh, nodes, corners, reference.shape[1], 2 if middles else 1, _EDGES[shape]["vtk"], middles, tuple(faces),
                reference, tuple(mirrored))


CELLS = {name: _make(name, shape, gmsh, nodes) for name, shape, gmsh, nodes in (
    ("triangle", "triangle", 2, 3), ("triangle6", "triangle", 9, 6),
    ("quad", "quad", 3, 4), ("quad8", "quad", 16, 8), ("quad9", "quad", 10, 9),
    ("tetra", "tetra", 4, 4), ("tetra10", "tetra", 11, 10),
    ("hexahedron", "hexahedron", 5, 8), ("hexahedron20", "hexahedron", 17, 20), ("hexahedron27", "hexahedron", 12, 27),
    ("wedge", "wedge", 6, 6), ("wedge15", "wedge", 18, 15),
    ("pyramid", "pyramid", 7, 5), ("pyramid13", "pyramid", 19, 13))}
SOLIDS = tuple(name for name, cell in CELLS.items() if cell.dimension == 3)
FLATS = tuple(name for name, cell in CELLS.items() if cell.dimension == 2)
BY_GMSH = {cell.gmsh: cell for cell in CELLS.values()}


@lru_cache(maxsize=None)
def permutation(kind, source, target):
    """Columns of a cell written by the program `source` in the order of `target`: "vtk" (also meshio, CalculiX), "gmsh",
    "nastran" or "abaqus"."""
    cell = CELLS[kind]
    place = {frozenset(each): cell.corners + k for k, each in enumerate(_middles(cell.shape, cell.nodes, source))}
    return list(range(cell.corners)) + [place[frozenset(each)] for each in _middles(cell.shape, cell.nodes, target)]


def type_of(shape, nodes):
    """The name of the type of a shape with so many nodes, or None."""
    return next((name for name, cell in CELLS.items() if cell.shape == shape and cell.nodes == nodes), None)


def solid_faces(cells):
    """Every face of every solid cell of {type: (n,k)}, outward: {surface type: (m,k)}."""
    found = {}
    for kind, block in cells.items():
        by_type = {}
        for flat, nodes in CELLS[kind].faces:
            by_type.setdefault(flat, []).append(nodes)
        for flat, sides in by_type.items():
            found.setdefault(flat, []).append(block[:, np.array(sides)].reshape(-1, CELLS[flat].nodes))
    return {flat: np.concatenate(found[flat]) for flat in FLATS if flat in found}


def face_keys(flat, faces):
    """(n,4) sorted corners of surface cells, by which faces of any order are compared; those of a triangle begin with -1."""
    corners = np.sort(faces[:, :CELLS[flat].corners], axis=1)
    return corners if corners.shape[1] == 4 else np.column_stack([np.full(len(corners), -1, corners.dtype), corners])


def boundary_faces(faces):
    """The faces of `solid_faces` that belong to one cell only, of the types that occur."""
    keys = np.concatenate([face_keys(flat, block) for flat, block in faces.items()])
    _, inverse, count = np.unique(keys, axis=0, return_inverse=True, return_counts=True)
    once = np.split(count[inverse.ravel()] == 1, np.cumsum([len(block) for block in faces.values()])[:-1])
    return {kind: block[alone] for (kind, block), alone in zip(faces.items(), once) if alone.any()}


def triangles_of(faces):
    """(n,3) triangles of the corners of surface cells {type: (m,k)}; two for a quadrilateral."""
    parts = [faces[flat][:, list(three)] for flat in faces for three in ((0, 1, 2), (0, 2, 3))[:CELLS[flat].corners - 2]]
    return np.concatenate(parts)


def six_volumes(points, kind, cells):
    """Six times the volumes of the straight cells of the corners, positive when right-handed. A face of four corners is
    bilinear: its part is the mean of its two divisions into triangles."""
    total, origin = np.zeros(len(cells)), points[cells[:, 0]]
    for side in SIDES[CELLS[kind].shape]:
        x = [points[cells[:, k]] - origin for k in side]
        for three, share in (((0, 1, 2), 1),) if len(side) == 3 else (((0, 1, 2), .5), ((0, 2, 3), .5), ((0, 1, 3), .5), ((1, 2, 3), .5)):
            a, b, c = (x[k] for k in three)
            total += share * np.einsum("ij,ij->i", np.cross(a, b), c)
    return total


@lru_cache(maxsize=None)
def _corner_edges(shape):
    """(corner, its three neighbours, right-handed) for all corners of three edges."""
    reference, found = np.array(_REFERENCE[shape], float), []
    for corner in range(len(reference)):
        ends = [b if a == corner else a for a, b in _EDGES[shape]["vtk"] if corner in (a, b)]
        if len(ends) == 3:
            right = np.linalg.det(reference[ends] - reference[corner]) > 0
            found.append((corner, ends if right else [ends[1], ends[0], ends[2]]))
    return found


def has_turned_corner(points, kind, cells):
    """(n) whether the edges of a cell are left-handed at a corner, though the cell may have a positive volume."""
    turned = np.zeros(len(cells), bool)
    for corner, ends in _corner_edges(CELLS[kind].shape):
        a, b, c = (points[cells[:, end]] - points[cells[:, corner]] for end in ends)
        turned |= np.einsum("ij,ij->i", np.cross(a, b), c) <= 0
    return turned
