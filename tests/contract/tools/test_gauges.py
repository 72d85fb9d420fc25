"""Tests of virtual strain gauges: surfaces and strains in closed form, and a bar that is stretched, bent, twisted and
rotated."""

import contextlib
import csv
import io
import os
import unittest

import h5py
import numpy as np

from box_mesh import REPOSITORY, InFolder, box
from python_tool import run_python_tool  # box_mesh sets the path
from reduced_bar import ReducedBar

from bielle_tools.bodies.gauges import ROSETTES, gauge_strains, principal_strains
from bielle_tools.mesh.surface_point import nearest_on_surface
from bielle_tools.messages import InputError  # box_mesh sets the path
from bielle_tools.quantities.quantities import Quantities
from bielle_tools.results import Results
from bielle_tools.study.gather import read_gather
from synthetic_results import VTK_TO_GMSH, put

SIZE = np.array([0.3, 0.2, 0.1])
YOUNG, POISSON = 210e9, 0.3
LENGTH, WIDTH = 1.0, 0.1
BODY = """
body: bar
geometry: bar.geo
mesh: {size: 0.05, order: 2}
materials: {steel: {young: 210e9, poisson: 0.3, density: 7800}}
regions: {bar: steel}
interfaces: {root: {surface: root, tie: rigid}, tip: {surface: tip, tie: average}}
points: {"top, middle": {at: [0.5, 0, 0.05]}}
modes: {count: 4}
recovery: {displacement: all, stress: surface}
"""
MODEL = """
nodes: {root: {position: [0, 0, 0]}, tip: {position: [1, 0, 0]}}
elements: {bar: {type: superelement, file: bar.h5, nodes: {root: root, tip: tip}}}
joints: {pin: {type: hinge, nodes: [ground, root], axis: [0.6, 0, 0.8]}}
drives: {turn: {joint: pin, angle: ANGLE}}
loads: {push: {node: tip, LOAD, follower: true}}
analysis: [{type: static, steps: 2}]
"""


def elasticity(young, poisson):
    """Returns stress over engineering strain (6,6)."""
    shear = young / (2 * (1 + poisson))
    C = np.zeros((6, 6))
    C[:3, :3] = young * poisson / ((1 + poisson) * (1 - 2 * poisson))
    C[range(3), range(3)] += 2 * shear
    C[range(3, 6), range(3, 6)] = shear
    return C


class OfPlaneStrains(unittest.TestCase):
    def test_pure_shear_has_its_principal_strains_at_45_degrees(self):
        shear = np.array([0.0, 0.0, 2e-4])
        np.testing.assert_allclose(principal_strains(shear), [1e-4, -1e-4, np.pi / 4], rtol=1e-15)
        np.testing.assert_allclose(gauge_strains(shear, ROSETTES["rectangular"]), [0, 1e-4, 0], atol=1e-19)
        np.testing.assert_allclose(gauge_strains(shear, ROSETTES["delta"]), np.array([0, np.sqrt(0.75), -np.sqrt(0.75)]) * 1e-4, atol=1e-19)

    def test_textbook_rosette_equations_give_the_principal_strains_of_the_readings(self):
        """The formulas are those of W. C. Young, R. G. Budynas, Roark's Formulas for Stress and Strain, table of
        rosettes."""
        plane = np.random.default_rng(1).normal(size=(200, 3))
        largest, least, angle = principal_strains(plane).T
        a, b, c = gauge_strains(plane, ROSETTES["rectangular"]).T
        radius = np.sqrt((a - b) ** 2 + (b - c) ** 2) / np.sqrt(2)
        np.testing.assert_allclose([(a + c) / 2 + radius, (a + c) / 2 - radius], [largest, least], atol=1e-14)
        np.testing.assert_allclose(np.tan(2 * angle), (2 * b - a - c) / (a - c), rtol=1e-9)
        a, b, c = gauge_strains(plane, ROSETTES["delta"]).T
        radius = np.sqrt(2 * ((a - b) ** 2 + (b - c) ** 2 + (c - a) ** 2)) / 3
        np.testing.assert_allclose([(a + b + c) / 3 + radius, (a + b + c) / 3 - radius], [largest, least], atol=1e-14)
        np.testing.assert_allclose(np.tan(2 * angle), np.sqrt(3) * (b - c) / (2 * a - b - c), rtol=1e-9)

    def test_a_gauge_along_the_principal_direction_shows_the_largest_strain(self):
        plane = np.random.default_rng(2).normal(size=(50, 3))
        for strain, (largest, least, angle) in zip(plane, principal_strains(plane)):
            np.testing.assert_allclose(gauge_strains(strain, np.array([angle, angle + np.pi / 2])), [largest, least], atol=1e-14)


class OfSurfaces(unittest.TestCase):
    def test_points_of_a_sphere_are_found_to_the_order_of_its_faces(self):
        """Returns a cube of quadrilaterals with nodes on the unit sphere. The error of faces of order k decreases as
        h^(k+1)."""
        for order, ratio in ((1, 4), (2, 8)):
            errors = [self.error_on_sphere(order, count) for count in (4, 8)]
            self.assertGreater(errors[0] / errors[1], 0.9 * ratio, order)

    def error_on_sphere(self, order, count):
        step = np.linspace(-1, 1, order * count + 1)
        points, faces = [], []
        for axis in range(3):
            for side in (-1, 1):
                grid = np.array([[side, np.tan(a * np.pi / 4), np.tan(b * np.pi / 4)] for a in step for b in step])
                start = len(points) * len(grid)
                points.append(np.roll(grid / np.linalg.norm(grid, axis=1)[:, None], axis, axis=1))
                n = order * count + 1
                for i in range(0, n - 1, order):
                    for j in range(0, n - 1, order):
                        ring = [(0, 0), (order, 0), (order, order), (0, order)]
                        ring += [(1, 0), (2, 1), (1, 2), (0, 1), (1, 1)] if order == 2 else []
                        ring = ring if side > 0 else [(b, a) for a, b in ring]
                        faces.append([start + (i + a) * n + j + b for a, b in ring])
        faces, points = {"quad9" if order == 2 else "quad": np.array(faces)}, np.concatenate(points)
        places = np.random.default_rng(3).normal(size=(40, 3))
        places /= np.linalg.norm(places, axis=1)[:, None]
        errors = []
        for place in places:
            found = nearest_on_surface(points, faces, place)
            errors.append(found.distance)
            self.assertGreater(found.normal @ place, 0.9)
        return max(errors)


class OfBoxes(InFolder):
    """A box whose strain, in a rotating frame, is a given tensor times each coordinate, linear over the box."""

    def setUp(self):
        super().setUp()
        points, cells = box((3, 2, 2), tuple(SIZE))
        random = np.random.default_rng(4)
        self.constant, self.slope = random.normal(size=(6, 2)), random.normal(size=(6, 3))
        strain = np.einsum("p,ij->pij", np.ones(len(points)), self.constant)
        strain[:, :, 1] += points @ self.slope.T
        self.C = elasticity(YOUNG, POISSON)
        with h5py.File(self.path("box.h5"), "w") as file:
            file.attrs.update({"format": "bielle superelement", "version": 2, "name": "box", "complete": True})
            put(file, "mesh/points", points, "m")
            put(file, "mesh/cells/11", cells[:, VTK_TO_GMSH], "")
            put(file, "recovery/displacement", np.zeros((3 * len(points), 2)), "m")
            put(file, "recovery/stress", (self.C @ strain).reshape(-1, 2), "Pa")
            put(file, "recovery/stress_nodes", np.arange(len(points)), "")
            put(file, "recovery/elasticity", self.C[None], "Pa")
            put(file, "recovery/stress_materials", np.zeros(len(points), int), "")
            put(file, "points/a%2Fb/position", [0.1, 0.05, 0.1], "m")
            put(file, "points/a%2Fb/shapes", np.zeros((6, 2)), "m")
        self.points, self.q = points, random.normal(size=(3, 2))
        with h5py.File(self.path("run.h5"), "w") as file:
            file.attrs.update({"format": "bielle results", "version": 1, "complete": True})
            put(file, "time", np.arange(3.0), "s")
            put(file, "elements/arm/frame", random.normal(size=(3, 7)), "m")
            put(file, "elements/arm/coordinates", self.q, "m")
            file["elements/arm"].attrs["file"] = "box.h5"

    def read(self, text):
        with Results(self.path("run.h5")) as results:
            return Quantities(results).read(text).values

    def expected(self, place, direction):
        """e . strain . e"""
        strain = self.q @ self.constant.T + self.q[:, 1:] * (self.slope @ place)
        e = np.asarray(direction, float) / np.linalg.norm(direction)
        xx, yy, zz, yz, xz, xy = strain.T
        tensor = np.array([[xx, xy / 2, xz / 2], [xy / 2, yy, yz / 2], [xz / 2, yz / 2, zz]])
        return np.einsum("i,ijt,j->t", e, tensor, e)

    def test_a_gauge_shows_the_tensor_along_its_direction_on_every_side(self):
        for place, direction in (([0.11, 0.05, 0.1], [2, 1, 0]), ([0.11, 0.05, 0], [1, -3, 0]), ([0.3, 0.07, 0.03], [0, 1, 1]), ([0.2, 0, 0.02], [-1, 0, 5])):
            text = " ".join(map(str, place)), " ".join(map(str, direction))
            np.testing.assert_allclose(self.read(f"arm.gauge({text[0]}, {text[1]})")[:, 0], self.expected(np.array(place), direction), rtol=1e-11)

    def test_gauges_of_a_rosette_are_anticlockwise_seen_from_outside(self):
        for place, first, second in (("0.11 0.05 0.1", [1, 0, 0], [0, 1, 0]), ("0.11 0.05 0", [1, 0, 0], [0, -1, 0]), ("0 0.05 0.03", [0, 0, 1], [0, 1, 0])):
            x, y, where = np.array(first, float), np.array(second, float), np.array(place.split(), float)
            for kind, angles in ROSETTES.items():
                found = self.read(f"arm.rosette({place}, {' '.join(map(str, first))}, {kind})")
                for k, angle in enumerate(angles):
                    np.testing.assert_allclose(found[:, k], self.expected(where, np.cos(angle) * x + np.sin(angle) * y), rtol=1e-11)
                for row, angle in enumerate(found[:, 5]):
                    along = np.cos(angle) * x + np.sin(angle) * y
                    self.assertAlmostEqual(self.expected(where, along)[row], found[row, 3], delta=1e-11)

    def test_nodes_names_and_places_are_the_same_gauge(self):
        named = self.read("arm.gauge(a/b, 1 0 0)")
        node = int(np.linalg.norm(self.points - [0.1, 0.05, 0.1], axis=1).argmin())
        np.testing.assert_allclose(self.points[node], [0.1, 0.05, 0.1], atol=1e-12)
        for place in (str(node), "0.1 0.05 0.1", "'a/b'"):
            np.testing.assert_allclose(self.read(f"arm.gauge({place}, 1 0 0)"), named, rtol=1e-12)
        np.testing.assert_array_equal(self.read("arm.rosette(a/b, 1 0 0, delta).a"), named)

    def test_tables_cycles_and_studies_take_gauges(self):
        strain = self.read("arm.gauge(a/b, 1 0 0)")[:, 0]
        done = run_python_tool(os.path.join(REPOSITORY, "tools", "bielle-table"), ["run.h5", "--quantity", "arm.gauge('a/b', 1 0 0), arm.rosette(a/b, 1 0 0, delta)"], self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        heads, *lines = csv.reader(done.stdout.splitlines())
        names = [f"arm.rosette(a/b, 1 0 0, delta).{name}" for name in ("a", "b", "c", "largest", "least", "angle [rad]")]
        self.assertEqual(heads, ["time [s]", "arm.gauge('a/b', 1 0 0)", *names])
        np.testing.assert_array_equal(np.array(lines, float)[:, 1], strain)
        done = run_python_tool(os.path.join(REPOSITORY, "tools", "bielle-rainflow"), ["run.h5", "arm.gauge(a/b, 1 0 0)"], self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("3 times", done.stdout)
        wanted, = read_gather([("top", "max arm.gauge(0.1 0.05 0.1, 1 0 0) from 0 to 2")])
        with Results(self.path("run.h5")) as results:
            self.assertEqual(wanted.value(results), strain.max())

    def test_a_place_or_direction_off_the_surface_is_noted(self):
        with contextlib.redirect_stderr(io.StringIO()) as said:
            moved = self.read("arm.gauge(0.11 0.05 0.102, 1 0 0.2)")
        np.testing.assert_allclose(moved, self.read("arm.gauge(0.11 0.05 0.1, 1 0 0)"), rtol=1e-12)
        self.assertIn("is moved by 0.002 m onto the surface, to (0.11, 0.05, 0.1)", said.getvalue())
        self.assertIn("is turned by 11.3 degrees into the surface", said.getvalue())
        self.assertEqual(said.getvalue().count("note:"), 2)

    def test_slips(self):
        inner = int(np.linalg.norm(self.points - [0.15, 0.1, 0.05], axis=1).argmin())
        for text, part in (("arm.gauge", "'arm.gauge(PLACE, DIRECTION)'"), ("arm.gauge(1 2 3)", "expected a place and a direction"),
                           ("arm.rosette(a/b, 1 0 0)", "and the kind"), ("arm.rosette(a/b, 1 0 0, rectangle)", "did you mean 'rectangular'?"),
                           ("arm.gauge(a/c, 1 0 0)", "did you mean 'a/b'?"), ("arm.gauge(1 2, 1 0 0)", "no point '1 2'"), ("arm.gauge(99999, 1 0 0)", "no node 99999"),
                           ("arm.gauge(-1, 1 0 0)", "no point '-1'"), ("arm.gauge(nan 0 0, 1 0 0)", "no point 'nan 0 0'"),
                           ("arm.gauge(a/b, 1 0)", "three numbers"), ("arm.gauge(a/b, nan 0 0)", "three numbers"), ("arm.gauge(a/b, 0 0 0)", "has no length"),
                           ("arm.gauge(a/b, 0 0 -3)", "is normal to the surface"), ("arm.gauge(0.1 0 0.1, 1 0 0)", "is on an edge"), ("arm.gauge(0 0 0, 1 0 0)", "is on an edge"),
                           ("arm.gauge(1e300 0 0, 1 0 0)", "no point '1e300 0 0'"), ("arm.gauge(a/b, 1e300 0 0)", "three numbers"), ("arm.gauge(1e99 0 0, 1 0 0)", "is not on the surface"),
                           ("arm.gauge(a/b, 1e-200 0 0)", "has no length"), ("arm.gauge(100 50 100, 1 0 0)", "is not on the surface"), (f"arm.gauge({inner}, 1 0 0)", "is not on the surface"),
                           ("arm.gauge(a/b, 1 0 0", "a bracket is not closed"), ("arm.gauge(a/b, 1 0 0).x", "no component 'x'"),
                           ("arm.rosette(a/b, 1 0 0, delta).norm", "no component 'norm'"), ("arm.von_mises(3)", "takes no words in brackets")):
            with self.subTest(text=text), self.assertRaises(InputError) as caught:
                self.read(text)
            self.assertIn(part, str(caught.exception))

    def test_a_body_without_stress_or_elasticity_or_stress_at_the_place_is_refused(self):
        with h5py.File(self.path("box.h5"), "r+") as file:
            kept = np.flatnonzero(self.points[:, 0] < 0.08)
            stress = file["recovery/stress"][:].reshape(-1, 6, 2)[kept].reshape(-1, 2)
            for name, values in (("stress", stress), ("stress_nodes", kept), ("stress_materials", np.zeros(len(kept), int))):
                del file[f"recovery/{name}"]
                put(file, f"recovery/{name}", values, "")
        with self.assertRaises(InputError) as caught:
            self.read("arm.gauge(a/b, 1 0 0)")
        self.assertIn("keeps no stress at (0.1, 0.05, 0.1)", str(caught.exception))
        for name, part in (("elasticity", "keeps no elasticity"), ("stress", "keeps no stress, of which")):
            with h5py.File(self.path("box.h5"), "r+") as file:
                del file[f"recovery/{name}"]
            with self.assertRaises(InputError) as caught:
                self.read("arm.gauge(a/b, 1 0 0)")
            self.assertIn(part, str(caught.exception))


class OfABar(ReducedBar):
    def test_a_bar_drawn_bent_twisted_and_turned(self):
        self.reduce_bar(BODY)
        area, bending = WIDTH ** 2, YOUNG * WIDTH ** 4 / 12
        force, moment = 1e4, 1e3
        drawn, bent = f"force: [{force}, 0, 0]", f"moment: [0, {-moment}, 0]"
        exact, bilinear = 1e-4, 5e-3  # cells of order 2 represent linear strains, but a force at the tip causes x z
        for load, place, strain, error in ((drawn, "0.5 0 0.05", force / (YOUNG * area), exact),
                                           (bent, "'top, middle'", -moment * WIDTH / 2 / bending, exact),
                                           (bent, "0.5 0 -0.05", moment * WIDTH / 2 / bending, exact),
                                           (f"force: [0, 0, {force}]", "0.3 0 0.05", -force * (LENGTH - 0.3) * WIDTH / 2 / bending, bilinear),
                                           (f"force: [0, 0, {force}]", "0.7 0 0.05", -force * (LENGTH - 0.7) * WIDTH / 2 / bending, bilinear)):
            with self.subTest(load=load, place=place):
                a, b, c, largest, least, _ = self.rosette(load, place, 0)
                np.testing.assert_allclose(np.array([a, b, c, *sorted([largest, least], key=abs)]) / strain,
                                           [1, (1 - POISSON) / 2, -POISSON, -POISSON, 1], atol=error)
        twisted = self.rosette(f"moment: [{moment}, 0, 0]", "0.5 0 0.05", 0)  # T_x = -z tau_xy at the top
        self.assertAlmostEqual(np.rad2deg(twisted[5]), -45, delta=1)
        self.assertAlmostEqual(twisted[4] / twisted[3], -1, delta=0.03)
        still, turned = (self.rosette(f"force: [0, 0, {force}]", "0.3 0 0.05", angle) for angle in (0, 1))
        np.testing.assert_allclose(turned, still, rtol=1e-8)
        np.testing.assert_allclose(self.rosette("force: [0, 0, 0]", "0.5 0 0.05", 1)[:5], 0, atol=1e-12)

    def rosette(self, load, place, angle):
        """Returns the last row."""
        self.run_bar(MODEL.replace("LOAD", load).replace("ANGLE", str(angle)))
        with Results(self.path("run.h5")) as results:
            return Quantities(results).read(f"bar.rosette({place}, 1 0 0, rectangular)").values[-1]


if __name__ == "__main__":
    unittest.main()
