"""DMIG cards of a Nastran deck: a header for each matrix, and a card for each of its columns.

The header has the form (1 square, 2 or 9 rectangular, 6 symmetric: one triangle), the type (1, 2 real; 3, 4 complex) and,
of rectangular matrices, the number of columns. A column names its point and component, then for each entry a point, a
component, the real and the imaginary part (or, with POLAR, amplitude and phase).
(MSC Nastran Quick Reference Guide, "DMIG".)
"""

import numpy as np

from ..messages import InputError

FORMS = {1: "square", 2: "rectangular", 6: "symmetric", 9: "rectangular"}


class DmigMatrix:
    """A matrix as its cards give it: rows and columns are pairs of point and component."""

    def __init__(self, header):
        """@raises InputError with file and line"""
        self.header, self.name = header, header.fields[1]
        self.form, kind = header.integer(3), header.integer(4)
        if self.form not in FORMS:
            header.fail(3, "a form: 1 (square), 2 or 9 (rectangular) or 6 (symmetric)")
        if kind not in (1, 2, 3, 4):
            header.fail(4, "a type: 1 to 4")
        self.width = header.integer(8, 0)  # columns of a rectangular matrix
        self.complex = False
        self.columns, self.entries = set(), []  # an entry: row pair, column pair, value

    @property
    def rectangular(self):
        """Tells whether columns are numbers rather than unknowns."""
        return self.form in (2, 9)

    def add(self, card):
        """Adds a column."""
        column = (card.integer(2), card.integer(3, 0))
        if column[0] < 0 or not 0 <= column[1] <= 6:
            self.fail(card, column, "is none: expected a number from 1 on and a component of 0 to 6")
        if column in self.columns:
            self.fail(card, column, "stands twice")
        self.columns.add(column)
        fields, rows = card.fields, set()
        for k in range(5, len(fields), 4):
            texts = (fields[k:k + 4] + [""] * 3)[:4]
            if not any(texts):
                continue
            try:
                row, value, imaginary = (card.integer(k), card.integer(k + 1, 0)), card.number(k + 2, None), card.number(k + 3, 0.0)
            except InputError:
                value = None
            if value is None:
                self.fail(card, column, f"has an entry of {texts}; expected a point, a component, a real and perhaps an imaginary part")
            if row[0] <= 0 or not 0 <= row[1] <= 6:
                self.fail(card, column, f"has the row {row[0]} {row[1]}; expected a number from 1 on and a component of 0 to 6")
            if row in rows:
                self.fail(card, column, f"has the row {row[0]} {row[1]} twice")
            rows.add(row)
            self.complex |= imaginary != 0
            self.entries.append((row, column, value))

    def fail(self, card, column, told):
        """@raises InputError with file, line and column"""
        raise InputError(f"'{card.path}': line {card.line}: the column {column[0]} {column[1]} of DMIG {self.name} {told}")


def read_dmig(cards):
    """@returns DmigMatrix by name @raises InputError with file and line"""
    matrices = {}
    for card in cards:
        if card.name != "DMIG":
            continue
        name = card.fields[1]
        if card.integer(2) == 0:
            if name in matrices:
                raise InputError(f"'{card.path}': line {card.line}: there is a second header of DMIG {name} (the first: line "
                                 f"{matrices[name].header.line})")
            matrices[name] = DmigMatrix(card)
        elif name not in matrices:
            raise InputError(f"'{card.path}': line {card.line}: DMIG {name}: no header (DMIG, {name}, 0, form, type ..) stands before its columns")
        else:
            matrices[name].add(card)
    return matrices


def arrays(matrix, rows, columns):
    """Rows, columns and values of a matrix. @param rows, columns: places of the pairs"""
    count = len(matrix.entries)
    return (np.fromiter((rows[row] for row, _, _ in matrix.entries), np.int64, count),
            np.fromiter((columns[column] for _, column, _ in matrix.entries), np.int64, count),
            np.fromiter((value for _, _, value in matrix.entries), float, count))
