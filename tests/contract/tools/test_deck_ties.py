"""Tests of surfaces of *TIE: coinciding meshes are joined, others are refused."""

import unittest

from cell_decks import SIZE, VOLUME, Box
from test_deck_assemblies import Decks, volume


def right(box):
    """Returns a *SURFACE of the faces at the end x."""
    other = Box.__new__(Box)
    other.__dict__ = dict(box.__dict__, left=lambda: [k for k, x in enumerate(box.points) if x[0] == SIZE[0]])
    return other.surface("END")


class Ties(Decks):
    def part(self, box, name):
        return f"*PART, NAME={name}\n{box.abaqus(box.surface('START') + right(box))}*END PART\n"

    def chain(self, order=2, second=None, at=SIZE[0], tie="A.END, B.START\n", kind="hexahedron"):
        """Returns two boxes in a row along x, which are tied."""
        one = Box((kind,) * 3, order)
        return (self.part(one, "P") + self.part(second or one, "Q") + "*ASSEMBLY, NAME=A0\n*INSTANCE, NAME=A, PART=P\n*END INSTANCE\n"
                f"*INSTANCE, NAME=B, PART=Q\n{at:.17g}, 0., 0.\n*END INSTANCE\n*TIE, NAME=WELD, ADJUST=YES\n{tie}*END ASSEMBLY\n")

    def test_coinciding_meshes_get_common_nodes(self):
        for order, kind, common in ((1, "hexahedron", 9), (2, "hexahedron", 21), (1, "wedge", 9), (2, "wedge", 21), (2, "tetra", 25)):
            single = Box((kind,) * 3, order)
            single.abaqus()  # creates the mid-side nodes
            double = self.read(self.chain(order, kind=kind))
            self.assertEqual(sum(x[0] == 0 for x in single.points), common)
            self.assertEqual(len(double.points), 2 * len(single.points) - common)
            self.assertAlmostEqual(volume(double) / (2 * VOLUME), 1, delta=1e-12)
            self.assertEqual(set(double.surfaces), {"A.START", "B.END"})  # tied faces are inside
            self.assertIn(f"*TIE, NAME=WELD: {common} nodes of 'A.END' and 'B.START' have become common ones (the largest gap was 0)", double.notes)

    def test_a_joined_chain_equals_a_long_box(self):
        """The cells are those of one instance of six, with other node numbers."""
        def cells(mesh):
            return sorted(tuple(map(tuple, mesh.points[row].round(9))) for row in mesh.cells["hexahedron20"])
        double = self.read(self.chain())
        long = Box(("hexahedron",) * 6, 2)
        long.points = [x * [2, 1, 1] for x in long.points]
        self.assertEqual(cells(double), cells(self.read(long.abaqus())))

    def test_a_ring_of_ties(self):
        """Four boxes meet at an edge: a node of the edge is tied three times, and becomes one node."""
        box = Box(("hexahedron",), 1)
        sides = {"Y0": (1, 0.0), "Y1": (1, SIZE[1]), "Z0": (2, 0.0), "Z1": (2, SIZE[2])}
        part = f"*PART, NAME=P\n{box.abaqus()}"
        for name, (axis, value) in sides.items():
            other = Box.__new__(Box)
            other.__dict__ = dict(box.__dict__, left=lambda axis=axis, value=value: [k for k, x in enumerate(box.points) if x[axis] == value])
            part += other.surface(name)
        places = {"A": (0, 0), "B": (SIZE[1], 0), "C": (SIZE[1], SIZE[2]), "D": (0, SIZE[2])}
        text = part + "*END PART\n*ASSEMBLY, NAME=X\n" + "".join(f"*INSTANCE, NAME={name}, PART=P\n0., {y}, {z}\n*END INSTANCE\n"
                                                             for name, (y, z) in places.items())
        mesh = self.read(text + "*TIE, NAME=T\nA.Y1, B.Y0\nB.Z1, C.Z0\nD.Y1, C.Y0\nA.Z1, D.Z0\n*END ASSEMBLY\n")
        self.assertEqual(len(mesh.points), 2 * 5 * 5)
        self.assertAlmostEqual(volume(mesh) / (4 * VOLUME), 1, delta=1e-12)

    def test_small_gaps_are_closed_and_large_ones_refused(self):
        edge = 0.1 * 0.5  # the shortest edge of the surfaces, along z
        self.read(self.chain(at=SIZE[0] + 9e-4 * edge))
        self.assertIn("largest gap was 4.5e-05", " ".join(self.mesh.notes))
        self.refuse(self.chain(at=SIZE[0] + 2e-3 * edge), "*TIE, NAME=WELD: 21 of 21 nodes of 'A.END' do not coincide", "gap is 0.0001,")
        self.refuse(self.chain(at=0.7), "21 of 21 nodes", "the largest gap is 0.1,")

    def test_other_meshes_are_refused(self):
        self.refuse(self.chain(second=Box(("hexahedron",) * 3, 1)), "12 of 21 nodes of 'A.END' do not coincide with nodes of 'B.START'")
        fine = Box(("hexahedron",) * 3, 1, across=4)
        self.refuse(self.chain(order=1, second=fine), "4 of 4 faces of 'A.END' are no faces of 'B.START'")
        self.refuse(self.chain(order=1, second=fine, tie="B.START, A.END\n"), "16 of 25 nodes of 'B.START' do not coincide with nodes of 'A.END'")
        self.refuse(self.chain(order=1, second=Box(("tetra",) * 3, 1)), "4 of 4 faces of 'A.END' are no faces of 'B.START'")

    def test_wrong_ties_are_told(self):
        self.refuse(self.chain(tie="A.END, B.STRAT\n"), "*TIE, NAME=WELD: there is no surface 'B.STRAT'; did you mean 'B.START'?")
        self.refuse(self.chain(tie="A.END\n"), "expected the names of two surfaces, found 1 name")
        self.refuse(self.chain().replace("ADJUST=YES", "CYCLIC SYMMETRY"), "sectors are not read")


if __name__ == "__main__":
    unittest.main()
