"""Tests of Matrix Market files with tables of nodes and unknowns."""

import unittest

import numpy as np

from exchange_bodies import Exchange, cloud_body, turned
from bielle_tools.exchange import formats
from bielle_tools.exchange.axes import in_body_axes

HEAD = "%%MatrixMarket matrix coordinate real symmetric\n% a comment\n"
STIFFNESS = HEAD + "3 3 4\n1 1 2.0D0\n2 1 -1.5\n2 2 3\n3 3 1e-2\n"
MASS = "%%MatrixMarket matrix array real general\n3 3\n" + "1\n0\n0\n" + "0\n1\n0\n" + "0\n0\n1.d0\n"


class MatrixMarket(Exchange):
    def files(self, stiffness=STIFFNESS, mass=MASS, nodes="node,x,y,z\n9,1.5,2d0,-3\n"):
        self.write("K_mass.mtx", mass)
        self.write("K_nodes.csv", nodes)
        return self.write("K_stiffness.mtx", stiffness)

    def test_files(self):
        for end in ("\n", "\r\n"):
            path = self.files(*(text.replace("\n", end) for text in (STIFFNESS, MASS)))
            self.assertEqual(formats.format_of(path), "matrix_market")
            found = self.read("matrix_market", path)
            np.testing.assert_array_equal(found.stiffness.toarray(), [[2, -1.5, 0], [-1.5, 3, 0], [0, 0, 0.01]])
            np.testing.assert_array_equal(found.mass.toarray(), np.eye(3))
            np.testing.assert_array_equal(found.positions, [[1.5, 2, -3]])
            np.testing.assert_array_equal(found.unknown_components, [0, 1, 2])

    def test_general_matrices_keep_both_triangles(self):
        found = self.read("matrix_market", self.files(STIFFNESS.replace("symmetric", "general")))
        self.assertEqual((found.stiffness[1, 0], found.stiffness[0, 1]), (-1.5, 0))

    def test_round_trip(self):
        body = cloud_body()
        self.same(self.read_back("matrix_market", body, self.path("a.mtx")), body)
        self.same(self.read_back("matrix_market", turned(body), self.path("b.mtx")), in_body_axes(turned(body)))

    def test_refusals(self):
        for given, told in (({"stiffness": STIFFNESS.replace("3 3 1e-2\n", "")}, "the head tells 4 entries, the file has 3"),
                            ({"stiffness": STIFFNESS.replace("real", "complex")}, "expected a square matrix of real numbers, found 3 x 3, complex"),
                            ({"stiffness": STIFFNESS.replace("3 3 4", "3 4 4")}, "found 3 x 4, real"),
                            ({"stiffness": STIFFNESS.replace("2 1 -1.5", "2 7 -1.5")}, "the entries are damaged"),
                            ({"mass": MASS[2:]}, "expected %%MatrixMarket"), ({"mass": HEAD}, "ends before the counts"), ({"mass": MASS.rstrip()[:-20]}, "the head tells 9 entries"),
                            ({"nodes": "node,x,y\n9,1,2\n"}, "K_nodes.csv:1: there is no column 'z'"),
                            ({"nodes": "9,1,2,3\n9,1,2,4\n"}, "node 9 stands twice"), ({"nodes": "9,1,2,3\n8,1,x,4\n"}, "K_nodes.csv:2: expected a number, found 'x'"),
                            ({"nodes": "9,1,2,3\n8,1,nan,4\n"}, "K_nodes.csv:2: node 8 has the coordinate 'nan'; expected a finite number"),
                            ({"nodes": "9,-inf,2,3\n"}, "K_nodes.csv:1: node 9 has the coordinate '-inf'; expected"),
                            ({"nodes": "9,1,2,3\n8,1,2,4\n"}, "2 nodes with 3 or 6 unknowns each do not make the 3 rows"), ({"nodes": ""}, "holds no nodes")):
            with self.subTest(told):
                self.refuse("matrix_market", self.files(**given), told)
        self.refuse("matrix_market", self.files(STIFFNESS.replace("3 3 4", "999999999 999999999 4")), "has 999999999 rows, but the nodes have 6 unknowns")
        path = self.files()
        self.refuse("matrix_market", path, "has 2 unknowns for matrices of 3 rows", unknowns=self.write("u.csv", "9,x\n9,y\n"))
        self.refuse("matrix_market", path, "u.csv:2: there is no component 'xx'", unknowns=self.write("u.csv", "9,x\n9,xx\n"))
        self.refuse("matrix_market", path, "u.csv:1: node 4 has no position", unknowns=self.write("u.csv", "4,x\n"))
        deck = self.write("nodes.inp", "*NODE\n9, 1., nan, 3.\n")
        self.refuse("matrix_market", path, "nodes.inp': node 9 has the position (1, nan, 3); expected finite numbers", nodes=deck)
        self.refuse("matrix_market", self.write("lone.mtx", STIFFNESS), "the positions of the nodes are missing")
        self.refuse("matrix_market", self.path("lone.mtx"), "the file of the mass matrix is missing", nodes=self.path("K_nodes.csv"))


if __name__ == "__main__":
    unittest.main()
