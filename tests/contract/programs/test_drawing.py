"""Tests of the drawing in results files: its format in both layouts, after a failure, in continued runs, and for models
that are only checked."""

import json
import os
import re
import shutil
import struct
import subprocess
import unittest

import h5py
import numpy as np

from command import PROGRAMS, CommandTest
from in_folder import REPOSITORY
from shares import share_of_tests as load_tests  # noqa: F401

SHAPES = """, shape: [{box: [0.4, 0.2, 0.1], position: [0.1, 0, 0], rotation_vector: [0, 0, pi/2], colour: steelblue, opacity: 0.5},
         {ring: [0.3, 0.05]}, {stl: part.stl, scale: 0.001}, {stl: part.stl, scale: 0.001, colour: red}, {stl: part.stl}]"""

MODEL = """\
mechanism: a drawn "mechanism" of steel \\u00fc
gravity: [0, 0, -9.81]
nodes:
  a: {position: [0.5, 0, 0]SHAPE_A}
  b: {position: [1, 0, 0]}
  tip: {position: [2, 0, 0]}
elements:
  a: {type: rigid_body, node: a, mass: 1, inertia: [0.1, 0.1, 0.1]SHAPES}
  b: {type: rigid_body, node: b, solid: {cylinder: [0.05, 1], density: 1000}}
  beam: {type: beam, nodes: [b, tip], elements: 2, section: {box: {width: 0.1, height: 0.2, thickness: 0.01}, young: 2e9, poisson: 0.3, density: 1000}}
  spring: {type: spring_damper, nodes: [ground, tip], stiffness: 10, damping: 1, at: [[2, 0, 3], [0, 0, 0]]}
joints:
  pin: {type: hinge, nodes: [ground, a], position: [0, 0, 0], axis: [0, 1, 0]}
  weld: {type: rigid, nodes: [a, b]}
loads: {push: {node: beam.1, force: [0, 0, 1]}}
analysis: [{type: dynamic, duration: DURATION, step: 0.01}]
output: {every: 1, layout: LAYOUT, checkpoint: 5}
"""

PLACED = {"box", "cylinder", "tube", "cone", "sphere", "mesh", "gear", "pulley", "tyre", "cam", "plane", "curve", "body",
          "node", "support", "force"}
LISTS = {"bar": "ends", "coil": "ends", "damper": "ends", "coil_damper": "ends", "jack": "ends", "joint": "frames",
         "course": "points", "stiffness": "places"}


def model(shapes=True, layout="named", duration="0.1"):
    text = MODEL.replace("SHAPES", SHAPES if shapes else "")
    text = text.replace("SHAPE_A", ", shape: {sphere: 0.1}" if shapes else "")
    return text.replace("LAYOUT", layout).replace("DURATION", duration)


def stl(triangles):
    """Returns a binary STL file of a strip of triangles [mm]."""
    k = np.arange(triangles, dtype=np.float32)
    corners = np.zeros((triangles, 12), dtype="<f4")
    corners[:, 3], corners[:, 6], corners[:, 9] = k, k + 1, k + 2
    corners[:, 4], corners[:, 7], corners[:, 10] = k % 2, (k + 1) % 2, k % 2
    record = np.zeros(triangles, dtype=[("numbers", "<f4", 12), ("attribute", "<u2")])
    record["numbers"] = corners
    return b"\0" * 80 + struct.pack("<I", triangles) + record.tobytes()


def numbers_of(path, group="analysis_1"):
    """Returns all numbers below a group of a results file by their paths."""
    found = {}

    def keep(name, item):
        if isinstance(item, h5py.Dataset) and item.dtype.kind == "f":
            found[name] = item[()]

    with h5py.File(path) as f:
        f[group].visititems(keep)
    return found


def matrix(q):
    """Returns the rotation matrix of a unit quaternion w x y z."""
    w, x, y, z = q
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


class Drawing(CommandTest):
    program = "bielle-mechanism"

    def setUp(self):
        super().setUp()
        self.write_bytes("part.stl", stl(4))

    def write_bytes(self, name, data):
        with open(os.path.join(self.folder, name), "wb") as file:
            file.write(data)

    def done(self, *arguments, status=0):
        result = self.run_program(*arguments)
        self.assertEqual(result.returncode, status, result.stderr)
        return result

    def drawing(self, name):
        with h5py.File(self.path(name)) as f:
            return json.loads(f["/drawing"].asstr()[()])

    def check_place(self, place, nodes, inner):
        node = place["node"]
        if node not in nodes | {"ground"}:
            self.assertEqual(inner.get(node), (place.get("element"), place.get("station")), place)
        self.assertEqual(len(place.get("position", [0, 0, 0])), 3)
        self.assertAlmostEqual(np.linalg.norm(place.get("rotation", [1, 0, 0, 0])), 1, 12)

    def check_format(self, name, nodes, inner):
        """Checks all items of a drawing, and returns them by entry and shape."""
        drawing = self.drawing(name)
        self.assertEqual((drawing["format"], drawing["version"]), ("bielle drawing", 1))
        self.assertEqual(drawing["gravity"], [0, 0, -9.81])
        found = {}
        with h5py.File(self.path(name)) as f:
            self.assertEqual(drawing["name"], f.attrs["name"])
            for item in drawing["items"]:
                shape = item["shape"]
                found.setdefault((item["entry"], shape), []).append(item)
                if shape in PLACED:
                    self.check_place(item, nodes, inner)
                elif shape in LISTS:
                    for place in item[LISTS[shape]]:
                        self.check_place(place, nodes, inner)
                else:
                    self.assertIn(shape, ("beam", "superelement"))
                if shape == "mesh":
                    mesh = f["/drawing_meshes"][item["mesh"]]
                    self.assertEqual(mesh["points"].dtype, np.dtype("<f4"))
                    self.assertEqual(mesh["triangles"].dtype, np.dtype("<i4"))
                    self.assertLess(mesh["triangles"][()].max(), len(mesh["points"]))
                    self.assertEqual(mesh["points"].attrs["units"], "m")
        return found

    def test_every_item_is_in_its_format_in_both_layouts(self):
        for layout in ("named", "stacked"):
            self.write("model.yaml", model(layout=layout))
            self.done("model.yaml", "-o", "run.h5")
            found = self.check_format("run.h5", {"a", "b", "tip"}, {"beam.1": ("elements/beam", 1)})
            self.assertEqual(set(found), {
                ("nodes/a", "sphere"), ("nodes/a", "node"), ("nodes/b", "node"), ("nodes/tip", "node"),
                ("elements/a", "box"), ("elements/a", "mesh"), ("elements/b", "cylinder"), ("elements/beam", "beam"),
                ("elements/spring", "coil_damper"), ("joints/pin", "joint"), ("joints/weld", "joint"),
                ("loads/push", "force")})
            box = found["elements/a", "box"][0]
            self.assertEqual((box["colour"], box["opacity"]), ("#4682b4", 0.5))
            self.assertEqual((box["type"], box["node"]), ("rigid_body", "a"))
            np.testing.assert_allclose(box["rotation"], [np.sqrt(0.5), 0, 0, np.sqrt(0.5)], atol=1e-15)
            # One file in one unit is one mesh, for any colours.
            meshes = [item["mesh"] for item in found["elements/a", "mesh"]]
            self.assertEqual(meshes, ["ring", "part", "part", "part_2"])
            with h5py.File(self.path("run.h5")) as f:
                self.assertEqual(set(f["/drawing_meshes"]), {"ring", "part", "part_2"})
                self.assertEqual(len(f["/drawing_meshes/part/points"]), 6)
                small, large = (f[f"/drawing_meshes/{name}/points"][()] for name in ("part", "part_2"))
                np.testing.assert_allclose(small * 1000, large, rtol=1e-6)
            beam = found["elements/beam", "beam"][0]
            self.assertEqual(beam["element"], "elements/beam")
            self.assertEqual([section["at"] for section in beam["sections"]], [0, 1])
            np.testing.assert_allclose(np.ptp(beam["sections"][0]["outer"], axis=0), [0.1, 0.2])
            np.testing.assert_allclose(np.ptp(beam["sections"][0]["inner"], axis=0), [0.08, 0.18])

    def test_shapes_change_no_number(self):
        numbers = []
        for shapes in (True, False):
            self.write("model.yaml", model(shapes))
            self.done("model.yaml", "-o", "run.h5")
            numbers.append(numbers_of(self.path("run.h5")))
        self.assertEqual(set(numbers[0]), set(numbers[1]))
        for name, values in numbers[0].items():
            self.assertEqual(values.tobytes(), numbers[1][name].tobytes(), name)

    def test_a_continued_run_has_the_drawing_of_its_own_shapes(self):
        self.write("model.yaml", model(shapes=False))
        self.done("model.yaml", "-o", "run.h5")
        self.write("model.yaml", model(duration="0.2"))
        for output in ("run.h5", "other.h5"):
            self.done("model.yaml", "--restart", "run.h5", "-o", output)
            found = self.check_format(output, {"a", "b", "tip"}, {"beam.1": ("elements/beam", 1)})
            self.assertIn(("elements/a", "box"), found)
        # A file of an earlier version, without a drawing, gets one.
        with h5py.File(self.path("run.h5"), "a") as f:
            del f["/drawing"], f["/drawing_meshes"]
        self.write("model.yaml", model(duration="0.3"))
        self.done("model.yaml", "--restart", "run.h5", "-o", "run.h5")
        self.assertTrue(self.drawing("run.h5")["items"])

    def test_a_run_that_fails_has_a_drawing(self):
        text = model().replace("  weld: {", "  wrong: {type: distance, nodes: [a, b], length: 3}\n  weld: {")
        self.write("model.yaml", text)
        self.done("model.yaml", "-o", "run.h5", status=2)
        self.assertTrue(self.drawing("run.h5")["items"])
        with h5py.File(self.path("run.h5")) as f:
            self.assertEqual(f.attrs["complete"], 0)

    def test_a_million_triangles(self):
        self.write_bytes("part.stl", stl(1_000_000))
        self.write("model.yaml", model(duration="0.01"))
        self.done("model.yaml", "-o", "run.h5")
        with h5py.File(self.path("run.h5")) as f:
            self.assertEqual(f["/drawing_meshes/part/triangles"].shape, (1_000_000, 3))
            self.assertEqual(f["/drawing_meshes/part/points"].shape, (1_000_002, 3))

    def test_a_missing_file_is_refused_with_its_place(self):
        os.remove(self.path("part.stl"))
        self.write("model.yaml", model())
        self.expect_refusal(1, "model.yaml", says=("model.yaml:9: elements.a.shape[3].stl: ", "part.stl"))


class Checked(CommandTest):
    program = "bielle-mechanism"
    BAR = """\
gravity: [0, 0, -9.81]
nodes: {a: {position: [1, 0, 0]}}
elements: {a: {type: rigid_body, node: a, mass: 1, inertia: [0.1, 0.1, 0.1]}}
joints:
  pin: {type: hinge, nodes: [ground, a], at: [[0, 0, 0.1], [-1, 0, 0]], axis: [0, 1, 0]}
"""

    def file(self, text, status=0):
        self.write("model.yaml", text)
        done = self.run_program("model.yaml", "--check", "-o", "check.h5")
        self.assertEqual(done.returncode, status, done.stderr)
        return done, h5py.File(self.path("check.h5"))

    def test_the_assembled_position_is_the_only_row(self):
        for layout in ("named", "stacked"):
            done, f = self.file(self.BAR + f"output: {{layout: {layout}}}\n")
            plain = self.run_program("model.yaml", "--check")
            self.assertEqual(done.stdout, plain.stdout + "results: check.h5\n")
            with f:
                self.assertEqual(f.attrs["complete"], 1)
                self.assertEqual((f["/analysis_1"].attrs["type"], f["/analysis_1"].attrs["assembled"]), ("check", 1))
                self.assertEqual(f["/time"].shape, (1,))
                self.assertNotIn("redundant", f)
                self.assertIn("drawing", f)
                place = "/nodes/a" if layout == "named" else "/nodes/node"
                position, rotation = (f[f"{place}/{name}"][0].reshape(-1) for name in ("position", "rotation"))
            # The bar of 1 m hangs on its pin at (0, 0, 0.1).
            np.testing.assert_allclose(position - matrix(rotation)[:, 0], [0, 0, 0.1], atol=1e-9)

    def test_without_a_name_nothing_is_written(self):
        self.write("model.yaml", self.BAR)
        self.run_program("model.yaml", "--check")
        self.assertEqual(os.listdir(self.folder), ["model.yaml"])

    def test_a_model_that_cannot_be_assembled_is_drawn(self):
        far = "  far: {type: distance, nodes: [ground, a], at: [[50, 0, 0], [0, 0, 0]], length: 1}\n"
        done, f = self.file(self.BAR + far, status=2)
        self.assertIn(": error: ", done.stderr)
        with f:
            group = f["/analysis_1"]
            self.assertEqual(group.attrs["assembled"], 0)
            self.assertIn(group.attrs["failure"], done.stderr)
            np.testing.assert_array_equal(f["/nodes/a/position"][0], [1, 0, 0])

    def test_redundant_joints_are_named(self):
        _, f = self.file(self.BAR.replace("at: [[0, 0, 0.1], [-1, 0, 0]]", "position: [0, 0, 0]") +
                         "  second: {type: hinge, nodes: [ground, a], position: [0, 1, 0], axis: [0, 1, 0]}\n")
        with f:
            self.assertEqual(list(f["/redundant"].asstr()), ["joints/second"])

    def test_shapes_of_mirrored_parts_are_mirrored(self):
        _, f = self.file("""\
definitions:
  side:
    nodes:
      hub: {position: [0, 1, 0], rotation_vector: [0.3, 0.2, 0.5], shape: {cylinder: [0.1, 1], position: [0.1, 0.2, 0.3], rotation_vector: [0.4, 0.5, 0.6]}}
    elements:
      b: {type: rigid_body, node: hub, mass: 1, inertia: [1, 1, 1], shape: {cone: [0.1, 0.2, 1], position: [0, 0.5, 0.1], axes: {z: [1, 2, 3], x: [1, 0, 0]}}}
parts:
  left: {part: side}
  right: {part: side, mirror: y}
""")
        with f:
            places = {}
            for item in json.loads(f["/drawing"].asstr()[()])["items"]:
                if item["shape"] in ("cylinder", "cone"):
                    node, at = f["/nodes"][item["node"]], matrix(item["rotation"])
                    axes = matrix(node["rotation"][0])
                    side, shape = item["node"].split(".")[0], item["shape"]
                    position = node["position"][0] + axes @ item["position"]
                    places[side, shape] = np.concatenate([position, (axes @ at)[:, 2]])
        for shape in ("cylinder", "cone"):
            mirrored = places["left", shape] * [1, -1, 1, 1, -1, 1]
            np.testing.assert_allclose(places["right", shape], mirrored, atol=1e-14)

    def test_other_files_are_not_replaced(self):
        self.write("model.yaml", self.BAR)
        self.write("notes.txt", "mine")
        says = ("notes.txt: exists and is no results file",)
        self.expect_refusal(1, "model.yaml", "--check", "-o", "notes.txt", says=says)
        self.expect_refusal(1, "model.yaml", "--check", "-o", "nowhere/x.h5", says=("nowhere",))


CYLINDER = """\
SetFactory("OpenCASCADE");
Cylinder(1) = {0, 0, 0, 0, 0, 2000, 500};
Box(2) = {2000, 0, 0, 1000, 2000, 3000};
"""


def volume_inside(corners):
    """Returns the volume inside closed surfaces of triangles (n, 3, 3), whose corners are anticlockwise as seen from
    outside."""
    return np.einsum("ij,ij->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6


class Surface(CommandTest):
    program = "bielle-reduce"

    def surface(self, *arguments):
        done = self.run_program("--surface", *arguments, "-o", "surface.stl")
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.path("surface.stl"), "rb") as file:
            data = file.read()
        count = struct.unpack("<I", data[80:84])[0]
        self.assertEqual(len(data), 84 + 50 * count)
        record = np.frombuffer(data[84:], dtype=[("numbers", "<f4", 12), ("attribute", "<u2")])
        return record["numbers"][:, 3:].reshape(-1, 3, 3).astype(float)

    def test_solids_have_closed_surfaces_of_their_volume_in_metres(self):
        self.write("two.geo", CYLINDER)
        corners = self.surface("two.geo", "--length-unit", "mm")
        box = corners[:, :, 0].min(axis=1) > 1
        self.assertAlmostEqual(volume_inside(corners[box]), 6, 4)
        # A prism with n sides has sin(2 pi/n)/(2 pi/n) of the volume of the cylinder, 0.99 for 25 sides.
        ratio = volume_inside(corners[~box]) / (np.pi * 0.25 * 2)
        self.assertTrue(0.98 < ratio < 1, ratio)

    def test_wrong_calls_are_refused(self):
        self.write("two.geo", CYLINDER)
        self.expect_refusal(1, "--surface", "two.geo", says=("--surface needs -o",))
        self.expect_refusal(1, "--surface", "missing.step", "-o", "x.stl", says=("missing.step",))
        self.expect_refusal(1, "--surface", "two.geo", "-o", "two.geo", says=("two.geo",))
        self.write("bad.step", "ISO-10303-21; nothing")
        self.expect_refusal(1, "--surface", "bad.step", "-o", "x.stl", says=("bad.step",))
        self.assertFalse(os.path.exists(self.path("x.stl")))


class Geometry(CommandTest):
    program = "bielle-mechanism"
    MODEL = """\
nodes: {a: {fixed: [rx, ry, rz], shape: {step: part.step, colour: steelblue}}}
elements: {a: {type: point_mass, node: a, mass: 1}}
analysis: [{type: dynamic, duration: 0.01, step: 0.01}]
"""

    def test_a_geometry_is_drawn_by_its_surface(self):
        shutil.copy(os.path.join(REPOSITORY, "meshes", "conrod.step"), self.path("part.step"))
        self.write("model.yaml", self.MODEL)
        done = self.run_program("model.yaml", "-o", "run.h5")
        self.assertEqual(done.returncode, 0, done.stderr)
        with h5py.File(self.path("run.h5")) as f:
            mesh = f["/drawing_meshes/part"]
            corners = mesh["points"][()].astype(float)[mesh["triangles"][()]]
        command = [os.path.join(PROGRAMS, "bielle-reduce"), "--list", "part.step"]
        listed = subprocess.run(command, cwd=self.folder, text=True, capture_output=True)
        volume = float(re.search(r"volume 1: .*, ([\d.e+-]+) m\^3", listed.stdout)[1])
        self.assertAlmostEqual(volume_inside(corners) / volume, 1, delta=0.02, msg=listed.stdout)

    def test_a_wrong_geometry_is_refused_with_its_place(self):
        self.write("model.yaml", self.MODEL)
        self.expect_refusal(1, "model.yaml", says=("model.yaml:1: nodes.a.shape.step: ", "part.step"))
        self.write("part.step", "ISO-10303-21; nothing")
        self.expect_refusal(1, "model.yaml", says=("model.yaml:1: nodes.a.shape.step: ", "part.step"))


if __name__ == "__main__":
    unittest.main()
