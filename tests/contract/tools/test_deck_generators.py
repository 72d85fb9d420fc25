"""Tests that Abaqus decks with generated nodes and elements equal the same decks written out."""

import unittest

import numpy as np

from box_mesh import area
from test_deck_assemblies import Decks, volume
from bielle_tools.decks.abaqus_file import read_abaqus, read_deck
from bielle_tools.mesh.cells import triangles_of

# Corners of a block of 4 x 2 x 2 hexahedra of 0.2 x 0.1 x 0.05, which are nodes 1 + i + 10 j + 100 k.
BLOCK = ("*NODE, NSET=CORNERS\n1, 0., 0., 0.\n5, .8, 0., 0.\n21, 0., .2, 0.\n25, .8, .2, 0.\n"
         "*NGEN, NSET=FRONT\n1, 5\n*NGEN, NSET=BACK\n21, 25, 1\n*NFILL, NSET=BOTTOM\nFRONT, BACK, 2, 10\n"
         "*NCOPY, CHANGE NUMBER=200, OLD SET=BOTTOM, NEW SET=TOP, SHIFT\n0., 0., .1\n\n*NFILL\nBOTTOM, TOP, 2, 100\n")
CELLS = "*ELEMENT, TYPE=C3D8\n1, 1, 2, 12, 11, 101, 102, 112, 111\n*ELGEN, ELSET=BODY\n1, 4, 1, 1, 2, 10, 10, 2, 100, 100\n"
NODES = {1 + i + 10 * j + 100 * k: (.2 * i, .1 * j, .05 * k) for i in range(5) for j in range(3) for k in range(3)}


class Generators(Decks):
    def nodes(self, text):
        """Returns {number: coordinates} of the nodes of a deck."""
        reader = read_deck(self.write("deck.inp", text))
        return {label: np.array(reader.points[row]) for label, row in reader.numbers.items()}

    def test_a_generated_block_equals_the_block_written_out(self):
        written = "*NODE\n" + "".join(f"{n}, {x:.17g}, {y:.17g}, {z:.17g}\n" for n, (x, y, z) in NODES.items()) + "*ELEMENT, TYPE=C3D8, ELSET=BODY\n"
        for k, j, i in np.ndindex(2, 2, 4):
            first = 1 + i + 10 * j + 100 * k
            nodes = [first + step for step in (0, 1, 11, 10, 100, 101, 111, 110)]
            written += f"{1 + i + 10 * j + 100 * k}, " + ", ".join(map(str, nodes)) + "\n"
        made = self.read(BLOCK + CELLS)
        self.assertAlmostEqual(volume(made) / (.8 * .2 * .1), 1, delta=1e-12)
        made = read_abaqus(self.write("made.inp", BLOCK + CELLS))
        plain = read_abaqus(self.write("plain.inp", written))
        cells = [{label: [tuple(raw.points[n].round(12)) for n in nodes] for labels, (_, block) in zip(raw.labels, raw.cells)
                  for label, nodes in zip(labels.tolist(), block)} for raw in (made, plain)]
        self.assertEqual(cells[0], cells[1])
        self.assertEqual(len(made.cell_sets["BODY"]), len(made.cells))
        self.assertEqual(sum(len(rows) for rows in made.cell_sets["BODY"]), 16)
        found = self.nodes(BLOCK)
        self.assertEqual(set(found), set(NODES))
        self.assertLess(max(np.abs(found[n] - NODES[n]).max() for n in NODES), 1e-12)

    def test_elements_that_are_copied(self):
        mesh = self.read(BLOCK + CELLS + "*NSET, NSET=EVERY, ELSET=BODY\n*NCOPY, CHANGE NUMBER=1000, OLD SET=EVERY, SHIFT\n0., 5., 0.\n"
                         "0., 0., 0., 0., 0., 1., 90.\n*ELCOPY, ELEMENT SHIFT=500, OLD SET=BODY, SHIFT NODES=1000, NEW SET=COPY\n")
        self.assertAlmostEqual(volume(mesh) / (2 * .8 * .2 * .1), 1, delta=1e-12)
        copied = mesh.points[np.unique(mesh.cells["hexahedron"][mesh.volumes["COPY"]["hexahedron"]])]
        np.testing.assert_allclose([copied.min(axis=0), copied.max(axis=0)], [[-5.2, 0, 0], [-5, .8, .1]], atol=1e-12)

    def test_arcs(self):
        ends = "*NODE\n1, 2., 1., 3.\n9, 1., 2., 3.\n50, 1., 1., 3.\n"
        angles = np.linspace(0, np.pi / 2, 9)
        for extra in ("9, 1, 50", "9, 1, , 1., 1., 3."):
            found = self.nodes(f"{ends}*NGEN, LINE=C\n1, {extra}\n")
            for k, angle in enumerate(angles):
                np.testing.assert_allclose(found[1 + k], [1 + np.cos(angle), 1 + np.sin(angle), 3], atol=1e-14)
        found = self.nodes(f"{ends}*NGEN, LINE=C\n1, 9, 2, 50, , , , 0., 0., -1.\n")  # the longer arc
        for k, angle in enumerate(np.linspace(0, -1.5 * np.pi, 5)):
            np.testing.assert_allclose(found[1 + 2 * k], [1 + np.cos(angle), 1 + np.sin(angle), 3], atol=1e-14)
        found = self.nodes("*NODE\n1, 2., 0., 0.\n5, -2., 0., 0.\n*NGEN, LINE=C, SYSTEM=C\n1, 5, 1, , 0., 77., 0., 0., 0., 1.\n")
        np.testing.assert_allclose(found[3], [0, 2, 0], atol=1e-14)
        for data, told in (("1, 9, 1, 1", "from its centre"), ("1, 9, 3", "in steps of 3"), ("1, 9", "extra point"), ("1, 8, 1, 50", "no node 8"),
                           ("1, 9, 1, 50, , , , 0., 1., 0.", "not normal")):
            self.refuse(f"{ends}*NGEN, LINE=C\n{data}\n", "deck.inp:6: ", told)
        self.refuse("*NODE\n1, 2., 0., 0.\n5, -2., 0., 0.\n*NGEN, LINE=C\n1, 5, 1, , 0., 0., 1.E-9\n", "180 degrees")
        self.refuse(f"{ends}*NGEN, LINE=S\n1, 9\n", "expected LINE=P")

    def test_parabolas(self):
        found = self.nodes("*NODE\n1, 0., 0., 0.\n5, 4., 0., 0.\n*NGEN, LINE=P\n1, 5, 1, , 2., 1., 0.\n")
        for k in range(5):  # y = 1 - (x - 2)^2 / 4
            np.testing.assert_allclose(found[1 + k], [k, 1 - (k - 2) ** 2 / 4, 0], atol=1e-14)

    def test_bias(self):
        ends = "*NODE, NSET=A\n1, 0., 0., 0.\n*NODE, NSET=B\n9, 1., 0., 0.\n"
        found = self.nodes(f"{ends}*NFILL, BIAS=0.5\nA, B, 3, 1\n")
        np.testing.assert_allclose([found[2][0], found[3][0]], [1 / 7, 3 / 7], atol=1e-14)  # distances 1 : 2 : 4
        found = self.nodes(f"{ends}*NFILL, BIAS=2., TWO STEP\n1, 9, 4\n")
        np.testing.assert_allclose([found[n][0] for n in (2, 3, 4)], [1 / 3, 2 / 3, 5 / 6], atol=1e-14)
        self.refuse(f"{ends}*NFILL, SINGULAR=1\nA, B, 3, 1\n", "deck.inp:5: *NFILL: the option SINGULAR is not read")
        self.refuse(f"{ends}*NFILL, BIAS=-1\nA, B, 3, 1\n", "BIAS")
        self.refuse(f"{ends}*NFILL, BIAS=2., TWO STEP\nA, B, 3\n", "even number of intervals")
        self.refuse(f"{ends}*NFILL\nA, C, 3\n", "deck.inp:6: there is no *NSET 'C' before this line")
        self.refuse(f"{ends}*NFILL\nA, B, 8.5\n", "expected an integer, found '8.5'")
        self.refuse(f"{ends}*NFILL\nA, B, 9, 1\n", "second node 9, in another place")

    def test_copies_of_nodes(self):
        nodes, x = "*NODE, NSET=A\n1, 1., 2., 3.\n2, -1., 0., 4.\n", np.array([[1., 2, 3], [-1, 0, 4]])
        for form, data, expected in (
                ("REFLECT=POINT", "1., 1., 1.\n", 2 - x), ("POLE", ", 1., 1., 1.\n", 2 * x - 1), ("POLE", "2\n", 2 * x - x[1]),
                ("REFLECT=MIRROR", "0., 0., 1., 1., 0., 1.\n0., 1., 1.\n", x * [1, 1, -1] + [0, 0, 2]),
                ("REFLECT=LINE", "5., 1., 0., 7., 1., 0.\n", x * [1, -1, -1] + [0, 2, 0]),
                ("SHIFT", "1., 0., 0.\n1., 0., 0., 1., 0., 5., 90.\n", np.column_stack([1 - x[:, 1], x[:, 0], x[:, 2]]))):
            found = self.nodes(f"{nodes}*NCOPY, CHANGE NUMBER=10, OLD SET=A, {form}\n{data}")
            np.testing.assert_allclose([found[11], found[12]], expected, atol=1e-14, err_msg=form)
        for line, told in (("CHANGE NUMBER=1, SHIFT", "OLD SET=... is missing"), ("CHANGE NUMBER=1, OLD SET=A", "one of SHIFT, REFLECT and POLE"),
                           ("CHANGE NUMBER=1, OLD SET=A, SHIFT, MULTIPLE=3", "the option MULTIPLE is not read"),
                           ("CHANGE NUMBER=1, OLD SET=A, REFLECT=LINE", "expected 6 coordinates, found 3"),
                           ("CHANGE NUMBER=1, OLD SET=A, SHIFT", "second node 2, in another place"),
                           ("CHANGE NUMBER=-1, OLD SET=A, SHIFT", "number 0"), ("CHANGE NUMBER=x, OLD SET=A, SHIFT", "expected an integer")):
            self.refuse(f"{nodes}*NCOPY, {line}\n7., 7., 7.\n", told)

    def test_elements_are_refused_by_their_lines(self):
        for line, told in (("2, 4", "no element 2"), ("1, 0", "a number of elements"), ("1, 9", "element"), ("1, 4, x", "'x'"),
                           ("1, 900000, 1, 1, 900000", "too many")):
            self.refuse(BLOCK + CELLS.split("*ELGEN")[0] + f"*ELGEN\n{line}\n", told)
        self.refuse(BLOCK + CELLS + "*ELCOPY, ELEMENT SHIFT=1, OLD SET=BODY, SHIFT NODES=0\n", "second element 2")
        self.refuse(BLOCK + CELLS + "*ELCOPY, ELEMENT SHIFT=1, OLD SET=BODY, SHIFT NODES=0, REFLECT\n", "the option REFLECT is not read")

    def test_cylindrical_nodes(self):
        plain = self.nodes(BLOCK)
        text = "*NODE, SYSTEM=C\n" + "".join(f"{n}, {np.hypot(x, y):.17g}, {np.degrees(np.arctan2(y, x)):.17g}, {z:.17g}\n"
                                             for n, (x, y, z) in plain.items())
        mesh = self.read(text + CELLS)
        self.assertAlmostEqual(volume(mesh) / (.8 * .2 * .1), 1, delta=1e-12)
        found = self.nodes("*SYSTEM\n1., 2., 3., 1., 3., 3.\n0., 2., 3.\n*NODE, SYSTEM=C\n1, 2., 90., 5.\n")
        np.testing.assert_allclose(found[1], [-1, 2, 8], atol=1e-14)
        self.refuse("*NODE, SYSTEM=S\n1, 2., 90., 5.\n", "deck.inp:1: *NODE: spherical coordinates are not read")
        self.refuse("*NODE, SYSTEM=Q\n1, 2., 90., 5.\n", "expected SYSTEM=R or C")

    def test_included_data_lines(self):
        """A file may contain data lines first, and keywords after them."""
        self.write("rest.inc", "25, .8, .2, 0.\n** a comment\n*NGEN, NSET=FRONT\n1, 5\n")
        text = BLOCK.replace("25, .8, .2, 0.\n*NGEN, NSET=FRONT\n1, 5\n", "*INCLUDE, INPUT=rest.inc\n")
        mesh = self.read(text + CELLS + "*SURFACE, NAME=S\nBODY, S1\n")
        self.assertAlmostEqual(volume(mesh) / (.8 * .2 * .1), 1, delta=1e-12)
        sides = mesh.cells["quad"][mesh.surfaces["S"]["quad"]]
        self.assertAlmostEqual(area(mesh.points, triangles_of({"quad": sides})) / (2 * .8 * .2), 1, delta=1e-12)
        self.write("a.inc", "*INCLUDE, INPUT=b.inc\n")
        self.write("b.inc", "*INCLUDE, INPUT=a.inc\n")
        self.refuse("*INCLUDE, INPUT=a.inc\n", "b.inc:1", "a.inc' is included by itself")
        self.refuse("*INCLUDE\n", "deck.inp:1: *INCLUDE: no file")


if __name__ == "__main__":
    unittest.main()
