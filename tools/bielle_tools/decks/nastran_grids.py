"""Grid points of a Nastran file, and the coordinate systems in which they and their displacements stand."""

import numpy as np

from ..messages import InputError

KINDS = {"R": "rectangular", "C": "cylindrical", "S": "spherical"}
CP, CD = 2, 6  # fields of GRID and GRDSET
NUMBERS = 2**31
DEEPEST = 100    # coordinate systems that refer to each other


def card_number(card):
    """The number of a grid point or an element. @raises InputError for numbers that Nastran does not have"""
    number = card.integer(1)
    if not 0 < number < NUMBERS:
        raise InputError(f"'{card.path}': line {card.line}: {card.name} has the number {number}, but numbers are from 1 to {NUMBERS - 1}")
    return number


class Grids:
    """points (p,3) in the basic system; rows: the row of each grid point by its number."""

    def __init__(self, cards):
        """@raises InputError with file and line."""
        self.rows, self.points = {}, np.zeros((0, 3))
        self._cards = []
        self._defaults = next((card for card in cards if card.name == "GRDSET"), None)
        for card in cards:
            if card.name == "GRID":
                number = card_number(card)
                if number in self.rows:
                    raise InputError(f"'{card.path}': line {card.line}: there is a second GRID {number} (the first: line "
                                     f"{self._cards[self.rows[number]].line}); parts with numbers of their own must be renumbered")
                self.rows[number] = len(self._cards)
                self._cards.append(card)
        default = self._default(CP)
        self.systems = Systems(cards, self._cards, self.rows, default)
        if self._cards:
            self.points = np.array([self.systems.place(card.integer(CP, default), [card.number(k, 0.0) for k in (3, 4, 5)], card)
                                    for card in self._cards])

    def axes(self, number):
        """Axes (columns) of the displacements of a grid point. @raises InputError for a system that does not exist"""
        card = self._cards[self.rows[number]]
        return self.systems.axes_at(card.integer(CD, self._default(CD)), self.points[self.rows[number]], card)

    def _default(self, field):
        return self._defaults.integer(field, 0) if self._defaults else 0


class Systems:
    """Coordinate systems, each computed on demand: they may refer to each other and to grid points."""

    def __init__(self, cards, grids, rows, default):
        self.grids, self.rows, self.default = grids, rows, default
        self.cards, self.found, self.asked = {}, {0: ("R", np.zeros(3), np.eye(3))}, []
        for card in cards:
            if card.name[:5] in ("CORD1", "CORD2") and card.name[5:] in KINDS:
                for first in (1, 5) if card.name[4] == "1" and len(card.fields) > 5 and card.fields[5] else (1,):
                    self._add(card, first)

    def _add(self, card, first):
        number = card.integer(first)
        if not 0 < number < NUMBERS:
            card.fail(first, "a number from 1 on")
        other, place = self.cards.setdefault(number, (card, first))
        end = len(card.fields) if card.name[4] == "2" else first + 4
        if (other.name, other.fields[place:place + end - first]) != (card.name, card.fields[first:end]):
            raise InputError(f"'{card.path}': line {card.line}: there is a second coordinate system {number} (the first: line {other.line})")

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
        if len(self.asked) == DEEPEST:
            raise InputError(f"'{card.path}': line {card.line}: more than {DEEPEST} coordinate systems refer to each other, the last one to {number}")
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

    def axes_at(self, number, point, card):
        """Axes (columns) of a system at a point: of a cylindrical or spherical one its local directions there."""
        kind, origin, axes = self.system(number, card)
        x, y, z = axes.T @ (point - origin)
        about_z = np.arctan2(y, x) if np.hypot(x, y) > 1e-12 * np.linalg.norm((x, y, z)) else 0.0
        radial, across = np.array([np.cos(about_z), np.sin(about_z), 0]), np.array([-np.sin(about_z), np.cos(about_z), 0])
        if kind == "C":
            return axes @ np.column_stack([radial, across, [0, 0, 1]])
        if kind == "S":
            from_z = np.arctan2(np.hypot(x, y), z)
            up = np.array([0, 0, 1])
            return axes @ np.column_stack([np.sin(from_z) * radial + np.cos(from_z) * up, np.cos(from_z) * radial - np.sin(from_z) * up, across])
        return axes

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
