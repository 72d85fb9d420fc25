"""Tests of coarser triangles of surfaces: a sphere, a thin plate, a bar."""

import unittest

import numpy as np

import box_mesh

from bielle_tools.mesh.cells import boundary_faces, solid_faces, triangles_of  # box_mesh sets the path
from bielle_tools.scene.levels import FEWEST, levels_of


def surface(divisions, size):
    """Returns points and outward triangles of a box of tetrahedra."""
    points, cells = box_mesh.box(divisions, size, 1)
    nodes, triangles = np.unique(triangles_of(boundary_faces(solid_faces({"tetra": cells}))), return_inverse=True)
    return points[nodes], triangles.reshape(-1, 3)


def volume(points, triangles):
    a, b, c = (points[triangles[:, k]] for k in range(3))
    return np.einsum("ij,ij->", a, np.cross(b, c)) / 6


def area(points, triangles):
    a, b, c = (points[triangles[:, k]] for k in range(3))
    return np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2


class Levels(unittest.TestCase):
    def levels(self, points, triangles):
        order, levels = levels_of(points, triangles)
        self.assertEqual(sorted(order), list(range(len(points))))
        self.assertEqual((levels[0].cell, levels[0].count), (0, len(points)))
        np.testing.assert_array_equal(order[levels[0].triangles], triangles)
        for finer, coarser in zip(levels, levels[1:]):
            self.assertLess(len(coarser.triangles), len(finer.triangles))
            self.assertLess(coarser.count, finer.count)
            self.assertGreater(coarser.cell, finer.cell)
            self.assertEqual(np.unique(coarser.triangles).tolist(), list(range(coarser.count)))
        return points[order], levels

    def test_the_surface_of_a_bar_stays_where_it_is(self):
        """Asserts that each point of the surface is within the diagonal of a cell from a coarse point on the same
        side."""
        points, levels = self.levels(*surface((40, 12, 12), (1.0, 0.3, 0.3)))
        self.assertGreater(len(levels), 3)
        for level in levels[1:]:
            near = np.linalg.norm(points[:, None] - points[None, :level.count], axis=2).min(axis=1).max()
            self.assertLessEqual(near, np.sqrt(3) * sum(each.cell for each in levels if each.cell <= level.cell))
        exact = 0.09
        for level in levels:
            if level.cell < 0.1:
                self.assertAlmostEqual(volume(points, level.triangles) / exact, 1, delta=1e-12 + 2 * level.cell / 0.3)

    def test_a_thin_plate_keeps_both_sides(self):
        points, levels = self.levels(*surface((40, 40, 1), (1.0, 1.0, 0.002)))
        for level in levels:
            if level.cell < 0.1:
                self.assertAlmostEqual(area(points, level.triangles) / 2.008, 1, delta=2 * level.cell)
                self.assertGreater(volume(points, level.triangles), 0.5 * 0.002)

    def test_small_and_empty_surfaces_have_one_level(self):
        for divisions in ((1, 1, 1), (2, 2, 2)):
            points, triangles = surface(divisions, (1, 1, 1))
            self.assertLess(len(triangles), FEWEST)
            self.assertEqual(len(levels_of(points, triangles)[1]), 1)
        order, levels = levels_of(np.zeros((3, 3)), np.zeros((0, 3), int))
        self.assertEqual((order.tolist(), len(levels)), ([0, 1, 2], 1))
        many = np.zeros((600, 3)), np.arange(600).reshape(-1, 3)  # a body without extent
        self.assertEqual(len(levels_of(*many)[1]), 1)


if __name__ == "__main__":
    unittest.main()
