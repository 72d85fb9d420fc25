"""The mesh of a Nastran file: grid points in their coordinate systems, solid cells and skins, properties as sets."""

import numpy as np

from .messages import InputError
from .solid_mesh import RawMesh

# Card: nodes -> meshio type. Nodes follow from field 3 on, in VTK's order.
CELLS = {
    "CTETRA": {4: "tetra", 10: "tetra10"},
    "CTRIA3": {3: "triangle"}, "CTRIAR": {3: "triangle"}, "CTRIA6": {6: "triangle6"},
    "CHEXA": {8: "hexahedron", 20: "hexahedron20"}, "CPENTA": {6: "wedge", 15: "wedge15"},
    "CPYRAM": {5: "pyramid", 13: "pyramid13"}, "CPYRA": {5: "pyramid", 13: "pyramid13"},
    "CQUAD4": {4: "quad"}, "CQUADR": {4: "quad"}, "CQUAD8": {8: "quad8"},
}
MOST_NODES = {"CTETRA": 10, "CTRIA3": 3, "CTRIAR": 3, "CTRIA6": 6, "CHEXA": 20, "CPENTA": 15, "CPYRAM": 13, "CPYRA": 13, "CQUAD4": 4,
              "CQUADR": 4, "CQUAD8": 8}
KINDS = {"R": "rectangular", "C": "cylindrical", "S": "spherical"}


def read_mesh(cards):
    """@returns RawMesh, and the row of each grid point by its number. @raises InputError with file and line."""
    points, rows = _points(cards)
    raw = RawMesh(points, [])
    blocks = {}  # (type, property) -> rows of nodes
    for card in cards:
        if card.name in CELLS:
            nodes, kind = _nodes(card, rows)
            blocks.setdefault((kind, card.integer(2, card.integer(1))), []).append(nodes)
    raw.cells = [(kind, np.array(nodes, np.int64)) for (kind, _), nodes in blocks.items()]
    for number in dict.fromkeys(number for _, number in blocks):
        raw.cell_sets[f"property_{number}"] = [np.arange(len(nodes)) if which == number else np.zeros(0, np.int64)
                                               for (_, which), nodes in blocks.items()]
    return raw, rows


def _nodes(card, rows):
    filled = [k for k in range(3, 3 + MOST_NODES[card.name]) if k < len(card.fields) and card.fields[k]]
    kind = CELLS[card.name].get(len(filled))
    if kind is None or filled != list(range(3, 3 + len(filled))):
        counts = " or ".join(str(count) for count in CELLS[card.name])
        raise InputError(f"'{card.path}': line {card.line}: {card.name} {card.fields[1]} has {len(filled)} nodes, but Bielle reads those "
                         f"of {counts}")
    nodes = []
    for k in filled:
        number = card.integer(k)
        if number not in rows:
            raise InputError(f"'{card.path}': line {card.line}: {card.name} {card.fields[1]} names the grid point {number}, which does "
                             "not exist")
        nodes.append(rows[number])
    return nodes, kind


def _points(cards):
    """Points (p,3) in the basic system, and the row of each by its number."""
    default = next((card.integer(2, 0) for card in cards if card.name == "GRDSET"), 0)
    grids, rows = [], {}
    for card in cards:
        if card.name == "GRID":
            number = card.integer(1)
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
