"""Tests of Abaqus decks with parts and instances: a part that is moved and rotated equals the same mesh written in
place."""

import unittest

import numpy as np
from scipy.spatial.transform import Rotation

from box_mesh import InFolder, area
from cell_decks import SIDE, SIZE, VOLUME, Box
from bielle_tools.decks.abaqus_file import read_abaqus
from bielle_tools.decks.materials import read_materials
from bielle_tools.mesh.cell_integrals import volumes
from bielle_tools.mesh.cells import SOLIDS, permutation, triangles_of
from bielle_tools.mesh.solid_mesh import solid_mesh
from bielle_tools.messages import InputError

STEEL = "*MATERIAL, NAME=STEEL\n*ELASTIC\n2.1E11, 0.3\n*DENSITY\n7850.\n"
SHIFT, A, B, ANGLE = (0.1, -0.2, 0.35), (0.3, 0.1, -0.2), (1.3, 2.1, 0.7), 30.0
MOVED = f"{SHIFT[0]}, {SHIFT[1]}, {SHIFT[2]}\n{A[0]}, {A[1]}, {A[2]}, {B[0]}, {B[1]}, {B[2]}, {ANGLE}\n"


def moved(points):
    """Applies the translation, then the rotation about the axis from A to B."""
    axis = np.subtract(B, A) / np.linalg.norm(np.subtract(B, A))
    return Rotation.from_rotvec(np.radians(ANGLE) * axis).apply(np.asarray(points) + SHIFT - A) + A


def volume(mesh):
    """Returns the volume of a mesh by the quadrature of its cells."""
    cells = {kind: block[:, permutation(kind, "gmsh", "vtk")] for kind, block in mesh.cells.items() if kind in SOLIDS}
    return sum(found.sum() for found in volumes(mesh.points, cells).values())


class Decks(InFolder):
    def read(self, text):
        self.mesh = solid_mesh(read_abaqus(self.write("deck.inp", text)))
        return self.mesh

    def refuse(self, text, *parts):
        with self.assertRaises(InputError) as caught:
            self.read(text)
        for part in parts:
            self.assertIn(part, str(caught.exception))

    def materials(self, text):
        return read_materials(self.write("deck.inp", text))


class Instances(Decks):
    def setUp(self):
        super().setUp()
        self.box = Box(("hexahedron", "pyramid", "wedge"), order=2)

    def part(self, name="BLOCK", extra="*SOLID SECTION, ELSET=BODY, MATERIAL=STEEL\n"):
        lines = self.box.abaqus(self.box.surface() + "*NSET, NSET=LEFT\n" + "".join(f"{n + 1},\n" for n in self.box.left()) + extra)
        return f"*PART, NAME={name}\n{lines}*END PART\n"

    @staticmethod
    def assembly(*instances, extra=""):
        """instances: (name, part, data lines)"""
        text = "".join(f"*INSTANCE, NAME={name}, PART={part}\n{lines}*END INSTANCE\n" for name, part, lines in instances)
        return f"*ASSEMBLY, NAME=ALL\n{text}{extra}*END ASSEMBLY\n{STEEL}"

    def check_places(self, mesh, *sets):
        """The nodes of the mesh are at the places of the sets, within 1e-12 of the size."""
        places = np.concatenate(sets)
        self.assertEqual(len(mesh.points), len(places))
        np.testing.assert_allclose(mesh.points, places, atol=1e-12)

    def test_an_instance_that_is_turned_equals_the_mesh_in_place(self):
        one = self.read(self.part() + self.assembly(("B-1", "block", MOVED)))
        self.check_places(one, moved(self.box.points))
        self.box.points = list(moved(self.box.points))
        other = self.read(self.box.abaqus(self.box.surface()))
        self.assertLess(np.abs(one.points - other.points).max(), 1e-12)
        for kind in other.cells:
            np.testing.assert_array_equal(one.cells[kind], other.cells[kind])
        self.assertEqual(set(one.surfaces), {"PRESS", "LEFT"})
        self.assertAlmostEqual(volume(one) / VOLUME, 1, delta=1e-12)

    def test_an_instance_with_a_mesh_of_its_own(self):
        text = f"*PART, NAME=P\n*END PART\n*ASSEMBLY, NAME=A\n*INSTANCE, NAME=P-1, PART=P\n{MOVED}{self.box.abaqus()}*END INSTANCE\n*END ASSEMBLY\n"
        self.check_places(self.read(text), moved(self.box.points))

    def test_several_parts_and_instances(self):
        block = self.part()
        self.box = Box(("tetra",) * 2, order=2)
        mesh = self.read(block + self.part("OTHER") + self.assembly(
            ("B-1", "BLOCK", ""), ("B-2", "BLOCK", "0.6, 0., 0.\n"), ("O-1", "OTHER", MOVED), extra="*NSET, NSET=ENDS, INSTANCE=B-1\nLEFT\n"
            "*NSET, NSET=ENDS, INSTANCE=O-1\nLEFT\n*ELSET, ELSET=TWO, INSTANCE=B-1\n1\n*ELSET, ELSET=TWO, INSTANCE=B-2\n1, 2\n"
            "*ELSET, ELSET=_F, INTERNAL, INSTANCE=B-2\nBODY\n*NSET, NSET=MORE\nB-1.LEFT, ALL.O-1.LEFT\n"))
        self.assertAlmostEqual(volume(mesh) / (3 * VOLUME), 1, delta=1e-12)
        self.assertEqual(set(mesh.volumes), {"B-1.BODY", "B-2.BODY", "O-1.BODY", "TWO"})
        self.assertEqual(set(mesh.surfaces), {*(f"{each}.{name}" for each in ("B-1", "B-2", "O-1") for name in ("PRESS", "LEFT")), "ENDS", "MORE"})
        for name, count in (("B-2.PRESS", 1), ("O-1.PRESS", 1), ("ENDS", 2), ("MORE", 2)):
            self.assertAlmostEqual(self.area(name) / (count * SIDE), 1, delta=1e-12)
        self.assertEqual(sum(len(rows) for rows in mesh.volumes["TWO"].values()), 3)
        self.assertIn("3 instances (B-1, B-2, O-1)", " ".join(mesh.notes))
        x = np.concatenate([mesh.points[np.unique(mesh.cells[kind][rows])] for kind, rows in mesh.volumes["B-2.BODY"].items()])
        np.testing.assert_allclose([x.min(axis=0), x.max(axis=0)], [[0.6, 0, 0], [1.2, SIZE[1], SIZE[2]]], atol=1e-12)

    def area(self, name):
        return area(self.mesh.points, triangles_of({kind: self.mesh.cells[kind][rows] for kind, rows in self.mesh.surfaces[name].items()}))

    def test_materials_of_instances(self):
        block = self.part()
        text = block + self.part("OTHER", "*SOLID SECTION, ELSET=BODY, MATERIAL=ALU\n")
        found = self.materials(text + self.assembly(("B-1", "BLOCK", ""), ("B-2", "BLOCK", "1., 0., 0.\n"), ("O-1", "OTHER", MOVED))
                               + STEEL.replace("STEEL", "ALU").replace("2.1E11", "7.E10"))
        self.assertEqual(found.regions, {"B-1.BODY": "STEEL", "B-2.BODY": "STEEL", "O-1.BODY": "ALU"})
        self.assertEqual(found.materials["ALU"]["young"], 7e10)
        self.assertEqual(self.materials(block + self.assembly(("B-1", "BLOCK", MOVED))).regions, {"BODY": "STEEL"})
        stiff = self.part() + self.assembly(("B-1", "BLOCK", MOVED)).replace(
            "*ELASTIC\n2.1E11, 0.3", "*ELASTIC, TYPE=ENGINEERING CONSTANTS\n1.4E11,1E10,1E10,.3,.3,.4,5E9,5E9\n3.5E9")
        with self.assertRaisesRegex(InputError, "its instance is turned"):
            self.materials(stiff)
        self.assertIn("E1", self.materials(stiff.replace(MOVED, "1., 2., 3.\n")).materials["STEEL"])

    def test_wrong_assemblies_are_told(self):
        part, one = self.part(), ("B-1", "BLOCK", "")
        self.refuse(part + self.assembly(("B-1", "BLOK", "")), "there is no part 'BLOK'; did you mean 'BLOCK'?")
        self.refuse(part + self.assembly(one, ("B-2", "BLOCK", "")), "'B-1' and 'B-2' of the part 'BLOCK' stand in the same place")
        self.refuse(part + self.assembly(one, ("b-1", "BLOCK", "1.,0.,0.\n")), "second instance 'b-1'")
        self.refuse(part + self.assembly(("B-1", "BLOCK", "1., 0., 0.\n0., 0., 0., 0., 0., 0., 30.\n")), "axis of rotation are the same")
        self.refuse(part + self.assembly(("B-1", "BLOCK", "1., 0., 0.\n0., 0., 0., 1., 0.\n1.\n")), "found 3 lines")
        self.refuse(part + self.assembly(("B-1", "BLOCK", "1., 0., 0., 4.\n")), "expected 3 numbers at most, found 4")
        self.refuse(part + self.assembly(("B-1", "BLOCK", "1., up, 0.\n")), "expected a number, found 'up'")
        self.refuse(part + self.assembly(one, extra="*NSET, NSET=N, INSTANCE=B-2\n1\n"), "no instance 'B-2'; did you mean 'B-1'?")
        self.refuse(part + self.assembly(one, extra="*NSET, NSET=N\nB-2.1\n"), "no instance 'B-2'")
        self.refuse(part + self.assembly(one).replace("*END ASSEMBLY\n", ""), "*ASSEMBLY has no *END ASSEMBLY")
        self.refuse(part + part, "second part 'BLOCK'")
        self.refuse(part + self.part("OTHER"), "several parts (BLOCK, OTHER) and no *INSTANCE")
        self.refuse(part + self.assembly(one).replace("PART=BLOCK", "INSTANCE=B-1, LIBRARY=old"), "results of another analysis")
        self.refuse(part.replace("\n1, 1,", "\n1, 99999,", 1) + self.assembly(one, ("B-2", "BLOCK", "1., 0., 0.\n")), "of instance 'B-1'")
        self.refuse("*END PART\n" + part, "*END PART without *PART")

    def test_a_part_without_an_instance_is_told(self):
        self.read(self.part() + self.part("SPARE") + self.assembly(("B-1", "BLOCK", "")))
        self.assertIn("the part 'SPARE' stands in no instance and is left out", self.mesh.notes)


if __name__ == "__main__":
    unittest.main()
