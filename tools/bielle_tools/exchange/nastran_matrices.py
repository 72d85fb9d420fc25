"""A MatrixSet out of the matrices of a Nastran deck or of an OUTPUT4 file."""

import os

import numpy as np
import scipy.sparse

from ..messages import counted
from .deck_cells import blocks_of_cards, cells_between
from .matrix_set import MatrixSet, Shapes
from .nastran_unknowns import SCALAR, arrays_of

RECTANGULAR = ("shapes", "stress")  # the roles of matrices that have columns of the unknowns alone


def matrix_set(deck, unknowns, matrices, options, path, source):
    """@param unknowns: sorted pairs @param matrices: by the names of the members of MatrixSet @param source: name of the format"""
    result = MatrixSet(name=options.name or os.path.splitext(os.path.basename(path))[0], source=f"{source}, {os.path.basename(path)}",
                       **arrays_of(deck, unknowns), **matrices)
    result.notes += deck.notes
    blocks = blocks_of_cards(deck.cards)
    result.cells = cells_between(blocks, result.numbers)
    if result.shapes is not None:
        result.shapes.cells = cells_between(blocks, result.shapes.numbers)
    if not result.interfaces:
        result.notes.append("neither BSET nor ASET of the deck tells which nodes are interfaces: the body file has to name them")
    return result


def shapes_of(deck, blocks, values):
    """Shapes in axes of the body out of those in axes of the points.

    @param blocks: rows of each grid point: {number: {component: row}} @param values: scipy.sparse (rows, n)
    @returns Shapes or None, and notes"""
    numbers = sorted(number for number in blocks if number in deck.grids.rows)
    notes = []
    if len(numbers) < len(blocks):
        notes.append(f"left out: the shapes of {len(blocks) - len(numbers)} points, whose GRID the deck does not hold")
    if not numbers:
        return None, notes
    size = values.shape[1]
    parts = _by_component(numbers, blocks, values).reshape(len(numbers), 2, 3, size)
    axes = np.array([deck.grids.axes(number) for number in numbers])
    if (axes != np.eye(3)).any():
        parts = axes[:, None] @ parts
    displacement, rotation = parts.transpose(1, 0, 2, 3).reshape(2, -1, size)
    return Shapes(numbers=np.array(numbers, np.int64), points=np.array([deck.grids.points[deck.grids.rows[number]] for number in numbers]),
                  displacement=displacement, rotation=rotation if rotation.any() else None), notes


def _by_component(numbers, blocks, values):
    """(p,6,n) values of points by component, zero for rows that do not exist. @param blocks: {number: {1 to 6: row}}"""
    result = np.zeros((len(numbers), 6, values.shape[1]))
    filled = [(k, component - 1, row) for k, number in enumerate(numbers) for component, row in blocks[number].items()]
    places, components, rows = np.array(filled, np.int64).reshape(-1, 3).T
    result[places, components] = scipy.sparse.csr_matrix(values)[rows].toarray()
    return result


def add_stress(shapes, blocks, values, name):
    """Adds stress xx yy zz yz xz xy, body axes, to the points of shapes. @param blocks: rows of each grid point: {number: {1 to 6: row}}
    @param values: scipy.sparse (rows, n) @returns notes"""
    places = {} if shapes is None else {int(number): row for row, number in enumerate(shapes.numbers)}
    found = [number for number in sorted(blocks) if number in places]
    if found:
        shapes.stress = _by_component(found, blocks, values).reshape(-1, values.shape[1])
        shapes.stress_points = np.array([places[number] for number in found], np.int64)
    missing = len(blocks) - len(found)
    return [f"left out: the stress {name} of {counted(missing, 'point')} whose displacements the file does not hold"] if missing else []


def blocks_of_rows(pairs):
    """Rows of each grid point by component. @param pairs: row of each pair of point and component"""
    blocks = {}
    for (number, component), row in pairs.items():
        if component != SCALAR:
            blocks.setdefault(number, {})[component] = row
    return blocks
