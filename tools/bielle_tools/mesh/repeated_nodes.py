"""Cells with repeated nodes: a hexahedron of which edges have shrunk to points is a wedge, a pyramid or a tetrahedron.

The faces of a cell, each without its repeated corners, bound the body that remains. It is one of the table if it has the
numbers of triangles and quadrilaterals of one, if each of its edges belongs to two faces, in opposite directions, and if
each of its corners belongs to three faces at least. (There are two polyhedra of five faces, and one of four.)
"""

from collections import Counter
from itertools import pairwise

import numpy as np

from ..messages import InputError
from .cells import CELLS, SIDES, type_of

# Corners, triangles and quadrilaterals of the remaining body.
SHAPES = {(4, 4, 0): "tetra", (5, 4, 1): "pyramid", (6, 2, 3): "wedge"}


def has_repeated(cells):
    """(n) whether a cell names a node twice."""
    ordered = np.sort(cells, axis=1)
    return (ordered[:, 1:] == ordered[:, :-1]).any(axis=1)


def without_repeated(kind, nodes):
    """The type and nodes, in VTK's order, that a cell with repeated nodes stands for; None if it stands for none."""
    cell, nodes = CELLS[kind], [int(node) for node in nodes]
    middles = _middles(cell, nodes)
    if middles is None:
        return None
    if cell.dimension == 2:
        corners = _cycle(nodes[:cell.corners])
        return _completed("triangle", corners, middles) if cell.shape == "quad" and len(set(corners)) == len(corners) == 3 else None
    faces = [_cycle([nodes[k] for k in side]) for side in SIDES[cell.shape]]
    faces = [face for face in faces if len(face) > 2]
    if any(len(set(face)) < len(face) for face in faces) or not _closed(faces):
        return None
    corners = Counter(node for face in faces for node in face)
    counts = Counter(len(face) for face in faces)
    shape = SHAPES.get((len(corners), counts[3], counts[4]))
    if shape is None or min(corners.values()) < 3 or set(corners) != set(nodes[:cell.corners]):
        return None
    return _completed(shape, _ordered(shape, faces), middles)


def _middles(cell, nodes):
    """{pair of corner nodes: node in the middle of their edge}; None if they contradict each other."""
    found = {}
    if cell.order == 1:
        return found
    if cell.nodes > cell.corners + len(cell.edges):
        return None
    for k, (a, b) in enumerate(cell.edges):
        a, b, middle = nodes[a], nodes[b], nodes[cell.corners + k]
        if a == b:
            if middle != a:
                return None
        elif middle in (a, b) or found.setdefault(frozenset((a, b)), middle) != middle:
            return None
    corners = set(nodes[:cell.corners])
    return found if len(set(found.values()) - corners) == len(found) else None


def _cycle(corners):
    """Corners of a face without those that are the same as the one before."""
    return [node for node, before in zip(corners, corners[-1:] + corners[:-1]) if node != before]


def _closed(faces):
    directed = Counter(edge for face in faces for edge in pairwise((*face, face[0])))
    return all(count == 1 and directed.get((b, a)) == 1 for (a, b), count in directed.items())


def _ordered(shape, faces):
    """Corners in the order of the shape, whose first face, outward, is 0 2 1 or 0 3 2 1."""
    base = next(face for face in faces if len(face) == (4 if shape == "pyramid" else 3))
    corners = [base[0], *reversed(base[1:])]
    others = [node for face in faces for node in face if node not in base]
    if shape != "wedge":
        return corners + others[:1]
    edges = [edge for face in faces for edge in pairwise((*face, face[0]))]
    return corners + [next(b for a, b in edges if a == corner and b in others) for corner in corners]


def _completed(shape, corners, middles):
    """The type and nodes with the mid-side nodes of order 2; None if one is missing."""
    if not middles:
        return shape, corners
    pairs = [frozenset(corners[k] for k in edge) for edge in CELLS[shape].edges]
    if any(pair not in middles for pair in pairs):
        return None
    return type_of(shape, len(corners) + len(pairs)), corners + [middles[pair] for pair in pairs]


def turn_repeated(blocks, refuse):
    """Replaces cells with repeated nodes.

    blocks: list of (type, (n,k)); refuse(block, row): the error for a cell that stands for none.
    @returns for each block its parts, a list of (type, rows of the block, nodes), and a Counter of (type before, type after)
    """
    parts, changes = [], Counter()
    for number, (kind, cells) in enumerate(blocks):
        if kind not in CELLS or CELLS[kind].shape == "triangle" or not len(cells) or not has_repeated(cells).any():
            parts.append([(kind, np.arange(len(cells)), cells)])
            continue
        repeated = has_repeated(cells)
        whole, turned = np.flatnonzero(~repeated), {}
        for row in np.flatnonzero(repeated).tolist():
            found = without_repeated(kind, cells[row])
            if found is None:
                raise refuse(number, row)
            changes[kind, found[0]] += 1
            turned.setdefault(found[0], []).append((row, found[1]))
        parts.append(([(kind, whole, cells[whole])] if len(whole) else [])
                     + [(new, np.array([row for row, _ in rows]), np.array([nodes for _, nodes in rows], np.int64))
                        for new, rows in turned.items()])
    return parts, changes


def refusal(kind, name, nodes):
    counts = Counter(int(node) for node in nodes)
    told = "" if CELLS[kind].shape != "tetra" else ": it has no volume"
    names = ", ".join(f"{counts[node]} times" for node in list(counts) if counts[node] > 1)
    shape = CELLS[kind].singular
    return InputError(f"{name}, a {shape} of {len(nodes)} nodes, repeats nodes ({names})" + (told or ", but not as a wedge, a pyramid or a "
                      "tetrahedron would"))
