"""Tables by which a Nastran deck names the rows of a recovery matrix: DTI,TUG1 those of MUG1, DTI,TES1 those of MES1.

The second record of a table lists groups of four numbers: type, number, count of rows, first row. Type 1 is a grid point,
2 a scalar point; of a table of elements it is the number of the type of element. (MSC Nastran Quick Reference Guide,
"EXTSEOUT", "DTI"; the element types of the items codes.)
"""

from dataclasses import dataclass

from ..messages import InputError, counted
from .matrix_set import COMPONENTS
from .recovery import UNKNOWN

HEADING = ("TYPE", "ID", "COMP", "ROW", "ENDREC")
GRID, SCALAR_POINT = 1, 2
ELEMENTS = {1: "crod", 2: "cbeam", 4: "cshear", 10: "conrod", 11: "celas1", 12: "celas2", 13: "celas3", 14: "celas4", 33: "cquad4",
            34: "cbar", 39: "ctetra", 40: "cbush1d", 64: "cquad8", 67: "chexa", 68: "cpenta", 70: "ctriar", 74: "ctria3",
            75: "ctria6", 82: "cquadr", 100: "cbar", 102: "cbush", 144: "cquad4"}
# Forces of the elements whose rows have different units: the items in Nastran's order.
BAR_FORCE = (("bend_a1", "N m"), ("bend_a2", "N m"), ("bend_b1", "N m"), ("bend_b2", "N m"), ("shear1", "N"), ("shear2", "N"),
             ("axial", "N"), ("torque", "N m"))
BUSH_FORCE = (("fx", "N"), ("fy", "N"), ("fz", "N"), ("mx", "N m"), ("my", "N m"), ("mz", "N m"))
ROD_FORCE = (("axial", "N"), ("torque", "N m"))
FORCES = {34: BAR_FORCE, 102: BUSH_FORCE, 1: ROD_FORCE, 10: ROD_FORCE}


@dataclass(frozen=True)
class Group:
    """Neighbouring rows of one point or element."""

    kind: int
    number: int
    count: int
    first: int   # from 0


def table_of(matrix):
    """Name of the table that belongs to a matrix: TUG1 of MUG1."""
    return "T" + matrix[1:]


def groups_of(deck, matrix, rows):
    """Groups of a matrix that has a number of rows; None if the deck has no such table. @raises InputError with file and line"""
    table = table_of(matrix)
    card = next((card for card in deck.cards if card.name == "DTI" and card.fields[1:3] == [table, "2"]), None)
    if card is None:
        return None
    filled = [k for k in card.filled(3) if card.fields[k] not in HEADING]
    if len(filled) % 4:
        raise InputError(f"'{card.path}': line {card.line}: DTI,{table},2 has {len(filled)} fields; expected groups of 4: type, point, components, row")
    groups, taken = [], {}
    for kind, number, count, row in zip(*(filled[k::4] for k in range(4))):
        group = Group(card.integer(kind), card.integer(number), card.integer(count), card.integer(row) - 1)
        if not (0 < group.count <= rows and 0 <= group.first <= rows - group.count):
            card.fail(row, f"rows of {matrix}, which has {rows}")
        for place in range(group.first, group.first + group.count):
            if taken.setdefault(place, number) != number:
                card.fail(row, f"rows of {matrix} that no other entry has: row {place + 1} stands twice")
        groups.append(group)
    return groups


def unnamed_rows(matrix, groups, rows):
    """Notes on rows of a matrix that its table does not name. @param rows: their number"""
    missing = rows - sum(group.count for group in groups)
    return [f"left out: {counted(missing, 'row')} of {matrix} that DTI,{table_of(matrix)} does not name"] if missing > 0 else []


def rows_of_elements(groups, unit):
    """Name and unit of each row of elements. @param unit: of all rows; None: forces, whose units the type of element tells"""
    named = {}
    for group in groups:
        known = FORCES.get(group.kind, ()) if unit is None else ()
        for k in range(group.count):
            item, its_unit = known[k] if group.count == len(known) else (str(k + 1), unit or UNKNOWN)
            named[group.first + k] = (f"{ELEMENTS.get(group.kind, f'type{group.kind}')}_{group.number}_{item}", its_unit)
    return named


def rows_of_points(groups):
    """Name and unit of each row of forces at points."""
    named = {}
    for group in groups:
        for k in range(group.count):
            item = COMPONENTS[k] if group.kind == GRID else "value"
            named[group.first + k] = (f"node_{group.number}_{item}", "N" if k < 3 else "N m")
    return named
