"""Reads nodes and weights of interfaces that are ties of a deck, from the deck from which the body was reduced."""

import os

import numpy as np

from ..decks.ties import read_ties
from ..messages import InputError

METRES = {"m": 1.0, "mm": 1e-3, "cm": 1e-2, "um": 1e-6, "km": 1e3, "in": 0.0254, "ft": 0.3048}  # by `length_unit`
SAME_PLACE = 1e-6  # times the size of the body: decks have few digits


def tie_of_interface(path, name, said):
    """The tie (as in DeckTies) of an interface with `from`, and the points (p,3) that its node numbers count [m].

    path: superelement; said: body file as a dictionary. @raises InputError if the deck is not there or has no such tie
    """
    wanted = str(said["interfaces"][name]["from"])
    deck = os.path.join(os.path.dirname(path), str(said["geometry"]))
    if not os.path.isfile(deck):
        raise InputError(f"'{path}': the interface '{name}' is '{wanted}' of '{said['geometry']}', which has its nodes and weights and is not "
                         "there: put the superelement next to its body file")
    found = read_ties(deck)
    tie = next((tie for tie in found.ties if _folded(tie["name"]) == _folded(wanted) and "refused" not in tie), None)
    if tie is None:
        raise InputError(f"'{deck}' has no tie '{wanted}' any more, which the interface '{name}' of '{path}' is")
    return tie, found.points * METRES[said.get("length_unit", "m")]


def weighted_nodes(path, name, points, tie, of_deck):
    """Returns the nodes of the superelement's mesh (points) in a tie of nodes, and their weights. @raises InputError if
    the deck has changed since the mesh was made"""
    places = of_deck[np.asarray(tie["nodes"]) - 1]
    apart = np.linalg.norm(points[None, :, :] - places[:, None, :], axis=2)
    nodes = apart.argmin(axis=1)
    if (apart.min(axis=1) > SAME_PLACE * np.ptp(points, axis=0).max()).any() or len(set(nodes)) < len(nodes):
        raise InputError(f"'{path}': the nodes of '{tie['name']}', the interface '{name}', are at other places in the deck now: reduce the body "
                         "again")
    return nodes, np.asarray(tie["weights"])


def spread_over_nodes(points, weights, position):
    """(n,3,6) forces on nodes for unit forces and moments on the interface at a position: F and the moment M about the weighted
    centroid are w (F / sum w + (J^-1 M) x r)."""
    centre = weights @ points / weights.sum()
    r = points - centre
    moments = np.einsum("a,ai,aj->ij", weights, r, r)
    inverse = np.linalg.inv(np.trace(moments) * np.eye(3) - moments)
    spread = np.zeros((len(points), 3, 6))
    for k in range(3):
        about = np.cross(position - centre, np.eye(3)[k])
        spread[:, :, k] = np.eye(3)[k] / weights.sum() + np.cross(inverse @ about, r)
        spread[:, :, 3 + k] = np.cross(inverse[:, k], r)
    return spread * weights[:, None, None]


def _folded(name):
    return " ".join(name.upper().split())
