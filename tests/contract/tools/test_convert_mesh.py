"""Tests that convert_mesh.py converts files of other programs to MSH files with groups that gmsh reads, or prints one
clear sentence."""

import os
import subprocess
import unittest

import meshio
import numpy as np

from box_mesh import REPOSITORY, InFolder, area, box
from gmsh_library import GmshFile
from python_tool import run_python_tool
from shares import share_of_tests as load_tests  # noqa: E402,F401


CONVERT = os.path.join(REPOSITORY, "tools", "convert_mesh.py")
# gmsh's six mid-side nodes, "Gmsh reference manual, Node ordering": 01 12 02 03 23 13
GMSH_EDGES = [[0, 1], [1, 2], [0, 2], [0, 3], [2, 3], [1, 3]]
ABAQUS_TO_GMSH = [0, 1, 2, 3, 4, 5, 6, 7, 9, 8]
SIZE = (0.3, 0.2, 0.1)
VOLUME = 0.3 * 0.2 * 0.1


class Converter(InFolder):
    def setUp(self):
        super().setUp()
        self.points, self.cells = box(size=SIZE)
        self.left = np.flatnonzero(self.points[:, 0] == 0)
        middle = self.points[self.cells].mean(axis=1)
        self.half = np.flatnonzero(middle[:, 0] < 0.15)

    def run_tool(self, name):
        return run_python_tool(CONVERT, [self.path(name), self.path("out.msh")], timeout=120)

    def convert(self, name):
        done = self.run_tool(name)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.notes = done.stderr
        mesh = GmshFile(self.path("out.msh"))
        self.check_tetrahedra(mesh)
        return mesh

    def check_tetrahedra(self, mesh):
        """Asserts the volume of the body up to rounding, and mid-side nodes in the middle of the edges by gmsh's
        order."""
        total = 0.0
        for kind in ("tetra", "tetra10"):
            if kind not in mesh.cells:
                continue
            corners = mesh.points[mesh.cells[kind][:, :4]]
            a, b, c, d = (corners[:, k] for k in range(4))
            volumes = np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a) / 6
            self.assertGreater(volumes.min(), 0)
            total += volumes.sum()
            if kind == "tetra10":
                middles = corners[:, GMSH_EDGES].mean(axis=2)
                mids = mesh.points[mesh.cells[kind][:, 4:]]
                np.testing.assert_allclose(mids, middles, atol=1e-6)  # .bdf files have 8 characters per number
        self.assertAlmostEqual(total / VOLUME, 1, delta=1e-5)

    def refuse(self, name, *parts):
        done = self.run_tool(name)
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)
        self.assertNotIn("Traceback", done.stderr)
        for part in parts:
            self.assertIn(part, done.stderr)
        self.assertFalse(os.path.exists(self.path("out.msh")))

    def inp(self, extra="", kind="C3D10", elset=""):
        nodes = "".join(f"{i + 1}, {x:.17g}, {y:.17g}, {z:.17g}\n" for i, (x, y, z) in enumerate(self.points))
        rows = "".join(f"{i + 1}, " + ",\n  ".join([", ".join(map(str, row[:6] + 1)), ", ".join(map(str, row[6:] + 1))]) + "\n"
                       if len(row) == 10 else f"{i + 1}, " + ", ".join(map(str, row + 1)) + "\n"
                       for i, row in enumerate(self.cells))
        return f"*Heading\n box\n** a comment\n*Node\n{nodes}*Element, type={kind}{elset}\n{rows}{extra}"


class Abaqus(Converter):
    def test_sets_of_elements_and_nodes_become_groups(self):
        numbers = ",\n".join(str(n + 1) for n in self.half)
        left = ",\n".join(str(n + 1) for n in self.left)
        self.write("box.inp", self.inp(f"*Elset, elset=Half\n{numbers}\n*Nset, nset=Left\n{left}\n", elset=", elset=Body"))
        mesh = self.convert("box.inp")
        self.assertEqual(set(mesh.groups), {(3, "Body"), (3, "Half"), (2, "Left")})
        self.assertEqual(len(mesh.groups[3, "Body"]["tetra10"]), len(self.cells))
        self.assertEqual(len(mesh.groups[3, "Half"]["tetra10"]), len(self.half))
        self.assertAlmostEqual(area(mesh.points, mesh.groups[2, "Left"]["triangle6"]), 0.2 * 0.1, delta=1e-12)

    def test_last_two_mid_side_nodes_change_places(self):
        self.write("box.inp", self.inp())
        mesh = self.convert("box.inp")
        expected = self.points[self.cells[:, ABAQUS_TO_GMSH]]
        np.testing.assert_allclose(mesh.points[mesh.cells["tetra10"]], expected, atol=1e-15)

    def test_linear_tetrahedra(self):
        self.points, self.cells = box(size=SIZE, order=1)
        left = ", ".join(str(n + 1) for n in np.flatnonzero(self.points[:, 0] == 0))
        self.write("box.inp", self.inp(f"*NSET,NSET=left\n{left}\n", kind="C3D4"))
        mesh = self.convert("box.inp")
        self.assertAlmostEqual(area(mesh.points, mesh.groups[2, "left"]["triangle"]), 0.2 * 0.1, delta=1e-12)

    def test_generated_sets_and_sets_of_sets(self):
        text = "*Elset, elset=A, generate\n1, 5, 2\n*Elset, elset=B\n7\n*Elset, elset=C\na, B\n9,\n"
        self.write("box.inp", self.inp(text))
        mesh = self.convert("box.inp")
        self.assertEqual({name: len(g["tetra10"]) for (_, name), g in mesh.groups.items()}, {"A": 3, "B": 1, "C": 5})

    def test_surfaces_of_element_faces(self):
        """Each of the four faces is named for all cells; together they contain inner faces twice and outer ones
        once."""
        text = "*Elset, elset=all, generate\n1, %d\n" % len(self.cells)
        text += "".join(f"*Surface, type=element, name=side{k}\nall, S{k}\n" for k in (1, 2, 3, 4))
        self.write("box.inp", self.inp(text))
        mesh = self.convert("box.inp")
        # Abaqus: S1 = 1 2 3, S2 = 1 4 2, S3 = 2 4 3, S4 = 3 4 1
        for k, corners in ((1, [0, 1, 2]), (2, [0, 3, 1]), (3, [1, 3, 2]), (4, [2, 3, 0])):
            faces = {tuple(sorted(face)) for face in self.cells[:, corners].tolist()}
            found = mesh.points[mesh.groups[2, f"side{k}"]["triangle6"][:, :3]].mean(axis=1)
            expected = self.points[np.array(sorted(faces))].mean(axis=1)
            self.assertEqual(len(found), len(expected))
            np.testing.assert_allclose(np.sort(found.round(12), axis=0), np.sort(expected.round(12), axis=0), atol=1e-11)

    def test_surface_of_one_side_and_of_nodes(self):
        faces = []
        for number, row in enumerate(self.cells, start=1):
            for side, corners in (("S1", [0, 1, 2]), ("S2", [0, 3, 1]), ("S3", [1, 3, 2]), ("S4", [2, 3, 0])):
                if set(row[corners]) <= set(self.left):
                    faces.append(f"{number}, {side}")
        text = "*Surface, name=press, type=ELEMENT\n" + "\n".join(faces) + "\n"
        text += "*Nset, nset=l\n" + ",\n".join(str(n + 1) for n in self.left) + "\n*Surface, type=NODE, name=glue\nl\n"
        self.write("box.inp", self.inp(text))
        mesh = self.convert("box.inp")
        for name in ("press", "glue", "l"):
            self.assertAlmostEqual(area(mesh.points, mesh.groups[2, name]["triangle6"]), 0.2 * 0.1, delta=1e-12)

    def test_faces_of_groups_point_outwards(self):
        self.write("box.inp", self.inp("*Nset, nset=l\n" + ",\n".join(str(n + 1) for n in self.left) + "\n"))
        mesh = self.convert("box.inp")
        a, b, c = (mesh.points[mesh.groups[2, "l"]["triangle6"][:, k]] for k in range(3))
        self.assertTrue((np.cross(b - a, c - a)[:, 0] < 0).all())

    def test_files_that_gmsh_writes(self):
        """gmsh writes surfaces as CPS6 and physical groups as ELSET, on which meshio ends the program."""
        triangles = [face for face in self.cells[:, [0, 2, 1, 6, 5, 4]].tolist() if set(face[:3]) <= set(self.left)]
        triangles += [face for face in self.cells[:, [0, 3, 2, 7, 9, 6]].tolist() if set(face[:3]) <= set(self.left)]
        first = len(self.cells) + 1
        rows = "".join(f"{first + i}, " + ", ".join(str(n + 1) for n in face) + "\n" for i, face in enumerate(triangles))
        text = f"*ELEMENT, type=CPS6, ELSET=Surface1\n{rows}*ELSET,ELSET=bore\n"
        text += "".join(f"{first + i},\n" for i in range(len(triangles)))
        self.write("box.inp", self.inp(text))
        mesh = self.convert("box.inp")
        self.assertEqual(len(mesh.groups[2, "bore"]["triangle6"]), len(triangles))
        self.assertGreater(len(triangles), 0)

    def test_one_part_in_an_assembly(self):
        body = self.inp(elset=", elset=Body")
        body = body.replace("*Node\n", "*Part, name=P\n*Node\n", 1)
        text = ("*End Part\n*Assembly, name=A\n*Instance, name=P-1, part=P\n*End Instance\n*Node\n 1, 9, 9, 9\n"
                "*Elset, elset=_press_S1, internal, instance=P-1\n1\n*Surface, type=ELEMENT, name=press\n_press_S1, S1\n"
                "*End Assembly\n*Material, name=steel\n*Elastic\n2e11, 0.3\n")
        self.write("box.inp", body + text)
        mesh = self.convert("box.inp")
        self.assertEqual(set(mesh.groups), {(3, "Body"), (2, "press")})
        self.assertIn("1 reference point of the assembly is left out", self.notes)

    def test_included_files(self):
        text = self.inp()
        nodes, rest = text.split("*Element", 1)
        self.write("nodes.inc", nodes)
        self.write("box.inp", "*INCLUDE, INPUT=nodes.inc\n*Element" + rest)
        self.convert("box.inp")

    def test_unused_reference_point_and_point_mass_are_left_out_and_said(self):
        self.write("box.inp", self.inp("*Node\n9001, 5., 5., 5.\n*Element, type=MASS\n9001, 9001\n"))
        mesh = self.convert("box.inp")
        self.assertEqual(len(mesh.points), len(self.points))
        self.assertIn("MASS", self.notes)
        self.assertIn("left out: 1 point of no tetrahedron", self.notes)

    def test_gmsh_order_in_an_abaqus_file_is_noticed_and_righted(self):
        self.cells = self.cells[:, ABAQUS_TO_GMSH]
        self.write("box.inp", self.inp())
        self.convert("box.inp")
        self.assertIn("last two mid-side nodes", self.notes)

    def test_left_handed_cells_are_turned_over(self):
        mirrored = [0, 2, 1, 3, 6, 5, 4, 7, 9, 8]
        self.cells[::3] = self.cells[::3][:, mirrored]
        self.write("box.inp", self.inp())
        self.convert("box.inp")
        self.assertIn("left-handed", self.notes)

    def test_one_name_for_elements_and_nodes(self):
        left = ",\n".join(str(n + 1) for n in self.left)
        self.write("box.inp", self.inp(f"*Nset, nset=Body\n{left}\n", elset=", elset=Body"))
        mesh = self.convert("box.inp")
        self.assertEqual(set(mesh.groups), {(3, "Body"), (2, "Body_surface")})
        self.assertIn("Body_surface", self.notes)

    def test_node_set_without_a_face_is_said(self):
        self.write("box.inp", self.inp("*Nset, nset=lonely\n1\n"))
        mesh = self.convert("box.inp")
        self.assertEqual(mesh.groups, {})
        self.assertIn("'lonely'", self.notes)


class OtherFormats(Converter):
    def boundary(self):
        """Returns the triangles of the side x = 0 in VTK's order, for formats with surface cells."""
        sides = [[0, 2, 1, 6, 5, 4], [0, 1, 3, 4, 8, 7], [1, 2, 3, 5, 9, 8], [0, 3, 2, 7, 9, 6]]
        return np.array([row[side] for row in self.cells for side in sides if set(row[side]) <= set(self.left)])

    def mesh(self, **data):
        return meshio.Mesh(self.points, [("tetra10", self.cells), ("triangle6", self.boundary())], **data)

    def check_side(self, mesh, name):
        self.assertAlmostEqual(area(mesh.points, mesh.groups[2, name]["triangle6"]), 0.2 * 0.1, delta=1e-6)

    def test_vtu_with_integer_data(self):
        kinds = [np.where(np.isin(np.arange(len(self.cells)), self.half), 1, 2), np.full(len(self.boundary()), 7)]
        self.mesh(cell_data={"region": kinds}).write(self.path("box.vtu"))
        mesh = self.convert("box.vtu")
        self.assertEqual(set(mesh.groups), {(3, "region_1"), (3, "region_2"), (2, "region_7")})
        self.check_side(mesh, "region_7")

    def test_vtu_with_sets_as_meshio_writes_them(self):
        rest = np.setdiff1d(np.arange(len(self.cells)), self.half)
        none = np.array([], int)
        sets = {"near": [self.half, none], "far": [rest, none], "side": [none, np.arange(len(self.boundary()))]}
        self.mesh(cell_sets=sets).write(self.path("box.vtu"))
        mesh = self.convert("box.vtu")
        self.assertEqual(set(mesh.groups), {(3, "near"), (3, "far"), (2, "side")})

    def test_vtk_with_integer_data_on_points(self):
        marks = np.zeros(len(self.points), int)
        marks[self.left] = 4
        meshio.Mesh(self.points, [("tetra10", self.cells)], point_data={"face": marks}).write(self.path("box.vtk"))
        mesh = self.convert("box.vtk")
        self.check_side(mesh, "face_4")

    def test_med_families(self):
        data = self.mesh(cell_data={"cell_tags": [np.where(np.isin(np.arange(len(self.cells)), self.half), -1, -2),
                                                  np.full(len(self.boundary()), -3)]})
        data.cell_tags = {-1: ["near", "body"], -2: ["body"], -3: ["bore"]}
        data.write(self.path("box.med"))
        mesh = self.convert("box.med")
        self.assertEqual(set(mesh.groups), {(3, "near"), (3, "body"), (2, "bore")})
        self.assertEqual(len(mesh.groups[3, "body"]["tetra10"]), len(self.cells))
        self.check_side(mesh, "bore")

    def test_nastran_properties(self):
        kinds = [np.where(np.isin(np.arange(len(self.cells)), self.half), 1, 2), np.full(len(self.boundary()), 7)]
        self.mesh(cell_data={"nastran:ref": kinds}).write(self.path("box.bdf"))
        mesh = self.convert("box.bdf")
        self.assertEqual(set(mesh.groups), {(3, "property_1"), (3, "property_2"), (2, "property_7")})
        self.check_side(mesh, "property_7")

    def test_nastran_without_case_control(self):
        self.mesh().write(self.path("whole.bdf"))
        with open(self.path("whole.bdf"), encoding="utf-8") as file:
            text = file.read().replace("BEGIN BULK\n", "").replace("ENDDATA", "")
        self.write("box.nas", text)
        self.convert("box.nas")

    def nastran(self, extra):
        """Returns the box with more cards before its end."""
        self.mesh().write(self.path("plain.bdf"))
        with open(self.path("plain.bdf"), encoding="utf-8") as file:
            self.write("box.bdf", file.read().replace("ENDDATA", extra + "ENDDATA"))

    def test_nastran_masses_materials_and_rigid_elements_are_converted_or_told(self):
        left = [str(n + 1) for n in self.left]
        members = left[:5]
        rbe2 = "RBE2,77,9001,123456," + ",".join(members) + ",\n"
        for k in range(5, len(left), 8):
            rbe2 += "," + ",".join((left[k:k + 8] + [""] * 8)[:8]) + "\n"
        right = [str(n + 1) for n in np.flatnonzero(self.points[:, 0] == SIZE[0])]
        rbe3 = "RBE3,78,,9002,123456,1.0,123," + ",".join(right[:2]) + "\n"
        for k in range(2, len(right), 8):
            rbe3 += "," + ",".join((right[k:k + 8] + [""] * 8)[:8]) + "\n"
        self.nastran("GRID,9001,,0.0,0.1,0.05\nGRID    9002            .3      .1      .05\n" + rbe2 + rbe3 +
                     "CONM2   1001    9001            10.     \n" + "CONM2*  %-16s%-16s%-16s%-16s\n" % (1002, 9002, "", "25.-1") +
                    "RBE2,79,9002,1,1,2,3\n"
                     "MAT1,5,2.1+11,,.3,7850.\nPSOLID,1,5\nCBUSH,31,1,9001,9002\nMPC,4,9001,1,1.0\n")
        mesh = self.convert("box.bdf")
        self.check_side(mesh, "rbe2_77")
        self.assertAlmostEqual(area(mesh.points, mesh.groups[2, "rbe3_78"]["triangle6"]), 0.2 * 0.1, delta=1e-6)
        for text in ("RBE2 77 (25 nodes): the interface {from: RBE2 77}", "the surface 'rbe3_78'",
                     "2 CONM2 with a mass of 12.5 in total", "1001: 10 at (0, 0.1, 0.05), tied by RBE2 77", "1 CBUSH (31)", "left out: RBE2 79: it takes the components 1 of its nodes", "1 MPC (4)",
                     "MAT1 5 of property_1", "mat_5: {young: 2.1e+11, poisson: 0.3, density: 7850}"):
            self.assertIn(text, self.notes)

    def test_nastran_rigid_element_on_a_node_that_is_none(self):
        self.nastran("RBE2,77,9001,123456,1,2,3\n")
        self.refuse("box.bdf", "RBE2 77", "the node 9001")

    def test_a_numbering_is_no_group(self):
        data = {"GlobalCellId": [np.arange(1000, 1000 + len(self.cells)), np.arange(len(self.boundary()))]}
        self.points, self.cells = box((6, 5, 4), SIZE)
        self.left = np.flatnonzero(self.points[:, 0] == 0)
        data = {"GlobalCellId": [np.arange(1000, 1000 + len(self.cells)), np.arange(len(self.boundary()))]}
        self.mesh(cell_data=data).write(self.path("box.vtu"))
        self.assertEqual(self.convert("box.vtu").groups, {})
        self.assertIn("GlobalCellId", self.notes)


class Refusals(Converter):
    def test_missing_file(self):
        self.refuse("nothing.inp", "nothing.inp", "does not exist")

    def test_unknown_extension(self):
        self.write("box.xyz123", "")
        self.refuse("box.xyz123", "box.xyz123")

    def test_formats_that_need_no_conversion(self):
        self.write("box.step", "")
        self.refuse("box.step", "bielle-reduce reads it")

    def test_cells_that_are_not_known(self):
        meshio.Mesh(np.random.default_rng(1).random((18, 3)), [("wedge18", [list(range(18))])]).write(self.path("wedge.vtu"))
        self.refuse("wedge.vtu", "wedge.vtu", "wedge18", "tetrahedra, hexahedra, wedges and pyramids")
        self.write("cohesive.inp", "*NODE\n" + "".join(f"{i + 1}, {i & 1}, {i >> 1 & 1}, {i >> 2}\n" for i in range(8)) +
                   "*ELEMENT, TYPE=COH3D8\n1, 1, 2, 4, 3, 5, 6, 8, 7\n")
        self.refuse("cohesive.inp", "cohesive.inp:10", "COH3D8", "C3D8")

    def test_only_a_surface(self):
        meshio.Mesh(self.points[:3] + np.eye(3), [("triangle", [[0, 1, 2]])]).write(self.path("shell.vtu"))
        self.refuse("shell.vtu", "no tetrahedra")

    def test_garbage(self):
        for name in ("bad.inp", "bad.bdf", "bad.vtu", "bad.med", "bad.vtk"):
            self.write(name, "this is not a mesh\n1 2 3\n")
            self.refuse(name, name)

    def test_numbers_that_are_none(self):
        self.write("box.inp", self.inp().replace("*Node\n1, ", "*Node\n1, zero", 1))
        self.refuse("box.inp", "box.inp:5", "*NODE", "expected a number, found 'zero0'")

    def test_undefined_node(self):
        self.write("box.inp", self.inp("*Element, type=C3D4\n900, 1, 2, 3, 99999\n"))
        self.refuse("box.inp", "element 900", "node 99999")

    def test_undefined_set(self):
        self.write("box.inp", self.inp("*Surface, name=s\nnobody, S1\n"))
        self.refuse("box.inp", "nobody", "not defined")

    def test_several_parts(self):
        self.write("two.inp", "*Part, name=a\n*End Part\n*Part, name=b\n*End Part\n")
        self.refuse("two.inp", "several parts")

    def test_wrong_node_order(self):
        self.cells = self.cells[:, [0, 1, 2, 3, 9, 8, 7, 6, 5, 4]]
        self.write("box.inp", self.inp())
        self.refuse("box.inp", "mid-side nodes")

    def test_flat_tetrahedron(self):
        self.points, self.cells = box(size=SIZE, order=1)
        self.cells[0, 3] = self.cells[0, 0]
        self.write("box.inp", self.inp(kind="C3D4"))
        self.refuse("box.inp", "no volume")

    def test_a_folder_that_does_not_exist_for_the_output(self):
        self.write("box.inp", self.inp())
        done = subprocess.run(["/usr/bin/python3", CONVERT, self.path("box.inp"), self.path("no/where.msh")],
                              capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, 1)
        self.assertIn("where.msh", done.stderr)


if __name__ == "__main__":
    unittest.main()
