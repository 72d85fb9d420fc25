"""Cells between the nodes of matrices, by which a body is drawn: those of the deck or results file that gives the nodes.

They are no part of the model: a cell is left out if one of its nodes has no unknowns.
"""

import numpy as np

from ..decks.nastran_mesh import SHAPES
from ..mesh.cells import CELLS, permutation, type_of
from ..messages import InputError
from ..text_lines import lines_of

# CalculiX' results file: type of element -> meshio type. Its nodes stand in the order that Nastran has as well.
FRD_TYPES = {1: "hexahedron", 2: "wedge", 3: "tetra", 4: "hexahedron20", 5: "wedge15", 6: "tetra10", 7: "triangle", 8: "triangle6", 9: "quad",
             10: "quad8"}


def cells_between(blocks, numbers):
    """Cells by gmsh's type, as rows of nodes in gmsh's order. @param blocks: (meshio type, (n,k) numbers of nodes in VTK's order)
    @param numbers: (N) of the nodes"""
    order = np.argsort(numbers)
    found = {}
    for kind, labels in blocks:
        labels = np.asarray(labels, np.int64).reshape(-1, CELLS[kind].nodes)
        if not len(numbers) or not len(labels):
            continue
        rows = order[np.minimum(np.searchsorted(numbers, labels, sorter=order), len(order) - 1)]
        whole = (np.asarray(numbers)[rows] == labels).all(axis=1)
        if whole.any():
            found.setdefault(CELLS[kind].gmsh, []).append(rows[whole][:, permutation(kind, "vtk", "gmsh")])
    return {kind: np.concatenate(parts) for kind, parts in found.items()}


def blocks_of_cards(cards):
    """Blocks of the elements of a Nastran deck. Those whose mid-side nodes are not all there have their corners alone; unreadable ones are
    left out."""
    rows = {}
    for card in cards:
        if card.name not in SHAPES:
            continue
        shape, least, most = SHAPES[card.name]
        try:
            nodes = [card.integer(k, 0) for k in range(3, 3 + most)]
        except InputError:
            continue
        nodes = nodes if all(nodes) else nodes[:least]
        if all(nodes):
            rows.setdefault(type_of(shape, len(nodes)), []).append(nodes)
    return [(kind, np.array(block, np.int64)[:, permutation(kind, "nastran", "vtk")]) for kind, block in rows.items()]


def blocks_of_results(path):
    """Blocks of the elements of CalculiX' results file (.frd), whose numbers have ten characters."""
    rows, kind, nodes, inside = {}, None, [], False
    for text in lines_of(path):
        if text[:6] == "    3C":
            inside = True
        elif inside and text[:3] == " -3":
            break
        elif inside and text[:3] == " -1":
            kind, nodes = FRD_TYPES.get(_number(text[13:18])), []
        elif inside and text[:3] == " -2" and kind:
            nodes += [_number(text[k:k + 10]) for k in range(3, len(text.rstrip()), 10)]
            if len(nodes) == CELLS[kind].nodes:
                rows.setdefault(kind, []).append(nodes)
    return [(kind, np.array(block, np.int64)[:, permutation(kind, "nastran", "vtk")]) for kind, block in rows.items()]


def _number(text):
    return int(text) if text.strip().isdigit() else 0
