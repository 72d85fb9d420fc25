"""The mesh of a Nastran file: grid points in their coordinate systems, solid cells and skins, properties as sets."""

import numpy as np

from ..mesh.cells import permutation, type_of
from ..mesh.solid_mesh import RawMesh
from ..messages import InputError
from .missing_nodes import NONE, complete_edges
from .nastran_grids import Grids, card_number

# Card: shape, nodes of order 1 and 2. Nodes follow from field 3 on, in the order "nastran" of cells.py.
SHAPES = {
    "CTETRA": ("tetra", 4, 10), "CHEXA": ("hexahedron", 8, 20), "CPENTA": ("wedge", 6, 15), "CPYRAM": ("pyramid", 5, 13),
    "CPYRA": ("pyramid", 5, 13), "CTRIA3": ("triangle", 3, 3), "CTRIAR": ("triangle", 3, 3), "CTRIA6": ("triangle", 3, 6),
    "CQUAD4": ("quad", 4, 4), "CQUADR": ("quad", 4, 4), "CQUAD8": ("quad", 4, 8),
}
SOLID_SHAPES = ("tetra", "hexahedron", "wedge", "pyramid")


def read_mesh(cards):
    """@returns RawMesh, and Grids. @raises InputError with file and line."""
    grids = Grids(cards)
    points, rows = grids.points, grids.rows
    blocks = {}  # (type, property) -> cards, rows of nodes
    known = {}   # element number -> card
    for card in cards:
        if card.name in SHAPES:
            first = known.setdefault(card_number(card), card)
            if first is not card:
                raise InputError(f"'{card.path}': line {card.line}: there is a second element {card.integer(1)} (the first: {first.name} at line "
                                 f"{first.line})")
            nodes, kind = _nodes(card, rows)
            block = blocks.setdefault((kind, card.integer(2, card.integer(1))), ([], []))
            block[0].append(card)
            block[1].append(nodes)
    cells = [(kind, np.array(nodes, np.int64)[:, permutation(kind, "nastran", "vtk")]) for (kind, _), (_, nodes) in blocks.items()]
    notes = []
    cards_of = [of_block for of_block, _ in blocks.values()]
    points = complete_edges(points, cells, cards_of, {row: number for number, row in rows.items()}, notes)
    raw = RawMesh(points, cells, notes=notes, labels=[np.array([card.integer(1) for card in each], np.int64) for each in cards_of])
    for number in dict.fromkeys(number for _, number in blocks):
        raw.cell_sets[f"property_{number}"] = [np.arange(len(nodes)) if which == number else np.zeros(0, np.int64)
                                               for (_, which), (_, nodes) in blocks.items()]
    return raw, grids


def _nodes(card, rows):
    """The rows of a card's nodes, with NONE for mid-side nodes that it leaves out, and the type."""
    shape, least, most = SHAPES[card.name]
    filled = [k for k in range(3, 3 + most) if k < len(card.fields) and card.fields[k] and (k < 3 + least or card.fields[k].strip("+0"))]
    if filled[:least] != list(range(3, 3 + least)):
        counts = " or ".join(str(count) for count in dict.fromkeys((least, most)))
        raise InputError(f"'{card.path}': line {card.line}: {card.name} {card.fields[1]} has {len(filled)} nodes, but Bielle reads those "
                         f"of {counts}")
    # Mid-side nodes that a face leaves out are taken from the solid cells.
    has_middles = len(filled) > least if shape in SOLID_SHAPES else len(filled) == most
    nodes = [NONE] * (most if has_middles else least)
    for k in filled[:None if has_middles else least]:
        number = card.integer(k)
        if number not in rows:
            raise InputError(f"'{card.path}': line {card.line}: {card.name} {card.fields[1]} names the grid point {number}, which does "
                             "not exist")
        nodes[k - 3] = rows[number]
    return nodes, type_of(shape, len(nodes))
