"""Tests of bielle-reduce with every kind of geometry and mesh that a body file may name, of --list, and of broken
meshes."""

import os
import shutil
import subprocess
import sys
import unittest

import h5py
import meshio
import numpy as np

from command import PROGRAMS, CommandTest
from quick_tools import WithQuickTools

HERE = os.path.dirname(os.path.abspath(__file__))
MESHES = os.path.join(HERE, "..", "..", "..", "meshes")
sys.path.insert(0, os.path.join(HERE, "..", "tools"))
from box_mesh import box  # noqa: E402
from shares import share_of_tests as load_tests  # noqa: E402,F401

SIZE = (0.3, 0.2, 0.1)
MASS = 7850 * 0.3 * 0.2 * 0.1
BODY = """\
body: box
geometry: {file}
materials:
  steel: {{young: 210e9, poisson: 0.3, density: 7850}}
regions: {{{region}: steel}}
interfaces:
  left: {{surface: {surface}, tie: rigid}}
modes: {{count: 3}}
"""
SIDE = "{plane: {point: [0, 0, 0], normal: [1, 0, 0]}}"


class Meshes(WithQuickTools, CommandTest):
    program = "bielle-reduce"

    def setUp(self):
        super().setUp()
        self.points, self.cells = box(size=SIZE)
        self.left = np.flatnonzero(self.points[:, 0] == 0)

    def reduce(self, file, region="all", surface=SIDE):
        """Reduces the body in the file; @returns its fixed-boundary frequencies after checking mass and centre."""
        self.write("body.yaml", BODY.format(file=file, region=region, surface=surface))
        done = self.run_program("body.yaml")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn("FAILED", done.stdout)
        with h5py.File(self.path("body.h5")) as result:
            self.assertAlmostEqual(result["mass_properties/mass"][()] / MASS, 1, delta=1e-5)
            np.testing.assert_allclose(result["mass_properties/centre"][()], np.array(SIZE) / 2, atol=1e-6)
            return result["modes/frequencies"][()]

    def sides(self):
        """Returns the triangles on x = 0 in VTK's node order."""
        faces = [[0, 2, 1, 6, 5, 4], [0, 1, 3, 4, 8, 7], [1, 2, 3, 5, 9, 8], [0, 3, 2, 7, 9, 6]]
        return np.array([row[face] for row in self.cells for face in faces if set(row[face]) <= set(self.left)])

    def mesh(self, **data):
        return meshio.Mesh(self.points, [("tetra10", self.cells), ("triangle6", self.sides())], **data)

    def kinds(self, solid, side):
        return [np.full(len(self.cells), solid), np.full(len(self.sides()), side)]

    def abaqus(self):
        # Abaqus numbers mid-side nodes as VTK does.
        nodes = "".join(f"{i + 1}, {x:.17g}, {y:.17g}, {z:.17g}\n" for i, (x, y, z) in enumerate(self.points))
        rows = "".join(f"{i + 1}, " + ", ".join(str(n + 1) for n in row) + "\n" for i, row in enumerate(self.cells))
        left = ",\n".join(str(n + 1) for n in self.left)
        return f"*Node\n{nodes}*Element, type=C3D10, elset=Body\n{rows}*Nset, nset=Left\n{left}\n"

    def test_foreign_meshes_with_their_sets_give_one_body(self):
        self.write("box.inp", self.abaqus())
        self.mesh(cell_data={"nastran:ref": self.kinds(1, 7)}).write(self.path("box.bdf"))
        self.mesh(cell_data={"region": self.kinds(1, 7)}).write(self.path("box.vtu"))
        med = self.mesh(cell_data={"cell_tags": self.kinds(-1, -2)})
        med.cell_tags = {-1: ["body"], -2: ["left"]}
        med.write(self.path("box.med"))
        reference = self.reduce("box.inp", "Body", "Left")
        for file, region, surface in (("box.bdf", "property_1", "property_7"), ("box.vtu", "region_1", "region_7"),
                                      ("box.med", "body", "left")):
            with self.subTest(file):
                # .bdf has 8 characters per number.
                np.testing.assert_allclose(self.reduce(file, region, surface), reference, rtol=1e-5)

    def test_universal_file(self):
        self.write("box.inp", self.abaqus())
        reference = self.reduce("box.inp", "Body", "Left")
        for dataset in (2467, 2477):
            with self.subTest(dataset):
                write_unv(self.path("box.unv"), self.points, self.cells, self.sides(), dataset)
                np.testing.assert_allclose(self.reduce("box.unv", "body", "left"), reference, rtol=1e-8)

    def test_a_foreign_mesh_in_millimetres_with_a_side_selected_by_its_shape(self):
        self.points *= 1000
        self.write("box.inp", self.abaqus())
        self.reduce("box.inp\nlength_unit: mm", "Body")

    def test_a_mesh_is_cut_along_faces_of_elements(self):
        self.write("box.inp", self.abaqus())
        self.write("body.yaml", BODY.format(file="box.inp", region="Body", surface="Left") +
                   "pieces: {planes: {axis: x, at: 0.12}}\n")
        done = self.run_program("body.yaml")
        self.assertEqual(done.returncode, 0, done.stderr)
        # Layers of elements are 0.1 m long, with centroids a quarter of that inside.
        self.assertIn("cut_1: between pieces 1 and 2, at (0.1, 0.1, 0.05) m, area 0.02 m^2, along faces of elements, up to "
                      "20 mm from its plane", done.stdout)
        with h5py.File(self.path("body.h5")) as result:
            masses = [result[f"pieces/{k}/mass_properties/mass"][()] for k in (1, 2)]
        np.testing.assert_allclose(masses, [MASS / 3, 2 * MASS / 3], rtol=1e-6)

    def test_a_set_that_a_foreign_mesh_does_not_have(self):
        self.write("box.inp", self.abaqus())
        self.write("body.yaml", BODY.format(file="box.inp", region="Body", surface="Lfet"))
        self.expect_refusal(1, "body.yaml", says=["body.yaml:7", "Lfet", "did you mean 'Left'"])
        self.write("body.yaml", BODY.format(file="box.inp", region="Bdy", surface="Left"))
        self.expect_refusal(1, "body.yaml", says=["body.yaml:5", "did you mean 'Body'"])

    def test_a_group_that_names_an_element_that_is_not_there(self):
        write_unv(self.path("box.unv"), self.points, self.cells, self.sides(), 2467)
        with open(self.path("box.unv"), encoding="utf-8") as file:
            text = file.read()
        last = f"{8:10d}{len(self.cells) + len(self.sides()):10d}"
        self.assertIn(last, text)
        self.write("box.unv", text.replace(last, f"{8:10d}{999999:10d}"))
        self.write("body.yaml", BODY.format(file="box.unv", region="body", surface="left"))
        self.expect_refusal(1, "body.yaml", says=["body.yaml:2: geometry: 'box.unv' cannot be read"])
        self.expect_refusal(1, "--list", "box.unv", says=["'box.unv' cannot be read"])

    def test_broken_foreign_meshes(self):
        for name in ("bad.inp", "bad.bdf", "bad.vtu", "bad.med", "bad.unv"):
            with self.subTest(name):
                self.write(name, "this is not a mesh\n1 2 3\n")
                self.write("body.yaml", BODY.format(file=name, region="all", surface=SIDE))
                self.expect_refusal(1, "body.yaml", says=["body.yaml:2", name])
                self.assertFalse(os.path.exists(self.path("body.h5")))

    def test_an_empty_group(self):
        # The physical surface has a name, but no triangles.
        mesh = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n2 1 \"left\"\n3 2 \"body\"\n$EndPhysicalNames\n"
        mesh += f"$Nodes\n{len(self.points)}\n" + "".join(
            f"{i + 1} {x:.17g} {y:.17g} {z:.17g}\n" for i, (x, y, z) in enumerate(self.points)) + "$EndNodes\n"
        gmsh = self.cells[:, [0, 1, 2, 3, 4, 5, 6, 7, 9, 8]] + 1
        mesh += f"$Elements\n{len(gmsh)}\n" + "".join(
            f"{i + 1} 11 2 2 1 " + " ".join(map(str, row)) + "\n" for i, row in enumerate(gmsh)) + "$EndElements\n"
        self.write("box.msh", mesh)
        self.write("body.yaml", BODY.format(file="box.msh", region="body", surface="left"))
        self.expect_refusal(1, "body.yaml", says=["body.yaml:7", "left"])

    def test_a_foreign_mesh_in_two_pieces(self):
        other = self.points + [1, 0, 0]
        self.points, self.cells = np.concatenate([self.points, other]), np.concatenate(
            [self.cells, self.cells + len(self.points)])
        meshio.Mesh(self.points, [("tetra10", self.cells)]).write(self.path("box.vtu"))
        self.write("body.yaml", BODY.format(file="box.vtu", region="all", surface=SIDE))
        self.expect_refusal(1, "body.yaml", says=["body.yaml:2", "2 pieces"])

    def test_what_a_list_offers(self):
        self.write("box.inp", self.abaqus())
        done = self.run_program("--list", "box.inp")
        self.assertEqual(done.returncode, 0, done.stderr)
        for word in ("Body", "Left", "plane", "tet10"):
            self.assertIn(word, done.stdout)
        done = self.run_program("--list", os.path.join(MESHES, "conrod.step"))
        self.assertEqual(done.returncode, 0, done.stderr)
        for word in ("cylinder", "radius: 0.024", "radius: 0.011"):
            self.assertIn(word, done.stdout)


class Conrod(CommandTest):
    program = "bielle-reduce"

    def test_the_rod_is_the_same_body_as_geo_and_as_step(self):
        for name in ("conrod.geo", "conrod.step", "conrod.yaml", "conrod_step.yaml"):
            shutil.copy(os.path.join(MESHES, name), self.folder)
        found = {}
        for name in ("conrod", "conrod_step"):
            with open(os.path.join(self.folder, name + ".yaml"), encoding="utf-8") as file:
                text = file.read()
            self.assertIn("size: 4.6e-3", text)
            self.write(name + ".yaml", text.replace("size: 4.6e-3", "size: 8e-3"))
            done = self.run_program(name + ".yaml", timeout=300)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertNotIn("FAILED", done.stdout)
            with h5py.File(os.path.join(self.folder, name + ".h5")) as file:
                found[name] = (file["mass_properties/mass"][()], file["mass_properties/centre"][()],
                               file["interface/positions"][()], file["modes/frequencies"][()])
        geo, step = found["conrod"], found["conrod_step"]
        self.assertAlmostEqual(step[0] / geo[0], 1, delta=2e-3)  # two coarse meshes of one body
        np.testing.assert_allclose(step[1], geo[1], atol=1e-4)
        np.testing.assert_allclose(step[2], [[0, 0, 0], [0.2, 0, 0]], atol=1e-12)
        np.testing.assert_allclose(step[3], geo[3], rtol=0.03)


def write_unv(path, points, cells, sides, dataset):
    """Returns a universal file with nodes (2411), elements (2412: 118 tet10, 42 tri6), and the groups `body` and `left`
    (2467, or its predecessor 2477)."""
    # The universal order is corner, middle, corner, .. along the edges of the base, then the three middles below the
    # top, and the top.
    tet = [0, 4, 1, 5, 2, 6, 7, 8, 9, 3]
    tri = [0, 3, 1, 4, 2, 5]
    lines = ["    -1", "  2411"]
    for i, x in enumerate(points):
        lines += [f"{i + 1:10d}{1:10d}{1:10d}{11:10d}", "".join(f"{v:25.16E}" for v in x)]
    lines += ["    -1", "    -1", "  2412"]
    for i, (kind, row) in enumerate([(118, r[tet]) for r in cells] + [(42, r[tri]) for r in sides]):
        lines.append(f"{i + 1:10d}{kind:10d}{7 if kind == 118 else 8:10d}{1:10d}{7:10d}{len(row):10d}")
        numbers = [f"{n + 1:10d}" for n in row]
        lines += ["".join(numbers[k:k + 8]) for k in range(0, len(numbers), 8)]
    lines += ["    -1", "    -1", f"  {dataset}"]
    first = 1
    for group, (name, count) in enumerate((("body", len(cells)), ("left", len(sides))), start=1):
        lines += [f"{group:10d}" + f"{0:10d}" * 6 + f"{count:10d}", name]
        entries = [f"{8:10d}{n:10d}{0:10d}{0:10d}" for n in range(first, first + count)]
        lines += ["".join(entries[k:k + 2]) for k in range(0, len(entries), 2)]
        first += count
    lines += ["    -1", ""]
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(lines))


class Unreadable(WithQuickTools, CommandTest):
    program = "bielle-reduce"

    def refuse(self, name, content, *says, mode="w"):
        path = os.path.join(self.folder, name)
        with open(path, mode) as file:
            file.write(content)
        self.write("body.yaml", BODY.format(file=name, region="all", surface=SIDE))
        self.expect_refusal(1, "body.yaml", says=["body.yaml:2: geometry: ", f"'{name}'", *says])

    def test_files_that_are_not_what_their_ending_says(self):
        with open(os.path.join(MESHES, "conrod.step"), encoding="utf-8") as file:
            step = file.read()
        self.refuse("rod.step", "", "is empty")
        self.refuse("rod.step", "a letter\n", "is no STEP file: one begins with 'ISO-10303-21;'")
        self.refuse("rod.step", b"\x00\xff" * 3000, "is no STEP file", mode="wb")
        for part in (3000, len(step) - 3000, len(step) - 40):
            self.refuse("rod.step", step[:part], "is cut off: a STEP file ends with 'END-ISO-10303-21;'")
        self.refuse("rod.brep", "a letter\n", "is no BREP file")
        self.refuse("rod.msh", "a letter\n", "is no MSH file: one begins with '$'")
        self.refuse("rod.unv", "a letter\n", "is it a file of the kind that its ending says?")

    def test_a_file_that_may_not_be_read(self):
        source = self.write("secret.geo", "a")
        os.chmod(source, 0)
        os.chmod(self.folder, 0o777)
        self.write("body.yaml", BODY.format(file="secret.geo", region="all", surface=SIDE))
        if os.geteuid() != 0:
            self.expect_refusal(1, "body.yaml", says=["body.yaml:2: geometry: 'secret.geo' cannot be read: Permission denied"])
            return
        done = subprocess.run([os.path.join(PROGRAMS, self.program), "body.yaml", "-o", "out.h5"], cwd=self.folder, text=True,
                              capture_output=True, timeout=120, user=65534, group=65534, extra_groups=[])
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("body.yaml:2: geometry: 'secret.geo' cannot be read: Permission denied", done.stderr)

    def test_nodes_that_are_nowhere(self):
        formats = {"box2.msh": {"file_format": "gmsh22", "binary": False}, "binary.msh": {"file_format": "gmsh", "binary": True},
                   "box.inp": {"file_format": "abaqus"}}
        for name, options in formats.items():
            for wrong, says in ((np.nan, "nan"), (-np.inf, "-inf"), (1e300, "1e+300")):
                points, cells = box(order=1)
                points[5, 1] = wrong
                meshio.write(os.path.join(self.folder, name), meshio.Mesh(points, [("tetra", cells)]), **options)
                self.write("body.yaml", BODY.format(file=name, region="all", surface=SIDE))
                foreign = name.endswith(".inp")
                self.expect_refusal(1, "body.yaml", says=["body.yaml:2: geometry: ", f"'{name}'", says,
                                                          "point 6 has a coordinate that is not finite" if foreign
                                                          else "node 6 stands at"])


if __name__ == "__main__":
    unittest.main()
