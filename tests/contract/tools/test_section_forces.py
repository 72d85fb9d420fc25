"""Tests of section forces of superelements: parts of meshes in front of planes, a cantilever with a load and with its
weight, a spinning bar."""

import contextlib
import io
import shutil
import unittest

import numpy as np

from box_mesh import box
from reduced_bar import ReducedBar

from bielle_tools.mesh.cells import CELLS, SOLIDS
from bielle_tools.mesh.half_space import moments_in_front
from bielle_tools.messages import InputError  # box_mesh sets the path
from bielle_tools.quantities.quantities import Quantities
from bielle_tools.results import Results

LENGTH, WIDTH, DENSITY = 1.0, 0.1, 7800.0
BODY = """
body: bar
geometry: bar.geo
mesh: {size: 0.05, order: 2}
materials: {steel: {young: 210e9, poisson: 0.3, density: 7800}}
regions: {bar: steel}
interfaces: {root: {surface: root, tie: rigid}, tip: {surface: tip, tie: average}}
modes: {count: 6}
damping: {ratio: 0.02}
"""
MODEL = """
gravity: GRAVITY
nodes: {root: {position: [0, 0, 0]}, tip: {position: [1, 0, 0]}}
elements: {bar: {type: superelement, file: bar.h5, nodes: {root: root, tip: tip}}}
joints: {pin: {type: hinge, nodes: [ground, root], axis: [0, 0, 1]}}
"""
HELD = "drives: {held: {joint: pin, angle: 0}}\nloads: {push: {node: tip, force: [3000, 0, 1000], moment: [200, 0, 0]}}\nanalysis: [{type: static, steps: 2}]\n"
SPUN = """
drives: {motor: {joint: pin, rate: "60*step(t, 0, 0.2)"}}
analysis: [{type: dynamic, duration: 0.3, step: 5e-4}]
output: {every: 600}
"""


class OfHalfSpaces(unittest.TestCase):
    def integrals(self, points, cells, place, normal, density=3.0):
        """Returns mass, first moments, and integrals of rho x_j x_k of the part in front of the plane."""
        W, V = moments_in_front(points, cells, {kind: np.full(len(block), density) for kind, block in cells.items()}, np.array(place, float),
                                np.array(normal, float) / np.linalg.norm(normal))
        return W.sum(), V.sum(axis=0), V.T @ points

    def expect_corner(self, found, lengths, density=3.0):
        """Returns integrals over the tetrahedron between the origin and points on the axes."""
        a = np.array(lengths)
        volume = a.prod() / 6
        np.testing.assert_allclose(found[0], density * volume, rtol=1e-12)
        np.testing.assert_allclose(found[1], density * volume * a / 4, rtol=1e-12)
        np.testing.assert_allclose(found[2], density * volume * np.outer(a, a) * (1 + np.eye(3)) / 20, rtol=1e-12)

    def test_a_corner_of_a_box_is_a_tetrahedron(self):
        for order in (1, 2):
            points, cells = box((3, 2, 2), (0.3, 0.2, 0.1), order)
            a = np.array([0.23, 0.19, 0.09])
            self.expect_corner(self.integrals(points, {"tetra10" if order == 2 else "tetra": cells}, [a[0], 0, 0], -1 / a), a)

    def test_a_corner_of_a_hexahedron_and_of_a_wedge(self):
        for kind in ("hexahedron", "hexahedron20", "hexahedron27", "wedge", "wedge15", "tetra", "tetra10", "pyramid"):
            cell = CELLS[kind]
            points = cell.reference - cell.reference[0]
            a = np.array([0.4, 0.35, 0.3])  # inside each cell; the edge of a pyramid is oblique
            if cell.shape == "pyramid":
                points = points @ np.linalg.inv(points[[1, 3, 4]])
            self.expect_corner(self.integrals(points, {kind: np.arange(cell.nodes)[None]}, [a[0], 0, 0], -1 / a), a)

    def test_both_sides_together_are_the_whole(self):
        random = np.random.default_rng(5)
        for kind in SOLIDS:
            cell = CELLS[kind]
            points = cell.reference @ (np.eye(3) + 0.3 * random.normal(size=(3, 3)))
            for _ in range(2):
                place, normal = points.mean(axis=0) + 0.2 * random.normal(size=3), random.normal(size=3)
                cells = {kind: np.arange(cell.nodes)[None]}
                sides = [self.integrals(points, cells, place, sign * normal) for sign in (1, -1)]
                whole = self.integrals(points, cells, points.min(axis=0) - 1, [1, 1, 1])
                for first, second, total in zip(*sides, whole):
                    np.testing.assert_allclose(first + second, total, atol=1e-11 * abs(whole[0]), err_msg=kind)


class OfABar(ReducedBar):
    @classmethod
    def setUpClass(cls):
        cls.made = ReducedBar()
        cls.made.setUp()
        cls.made.reduce_bar(BODY)

    @classmethod
    def tearDownClass(cls):
        cls.made.doCleanups()

    def run_model(self, rest, gravity="[0, 0, 0]"):
        shutil.copy(self.made.path("bar.h5"), self.folder)
        self.run_bar(MODEL.replace("GRAVITY", gravity) + rest)

    def sections(self, places=(0.02, 0.3, 0.525, 0.97)):
        """Returns [(x, section (6))] of the last row, with the normal along the bar."""
        with Results(self.path("run.h5")) as results:
            quantities = Quantities(results)
            return [(x, quantities.read(f"bar.section({x} 0 0, 1 0 0)").values[-1]) for x in places]

    def test_a_cantilever_with_a_load_at_its_end(self):
        """The section has axial force, shear, torque and the bending moment F (L - x). Loads keep their direction and
        the bar bends by 2e-4 rad, which is the error."""
        self.run_model(HELD)
        force, moment = np.array([3000, 0, 1000.0]), np.array([200, 0, 0.0])
        turn = 1000 * LENGTH ** 2 / (2 * 210e9 * WIDTH ** 4 / 12)
        for x, found in self.sections():
            exact = np.concatenate([force, moment + np.cross([LENGTH - x, 0, 0], force)])
            np.testing.assert_allclose(found, exact, atol=1.5 * turn * 3000)
        with Results(self.path("run.h5")) as results:
            quantities = Quantities(results)
            root = results.rows("elements/bar/interface_force")[-1, 0]
            front = quantities.read("bar.section(0.3 0.01 0.02, 1 0.3 0.2)").values[-1]
            back = quantities.read("bar.section(0.3 0.01 0.02, -1 -0.3 -0.2)").values[-1]
            np.testing.assert_allclose(front, -back, atol=1e-8 * np.abs(root).max())  # action and reaction
            np.testing.assert_allclose(front[:3], -root[:3], atol=1.5 * turn * 3000)  # no load acts between
            self.assertEqual(quantities.read("bar.section(0.3 0 0, 1 0 0).norm").units, ["N"])
            self.assertEqual(quantities.read("bar.section(0.3 0 0, 1 0 0).ry").units, ["N m"])

    def test_a_cantilever_under_its_weight(self):
        self.run_model(HELD.replace("3000, 0, 1000", "0, 0, 0").replace("200, 0, 0", "0, 0, 0"), "[0, 0, -9.81]")
        for x, found in self.sections():
            length = LENGTH - x
            weight = DENSITY * WIDTH ** 2 * length * 9.81
            np.testing.assert_allclose(found / weight, [0, 0, -1, 0, length / 2, 0], atol=1e-4)

    def test_a_bar_that_spins(self):
        """The centrifugal force is rho A w^2 (L^2 - x^2)/2. The bar is stretched by 1e-4, and vibrates a little after
        the start."""
        self.run_model(SPUN)
        for x, found in self.sections():
            self.assertAlmostEqual(found[0] / (DENSITY * WIDTH ** 2 * 3600 * (LENGTH ** 2 - x ** 2) / 2), 1, delta=5e-4)

    def test_loads_that_are_not_recorded_are_told(self):
        for more, part in (("", ""), ("points: {mid: {element: bar, at: [0.5, 0, 0]}}\n", "forces of the point 'mid' are not recorded")):
            self.run_model(HELD + more)
            with contextlib.redirect_stderr(io.StringIO()) as said:
                self.sections((0.3, 0.97))
            self.assertEqual(said.getvalue().count("not recorded"), bool(part))
            self.assertIn(part, said.getvalue())

    def test_slips(self):
        self.run_model(HELD)
        with Results(self.path("run.h5")) as results:
            quantities = Quantities(results)
            for text, part in (("bar.section", "'bar.section(PLACE, NORMAL)'"), ("bar.section(0.5 0 0)", "the normal of the plane"),
                               ("bar.section(0.5 0 0, 1 0)", "three numbers"), ("bar.section(0.5 0 0, 0 0 0)", "has no length"),
                               ("bar.section(1.5 0 0, 1 0 0)", "does not cut the body"), ("bar.section(0 0 0, 1 0 0)", "does not cut the body"),
                               ("bar.section(1 0 0, 1 0 0)", "does not cut the body"), ("bar.section(0.5 0 0, 0 0 1)", "cuts the surface of the interface 'root'"),
                               ("bar.section(middle, 1 0 0)", "no point 'middle'"), ("bar.section(nan 0 0, 1 0 0)", "no point 'nan 0 0'"),
                               ("bar.section(0.5 0 0, 1 0 inf)", "three numbers"), ("bar.section(1e99 0 0, 1 0 0)", "does not cut the body"), ("bar.section(0.5 0 0, 1 0 0).xx", "no component 'xx'")):
                with self.subTest(text=text), self.assertRaises(InputError) as caught:
                    quantities.read(text)
                self.assertIn(part, str(caught.exception))


if __name__ == "__main__":
    unittest.main()
