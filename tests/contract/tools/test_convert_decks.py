"""Tests convert_mesh.py with decks as preprocessors write them. The body is a bar of 1 x 0.2 x 0.2 m, for every form of
its cards."""

import os
import unittest

import numpy as np

import test_convert_mesh
from box_mesh import box
from shares import share_of_tests as load_tests  # noqa: E402,F401

SIZE = (1.0, 0.2, 0.2)
VOLUME = 1.0 * 0.2 * 0.2


class Deck(test_convert_mesh.Converter):
    def setUp(self):
        super().setUp()
        self.points, self.cells = box((3, 1, 1), SIZE)
        self.cells = self.cells[:, :4] if self.linear else self.cells
        used = np.unique(self.cells)
        number = np.full(len(self.points), -1)
        number[used] = np.arange(len(used))
        self.points, self.cells = self.points[used], number[self.cells]

    linear = True

    def check_tetrahedra(self, mesh):
        total = 0.0
        for kind in ("tetra", "tetra10"):
            if kind in mesh.cells:
                a, b, c, d = (mesh.points[mesh.cells[kind][:, k]] for k in range(4))
                total += np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a).sum() / 6
        self.assertAlmostEqual(total / VOLUME, 1, delta=1e-5)
        self.assertEqual(sum(len(mesh.cells.get(kind, ())) for kind in ("tetra", "tetra10")), len(self.cells))

    def refuse(self, name, *parts):
        if os.path.exists(self.path("out.msh")):  # removes the output of an earlier test
            os.remove(self.path("out.msh"))
        super().refuse(name, *parts)

    def corners(self, mesh):
        return np.vstack([mesh.points.min(axis=0), mesh.points.max(axis=0)])


class Nastran(Deck):
    def grids(self, system="", places=None):
        return "".join(f"GRID    {i + 1:8d}{system:>8}{x:8.5f}{y:8.5f}{z:8.5f}\n" for i, (x, y, z) in
                       enumerate(self.points if places is None else places))

    def tetrahedra(self, first=0, last=None):
        return "".join(f"CTETRA  {i + 1:8d}{1:8d}" + "".join(f"{n + 1:8d}" for n in row[:6])
                       + ("\n        " + "".join(f"{n + 1:8d}" for n in row[6:]) if len(row) > 6 else "") + "\n"
                       for i, row in list(enumerate(self.cells))[first:last])

    def deck(self, *parts, name="bar.bdf"):
        self.write(name, "SOL 103\nCEND\nBEGIN BULK\nMAT1    1       2.1E11          0.3     7850.\nPSOLID  1       1\n" + "".join(parts) + "ENDDATA\n")
        return name

    def test_grid_points_in_a_moved_and_turned_system(self):
        for cards, system in (("CORD2R         5       0     10.      0.      0.     10.      1.      0.\n             11.      0.      0.\n", "5"),
                              ("GRDSET                 5\nCORD2R,5,0,10.,0.,0.,10.,1.,0.,\n,11.,0.,0.\n", "")):
            mesh = self.convert(self.deck(cards, self.grids(system), self.tetrahedra()))
            # z' is along y and x' in the plane of x and z, hence y' = z' x x' = -z.
            np.testing.assert_allclose(self.corners(mesh), [[10, 0, -0.2], [11, 0.2, 0]], atol=1e-5)

    def test_a_point_of_grdset_may_stand_in_the_basic_system(self):
        cards = "GRDSET,,5\nCORD2R,5,,10.,0.,0.,10.,0.,1.,\n,11.,0.,0.\n"
        mesh = self.convert(self.deck(cards, self.grids("0"), self.tetrahedra()))
        np.testing.assert_allclose(self.corners(mesh), [[0, 0, 0], SIZE], atol=1e-5)

    def test_cylindrical_and_spherical_systems(self):
        x, y, z = self.points.T
        r, R = np.hypot(x, y), np.linalg.norm(self.points, axis=1)
        cylindrical = np.column_stack([r, np.degrees(np.arctan2(y, x)), z])
        spherical = np.column_stack([R, np.degrees(np.arccos(np.divide(z, R, out=np.ones_like(z), where=R > 0))), np.degrees(np.arctan2(y, x))])
        for kind, places in (("C", cylindrical), ("S", spherical)):
            grids = "".join(f"GRID*   {i + 1:16d}{7:16d}{a:16.9f}{b:16.9f}\n*       {c:16.9f}\n" for i, (a, b, c) in enumerate(places))
            mesh = self.convert(self.deck(f"CORD2{kind},7,,0.,0.,0.,0.,0.,1.,\n,1.,0.,0.\n", grids, self.tetrahedra()))
            np.testing.assert_allclose(self.corners(mesh), [[0, 0, 0], SIZE], atol=1e-7)

    def test_systems_of_grid_points_and_in_other_systems(self):
        # CORD1R is defined by three points; CORD2R in it is moved back along its axes to the place of the basic system.
        extra = "GRID,901,,5.,0.,0.\nGRID,902,,5.,0.,1.\nGRID,903,,6.,0.,0.\nCORD1R,3,901,902,903\nCORD2R,4,3,-5.,0.,0.,-5.,0.,1.,\n,-4.,0.,0.\n"
        mesh = self.convert(self.deck(extra, self.grids("4"), self.tetrahedra()))
        np.testing.assert_allclose(self.corners(mesh), [[0, 0, 0], SIZE], atol=1e-5)

    def test_included_files(self):
        self.write("rest.inc", self.tetrahedra(5))
        self.convert(self.deck(self.grids(), self.tetrahedra(0, 5), "INCLUDE 'rest.inc'\n"))
        self.refuse(self.deck(self.grids(), "INCLUDE 'none.inc'\n"), "line", "none.inc", "no such file")
        self.write("self.inc", "INCLUDE 'self.inc'\n")
        self.refuse(self.deck(self.grids(), "INCLUDE 'self.inc'\n"), "included by itself")

    def test_included_files_are_sought_next_to_their_file_and_next_to_the_deck(self):
        os.makedirs(self.path("parts"))
        self.write("rest.inc", self.tetrahedra(5))
        self.write("parts/some.inc", self.tetrahedra(0, 5) + "INCLUDE 'rest.inc'\n")
        self.convert(self.deck(self.grids(), "INCLUDE 'parts\\some.inc'\n"))
        self.write("rest.inc", "the file next to the one that includes it comes first")
        self.write("parts/rest.inc", self.tetrahedra(5))
        self.convert(self.deck(self.grids(), "INCLUDE 'parts/some.inc'\n"))
        self.write("parts/some.inc", "INCLUDE 'none.inc'\n")
        self.refuse(self.deck(self.grids(), "INCLUDE 'parts/some.inc'\n"), "some.inc': line 1", "no such file", "parts' or '")

    def marked(self, own):
        """Returns cards in large fields, [card][line]. A line ends with a mark, with which the next line of its card
        begins. @param own:  each card has its own marks"""
        cards = []
        for i, row in enumerate(self.cells):
            fields = [i + 1, 1, *(n + 1 for n in row)]
            parts = [fields[k:k + 4] for k in range(0, len(fields), 4)]
            marks = [f"*{i if own else ''}{letter}" for letter in "abc"]
            cards.append([("CTETRA*" if k == 0 else marks[k - 1]).ljust(8) + "".join(f"{n:16d}" for n in part).ljust(64) + (marks[k] if k + 1 < len(parts) else "") + "\n"
                          for k, part in enumerate(parts)])
        return cards

    def test_continuations_by_their_marks(self):
        shared = self.marked(False)
        self.convert(self.deck(self.grids(), *(line for column in zip(*shared) for line in column)))
        cards = self.marked(True)
        columns = list(zip(*cards))
        for lines in ([line for card in cards for line in card], [line for column in columns for line in column],
                      [*columns[0], *(line for column in columns[1:] for line in column[::-1])],
                      [line for column in columns[::-1] for line in column]):
            self.convert(self.deck(self.grids(), *lines))
        self.convert(self.deck(*(line for column in columns[:0:-1] for line in column), "PSOLID,1,1\n", self.grids(), *columns[0]))
        self.refuse(self.deck(self.grids(), cards[0][0], "*E7     " + cards[0][1][8:]), "line", "no line of the deck ends with the mark '+E7'")
        self.refuse(self.deck("*E7     " + cards[0][1][8:], self.grids(), self.tetrahedra()), "no line of the deck ends with the mark '+E7'")

    def test_lines_with_more_fields_than_ten(self):
        self.refuse(self.deck(self.grids(), self.tetrahedra(), "SPC1,7,123,1,2,3,4,5,6,,7,8\n"), "12 fields", "a line has 10 at the most")

    def test_supports_and_control_are_told(self):
        self.convert(self.deck(self.grids(), self.tetrahedra(), "SPC1,7,123,1,2,3\nSPC1,7,456,4\nSPC,8,5,12,0.,6,3,0.\n"))
        self.assertIn("supports, SPC 7: 2 cards, components 123, 456; 8: 1 card, components 12, 3: the body is free", self.notes)
        self.assertIn("left out: 2 lines before BEGIN BULK, which control an analysis (SOL 103)", self.notes)

    def test_large_fields_and_free_ones_tabs_and_lower_case(self):
        wide = "".join(f"CTETRA* {i + 1:16d}{1:16d}{a + 1:16d}{b + 1:16d}\n*       {c + 1:16d}{d + 1:16d}\n"
                       for i, (a, b, c, d) in enumerate(self.cells[:9]))
        self.convert(self.deck(self.grids(), wide, self.tetrahedra(9)))
        tabs = "".join(f"GRID\t{i + 1}\t\t{x:.5f}\t{y:.5f}\t{z:.5f}\n" for i, (x, y, z) in enumerate(self.points))
        self.convert(self.deck(tabs, self.tetrahedra()))
        free = "".join(f"grid,{i + 1},,{x:.5f},{y:.5f},{z:.5f} $ a note\n" for i, (x, y, z) in enumerate(self.points))
        self.convert(self.deck(free, self.tetrahedra().lower()))
        blank = self.grids().replace(" 0.00000", "        ")
        self.convert(self.deck(blank, self.tetrahedra()))
        self.convert(self.deck(self.grids(), self.tetrahedra(), name="bar.dat"))

    def test_what_no_tetrahedron_stands_for_is_told(self):
        cards = "PELAS,7,1.0+6\nCELAS1,900001,7,1,1,2,1\nMAT9ORT,2,8.+4,8.+3,8.+3,.3,.3,.3,1.6-9\n"
        self.convert(self.deck(self.grids(), self.tetrahedra(), cards))
        self.assertIn("1 CELAS1 (900001)", self.notes)
        self.assertIn("1 MAT9ORT (2)", self.notes)
        self.convert(self.deck(self.grids(), self.tetrahedra(0, 5), "BEGIN SUPER=1\n", self.tetrahedra(5)))
        self.assertIn("begins a superelement", self.notes)
        self.refuse(self.deck(self.grids(), self.tetrahedra(0, 5), "BEGIN SUPER=1\n", self.grids(), self.tetrahedra(5)), "second GRID 1")

    def test_skins_with_an_angle_are_surfaces(self):
        self.convert(self.deck(self.grids(), self.tetrahedra(), "PSHELL,9,1,1.-3\n" + self.skin()))
        self.assertIn("PSHELL 9", self.notes)

    def skin(self):
        a, b, c = self.cells[0][:3] + 1
        return f"CTRIA3  {900001:8d}{9:8d}{a:8d}{b:8d}{c:8d}      0.\n"

    def test_wrong_cards_are_told_with_their_lines(self):
        self.refuse(self.deck(self.grids("8"), self.tetrahedra()), "coordinate system 8", "does not exist")
        axes = "0.,0.,0.,0.,0.,1.,\n,1.,0.,0.\n"
        chain = "".join(f"CORD2R,{k},{k - 1 if k > 1000 else 0},{axes}" for k in range(1000, 1200))
        self.refuse(self.deck(chain, self.grids("1199"), self.tetrahedra()), "more than 100 coordinate systems refer to each other")
        self.refuse(self.deck(f"CORD2R,5,,{axes}CORD2R,5,,1.,{axes[3:]}", self.grids("5"), self.tetrahedra()), "a second coordinate system 5 (the first: line")
        self.refuse(self.deck(f"CORD2R,0,,{axes}", self.grids(""), self.tetrahedra()), "CORD2R: expected a number from 1 on in field 2, found '0'")
        self.refuse(self.deck("CORD2R,5,5,0.,0.,0.,0.,0.,1.,\n,1.,0.,0.\n", self.grids("5"), self.tetrahedra()), "refers to itself")
        self.refuse(self.deck("CORD2R,5,,0.,0.,0.,0.,0.,1.,\n,0.,0.,2.\n", self.grids("5"), self.tetrahedra()), "stand in one line")
        self.refuse(self.deck(self.grids(), "CTETRA,1,1,1,2,3\n"), "line", "CTETRA 1 has 3 nodes")
        self.refuse(self.deck(self.grids(), "CTETRA,1,1,1,2,3,9999\n"), "grid point 9999")
        self.refuse(self.deck(self.grids(), "CTETRA,1,1,1,2,x,4\n"), "expected an integer in field 6, found 'X'")
        self.refuse(self.deck("GRID,1,,a,0.,0.\n"), "expected a number in field 4")
        self.refuse(self.deck("GRID,2147483648,,0.,0.,0.\n"), "GRID has the number 2147483648, but numbers are from 1 to 2147483647")
        self.refuse(self.deck(self.grids(), self.tetrahedra(), "CTETRA,1,1,1,2,3,4\n"), "there is a second element 1 (the first: CTETRA at line")
        self.refuse(self.deck("$ nothing\n"), "holds no GRID")


class NastranOfSecondOrder(Nastran):
    linear = False

    def test_large_fields_and_free_ones_tabs_and_lower_case(self):
        """Tests continuations without marks, in small and in free fields."""
        self.convert(self.deck(self.grids(), self.tetrahedra()))
        free = "".join(f"CTETRA,{i + 1},1,{','.join(str(n + 1) for n in row[:6])}\n,{','.join(str(n + 1) for n in row[6:])}\n"
                       for i, row in enumerate(self.cells))
        self.convert(self.deck(self.grids(), free))


class Abaqus(Deck):
    material = "*MATERIAL, NAME=STEEL\n*ELASTIC\n2.1E11, 0.3\n*DENSITY\n7850.\n*SOLID SECTION, ELSET=E, MATERIAL=STEEL\n"

    def nodes(self, first=0, last=None):
        return "".join(f"{i + 1}, {x:.9g}, {y:.9g}, {z:.9g}\n" for i, (x, y, z) in list(enumerate(self.points))[first:last])

    def rows(self, first=0, last=None):
        return "".join(f"{i + 1}, " + ", ".join(str(n + 1) for n in row) + "\n" for i, row in list(enumerate(self.cells))[first:last])

    def deck(self, text):
        self.write("bar.inp", text + self.material)
        return "bar.inp"

    def whole(self):
        return f"*NODE\n{self.nodes()}*ELEMENT, TYPE=C3D4, ELSET=E\n{self.rows()}"

    def test_data_lines_in_other_files(self):
        self.write("nodes.dat", self.nodes(4))
        self.write("elements.dat", self.rows(5))
        self.convert(self.deck(f"*NODE, INPUT=nodes.dat\n{self.nodes(0, 4)}*ELEMENT, TYPE=C3D4, ELSET=E\n{self.rows(0, 5)}"
                               "*ELEMENT, TYPE=C3D4, ELSET=E, INPUT=elements.dat\n"))
        self.refuse(self.deck("*NODE, INPUT=none.dat\n"), "bar.inp:1", "none.dat")

    def test_nodes_in_a_system(self):
        # The first axis is along y, the second one along -x.
        turned = "*SYSTEM\n10., 0., 0., 10., 1., 0.\n9., 0., 0.\n"
        mesh = self.convert(self.deck(f"{turned}*NODE\n{self.nodes()}*SYSTEM\n*ELEMENT, TYPE=C3D4, ELSET=E\n{self.rows()}"))
        np.testing.assert_allclose(self.corners(mesh), [[9.8, 0, 0], [10, 1, 0.2]], atol=1e-9)
        back = [f"{i + 1}, {x - 10:.9g}, {y:.9g}, {z:.9g}\n" for i, (x, y, z) in enumerate(self.points)]
        mesh = self.convert(self.deck(f"*NODE\n{self.nodes(0, 4)}*SYSTEM\n10., 0., 0.\n*NODE\n{''.join(back[4:])}*SYSTEM\n"
                                      f"*ELEMENT, TYPE=C3D4, ELSET=E\n{self.rows()}"))
        np.testing.assert_allclose(self.corners(mesh), [[0, 0, 0], SIZE], atol=1e-9)
        self.refuse(self.deck(f"*SYSTEM\n0., 0., 0., 1., 0., 0.\n2., 0., 0.\n{self.whole()}"), "bar.inp:1", "one line")

    def test_what_moves_nodes_is_refused_by_name(self):
        for keyword in ("*NMAP, NSET=N\n0.,0.,0.\n", "*SYMMETRIC MODEL GENERATION, REVOLVE\n"):
            self.refuse(self.deck(self.whole() + keyword), keyword.split(",")[0].split("\n")[0], "write the mesh out in full")

    def test_couplings_and_constraints_are_told(self):
        self.convert(self.deck(self.whole() + "*NODE\n9001, 0., .1, .1\n*NSET, NSET=LEFT\n1, 2\n*RIGID BODY, NSET=LEFT, REF NODE=9001\n"
                               "*SURFACE, NAME=S, TYPE=NODE\nLEFT\n*COUPLING, REF NODE=9001, SURFACE=S, CONSTRAINT NAME=C\n*DISTRIBUTING\n"
                               "*ELEMENT, TYPE=MASS, ELSET=M\n9001, 9001\n*MASS, ELSET=M\n2.5\n*EQUATION\n2\n1, 1, 1., 2, 1, -1.\n"))
        for word in ("{from: rigid body 9001}", "{from: coupling C}", "1 *MASS", "1 *EQUATION"):
            self.assertIn(word, self.notes)

    def test_materials_and_orientations_are_told(self):
        half = len(self.cells) // 2
        self.convert(self.deck(f"*NODE\n{self.nodes()}*ELEMENT, TYPE=C3D4, ELSET=E\n{self.rows(0, half)}*ELEMENT, TYPE=C3D4, ELSET=B\n{self.rows(half)}"
                               "*MATERIAL, NAME=ALU\n*ELASTIC\n7.E10,0.33\n*DENSITY\n2700.\n*SOLID SECTION, ELSET=B, MATERIAL=ALU\n"))
        for word in ("steel: {young: 2.1e+11, poisson: 0.3, density: 7850}", "alu: {young: 7e+10, poisson: 0.33, density: 2700}", "B: alu, E: steel"):
            self.assertIn(word, self.notes)
        self.convert(self.deck(self.whole() + "*ORIENTATION, NAME=O, SYSTEM=CYLINDRICAL\n0., 0., 0., 0., 0., 1.\n*MATERIAL, NAME=C\n"
                               "*ELASTIC, TYPE=ENGINEERING CONSTANTS\n1.4E11,1E10,1E10,.3,.3,.4,5E9,5E9\n3.5E9\n*DENSITY\n1600.\n"
                               "*SOLID SECTION, ELSET=E, MATERIAL=C, ORIENTATION=O\n"))
        for word in ("1 *ORIENTATION", "TYPE=ENGINEERING CONSTANTS", "with an orientation"):
            self.assertIn(word, self.notes)


if __name__ == "__main__":
    unittest.main()
