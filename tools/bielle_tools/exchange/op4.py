"""Matrices of bodies in an OUTPUT4 file of Nastran; a deck next to it has the order of the unknowns.

Matrices of the g-set (KGG) hold the unknowns of all points of the deck by ascending numbers, others those of the a-set
(ASET ..), or of all points if the deck declares none. DTI,TUG1 of the deck names the rows of MUG1: displacements of grid
points in their own axes; DTI,TES1 those of MES1 and so on (nastran_tables).
"""

import os

from ..decks.nastran_cards import read_cards
from ..messages import InputError, counted
from . import nastran_quantities, op4_binary, op4_text
from .matrix_set import mirrored, sparse
from .nastran_matrices import RECTANGULAR, add_stress, matrix_set, shapes_of
from .nastran_roles import left_out, matrices_by_role
from .nastran_tables import GRID, groups_of, table_of, unnamed_rows
from .nastran_unknowns import Deck
from .op4_writer import write  # noqa: F401  (the second half of this format)
from .op4_writer import nodes_beside
from .quantity_comments import told_quantities
from .recovery import STRESS


def read(path, options):
    """@returns MatrixSet @raises InputError"""
    found = _matrices(path)
    chosen = matrices_by_role(found, _matrices(options.mass) if options.mass else {}, options, path)
    nodes = options.nodes or _nodes_beside(path)
    deck = Deck(read_cards(nodes))
    unknowns = _order(deck, chosen["stiffness"], path)
    # One row of zeros stands for a matrix that does not exist.
    empty = [matrix for matrix in found.values() if matrix.entries.shape[0] == 1 != len(unknowns) and not matrix.entries.nnz]
    chosen = {role: matrix for role, matrix in chosen.items() if matrix not in empty}
    told = told_quantities(nodes)
    asked = {name: pair for name, pair in nastran_quantities.wanted(found, options.quantities, path, told).items() if pair[0] not in empty}
    notes = [] if options.nodes else [f"the order of the unknowns is that of '{nodes}'"]
    used = {**chosen, **{f"quantity {name}": matrix for name, (matrix, _) in asked.items()}}
    notes += left_out({name: matrix for name, matrix in found.items() if matrix not in empty}, used)
    members = {role: _square(matrix, len(unknowns), path, notes) for role, matrix in chosen.items() if role not in RECTANGULAR}
    if "shapes" in chosen:
        members["shapes"], more = _shapes(deck, chosen["shapes"], len(unknowns), path)
        notes += more
    if "stress" in chosen:
        notes += _add_stress(deck, chosen["stress"], members.get("shapes"), len(unknowns), path)
    members["quantities"] = {}
    for name, (matrix, kind) in asked.items():
        _check_columns(matrix, len(unknowns), path)
        members["quantities"][name], more = nastran_quantities.quantity(deck, matrix.name, kind, matrix.entries.toarray(), told=told.get(matrix.name))
        notes += more
    result = matrix_set(deck, unknowns, members, options, path, "Nastran OUTPUT4")
    result.notes += notes
    return result


def _matrices(path):
    try:
        with open(path, "rb") as file:
            begin = file.read(op4_binary.MARK)
    except OSError as error:
        raise InputError(f"cannot read '{path}': {error.strerror}") from None
    found = {}
    for matrix in op4_binary.read_binary(path) if op4_binary.kind_of(begin) else op4_text.read_text(path):
        if matrix.name in found:
            raise InputError(f"'{path}': there are two matrices '{matrix.name}'")
        found[matrix.name] = matrix
    if not found:
        raise InputError(f"'{path}': the file holds no matrices")
    return found


def _nodes_beside(path):
    nodes = nodes_beside(path)
    if not os.path.isfile(nodes):
        raise InputError(f"'{path}': an OUTPUT4 file does not name its unknowns: --nodes DECK gives the deck with GRID, SPOINT and ASET "
                         f"(there is no '{os.path.basename(nodes)}' beside it)")
    return nodes


def _order(deck, stiffness, path):
    """The unknowns of the stiffness. @raises InputError with both numbers"""
    size = stiffness.entries.shape[0]
    everything = deck.all_unknowns()
    whole = stiffness.name.endswith("GG") or not deck.a_set
    unknowns = everything if whole else sorted(deck.a_set)
    if size != len(unknowns):
        other = "" if whole else f" (and {len(everything)} in all)"
        raise InputError(f"'{path}': {stiffness.name} has {counted(size, 'row')}, but the deck has {counted(len(unknowns), 'unknown')}"
                         f"{' at all its points' if whole else ' in its a-set'}{other}")
    deck.check(unknowns, f"'{path}': the a-set of the deck ")
    return unknowns


def _square(matrix, size, path, notes):
    if matrix.entries.shape != (size, size):
        rows, columns = matrix.entries.shape
        raise InputError(f"'{path}': {matrix.name} has {rows} rows and {columns} columns for {counted(size, 'unknown')}")
    rows, columns = matrix.entries.row, matrix.entries.col
    if matrix.form == 6 and (rows != columns).any() and ((rows >= columns).all() or (rows <= columns).all()):
        notes.append(f"{matrix.name} is symmetric by its form and holds one triangle: the other one is the same")
        return mirrored(matrix.entries)
    if matrix.form not in (1, 6):
        raise InputError(f"'{path}': the form of {matrix.name} is {matrix.form}; expected 1 (square) or 6 (symmetric)")
    return sparse(matrix.entries)


def _check_columns(matrix, size, path):
    if matrix.entries.shape[1] != size:
        raise InputError(f"'{path}': {matrix.name} has {counted(matrix.entries.shape[1], 'column')} for {counted(size, 'unknown')}")


def _shapes(deck, matrix, size, path):
    """Shapes by the rows that DTI,TUG1 names, or None, and notes."""
    count = matrix.entries.shape[0]
    groups = groups_of(deck, matrix.name, count)
    if groups is None:
        return None, [f"left out: the shapes {matrix.name}: the deck has no DTI,{table_of(matrix.name)}, which names their rows"]
    _check_columns(matrix, size, path)
    blocks = {group.number: {k + 1: group.first + k for k in range(min(group.count, 6))} for group in groups if group.kind == GRID}
    shapes, notes = shapes_of(deck, blocks, matrix.entries)
    return shapes, notes + unnamed_rows(matrix.name, groups, count)


def _add_stress(deck, matrix, shapes, size, path):
    """Adds stress at points to their shapes. @returns notes"""
    count = matrix.entries.shape[0]
    groups = groups_of(deck, matrix.name, count)
    if groups is None:
        return [f"left out: the stress {matrix.name}: the deck has no DTI,{table_of(matrix.name)}, which names its rows"]
    _check_columns(matrix, size, path)
    wrong = next((group for group in groups if group.count != len(STRESS)), None)
    if wrong is not None:
        raise InputError(f"'{path}': DTI,{table_of(matrix.name)} gives the point {wrong.number} {counted(wrong.count, 'row')} of {matrix.name}; "
                         f"expected {len(STRESS)}: {' '.join(STRESS)}")
    blocks = {group.number: {k + 1: group.first + k for k in range(group.count)} for group in groups if group.kind == GRID}
    return add_stress(shapes, blocks, matrix.entries, matrix.name) + unnamed_rows(matrix.name, groups, count)
