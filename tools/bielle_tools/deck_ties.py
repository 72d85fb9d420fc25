"""Ties of decks to one node (RBE2, RBE3, couplings, rigid bodies), and their point masses, for the interfaces of a body file.

Values keep the file's units. Nothing is guessed: a tie that an interface cannot stand for is listed with the reason.
"""

import os
from collections import Counter
from dataclasses import dataclass, field

import numpy as np

from .abaqus_file import read_deck as read_abaqus_deck
from .abaqus_ties import read_abaqus_masses, read_abaqus_ties
from .cells import SOLIDS
from .foreign_mesh import MANY_PROGRAMS, NASTRAN, is_nastran, with_path
from .messages import InputError
from .nastran_cards import read_cards
from .nastran_masses import read_masses
from .nastran_mesh import read_mesh
from .nastran_ties import read_nastran_ties
from .solid_mesh import solid_mesh
from .tie_model import TieRefusal


@dataclass
class DeckTies:
    """ties and masses as dictionaries of plain values, for JSON; notes: sentences for the user."""

    ties: list = field(default_factory=list)
    masses: list = field(default_factory=list)
    notes: list = field(default_factory=list)


def read_ties(path):
    """The ties and point masses of a deck; none of a file that is no deck. @raises InputError with one sentence"""
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
    else:
        return DeckTies()
    return _Numbering(with_path(path, lambda: solid_mesh(raw)), labels).numbered(ties, masses)


class _Numbering:
    """Numbers of nodes in the converted mesh."""

    def __init__(self, mesh, labels):
        self.mesh, self.labels, self.found = mesh, labels, DeckTies()
        self.in_solid = np.zeros(len(mesh.points), bool)
        for kind, cells in mesh.cells.items():
            if kind in SOLIDS:
                self.in_solid[cells] = True

    def numbered(self, ties, masses):
        counts = Counter(tie.name.upper() for tie in ties)
        done = set()
        for tie in ties:
            if tie.name.upper() in done:
                continue
            done.add(tie.name.upper())
            try:
                if counts[tie.name.upper()] > 1:
                    raise TieRefusal(f"there are {counts[tie.name.upper()]} of this name")
                self.found.ties.append(self._tie(tie))
            except TieRefusal as refusal:
                self.found.ties.append({"name": tie.name, "refused": str(refusal)})
        carriers = {}
        for tie in ties:
            if tie.reference is not None:
                carriers.setdefault(tie.reference, []).append(tie.name)
        for mass in masses:
            entry = {"name": mass.name, "mass": mass.mass, "position": list(mass.position), "inertia": np.asarray(mass.inertia).tolist()}
            node = self._node(mass.node)
            if len(carriers.get(mass.node, ())) > 1:
                raise InputError(f"{mass.name} stands at a node of several ties ({', '.join(carriers[mass.node])}), which would share it: give the "
                                 "ties one node each, or join them to one tie")
            if mass.node in carriers:
                entry["tie"] = carriers[mass.node][0]
            elif node is not None:
                entry["node"], entry["place"] = node + 1, self.mesh.points[node].tolist()
            self.found.masses.append(entry)
        return self.found

    def _node(self, row):
        """The row in the converted mesh of a node of the deck; None if it is in no solid cell."""
        new = self.mesh.numbers[row] if isinstance(row, (int, np.integer)) else -1
        return int(new) if new >= 0 and self.in_solid[new] else None

    def _tie(self, tie):
        if tie.refused:
            raise TieRefusal(tie.refused)
        entry = {"name": tie.name, "tie": tie.kind, "position": [float(x) for x in tie.position],
                 "axes": np.asarray(tie.axes).T.tolist(), "directions": tie.directions}
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
