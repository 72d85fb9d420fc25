"""Ties of decks to one node (RBE2, RBE3, couplings, rigid bodies), and their point masses, for the interfaces of a body file.

Values keep the file's units. Nothing is guessed: a tie that an interface cannot stand for, and a
mass that nothing carries, are listed with the reason.
"""

import os
from collections import Counter
from dataclasses import dataclass, field

import numpy as np

from ..mesh.cells import SOLIDS
from ..mesh.solid_mesh import solid_mesh
from ..messages import InputError
from .abaqus_file import read_deck as read_abaqus_deck
from .abaqus_ties import read_abaqus_masses, read_abaqus_ties
from .foreign_mesh import MANY_PROGRAMS, NASTRAN, is_nastran, with_path
from .nastran_cards import read_cards
from .nastran_masses import read_masses
from .nastran_mesh import read_mesh
from .nastran_ties import read_nastran_ties
from .tie_model import TieRefusal


@dataclass
class DeckTies:
    """ties and masses as dictionaries of plain values, for JSON; notes: sentences for the user; points (p,3): those of the
    converted mesh, which the numbers of nodes of a tie count from 1."""

    ties: list = field(default_factory=list)
    masses: list = field(default_factory=list)
    notes: list = field(default_factory=list)
    points: np.ndarray = field(default_factory=lambda: np.zeros((0, 3)))


def read_ties(path):
    """The ties and point masses of a deck; both lists are empty if the file is no deck. @raises InputError with one
    sentence"""
    extension = os.path.splitext(path)[1].lower()
    if not os.path.isfile(path):
        raise InputError(f"'{path}' does not exist")
    if extension in NASTRAN or (extension in MANY_PROGRAMS and is_nastran(path)):
        cards = read_cards(path)
        raw, grids = read_mesh(cards)
        ties, masses = read_nastran_ties(cards, grids), read_masses(cards, grids)
        labels = {row: number for number, row in grids.rows.items()}
    elif extension == ".inp" or extension in MANY_PROGRAMS:
        deck = read_abaqus_deck(path)
        raw = deck.raw_mesh(path)
        ties, masses = read_abaqus_ties(deck), read_abaqus_masses(deck)
        labels = {row: deck.assembly.told(number) for number, row in deck.numbers.items()}
        labels.update({("reference point", number): deck.assembly.told(number) for number in deck.reference_points})
    else:
        return DeckTies()
    return _Numbering(with_path(path, lambda: solid_mesh(raw)), labels).numbered(ties, masses)


class _Numbering:
    """Numbers of nodes in the converted mesh."""

    def __init__(self, mesh, labels):
        self.mesh, self.labels, self.found = mesh, labels, DeckTies(points=mesh.points)
        self.in_solid = np.zeros(len(mesh.points), bool)
        for kind, cells in mesh.cells.items():
            if kind in SOLIDS:
                self.in_solid[cells] = True

    def numbered(self, ties, masses):
        """DeckTies of the ties and masses."""
        self.found.ties = _each_once(ties, self._tie)
        refused = {entry["name"].upper(): entry["refused"] for entry in self.found.ties if "refused" in entry}
        self.found.masses = _each_once(masses, lambda mass: self._mass(mass, ties, refused))
        return self.found

    def _mass(self, mass, ties, refused):
        """@param refused: reasons by names of ties"""
        if mass.refused:
            raise TieRefusal(mass.refused)
        entry = {"name": mass.name, "mass": mass.mass, "position": list(mass.position), "inertia": np.asarray(mass.inertia).tolist()}
        return {**entry, **self._carrier(mass.node, ties, refused)} if mass.has_effect() else entry

    def _carrier(self, node, ties, refused):
        """The tie, or the node of the solid, that carries a mass. @raises TieRefusal if there is none, or several ties"""
        own = list({tie.name.upper(): tie.name for tie in ties if tie.reference is not None and tie.reference == node}.values())
        if len(own) > 1:
            raise TieRefusal(f"it stands at a node of several ties ({', '.join(own)}), which would share it: give the ties one node each, or join "
                             "them to one tie")
        if own and own[0].upper() not in refused:
            return {"tie": own[0]}
        row = self._node(node)
        if row is not None:
            return {"node": row + 1, "place": self.mesh.points[row].tolist()}
        if own:
            raise TieRefusal(f"{own[0]}, at whose node it stands, cannot carry it: {refused[own[0].upper()]}")
        holder = next((tie.name for tie in ties if node in tie.weights), None)
        if holder:
            raise TieRefusal(f"it stands at a node that {holder} ties to others and no solid cell has: put it at the reference node of the tie")
        raise TieRefusal("it stands at a node that belongs to no solid cell and is the reference node of no tie")

    def _node(self, row):
        """The row in the converted mesh of a node of the deck; None if it is in no solid cell."""
        new = self.mesh.numbers[row] if isinstance(row, (int, np.integer)) else -1
        return int(new) if new >= 0 and self.in_solid[new] else None

    def _tie(self, tie):
        if tie.refused:
            raise TieRefusal(tie.refused)
        entry = {"name": tie.name, "tie": tie.kind, "position": [float(x) for x in tie.position],
                 "axes": np.asarray(tie.axes).T.tolist(), "directions": tie.directions, "reference": str(self.labels[tie.reference])}
        if tie.surface:
            self._check_surface(tie)
            return {**entry, "surface": self.mesh.surface_of[tie.surface]}
        weights = dict(tie.weights)
        if tie.kind == "rigid" and self._node(tie.reference) is not None and tie.reference not in weights:
            weights[tie.reference] = 1.0
            self.found.notes.append(f"{tie.name}: its reference node {self.labels[tie.reference]} belongs to the solid, too: it moves with the "
                                    "others as one rigid body")
        self._check_reference(tie)
        strange = next((row for row in weights if self._node(row) is None), None)
        if strange is not None:
            raise TieRefusal(f"it ties the node {self.labels[strange]}, which belongs to no solid cell")
        if not weights:
            raise TieRefusal("it ties no nodes")
        nodes = sorted(weights, key=self._node)
        return {**entry, "nodes": [self._node(row) + 1 for row in nodes], "weights": [float(weights[row]) for row in nodes]}

    def _check_reference(self, tie):
        if tie.kind == "average" and self._node(tie.reference) is not None:
            raise TieRefusal(f"its reference node {self.labels[tie.reference]} is a node of the solid: an interface is a node of its own, which "
                             "follows the mean of others; give the tie a node at the same place that no cell uses")

    def _check_surface(self, tie):
        self._check_reference(tie)
        if tie.surface not in self.mesh.surface_of:
            raise TieRefusal(f"its surface '{tie.surface}' has no faces of the solid")
        node = self._node(tie.reference)
        group = self.mesh.surfaces[self.mesh.surface_of[tie.surface]]
        if node is not None and not any((self.mesh.cells[kind][cells] == node).any() for kind, cells in group.items()):
            raise TieRefusal(f"its reference node {self.labels[tie.reference]} is a node of the solid outside of its surface")


def _each_once(items, entry_of):
    """Entries of ties or masses; one for several of the same name, with the reason."""
    counts, first, entries = Counter(item.name.upper() for item in items), {}, []
    for item in items:
        first.setdefault(item.name.upper(), item)
    for key, item in first.items():
        try:
            if counts[key] > 1:
                raise TieRefusal(f"there are {counts[key]} of this name")
            entries.append(entry_of(item))
        except TieRefusal as refusal:
            entries.append({"name": item.name, "refused": str(refusal)})
    return entries
