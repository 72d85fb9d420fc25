"""The unknowns of a Nastran deck: components of grid points, scalar points, and the sets to which they belong.

An unknown is a pair of a point's number and a component, 1 to 6, or 0 of a scalar point. Nastran sorts the unknowns of a
matrix by these pairs. Unknowns in the q-set (QSET) are modal amplitudes, also where they are components of grid points.
(MSC Nastran Quick Reference Guide, "Degree-of-Freedom Sets"; "ASET", "ASET1", "EXTRN", "SPOINT".)
"""

import numpy as np

from ..decks.nastran_cards import mass_per_weight
from ..decks.nastran_grids import Grids, card_number
from ..messages import InputError

PAIRED = ("ASET", "BSET", "CSET", "QSET", "EXTRN")     # point, components, point, components ..
LISTED = ("ASET1", "BSET1", "CSET1", "QSET1")          # components, points
SCALAR = 0
MOST_SCALARS = 1_000_000
MOST_INTERFACES = 50                                   # more nodes than these are hardly all interfaces


class Deck:
    """Points of a deck. a_set: its unknowns in the analysis set; held: those in the b-set, the ends of the modes; modal: those
    in the q-set; scalars: scalar points."""

    def __init__(self, cards):
        """@raises InputError with file and line"""
        self.cards = cards
        self.grids = Grids(cards)
        self.scalars, self.a_set, self.held, self.modal = set(), set(), set(), set()
        for card in cards:
            if card.name == "SPOINT":
                self.scalars.update(_numbers(card, 1, None))
        double = next((number for number in sorted(self.scalars) if number in self.grids.rows), None)
        if double is not None:
            raise InputError(f"'{cards[0].path}': the point {double} is both a GRID and an SPOINT")
        known = self._known()
        for card in cards:
            if card.name in PAIRED:
                for k in range(1, len(card.fields), 2):
                    if card.fields[k] or k + 1 < len(card.fields) and card.fields[k + 1]:
                        self._add(card, [_number(card, k)], k + 1)
            elif card.name in LISTED:
                self._add(card, _numbers(card, 2, known), 1)

    @property
    def notes(self):
        """Sentences on cards that have no effect."""
        if mass_per_weight(self.cards) == 1:
            return []
        return ["PARAM,WTMASS is not applied: the matrices that Nastran writes contain it"]

    def all_unknowns(self):
        """The g-set in Nastran's order."""
        return [(number, component) for number in self._known()
                for component in (range(1, 7) if number in self.grids.rows else (SCALAR,))]

    def named(self, number, component):
        """A pair as this deck means it: component 1 of a scalar point is the point itself."""
        return (number, SCALAR) if number in self.scalars and component == 1 else (number, component)

    def check(self, unknowns, asking):
        """@param asking: text before the sentence @raises InputError for unknowns of points that do not exist"""
        for number, component in unknowns:
            if component != SCALAR and number not in self.grids.rows:
                told = "is an SPOINT, which has no components" if number in self.scalars else "does not exist"
                found = "" if self.grids.rows else "; the deck holds no GRID: --nodes DECK names one that does"
                raise InputError(f"{asking}names component {component} of the point {number}, which {told}{found}")
            if component == SCALAR and number in self.grids.rows:
                raise InputError(f"{asking}names the point {number} without a component, but it is a GRID")

    def _known(self):
        return sorted(self.scalars | set(self.grids.rows))

    def _add(self, card, numbers, k):
        components = _components(card, k)
        for number in numbers:
            pairs = {self.named(number, component) for component in components}
            if number in self.grids.rows and SCALAR in components:
                card.fail(k, f"components 1 to 6 of GRID {number}")
            if number not in self.grids.rows and SCALAR in components:  # decks of matrices often hold no SPOINT
                self.scalars.add(number)
            self.a_set |= pairs
            if card.name.startswith("QSET"):
                self.modal |= pairs
            if card.name.startswith("BSET"):
                self.held |= pairs


def arrays_of(deck, unknowns):
    """Nodes and unknowns of a MatrixSet, as keywords. @param unknowns: sorted pairs, which exist"""
    scalar = [pair[1] == SCALAR or pair in deck.modal for pair in unknowns]
    numbers = sorted({number for (number, _), modal in zip(unknowns, scalar) if not modal})
    rows = {number: row for row, number in enumerate(numbers)}
    counts = np.cumsum(scalar) - 1
    axes = np.array([deck.grids.axes(number) for number in numbers]).reshape(-1, 3, 3)
    return {"numbers": np.array(numbers, np.int64),
            "positions": np.array([deck.grids.points[deck.grids.rows[number]] for number in numbers]).reshape(-1, 3),
            "axes": None if (axes == np.eye(3)).all() else axes,
            "unknown_nodes": np.array([-1 if modal else rows[number] for (number, _), modal in zip(unknowns, scalar)], np.int64),
            "unknown_components": np.array([count if modal else component - 1 for (_, component), modal, count in
                                            zip(unknowns, scalar, counts)], np.int64),
            "interfaces": {f"node_{number}": rows[number] for number in _interfaces(deck, rows, any(scalar))}}


def _interfaces(deck, rows, has_modes):
    """Numbers of the grid points that are interfaces: those of the b-set, or else of the a-set. If these are all that have
    unknowns, they are interfaces of a body with modes, or if they are few."""
    for members in (deck.held, deck.a_set - deck.modal):
        declared = sorted({number for number, component in members if component != SCALAR and number in rows})
        if declared and (len(declared) < len(rows) or has_modes):
            return declared
    return rows if len(rows) <= MOST_INTERFACES else []


def _number(card, k):
    number = card.integer(k)
    if number <= 0:
        card.fail(k, "the number of a point")
    return number


def _numbers(card, first, known):
    """Numbers of points in a list with THRU. @param known: those that exist, sorted; None: the card defines them"""
    if first + 1 < len(card.fields) and card.fields[first + 1] == "THRU":
        begin, end = _number(card, first), card.integer(first + 2)
        count = end - begin + 1
        if count < 1:
            card.fail(first + 2, f"a number from {begin} on")
        if known is None:
            if count > MOST_SCALARS:
                card.fail(first + 2, f"{MOST_SCALARS} scalar points at most")
            return range(begin, end + 1)
        inside = [number for number in known if begin <= number <= end] or [begin]
        if len(inside) < count:
            missing = next(number for number, other in zip(range(begin, end + 1), inside + [None]) if number != other)
            raise InputError(f"'{card.path}': line {card.line}: {card.name} names the points {begin} to {end}, but {missing} does not exist")
        return inside
    if known is None:
        card_number(card)
    return [_number(card, k) for k in card.filled(first)]


def _components(card, k):
    text = card.fields[k] if k < len(card.fields) else ""
    digits = sorted({int(digit) for digit in text if digit in "0123456"})
    if any(digit not in "0123456" for digit in text) or len(digits) != len(text) or len(text) > 1 and SCALAR in digits:
        card.fail(k, "components such as 123456, or 0 for scalar points")
    return digits or [SCALAR]
