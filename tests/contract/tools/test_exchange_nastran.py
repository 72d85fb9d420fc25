"""Tests of matrices of bodies in decks of Nastran (DMIG) and in OUTPUT4 files with a deck: unknowns, axes, sets,
shapes.

The decks have the layout of those of the package pyYeti (pyyeti/tests/nastran_dmig_data, nas2cam_extseout), which Nastran
wrote.
"""

import dataclasses
import unittest

import numpy as np

from box_mesh import InFolder
from exchange_bodies import cloud_body
from exchange_samples import assert_same, beam, shuffled, turned, with_modes
from op4_samples import binary, text
from bielle_tools.exchange import dmig, op4
from bielle_tools.exchange.formats import Options
from bielle_tools.exchange.nastran_deck import number_of, wide_number
from bielle_tools.messages import InputError

STEEL = (210e9, 7800.0, 0.5, 0.02)

# Two masses of 2 and 3 are connected by a spring of 10 along x with damping 0.1; a modal coordinate of stiffness 5 is
# coupled with the second mass.
SMALL = """$ a comment
GRID           1              0.      0.      0.
GRID           2              2.      0.      0.
SPOINT        11
ASET1          1       1       2
QSET1          0      11
DMIG    KAAX           0       6       2       0
DMIG    KAAX           1       1               1       1     10.
               2       1    -10.
DMIG    KAAX           2       1               2       1     10.
DMIG    KAAX          11       0              11       0      5.
DMIG    MAAX           0       6       2       0
DMIG    MAAX           1       1               1       1      2.
DMIG    MAAX           2       1               2       1      3.
              11       0      .5
DMIG    MAAX          11       0              11       0      1.
"""
STIFFNESS = np.array([[10, -10, 0], [-10, 10, 0], [0, 0, 5]])
MASS = np.array([[2, 0, 0], [0, 3, 0.5], [0, 0.5, 1]])


class Decks(InFolder):
    def read(self, deck, name="deck.pch", **options):
        return dmig.read(self.write(name, deck), Options(**options))

    def refuse(self, deck, told, **options):
        with self.assertRaises(InputError) as caught:
            self.read(deck, **options)
        self.assertIn(told, str(caught.exception))


class Dmig(Decks):
    def check(self, found):
        np.testing.assert_array_equal(found.stiffness.toarray(), STIFFNESS)
        np.testing.assert_array_equal(found.mass.toarray(), MASS)
        self.assertEqual(list(found.numbers), [1, 2])
        np.testing.assert_array_equal(found.positions, [[0, 0, 0], [2, 0, 0]])
        self.assertEqual((list(found.unknown_nodes), list(found.unknown_components)), ([0, 1, -1], [0, 0, 0]))
        self.assertEqual(found.interfaces, {"node_1": 0, "node_2": 1})
        self.assertIsNone(found.axes)
        found.check()

    def test_small_wide_and_free_fields(self):
        self.check(self.read(SMALL))
        wide, free = [], []
        for line in SMALL.splitlines():
            fields = [line[k:k + 8].strip() for k in range(0, 72, 8)]
            if line.startswith("$"):
                continue
            free.append(",".join(fields))
            for k in (1, 5):
                head = fields[0] + "*" if k == 1 and fields[0] else "*"
                wide.append(f"{head:8s}" + "".join(f"{field + 'D0' if '.' in field else field:>16s}" for field in fields[k:k + 4]))
        self.check(self.read("\n".join(wide) + "\n"))
        self.check(self.read("\n".join(free) + "\n"))

    def test_symmetric_and_square(self):
        lower, entry = "               2       1    -10.\n", "DMIG    KAAX           2       1               2       1     10.\n"
        both = SMALL.replace(entry, entry + "               1       1    -10.\n")
        for deck in (both, both.replace(lower, ""), both.replace("KAAX           0       6", "KAAX           0       1")):
            self.check(self.read(deck))
        one_sided = self.read(SMALL.replace("KAAX           0       6", "KAAX           0       1"))
        # The entries are those of the file.
        np.testing.assert_array_equal(one_sided.stiffness.toarray(), [[10, 0, 0], [-10, 10, 0], [0, 0, 5]])
        self.refuse(both.replace("-10.", "-11.", 1), "DMIG KAAX, column 2 1, row 1 1: has an entry on both sides of the diagonal, with two values, but "
                    "the form 6 (symmetric)")

    def test_names(self):
        other = SMALL.replace("KAAX", "KB2").replace("MAAX", "MB2")
        self.check(self.read(other, names={"stiffness": "KB2", "mass": "mb2"}))
        self.refuse(other, "there is no stiffness matrix (KAAX, KAA")
        self.refuse(other, "--names stiffness=NAME names one")
        self.refuse(SMALL.replace("MAAX", "MAAY"), "there is no mass matrix (MAAX, MAA, MXX, MGG, M2GG, M2PP, MFF, MLL); did you mean 'MAAY'?; --names"
                    " mass=NAME names one, --mass FILE another file")
        self.refuse(SMALL, "there is no matrix 'KAAY', which --names gives for the stiffness; did you mean 'KAAX'?", names={"stiffness": "KAAY"})
        extra = "DMIG    {0}           0       6       2       0\nDMIG    {0}           1       1               1       1      .1\n"
        found = self.read(SMALL + extra.format("BAAX") + extra.format("K4AA") + extra.format("PAAA"))
        self.assertEqual(found.damping[0, 0], 0.1)
        self.assertIn("left out: the structural damping K4AA", found.notes)
        self.assertIn("left out: the matrix PAAA", found.notes)
        self.assertEqual(self.read(SMALL + extra.format("KGGD")).geometric_stiffness[0, 0], 0.1)

    def test_points_and_masses_in_other_decks(self):
        points = "\n".join(line for line in SMALL.splitlines() if "DMIG" not in line and not line.startswith(" "))
        alone = "\n".join(line for line in SMALL.splitlines() if line.startswith((" ", "DMIG"))) + "\n"
        nodes = self.write("nodes.bdf", "SOL 103\nCEND\nBEGIN BULK\n" + points + "\nGRID,99,,5.,5.,5.\nENDDATA\n")
        self.check(self.read(alone, nodes=nodes))
        self.refuse(alone, "DMIG KAAX names component 1 of the point 1, which does not exist; the deck holds no GRID: --nodes DECK names one that does")
        stiffness, mass = SMALL.split("DMIG    MAAX", 1)
        self.check(self.read(stiffness, mass=self.write("mass.pch", "DMIG    MAAX" + mass)))

    def test_unknowns(self):
        axes = "CORD2R         5              0.      0.      0.      1.      0.      0.\n              0.      1.      0.\n"
        found = self.read(axes + SMALL.replace("2.      0.      0.\n", "2.      0.      0.       5\n", 1))
        # The system has z along x, and x along y.
        np.testing.assert_allclose(found.axes, [np.eye(3), [[0, 0, 1], [1, 0, 0], [0, 1, 0]]])
        self.refuse(SMALL.replace("GRID           2 ", "GRID           3 "), "1 of the point 2, which does not exist")
        self.refuse(SMALL.replace("11       0              11       0      5.", " 1       0               1       0      5."),
                    "names the point 1 without a component, but it is a GRID")
        self.refuse(SMALL.replace("ASET1          1       1       2", "ASET1          1       1       2       4"), "component 1 of the point 4, which does")
        self.refuse(SMALL.replace("SPOINT        11", "SPOINT         2"), "the point 2 is both a GRID and an SPOINT")
        # Direction y is in the a-set and has no stiffness.
        found = self.read(SMALL.replace("ASET1          1       1", "ASET1         12       1"))
        self.assertEqual((found.size, list(found.unknown_components)), (5, [0, 1, 0, 1, 0]))
        without = self.read("\n".join(line for line in SMALL.splitlines() if "SET1" not in line and "SPOINT" not in line) + "\n")
        self.check(without)
        modal = self.read(SMALL.replace("ASET1          1       1       2", "ASET1          1       1\nQSET1          1       2"))
        self.assertEqual((list(modal.numbers), list(modal.unknown_nodes), list(modal.unknown_components)), ([1], [0, -1, -1], [0, 0, 1]))
        many = "".join(f"GRID,{k},,{k}.,0.,0.\n" for k in range(20, 80))
        columns = "".join(f"DMIG,KAAX,{k},1,,{k},1,1.\n" for k in range(20, 80))
        head, tail = SMALL.split("DMIG    MAAX", 1)
        head = "\n".join(line for line in head.splitlines() if "SET1" not in line) + "\n"
        found = self.read(many + head + columns + "DMIG    MAAX" + tail)
        self.assertEqual((len(found.numbers), found.interfaces), (62, {}))
        self.assertIn("neither BSET nor ASET of the deck tells which nodes are interfaces: the body file has to name them", found.notes)
        every = "ASET1,1,20,THRU,79\nASET1,1,1,2\n"
        deck = many + head.replace("DMIG    KAAX           0", every + "DMIG    KAAX           0") + columns + "DMIG    MAAX" + tail
        self.assertEqual(len(self.read(deck).interfaces), 62)
        deck = "\n".join(line for line in deck.splitlines() if "   11  " not in line) + "\n"
        # All unknowns are in the a-set, which is ambiguous unless the body has modes.
        self.assertEqual(self.read(deck).interfaces, {})
        self.assertEqual(self.read(deck + "BSET1,1,30,2\n").interfaces, {"node_2": 1, "node_30": 12})

    def test_refused_cards(self):
        header = "DMIG    KAAX           0       6       2       0\n"
        for deck, told in (
                (SMALL.replace(header, ""), "line 7: DMIG KAAX: no header (DMIG, KAAX, 0, form, type ..) stands before its columns"),
                (SMALL + header, "there is a second header of DMIG KAAX (the first: line 7)"),
                (SMALL.replace("KAAX           0       6", "KAAX           0       4"), "DMIG: expected a form: 1 (square), 2 or 9 (rectangular) or 6"),
                (SMALL.replace("KAAX           0       6", "KAAX           0       2"), "DMIG KAAX is rectangular (form 2); expected 1 (square) or 6"),
                (SMALL.replace("6       2       0\nDMIG    KAAX", "6       7       0\nDMIG    KAAX"), "expected a type: 1 to 4 in field 5, found '7'"),
                (SMALL + "DMIG    KAAX           1       1               1       1     10.\n", "the column 1 1 of DMIG KAAX stands twice"),
                (SMALL.replace("               2       1    -10.", "               1       1    -10."), "the column 1 1 of DMIG KAAX has the row 1 1 twice"),
                (SMALL.replace("2       1    -10.", "2       7    -10."), "the column 1 1 of DMIG KAAX has the row 2 7; expected a number from 1 on and"),
                (SMALL.replace("KAAX           1       1", "KAAX           1       8"), "the column 1 8 of DMIG KAAX is none: expected a number from 1 on"),
                (SMALL.replace("    -10.", "    -1x."), "has an entry of ['2', '1', '-1X.', '']; expected a point, a component, a real"),
                (SMALL.replace("    -10.", "        "), "has an entry of ['2', '1', '', '']; expected a point"),
                (SMALL.replace("    -10.", "    -10.      1."), "the stiffness KAAX is complex; only real matrices describe a body"),
                (SMALL.replace("ASET1          1", "ASET1          7"), "ASET1: expected components such as 123456, or 0 for scalar points in field 2"),
                (SMALL.replace("ASET1          1       1       2", "ASET1          1       1    THRU       9"), "ASET1 names the points 1 to 9, but 3 does not exist"),
                (SMALL.replace("SPOINT        11", "SPOINT        11    THRU99999999"), "SPOINT: expected 1000000 scalar points at most in field 4")):
            with self.subTest(told):
                self.refuse(deck, told)
        self.check(self.read(SMALL.replace("0       6       2       0", "0       6       4       0")))  # complex by its type alone

    def test_cut_off(self):
        self.refuse(SMALL[:-2], "line 16: the file ends in the middle of a line, in the card 'DMIG MAAX 11 0': it is cut off; if it is whole, end its last line")
        self.assertEqual(self.read(SMALL).notes, [])
        self.assertEqual(self.read(SMALL + "enddata").notes, [])
        self.assertIn("ends in the middle of a line: it may be cut off", self.read(SMALL + "PARAM,POST,0").notes[-1])
        self.refuse(SMALL[:SMALL.rindex("DMIG")], "DMIG MAAX has no mass of 1 amplitude of modes that has a stiffness, the first 11 0")
        for cut in range(1, len(SMALL)):
            with self.assertRaises(InputError):
                self.read(SMALL[:cut])

    def test_written_columns_of_shapes_are_complete(self):
        body = cloud_body(scalars=3, points=6, damping=False)
        body.shapes.displacement[:, -1] = 0
        body.shapes.rotation = None
        dmig.write(body, self.path("written.pch"))
        found = dmig.read(self.path("written.pch"), Options())
        self.assertFalse([note for note in found.notes if "no card" in note])
        np.testing.assert_array_equal(found.shapes.displacement[:, -1], 0)
        with open(self.path("written.pch"), encoding="ascii") as file:
            lines = file.readlines()
        self.refuse("".join(lines[:-1]), f"has no card for the column {body.size} of {body.size}: the end of the file is cut off")

    def test_columns_of_shapes_that_are_missing(self):
        columns = "".join(f"DMIG    MUG1    {k:8d}       0               2       1{k:8d}\n" for k in (1, 2, 3))
        shapes = "DMIG    MUG1           0       9       2       0                       {}\n"
        whole = SMALL + shapes.format(3) + columns
        found = self.read(whole)
        self.assertEqual(found.notes, [])
        np.testing.assert_array_equal(found.shapes.displacement, [[1, 2, 3], [0, 0, 0], [0, 0, 0]])
        lines = whole.splitlines(keepends=True)
        told = "DMIG MUG1 has no card for the column {} of 3: zero, unless the file lacks lines"
        without = "".join(lines[:-1])
        # The only mode of the last row may have zero shapes.
        self.assertIn(told.format(3), self.read(without).notes)
        self.assertIn(told.format(2), self.read("".join(lines[:-2] + lines[-1:])).notes)
        empty = self.read(without + "DMIG,MUG1,3,0\n")
        self.assertEqual(empty.notes, [])
        np.testing.assert_array_equal(empty.shapes.displacement, [[1, 2, 0], [0, 0, 0], [0, 0, 0]])
        second = ("DMIG    KAAX          12       0              12       0      7.\n", "DMIG    MAAX          12       0              12       0      1.\n")
        modes = SMALL.replace("DMIG    MAAX           0", second[0] + "DMIG    MAAX           0").replace("0      11\n", "0      11      12\n") + second[1]
        modes += shapes.format(4) + columns
        self.refuse(modes, "line 19: DMIG MUG1 has no card for the column 4 of 4: the end of the file is cut off; if a column is zero, write its card "
                    "without rows: DMIG,MUG1,4,0")
        for end in ("ENDDATA\n", "PARAM,POST,0\n"):
            self.assertIn("DMIG MUG1 has no card for the column 4 of 4: zero, unless the file lacks lines", self.read(modes + end).notes)
        self.assertEqual(self.read(modes + "DMIG,MUG1,4,0\n").notes, [])

    def test_a_last_column_that_is_short(self):
        """A file that is cut off between two lines may still contain all of its columns."""
        body = cloud_body(damping=False)
        dmig.write(body, self.path("a.pch"))
        with open(self.path("a.pch"), encoding="ascii") as file:
            lines = file.readlines()
        self.assertEqual([note for note in self.read("".join(lines)).notes if "last column" in note], [])
        for left_out in (1, 5, 3 * len(body.shapes.points) - 1):
            words = lines[-left_out - 1].split()
            self.assertIn(f"the last column of DMIG MUG1, {body.size}, ends at the row {words[1]} {words[2]}, others at ",
                          " ".join(self.read("".join(lines[:-left_out])).notes))
        self.assertNotIn("last column", " ".join(self.read("".join(lines[:-1]) + "ENDDATA\n").notes))

    def test_damaged(self):
        random = np.random.default_rng(5)
        for _ in range(400):
            damaged = bytearray(SMALL.encode())
            if random.random() < 0.3:
                del damaged[random.integers(1, len(damaged)):]
            for place in random.integers(0, len(damaged), random.integers(1, 4)):
                damaged[place] = random.choice(list(b"0123456789.+-ED *,$\n\0\xff"))
            with open(self.path("damaged.pch"), "wb") as file:
                file.write(damaged)
            try:
                dmig.read(self.path("damaged.pch"), Options()).check()
            except InputError:
                pass

    def test_numbers_of_sixteen_characters(self):
        random = np.random.default_rng(1)
        values = random.choice([-1, 1], 4000) * (1 + 9 * random.random(4000)) * 10.0 ** random.integers(-30, 30, 4000)
        for value in [*values, 9.9999999999999999e9, 0.99999999999999999, -0.99999999999999994, 1e15, 123456789012345678.0, 0.1, -0.0, 1e-310, -1.7e308, 1.0]:
            written = wide_number(value)
            self.assertLessEqual(len(written), 16)
            self.assertIn(".", written)
            self.assertLessEqual(abs(number_of(written) - value), 5e-10 * abs(value) if abs(value) < 1e-99 else 5.01e-11 * abs(value), written)
            if 1 <= abs(value) < 1e13:  # 14 digits and more
                self.assertLessEqual(abs(number_of(written) - value), 5.01e-14 * abs(value), written)


class RoundTrips(Decks):
    def setUp(self):
        super().setUp()
        body = beam(*STEEL, turned())
        self.bodies = [body, beam(*STEEL), with_modes(body), shuffled(with_modes(body)), with_modes(beam(*STEEL), 12)]

    def test_dmig(self):
        for body in self.bodies:
            dmig.write(body, self.path("body.pch"))
            found = dmig.read(self.path("body.pch"), Options())
            assert_same(self, found, body, 1e-11)
            self.assertEqual(found.shapes is None, body.shapes is None)
            self.assertTrue(any(note.startswith("fields of 16 characters hold the numbers of the matrices to") for note in body.notes))

    def test_op4(self):
        for body in self.bodies:
            for kind in ("op4", "op4-text"):
                op4.write(dataclasses.replace(body, notes=[]), self.path("body.op4"), Options(format=kind))
                found = op4.read(self.path("body.op4"), Options())
                assert_same(self, found, dataclasses.replace(body, shapes=None), 1e-13 if body.axes is not None else 0)

    def test_not_symmetric(self):
        body = beam(*STEEL)
        body.stiffness[0, 6] *= 1.001
        dmig.write(body, self.path("body.pch"))
        assert_same(self, dmig.read(self.path("body.pch"), Options()), body, 1e-11)
        op4.write(body, self.path("body.op4"), Options())
        assert_same(self, op4.read(self.path("body.op4"), Options()), body, 0)

    def test_interfaces_among_nodes(self):
        body = beam(*STEEL)
        body.interfaces = {"tip": 1}
        dmig.write(body, self.path("body.pch"))
        self.assertEqual(dmig.read(self.path("body.pch"), Options()).interfaces, {"node_12": 1})
        op4.write(body, self.path("body.op4"), Options())
        self.assertEqual(op4.read(self.path("body.op4"), Options()).interfaces, {"node_12": 1})

    def test_numbers_of_points(self):
        body = with_modes(beam(*STEEL))
        body.shapes.numbers = np.array([7, 8, 12])  # the nodes at other places
        dmig.write(body, self.path("body.pch"))
        found = dmig.read(self.path("body.pch"), Options())
        self.assertEqual(list(found.shapes.numbers), [107, 108, 112])
        assert_same(self, found, body, 1e-11)
        self.assertIn("the numbers of the points of the shapes are raised by 100: nodes have the same ones", body.notes)
        body.shapes.points[0] = body.positions[0]
        body.shapes.points[2] = body.positions[1]
        dmig.write(dataclasses.replace(body, axes=np.array([np.eye(3), turned()]), notes=[]), self.path("body.pch"))
        found = dmig.read(self.path("body.pch"), Options())
        self.assertEqual(list(found.shapes.numbers), [7, 8, 12])
        np.testing.assert_allclose(found.shapes.displacement, body.shapes.displacement, rtol=0, atol=1e-10)
        for numbers in ([0, 5], [-3, 2], [3, 3], [5, 10**8]):
            body = beam(*STEEL)
            body.numbers = np.array(numbers)
            dmig.write(body, self.path("body.pch"))
            self.assertEqual(list(dmig.read(self.path("body.pch"), Options()).numbers), [1, 2])
            self.assertIn("the points are numbered from 1, since their numbers are not of Nastran", body.notes)


POINTS = """GRID,20,,0.,0.,0.
GRID,3,,1.,0.,0.
SPOINT,11
"""


class Op4Order(InFolder):
    """Tests the order of the unknowns of OUTPUT4 files, points by ascending numbers."""

    def matrices(self, size, names=("KGG", "MGG"), **more):
        a = np.random.default_rng(size).standard_normal((size, size))
        return {names[0]: a @ a.T, names[1]: a + a.T, **more}

    def read(self, matrices, deck, content=None, **options):
        with open(self.path("body.op4"), "wb") as file:
            file.write(content or binary(matrices))
        return op4.read(self.path("body.op4"), Options(nodes=self.write("nodes.bdf", deck), **options))

    def refuse(self, told, *arguments, **options):
        with self.assertRaises(InputError) as caught:
            self.read(*arguments, **options)
        self.assertIn(told, str(caught.exception))

    def test_all_points(self):
        matrices = self.matrices(13)
        found = self.read(matrices, POINTS)
        self.assertEqual(list(found.numbers), [3, 20])
        self.assertEqual(list(found.unknown_nodes), [0] * 6 + [-1] + [1] * 6)
        self.assertEqual(list(found.unknown_components), [0, 1, 2, 3, 4, 5, 0, 0, 1, 2, 3, 4, 5])
        np.testing.assert_array_equal(found.stiffness.toarray(), matrices["KGG"])
        np.testing.assert_array_equal(found.mass.toarray(), matrices["MGG"])
        self.assertEqual(list(found.interfaces), ["node_3", "node_20"])
        declared = self.read(matrices, POINTS + "ASET,20,123\n")
        self.assertEqual(declared.interfaces, {"node_20": 1})

    def test_null_rows_stay(self):
        matrices = self.matrices(13)
        for matrix in matrices.values():
            matrix[3:6] = matrix[:, 3:6] = 0
        self.assertEqual(self.read(matrices, POINTS).size, 13)

    def test_the_a_set(self):
        deck = POINTS + "ASET1,13,20\nASET,3,2\nQSET1,0,11\n"
        found = self.read(self.matrices(4, ("KAA", "MAA")), deck)
        self.assertEqual((list(found.unknown_nodes), list(found.unknown_components)), ([0, -1, 1, 1], [1, 0, 0, 2]))
        self.refuse("KAA has 5 rows, but the deck has 4 unknowns in its a-set (and 13 in all)", self.matrices(5, ("KAA", "MAA")), deck)
        self.refuse("KGG has 12 rows, but the deck has 13 unknowns at all its points", self.matrices(12), POINTS)

    def test_other_files(self):
        matrices = self.matrices(13)
        mass = self.path("mass.op4")
        with open(mass, "w", encoding="ascii") as file:
            file.write(text({"MGG": matrices["MGG"]}))
        found = self.read({"KGG": matrices["KGG"]}, POINTS, mass=mass)
        np.testing.assert_array_equal(found.mass.toarray(), matrices["MGG"])
        self.refuse("there is no mass matrix", {"KGG": matrices["KGG"]}, POINTS)
        self.refuse("'KGG2', which --names gives for the stiffness; did you mean 'KGG'?", matrices, POINTS, names={"stiffness": "KGG2"})
        self.refuse("MGG has 12 rows and 12 columns for 13 unknowns", {"KGG": matrices["KGG"], "MGG": matrices["MGG"][:12, :12]}, POINTS)
        with self.assertRaises(InputError) as caught:
            op4.read(self.path("body.op4"), Options())
        self.assertIn("an OUTPUT4 file does not name its unknowns: --nodes DECK", str(caught.exception))

    def test_more_matrices(self):
        matrices = self.matrices(13)
        found = self.read({**matrices, "BGG": np.zeros((1, 1)), "KGGD": matrices["MGG"], "K4GG": matrices["KGG"], "PG": np.ones((13, 2))}, POINTS)
        self.assertIsNone(found.damping)
        np.testing.assert_array_equal(found.geometric_stiffness.toarray(), matrices["MGG"])
        self.assertIn("left out: the structural damping K4GG", found.notes)
        self.assertIn("left out: the matrix PG", found.notes)

    def test_one_triangle(self):
        matrices = self.matrices(13)
        for part in (np.tril, np.triu):
            found = self.read({"KGG": part(matrices["KGG"]), "MGG": matrices["MGG"]}, POINTS)
            np.testing.assert_array_equal(found.stiffness.toarray(), matrices["KGG"])
            self.assertIn("KGG is symmetric by its form and holds one triangle: the other one is the same", found.notes)
        content = binary({"KGG": np.tril(matrices["KGG"]), "MGG": matrices["MGG"]}, form=1)
        # A triangle of form 1 is not completed, and the check of symmetry reports it.
        np.testing.assert_array_equal(self.read({}, POINTS, content).stiffness.toarray(), np.tril(matrices["KGG"]))

    def test_complex(self):
        matrices = self.matrices(13)
        self.read({}, POINTS, binary(matrices, kind=4))
        self.refuse("the stiffness KGG is complex; only real matrices describe a body", {}, POINTS,
                    binary({"KGG": matrices["KGG"] * (1 + 0.02j), "MGG": matrices["MGG"]}, kind=4))

    def test_shapes_by_rows_that_the_deck_names(self):
        deck = ("CORD2R,5,,0.,0.,0.,1.,0.,0.\n,0.,1.,0.\n" + POINTS.replace("3,,1.,0.,0.", "3,,1.,0.,0.,5") + "ASET,20,123,3,2\nQSET1,0,11\n"
                "DTI     TUG1    2\n        TYPE    ID      COMP    ROW     TYPE    ID      COMP    ROW\n"
                "        1       3       6       7       1       20      6       1\n        2       11      1       13      1       50      6       14\n"
                "        ENDREC\n")
        shapes = np.random.default_rng(4).standard_normal((19, 5))
        found = self.read({**self.matrices(5, ("KAA", "MAA")), "MUG1": shapes}, deck)
        axes = np.array([[0, 0, 1], [1, 0, 0], [0, 1, 0]])
        self.assertEqual(list(found.shapes.numbers), [3, 20])
        np.testing.assert_allclose(found.shapes.displacement, np.concatenate([axes @ shapes[6:9], shapes[0:3]]))
        np.testing.assert_allclose(found.shapes.rotation, np.concatenate([axes @ shapes[9:12], shapes[3:6]]))
        self.assertIn("left out: the shapes of 1 points, whose GRID the deck does not hold", found.notes)
        self.assertNotIn("does not name", " ".join(found.notes))
        short = self.read({**self.matrices(5, ("KAA", "MAA")), "MUG1": shapes}, deck.replace("      1       50      6       14\n", "\n"))
        self.assertIn("left out: 6 rows of MUG1 that DTI,TUG1 does not name", short.notes)
        stress = deck.replace("TUG1", "TGS1").replace("        2       11      1       13      1       50      6       14\n", "")
        whole = {**self.matrices(5, ("KAA", "MAA")), "MUG1": shapes, "MGS1": shapes[:12]}
        self.assertEqual(len(self.read(whole, deck + stress[stress.index("DTI"):]).shapes.stress), 12)
        self.refuse("DTI,TGS1 gives the point 3 5 rows of MGS1; expected 6: xx yy zz yz xz xy", whole,
                    deck + stress[stress.index("DTI"):].replace("3       6       7", "3       5       7"))
        self.refuse("DTI: expected rows of MUG1, which has 18 in field", {**self.matrices(5, ("KAA", "MAA")), "MUG1": shapes[:18]}, deck)


if __name__ == "__main__":
    unittest.main()
