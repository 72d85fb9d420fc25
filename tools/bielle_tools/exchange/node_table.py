"""Positions of nodes and order of unknowns from files besides the matrices: decks of Abaqus and CalculiX, and tables
(.csv).

A table of nodes has the columns node, x, y, z; one of unknowns node, component (x y z rx ry rz or 1 to 6; node 0: a
scalar coordinate), a row for each row of the matrices. A first line with these names is optional, unless the columns
stand in another order.
"""

import csv
import math
import os
from dataclasses import dataclass, field

import numpy as np

from ..decks.abaqus_contents import LABELS
from ..decks.abaqus_file import read_deck
from ..decks.abaqus_lines import number
from ..messages import InputError, counted, did_you_mean
from ..text_lines import lines_of
from .matrix_set import COMPONENTS, check_positions

NODE_COLUMNS, UNKNOWN_COLUMNS = ("node", "x", "y", "z"), ("node", "component")
ALIASES = {"id": "node", "number": "node", "dof": "component", "direction": "component"}


@dataclass
class Nodes:
    """Nodes of a table or deck. A deck's node set SCALARS names nodes whose unknowns are scalar coordinates."""

    path: str
    numbers: np.ndarray    # (N)
    positions: np.ndarray  # (N,3)
    scalars: frozenset = frozenset()  # numbers of nodes without a place
    blocks: list = field(default_factory=list)  # (meshio type, (n,k) numbers of nodes in VTK's order) of the cells between them


def read_nodes(path):
    """Nodes of a table or deck. @raises InputError"""
    scalars, blocks = frozenset(), []
    if os.path.splitext(path)[1].lower() == ".csv":
        rows = _table(path, NODE_COLUMNS)
        numbers = [_label(path, line, words[0]) for line, words in rows]
        positions = [[_coordinate(path, line, words[0], word) for word in words[1:]] for line, words in rows]
    else:
        numbers, positions, scalars, blocks = _nodes_of_deck(path)
    if len(set(numbers)) < len(numbers):
        twice = next(each for each in numbers if numbers.count(each) > 1)
        raise InputError(f"'{path}': node {twice} stands twice")
    if not numbers:
        raise InputError(f"'{path}': holds no nodes")
    return Nodes(path, np.array(numbers, np.int64), np.array(positions, float).reshape(-1, 3), scalars, blocks)


def _nodes_of_deck(path):
    """Numbers, positions, the set SCALARS and blocks of cells. @raises InputError for decks whose unknowns or numbers are not those of the matrices"""
    deck = read_deck(path)
    if deck.constraints.transforms:
        raise InputError(f"{deck.constraints.transforms[0].where}: *TRANSFORM turns the unknowns of nodes: matrices "
                         "are read in global axes; "
                         "remove it and generate them again")
    numbers = list(deck.numbers)
    check_positions(numbers, np.asarray(deck.points, float).reshape(-1, 3), f"'{path}': ")
    if any(not 0 < each < LABELS for each in numbers):
        raise InputError(f"'{path}': several instances have nodes, whose numbers are not those of the matrices: give "
                         "a table of nodes "
                         "(node,x,y,z)")
    return numbers, deck.points, frozenset(deck.labels_of("NSET", "SCALARS") if "SCALARS" in deck.sets["NSET"] else ()), [(kind, nodes) for kind, _, nodes in deck.blocks]


def read_unknowns(path, numbers):
    """Row of the node in `numbers` (-1: a scalar coordinate) and component of each unknown. @raises InputError"""
    place, nodes, components, scalars = {int(number): row for row, number in enumerate(numbers)}, [], [], 0
    for line, (node, component) in _table(path, UNKNOWN_COLUMNS):
        label = _label(path, line, node)
        if label == 0:
            nodes.append(-1)
            components.append(scalars)
            scalars += 1
            continue
        if label not in place:
            raise InputError(f"{path}:{line}: node {label} has no position")
        nodes.append(place[label])
        components.append(_component(path, line, component))
    return np.array(nodes, np.int64), np.array(components, np.int64)


def unknowns_in_order(path, count, size):
    """Node and component of each of `size` unknowns, those of one node after another. @raises InputError unless each of the `count`
    nodes has 3 or 6; path: file of the nodes"""
    if size not in (3 * count, 6 * count):
        raise InputError(f"'{path}': {counted(count, 'node')} with 3 or 6 unknowns each do not make the "
                         f"{counted(size, 'row')} of the "
                         "matrices: give a table of the unknowns (node,component)")
    each = size // count
    return np.repeat(np.arange(count), each), np.tile(np.arange(each), count)


def places_of(path, labels, components, nodes):
    """Row of the node (-1: a scalar coordinate) and component of unknowns given by labels of nodes and components from 0.

    Nodes with a negative label or in the set SCALARS are scalar coordinates, counted in the order of the unknowns.
    @param path: file of the labels. @raises InputError naming the first label that has no position
    """
    scalar = (labels < 0) | np.isin(labels, list(nodes.scalars))
    order = np.argsort(nodes.numbers)
    at = np.searchsorted(nodes.numbers, labels, sorter=order)
    rows = order[np.minimum(at, len(order) - 1)]
    missing = (nodes.numbers[rows] != labels) & ~scalar
    if missing.any():
        raise InputError(f"'{path}': node {labels[missing][0]} has no position in '{nodes.path}' "
                         f"({counted(len(set(labels[missing])), 'node')} "
                         "missing)")
    return np.where(scalar, -1, rows), np.where(scalar, np.cumsum(scalar) - 1, components)


def _table(path, columns):
    """(line, words in the order of `columns`) of each row. @raises InputError"""
    rows = []
    try:
        for line, words in enumerate(csv.reader(lines_of(path)), 1):
            words = [word.strip() for word in words]
            if any(words) and not words[0].startswith("#"):
                rows.append((line, words))
    except csv.Error as error:
        raise InputError(f"'{path}': {error}") from None
    order = list(range(len(columns)))
    if rows and not rows[0][1][0].lstrip("+-").isdigit():
        line, words = rows.pop(0)
        names = [ALIASES.get(word.lower(), word.lower()) for word in words]
        for column in columns:
            if column not in names:
                raise InputError(f"{path}:{line}: there is no column '{column}'{did_you_mean(column, names)}")
        order = [names.index(column) for column in columns]
    for line, words in rows:
        if len(words) <= max(order):
            raise InputError(f"{path}:{line}: expected the columns {', '.join(columns)}, found "
                             f"{counted(len(words), 'word')}")
    return [(line, [words[k] for k in order]) for line, words in rows]


def _label(path, line, word):
    try:
        label = int(word)
    except ValueError:
        raise InputError(f"{path}:{line}: expected the number of a node, found '{word}'") from None
    if not 0 <= label < LABELS:
        raise InputError(f"{path}:{line}: a node has the number {label}, but numbers are from 1 to {LABELS - 1}")
    return label


def _coordinate(path, line, node, word):
    try:
        found = number(word)
    except ValueError as error:
        raise InputError(f"{path}:{line}: {error}") from None
    if not math.isfinite(found):
        raise InputError(f"{path}:{line}: node {node} has the coordinate '{word}'; expected a finite number")
    return found


def _component(path, line, word):
    if word in ("1", "2", "3", "4", "5", "6"):
        return int(word) - 1
    if word.lower() in COMPONENTS:
        return COMPONENTS.index(word.lower())
    raise InputError(f"{path}:{line}: there is no component '{word}'{did_you_mean(word, list(COMPONENTS))}")
