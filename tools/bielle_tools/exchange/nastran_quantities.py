"""Recovered quantities of Nastran's matrices: those of EXTSEOUT by their usual names, and others that the user names.

MES1, MEE1 and MEF1 recover stress, strain and forces of elements, MQG1 and MQMG1 forces of supports and of rigid elements at
grid points; a table of the deck names their rows. OTM1, OTM2 .. of a deck that Bielle writes have their names in comments.
MGS1, which Bielle writes, has the stress at grid points, six rows of each: xx yy zz yz xz xy in axes of the body.
"""

from ..messages import InputError, counted
from .nastran_tables import groups_of, rows_of_elements, rows_of_points, unnamed_rows
from .recovery import KINDS, UNKNOWN, Quantity

STRESS_AT_POINTS = "MGS1"
# By matrix: name of the quantity, unit of its rows (None: forces); whether they are rows of points.
USUAL = {"MES1": ("element_stress", "Pa", False), "MEE1": ("element_strain", "m/m", False), "MEF1": ("element_force", None, False),
         "MQG1": ("support_force", None, True), "MQMG1": ("constraint_force", None, True)}


def is_recovery(name):
    """Tells whether a matrix is read as a quantity without a request."""
    return name in USUAL


def wanted(found, requests, path, told):
    """Matrices of quantities: {name: (matrix, kind or None)}. @param found: matrices by name @param requests: those of the user
    @param told: quantities that comments name @raises InputError for a matrix that is missing"""
    chosen = {}
    for name, request in requests.items():
        matrix = request.matrix.upper()
        if matrix not in found:
            raise InputError(f"'{path}': there is no matrix '{matrix}', which the quantity '{name}' takes; there are {', '.join(sorted(found))}")
        chosen[name] = (found[matrix], request.kind)
    named = {id(matrix) for matrix, _ in chosen.values()}
    for matrix, name in [(matrix, name) for matrix, (name, _, _) in USUAL.items()] + [(matrix, each.name) for matrix, each in told.items()]:
        if matrix in found and id(found[matrix]) not in named and name not in chosen:
            chosen[name] = (found[matrix], None)
    return chosen


def quantity(deck, name, kind, values, labels=None, told=None):
    """A quantity of a matrix, and notes; None with a note if nothing names the units of its rows.

    @param kind: the requested one; None: a usual matrix @param values: (k,n) @param labels: names of the rows if no table gives them
    @param told: names that comments give, or None"""
    count = len(values)
    groups = groups_of(deck, name, count)
    _, unit, points = USUAL.get(name, ("", None, False))
    notes = []
    if told is not None and len(told.rows) != count:
        notes.append(f"comments of the deck name {counted(len(told.rows), 'row')} of {name}, which has {count}: their names are not used")
        told = None
    if told is not None:
        rows = dict(enumerate(zip(told.rows, told.units)))
    elif groups is None:
        rows = {k: (label, unit or UNKNOWN) for k, label in enumerate(labels or [f"row_{k + 1}" for k in range(count)])}
    elif points:
        rows = rows_of_points(groups)
    else:
        rows = rows_of_elements(groups, unit)
    if kind is not None:
        rows = {k: (label, KINDS[kind]) for k, (label, _) in rows.items()}
    places = sorted(rows)
    notes += unnamed_rows(name, groups, count) if groups else []
    unknown = sum(rows[k][1] == UNKNOWN for k in places)
    if unknown:
        notes.append(f"the units of {counted(unknown, 'row')} of {name} are not known: their numbers stay as they are in the file; a request "
                     "with a kind converts them")
    return Quantity([rows[k][0] for k in places], [rows[k][1] for k in places], values[places]), notes
