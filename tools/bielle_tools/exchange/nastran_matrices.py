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
    values = scipy.sparse.csr_matrix(values)
    size = values.shape[1]
    parts = np.zeros((2, len(numbers), 3, size))
    for k, number in enumerate(numbers):
        axes = deck.grids.axes(number)
        for component, row in blocks[number].items():
            parts[(component - 1) // 3, k, (component - 1) % 3] = values[row].toarray().ravel()
        parts[:, k] = axes @ parts[:, k]
    displacement, rotation = parts.reshape(2, -1, size)
    return Shapes(numbers=np.array(numbers, np.int64), points=np.array([deck.grids.points[deck.grids.rows[number]] for number in numbers]),
                  displacement=displacement, rotation=rotation if rotation.any() else None), notes


def add_stress(shapes, blocks, values, name):
    """Adds stress xx yy zz yz xz xy, body axes, to the points of shapes. @param blocks: rows of each grid point: {number: {1 to 6: row}}
    @param values: scipy.sparse (rows, n) @returns notes"""
    places = {} if shapes is None else {int(number): row for row, number in enumerate(shapes.numbers)}
    found = [number for number in sorted(blocks) if number in places]
    values = scipy.sparse.csr_matrix(values)
    stress = np.zeros((len(found), 6, values.shape[1]))
    for k, number in enumerate(found):
        for component, row in blocks[number].items():
            stress[k, component - 1] = values[row].toarray().ravel()
    if found:
        shapes.stress, shapes.stress_points = stress.reshape(-1, values.shape[1]), np.array([places[number] for number in found], np.int64)
    missing = len(blocks) - len(found)
    return [f"left out: the stress {name} of {counted(missing, 'point')} whose displacements the file does not hold"] if missing else []


def blocks_of_rows(pairs):
    """Rows of each grid point by component. @param pairs: row of each pair of point and component"""
    blocks = {}
    for (number, component), row in pairs.items():
        if component != SCALAR:
            blocks.setdefault(number, {})[component] = row
    return blocks
