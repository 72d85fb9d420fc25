"""Compares reductions of geometries with several solids, and of their hexahedral meshes, with closed forms of stiffness
and frequencies."""

import math
import re
import unittest

import h5py
import numpy as np

from command import CommandTest
from iges_boxes import iges_boxes
from shares import share_of_tests as load_tests  # noqa: E402,F401

# Two bars in a row, and a separate third one.
BARS = """SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 60, 10, 10}; Box(2) = {60, 0, 0, 40, 10, 10}; Box(3) = {200, 0, 0, 40, 10, 10};
"""
BAR = """SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 100, 10, 10};
"""
ENDS = """\
interfaces:
  left: {surface: {plane: {point: [0, 0, 0], normal: [1, 0, 0]}}}
  right: {surface: {plane: {point: [0.1, 0, 0], normal: [1, 0, 0]}}}
modes: {count: 6}
"""
LEFT = """\
interfaces: {left: {surface: {plane: {point: [0, 0, 0], normal: [1, 0, 0]}}, tie: average}}
modes: {count: 0}
"""
MATERIALS = """\
materials:
  steel: {young: 210e9, poisson: 0, density: 7850}
  light: {young: 70e9, poisson: 0, density: 2700}
"""
AREA = 1e-4


class Assemblies(CommandTest):
    program = "bielle-reduce"

    def body(self, geometry, mesh, more, interfaces=ENDS):
        self.write("bar.geo", geometry)
        self.write("body.yaml", f"body: bar\ngeometry: bar.geo\nlength_unit: mm\nmesh: {mesh}\n{MATERIALS}{more}\n{interfaces}")

    def reduce(self, *arguments, **named):
        """@returns the standard error; the results are in mass, stiffness, frequencies."""
        self.body(*arguments, **named)
        done = self.run_program("body.yaml")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn("FAILED", done.stdout)
        with h5py.File(self.path("body.h5")) as file:
            self.mass = file["mass_properties/mass"][()]
            self.stiffness = file["reduced/stiffness"][()]
            self.frequencies = file["modes/frequencies"][()]
        self.said = done.stdout
        return done.stderr

    def test_two_glued_bars_are_one(self):
        self.reduce(BAR, "{size: 5e-3}", "regions: {all: steel}")
        stiffness, frequencies = self.stiffness, self.frequencies
        self.reduce(BARS, "{size: 5e-3}", "volumes: [1, 2]\nglue: true\nregions: {all: steel}")
        self.assertAlmostEqual(self.mass / (7850 * AREA * 0.1), 1, delta=1e-9)
        # Without lateral contraction a pulled bar has constant strain, which elements represent exactly.
        for pulled in (stiffness, self.stiffness):
            self.assertAlmostEqual(pulled[0, 0] / (210e9 * AREA / 0.1), 1, delta=1e-8)
        # Both meshes have two elements across the section, and errors of the frequencies below 1 %.
        np.testing.assert_allclose(self.frequencies, frequencies, rtol=0.01)

    def test_bars_of_two_materials_are_springs_in_a_row(self):
        for cells in ("tetrahedra", "hexahedra"):
            with self.subTest(cells):
                self.reduce(BARS, f"{{size: 5e-3, cells: {cells}}}",
                            "volumes: [1, 2]\nglue: true\nregions: {volume_1: steel, volume_2: light}")
                self.assertAlmostEqual(self.mass / (AREA * (7850 * 0.06 + 2700 * 0.04)), 1, delta=1e-9)
                stiffness = AREA / (0.06 / 210e9 + 0.04 / 70e9)
                self.assertAlmostEqual(self.stiffness[0, 0] / stiffness, 1, delta=1e-8)

    def test_a_cantilever_of_tetrahedra_and_of_hexahedra_vibrates_as_a_beam(self):
        clamped = "interfaces:\n  left: {surface: {plane: {point: [0, 0, 0], normal: [1, 0, 0]}}}\nmodes: {count: 2}\n"
        # This is the first frequency of a cantilever by Euler and Bernoulli; shear and rotary inertia lower it by about
        # 0.5 % here (h / L = 0.1, Timoshenko's equations).
        euler = 1.8751040687**2 / (2 * math.pi) * math.sqrt(210e9 * 0.01**2 / (12 * 7850)) / 0.1**2
        found = {}
        for cells, says in (("tetrahedra", ""), ("hexahedra", "hexahedra: in grids")):
            said = self.reduce(BAR, f"{{size: 5e-3, cells: {cells}}}", "regions: {all: steel}", interfaces=clamped)
            self.assertIn(says, said)
            self.assertEqual("hex20" in self.said, cells == "hexahedra")
            found[cells] = self.frequencies
            np.testing.assert_allclose(self.frequencies, timoshenko(euler), rtol=2e-3)
        np.testing.assert_allclose(found["hexahedra"], found["tetrahedra"], rtol=2e-3)

    def test_hexahedra_from_tetrahedra_are_reported(self):
        said = self.reduce('SetFactory("OpenCASCADE"); Cylinder(1) = {0, 5, 5, 100, 0, 0, 5};\n',
                           "{size: 2.5e-3, cells: hexahedra}", "regions: {all: steel}")
        self.assertIn("tetrahedra of twice the size are divided into four each", said)
        self.assertIn("hex20", self.said)
        # Inverted elements got straight edges, where the section of the mesh is smaller. The stiffness follows from the
        # mean section, up to the variation along the bar.
        area = self.mass / (7850 * 0.1)
        self.assertAlmostEqual(area / (math.pi * 0.005**2), 1, delta=5e-3)
        self.assertAlmostEqual(self.stiffness[0, 0] / (210e9 * area / 0.1), 1, delta=5e-4)

    def test_lost_volume_is_reported(self):
        rod = 'SetFactory("OpenCASCADE"); Cylinder(1) = {0, 5, 5, 100, 0, 0, 5};\n'
        for more in ("size: 6e-3, order: 1", "size: 3.5e-3, cells: hexahedra, order: 1", "size: 3.5e-3, cells: hexahedra"):
            with self.subTest(more):
                said = self.reduce(rod, f"{{{more}}}", "regions: {all: steel}", interfaces=LEFT)
                lost = 1 - self.mass / (7850 * math.pi * 0.005**2 * 0.1)
                told = re.search(r"warning: body.yaml:4: mesh: the mesh has ([0-9.]+) % less volume, and mass, than the geometry", said)
                self.assertEqual(lost > 0.01, told is not None, f"{lost} {said}")
                if told:
                    self.assertAlmostEqual(float(told[1]) / (100 * lost), 1, delta=0.05)
        self.assertNotIn("less volume", self.reduce(rod, "{size: 6e-3, curvature: 32, order: 1}", "regions: {all: steel}", interfaces=LEFT))

    def test_sizes_name_surfaces_as_users_do(self):
        regions, mass = "regions: {all: steel}\n", "masses: {%s: {surface: {plane: {point: [0, 0, 0], normal: [0, 1, 0]}}, mass: 1}}"
        self.body(BAR, "{size: 5e-3, sizes: {pump: 1e-3}}", regions + mass % "pmup")
        self.expect_refusal(1, "body.yaml", says=["body.yaml:4: mesh.sizes.pump: 'pump' is no physical group, interface, load, point or mass; "
                                                  "did you mean 'pmup'?"])
        self.body(BAR, "{size: 5e-3, sizes: {zz: 1e-3}}", regions + mass % "pump")
        self.expect_refusal(1, "body.yaml", says=["or mass; expected one of 'left', 'pump', 'right'"])
        self.body(BAR, "{size: 5e-3, sizes: {left: 1e-3}}", regions + mass % "left")
        self.expect_refusal(1, "body.yaml", says=["body.yaml:4: mesh.sizes.left: an interface and a mass have the name 'left', but other surfaces"])
        self.reduce(BAR, "{size: 5e-3}", regions + mass % "left")

    def test_solids_of_an_iges_file_have_its_unit(self):
        boxes = [((0, 0, 0), (60, 10, 10)), ((60, 0, 0), (100, 10, 10))]
        for unit, metres in (("mm", 1e-3), ("in", 0.0254), ("m", 1)):
            with self.subTest(unit):
                scaled = [tuple(tuple(x * 1e-3 / metres for x in corner) for corner in box) for box in boxes]
                self.write("bar.igs", iges_boxes(scaled, unit))
                listed = self.run_program("--list", "bar.igs").stdout
                self.assertIn("volume 2: 'SOLID', 4e-06 m^3, from (0.06, 0, 0) m to (0.1, 0.01, 0.01) m", listed)
                for solids, length in (("glue: true", 0.1), ("volume: 1", 0.06), ("glue: true\nmesh: {size: 5e-3, heal: true}", 0.1)):
                    self.body("", "{size: 5e-3}", f"regions: {{all: steel}}\n{solids}", interfaces=LEFT)
                    with open(self.path("body.yaml"), encoding="utf-8") as file:
                        text = file.read().replace("bar.geo\nlength_unit: mm", "bar.igs")
                    self.write("body.yaml", text.replace("mesh: {size: 5e-3}\n", "", text.count("mesh:") - 1))
                    done = self.run_program("body.yaml")
                    self.assertEqual(done.returncode, 0, done.stderr)
                    with h5py.File(self.path("body.h5")) as file:
                        self.assertAlmostEqual(file["mass_properties/mass"][()] / (7850 * AREA * length), 1, delta=1e-9)

    def test_healing_is_reported(self):
        said = self.reduce(BAR, "{size: 5e-3, heal: true}", "regions: {all: steel}")
        self.assertIn("heal: 12 edges and 6 faces became 12 edges and 6 faces without those below 0.05 mm", said)

    def test_wrong_keys(self):
        regions = "regions: {all: steel}"
        for mesh, more, says in (
                ("{size: 5e-3}", regions, ["body.yaml:2: geometry", "in 3 pieces", "`glue: true`", "`volume: "]),
                ("{size: 5e-3}", regions + "\nvolume: 4", ["body.yaml:9: volume", "there is no volume 4", "'1', '2', '3'"]),
                ("{size: 5e-3}", regions + "\nvolume: -1", ["there is no volume -1", "'1', '2', '3'"]),
                ("{size: 5e-3}", regions + "\nvolume: 1.5", ["there is no volume 1.5", "'1', '2', '3'"]),
                ("{size: 5e-3}", regions + "\nvolume: [1]", ["body.yaml:9: volume: expected a volume, by its number or its name"]),
                ("{size: 5e-3}", regions + "\nvolume: {a: 1}", ["expected a volume, by its number or its name"]),
                ("{size: 5e-3}", regions + "\nvolume:", ["expected a volume, by its number or its name"]),
                ("{size: 5e-3}", regions + "\nvolumes: 1", ["body.yaml:9: volumes: expected a list"]),
                ("{size: 5e-3}", regions + "\nvolumes: []", ["body.yaml:9: volumes: expected at least one volume"]),
                ("{size: 5e-3}", regions + "\nvolumes: [1, volume_1]", ["volumes[2]: volume 1 is selected twice"]),
                ("{size: 5e-3}", regions + "\nvolumes: [1, 2]\nvolume: 1", ["expected either volume, or volumes"]),
                ("{size: 5e-3}", regions + "\nglue: 3", ["body.yaml:9: glue: expected true or false"]),
                ("{size: 5e-3}", "glue: true\nvolumes: [1, 2]\nregions: {volume_1: steel, volume_3: light}",
                 ["regions.volume_3", "'volume_3' is not a physical volume"]),
                ("{size: 5e-3, cells: hexaedra}", regions, ["body.yaml:4: mesh.cells", "did you mean 'hexahedra'"]),
                ("{size: 5e-3, cells: 1}", regions, ["mesh.cells", "'tetrahedra', 'hexahedra'"]),
                ("{size: 5e-3, curvature: 2}", regions, ["mesh.curvature: expected", "between 3 and 360"]),
                ("{size: 5e-3, curvature: -12}", regions, ["mesh.curvature: expected", "between 3 and 360"]),
                ("{size: 5e-3, curvature: 1e9}", regions, ["mesh.curvature: expected"]),
                ("{size: 5e-3, curvature: 12.5}", regions, ["mesh.curvature: expected"]),
                ("{size: 5e-3, heal: 1e-3}", regions, ["mesh.heal: expected true or false"])):
            with self.subTest(mesh=mesh, more=more):
                self.body(BARS, mesh, more)
                self.expect_refusal(1, "body.yaml", says=says)


def timoshenko(euler):
    """Returns the first frequency of the cantilever by Timoshenko's equations with Cowper's shear factor 5/6 for a
    Poisson's ratio of 0. It is a zero of the characteristic determinant between 0.9 and 1 times the frequency by Euler
    and Bernoulli."""
    length, height, young, density = 0.1, 0.01, 210e9, 7850
    area, inertia, shear = height**2, height**4 / 12, young / 2 * 5 / 6

    def determinant(frequency):
        # The state (w, psi, M, Q) changes along the bar by a matrix exponential, with w = psi = 0 at one end and M = Q
        # = 0 at the other.
        square = (2 * math.pi * frequency)**2
        rate = np.zeros((4, 4))
        rate[0, 1], rate[0, 3] = 1, 1 / (shear * area)
        rate[1, 2] = 1 / (young * inertia)
        rate[2, 1], rate[2, 3] = -density * inertia * square, -1
        rate[3, 0] = -density * area * square
        scale = np.diag([1, 1 / length, young * inertia / length**2, young * inertia / length**3])
        values, vectors = np.linalg.eig(np.linalg.solve(scale, rate @ scale) * length)
        whole = (vectors * np.exp(values)) @ np.linalg.inv(vectors)
        return np.linalg.det(whole[2:, 2:].real)

    low, high = 0.9 * euler, euler
    assert determinant(low) * determinant(high) < 0
    for _ in range(50):
        middle = (low + high) / 2
        low, high = (middle, high) if determinant(low) * determinant(middle) > 0 else (low, middle)
    return low


if __name__ == "__main__":
    unittest.main()
