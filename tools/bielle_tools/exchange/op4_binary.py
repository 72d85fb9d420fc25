"""OUTPUT4 files in binary form: Fortran's records, of either order of bytes, with words of 4 or 8 bytes.

Each record stands between two marks of its length. The header has 4 integers and 8 characters (16 in files of 64 bits), so
that the first mark, 24 or 48, tells the order of the bytes and the size of a word.
"""

import numpy as np

from ..messages import InputError
from .op4_model import Columns, checked_header, columns_of, dense_part

HEADER_BYTES = {24: 4, 48: 8}  # bytes of a word by those of the header
MARK = 4


def kind_of(begin):
    """Order of bytes and bytes of a word by the first bytes of a file; None: it is a text."""
    for order in "<>":
        if len(begin) >= MARK:
            size = int(np.frombuffer(begin[:MARK], order + "i4")[0])
            if size in HEADER_BYTES:
                return order, HEADER_BYTES[size]
    return None


def read_binary(path):
    """@returns list of Op4Matrix @raises InputError with the place in the file"""
    with open(path, "rb") as file:
        reader = _Reader(path, file.read())
    matrices = []
    while reader.at < len(reader.data):
        matrices.append(reader.matrix())
    return matrices


class _Reader:
    def __init__(self, path, data):
        self.path, self.data, self.at = path, data, 0
        self.order, self.word = kind_of(data)
        self.integer, self.begin, self.inside = f"{self.order}i{self.word}", 0, ""

    def fail(self, told):
        raise InputError(f"'{self.path}': byte {self.begin}: {told}")

    def record(self):
        """The contents of the next record."""
        self.begin = self.at
        size = self._mark(self.at)
        end = self.at + MARK + size
        if size < 3 * self.word or size % 4 or end + MARK > len(self.data):
            self.fail(f"expected a record{self.inside}, found one of {size} bytes in the {len(self.data) - self.at} bytes that are left; the file is "
                      "truncated or damaged")
        if self._mark(end) != size:
            self.fail(f"a record{self.inside} begins with the length {size} and ends with {self._mark(end)}; the file is damaged")
        self.at = end + MARK
        return self.data[self.begin + MARK:end]

    def _mark(self, at):
        if at + MARK > len(self.data):
            self.fail(f"the file ends where a record{self.inside} is expected")
        return int(np.frombuffer(self.data, self.order + "i4", 1, at)[0])

    def matrix(self):
        self.inside = ""
        record = self.record()
        if len(record) != 6 * self.word:
            self.fail(f"expected the header of a matrix, {6 * self.word} bytes, found a record of {len(record)}")
        numbers = [int(number) for number in np.frombuffer(record, self.integer, 4)]
        # Words of 8 bytes hold 4 characters and 4 blanks.
        name = "".join(record[4 * self.word:].decode("latin-1").replace("\0", " ").split()).upper()
        if not name.isprintable():
            self.fail("the name in the header of a matrix is not text")
        header = checked_header(*numbers, name, f"'{self.path}': byte {self.begin}: ")
        self.inside = f" of '{name}'"
        columns = Columns(header, self.fail)
        while True:
            record = self.record()
            column, row, words = (int(number) for number in np.frombuffer(record, self.integer, 3))
            content = record[3 * self.word:]
            if column == header.columns + 1:
                return columns.matrix()
            if words * self.word != len(content):
                self.fail(f"column {column} of '{name}' tells {words} words in a record of {len(content) // self.word}")
            columns.next_column(column)
            if row:
                columns.add(row, self._reals(header, content))
            else:
                self._strings(header, content, columns)

    def _reals(self, header, content):
        single = header.kind in (1, 3) and self.word == 4
        count = 2 if header.complex else 1
        if not content or len(content) % ((4 if single else 8) * count):
            self.fail(f"{len(content)} bytes do not hold whole numbers of the type {header.kind} of '{header.name}'")
        return np.frombuffer(content, self.order + ("f4" if single else "f8")).astype(float)

    def _strings(self, header, content, columns):
        at, of_header = 0, 2 * self.word if header.big else self.word
        while at < len(content):
            if at + of_header > len(content):
                self.fail(f"a string of column {columns.last} of '{header.name}' goes over the end of the column")
            first = [int(number) for number in np.frombuffer(content, self.integer, of_header // self.word, at)]
            length, row = (first[0] - 1, first[1]) if header.big else (first[0] // 65536 - 1, first[0] % 65536)
            begin, end = at + of_header, at + of_header + length * self.word
            if length <= 0 or end > len(content):
                self.fail(f"a string of column {columns.last} of '{header.name}' has {length} words, but "
                          f"{(len(content) - begin) // self.word} are left")
            columns.add(row, self._reals(header, content[begin:end]))
            at = end


def write_binary(path, matrices, sparse, order="<"):
    """Writes matrices of double precision with words of 4 bytes. @param sparse: as BIGMAT strings @param order: < or >"""
    integer, real = order + "i4", order + "f8"
    with open(path, "wb") as file:
        def write(*parts):
            content = b"".join(parts)
            mark = np.array([len(content)], integer).tobytes()
            file.write(mark + content + mark)

        def integers(*numbers):
            return np.array(numbers, integer).tobytes()

        for matrix in matrices:
            rows, columns = matrix.entries.shape
            write(integers(columns, -rows if sparse else rows, matrix.form, 2), f"{matrix.name:8s}".encode())
            for column, strings in columns_of(matrix):
                if sparse:
                    words = sum(2 + 2 * len(values) for _, values in strings)
                    write(integers(column + 1, 0, words), *(integers(1 + 2 * len(values), row + 1) + values.astype(real).tobytes()
                                                            for row, values in strings))
                else:
                    first, values = dense_part(strings)
                    write(integers(column + 1, first + 1, 2 * len(values)), values.astype(real).tobytes())
            write(integers(columns + 1, 1, 2), np.array([1.0], real).tobytes())
