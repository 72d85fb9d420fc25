"""Tests of OUTPUT4 files of Nastran: every layout is read, written files are read back, and damaged files give one
sentence.

The layouts are those of the files of the package pyYeti (github.com/twmacro/pyyeti, pyyeti/tests/nastran_op4_data), which
Nastran wrote.
"""

import unittest

import numpy as np
import scipy.sparse

from box_mesh import InFolder
from op4_samples import LAYOUTS, binary, text
from bielle_tools.exchange import op4_binary, op4_text
from bielle_tools.exchange.op4_model import Op4Matrix
from bielle_tools.messages import InputError


def sample(rows=9, count=7, seed=2, complexity=0):
    """Returns a matrix with empty columns and gaps."""
    random = np.random.default_rng(seed)
    matrix = random.standard_normal((rows, count)) * 10.0 ** random.integers(-9, 9, (rows, count))
    matrix[random.random((rows, count)) < 0.4] = 0
    matrix[:, 2] = 0
    return matrix * (1 + complexity * 1j) if complexity else matrix


class Op4(InFolder):
    def read(self, content):
        path = self.path("matrices.op4")
        with open(path, "wb") as file:
            file.write(content if isinstance(content, bytes) else content.encode())
        known = op4_binary.kind_of(content[:4]) if isinstance(content, bytes) else None
        return op4_binary.read_binary(path) if known else op4_text.read_text(path)

    def check(self, content, matrices, digits=1e-16):
        found = self.read(content)
        self.assertEqual([matrix.name for matrix in found], list(matrices))
        for matrix, expected in zip(found, matrices.values()):
            expected = np.real(expected)
            self.assertEqual(matrix.entries.shape, expected.shape)
            self.assertTrue((abs(matrix.entries.toarray() - expected) <= digits * abs(expected)).all())
            self.assertFalse(matrix.complex)

    def refuse(self, content, told):
        with self.assertRaises(InputError) as caught:
            self.read(content)
        self.assertIn(told, str(caught.exception))


class Layouts(Op4):
    def test_binary(self):
        for layout in LAYOUTS:
            for order in "<>":
                for word in (4, 8):
                    for kind in (1, 2, 3, 4):
                        with self.subTest(layout=layout, order=order, word=word, kind=kind):
                            matrices = {"KAA": sample(), "LONGNAME": sample(3, 9, 5), "NULL": np.zeros((4, 2))}
                            digits = 2**-24 if kind in (1, 3) and word == 4 else 0
                            self.check(binary(matrices, layout, order, word, kind), matrices, digits)

    def test_text(self):
        for layout in LAYOUTS:
            for kind in (1, 2, 3, 4):
                for numbers, digits in (("1P,3E23.16", 1e-16), ("1P,5E16.9", 5e-10), ("1P,5D16.9", 5e-10), ("1P,3E21.14", 5e-15)):
                    with self.subTest(layout=layout, kind=kind, numbers=numbers):
                        matrices = {"KAA": sample(), "LONGNAME": sample(3, 9, 5), "NULL": np.zeros((4, 2))}
                        content = text(matrices, layout, kind, numbers=numbers)
                        self.check(content, matrices, digits)
                        self.check(content.replace("\n", "\r\n"), matrices, digits)
                        self.check(text(matrices, layout, kind, numbers=numbers, wide_header=True), matrices, digits)

    def test_by_hand(self):
        self.check("       3       2       2       2A       1P,5E16.9\n"
                   "       1       1       2\n"
                   " 1.500000000E+00-2.500000000D+00\n"
                   "       3       2       1\n"
                   " 1.000000000-101\n"  # an exponent of three digits has no letter
                   "       4       1       1\n"
                   " 1.000000000E+00\n", {"A": np.array([[1.5, 0, 0], [-2.5, 0, 1e-101]])}, 0)

    def test_imaginary_parts(self):
        for layout in LAYOUTS:
            for content in (binary({"A": sample(complexity=0.5)}, layout, kind=4), text({"A": sample(complexity=0.5)}, layout, kind=4)):
                found, = self.read(content)
                self.assertTrue(found.complex)

    def test_more_rows_than_short_strings_have(self):
        matrix = np.zeros((70000, 2))
        matrix[[5, 69998, 69999], [0, 1, 1]] = 1, 2, 3
        for content in (binary({"A": matrix}, "big").replace(np.int32(-70000).tobytes(), np.int32(70000).tobytes()), binary({"A": matrix}),
                        text({"A": matrix}, "big")):
            self.check(content, {"A": matrix})


class Writing(Op4):
    def test_every_form(self):
        matrices = {"KAA": sample(), "TINY": sample() * 1e-300, "LARGE": sample() * 1e290, "NULL": np.zeros((4, 2))}
        written = [Op4Matrix(name, 2, scipy.sparse.coo_matrix(matrix)) for name, matrix in matrices.items()]
        for sparse in (False, True):
            for order in "<>":
                op4_binary.write_binary(self.path("a.op4"), written, sparse, order)
                with open(self.path("a.op4"), "rb") as file:
                    content = file.read()
                self.assertEqual(op4_binary.kind_of(content), (order, 4))
                self.check(content, matrices, 0)
            # The content is the last matrix of this name.
            self.assertEqual(content, binary(matrices, "big" if sparse else "dense", ">", form=2))
            op4_text.write_text(self.path("b.op4"), written, sparse)
            with open(self.path("b.op4"), encoding="ascii") as file:
                content = file.read()
            self.check(content, matrices, 0)


class Damaged(Op4):
    def test_truncated_anywhere(self):
        matrices = {"KAA": sample(4, 3), "MAA": sample(4, 3, 4)}
        first = {"KAA": matrices["KAA"]}
        for layout in LAYOUTS:
            for write in (lambda which: binary(which, layout), lambda which: binary(which, layout, ">", 8), lambda which: text(which, layout).encode()):
                content, whole = write(matrices), write(first).rstrip()
                for length in range(10, len(content) - 1):
                    if content[:length].rstrip() != whole:
                        with self.assertRaises(InputError, msg=(layout, length)):
                            self.read(content[:length])

    def test_flipped_bytes(self):
        random = np.random.default_rng(7)
        matrices = {"KAA": sample(4, 3), "MAA": sample(4, 3, 4)}
        for layout in LAYOUTS:
            for content in (binary(matrices, layout), binary(matrices, layout, ">", 8), text(matrices, layout).encode()):
                for _ in range(300):
                    damaged = bytearray(content)
                    for place in random.integers(0, len(content), random.integers(1, 4)):
                        damaged[place] = random.integers(0, 256)
                    try:
                        self.read(bytes(damaged))
                    except InputError:
                        pass

    def test_sentences(self):
        good = text({"KAA": sample(4, 3)})
        header, rest = good.split("\n", 1)
        for content, told in (
                ("hello\n" + good, "line 1: expected the header of a matrix (columns, rows, form, type in fields of 8 characters"),
                (header.replace("       2KAA", "       7KAA") + "\n" + rest, "line 1: the type of 'KAA' is 7; expected 1 to 4"),
                (header.replace("       6", "       7", 1) + "\n" + rest, "line 1: the form of 'KAA' is 7; expected one of 1 (square), 2 (rect"),
                (header.replace("1P,3E23.16", "(free)") + "\n" + rest, "line 1: expected the format of numbers after the name, such as 1P,3E23.16"),
                (header + "\n       9       1       1\n", "line 2: column 9 follows column 0 of 'KAA', which has 3"),
                (header + "\n       1       5       1\n 1.0000000000000000E+00\n", "line 3: column 1 of 'KAA' has 1 values from row 5, but 4 rows"),
                (header + "\n       1       1       1\n 1.00000000E+00\n", "line 3: expected 1 numbers of 23 characters, found 15 characters"),
                (header + "\n       1       1       1\n 1.0000000000000000X+00\n", "line 3: expected numbers, found ' 1.0000000000000000X+00'"),
                (header + "\n       1       1\n", "line 2: expected a column, its first row and its number of words, found '       1       1'"),
                (header + "\n", "the file ends after line 1, in the middle of 'KAA'")):
            with self.subTest(told):
                self.refuse(content, told)
        data = binary({"KAA": sample(4, 3)})
        self.refuse(data[:-4] + b"\1\0\0\0", "a record of 'KAA' begins with the length 20 and ends with 1; the file is damaged")
        self.refuse(data[:100], "the file is truncated or damaged")


if __name__ == "__main__":
    unittest.main()
