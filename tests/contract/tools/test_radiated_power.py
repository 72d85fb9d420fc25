"""Tests of equivalent radiated power and deflections of superelements: rigid motions, breathing and bending in closed
form, and a bar."""

import h5py
import numpy as np

from box_mesh import InFolder, box
from reduced_bar import ReducedBar

from bielle_tools.bodies import radiated_power
from bielle_tools.messages import InputError  # box_mesh sets the path
from bielle_tools.quantities.quantities import Quantities
from bielle_tools.results import Results
from synthetic_results import VTK_TO_GMSH, put

SIZE = np.array([0.3, 0.2, 0.1])
Z = 1.204 * 343.2  # [N s/m^3] air at 20 degrees
BODY = """
body: bar
geometry: bar.geo
mesh: {size: 0.05, order: 2}
materials: {steel: {young: 210e9, poisson: 0.3, density: 7800}}
regions: {bar: steel}
interfaces: {root: {surface: root, tie: rigid}, tip: {surface: tip, tie: average}}
points: {middle: {at: [0.5, 0, 0], residual: [z]}}
modes: {count: 10}
recovery: {displacement: all, stress: surface}
"""
MODEL = """
nodes: {root: {position: [0, 0, 0]}, tip: {position: [1, 0, 0]}}
elements: {bar: {type: superelement, file: bar.h5, nodes: {root: root, tip: tip}}}
joints: {clamp: {type: rigid, nodes: [ground, root]}}
loads: {push: {node: tip, LOAD}}
analysis: [{type: static, steps: 2}]
"""


class OfBoxes(InFolder):
    """A box with given shapes, and with given motions of its frame and coordinates."""

    def write_body(self, shapes):
        """`shapes` maps (p,3) to displacements per coordinate (p,3,n)"""
        points, cells = box((3, 2, 2), tuple(SIZE))
        T = shapes(points)
        with h5py.File(self.path("box.h5"), "w") as file:
            file.attrs.update({"format": "bielle superelement", "version": 2, "name": "box", "complete": True})
            put(file, "mesh/points", points, "m")
            put(file, "mesh/cells/11", cells[:, VTK_TO_GMSH], "")
            put(file, "recovery/displacement", T.reshape(-1, T.shape[2]), "m")
            file.create_dataset("interface/names", data=["left", "right"], dtype=h5py.string_dtype())
            file["interface/dofs"], file["interface/rotations"] = np.zeros((2, 6), int), np.tile(np.eye(3), (2, 1, 1))
            file["interface/positions"] = np.zeros((2, 3))
        return points

    def write_motion(self, time, q, origin=None, turn=None):
        """`origin` is (nt,3); `turn` are quaternions (nt,4)"""
        still = np.zeros((len(time), 3))
        with h5py.File(self.path("run.h5"), "w") as file:
            file.attrs.update({"format": "bielle results", "version": 1, "complete": True})
            put(file, "time", time, "s")
            put(file, "elements/arm/frame", np.column_stack([still if origin is None else origin, np.tile([1.0, 0, 0, 0], (len(time), 1)) if turn is None else turn]), "m")
            put(file, "elements/arm/coordinates", q, "m")
            file["elements/arm"].attrs["file"] = "box.h5"

    def read(self, *names):
        with Results(self.path("run.h5")) as results:
            quantities = Quantities(results)
            return [quantities.read(name).values for name in names]

    def test_a_box_that_oscillates_radiates_half_of_rho_c_v2_s(self):
        self.write_body(lambda points: np.zeros((*points.shape, 1)))
        frequency, amplitude = 50.0, 1e-3
        time = np.linspace(0, 0.1, 1001)
        rate = 2 * np.pi * frequency
        for axis in range(3):
            origin = np.zeros((len(time), 3))
            origin[:, axis] = amplitude * np.sin(rate * time)
            self.write_motion(time, np.zeros((len(time), 1)), origin)
            (power,), area = self.read("arm.radiated_power"), 2 * SIZE.prod() / SIZE[axis]
            v = amplitude * rate
            self.assertAlmostEqual(np.mean(power[:-1]) / (Z * v ** 2 * area / 2), 1, delta=1e-6)
            np.testing.assert_allclose(power[20:-20, 0], Z * (v * np.cos(rate * time[20:-20])) ** 2 * area, rtol=1e-5, atol=1e-6 * Z * v ** 2 * area)
            elastic, = self.read("arm.radiated_power_elastic")
            np.testing.assert_array_equal(elastic, 0)

    def test_breathing(self):
        centre = SIZE / 2
        self.write_body(lambda points: (points - centre)[:, :, None])
        time = np.linspace(0, 0.1, 1001)
        self.write_motion(time, 1e-3 * np.sin(300 * time)[:, None])
        expected = Z * (0.3 * np.cos(300 * time)) ** 2 * sum(2 * SIZE.prod() / size * (size / 2) ** 2 for size in SIZE)
        for power in self.read("arm.radiated_power", "arm.radiated_power_elastic"):
            np.testing.assert_allclose(power[20:-20, 0], expected[20:-20], rtol=1e-6, atol=1e-6 * expected.max())

    def test_a_steady_turn_and_its_independence_of_the_place_in_space(self):
        self.write_body(lambda points: np.zeros((*points.shape, 1)))
        time, omega = np.linspace(0, 1, 1001), 40.0
        half = omega * time / 2
        turn = np.column_stack([np.cos(half), 0 * half, 0 * half, np.sin(half)])
        # In a rotation about z through a corner, v_n is -omega y on the faces across x, and omega x on those across y.
        a, b, c = SIZE
        expected = Z * omega ** 2 * c * (2 * b ** 3 / 3 + 2 * a ** 3 / 3)
        self.write_motion(time, np.zeros((len(time), 1)), turn=turn)
        power, = self.read("arm.radiated_power")
        np.testing.assert_allclose(power[20:-20], expected, rtol=1e-6)
        # Results have quaternions with this sign.
        self.write_motion(time, np.zeros((len(time), 1)), turn=np.where(turn[:, :1] < 0, -turn, turn))
        np.testing.assert_allclose(self.read("arm.radiated_power")[0][20:-20], expected, rtol=1e-6)
        other = np.array([0.3, -0.5, 0.7, 0.2]) / np.linalg.norm([0.3, -0.5, 0.7, 0.2])  # the same motion in other axes
        w, v = other[0], other[1:]
        moved = np.column_stack([w * turn[:, 0] - turn[:, 1:] @ v, w * turn[:, 1:] + turn[:, :1] * v + np.cross(v, turn[:, 1:])])
        self.write_motion(time, np.zeros((len(time), 1)), turn=moved, origin=np.tile([5.0, 6, 7], (len(time), 1)))
        np.testing.assert_allclose(self.read("arm.radiated_power")[0][20:-20], expected, rtol=1e-6)

    def test_gaps_and_times_that_do_not_increase(self):
        time, values = np.arange(8.0), np.column_stack([np.arange(8.0) ** 2])
        values[4] = np.nan
        np.testing.assert_allclose(radiated_power.rates(time, values)[:, 0], [0, 2, 4, 6, np.nan, 10, 12, 14], atol=1e-12)
        with self.assertRaises(InputError) as caught:
            radiated_power.rates(np.array([0.0, 1, 1]), values[:3])
        self.assertIn("after 1 s comes 1 s", str(caught.exception))

    def test_deflection_from_the_chord_of_a_parabola(self):
        def shapes(points):
            T = np.zeros((len(points), 3, 3))
            T[:, 2, 0] = points[:, 0] ** 2                            # bending
            T[:, 0, 1], T[:, 1, 1] = -points[:, 1], points[:, 0]       # small rotation about z
            T[:, :, 2] = [1, 2, 3]                                    # translation
            return T

        points = self.write_body(shapes)
        time = np.arange(3.0)
        self.write_motion(time, np.array([[0, 0, 0], [0.01, 0, 0], [0.01, 1e-6, 0.5]]))
        found, = self.read("arm.deflection(0.15 0 0, 0 0 0, 0.3 0 0)")
        np.testing.assert_allclose(found[:, 2], [0, -0.01 * 0.15 ** 2, -0.01 * 0.15 ** 2], atol=1e-12)
        np.testing.assert_allclose(found[:, :2], 0, atol=1e-9)
        start, middle, end = (int(np.linalg.norm(points - place, axis=1).argmin()) for place in ([0, 0, 0], [0.15, 0, 0], [0.3, 0, 0]))
        np.testing.assert_array_equal(self.read(f"arm.deflection({middle}, {start}, {end})")[0], found)
        np.testing.assert_array_equal(self.read(f"arm.deflection({middle}, {start}, {end}).z")[0], found[:, 2:])
        np.testing.assert_allclose(self.read(f"arm.deflection({start}, {start}, {end})")[0], 0, atol=1e-15)

    def test_a_large_rigid_rotation_of_the_chord_is_no_deflection(self):
        turn = 0.7
        R = np.array([[np.cos(turn), -np.sin(turn), 0], [np.sin(turn), np.cos(turn), 0], [0, 0, 1]])
        self.write_body(lambda points: (points @ R.T - points)[:, :, None])
        self.write_motion(np.arange(2.0), np.array([[0.0], [1.0]]))
        found, = self.read("arm.deflection(0.15 0.2 0.1, 0 0 0, 0.3 0 0)")  # a point far from the chord
        np.testing.assert_allclose(found, 0, atol=1e-12)

    def test_slips(self):
        self.write_body(lambda points: np.zeros((*points.shape, 1)))
        self.write_motion(np.arange(3.0), np.zeros((3, 1)))
        for text, part in (("arm.deflection(1,2)", "expected a point and the two ends"), ("arm.deflection(1, 2, rihgt)", "did you mean 'right'?"),
                           ("arm.deflection(1, 2, 2)", "at the same place"), ("arm.deflection(1, 2, 99999)", "no interface or point '99999'"),
                           ("arm.deflection(1, 2, right)", "does not keep its translations"), ("arm.von_mises", "keeps no stress"),
                           ("arm.radiated_powr", "did you mean 'arm.radiated_power'?")):
            with self.subTest(text=text), self.assertRaises(InputError) as caught:
                self.read(text)
            self.assertIn(part, str(caught.exception))


class OfABar(ReducedBar):
    def test_a_bar_bends_off_its_chord_as_beam_theory_says(self):
        self.reduce_bar(BODY)
        bending = 210e9 * 0.1 ** 4 / 12
        # The deflection of a cantilever by shear is a straight line, which the chord removes: w(L/2) - w(L)/2 = -F
        # L^3/(16 EI), -M L^2/(8 EI).
        for load, expected in (("force: [0, 0, 1000]", -1000 / (16 * bending)), ("moment: [0, -1000, 0]", -1000 / (8 * bending))):
            self.run_bar(MODEL.replace("LOAD", load))
            with Results(self.path("run.h5")) as results:
                found = Quantities(results).read("bar.deflection(middle, root, tip)").values
            # One element over the thickness is 0.08 % too stiff.
            np.testing.assert_allclose(found[:, 2] / expected, [0.5, 1], rtol=2e-3)
            np.testing.assert_allclose(found[:, :2], 0, atol=1e-3 * abs(expected))


if __name__ == "__main__":
    import unittest
    unittest.main()
