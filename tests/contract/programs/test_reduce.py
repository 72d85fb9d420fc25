"""Tests of the interface of bielle-reduce: messages, exit statuses, and replacement of files by complete ones only."""

import os
import unittest

import h5py
import numpy

from command import CommandTest

BAR = """\
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 0.2, 0.02, 0.02};
Physical Volume("bar") = {1};
Physical Surface("left") = {1};
Physical Surface("right") = {2};
Physical Surface("bottom") = {3};
"""

BODY = """\
body: bar
geometry: bar.geo
length_unit: m
mesh: {size: 0.02, order: 2}
materials:
  steel: {young: 210e9, poisson: 0.3, density: 7850}
regions: {bar: steel}
interfaces:
  left: {surface: left, tie: rigid}
  right: {surface: right, tie: rigid}
modes: {count: 4}
"""

# Two tetrahedra share a face. Two nodes of the second one are exchanged, which inverts it.
INVERTED = """\
$MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
3
2 1 "left"
2 2 "right"
3 3 "bar"
$EndPhysicalNames
$Nodes
5
1 0 0 0
2 1 0 0
3 0 1 0
4 0 0 1
5 1 1 1
$EndNodes
$Elements
4
1 4 2 3 1 1 2 3 4
2 4 2 3 1 2 4 3 5
3 2 2 1 1 1 2 4
4 2 2 2 2 3 4 5
$EndElements
"""


class Reduce(CommandTest):
    program = "bielle-reduce"

    def setUp(self):
        super().setUp()
        self.write("bar.geo", BAR)

    def refuse(self, old, new, *says, status=1):
        self.assertIn(old, BODY)
        self.write("body.yaml", BODY.replace(old, new))
        self.expect_refusal(status, "body.yaml", says=says)
        self.assertEqual([name for name in os.listdir(self.folder) if ".h5" in name], [])

    def test_a_good_body_is_reduced_and_summarised(self):
        self.write("body.yaml", BODY)
        done = self.run_program("body.yaml")
        self.assertEqual(done.returncode, 0, done.stderr)
        for word in ("mass", "Hz"):
            self.assertIn(word, done.stdout)
        with h5py.File(os.path.join(self.folder, "body.h5")) as file:
            self.assertEqual(file.attrs["format"], "bielle superelement")
            self.assertEqual(file.attrs["complete"], 1)
            self.assertEqual(file["reduced/stiffness"].shape, (16, 16))
            self.assertAlmostEqual(file["mass_properties/mass"][()], 7850 * 0.2 * 0.02 * 0.02, places=9)
            components = file["reduced/inertia_components"][()]
            mass = file["reduced/mass"][()]
            self.assertLess(numpy.abs(components[:3].sum(axis=0) - mass).max(), 1e-9 * numpy.abs(mass).max())
            missing = []
            file.visititems(lambda name, item: missing.append(name) if isinstance(item, h5py.Dataset) and
                            item.dtype.kind == "f" and "units" not in item.attrs else None)
            self.assertEqual(missing, [])

    def test_rigid_motions_and_geometric_stiffness_stand_in_the_file(self):
        self.write("body.yaml", BODY + "loads:\n  snow: {surface: bottom, pressure: 1e5}\n")
        done = self.run_program("body.yaml")
        self.assertEqual(done.returncode, 0, done.stderr)
        for text in ("bar: 16 coordinates, 12 of interfaces and 4 of modes", "mass 0.628 kg", "free-free frequencies",
                     "effective mass", "passed", "factorisation", "written: body.h5"):
            self.assertIn(text, done.stdout)
        self.assertNotIn("FAILED", done.stdout)
        self.assertIn("rigid ties (left, right) stiffen the body", done.stderr)
        with h5py.File(os.path.join(self.folder, "body.h5")) as file:
            stiffness, mass = file["reduced/stiffness"][()], file["reduced/mass"][()]
            along_x = numpy.zeros(16)
            along_x[[0, 6]] = 1
            self.assertLess(numpy.abs(stiffness @ along_x).max(), 1e-9 * stiffness.max())
            self.assertAlmostEqual(along_x @ mass @ along_x, 0.628, places=12)
            self.assertEqual(file["loads/snow"].shape, (3, 3, 16))
            self.assertEqual(file["reduced/geometric_stiffness/load"].shape, (12, 16, 16))

    def test_inspect_runs_the_checks_again(self):
        self.write("body.yaml", BODY)
        self.assertEqual(self.run_program("body.yaml", "-o", "other.h5", "--quiet").returncode, 0)
        with h5py.File(os.path.join(self.folder, "other.h5"), "r+") as file:
            file["reduced/mass"][...] *= 1.0005
            del file.attrs["checksum"]
        done = self.expect_refusal(2, "--inspect", "other.h5", says=["other.h5", "mass_error"])
        self.assertIn("FAILED   5.0e-04 (at most 1e-10)  its mass is that of the mesh", done.stdout)

    def test_quiet_prints_no_summary(self):
        self.write("body.yaml", BODY)
        done = self.run_program("body.yaml", "--quiet", "--threads", "1")
        self.assertEqual((done.returncode, done.stdout), (0, ""))
        for line in done.stderr.splitlines():
            self.assertIn("warning", line)

    def test_command_lines_that_make_no_sense(self):
        self.write("body.yaml", BODY)
        self.expect_refusal(1, says=["expected one of: a body file"])
        self.expect_refusal(1, "body.yaml", "--list", "bar.geo", says=["expected one of"])
        self.expect_refusal(1, "--list", "bar.geo", "-o", "x.h5", says=["-o goes with a body file"])
        self.expect_refusal(1, "body.yaml", "--length-unit", "mm", says=["--length-unit goes with --list"])
        self.expect_refusal(1, "body.yaml", "-o", "nowhere/bar.h5", says=["there is no folder 'nowhere'"])
        self.expect_refusal(1, "body.yaml", "-o", "bar.geo", says=["would replace its own input"])

    def test_a_body_that_is_not_held_says_how_it_can_still_move(self):
        self.refuse("left, tie: rigid}\n  right: {surface: right, tie: rigid}",
                    "left, tie: rigid, directions: [x, y, z, ry, rz]}", "body.yaml:9: interfaces.left",
                    "can still turn about the axis (1, 0, 0)")
        self.refuse("modes: {count: 4}", "modes: {count: 60000}", "60000 fixed-boundary modes")

    def test_inspect_and_list(self):
        self.write("body.yaml", BODY)
        self.assertEqual(self.run_program("body.yaml", "--quiet").returncode, 0)
        done = self.run_program("--inspect", "body.h5")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("left", done.stdout)
        done = self.run_program("--list", "bar.geo")
        self.assertEqual(done.returncode, 0, done.stderr)
        for word in ("left", "right", "bar", "plane"):
            self.assertIn(word, done.stdout)

    def test_help_version_and_options(self):
        for option in ("--help", "--version"):
            self.assertEqual(self.run_program(option).returncode, 0)
        self.expect_refusal(1, "body.yaml", "--quite", says=["--quite", "--quiet"])
        self.expect_refusal(1, "nowhere.yaml", says=["nowhere.yaml"])

    def test_unknown_keys(self):
        self.refuse("materials:", "material:", "body.yaml:5", "did you mean 'materials'")
        self.refuse("density:", "densty:", "body.yaml:6", "materials.steel", "did you mean 'density'")
        self.refuse("tie: rigid}\n  right", "tye: rigid}\n  right", "body.yaml:9", "did you mean 'tie'")
        self.refuse("tie: rigid}\n  right", "tie: rigd}\n  right", "body.yaml:9", "did you mean 'rigid'")

    def test_impossible_materials(self):
        self.refuse("density: 7850", "density: 0", "body.yaml:6", "density")
        self.refuse("poisson: 0.3", "poisson: 0.5", "body.yaml:6", "poisson")
        self.refuse("young: 210e9", "young: -1", "body.yaml:6", "young")

    def test_names_that_do_not_exist(self):
        self.refuse("geometry: bar.geo", "geometry: bra.geo", "bra.geo")
        self.refuse("surface: left", "surface: lfet", "body.yaml:9", "lfet", "did you mean 'left'")
        self.refuse("regions: {bar: steel}", "regions: {bar: stel}", "body.yaml:7", "did you mean 'steel'")
        self.refuse("regions: {bar: steel}", "regions: {bra: steel}", "body.yaml:7", "did you mean 'bar'")

    def test_overlapping_interfaces(self):
        self.refuse("surface: right", "surface: bottom", "body.yaml:10", "left")

    def test_a_body_in_two_pieces(self):
        self.write("bar.geo", BAR.replace('Physical Volume("bar") = {1};',
                                          'Box(2) = {0, 1, 0, 0.2, 0.02, 0.02};\nPhysical Volume("bar") = {1, 2};'))
        self.refuse("body: bar", "body: bar", "2", "pieces")

    def test_inverted_elements(self):
        self.write("inverted.msh", INVERTED)
        self.refuse("geometry: bar.geo", "geometry: inverted.msh", "inverted.msh")

    def test_broken_geometry(self):
        self.write("bar.geo", BAR.replace("Box(1)", "Bax(1)"))
        self.refuse("body: bar", "body: bar", "bar.geo")

    def test_a_good_file_survives_a_failed_run(self):
        self.write("body.yaml", BODY)
        self.assertEqual(self.run_program("body.yaml", "--quiet").returncode, 0)
        with open(os.path.join(self.folder, "body.h5"), "rb") as file:
            good = file.read()
        self.write("body.yaml", BODY.replace("surface: right", "surface: bottom"))
        self.expect_refusal(1, "body.yaml")
        with open(os.path.join(self.folder, "body.h5"), "rb") as file:
            self.assertEqual(file.read(), good)
        self.assertEqual([name for name in os.listdir(self.folder) if name.endswith(".partial")], [])

    def test_inspect_refuses_files_that_are_no_good(self):
        self.write("body.yaml", BODY)
        self.assertEqual(self.run_program("body.yaml", "--quiet").returncode, 0)
        path = os.path.join(self.folder, "body.h5")
        with h5py.File(path, "r+") as file:
            file.attrs["version"] = 99
        self.expect_refusal(1, "--inspect", "body.h5", says=["body.h5", "99"])
        with open(path, "r+b") as file:
            file.truncate(os.path.getsize(path) // 2)
        self.expect_refusal(1, "--inspect", "body.h5", says=["body.h5"])
        self.expect_refusal(1, "--inspect", "body.yaml", says=["body.yaml"])


if __name__ == "__main__":
    unittest.main()
