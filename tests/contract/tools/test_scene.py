"""Tests of the scene that is drawn from results: meshes, motion, paths of ropes, damaged drawings."""

import json
import os
import random
import sys
import tempfile
import unittest

import numpy as np

REPOSITORY = os.path.dirname(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))))
sys.path.insert(0, os.path.join(REPOSITORY, "tools"))

from bielle_tools.results import Results  # noqa: E402
from bielle_tools.results.quaternions import from_axes, from_z, product, rotated  # noqa: E402
from bielle_tools.results.rotations import rotation_matrices  # noqa: E402
from bielle_tools.scene import make_scene  # noqa: E402
from bielle_tools.scene.arrows import arrows_of  # noqa: E402
from bielle_tools.scene.templates import box, cylinder, extruded, lathe, sphere, torus, tube  # noqa: E402
from bielle_tools.scene.transforms import placed  # noqa: E402
from drawn_results import every_shape, resting, stressed_beam, turning, write_results  # noqa: E402


def volume(mesh):
    """Returns the volume by the divergence theorem, which is positive if triangles point outward."""
    a, b, c = (mesh.points[mesh.triangles[:, k]] for k in range(3))
    return np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6


class Scenes(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def scene(self, nodes, items, **options):
        path = tempfile.mkstemp(".h5", dir=self.folder.name)[1]
        results = Results(write_results(path, nodes, items, **options))
        self.addCleanup(results.file.close)
        return make_scene(results)

    def test_volumes_of_templates_are_those_of_the_solids(self):
        polygon = 24 / 2 * np.sin(2 * np.pi / 24)  # area of a regular polygon in the unit circle
        self.assertAlmostEqual(volume(box([1, 2, 3])), 6, 12)
        self.assertAlmostEqual(volume(cylinder(2, 3)), polygon * 4 * 3, 12)
        self.assertAlmostEqual(volume(tube(2, 1, 3)), polygon * 3 * 3, 12)
        self.assertAlmostEqual(volume(extruded([[0, 0], [0, 1], [1, 1], [1, 0]], 2)), 2, 12)
        self.assertAlmostEqual(volume(sphere(1, 100, 200)), 4 / 3 * np.pi, 2)
        self.assertAlmostEqual(volume(torus(1, 0.4, around=400)), 2 * np.pi**2 * 0.8 * 0.04, 1)
        self.assertAlmostEqual(volume(lathe([(0, 0), (1, 0), (0, 1)])), polygon / 3, 12)

    def test_rotations_from_directions_and_axes(self):
        directions = np.random.default_rng(1).normal(size=(50, 3))
        directions[0] = [0, 0, -2]
        unit = directions / np.linalg.norm(directions, axis=1, keepdims=True)
        np.testing.assert_allclose(rotated(from_z(directions), np.array([0, 0, 1.0])), unit, atol=1e-12)
        q = np.random.default_rng(2).normal(size=(50, 4))
        q /= np.linalg.norm(q, axis=1, keepdims=True)
        again = from_axes(*(rotated(q, axis) for axis in np.eye(3)))
        np.testing.assert_allclose(np.abs((q * again).sum(axis=1)), 1, atol=1e-12)

    def test_every_shape_is_drawn(self):
        nodes, items, meshes = every_shape()
        scene = self.scene(nodes, items, meshes=meshes)
        drawn = {part.entry for part in scene.parts}
        self.assertEqual({item["entry"] for item in items} - drawn, {"elements/odd"})
        self.assertEqual([entry for entry, _ in scene.notes], ["/drawing"])
        for part in scene.parts:
            poses = scene.poses(part, scene.rows)
            self.assertEqual(poses.shape, (31, part.mesh.bone_count, 8), part.entry)
            self.assertTrue(np.isfinite(poses).all() and np.isfinite(part.mesh.points).all(), part.entry)
            self.assertLess(part.mesh.triangles.max(initial=-1), len(part.mesh.points))
        self.assertEqual({anchor.entry for anchor in scene.anchors}, drawn)

    def test_a_corner_of_a_box_moves_with_its_node(self):
        q, x = turning(20, (0, 0, 1)), np.column_stack([np.arange(20.0), np.zeros(20), np.zeros(20)])
        item = {"entry": "elements/box", "type": "rigid_body", "shape": "box", "node": "n", "position": [1, 0, 0], "size": [0.2, 0.2, 0.2]}
        scene = self.scene({"n": (x, q)}, [item])
        corner = placed(scene.poses(scene.parts[0], scene.rows)[:, 0], np.array([0.1, 0.1, 0.1]))
        angle = 0.1 * np.arange(20)
        expected = x + np.column_stack([1.1 * np.cos(angle) - 0.1 * np.sin(angle), 1.1 * np.sin(angle) + 0.1 * np.cos(angle), np.full(20, 0.1)])
        np.testing.assert_allclose(corner, expected, atol=1e-12)

    def test_the_length_of_a_belt_is_that_of_the_closed_form(self):
        R, r, d = 0.3, 0.1, 1.0
        lean = np.arcsin((R - r) / d)
        open_belt = 2 * d * np.cos(lean) + np.pi * (R + r) + 2 * lean * (R - r)
        cross = np.arcsin((R + r) / d)
        crossed = 2 * d * np.cos(cross) + (np.pi + 2 * cross) * (R + r)
        for sides, expected in (((1, 1), open_belt), ((-1, -1), open_belt), ((1, -1), crossed)):
            points = [{"node": "ground", "radius": R, "side": sides[0]}, {"node": "ground", "position": [d, 0, 0], "radius": r, "side": sides[1]}]
            scene = self.scene({"n": resting(3)}, [{"entry": "joints/belt", "type": "belt", "shape": "course", "closed": True, "points": points}])
            length = scene.poses(scene.parts[0], [0])[0, :, 7].sum()
            # Arcs of 14 chords have a share of 1 - (angle/14)^2/24.
            self.assertAlmostEqual(length / expected, 1, delta=0.003)
            self.assertLess(length, expected)

    def test_a_course_over_a_moving_pulley_is_continuous_in_space(self):
        x = np.column_stack([0.5 + 0.02 * np.arange(20), np.zeros(20), np.zeros(20)])
        points = [{"node": "ground", "position": [0, 0.5, 0]}, {"node": "n", "radius": 0.1, "side": -1}, {"node": "ground", "position": [1.5, 0.5, 0]}]
        scene = self.scene({"n": (x, turning(20, (0, 0, 1)))}, [{"entry": "joints/c", "type": "cable", "shape": "course", "closed": False, "points": points}])
        poses = scene.poses(scene.parts[0], scene.rows)
        ends = placed(poses, np.array([0, 0, 1.0]))
        np.testing.assert_allclose(ends[:, :-1], poses[:, 1:, :3], atol=1e-12)
        distance = np.linalg.norm(poses[:, 1:15, :3] - x[:, None], axis=-1)
        np.testing.assert_allclose(distance, 0.1, atol=1e-12)

    def test_items_that_cannot_be_drawn_are_told(self):
        items = [{"entry": "a/lost", "shape": "box", "size": [1, 1, 1], "node": "absent"}, {"entry": "a/flat", "shape": "sphere", "radius": -1},
                 {"entry": "a/bare", "shape": "cylinder"}, {"shape": "box"}, 7, {"entry": "a/mesh", "shape": "mesh", "mesh": "gone"}]
        # `output: only` omits it, which is no error.
        items.append({"entry": "nodes/absent", "shape": "node", "node": "absent"})
        scene = self.scene({"n": resting(2)}, items)
        self.assertEqual(scene.parts, [])
        self.assertNotIn("nodes/absent", dict(scene.notes))
        told = dict(scene.notes)
        self.assertIn("'absent'", told["a/lost"])
        self.assertIn("not positive", told["a/flat"])
        self.assertIn("'radius' is missing", told["a/bare"])
        self.assertIn("gone", told["a/mesh"])

    def test_a_node_with_one_or_two_held_rotations_has_a_ring_about_each(self):
        lying = [np.sqrt(0.5), 0, np.sqrt(0.5), 0]  # takes z to x
        for fixed, axes, thin in ((["rz"], None, 2), (["rx"], None, 0), (["ry"], None, 1), (["rz"], lying, 0)):
            item = {"entry": "nodes/n", "type": "node", "shape": "support", "role": "support", "node": "n", "fixed": fixed, **({"axes": axes} if axes else {})}
            scene = self.scene({"n": (np.zeros((20, 3)), turning(20, (0, 0, 1)))}, [item])
            self.assertEqual([part.group for part in scene.parts], ["ground"])
            for row in (0, 13):  # the held axis is fixed in space
                size = np.ptp(placed(scene.poses(scene.parts[0], [row])[0, scene.parts[0].mesh.bones], scene.parts[0].mesh.points), axis=0)
                self.assertEqual(np.argmin(size), thin)
                self.assertLess(size[thin], 0.1 * size.max())
        self.assertGreater(volume(scene.parts[0].mesh), 0)
        both = {"entry": "nodes/n", "type": "node", "shape": "support", "role": "support", "node": "n", "fixed": ["rx", "ry"]}
        self.assertEqual(len(self.scene({"n": resting(2)}, [both]).parts), 1)
        self.assertEqual(self.scene({"n": resting(2)}, [{**both, "fixed": ["rx", "ry", "rz"]}]).parts, [])
        self.assertIn("axes", dict(self.scene({"n": resting(2)}, [{**both, "axes": [0, 0, 0, 0]}]).notes)["nodes/n"])

    def test_the_ends_of_a_beam_have_the_axes_of_its_sections(self):
        # The axes of the node at the start differ from those of the sections by 90 degrees about y.
        q = np.tile([1.0, 0, 0, 0], (4, 5, 1))
        q[:, 0] = [np.sqrt(0.5), 0, np.sqrt(0.5), 0]
        whole = turning(4, (0, 0, 1), 0.3)

        def beam(file):
            group = file.create_group("elements/b")
            x = np.zeros((4, 5, 3))
            x[..., 0] = np.arange(5)
            group["position"] = np.einsum("tij,tkj->tki", rotation_matrices(whole), x)
            group["rotation"] = product(whole[:, None], q)
        item = {"entry": "elements/b", "type": "beam", "shape": "beam", "element": "elements/b", "sections": [{"at": 0, "outer": [[-1, -1], [1, -1], [1, 1], [-1, 1]]}]}
        scene = self.scene({"n": resting(4)}, [item], extra=beam)
        np.testing.assert_allclose(scene.poses(scene.parts[0], scene.rows)[:, :, 3:7], np.tile(whole[:, None], (1, 5, 1)), atol=1e-12)
        self.assertAlmostEqual(volume(scene.parts[0].mesh), 0, 12)  # all stations are at the origin of their bones
        points = placed(scene.poses(scene.parts[0], [2])[0, scene.parts[0].mesh.bones], scene.parts[0].mesh.points)
        self.assertAlmostEqual(volume(type(scene.parts[0].mesh)(points, scene.parts[0].mesh.triangles, None, None)), 16, 9)

    def test_loads_have_arrows(self):
        # A load acts at a point of a node that rotates by 90 degrees. The resultant on a beam along x is 4 N along y at
        # x = 1.5, while the middle is at 1.
        node = np.zeros((2, 3)), np.array([[1.0, 0, 0, 0], [np.sqrt(0.5), 0, 0, np.sqrt(0.5)]])
        beam, records = stressed_beam()

        def loads(file):
            group = file.create_group("loads/push")
            group["force"], group["moment"] = [[0, 0, 5.0], [0, 0, 7]], np.zeros((2, 3))
            records(file)
            of_beam = file["elements/beam"]
            of_beam["distributed_force"], of_beam["distributed_moment"] = [[0, 4.0, 0], [0, 0, 0]], [[0, 0, 6.0], [0, 0, 0]]
        scene = self.scene({"n": node}, [{"entry": "loads/push", "type": "load", "shape": "force", "node": "n", "position": [1, 0, 0]}, beam], extra=loads)
        push, line = arrows_of(scene, np.arange(2))
        self.assertEqual([(each.entry, each.kind, each.largest) for each in (push, line)], [("loads/push", "loads", 7), ("elements/beam", "loads", 4)])
        np.testing.assert_allclose(push.origin, [[1, 0, 0], [0, 1, 0]], atol=1e-15)
        np.testing.assert_allclose(push.vector, [[0, 0, 5], [0, 0, 7]])
        np.testing.assert_allclose(line.origin, [[1.5, 0, 0], [1, 0, 0]])

    def test_equal_planes_are_drawn_once_and_others_do_not_overlap(self):
        def plane(name, x, z=0.0):
            return {"entry": f"joints/{name}", "type": "wheel", "shape": "plane", "node": "ground", "position": [x, 0, z]}
        box = {"entry": "elements/box", "type": "rigid_body", "shape": "box", "node": "n", "size": [20, 1, 1]}
        scene = self.scene({"n": resting(2)}, [box, plane("a", 0), plane("b", 0), plane("c", 1), plane("d", 0, 2)])
        planes = {part.entry: part for part in scene.parts if part.group == "ground"}
        self.assertEqual(set(planes), {"joints/a", "joints/c", "joints/d"})
        widths = {entry: np.ptp(part.mesh.points[:, 0]) for entry, part in planes.items()}
        np.testing.assert_allclose([widths["joints/a"], widths["joints/c"]], [1, 1])  # 1 m apart
        self.assertGreater(widths["joints/d"], 2)

    def test_symbols_do_not_cover_thin_beams(self):
        half, joint = 0.12, {"entry": "joints/j", "type": "hinge", "shape": "joint", "frames": [{"node": "ground"}, {"node": "n"}]}
        item, records = stressed_beam()  # 2 m long, with half the width of 0.2 m
        bar = {"entry": "elements/bar", "type": "rigid_body", "shape": "box", "node": "n", "size": [10, 0.1, 0.1]}
        self.assertAlmostEqual(self.scene({"n": resting(3)}, [bar, joint]).symbol, 0.02 * 10, delta=0.01)
        with_beam = self.scene({"n": resting(3)}, [bar, joint, item], extra=records).symbol
        self.assertAlmostEqual(with_beam, half, delta=1e-3)

    def test_arrows_of_reactions_and_contacts(self):
        def records(file):
            file["joints/pin/reaction_inertial"] = np.tile([1.0, 2, 3, 4, 5, 6], (4, 1))
            file["contacts/touch/point"] = np.tile([1.0, 1, 1], (4, 1))
            file["contacts/touch/force"] = np.array([[[0, 0, -5.0], [0, 0, 3.0], [0, 0, 2.0]]] * 4)
        items = [{"entry": "joints/pin", "type": "hinge", "shape": "joint", "frames": [{"node": "ground"}, {"node": "n", "position": [0.5, 0, 0]}]},
                 *({"entry": "joints/touch", "type": "contact", "shape": "sphere", "radius": 0.1, "role": "contact", "node": node} for node in ("ground", "n", "m"))]
        scene = self.scene({"n": resting(4, (2, 0, 0)), "m": resting(4, (3, 0, 0))}, items, extra=records)
        found = [(arrow.entry, arrow.kind, arrow.origin[2].tolist(), arrow.vector[2].tolist()) for arrow in arrows_of(scene, scene.rows)]
        self.assertEqual(found, [("joints/pin", "reactions", [2.5, 0, 0], [1, 2, 3]), ("joints/touch", "contact forces", [2, 0, 0], [0, 0, 3]),
                                 ("joints/touch", "contact forces", [3, 0, 0], [0, 0, 2])])

    def test_damaged_drawings_never_fail(self):
        nodes, items, meshes = every_shape(5)
        chance, text = random.Random(7), json.dumps(items)
        wrong = [None, -1, 0, 1e308, float("nan"), float("inf"), "x", [], {}, [1], True, [[1, 2], [3]], "ground", "end"]

        def damaged(tree):
            places = []

            def walk(part):
                for key, each in list(part.items() if isinstance(part, dict) else enumerate(part) if isinstance(part, list) else ()):
                    places.append((part, key))
                    walk(each)
            walk(tree)
            for part, key in chance.sample(places, chance.choice([1, 3, 30])):
                part[key] = chance.choice(wrong)
            return tree
        for _ in range(60):
            scene = self.scene(nodes, damaged(json.loads(text)), meshes=meshes)
            self.assertTrue(np.isfinite(scene.size) and np.isfinite(scene.symbol) and scene.size > 0)
            for part in scene.parts:
                self.assertEqual(scene.poses(part, scene.rows).shape, (5, part.mesh.bone_count, 8), part.entry)

    def test_planar_machines_and_scales(self):
        for unit in (1e-6, 1.0, 1e5):
            x = unit * np.column_stack([np.cos(np.arange(9)), np.full(9, 3.0), np.sin(np.arange(9))])
            item = {"entry": "nodes/n", "type": "node", "shape": "node", "node": "n"}
            scene = self.scene({"n": (x, turning(9, (0, 1, 0)))}, [item])
            self.assertEqual(scene.planar, 1)
            self.assertTrue(1 < scene.size / unit < 4 and 0.005 < scene.symbol / scene.size < 0.05, (unit, scene.size, scene.symbol))


if __name__ == "__main__":
    unittest.main()
