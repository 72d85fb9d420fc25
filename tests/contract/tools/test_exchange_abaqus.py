"""Tests of matrices of Abaqus: substructures, *MATRIX GENERATE in both forms, and refusals of files that are not a free
body."""

import os
import unittest

import numpy as np

from exchange_bodies import Exchange, cloud_body, turned
from bielle_tools.exchange import formats
from bielle_tools.exchange.axes import in_body_axes

NODES = "*NODE\n 4, 0.5, 0.25, 0\n 2, 1., 0., 0.\n"
# The first of two nodes has x and y, the second one z and a rotation; lines are written as by CalculiX and Abaqus.
ELEMENT = """** a substructure
*USER ELEMENT, NODES=2, LINEAR
** ELEMENT NODES
**      4,   2
 1, 2
 2, 3, 6
*MATRIX, TYPE=STIFFNESS
 0.1D+01,
 -2, 3e0,
 4, 5.,  6
 7, 8, 9,
 10
*MATRIX, TYPE=MASS
 1,
 0, 1
 0, 0, 1
 0, 0, 0, 2.5d-1
"""
STIFFNESS = [[1, -2, 4, 7], [-2, 3, 5, 8], [4, 5, 6, 9], [7, 8, 9, 10]]


class Substructures(Exchange):
    def element(self, text=ELEMENT, nodes=NODES):
        self.write("part.inp", nodes)
        return self.write("part.mtx", text)

    def test_lines_of_a_file(self):
        for text in (ELEMENT, ELEMENT.replace("\n", "\r\n")):
            found = self.read("abaqus", self.element(text))
            np.testing.assert_array_equal(found.numbers, [4, 2])
            np.testing.assert_array_equal(found.positions, [[0.5, 0.25, 0], [1, 0, 0]])
            np.testing.assert_array_equal(found.unknown_nodes, [0, 0, 1, 1])
            np.testing.assert_array_equal(found.unknown_components, [0, 1, 2, 5])
            np.testing.assert_array_equal(found.stiffness.toarray(), STIFFNESS)
            np.testing.assert_array_equal(found.mass.toarray(), np.diag([1, 1, 1, 0.25]))

    def test_all_columns(self):
        text = ELEMENT.replace("LINEAR", "LINEAR, UNSYMM")
        head, _, _ = text.partition("*MATRIX")
        full = np.arange(16.0).reshape(4, 4) + 16 * np.eye(4)
        columns = "\n".join(", ".join(f"{x}" for x in column) for column in full.T)
        found = self.read("abaqus", self.element(f"{head}*MATRIX, TYPE=STIFFNESS\n{columns}\n*MATRIX, TYPE=MASS\n{columns}\n"))
        np.testing.assert_array_equal(found.stiffness.toarray(), full)

    def test_round_trip(self):
        body = cloud_body()
        self.same(self.read_back("abaqus", body, self.path("a.mtx")), body)
        self.same(self.read_back("matrix_input", body, self.path("b.mtx")), body)
        for name in ("abaqus", "matrix_input"):
            self.same(self.read_back(name, turned(body), self.path("c.mtx")), in_body_axes(turned(body)))
            self.same(in_body_axes(turned(body)), body, 1e-13)

    def test_refusals(self):
        for text, told in ((ELEMENT.rstrip().rsplit(",", 1)[0], "*MATRIX, TYPE=MASS has 9 numbers, but a triangle of 4 rows has 10"),
                           (ELEMENT.partition("*MATRIX, TYPE=MASS")[0], "holds no mass matrix"),
                           (ELEMENT.replace("4,   2", "4,   9"), "node 9 has no position in"),
                           (ELEMENT.replace("NODES=2", "NODES=3"), "NODES=3, but 2 nodes are listed"),
                           (ELEMENT.replace("TYPE=MASS", "TYPE=MAS"), "there is no TYPE 'MAS'; did you mean 'MASS'?"),
                           (ELEMENT.replace(" 2, 3, 6", " 2, 3, 8"), "part.mtx:6: *USER ELEMENT: expected the position of a node and components"),
                           (ELEMENT.replace("5.,", "5.x,"), "part.mtx:10: expected a number, found '5.x'"),
                           ("*HEADING\n", "expected one *USER ELEMENT, found 0"), ("", "holds no entries")):
            self.write("part_MASS1.mtx", "")
            with self.subTest(told):
                path = self.element(text)
                self.refuse("abaqus", path, told, mass=path if told == "holds no entries" else "")
        self.refuse("abaqus", self.element(nodes=NODES + "*TRANSFORM, NSET=A\n1, 0, 0, 0, 1, 0\n"), "part.inp:4: *TRANSFORM turns the unknowns")
        body = cloud_body()
        body.stiffness[0, 1] += 1e3
        with self.assertRaisesRegex(Exception, "the stiffness is not symmetric"):
            formats.module_of("abaqus").write(body, self.path("n.mtx"), self.options())


class Assembled(Exchange):
    """Two unknowns of each of two nodes, in the two forms."""

    LABELLED = "4,1, 4,1, 2.0D+00\n4,1, 2,3, -1.e+00\n2,3, 2,3, 3\n"

    def files(self, stiffness=LABELLED, mass="4,1, 4,1, 1\n2,3, 2,3, 1\n"):
        self.write("job.inp", NODES)
        self.write("job_MASS1.mtx", mass)
        return self.write("job_STIF1.mtx", stiffness)

    def test_labelled(self):
        found = self.read("abaqus", self.files())
        np.testing.assert_array_equal(found.stiffness.toarray(), [[3, -1], [-1, 2]])
        np.testing.assert_array_equal(found.unknown_components, [2, 0])
        np.testing.assert_array_equal(found.numbers[found.unknown_nodes], [2, 4])

    def test_coordinate(self):
        # The rows are in ascending order of the nodes, 2 x y z, 4 x y z, or in the order of a table.
        mass = "".join(f"{k} {k} 1\n" for k in range(1, 7))
        stiffness = "1 1 5\n1 6 -2.5e0\n6 1 -2.5e0\n" + "".join(f"{k} {k} 4\n" for k in range(2, 7))
        found = self.read("abaqus", self.files(stiffness, mass))
        np.testing.assert_array_equal(found.numbers[found.unknown_nodes], [2, 2, 2, 4, 4, 4])
        self.assertEqual((found.stiffness[0, 5], found.stiffness[5, 0], found.stiffness[0, 0]), (-2.5, -2.5, 5))
        table = self.write("order.csv", "component,node\nz,4\nx,2\ny,2\nrx,4\n1,4\n-,0\n")
        found = self.read("abaqus", self.files(stiffness, mass), unknowns=table)
        np.testing.assert_array_equal(found.unknown_nodes, [0, 1, 1, 0, 0, -1])
        np.testing.assert_array_equal(found.unknown_components, [2, 0, 1, 3, 0, 0])
        self.refuse("abaqus", self.files(stiffness.replace("6", "7"), mass), "2 nodes with 3 or 6 unknowns each do not make the 7 rows")

    def test_no_damping(self):
        """A body without damping, or with an empty damping matrix, has no damping file."""
        body = cloud_body(damping=False)
        body.damping = 0 * body.stiffness
        body.damping.eliminate_zeros()
        paths = formats.module_of("matrix_input").write(body, self.path("d.mtx"), self.options())
        self.assertEqual([os.path.basename(path) for path in paths], ["d_STIF1.mtx", "d_MASS1.mtx", "d_nodes.inp"])
        self.write("d_DMPV1.mtx", "")
        self.same(self.read("matrix_input", paths[0]), body, damping=False)
        self.refuse("abaqus", self.files(mass=""), "job_MASS1.mtx': holds no entries")

    def test_both_triangles_stay_as_they_are(self):
        found = self.read("abaqus", self.files("4,1, 4,1, 2\n4,1, 2,3, -1\n2,3, 4,1, -1.5\n2,3, 2,3, 3\n"))
        self.assertEqual(sorted((found.stiffness[0, 1], found.stiffness[1, 0])), [-1.5, -1])

    def test_each_pair_once_on_either_side(self):
        """The entries of a symmetric matrix are above and below the diagonal."""
        mass = "".join(f"{node},{component}, {node},{component}, 1\n" for node in (2, 4) for component in (1, 2))
        found = self.read("abaqus", self.files(mass + "2,1, 4,1, 5\n4,2, 2,1, 6\n", mass))
        np.testing.assert_array_equal(found.stiffness.toarray(), [[1, 0, 5, 6], [0, 1, 0, 0], [5, 0, 1, 0], [6, 0, 0, 1]])

    def test_refusals(self):
        for text, told in (("4,1, 4,1, 1e36\n2,3, 2,3, 3\n", "1 unknown held by boundary conditions (node 4, component 1)"),
                           ("4,1, 4,1, 2\n-1,1, 4,1, 1\n2,3, 2,3, 3\n", "node -1 is a Lagrange multiplier"),
                           ("4,1, 4,8, 2\n", "node 4 has the component 8"), ("4,1, 4.5,1, 2\n", "a node or component is 4.5"),
                           ("4,1, 4,1, 2\n4,1,4\n", "job_STIF1.mtx:2: expected 5 numbers, found 3"),
                           ("4,1, 5,1, 2\n", "node 5 has no position"), ("4,1, 4,1, nan\n2,3, 2,3, 3\n", "not finite"),
                           (self.LABELLED + "4,1, 2,3, -1\n", "job_STIF1.mtx': the entry of node 4 component 1 and node 2 component 3 stands twice"),
                           ("1 1 2\n", "one file has rows and columns")):
            with self.subTest(told):
                self.refuse("abaqus", self.files(text), told)
        self.refuse("abaqus", self.write("other.mtx", self.LABELLED), "the file of the mass matrix is missing", nodes=self.path("job.inp"))


if __name__ == "__main__":
    unittest.main()
