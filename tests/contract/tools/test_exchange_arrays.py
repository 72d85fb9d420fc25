"""Tests of files of NumPy, MATLAB and FEDEM with complete matrices."""

import struct
import unittest

import h5py
import numpy as np
import scipy.io

from exchange_bodies import Exchange, cloud_body, turned
from bielle_tools.exchange import formats
from bielle_tools.exchange.axes import in_body_axes
from bielle_tools.exchange.superelement_set import shapes_of


class Npz(Exchange):
    def saved(self, **arrays):
        np.savez(self.path("a.npz"), **arrays)
        return self.path("a.npz")

    def test_round_trip(self):
        for body in (cloud_body(), turned(cloud_body())):
            body.interfaces = {"left": 0, "right": 1}
            body.length_unit = "mm"
            found = self.read_back("npz", body, self.path("b.npz"))
            self.same(found, body)
            self.assertEqual((found.interfaces, found.length_unit, found.mass_unit, found.name), (body.interfaces, "mm", None, "cloud"))
            for name in ("mass", "centre", "inertia") if body.mass_properties else ():
                np.testing.assert_array_equal(getattr(found.mass_properties, name), getattr(body.mass_properties, name))
            if body.shapes is not None:
                np.testing.assert_array_equal(found.inertia_components, body.inertia_components)
                for name in ("numbers", "points", "displacement", "masses"):
                    np.testing.assert_array_equal(getattr(found.shapes, name), getattr(body.shapes, name))
            if body.axes is not None:
                np.testing.assert_array_equal(found.axes, body.axes)
        self.assertEqual(formats.format_of(self.path("b.npz")), "npz")

    def test_order_without_a_list(self):
        found = self.read("npz", self.saved(K=np.eye(8), M=np.eye(8), positions=np.zeros((2, 3))))
        np.testing.assert_array_equal(found.unknown_nodes, [0, 0, 0, 1, 1, 1, -1, -1])
        np.testing.assert_array_equal(found.unknown_components, [0, 1, 2, 0, 1, 2, 0, 1])
        found = self.read("npz", self.saved(K=np.eye(7), M=np.eye(7), positions=np.zeros((1, 3))))
        np.testing.assert_array_equal(found.unknown_components, [0, 1, 2, 3, 4, 5, 0])

    def test_refusals(self):
        given = {"K": np.eye(3), "M": np.eye(3), "positions": np.zeros((1, 3))}
        for changed, told in (({"k": 1}, "there is no key 'k'"), ({"M": None}, "the array 'M' is missing"), ({"K": np.eye(2)}, "1 node with 3 unknowns"),
                              ({"K": np.zeros((3, 2))}, "'K' has 3 rows and 2 columns"), ({"positions": np.zeros(3)}, "n x 3 numbers are expected"),
                              ({"K": np.array([{}], object)}, "is no readable .npz file"), ({"positions": np.full((1, 3), np.nan)}, "not finite"),
                              ({"unknown_nodes": [1, 1, 1]}, "'unknown_components' is missing"), ({"nodes": [0]}, "'nodes' must be numbers from 1"),
                              ({"nodes": [1.5]}, "'nodes' holds 1.5; whole numbers are expected"),
                              ({"interface_names": ["a", "b"], "interface_nodes": [1, 1]}, "the interfaces 'a' and 'b' are both node 1"),
                              ({"interface_names": ["a", "a"], "interface_nodes": [1, 1]}, "holds 'a' more than once"),
                              ({"interface_names": ["a"], "interface_nodes": [0]}, "gives 'a' the node 0"),
                              ({"unknown_nodes": [1, 1, 2], "unknown_components": [0, 1, 2]}, "names node 2"),
                              ({"unknown_nodes": [1, 1, 1], "unknown_components": [0, 1, 6]}, "holds 6; 0 to 5"),
                              ({"interface_names": ["a", "b"], "interface_nodes": [1]}, "2 numbers are expected"),
                              ({"mass": 1.0}, "the array 'centre' is missing"), ({"inertia_components": np.zeros((6, 2, 2))}, "6 x 3 x 3 numbers are expected"),
                              ({"points": np.zeros((2, 3)), "displacement": np.zeros((3, 3))}, "6 x 3 numbers are expected")):
            with self.subTest(told):
                self.refuse("npz", self.saved(**{key: array for key, array in (given | changed).items() if array is not None}), told)
        self.refuse("npz", self.path("none.npz"), "cannot read")
        with self.assertRaisesRegex(Exception, "the unknown node 1 x stands twice"):
            self.read("npz", self.saved(**given | {"unknown_nodes": [1, 1, 1], "unknown_components": [0, 0, 1]}))


class Superelement(Exchange):
    def test_recovery_of_some_nodes(self):
        """Tests a file that keeps four of five nodes, with a tetrahedron of them, with another one, and without
        cells."""
        for cells in (True, False):
            with h5py.File(self.path("s.h5"), "w") as file:
                file["mesh/points"], displacement = np.arange(15.0).reshape(5, 3), np.arange(72.0).reshape(12, 6)
                if cells:
                    file["mesh/cells/4"] = [[0, 1, 3, 4], [0, 1, 2, 3]]
                file["recovery/displacement"], file["recovery/displacement_nodes"] = displacement, [0, 1, 3, 4]
                found = shapes_of(file)
            np.testing.assert_array_equal(found.numbers, [1, 2, 4, 5])
            np.testing.assert_array_equal(found.points, np.arange(15.0).reshape(5, 3)[[0, 1, 3, 4]])
            self.assertEqual({kind: block.tolist() for kind, block in found.cells.items()}, {4: [[0, 1, 2, 3]]} if cells else {})


class Simscape(Exchange):
    def test_round_trip(self):
        body = cloud_body()
        self.same(self.read_back("simscape", body, self.path("a.mat")), self.renumbered(body))
        self.same(self.read_back("simscape", turned(body), self.path("b.mat")), self.renumbered(in_body_axes(turned(body))))

    @staticmethod
    def renumbered(body):
        body.numbers = np.arange(1, len(body.numbers) + 1)
        return body

    def test_variables_and_script(self):
        body = cloud_body(damping=False)
        paths = formats.module_of("simscape").write(body, self.path("my arm.mat"), self.options())
        variables = scipy.io.loadmat(paths[0])
        self.assertEqual({name for name in variables if name[0] != "_"}, {"origins", "K", "M"})
        self.assertEqual(paths[1], self.path("my_arm_block.m"))
        with open(paths[1], encoding="utf-8") as file:
            text = file.read()
        self.assertIn("load('my arm.mat')", text)
        self.assertNotIn("body.C", text)

    def test_a_structure(self):
        scipy.io.savemat(self.path("s.mat"), {"arm": {"P": np.ones((1, 3)), "K": np.eye(8), "M": np.eye(8)}})
        found = self.read("simscape", self.path("s.mat"))
        self.assertEqual((found.size, found.scalars, found.positions.tolist()), (8, 2, [[1, 1, 1]]))

    def test_refusals(self):
        for changed, told in (({"K": "text"}, "'K' must be a matrix of finite numbers"), ({"K": np.eye(5)}, "'K' has 5 x 5 numbers; 1 frame need"),
                              ({"M": np.eye(7)}, "'M' has 7 x 7"), ({"origins": np.ones((2, 2))}, "'origins' has 2 x 2"), ({"M": None}, "'M' is missing"),
                              ({"origins": None}, "'origins' (k,3) is missing")):
            variables = {"origins": np.ones((1, 3)), "K": np.eye(6), "M": np.eye(6)} | changed
            scipy.io.savemat(self.path("s.mat"), {name: value for name, value in variables.items() if value is not None})
            with self.subTest(told):
                self.refuse("simscape", self.path("s.mat"), told)
        self.refuse("simscape", self.write("t.mat", "no matlab"), "is no readable .mat file")
        with self.assertRaisesRegex(Exception, "node 3 has no unknown rx: a node of Simscape needs all six"):
            formats.module_of("simscape").write(cloud_body(components=3), self.path("u.mat"), self.options())


class Fedem(Exchange):
    def test_round_trip(self):
        body = cloud_body()
        self.same(self.read_back("fedem", body, self.path("part.fmx")), body, damping=False)

    def test_bytes(self):
        """The layout is that of binaryDB.c and FFaTag.C in the other byte order, with columns one after another."""
        K = np.arange(36.0).reshape(6, 6)
        for name, tag, matrix in (("S", b"stiffness", K), ("M", b"mass", np.eye(6))):
            content = (b"#FEDEM " + tag + b" matrix").ljust(30) + struct.pack(">HII", 0x1234, 0, 77) + b";1.0;\n"
            with open(self.path(f"p_{name}.fmx"), "wb") as file:
                file.write(content + matrix.T.astype(">f8").tobytes())
        self.write("p_nodes.csv", "1,0,0,0\n")
        found = self.read("fedem", self.path("p_S.fmx"))
        np.testing.assert_array_equal(found.stiffness.toarray(), K)
        self.assertEqual(formats.format_of(self.path("p_S.fmx")), "fedem")
        self.refuse("fedem", self.path("p_S.fmx"), "6 rows do not fit the 12 unknowns", nodes=self.write("n.csv", "1,0,0,0\n2,0,0,0\n"))
        self.refuse("fedem", self.path("p_M.fmx"), "the file of the mass matrix is missing")
        with open(self.path("p_M.fmx"), "rb+") as file:
            file.truncate(46 + 35 * 8)
        self.refuse("fedem", self.path("p_S.fmx"), "280 bytes of numbers, which are no square matrix")
        self.write("p_M.fmx", "#FEDEM gravity force vectors")
        self.refuse("fedem", self.path("p_S.fmx"), "expected FEDEM's tag '#FEDEM mass matrix', found '#FEDEM gravity force vectors'")


if __name__ == "__main__":
    unittest.main()
