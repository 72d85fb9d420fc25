"""Matrices of bodies as DMIG cards of Nastran: what EXTSEOUT(DMIGPCH) of Nastran and PARAM,EXTOUT of OptiStruct write."""

import numpy as np
import scipy.sparse

from ..decks.nastran_cards import read_cards
from ..messages import InputError, counted
from . import nastran_quantities
from .dmig_cards import arrays, read_dmig
from .dmig_ends import check_columns, check_end, check_modal_mass, last_matrix
from .dmig_writer import write  # noqa: F401  (the second half of this format)
from .matrix_set import sparse
from .nastran_matrices import RECTANGULAR, add_stress, blocks_of_rows, matrix_set, shapes_of
from .nastran_roles import left_out, matrices_by_role
from .nastran_unknowns import SCALAR, Deck
from .quantity_comments import told_quantities


MOST_ROWS = 1_000_000
POINTS = ("GRID", "GRDSET", "CORD1R", "CORD1C", "CORD1S", "CORD2R", "CORD2C", "CORD2S")


def read(path, options):
    """@returns MatrixSet @raises InputError"""
    cards = read_cards(path)
    notes = check_end(cards)
    found = read_dmig(cards)
    if not found:
        raise InputError(f"'{path}': the deck holds no DMIG")
    last = last_matrix(cards)
    masses = read_cards(options.mass) if options.mass else []
    notes += check_end(masses)
    chosen = matrices_by_role(found, read_dmig(masses), options, path)
    if options.nodes:
        cards = read_cards(options.nodes) + [card for card in cards if card.name not in POINTS]
    deck = Deck(cards)
    squares = {role: matrix for role, matrix in chosen.items() if role not in RECTANGULAR}
    unknowns = _unknowns(deck, list(squares.values()))
    places = {pair: place for place, pair in enumerate(unknowns)}
    members = {role: _square(matrix, places) for role, matrix in squares.items()}
    told = told_quantities(path)
    asked = nastran_quantities.wanted(found, options.quantities, path, told)
    notes += left_out(found, {**chosen, **{f"quantity {name}": matrix for name, (matrix, _) in asked.items()}})
    check_modal_mass(deck, chosen["stiffness"], chosen["mass"])
    filled = sum(np.diff(scipy.sparse.csc_matrix(members[role]).indptr) for role in ("stiffness", "mass")) > 0
    modal = np.array([pair[1] == SCALAR or pair in deck.modal for pair in unknowns])
    for matrix in [chosen[role] for role in RECTANGULAR if role in chosen] + [matrix for matrix, _ in asked.values()]:
        _columns(matrix, places)
        if matrix.rectangular:
            notes += check_columns(matrix, filled, modal, matrix.name == last)
    if "shapes" in chosen:
        blocks, values = _rows_of_points(chosen["shapes"], places)
        members["shapes"], more = shapes_of(deck, blocks, values)
        notes += more
    if "stress" in chosen:
        notes += add_stress(members.get("shapes"), *_rows_of_points(chosen["stress"], places), chosen["stress"].name)
    members["quantities"] = {}
    for name, (matrix, kind) in asked.items():
        names = told.get(matrix.name)
        values, labels = _rows(matrix, places, len(names.rows) if names else 1)
        members["quantities"][name], more = nastran_quantities.quantity(deck, matrix.name, kind, values, labels, names)
        notes += more
    result = matrix_set(deck, unknowns, members, options, path, "Nastran DMIG")
    result.notes += notes
    return result


def _unknowns(deck, matrices):
    """Sorted pairs of all rows and columns of some matrices, and of the a-set if it is declared for them."""
    pairs = set()
    for matrix in matrices:
        asking = f"'{matrix.header.path}': DMIG {matrix.name} "
        if matrix.rectangular:
            raise InputError(f"'{matrix.header.path}': line {matrix.header.line}: DMIG {matrix.name} is rectangular (form {matrix.form}); "
                             "expected 1 (square) or 6 (symmetric)")
        own = {deck.named(*pair) for pair in matrix.columns} | {deck.named(*row) for row, _, _ in matrix.entries}
        deck.check(sorted(own), asking)
        pairs |= own
    if deck.a_set >= pairs:
        deck.check(sorted(deck.a_set), f"'{matrices[0].header.path}': the a-set ")
        pairs = deck.a_set
    return sorted(pairs)


def _square(matrix, places):
    by_name = _by_name(places)
    rows, columns, values = arrays(matrix, by_name, by_name)
    keys = rows * len(places) + columns
    order = np.argsort(keys, kind="stable")
    twice = np.flatnonzero(np.diff(keys[order]) == 0)
    if len(twice):
        _refuse(matrix, order[twice[0]], "has a row twice, once as component 0 and once as 1")
    if matrix.form == 6:
        return _completed(matrix, rows, columns, values, len(places))
    return sparse(scipy.sparse.coo_matrix((values, (rows, columns)), shape=(len(places),) * 2))


def _completed(matrix, rows, columns, values, size):
    """A symmetric matrix out of entries on either side of its diagonal."""
    low, high = np.minimum(rows, columns), np.maximum(rows, columns)
    keys = low * size + high
    order = np.argsort(keys, kind="stable")
    same = np.diff(keys[order]) == 0
    differing = np.flatnonzero(same & (np.diff(values[order]) != 0))
    if len(differing):
        _refuse(matrix, order[differing[0] + 1], "has an entry on both sides of the diagonal, with two values, but the form 6 (symmetric)")
    kept = order[np.concatenate([[True], ~same])] if len(order) else order
    low, high, values = low[kept], high[kept], values[kept]
    upper = low != high
    rows, columns = np.concatenate([low, high[upper]]), np.concatenate([high, low[upper]])
    return sparse(scipy.sparse.coo_matrix((np.concatenate([values, values[upper]]), (rows, columns)), shape=(size, size)))


def _refuse(matrix, entry, told):
    row, column, _ = matrix.entries[entry]
    raise InputError(f"'{matrix.header.path}': DMIG {matrix.name}, column {column[0]} {column[1]}, row {row[0]} {row[1]}: {told}")


def _columns(matrix, places):
    """Places of the columns of a matrix of recovery. Those of a rectangular one are counted in the order of the unknowns."""
    if matrix.rectangular:
        columns = {(number, 0): number - 1 for number in range(1, len(places) + 1)}
    else:
        columns = _by_name(places)
    strange = next((column for column in sorted(matrix.columns) if column not in columns), None)
    if strange is not None:
        raise InputError(f"'{matrix.header.path}': DMIG {matrix.name} has the column {strange[0]} {strange[1]}, which is none of the "
                         f"{len(places)} unknowns of the stiffness")
    if matrix.rectangular and matrix.width not in (0, len(places)):
        raise InputError(f"'{matrix.header.path}': line {matrix.header.line}: DMIG {matrix.name} has {counted(matrix.width, 'column')} for "
                         f"{counted(len(places), 'unknown')}")
    return columns


def _values(matrix, places, rows):
    """The rows of a matrix of recovery (scipy.sparse). @param rows: their places by pair"""
    columns = _columns(matrix, places)
    kept = [entry for entry in matrix.entries if entry[0] in rows]
    return scipy.sparse.coo_matrix(([value for _, _, value in kept], ([rows[row] for row, _, _ in kept], [columns[column] for _, column, _ in kept])),
                                   shape=(len(rows), len(places)))


def _rows_of_points(matrix, places):
    """Rows of each grid point, and the values."""
    pairs = sorted({row for row, _, _ in matrix.entries if row[1] != SCALAR})
    rows = {pair: row for row, pair in enumerate(pairs)}
    return blocks_of_rows(rows), _values(matrix, places, rows)


def _rows(matrix, places, least):
    """Values (k,n) and labels of the rows. Rows without components are counted; others are named by point and component, and those
    without entries are not known. @param least: number of rows at least, if they are counted"""
    pairs = sorted({row for row, _, _ in matrix.entries})
    if all(component == 0 for _, component in pairs):
        if pairs and pairs[-1][0] > MOST_ROWS:
            raise InputError(f"'{matrix.header.path}': DMIG {matrix.name} has the row {pairs[-1][0]}; rows of a quantity are counted from 1 to "
                             f"{MOST_ROWS} at most")
        pairs = [(number, 0) for number in range(1, max(pairs[-1][0] if pairs else 1, least) + 1)]
        labels = [f"row_{number}" for number, _ in pairs]
    else:
        labels = [f"row_{number}_{component}" for number, component in pairs]
    return _values(matrix, places, {pair: row for row, pair in enumerate(pairs)}).toarray(), labels


def _by_name(places):
    """Places of unknowns by all of their names: component 1 of a scalar point is the point itself."""
    return {**places, **{(number, 1): place for (number, component), place in places.items() if component == SCALAR}}
