"""A matrix of an OUTPUT4 file of Nastran, text or binary.

A matrix is a header, a record for each column that is not zero, and a last record for the column after the last one. A
column is dense (a first row and all values down to the last one that is not zero) or a list of strings of neighbouring
values, each with its length and first row. BIGMAT strings have two words for them, others one word, 65536 (length + 1) +
row. A word has 4 bytes, or 8 in files of 64 bits. (MSC Nastran DMAP Programmer's Guide, "OUTPUT4".)
"""

from dataclasses import dataclass

import numpy as np
import scipy.sparse

from ..messages import InputError

FORMS = {1: "square", 2: "rectangular", 3: "diagonal", 4: "lower triangular", 5: "upper triangular", 6: "symmetric", 8: "identity"}
MOST_ROWS_OF_SHORT_STRINGS = 65535  # longer columns have BIGMAT strings, whatever the header says
LARGEST = 2**31 - 1                 # rows and columns


@dataclass
class Header:
    """Contents of the header of a matrix."""

    name: str
    rows: int
    columns: int
    form: int
    kind: int       # 1, 2: real, single and double; 3, 4: complex, single and double
    big: bool       # BIGMAT

    @property
    def complex(self):
        """Tells whether each value has an imaginary part."""
        return self.kind > 2

    @property
    def words(self):
        """Number of words of a real number, in files of 32 bits and in the lengths of strings in text."""
        return 1 if self.kind in (1, 3) else 2


@dataclass(eq=False)
class Op4Matrix:
    """A matrix by its entries."""

    name: str
    form: int
    entries: scipy.sparse.coo_matrix  # the real parts
    complex: bool = False             # whether an imaginary part does not vanish


def checked_header(columns, rows, form, kind, name, place):
    """@param place: text before the sentence @raises InputError for a header that no matrix has"""
    if kind not in (1, 2, 3, 4):
        raise InputError(f"{place}the type of '{name}' is {kind}; expected 1 to 4 (real or complex, single or double)")
    if form not in FORMS:
        raise InputError(f"{place}the form of '{name}' is {form}; expected one of "
                         + ", ".join(f"{number} ({told})" for number, told in FORMS.items()))
    if not (0 < columns <= LARGEST and 0 < abs(rows) <= LARGEST):
        raise InputError(f"{place}'{name}' has {abs(rows)} rows and {columns} columns; expected 1 to {LARGEST}")
    return Header(name, abs(rows), columns, form, kind, rows < 0 or abs(rows) > MOST_ROWS_OF_SHORT_STRINGS)


class Columns:
    """Collects the columns of a matrix. fail: a function that raises InputError with the place in the file."""

    def __init__(self, header, fail):
        self.header, self.fail = header, fail
        self.rows, self.columns, self.values, self.last = [], [], [], 0
        self.imaginary = False

    def next_column(self, column):
        """Checks that the columns ascend."""
        if not self.last < column <= self.header.columns:
            self.fail(f"column {column} follows column {self.last} of '{self.header.name}', which has {self.header.columns}")
        self.last = column

    def add(self, row, values):
        """Adds values from a row of the present column downwards. @param row: from 1"""
        header = self.header
        if header.complex:
            self.imaginary |= bool(values[1::2].any())
            values = values[0::2]
        if not 0 < row <= header.rows - len(values) + 1:
            self.fail(f"column {self.last} of '{header.name}' has {len(values)} values from row {row}, but {header.rows} rows")
        self.rows.append(np.arange(row - 1, row - 1 + len(values)))
        self.columns.append(np.full(len(values), self.last - 1))
        self.values.append(values)

    def matrix(self):
        """The matrix of all columns so far."""
        parts = [np.concatenate(part) if part else np.zeros(0, kind) for part, kind in
                 ((self.rows, int), (self.columns, int), (self.values, float))]
        rows, columns, values = parts
        stored = values != 0
        shape = (self.header.rows, self.header.columns)
        entries = scipy.sparse.coo_matrix((values[stored], (rows[stored], columns[stored])), shape=shape)
        return Op4Matrix(self.header.name, self.header.form, entries, self.imaginary)


def columns_of(matrix):
    """The columns of a matrix that are not zero. @returns iterator of (column, strings), counted from 0; a string is a first
    row and neighbouring values that are not zero"""
    by_column = scipy.sparse.csc_matrix(matrix.entries)
    by_column.eliminate_zeros()
    by_column.sort_indices()
    for column, (begin, end) in enumerate(zip(by_column.indptr, by_column.indptr[1:])):
        if begin < end:
            rows, values = by_column.indices[begin:end], by_column.data[begin:end]
            breaks = np.flatnonzero(np.diff(rows) > 1) + 1
            yield column, [(int(part[0]), string) for part, string in zip(np.split(rows, breaks), np.split(values, breaks))]


def dense_part(strings):
    """The first row and the values from it to the last one of a column that is not zero."""
    first, (last, values) = strings[0][0], strings[-1]
    part = np.zeros(last + len(values) - first)
    for row, values in strings:
        part[row - first:row - first + len(values)] = values
    return first, part
