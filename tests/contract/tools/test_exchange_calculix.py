"""Tests of matrices of CalculiX: written files, and files of runs of the program if it is installed."""

import os
import shutil
import subprocess
import unittest

import numpy as np
import scipy.linalg

from exchange_bodies import Exchange, cloud_body, rigid_of
from kuhn_cubes import kuhn_cubes

MATERIAL = "*MATERIAL, NAME=M\n*ELASTIC\n200000., 0.3\n*DENSITY\n4.\n"
STORE = "*STEP\n*FREQUENCY, SOLVER=MATRIXSTORAGE\n1\n*END STEP\n"
EXPANDED = "*STEP\n*FREQUENCY\n1\n*NODE FILE, OUTPUT=3D\nU\n*END STEP\n"
PLATE = """*NODE
1, 0., 0., 0.
2, 1., 0., 0.
3, 1., 1., 0.
4, 0., 1., 0.
5, .5, 0., 0.
6, 1., .5, 0.
7, .5, 1., 0.
8, 0., .5, 0.
9, 2., 0., 0.
10, 2., 1., 0.
11, 1.5, 0., 0.
12, 2., .5, 0.
13, 1.5, 1., 0.
*ELEMENT, TYPE=S8, ELSET=E
1, 1, 2, 3, 4, 5, 6, 7, 8
2, 2, 9, 10, 3, 11, 12, 13, 6
*SHELL SECTION, ELSET=E, MATERIAL=M
0.1
"""


def tetrahedra(cubes):
    """Returns a deck of cubes in a row, each of six tetrahedra with ten nodes around a diagonal."""
    numbers, elements = kuhn_cubes(cubes)
    nodes = "".join(f"{number}, {x}, {y}, {z}\n" for (x, y, z), number in numbers.items())
    cells = "".join(f"{k}, {', '.join(map(str, element))}\n" for k, element in enumerate(elements, 1))
    return f"*NODE\n{nodes}*ELEMENT, TYPE=C3D10, ELSET=E\n{cells}*SOLID SECTION, ELSET=E, MATERIAL=M\n{MATERIAL}"


class Files(Exchange):
    """Three unknowns of two nodes."""

    def files(self, sti="1 1 2.0E+00\n1 2 -1.\n2 2 3\n1 3 0\n3 3 4.5\n", mas="1 1 1\n2 2 1\n3 3 1.0D+00\n", dof="5.1\n5.2\n7.3\n"):
        self.write("job.inp", "*NODE\n7, 1, 2, 3\n5, 0, 0, 1\n")
        self.write("job.mas", mas)
        self.write("job.dof", dof)
        return self.write("job.sti", sti)

    def test_files(self):
        found = self.read("calculix", self.files())
        np.testing.assert_array_equal(found.stiffness.toarray(), [[2, -1, 0], [-1, 3, 0], [0, 0, 4.5]])
        np.testing.assert_array_equal(found.positions[found.unknown_nodes], [[0, 0, 1], [0, 0, 1], [1, 2, 3]])
        np.testing.assert_array_equal(found.unknown_components, [0, 1, 2])
        self.assertIn("2 nodes with less than three unknowns", found.notes[0])

    def test_refusals(self):
        for given, told in (({"sti": "1 1 2\n2 2 3\n"}, "row 3 has no entry on the diagonal: the file is truncated"),
                            ({"sti": "1 1 2\n2 2 3\n4 4 3\n"}, "has the rows and columns 1 to 4, but the .dof file has 3 unknowns"),
                            ({"sti": "1 1 2\n2 2\n"}, "job.sti:2: expected 3 numbers, found 2"), ({"dof": "5.1\n5\n"}, "job.dof:2: expected node.component"),
                            ({"dof": "5.1\n5.7\n"}, "node 5 has the component 7"), ({"dof": ""}, "holds no unknowns"),
                            ({"dof": "5.1\n5.2\n8.3\n"}, "node 8 has no position"),
                            ({"dof": "5.1\n5.2\n5.1\n"}, "a step *FREQUENCY with *NODE FILE, OUTPUT=3D before")):
            with self.subTest(told):
                self.refuse("calculix", self.files(**given), told)
        os.remove(self.path("job.mas"))
        self.write("job.dof", "5.1\n")
        self.refuse("calculix", self.path("job.sti"), "job.mas' of the same job is missing")

    def test_substructure(self):
        body = cloud_body()
        self.same(self.read_back("calculix", body, self.path("a.mtx")), body)
        # Abaqus' reader also accepts the form of CalculiX, which has a node for each unknown.
        self.same(self.read("abaqus", self.path("a.mtx"), nodes=self.path("a_nodes.inp")), body)


@unittest.skipUnless(shutil.which("ccx"), "CalculiX is not installed (Debian: calculix-ccx)")
class Runs(Exchange):
    def run_job(self, text):
        self.write("job.inp", text)
        subprocess.run(["ccx", "job"], cwd=self.folder, check=True, capture_output=True, timeout=120)

    def check_rigid(self, found, mass, centre, inertia, within):
        """Asserts that rigid motions cause no forces and have the inertia of a box."""
        motions = rigid_of(found.positions, 3)[3 * found.unknown_nodes + found.unknown_components]
        K, M = found.stiffness.toarray(), found.mass.toarray()
        self.assertLess(np.abs(K @ motions).max(), within * np.abs(K).max())
        expected = np.zeros((6, 6))
        cross = np.array([[0, -centre[2], centre[1]], [centre[2], 0, -centre[0]], [-centre[1], centre[0], 0]])
        expected[:3, :3] = mass * np.eye(3)
        expected[3:, :3], expected[:3, 3:] = mass * cross, -mass * cross
        expected[3:, 3:] = inertia
        np.testing.assert_allclose(motions.T @ M @ motions, expected, rtol=0, atol=within * np.abs(expected).max())

    def test_solid(self):
        corners = np.array([(0, 0, 0), (1, 0, 0), (0, 2, 0), (0, 0, 3)], float)
        edges = ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))
        places = np.concatenate([corners, [(corners[a] + corners[b]) / 2 for a, b in edges]])
        nodes = "".join(f"{10 * k}, {x}, {y}, {z}\n" for k, (x, y, z) in enumerate(places, 1))
        self.run_job(f"*NODE\n{nodes}*ELEMENT, TYPE=C3D10, ELSET=E\n1, " + ", ".join(str(10 * k) for k in range(1, 11)) +
                     f"\n*SOLID SECTION, ELSET=E, MATERIAL=M\n{MATERIAL}{STORE}")
        found = self.read("calculix", self.path("job.sti"))
        self.assertEqual((found.size, len(found.numbers), found.notes), (30, 10, []))
        # A tetrahedron with legs a b c has V = abc / 6, the moment a^2 V / 10 of x^2, and a b V / 20 of xy.
        legs, mass = np.array([1.0, 2, 3]), 4.0
        second = mass * np.outer(legs, legs) / 20 * (1 + np.eye(3))
        self.check_rigid(found, mass, legs / 4, np.trace(second) * np.eye(3) - second, 1e-12)
        self.assertEqual(np.count_nonzero(np.linalg.eigvalsh(found.stiffness.toarray()) > 1), 24)

    def test_internal_modes(self):
        """The unknowns of internal nodes of C3D8I are condensed; the reference is the dense Schur complement of
        CalculiX' own entries."""
        corners = [(x, y, z) for z in (0, 1, 2) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))]
        nodes = "".join(f"{k}, {x}, {y}, {z}\n" for k, (x, y, z) in enumerate(corners, 1))
        self.run_job(f"*NODE\n{nodes}*ELEMENT, TYPE=C3D8I, ELSET=E\n1, 1, 2, 3, 4, 5, 6, 7, 8\n2, 5, 6, 7, 8, 9, 10, 11, 12\n"
                     f"*SOLID SECTION, ELSET=E, MATERIAL=M\n{MATERIAL}{STORE}")
        found = self.read("calculix", self.path("job.sti"))
        self.assertEqual(found.notes, ["the internal modes of C3D8I are condensed, without their mass"])
        full = np.zeros((54, 54))
        for i, j, value in np.loadtxt(self.path("job.sti")):
            full[int(i) - 1, int(j) - 1] = full[int(j) - 1, int(i) - 1] = value
        schur = full[:36, :36] - full[:36, 36:] @ np.linalg.solve(full[36:, 36:], full[36:, :36])
        np.testing.assert_allclose(found.stiffness.toarray(), schur, rtol=0, atol=1e-12 * np.abs(full).max())
        second = np.array([[8 / 3, 2, 4], [2, 8 / 3, 4], [4, 4, 32 / 3]])
        self.check_rigid(found, 8, (0.5, 0.5, 1), np.trace(second) * np.eye(3) - second, 1e-12)

    def test_plate(self):
        self.run_job(PLATE + MATERIAL + EXPANDED + STORE)
        found = self.read("calculix", self.path("job.sti"))
        self.assertEqual((found.size, len(found.numbers)), (96, 32))
        # A box of 2 x 1 x 0.1 with its middle plane at z = 0; the .frd file has 6 digits.
        a, b, t = 2, 1, 0.1
        mass = 4 * a * b * t
        xx, yy, zz, xy = mass * a**2 / 3, mass * b**2 / 3, mass * t**2 / 12, mass * a * b / 4
        inertia = np.array([[yy + zz, -xy, 0], [-xy, xx + zz, 0], [0, 0, xx + yy]])
        self.check_rigid(found, mass, (a / 2, b / 2, 0), inertia, 1e-6)
        self.assertEqual(set(np.round(found.positions[:, 2], 9)), {-0.05, 0, 0.05})

    def own_frequencies(self, count):
        """Returns the frequencies [Hz] that CalculiX prints."""
        rows = []
        with open(self.path("job.dat"), encoding="utf-8") as file:
            for line in file:
                words = line.split()
                if len(words) == 5 and words[0] == str(len(rows) + 1) and len(rows) < count:
                    rows.append(float(words[3]))
        self.assertEqual(len(rows), count)
        return np.array(rows)

    def test_frequencies_are_those_of_calculix(self):
        """Compares eigenvalues of the matrices that were read with those of CalculiX' own step, which prints seven
        digits."""
        solid = tetrahedra(3)
        for told, deck in (("C3D10", solid), ("S8", PLATE + MATERIAL)):
            with self.subTest(told):
                self.run_job(deck + EXPANDED.replace("1\n*NODE", "12\n*NODE") + STORE)
                found = self.read("calculix", self.path("job.sti"))
                # The mass of these tetrahedra is singular, since it is integrated at four points, but K + M is not.
                K, M = found.stiffness.toarray(), found.mass.toarray()
                values = 1 / scipy.linalg.eigh(M, K + M, eigvals_only=True)[::-1][6:12] - 1
                np.testing.assert_allclose(np.sqrt(values) / (2 * np.pi), self.own_frequencies(12)[6:], rtol=1e-6)
                (kind, cells), = found.cells.items()  # CalculiX expands S8 to C3D20
                self.assertEqual((kind, cells.shape), (11, (18, 10)) if told == "C3D10" else (17, (2, 20)))
                block = found.positions[cells]
                first, rest = block[:, :4 if kind == 11 else 8], block[:, 4 if kind == 11 else 8:]
                # Each further node is the middle of an edge, in gmsh's order.
                ends = ((0, 1), (1, 2), (2, 0), (3, 0), (2, 3), (3, 1)) if kind == 11 else (
                    (0, 1), (0, 3), (0, 4), (1, 2), (1, 5), (2, 3), (2, 6), (3, 7), (4, 5), (4, 7), (5, 6), (6, 7))
                np.testing.assert_allclose(rest, np.stack([(first[:, a] + first[:, b]) / 2 for a, b in ends], axis=1), atol=1e-6)

    def test_plate_without_its_nodes(self):
        self.run_job(PLATE + MATERIAL + STORE)
        self.refuse("calculix", self.path("job.sti"), "*NODE FILE needs OUTPUT=3D")

    def test_substructure(self):
        nodes = "".join(f"{k}, {x}, {y}, {z}\n" for k, (x, y, z) in
                        enumerate(((x, y, z) for z in (0, 1, 2) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))), 1))
        deck = (f"*NODE\n{nodes}*ELEMENT, TYPE=C3D8, ELSET=E\n1, 1, 2, 3, 4, 5, 6, 7, 8\n2, 5, 6, 7, 8, 9, 10, 11, 12\n"
                f"*SOLID SECTION, ELSET=E, MATERIAL=M\n{MATERIAL}")
        self.run_job(deck + "*STEP\n*SUBSTRUCTURE GENERATE\n*RETAINED NODAL DOFS, SORTED=NO\n1, 1, 3\n2, 1, 3\n3, 1, 3\n"
                     "*SUBSTRUCTURE MATRIX OUTPUT, FILE NAME=part, OUTPUT FILE=USER DEFINED, STIFFNESS=YES\n*END STEP\n")
        path = self.path("part.mtx")
        self.refuse("calculix", path, "holds no mass matrix", nodes=self.path("job.inp"))
        with open(path, encoding="utf-8") as file:
            text = file.read()
        self.write("part.mtx", text + "*MATRIX, TYPE=MASS\n" + "".join("0, " * k + "1\n" for k in range(9)))
        found = self.read("calculix", path, nodes=self.path("job.inp"))
        # The reference is the condensation of the full matrices of another run. CalculiX 2.20 writes only their block
        # of the retained unknowns.
        self.run_job(deck + STORE)
        full = self.read("calculix", self.path("job.sti")).stiffness.toarray()
        schur = full[:9, :9] - full[:9, 9:] @ np.linalg.solve(full[9:, 9:], full[9:, :9])
        differences = [np.abs(found.stiffness.toarray() - expected).max() for expected in (schur, full[:9, :9])]
        self.assertLess(min(differences), 1e-12 * np.abs(full).max())


if __name__ == "__main__":
    unittest.main()
