"""Matrices in text files of Abaqus (.mtx).

The reader accepts substructures (`user_element`), assembled matrices of *MATRIX GENERATE (`abaqus_matrix_input`), each
line `node, component, node, component, value`, and FORMAT=COORDINATE, `row column value` in the order of the unknowns.
Nodes come from `options.nodes` or the deck of the same name. The writer makes a *USER ELEMENT with a deck of its nodes
(FILE_nodes.inp), whose set SCALARS has the nodes that carry scalar coordinates.
"""

import os

import numpy as np

from ..messages import InputError
from . import abaqus_matrix_input
from .axes import in_body_axes
from .entries import check_symmetric
from .job_files import beside, deck_of_nodes, first_line, stem, used_nodes
from .matrix_set import MatrixSet
from .node_table import places_of, read_nodes
from .user_element import UserElement, read_user_element, write_user_element


def recognises(path):
    """Tells whether a file is not a Matrix Market file."""
    return not first_line(path).startswith("%%MatrixMarket")


def read(path, options):
    """@raises InputError"""
    head = first_line(path, "**")
    if not head.startswith("*"):
        return abaqus_matrix_input.read(path, options)
    return read_substructure(path, options, "Abaqus")


def read_substructure(path, options, program):
    """The matrices of a *USER ELEMENT as a MatrixSet. @raises InputError"""
    nodes = read_nodes(options.nodes or beside(path, (".inp", "_nodes.inp", ".csv")))
    element = read_user_element(path)
    if options.mass:
        element.matrices.setdefault("mass", read_user_element(options.mass).matrices.get("mass"))
    for name in ("stiffness", "mass"):
        if element.matrices.get(name) is None:
            raise InputError(f"'{path}': holds no {name} matrix (*MATRIX, TYPE={name.upper()})" +
                             ("; --mass names a file that does" if name == "mass" else ""))
    place, components = places_of(path, element.labels, element.components, nodes)
    return MatrixSet(name=options.name or stem(path), source=f"{program} substructure, "
                                                             f"{os.path.basename(path)}", notes=element.notes,
                     **used_nodes(nodes, place), unknown_components=components, **element.matrices)


def write(matrices, path, options):
    """Writes FILE.mtx and FILE_nodes.inp. @returns their paths"""
    return write_substructure(matrices, path, single=False)


def write_substructure(matrices, path, single):
    """@param single: the form of CalculiX. @returns the paths. @raises InputError for a matrix that is not symmetric"""
    matrices = in_body_axes(matrices)
    check_symmetric(matrices)
    labels, deck = deck_of_nodes(matrices)
    order = np.lexsort((matrices.unknown_components, np.where(matrices.unknown_nodes < 0, labels.max() + 1, labels)))
    components = np.where(matrices.unknown_nodes < 0, 0, matrices.unknown_components)
    element = UserElement(labels[order], components[order], {
        name: matrix[order][:, order] for name, matrix in (("stiffness", matrices.stiffness), ("mass", matrices.mass),
                                                           ("damping", matrices.damping)) if matrix is not None})
    with open(path, "w", encoding="utf-8") as file:
        file.write(f"** {matrices.name}, of {matrices.source}\n")
        write_user_element(file, element, single)
    nodes = os.path.splitext(path)[0] + "_nodes.inp"
    with open(nodes, "w", encoding="utf-8") as file:
        file.write(deck)
    return [path, nodes]
