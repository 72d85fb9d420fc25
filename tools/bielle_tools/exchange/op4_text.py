"""OUTPUT4 files in text: a reader, and a writer of 17 digits, after which numbers of double precision are the same."""

import re

import numpy as np

from ..decks.nastran_cards import SHORT_EXPONENT
from ..messages import InputError
from ..text_lines import lines_of
from .op4_model import Columns, checked_header, columns_of, dense_part

NUMBERS = re.compile(r"(\d*)[EDG](\d+)\.\d+").search  # 1P,5E16.9: five in a line, each of 16 characters
LONG = "|I16"                                         # the header has integers of 16 characters
VALUES, WIDTH = 3, 23                                 # of the writer: 1P,3E23.16


def read_text(path):
    """@returns list of Op4Matrix @raises InputError with file and line"""
    reader = _Reader(path, lines_of(path))
    matrices = []
    while reader.more():
        matrices.append(reader.matrix())
    return matrices


class _Reader:
    def __init__(self, path, lines):
        self.path, self.lines, self.k = path, [line.rstrip() for line in lines], 0
        self.header = self.per_line = self.width = None

    def more(self):
        while self.k < len(self.lines) and not self.lines[self.k]:
            self.k += 1
        return self.k < len(self.lines)

    def fail(self, told):
        raise InputError(f"'{self.path}': line {self.k}: {told}")

    def line(self, expected):
        if self.k == len(self.lines) or self.k == len(self.lines) - 1 and not self.lines[self.k]:
            raise InputError(f"'{self.path}': the file ends after line {self.k}, in the middle of "
                             f"{repr(self.header.name) if self.header else 'a header'}: {expected} is missing")
        self.k += 1
        return self.lines[self.k - 1]

    def integers(self, count, expected):
        """Integers of equal width that fill a line."""
        text = self.line(expected)
        width = len(text) // count
        parts = [text[k * width:(k + 1) * width] for k in range(count)] if width * count == len(text) and width >= 8 else text.split()
        try:
            numbers = [int(part) for part in parts]
        except ValueError:
            numbers = []
        if len(numbers) != count:
            self.fail(f"expected {expected}, found '{text[:60]}'")
        return numbers

    def matrix(self):
        self.header = None
        self._read_header(self.line("a header"))
        columns = Columns(self.header, self.fail)
        while True:
            column, row, words = self.integers(3, "a column, its first row and its number of words")
            if column == self.header.columns + 1:
                self._values(1)
                return columns.matrix()
            columns.next_column(column)
            if row:
                self._count(words)
                columns.add(row, self._values(words))
            else:
                self._strings(columns, words)

    def _read_header(self, text):
        width = 16 if text.endswith(LONG) else 8
        if width == 16:
            text = text[:-len(LONG)]
        cuts = np.cumsum([0, width, width, 8, 8, 8])
        fields = [text[begin:end].strip() for begin, end in zip(cuts, cuts[1:])]
        try:
            numbers = [int(field) for field in fields[:4]]
        except ValueError:
            self.fail("expected the header of a matrix (columns, rows, form, type in fields of 8 characters, name, format), found "
                      f"'{text[:60]}'")
        self.header = checked_header(*numbers, fields[4].upper(), f"'{self.path}': line {self.k}: ")
        told = text[cuts[-1]:].strip().upper()
        form = NUMBERS(told or "5E16.9")
        if not form:
            self.fail(f"expected the format of numbers after the name, such as 1P,3E23.16, found '{told[:40]}'")
        self.per_line, self.width = int(form[1] or 1), int(form[2])
        if not 0 < self.per_line * self.width <= 1000:
            self.fail(f"the format '{told[:40]}' has {self.per_line} numbers of {self.width} characters in a line")

    def _count(self, count):
        if not 0 < count <= 2 * self.header.rows:
            self.fail(f"{count} values are more or fewer than a column of {self.header.rows} rows can have")

    def _strings(self, columns, words):
        """The strings of a column: words of their headers and values."""
        of_value = self.header.words * (2 if self.header.complex else 1)
        while words > 0:
            if self.header.big:
                length, row = self.integers(2, "the length and the row of a string")
                length, words = length - 1, words - length - 1
            else:
                first, = self.integers(1, "the length and the row of a string")
                length, row = first // 65536 - 1, first % 65536
                words -= length + 1
            if length <= 0 or length % of_value:
                self.fail(f"a string of {length} words does not hold whole numbers of {of_value} words")
            count = length // self.header.words
            self._count(count)
            columns.add(row, self._values(count))
        if words < 0:
            self.fail(f"the strings of column {columns.last} have more words than the column")

    def _values(self, count):
        texts = []
        for begin in range(0, count, self.per_line):
            here = min(self.per_line, count - begin)
            text = self.line(f"a line of {here} numbers")
            if len(text) != here * self.width:
                self.fail(f"expected {here} numbers of {self.width} characters, found {len(text)} characters")
            texts.append(text)
        joined = "".join(texts).upper().replace("D", "E")
        numbers = [joined[k:k + self.width] for k in range(0, len(joined), self.width)]
        try:
            return np.array([number if "E" in number else SHORT_EXPONENT.sub(r"E\1", number) for number in numbers]).astype(float)
        except ValueError:
            return self.fail(f"expected numbers, found '{text[:80]}'")


def write_text(path, matrices, sparse):
    """Writes matrices of double precision. @param sparse: as BIGMAT strings"""
    with open(path, "w", encoding="ascii") as file:
        for matrix in matrices:
            rows, columns = matrix.entries.shape
            file.write(f"{columns:8d}{-rows if sparse else rows:8d}{matrix.form:8d}{2:8d}{matrix.name:8s}1P,{VALUES}E{WIDTH}.{WIDTH - 7}\n")
            for column, strings in columns_of(matrix):
                if sparse:
                    _write_strings(file, column, strings)
                else:
                    first, values = dense_part(strings)
                    file.write(f"{column + 1:8d}{first + 1:8d}{len(values):8d}\n" + _lines(values))
            file.write(f"{columns + 1:8d}{1:8d}{1:8d}\n" + _lines([1.0]))


def _write_strings(file, column, strings):
    words = sum(2 + 2 * len(values) for _, values in strings)
    file.write(f"{column + 1:8d}{0:8d}{words:8d}\n")
    for row, values in strings:
        file.write(f"{1 + 2 * len(values):8d}{row + 1:8d}\n" + _lines(values))


def _lines(values):
    texts = [f"{value:{WIDTH}.{WIDTH - 7}E}" for value in values]
    texts = [text if len(text) == WIDTH else text.replace("E", "") for text in texts]  # exponents of three digits
    return "".join("".join(texts[k:k + VALUES]) + "\n" for k in range(0, len(texts), VALUES))
