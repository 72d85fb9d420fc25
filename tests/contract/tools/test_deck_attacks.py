"""Tests of decks with mistakes, other encodings and line ends: they are read as intended, or refused with one sentence
that tells the line."""

import unittest

from cell_decks import Box
from test_deck_assemblies import Decks
from bielle_tools.decks.foreign_mesh import read_foreign
from bielle_tools.mesh.solid_mesh import solid_mesh
from bielle_tools.messages import InputError

CUBE = "*ELEMENT, TYPE=C3D8\n"


class Encodings(Decks):
    def check(self, ending, content):
        with open(self.path("deck." + ending), "wb") as file:
            file.write(content)
        mesh = solid_mesh(read_foreign(self.path("deck." + ending)))
        self.assertEqual((len(mesh.points), len(mesh.cells["hexahedron"])), (27, 8))

    def test_ends_of_lines_marks_and_letters(self):
        box = Box(("hexahedron",) * 2)
        for ending, text, comment in (("inp", box.abaqus(), "** "), ("bdf", box.nastran(), "$ "), ("bdf", box.nastran(form="free"), "$ ")):
            with self.subTest(ending):
                for end in ("\r\n", "\r"):
                    self.check(ending, text.replace("\n", end).encode())
                self.check(ending, b"\xef\xbb\xbf" + text.encode())
                self.check(ending, (comment + "Gr\xf6\xdfe in mm \x85\n").encode("latin-1") + text.encode())
                self.check(ending, (comment + "form\x0cfeed\n" + text).encode())
                self.check(ending, ("\n \n\t\n" + text + "\n\n").encode())
        self.check("inp", box.abaqus().replace(", ", ",\t").encode())


class Slips(Decks):
    def setUp(self):
        super().setUp()
        self.text = Box(("hexahedron",) * 2).abaqus()

    def notes(self, extra):
        return " ".join(self.read(self.text + extra).notes)

    def test_empty_sections(self):
        self.read("*NODE\n*ELEMENT, TYPE=C3D8\n" + self.text)
        for extra, told in (("*NSET, NSET=A\n", "node set 'A' has no nodes and is left out"),
                            ("*SURFACE, NAME=A\n", "surface 'A' has no faces and is left out"),
                            ("*SURFACE, NAME=A, TYPE=NODE\n", "surface 'A' has no nodes and is left out"),
                            ("*NSET, NSET=A\n1, 2, 9999\n", "node set 'A' names 1 node that does not exist (the first: 9999)")):
            self.assertIn(told, self.notes(extra))
        with self.assertRaisesRegex(InputError, "holds no \\*NODE"):
            self.read("")

    def test_numbers_of_fields(self):
        first = self.text.index("\n1, ", self.text.index("*ELEMENT")) + 1
        line = self.text[:first].count("\n") + 1
        for text, told in ((self.text[:first] + self.text[first:].replace("1, ", "1, 2, ", 1), f"deck.inp:{line}: C3D8 needs 8 nodes per element: element 1 has 9"),
                           (self.text.rstrip().rpartition(",")[0] + "\n", "element 8 has 7"),
                           (self.text.replace("*NODE\n1, 0, 0, 0", "*NODE\n1 0 0 0"), "deck.inp:4: *NODE: expected an integer, found '1 0 0 0'"),
                           (self.text.replace("*NODE\n", "*NODE\n, 1., 2., 3.\n"), "deck.inp:4: *NODE: expected an integer, found ''"),
                           (self.text.replace("*NODE\n", "*NODE\n1.5, 1., 2., 3.\n"), "expected an integer, found '1.5'"),
                           (self.text + "*NSET, NSET=A, GENERATE\n1\n", "needs the first number, the last one and the step, found 1 word"),
                           (self.text + "*NSET, NSET=A, GENERATE\n1, 5, 0\n", "in steps of 0"),
                           (self.text + "*NSET, NSET=A, GENERATE\n1, 2000000000\n", "more than 20000000 numbers")):
            self.refuse(text, told)

    def test_numbers_that_are_taken_or_none(self):
        for number in (0, -3, 2**31, 10**25):
            self.refuse(self.text.replace("*NODE\n", f"*NODE\n{number}, 0., 0., 0.\n"), f"deck.inp:4: a node has the number {number}, but numbers are from 1")
            self.refuse(self.text + f"{CUBE}{number}, 1, 2, 3, 4, 5, 6, 7, 8\n", f"the number {number}, but numbers are from 1 to 2147483647")
            self.refuse(self.text + f"{CUBE}99, {number}, 2, 3, 4, 5, 6, 7, 8\n", f"the number {number}, but numbers are from 1 to 2147483647")
        self.read(self.text.replace("*NODE\n", f"*NODE\n{2**31 - 1}, 0., 0., 0.\n"))
        self.refuse(self.text + "*NODE\n1, 5., 5., 5.\n", "there is a second node 1, in another place")
        self.refuse(self.text + CUBE + "1, 1, 2, 3, 4, 5, 6, 7, 8\n", "there is a second element 1")
        self.refuse(self.text + "*SURFACE, NAME=A\n9999, S1\n", "surface 'A' names element 9999")
        self.refuse(self.text + "*SURFACE, NAME=A, TYPE=NODE\n9999,\n", "surface 'A' names node 9999, which does not exist")

    def test_circles(self):
        self.refuse(self.text + "*NSET, NSET=A\nB\n*NSET, NSET=B\nA\n", "set 'A' contains itself")
        self.refuse(self.text + "*INCLUDE, INPUT=deck.inp\n", "is included by itself")
        self.refuse(self.text + "*INCLUDE, INPUT=.\n", "cannot read")


class NastranSlips(Decks):
    def notes(self, extra):
        with open(self.path("deck.bdf"), "w", encoding="utf-8") as file:
            file.write(Box(("hexahedron",) * 2).nastran().replace("ENDDATA", "") + extra)
        return " ".join(read_foreign(self.path("deck.bdf")).notes)

    def test_ties_of_few_nodes_and_masses_of_no_node(self):
        self.assertIn("left out: RBE3 71 ties 0 nodes; an interface needs 3", self.notes("GRID,9001,,0.,0.,9.\nRBE3,71,,9001,123456,0.,123,1,2,\n,3,4\n"))
        self.assertIn("left out: RBE2 72 ties 2 nodes; an interface needs 3", self.notes("GRID,9001,,0.,0.,9.\nRBE2,72,9001,123456,1,2\n"))
        self.assertIn("(73: 2 at the grid point 9002, which does not exist)", self.notes("CONM2,73,9002,,2.\n"))


if __name__ == "__main__":
    unittest.main()
