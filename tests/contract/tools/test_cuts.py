"""Tests of solids with holes in pictures: the surfaces are closed and enclose the remaining volume, for any position of
the solid."""

import os
import sys
import unittest

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.dirname(HERE))

from in_folder import REPOSITORY, InFolder  # noqa: E402

sys.path[:0] = [os.path.join(REPOSITORY, "tools"), HERE]

from bielle_tools.results import Results  # noqa: E402
from bielle_tools.results.quaternions import product, rotated  # noqa: E402
from bielle_tools.scene import make_scene  # noqa: E402
from bielle_tools.scene.cuts import ROUND, solid_mesh  # noqa: E402
from bielle_tools.scene.outlines import triangulated  # noqa: E402
from drawn_results import resting, write_results  # noqa: E402

CIRCLE = ROUND * np.sin(2 * np.pi / ROUND) / 2  # area of the polygon that represents a circle of radius 1
HALF = 0.5 ** 0.5
ABOUT_X, ABOUT_Y = (HALF, HALF, 0, 0), (HALF, 0, HALF, 0)  # a quarter of a turn
TURNED = np.array([0.8, 0.2, -0.4, 0.4])  # a unit quaternion
BOX = {"shape": "box", "size": [2, 1, 0.4]}
DISC = {"shape": "cylinder", "radius": 1, "length": 0.2}


def volume(mesh):
    corners = mesh.points[mesh.triangles]
    return np.einsum("ij,ij->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6


def is_closed(mesh):
    """Asserts that every edge has as many triangles on one side as on the other."""
    _, same = np.unique(np.round(mesh.points, 9) + 0.0, axis=0, return_inverse=True)
    triangles = same[mesh.triangles]
    edges = np.concatenate([triangles[:, [k, (k + 1) % 3]] for k in range(3)])
    count = np.zeros((same.max() + 1,) * 2, int)
    np.add.at(count, tuple(edges.T), 1)
    return (count == count.T).all()


def hole(radius, length, position, rotation=(1, 0, 0, 0), **more):
    return {"shape": "cylinder", "radius": radius, "length": length, "position": list(position), "rotation": list(rotation), **more}


def window(size, position, rotation=(1, 0, 0, 0)):
    return {"shape": "box", "size": list(size), "position": list(position), "rotation": list(rotation)}


def put(item, position, rotation):
    """Returns the item on a displaced solid."""
    own = rotated(rotation, np.asarray(item.get("position", (0, 0, 0)), float))
    return {**item, "entry": "elements/it", "position": list(own + position), "rotation": list(product(rotation, np.asarray(item.get("rotation", (1, 0, 0, 0)), float)))}


class Cuts(unittest.TestCase):
    def test_a_bore_along_each_axis_leaves_the_box_where_it_is(self):
        size, place = np.array(BOX["size"]), np.array([0.3, 0.1, 0.02])
        for axis, rotation in ((0, ABOUT_Y), (1, ABOUT_X), (2, (1, 0, 0, 0))):
            with self.subTest(axis=axis):
                points = solid_mesh({**BOX, "entry": "elements/it", "position": [0, 0, 0], "rotation": [1, 0, 0, 0]},
                                    [hole(0.1, 3, place, rotation, entry="elements/it")])[0].points
                np.testing.assert_allclose([points.min(axis=0), points.max(axis=0)], [-size / 2, size / 2], atol=1e-12)
                away = np.delete(points - place, axis, axis=1)
                rim = np.abs(np.linalg.norm(away, axis=1) - 0.1) < 1e-9
                self.assertGreaterEqual(np.count_nonzero(rim), 2 * ROUND)
                self.assertTrue((np.isclose(np.abs(np.delete(points[~rim], axis, axis=1)), np.delete(size / 2, axis)).all()))

    def check(self, solid, cuts, left):
        """The same holds for a displaced and rotated solid."""
        for position, rotation in ((np.zeros(3), np.array([1.0, 0, 0, 0])), (np.array([3.0, -1, 2]), TURNED)):
            mesh, _ = solid_mesh(put(solid, position, rotation), [put(cut, position, rotation) for cut in cuts])
            self.assertAlmostEqual(volume(mesh), left, delta=1e-12)
            self.assertTrue(is_closed(mesh))

    def test_holes_along_each_axis_of_a_box(self):
        for cut, length in ((hole(0.15, 0.4, [0.5, 0.2, 0]), 0.4), (hole(0.15, 5, [0.5, 0, 0], ABOUT_X), 1), (hole(0.15, 2, [0, 0.1, 0], ABOUT_Y), 2)):
            self.check(BOX, [cut], 0.8 - CIRCLE * 0.0225 * length)

    def test_blind_holes_and_pockets_end_inside(self):
        self.check(BOX, [hole(0.2, 0.2, [0.5, 0, 0.1])], 0.8 - CIRCLE * 0.04 * 0.2)
        self.check(BOX, [window([0.3, 0.2, 0.1], [-0.5, 0.1, -0.15], (np.cos(0.2), 0, 0, np.sin(0.2))), hole(0.2, 0.4, [0.5, 0, 0])], 0.8 - 0.006 - CIRCLE * 0.04 * 0.4)
        self.check(BOX, [hole(0.2, 0.1, [0.5, 0, 0])], 0.8 - CIRCLE * 0.04 * 0.1)  # a cavity
        self.check(BOX, [hole(0.2, 0.1, [0.5, 0, 0.15]), hole(0.1, 0.3, [0.5, 0, -0.05])], 0.8 - CIRCLE * (0.004 + 0.003))  # a counterbore

    def test_bolts_of_a_disc_and_of_a_tube(self):
        bolts = [hole(0.1, 0.2, [0.7 * np.cos(a), 0.7 * np.sin(a), 0]) for a in np.pi / 3 * np.arange(6)]
        self.check(DISC, bolts, CIRCLE * 0.2 * (1 - 0.06))
        self.check({"shape": "tube", "radius": 1, "inner_radius": 0.4, "length": 0.2}, bolts, CIRCLE * 0.2 * (1 - 0.16 - 0.06))

    def test_what_cannot_be_drawn_is_left_out(self):
        for cut in (hole(0.2, 0.4, [0.9, 0, 0]), hole(0.2, 0.4, [0.8, 0, 0]), hole(0.1, 0.4, [0, 0, 1]), hole(0.1, 9, [0, 0, 0], TURNED), {"shape": "sphere", "radius": 0.1},
                    {"shape": "tube", "radius": 0.2, "inner_radius": 0.1, "length": 0.4}, hole(0.1, 0.4, [0, 0, 0], node="other"), hole(-1, 0.4, [0, 0, 0]),
                    hole(float("nan"), 0.4, [0, 0, 0]), {"shape": "cylinder"}, {"shape": "box", "size": 3}, hole(0.1, 0.4, [0, 0, "x"])):
            with self.subTest(cut=cut):
                mesh, left_out = solid_mesh({**BOX, "entry": "e"}, [cut])
                self.assertAlmostEqual(volume(mesh), 0.8, delta=1e-12)
                self.assertEqual(left_out, 1)
        self.check(DISC, [hole(0.05, 0.2, [0, 0, 0], ABOUT_X)], CIRCLE * 0.2)
        # The second hole overlaps the first.
        self.check(BOX, [hole(0.2, 0.4, [0, 0, 0]), hole(0.2, 0.4, [0.3, 0, 0])], 0.8 - CIRCLE * 0.016)

    def test_random_holes_fill_the_outline_with_triangles(self):
        random = np.random.default_rng(7)
        for _ in range(30):
            holes, discs = [], []
            for _ in range(60):
                radius, centre = random.uniform(0.005, 0.2), random.uniform(-1, 1, 2)
                if np.abs(centre).max() + radius < 0.999 and all(np.linalg.norm(centre - c) > radius + r + 1e-3 for c, r in discs):
                    discs.append((centre, radius))
                    angles = random.uniform(0, 6) + 2 * np.pi * np.arange(n := int(random.integers(3, 20))) / n
                    holes.append(centre + radius * np.column_stack([np.cos(angles), np.sin(angles)]))
            points, triangles = triangulated(np.array([[-1.0, -1], [1, -1], [1, 1], [-1, 1]]), holes)
            a, b, c = (points[triangles[:, k]] for k in range(3))
            areas = np.cross(b - a, c - a) / 2
            self.assertTrue((areas > 0).all())
            expected = 4 - sum(len(h) * np.sin(2 * np.pi / len(h)) / 2 * r * r for h, (_, r) in zip(holes, discs))
            self.assertAlmostEqual(areas.sum(), expected, delta=1e-12)
            self.assertEqual(len(triangles), len(points) + 2 * len(holes) - 2)


class Drawn(InFolder):
    def test_a_cut_is_no_part_of_its_own(self):
        items = [{"entry": "elements/it", "type": "rigid_body", "node": "n", **BOX},
                 {"entry": "elements/it", "type": "rigid_body", "node": "n", "role": "cut", **hole(0.2, 0.4, [0, 0, 0])},
                 {"entry": "elements/other", "type": "rigid_body", "node": "n", **DISC}]
        scene = make_scene(Results(write_results(self.path("run.h5"), {"n": resting(2)}, items)))
        parts = {part.entry: part for part in scene.parts if part.group == "body"}
        self.assertEqual(len([part for part in scene.parts if part.entry == "elements/it"]), 1)
        self.assertAlmostEqual(volume(parts["elements/it"].mesh), 0.8 - CIRCLE * 0.016, delta=1e-12)
        self.assertAlmostEqual(volume(parts["elements/other"].mesh), CIRCLE * 0.2, delta=1e-12)
        self.assertEqual(scene.notes, [])


if __name__ == "__main__":
    unittest.main()
