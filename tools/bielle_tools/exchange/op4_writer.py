"""Writes a MatrixSet as an OUTPUT4 file, and a deck next to it that names the unknowns of its rows."""

import os

import scipy.sparse

from .nastran_deck import Numbering, form_of, left_out_of_deck, point_cards
from .op4_binary import write_binary
from .op4_model import Op4Matrix
from .op4_text import write_text

NAMES = {"stiffness": "KAA", "mass": "MAA", "damping": "BAA", "geometric_stiffness": "KDAA"}
TEXT = "op4-text"         # the format by its name in `formats`; the other one is binary
DENSE_SHARE = 0.5         # matrices with a larger share of entries are written with their zeros


def nodes_beside(path):
    """Path of the deck that names the unknowns of an OUTPUT4 file."""
    return os.path.splitext(path)[0] + "-nodes.bdf"


def write(matrices, path, options):
    """@returns list of both paths"""
    numbering = Numbering(matrices, None)
    _, order = numbering.sorted_pairs(matrices)
    members = {name: scipy.sparse.csr_matrix(getattr(matrices, member)) for member, name in NAMES.items()
               if getattr(matrices, member) is not None}
    written = [Op4Matrix(name, form_of(matrix), scipy.sparse.coo_matrix(matrix[order][:, order])) for name, matrix in members.items()]
    dense = sum(matrix.nnz for matrix in members.values()) > DENSE_SHARE * len(members) * matrices.size**2
    (write_text if options.format == TEXT else write_binary)(path, written, sparse=not dense)
    nodes = nodes_beside(path)
    with open(nodes, "w", encoding="ascii") as file:
        file.write("\n".join(point_cards(matrices, numbering, None)) + "\n")
    matrices.notes += numbering.notes + left_out_of_deck(matrices)
    if matrices.shapes is not None:
        matrices.notes.append("left out: the shapes")
    return [path, nodes]
