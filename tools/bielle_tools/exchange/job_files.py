"""Files that stand next to matrices: their names, and the decks and rows of their nodes."""

import os

import numpy as np

from ..messages import InputError
from ..text_lines import lines_of
from .deck_cells import cells_between
from .matrix_set import COMPONENTS


def first_line(path, comment=None):
    """The first line with text that is no comment."""
    return next((text.strip() for text in lines_of(path) if text.strip() and not (comment and text.lstrip().startswith(comment))), "")


def used_nodes(nodes, place):
    """Numbers and positions of the nodes that have unknowns, the row of the node of each unknown, -1 for scalars, and the cells between
    them."""
    used = np.unique(place[place >= 0])
    return {"numbers": nodes.numbers[used], "positions": nodes.positions[used],
            "unknown_nodes": np.where(place < 0, -1, np.searchsorted(used, place)),
            "cells": cells_between(nodes.blocks, nodes.numbers[used])}


def stem(path):
    """Name of a file without folder and ending."""
    return os.path.splitext(os.path.basename(path))[0]


def beside(path, endings):
    """The file of the nodes next to another one. @raises InputError if there is none"""
    base = os.path.splitext(path)[0]
    found = [base + ending for ending in endings if os.path.exists(base + ending)]
    if not found:
        raise InputError(f"'{path}': the positions of the nodes are missing: --nodes FILE names a deck (.inp) or a "
                         "table (.csv) with them")
    return found[0]


def deck_of_nodes(matrices):
    """Labels of the node of each unknown, those of scalars above all others, and a deck of the nodes."""
    first = int(matrices.numbers.max(initial=0)) + 1
    scalar = matrices.unknown_nodes < 0
    labels = np.where(scalar, first + np.cumsum(scalar) - 1, matrices.numbers[matrices.unknown_nodes] if len(matrices.numbers) else 0)
    lines = ["*NODE"]
    lines += [", ".join([str(number), *(f"{x:.16e}" for x in position)]) for number, position in zip(matrices.numbers, matrices.positions)]
    if scalar.any():
        lines += [f"{label}, 0, 0, 0" for label in labels[scalar]]
        lines += ["** Their component 1 is a scalar coordinate, an amplitude of a mode.", "*NSET, NSET=SCALARS"]
        lines += [f"{label}," for label in labels[scalar]]
    return labels, "\n".join(lines) + "\n"


def node_table_text(matrices):
    """A table of the nodes (node_table)."""
    lines = ["node,x,y,z"]
    lines += [",".join([str(number), *(f"{x:.17g}" for x in position)]) for number, position in zip(matrices.numbers, matrices.positions)]
    return "\n".join(lines) + "\n"


def frames_first(matrices, program):
    """Rows in the order x y z rx ry rz of each node, then scalars. @param program: for the message
    @raises InputError when a node lacks some of its six unknowns"""
    place = {(int(node), int(component)): row for row, (node, component) in
             enumerate(zip(matrices.unknown_nodes, matrices.unknown_components))}
    order = []
    for node, number in enumerate(matrices.numbers):
        for component, name in enumerate(COMPONENTS):
            if (node, component) not in place:
                raise InputError(f"node {number} has no unknown {name}: a node of {program} needs all six")
            order.append(place[node, component])
    return order + np.flatnonzero(matrices.unknown_nodes < 0).tolist()
