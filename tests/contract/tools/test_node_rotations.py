"""Tests of rotations of nodes that the tools compute from recorded quaternions: over several turns, through
singularities, in figures and studies."""

import csv
import math
import os
import subprocess
import sys
import unittest

import h5py
import numpy as np
from scipy.spatial.transform import Rotation

import synthetic_results as synthetic
from box_mesh import REPOSITORY
from test_results_tools import ResultsTool as _ResultsTool

sys.path.insert(0, os.path.join(REPOSITORY, "tools"))
from bielle_tools.results import rotations  # noqa: E402
from bielle_tools.results import Results  # noqa: E402
from bielle_tools.results.columns import column_names, column_units, columns_of  # noqa: E402

AXES = {"euler": "ZXZ", "bryant": "XYZ"}


def quaternions(turns):
    """Returns w x y z (n, 4) of SciPy's rotations, whose signs are not continuous."""
    return np.roll(turns.as_quat(), 1, axis=-1)


def tumbling(rows):
    """Returns a body that rotates fast about an axis which rotates slowly."""
    t = np.linspace(0, 10, rows)
    zero = np.zeros(rows)
    return (Rotation.from_rotvec(np.column_stack([0.3 * t, 2 * np.sin(t), zero]))
            * Rotation.from_rotvec(np.column_stack([zero, zero, 5 * t])))


class Quantities(unittest.TestCase):
    def test_parameters_are_those_of_scipy(self):
        turns = Rotation.random(200, random_state=1)
        q = quaternions(turns)
        for name, axes in AXES.items():
            angles = getattr(rotations, f"{name}_angles")(rotations.rotation_matrices(q))
            np.testing.assert_allclose(angles, turns.as_euler(axes), atol=1e-13)
        np.testing.assert_allclose(rotations.rotation_vectors(q), turns.as_rotvec(), atol=1e-13)
        tiny = np.array([[1, 1e-9, -2e-9, 0]])
        np.testing.assert_allclose(rotations.rotation_vectors(tiny), 2 * tiny[:, 1:], rtol=1e-15)

    def test_turns_are_counted(self):
        t = np.linspace(0, 1, 401)
        angle = 30 * np.sin(2 * math.pi * t) + 5 * t
        axis = np.array([2, -1, 2]) / 3
        psi = rotations.rotation_quantity("rotation_vector", quaternions(Rotation.from_rotvec(angle[:, None] * axis)))
        np.testing.assert_allclose(psi, angle[:, None] * axis, atol=1e-13)
        for name, axes in AXES.items():
            # Angle b passes through both singularities.
            angles = np.column_stack([0.4 + 0.3 * t, 0.2 + 40 * t, -0.3 + 0.5 * t * t])
            found = rotations.rotation_quantity(name, quaternions(Rotation.from_euler(axes, angles)))
            np.testing.assert_allclose(found, angles, atol=1e-11)  # next to the singularity 1e-16/cos b

    def test_a_tumbling_motion_has_no_jumps(self):
        turns = tumbling(20001)
        for name in rotations.ROTATION_QUANTITIES:
            p = rotations.rotation_quantity(name, quaternions(turns))
            back = Rotation.from_rotvec(p) if name == "rotation_vector" else Rotation.from_euler(AXES[name], p)
            np.testing.assert_allclose(back.as_matrix(), turns.as_matrix(), atol=2e-8)
            self.assertLess(np.abs(np.diff(p, axis=0)).max(), 0.1)
            self.assertGreater(np.ptp(p, axis=0).max(), 7)

    def test_rows_without_numbers_stay_so(self):
        q = np.array([[1.0, 0, 0, 0], [np.nan] * 4, [0, 0, 0, 0], [math.cos(2), 0, 0, math.sin(2)]])
        p = rotations.rotation_quantity("bryant", q)
        self.assertEqual(np.isnan(p).all(axis=1).tolist(), [False, True, True, False])
        np.testing.assert_allclose(p[3], [0, 0, 4 - 2 * math.pi], atol=1e-15)
        self.assertEqual(rotations.rotation_quantity("euler", np.zeros((0, 4))).shape, (0, 3))


class InResults(_ResultsTool):
    def setUp(self):
        super().setUp()
        synthetic.write_results(self.path("stacked.h5"), "box.h5", analysis="dynamic")
        synthetic.stack(self.path("stacked.h5"))

    def test_are_read_as_what_is_recorded(self):
        for file in ("run.h5", "stacked.h5"):
            with Results(self.path(file)) as results:
                for name, components in (("rotation_vector", "xyz"), ("bryant", "abc"), ("euler", "abc")):
                    place = f"nodes/hub/{name}"
                    self.assertTrue(results.has(place))
                    self.assertIn(name, results.datasets("nodes/hub"))
                    self.assertEqual(results.shape(place), (len(self.time), 3))
                    self.assertEqual(column_names(results, place), list(components))
                    self.assertEqual(column_units(results, place), ["rad"] * 3)
                    turning = columns_of(results, place)[0 if name == "euler" else 2]
                    np.testing.assert_allclose(turning, synthetic.OMEGA * self.time, atol=1e-13)
                    np.testing.assert_array_equal(results.rows(place, np.array([2, 5])), results.rows(place)[[2, 5]])
                self.assertFalse(results.has("nodes/no_such/bryant"))
                self.assertFalse(results.has("elements/rod/bryant"))
                self.assertFalse(results.has("nodes/hub/bryan"))

    def test_without_recorded_rotations_there_are_none(self):
        with h5py.File(self.path("run.h5"), "r+") as file:
            del file["nodes/hub/rotation"]
        with Results(self.path("run.h5")) as results:
            self.assertFalse(results.has("nodes/hub/bryant"))
            self.assertNotIn("bryant", results.datasets("nodes/hub"))

    def test_figures(self):
        written = self.succeed("bielle-plot", self.path("run.h5"), "--rotation", "bryant", "--format", "svg").stdout
        self.assertIn("rotations.svg", written)
        with open(self.path("run-plots/rotations.svg"), encoding="utf-8") as file:
            text = file.read()
        self.assertIn("R = Rx(a) Ry(b) Rz(c)", text)
        self.refuse("bielle-plot", [self.path("run.h5"), "--rotation", "briant"], "--rotation", "bryant")

    def test_cycles(self):
        self.assertIn("nodes/hub/euler", self.succeed("bielle-rainflow", self.path("run.h5"), "nodes/hub/euler", "--component", "1").stdout)


STUDIED = """\
parameters: {speed: 1}
nodes: {wheel: {angular_velocity: [0, 0, speed]}}
elements: {wheel: {type: rigid_body, node: wheel, mass: 1, inertia: [1, 1, 2]}}
joints: {axle: {type: hinge, nodes: [ground, wheel], axis: [0, 0, 1]}}
analysis: [{type: dynamic, duration: 1, step: 0.02}]
"""


class InStudies(_ResultsTool):
    def test_the_table_has_them(self):
        with open(self.path("wheel.yaml"), "w", encoding="utf-8") as file:
            file.write(STUDIED)
        command = ["/usr/bin/python3", "-B", os.path.join(REPOSITORY, "tools", "bielle-study"), self.path("wheel.yaml"), "--grid", "speed=10,20",
                   "--gather", "turn=last nodes/wheel/bryant[c]", "-o", self.path("study.h5")]
        done = subprocess.run(command, capture_output=True, text=True, timeout=240, env={**os.environ, "BIELLE_BIN": os.environ["BIELLE_PROGRAMS"]})
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.path("study-table.csv"), encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        np.testing.assert_allclose([float(row["turn"]) for row in rows], [10, 20], rtol=1e-9)  # 20 rad: three turns


if __name__ == "__main__":
    unittest.main()
