"""Mid-side nodes that cells of Nastran leave out on some of their edges.

Nastran lets an edge of a cell of order 2 be straight and without a node, so that a cell of order 1 fits to it. Bielle has
no such cells: a node is made in the middle of the edge if all cells at the edge leave it out.
"""

import numpy as np

from ..mesh.cells import CELLS, SOLIDS
from ..messages import InputError, counted

NONE = -1  # in place of the node


def complete_edges(points, cells, cards, numbers, notes):
    """Replaces NONE in place by new nodes. cells: list of (type, (n,k) in VTK's order); cards: for each the list of its cards;
    numbers: of the grid points. @returns points with the new ones. @raises InputError if cells at an edge disagree"""
    lacking = {}  # pair of corners -> (block, row) of the first cell without the node
    incomplete = set()
    for block, (kind, nodes) in enumerate(cells):
        if kind in SOLIDS:
            for row, column in np.argwhere(nodes == NONE).tolist():
                pair = nodes[row, list(CELLS[kind].middles[column - CELLS[kind].corners])]
                lacking.setdefault(tuple(sorted(pair.tolist())), (block, row))
                incomplete.add((block, row))
    if not lacking:
        return points
    _check_neighbours(cells, cards, numbers, lacking, len(points))
    new = {pair: len(points) + k for k, pair in enumerate(lacking)}
    for block, row in incomplete:
        kind, nodes = cells[block]
        for k, edge in enumerate(CELLS[kind].middles, CELLS[kind].corners):
            if nodes[row, k] == NONE:
                nodes[row, k] = new[tuple(sorted(nodes[row, list(edge)].tolist()))]
    block, row = min(incomplete)
    notes.append(f"{counted(len(incomplete), 'cell')} of order 2 {'leaves' if len(incomplete) == 1 else 'leave'} out some mid-side "
                 "nodes (the first: "
                 f"{_card(cards[block][row])}): {counted(len(new), 'node')} {'has' if len(new) == 1 else 'have'} been made in the "
                 "middle of edges")
    return np.concatenate([points, np.array([(points[a] + points[b]) / 2 for a, b in new])])


def _check_neighbours(cells, cards, numbers, lacking, count):
    wanted = np.array([a * count + b for a, b in lacking])
    for block, (kind, nodes) in enumerate(cells):
        if kind not in SOLIDS:
            continue
        cell = CELLS[kind]
        for k, edge in enumerate(cell.edges):
            pairs = np.sort(nodes[:, list(edge)], axis=1)
            at = np.isin(pairs[:, 0] * count + pairs[:, 1], wanted)
            if cell.order == 2:
                at &= nodes[:, cell.corners + k] != NONE
            if at.any():
                row = int(np.argmax(at))
                a, b = pairs[row].tolist()
                first = cards[lacking[a, b][0]][lacking[a, b][1]]
                has = "has one" if cell.order == 2 else "is of order 1"
                raise InputError(f"'{first.path}': line {first.line}: {_card(first)} has no mid-side node between the grid points "
                                 f"{numbers[a]} and "
                                 f"{numbers[b]}, and {_card(cards[block][row])} at line {cards[block][row].line} {has}: give both the "
                                 "node or "
                                 "neither; Bielle has no cells of order 2 with edges of order 1")


def _card(card):
    return f"{card.name} {card.fields[1]}"
