"""Writes a MatrixSet as an OUTPUT4 file, and a deck next to it that names the unknowns of its rows."""

import os

import scipy.sparse

from .nastran_deck import Numbering, form_of, left_out_of_deck, named_quantities, point_cards, shape_rows, table_cards
from .nastran_quantities import STRESS_AT_POINTS
from .nastran_tables import GRID, table_of
from .op4_binary import write_binary
from .op4_model import Op4Matrix
from .op4_text import write_text

NAMES = {"stiffness": "KAA", "mass": "MAA", "damping": "BAA", "geometric_stiffness": "KDAA"}
SHAPES, RECTANGULAR = "MUG1", 2
TEXT = "op4-text"         # the format by its name in `formats`; the other one is binary
DENSE_SHARE = 0.5         # matrices with a larger share of entries are written with their zeros


def nodes_beside(path):
    """Path of the deck that names the unknowns of an OUTPUT4 file."""
    return os.path.splitext(path)[0] + "-nodes.bdf"


def write(matrices, path, options):
    """@returns list of both paths"""
    shapes = matrices.shapes
    numbering = Numbering(matrices, shapes)
    _, order = numbering.sorted_pairs(matrices)
    members = {name: scipy.sparse.csr_matrix(getattr(matrices, member)) for member, name in NAMES.items()
               if getattr(matrices, member) is not None}
    written = [Op4Matrix(name, form_of(matrix), scipy.sparse.coo_matrix(matrix[order][:, order])) for name, matrix in members.items()]
    tables = []
    for name, rows, values in _recovery(matrices, numbering):
        written.append(Op4Matrix(name, RECTANGULAR, scipy.sparse.coo_matrix(values[:, order])))
        tables += rows
    dense = sum(matrix.nnz for matrix in members.values()) > DENSE_SHARE * len(members) * matrices.size**2
    (write_text if options.format == TEXT else write_binary)(path, written, sparse=not dense)
    nodes = nodes_beside(path)
    with open(nodes, "w", encoding="ascii") as file:
        file.write("\n".join(point_cards(matrices, numbering, shapes) + tables) + "\n")
    matrices.notes += numbering.notes + left_out_of_deck(matrices)
    return [path, nodes]


def _recovery(matrices, numbering):
    """Names, lines of the deck that name the rows, and values of the matrices of recovery."""
    shapes = matrices.shapes
    if shapes is not None:
        pairs, values = shape_rows(matrices, numbering, shapes)
        count = len(pairs) // len(shapes.points)
        yield SHAPES, table_cards(table_of(SHAPES), [(GRID, number, count, 1 + count * k) for k, number in enumerate(numbering.shapes)]), values
        if shapes.stress is not None:
            groups = [(GRID, number, 6, 1 + 6 * k) for k, number in enumerate(numbering.shapes[shapes.stress_points])]
            yield STRESS_AT_POINTS, table_cards(table_of(STRESS_AT_POINTS), groups), shapes.stress
    for name, (told, quantity) in named_quantities(matrices).items():
        yield name, told, quantity.matrix
