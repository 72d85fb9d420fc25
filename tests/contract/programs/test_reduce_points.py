"""Tests of named points and their residual vectors, from the body file to the results of a mechanism."""

import os
import subprocess
import unittest

import h5py
import numpy

from bar_body import BarTest
from command import PROGRAMS
from shares import share_of_tests as load_tests  # noqa: E402,F401

# A bar with a pad on its bottom, away from both ends.
BAR = """\
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 0.2, 0.02, 0.02};
Rectangle(100) = {0.12, 0.005, 0, 0.02, 0.01};
BooleanFragments{ Volume{1}; Delete; }{ Surface{100}; Delete; }
"""

BODY = """\
body: bar
geometry: bar.geo
mesh: {size: 0.01}
materials:
  steel: {young: 210e9, poisson: 0.3, density: 7850}
regions: {all: steel}
interfaces:
  left: {surface: {plane: {point: [0, 0, 0], normal: [1, 0, 0]}}}
  right: {surface: {plane: {point: [0.2, 0, 0], normal: [1, 0, 0]}}, tie: average}
modes: {count: 4}
"""

PAD_PLACE, SENSOR_PLACE = numpy.array([0.13, 0.01, 0]), numpy.array([0.05, 0.01, 0.01])
PAD = "{plane: {point: [0, 0, 0], normal: [0, 0, 1]}, box: [[0.11, 0, -1], [0.15, 0.02, 1]]}"
POINTS = f"""\
points:
  pad: {{group: {PAD}, residual: true}}
  core: {{at: [0.05, 0.01, 0.01], residual: [z, ry]}}
  sensor: {{at: [0.05, 0.01, 0.01]}}
"""

MODEL = """\
nodes:
  base: {position: [0, 0.01, 0.01], fixed: true}
points:
  pad: {element: bar, point: pad}
  sensor: {element: bar, point: sensor}
elements:
  bar: {type: superelement, file: body.h5, nodes: {left: base}}
loads:
  push: {node: pad, force: [0.01, -0.02, 0.03], moment: [1e-3, 2e-3, -1e-3]}
analysis:
  - {type: static}
"""


class ReducePoints(BarTest):
    geometry = BAR

    def displacements(self, model, **nodes):
        """Runs the mechanism with the body. @returns the distances of nodes from their expected places"""
        self.write("model.yaml", model)
        done = subprocess.run([os.path.join(PROGRAMS, "bielle-mechanism"), "model.yaml", "-o", "run.h5"], cwd=self.folder,
                              text=True, capture_output=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr)
        with h5py.File(os.path.join(self.folder, "run.h5")) as file:
            return [file[f"analysis_1/nodes/{node.replace('__', '.')}/position"][-1] - place for node, place in nodes.items()]

    def test_points_and_residual_vectors_stand_in_summary_and_file(self):
        said = self.reduce(BODY + POINTS).stdout
        for text in ("24 coordinates, 12 of interfaces, 4 of modes and 8 of residual vectors", "points\n",
                     "pad     at (0.13, 0.01, 0) m, residual vectors for x y z rx ry rz",
                     "core    at (0.05, 0.01, 0.01) m, residual vectors for z ry\n", "sensor  at (0.05, 0.01, 0.01) m\n",
                     "8 residual vectors, with pseudo-frequencies of", "residual vectors   "):
            self.assertIn(text, said)
        inspected = self.run_program("--inspect", "body.h5")
        self.assertEqual(inspected.returncode, 0, inspected.stderr)
        self.assertIn("sensor  at (0.05, 0.01, 0.01) m\n", inspected.stdout)
        with h5py.File(os.path.join(self.folder, "body.h5")) as file:
            self.assertEqual(sorted(file["points"]), ["core", "pad", "sensor"])
            self.assertEqual(file["points/pad/shapes"].shape, (6, 24))
            self.assertEqual(list(file["points/core/residual"]), [0, 0, 1, 0, 1, 0])
            self.assertEqual(file["modes"].attrs["residual_vectors"], 8)
            frequencies = file["modes/frequencies"][()]
        self.assertEqual(len(frequencies), 12)
        self.assertTrue((numpy.diff(frequencies[:4]) >= 0).all() and (numpy.diff(frequencies[4:]) >= 0).all())

    def test_a_point_with_residual_vectors_gives_way_as_an_interface_on_its_surface_does(self):
        """Constraint modes are exact in statics, and the pad as an averaging interface is the same mean over the same
        surface."""
        extra = "recovery: {displacement: none, stress: none}\n"
        self.reduce(BODY + POINTS + extra)
        pad, sensor = self.displacements(MODEL, pad=PAD_PLACE, sensor=SENSOR_PLACE)
        self.reduce(BODY.replace("modes:", f"  pad: {{surface: {PAD}, tie: average}}\nmodes:") + extra +
                    "points: {sensor: {at: [0.05, 0.01, 0.01]}}\n")
        at_interface = MODEL.replace("  pad: {element: bar, point: pad}\n", "").replace("node: pad", "node: bar.pad")
        exact, exact_sensor = self.displacements(at_interface, bar__pad=PAD_PLACE, sensor=SENSOR_PLACE)
        # Quadratic terms are negligible, since the bar rotates by about 1e-7.
        self.assertLess(numpy.linalg.norm(pad - exact), 1e-6 * numpy.linalg.norm(exact))
        self.assertLess(numpy.linalg.norm(sensor - exact_sensor), 1e-6 * numpy.linalg.norm(exact_sensor))
        self.reduce(BODY + POINTS.replace(", residual: true", "") + extra)
        (without,) = self.displacements(MODEL, pad=PAD_PLACE)
        self.assertGreater(numpy.linalg.norm(without - exact), 1e-3 * numpy.linalg.norm(exact))

    def test_inertia_relief_makes_the_answer_to_accelerations_whole(self):
        def missing():
            with h5py.File(os.path.join(self.folder, "body.h5")) as file:
                group = file["reduced/inertia_answer"]
                return numpy.abs(group["missing"][()]).max() / numpy.abs(group["whole"][()]).max()

        self.reduce(BODY)
        self.assertGreater(missing(), 1e-3)
        said = self.reduce(BODY + "inertia_relief: true\n").stdout
        self.assertIn("28 coordinates, 12 of interfaces, 4 of modes and 12 of residual vectors", said)
        self.assertIn("deflects by 100, 100 and 100 % of the deflection of the mesh; spinning about them by 100, 100 and 100 %", said)
        self.assertLess(missing(), 1e-9)
        self.write("body.yaml", BODY + "inertia_relief: 12\n")
        refused = self.run_program("body.yaml")
        self.assertEqual(refused.returncode, 1)
        self.assertIn("body.yaml:", refused.stderr)
        self.assertIn("inertia_relief", refused.stderr)

    def test_points_that_were_changed_are_noticed(self):
        self.reduce(BODY + POINTS + "recovery: {displacement: none, stress: none}\n")
        path = os.path.join(self.folder, "body.h5")

        def change(name, attribute, add):
            with h5py.File(path, "r+") as file:
                if attribute:
                    file[name].attrs[attribute] += add
                else:
                    file[name][...] = file[name][()] + add

        for name, attribute, add in (("points/pad/shapes", "", 1e-3), ("points/sensor/position", "", 1e-3),
                                     ("modes", "residual_vectors", -1)):
            change(name, attribute, add)
            self.expect_refusal(1, "--inspect", "body.h5", says=["its numbers are not those that were written",
                                                                 "run bielle-reduce again"])
            change(name, attribute, -add) if attribute else self.reduce(BODY + POINTS + "recovery: {displacement: none}\n")
        self.assertEqual(self.run_program("--inspect", "body.h5").returncode, 0)

    def test_pieces_have_the_points_that_lie_in_them(self):
        said = self.reduce(BODY + POINTS + "pieces: {planes: {axis: x, at: 0.1}, compare: false}\n").stdout
        self.assertIn("4 of modes, 2 of residual vectors, interfaces left, cut_1, points core, sensor", said)
        self.assertIn("4 of modes, 6 of residual vectors, interfaces right, cut_1, points pad", said)
        pad, sensor = self.displacements(MODEL, pad=PAD_PLACE, sensor=SENSOR_PLACE)
        self.assertGreater(numpy.linalg.norm(pad), numpy.linalg.norm(sensor))

    def test_wrong_points_are_refused_with_their_line(self):
        for old, new, says in (("at: [0.05, 0.01, 0.01], residual", "at: [0.05, 0.1, 0.01], residual",
                                "body.yaml:13: points.core: stands 0.08 m away"),
                               (f"group: {PAD}", "group: pud", "body.yaml:12: points.pad.group"),
                               (f"group: {PAD}", "group: {plane: {point: [0, 0, 0], normal: [1, 0, 0]}}",
                                "body.yaml:12: points.pad: its loads leave nothing for residual vectors")):
            self.assertIn(old, POINTS)
            self.write("body.yaml", BODY + POINTS.replace(old, new))
            self.expect_refusal(1, "body.yaml", says=[says])


if __name__ == "__main__":
    unittest.main()
