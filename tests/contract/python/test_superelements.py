"""Tests of superelements from arrays: the file of matrices that the program gets, and the messages about wrong
arrays."""

import os
import stat
import tempfile
import unittest

import bielle
import h5py
import numpy as np
import scipy.sparse

# A bar along x between two nodes with 3 unknowns each, and an amplitude.
K = np.zeros((7, 7))
K[np.ix_([0, 3], [0, 3])] = [[1, -1], [-1, 1]]
K[6, 6] = 4
M = np.eye(7)
PLACES = [[0, 0, 0], [1, 0, 0]]


class Superelements(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.output = os.path.join(folder.name, "bar.matrices.h5")
        self.folder = folder.name

    def test_file_of_matrices(self):
        sparse = scipy.sparse.coo_matrix(K)
        self.assertEqual(bielle.superelement(self.output, sparse, M, PLACES, scalars=1, interfaces={"root": 1, "tip": 2}, length_unit="mm",
                                             mass_unit="t"), self.output)
        with h5py.File(self.output) as file:
            self.assertEqual((file.attrs["format"], file.attrs["name"], file.attrs["length_unit"], file.attrs["mass_unit"]),
                             ("bielle matrices", "bar", "mm", "t"))
            self.assertEqual(file["unknowns/nodes"][()].tolist(), [0, 0, 0, 1, 1, 1, -1])
            self.assertEqual(file["unknowns/components"][()].tolist(), [0, 1, 2, 0, 1, 2, 0])
            self.assertEqual(file["interfaces/names"].asstr()[()].tolist(), ["root", "tip"])
            full = np.zeros((7, 7))
            full[file["stiffness/rows"][()], file["stiffness/columns"][()]] = file["stiffness/values"][()]
            np.testing.assert_array_equal(full, K)

    def test_order_of_unknowns(self):
        order = [(8, 2), (0, 0), (5, 0)]
        bielle.superelement(self.output, np.eye(3), np.eye(3), PLACES, nodes=[5, 8], unknowns=order, C=np.eye(3))
        with h5py.File(self.output) as file:
            self.assertEqual(file["nodes/numbers"][()].tolist(), [5, 8])
            self.assertEqual(file["unknowns/nodes"][()].tolist(), [1, -1, 0])
            self.assertEqual(file["unknowns/components"][()].tolist(), [2, 0, 0])
            self.assertIn("damping", file)

    def test_recovery(self):
        gauges = np.arange(14.0).reshape(2, 7)
        bielle.superelement(self.output, K, M, PLACES, scalars=1, points=[[0.5, 0, 0]], displacement=np.ones((3, 7)), stress=np.ones((6, 7)),
                            quantities={"gauges": (gauges, ["front", "rear"], "Pa"), "ends": (gauges, ["pull", "bend"], ["N", "N m"])})
        with h5py.File(self.output) as file:
            self.assertEqual(file["shapes/stress"].shape, (6, 7))
            np.testing.assert_array_equal(file["quantities/gauges/matrix"], gauges)
            self.assertEqual(file["quantities/gauges/rows"].asstr()[()].tolist(), ["front", "rear"])
            self.assertEqual(file["quantities/ends/units"].asstr()[()].tolist(), ["N", "N m"])
        for quantities, told in (({"gauges": (gauges, ["a", "b"], "strain")}, "has the unit 'strain': that of strain is m/m; known ones: Pa, m/m"),
                                 ({"gauges": (gauges[:, :6], ["a", "b"], "Pa")}, "'quantity.gauges.matrix' is float64 of shape (2, 6)"),
                                 ({"gauges": (gauges, ["a"], "Pa")}, "the quantity 'gauges' has 1 row"),
                                 ({"gauges": (gauges, ["a", "b"], "MPa")}, "the unit 'MPa'"), ({"a b": (gauges, ["a", "b"], "Pa")}, "there is no key")):
            with self.subTest(told), self.assertRaises(bielle.InputError) as caught:
                bielle.superelement(self.output, K, M, PLACES, scalars=1, quantities=quantities)
            self.assertIn(told, str(caught.exception))
        with self.assertRaisesRegex(bielle.InputError, "'stress' belongs to 'points'"):
            bielle.superelement(self.output, K, M, PLACES, scalars=1, stress=np.ones((6, 7)))

    def test_wrong_arrays(self):
        for arguments, told in (((K, M[:3, :3], PLACES), "7 rows are not 3 or 6 unknowns of each of 2 nodes and 0 scalars"),
                                ((K[:6, :6], M, PLACES), "the mass has 7 x 7 entries for 6 unknowns"),
                                ((K[:6, :6] * np.nan, M, PLACES), "'K' holds numbers that are not finite"),
                                ((K[:6, :5], M, PLACES), "'K' has 6 rows and 5 columns"), ((K[:6, :6], M, [[0, 0], [1, 0]]), "'positions' is")):
            with self.subTest(told), self.assertRaises(bielle.InputError) as caught:
                bielle.superelement(self.output, *arguments)
            self.assertIn(told, str(caught.exception))
        with self.assertRaisesRegex(bielle.InputError, "'interface_nodes' names node 9"):
            bielle.superelement(self.output, K[:6, :6], M[:6, :6], PLACES, interfaces={"tip": 9})

    def test_the_program_is_called(self):
        """A stand-in for bielle-reduce prints its arguments as an error."""
        program = os.path.join(self.folder, "bielle-reduce")
        with open(program, "w", encoding="utf-8") as file:
            file.write('#!/bin/sh\ntest -f "$2" && echo "$1 $3 $4 $5 $6" >&2\nexit 1\n')
        os.chmod(program, os.stat(program).st_mode | stat.S_IXUSR)
        output = os.path.join(self.folder, "bar.h5")
        with self.assertRaises(bielle.InputError) as caught:
            bielle.superelement(output, K, M, PLACES, scalars=1, arguments=["--verify"], program=program)
        self.assertEqual(str(caught.exception), f"--from -o {output} --quiet --verify")
        with self.assertRaisesRegex(bielle.InputError, "there is no program /nowhere"):
            bielle.superelement(output, K, M, PLACES, scalars=1, program="/nowhere")


if __name__ == "__main__":
    unittest.main()
