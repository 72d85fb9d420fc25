"""The mesh of a Nastran file: grid points in their coordinate systems, solid cells and skins, properties as sets."""

import numpy as np

from .cells import permutation, type_of
from .messages import InputError
from .missing_nodes import NONE, complete_edges
from .solid_mesh import RawMesh

# Card: shape, nodes of order 1 and 2. Nodes follow from field 3 on, in the order "nastran" of cells.py.
SHAPES = {
    "CTETRA": ("tetra", 4, 10), "CHEXA": ("hexahedron", 8, 20), "CPENTA": ("wedge", 6, 15), "CPYRAM": ("pyramid", 5, 13),
    "CPYRA": ("pyramid", 5, 13), "CTRIA3": ("triangle", 3, 3), "CTRIAR": ("triangle", 3, 3), "CTRIA6": ("triangle", 3, 6),
    "CQUAD4": ("quad", 4, 4), "CQUADR": ("quad", 4, 4), "CQUAD8": ("quad", 4, 8),
}
SOLID_SHAPES = ("tetra", "hexahedron", "wedge", "pyramid")
NUMBERS = 2**31
KINDS = {"R": "rectangular", "C": "cylindrical", "S": "spherical"}


def read_mesh(cards):
    """@returns RawMesh, and the row of each grid point by its number. @raises InputError with file and line."""
    points, rows = _points(cards)
    blocks = {}  # (type, property) -> cards, rows of nodes
    known = {}   # element number -> card
    for card in cards:
        if card.name in SHAPES:
            first = known.setdefault(_number(card), card)
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
    return raw, rows


def _number(card):
    """The number of a grid point or an element."""
    number = card.integer(1)
    if not 0 < number < NUMBERS:
        raise InputError(f"'{card.path}': line {card.line}: {card.name} has the number {number}, but numbers are from 1 to {NUMBERS - 1}")
    return number


def _nodes(card, rows):
    """The rows of a card's nodes, with NONE for mid-side nodes that it leaves out, and the type."""
    shape, least, most = SHAPES[card.name]
    filled = [k for k in range(3, 3 + most) if k < len(card.fields) and card.fields[k] and (k < 3 + least or card.fields[k].strip("+0"))]
    if filled[:least] != list(range(3, 3 + least)):
        counts = " or ".join(str(count) for count in dict.fromkeys((least, most)))
        raise InputError(f"'{card.path}': line {card.line}: {card.name} {card.fields[1]} has {len(filled)} nodes, but Bielle reads those "
                         f"of {counts}")
    has_middles = len(filled) > least if shape in SOLID_SHAPES else len(filled) == most  # faces get those of the solid cells
    nodes = [NONE] * (most if has_middles else least)
    for k in filled[:None if has_middles else least]:
        number = card.integer(k)
        if number not in rows:
            raise InputError(f"'{card.path}': line {card.line}: {card.name} {card.fields[1]} names the grid point {number}, which does "
                             "not exist")
        nodes[k - 3] = rows[number]
    return nodes, type_of(shape, len(nodes))


def _points(cards):
    """Points (p,3) in the basic system, and the row of each by its number."""
    default = next((card.integer(2, 0) for card in cards if card.name == "GRDSET"), 0)
    grids, rows = [], {}
    for card in cards:
        if card.name == "GRID":
            number = _number(card)
            if number in rows:
                raise InputError(f"'{card.path}': line {card.line}: there is a second GRID {number} (the first: line "
                                 f"{grids[rows[number]].line}); parts with numbers of their own must be renumbered")
            rows[number] = len(grids)
            grids.append(card)
    if not grids:
        return np.zeros((0, 3)), rows
    systems = _Systems(cards, grids, rows, default)
    return np.array([systems.place(card.integer(2, default), [card.number(k, 0.0) for k in (3, 4, 5)], card) for card in grids]), rows


class _Systems:
    """Coordinate systems, each computed on demand: they may refer to each other and to grid points."""

    def __init__(self, cards, grids, rows, default):
        self.grids, self.rows, self.default = grids, rows, default
        self.cards, self.found, self.asked = {}, {0: ("R", np.zeros(3), np.eye(3))}, []
        for card in cards:
            if card.name[:5] in ("CORD1", "CORD2") and card.name[5:] in KINDS:
                for first in (1, 5) if card.name[4] == "1" and len(card.fields) > 5 and card.fields[5] else (1,):
                    self.cards[card.integer(first)] = (card, first)

    def place(self, number, coordinates, card):
        if number == 0:
            return np.array(coordinates)
        kind, origin, axes = self.system(number, card)
        return origin + axes @ _cartesian(kind, coordinates)

    def system(self, number, asking):
        """Kind, origin and axes (columns) in the basic system."""
        if number in self.found:
            return self.found[number]
        if number not in self.cards:
            raise InputError(f"'{asking.path}': line {asking.line}: {asking.name} {asking.fields[1]} stands in the coordinate system {number}, "
                             "which does not exist")
        card, first = self.cards[number]
        if number in self.asked:
            raise InputError(f"'{card.path}': line {card.line}: the coordinate system {number} refers to itself")
        self.asked.append(number)
        if card.name[4] == "1":
            a, b, c = (self._grid(card, first + k) for k in (1, 2, 3))
        else:
            reference = card.integer(2, 0)
            a, b, c = (self.place(reference, [card.number(k + i, 0.0) for i in range(3)], card) for k in (3, 6, 9))
        self.asked.pop()
        z, in_plane = b - a, c - a
        y = np.cross(z, in_plane)
        if np.linalg.norm(y) <= 1e-12 * np.linalg.norm(z) * np.linalg.norm(in_plane) or not z.any() or not in_plane.any():
            raise InputError(f"'{card.path}': line {card.line}: the three points of the coordinate system {number} stand in one line")
        z, y = z / np.linalg.norm(z), y / np.linalg.norm(y)
        self.found[number] = (card.name[5], a, np.column_stack([np.cross(y, z), y, z]))
        return self.found[number]

    def _grid(self, card, k):
        number = card.integer(k)
        if number not in self.rows:
            card.fail(k, "a grid point that exists")
        grid = self.grids[self.rows[number]]
        return self.place(grid.integer(2, self.default), [grid.number(i, 0.0) for i in (3, 4, 5)], grid)


def _cartesian(kind, coordinates):
    """Converts coordinates of a system's own kind, angles in degrees, to Cartesian ones in its axes."""
    r, second, third = coordinates
    if kind == "C":
        return np.array([r * np.cos(np.radians(second)), r * np.sin(np.radians(second)), third])
    if kind == "S":  # radius, angle from z, angle about z
        theta, phi = np.radians([second, third])
        return r * np.array([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)])
    return np.array(coordinates)
