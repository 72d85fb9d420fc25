"""Tests that one body in all forms of Nastran and Abaqus is the same mesh, in Bielle and in gmsh."""

import os
import unittest

import numpy as np

from box_mesh import REPOSITORY, InFolder, area
from cell_decks import SIDE, VOLUME
from everything_deck import Everything
from gmsh_library import GmshFile
from python_tool import run_python_tool
from test_deck_assemblies import volume
from bielle_tools.decks.materials import read_materials
from bielle_tools.mesh.cells import SOLIDS, triangles_of

CONVERT = os.path.join(REPOSITORY, "tools", "convert_mesh.py")


class EverythingInDecks(InFolder):
    def converted(self, name):
        target = name.replace(".", "_") + ".msh"
        done = run_python_tool(CONVERT, [self.path(name), self.path(target)])
        self.assertEqual(done.returncode, 0, done.stderr)
        return GmshFile(self.path(target))

    @staticmethod
    def cells(mesh, numbers, cells):
        """Returns {type: set of the cells, each as the common numbers of its nodes}."""
        return {kind: {frozenset(numbers[row].tolist()) for row in block} for kind, block in cells.items() if len(block)}

    def test_both_decks_are_the_same_body(self):
        deck = Everything()
        deck.write(self.write)
        one, other = self.converted("deck.bdf"), self.converted("deck.inp")
        places = np.array(deck.box.points)
        numbers = []
        for mesh in (one, other):
            self.assertEqual(len(mesh.points), len(places))
            distances = np.linalg.norm(mesh.points[:, None] - places[None], axis=2)
            numbers.append(distances.argmin(axis=1))
            self.assertLess(distances.min(axis=1).max(), 1e-12)
            self.assertEqual(len(set(numbers[-1].tolist())), len(places))
            self.assertAlmostEqual(volume(mesh) / VOLUME, 1, delta=1e-11)
            self.assertGreater(mesh.least_determinant, 0)
        self.assertEqual(self.cells(one, numbers[0], one.cells), self.cells(other, numbers[1], other.cells))
        self.assertEqual({kind for kind in one.cells if kind in SOLIDS}, {"wedge15", "hexahedron20", "pyramid13", "tetra10"})
        self.assertEqual(set(one.groups), {(3, "property_1"), (3, "property_2"), (2, "property_9")})
        for (dimension, name), cells in one.groups.items():
            twin = next(found for (_, each), found in other.groups.items() if each.lower() == name)
            self.assertEqual(self.cells(one, numbers[0], cells), self.cells(other, numbers[1], twin), name)
            if dimension == 2:
                self.assertAlmostEqual(area(one.points, triangles_of(cells)) / SIDE, 1, delta=1e-12)

    def test_both_decks_have_the_same_materials(self):
        Everything().write(self.write)
        one, other = (read_materials(self.path(name)) for name in ("deck.bdf", "deck.inp"))
        self.assertEqual(one.materials, other.materials)
        self.assertEqual(one.regions, {"property_1": "mat_1", "property_2": "mat_2"})
        self.assertEqual(one.regions, other.regions)


if __name__ == "__main__":
    unittest.main()
