"""Tests of universal files of hexahedra, wedges, tetrahedra and their mixtures, of both orders, with curved edges and
groups of several types."""

import os
import sys
import unittest

import h5py
import numpy as np

from command import CommandTest

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "tools"))
from cell_decks import SIZE, VOLUME, Box  # noqa: E402
from shares import share_of_tests as load_tests  # noqa: E402,F401

# Corners and middles of edges in the order of I-DEAS: along the edges of the bottom, up, along the edges of the top
# (SDRC I-DEAS, Universal Dataset Number 2412; Element library).
ORDERS = {"tetra": "1 12 2 23 3 31 14 24 34 4", "wedge": "1 12 2 23 3 31 14 25 36 4 45 5 56 6 64",
          "hexahedron": "1 12 2 23 3 34 4 41 15 26 37 48 5 56 6 67 7 78 8 85"}
TYPES = {"tetra": (111, 118), "wedge": (112, 113), "hexahedron": (115, 116), "pyramid": (312, 313)}
BODY = """\
body: box
geometry: box.unv
materials:
  steel: {young: 210e9, poisson: 0.3, density: 7850}
  light: {young: 70e9, poisson: 0.3, density: 1000}
regions: {first: steel, rest: light}
interfaces:
  left: {surface: {plane: {point: [0, 0, 0], normal: [1, 0, 0]}}, tie: average}
modes: {count: 2}
"""


def nodes_of(box, shape, corners):
    if box.order == 1:
        return corners
    return [corners[int(word) - 1] if len(word) == 1 else box.add([corners[int(c) - 1] for c in word]) for word in ORDERS[shape].split()]


def universal(box, bent=0.0, extra=(), physical=1, dataset=2467):
    """physical: the property of all elements. bent: z' = z + bent y (b - y), which curves edges and leaves volumes as they are. extra: lines of elements."""
    rows = [(shape, nodes_of(box, shape, corners)) for shape, corners in box.shapes]
    points = np.array(box.points)
    points[:, 2] += bent * points[:, 1] * (SIZE[1] - points[:, 1])
    lines = ["    -1", "  2411"]
    for k, x in enumerate(points, 1):
        lines += [f"{k:10d}{1:10d}{1:10d}{11:10d}", "".join(f"{value:25.16E}" for value in x)]
    lines += ["    -1", "    -1", "  2412"]
    for k, (shape, nodes) in enumerate(rows, 1):
        lines.append(f"{k:10d}{TYPES[shape][box.order - 1]:10d}{physical:10d}{1:10d}{7:10d}{len(nodes):10d}")
        lines += ["".join(f"{n + 1:10d}" for n in nodes[i:i + 8]) for i in range(0, len(nodes), 8)]
    lines += [*extra, "    -1", "    -1", f"  {dataset}"]
    half = SIZE[0] / 2
    first = [k for k, (_, nodes) in enumerate(rows, 1) if np.mean([box.points[n][0] for n in nodes]) < half]
    for group, (name, members) in enumerate((("first", first), ("rest", sorted(set(range(1, len(rows) + 1)) - set(first)))), 1):
        lines += [f"{group:10d}" + f"{0:10d}" * 6 + f"{len(members):10d}", name]
        entries = [f"{8:10d}{n:10d}{0:10d}{0:10d}" for n in members]
        lines += ["".join(entries[i:i + 2]) for i in range(0, len(entries), 2)]
    return "\n".join([*lines, "    -1", ""])


class UniversalFiles(CommandTest):
    program = "bielle-reduce"

    def reduced(self, text):
        self.write("box.unv", text)
        self.write("body.yaml", BODY)
        self.done = self.run_program("body.yaml")
        self.assertEqual(self.done.returncode, 0, self.done.stderr)
        self.assertNotIn("FAILED", self.done.stdout)
        with h5py.File(self.path("body.h5")) as file:
            return file["mass_properties/mass"][()], file["mass_properties/centre"][()]

    def test_mixtures_of_both_orders(self):
        """The two halves have different materials; each is a group of cells of several types."""
        for order in (1, 2):
            for kinds in (("hexahedron", "wedge") * 2, ("tetra", "tetra")):
                with self.subTest(order=order, kinds=kinds):
                    mass, centre = self.reduced(universal(Box(kinds, order)))
                    self.assertAlmostEqual(mass / (VOLUME / 2 * (7850 + 1000)), 1, delta=1e-9)
                    x = SIZE[0] * (7850 / 4 + 1000 * 3 / 4) / (7850 + 1000)
                    np.testing.assert_allclose(centre, [x, SIZE[1] / 2, SIZE[2] / 2], rtol=1e-9)

    def test_groups_keep_their_members_whatever_their_numbers(self):
        """gmsh divides the mesh by groups into parts, and treats them as members of the property with the same
        number."""
        for physical in (1, 2, 7):
            for dataset in (2467, 2477, 2452, 2435):
                with self.subTest(physical=physical, dataset=dataset):
                    mass, _ = self.reduced(universal(Box(("hexahedron", "wedge"), 1), physical=physical, dataset=dataset))
                    self.assertAlmostEqual(mass / (VOLUME / 2 * (7850 + 1000)), 1, delta=1e-9)

    def test_curved_edges(self):
        """Cells of order 2 represent the quadratic function of y that bends the box; a wrong order of their nodes would
        change the volume and the centre, or invert cells."""
        bent = 3.0
        for kinds in (("hexahedron",) * 2, ("wedge",) * 2, ("tetra",) * 2, ("wedge", "hexahedron") * 2):
            with self.subTest(kinds=kinds):
                mass, centre = self.reduced(universal(Box(kinds, 2), bent))
                self.assertAlmostEqual(mass / (VOLUME / 2 * (7850 + 1000)), 1, delta=1e-9)
                np.testing.assert_allclose(centre[1:], [SIZE[1] / 2, SIZE[2] / 2 + bent * SIZE[1]**2 / 6], rtol=1e-9)

    def test_cells_that_gmsh_drops_are_refused(self):
        element = f"{900:10d}{312:10d}{1:10d}{1:10d}{7:10d}{5:10d}"
        for lines, says in (((element, "".join(f"{n:10d}" for n in range(1, 6))), "solid cells of types that are not read: 1 of type 312 (the first at line LINE); types 111 and 118"),
                            ((element.replace(f"{312:10d}", f"{115:10d}"), "".join(f"{n:10d}" for n in range(1, 6))),
                             "element 900 of type 115 has 5 nodes, expected 8")):
            text = universal(Box(("hexahedron",), 1), extra=lines)
            line = text.splitlines().index(lines[0]) + 1
            self.write("box.unv", text)
            self.write("body.yaml", BODY)
            self.expect_refusal(1, "body.yaml", says=[f"line {line}: {says.replace('LINE', str(line))}"])

    def test_springs_and_masses_are_told(self):
        mass, beam = f"{900:10d}{161:10d}{1:10d}{1:10d}{7:10d}{1:10d}", f"{901:10d}{21:10d}{1:10d}{1:10d}{7:10d}{2:10d}"
        text = universal(Box(("hexahedron", "wedge"), 1), extra=(mass, f"{1:10d}", beam, f"{0:10d}{1:10d}{1:10d}", f"{1:10d}{2:10d}"))
        line = text.splitlines().index(mass) + 1
        self.reduced(text)
        self.assertIn("left out: elements that are neither solid cells nor faces of order 1 or 2: "
                      f"1 of type 21 (the first at line {line + 2}), 1 of type 161 (line {line})", self.done.stderr)

    def test_elements_on_which_gmsh_fails_are_left_out(self):
        """A pipe element would be an error in gmsh, and a face of order 3 would be dropped silently."""
        pipe, cubic = (f"{number:10d}{kind:10d}{1:10d}{1:10d}{7:10d}{nodes:10d}" for number, kind, nodes in ((900, 31, 2), (901, 43, 9)))
        self.reduced(universal(Box(("hexahedron", "wedge"), 1), extra=(pipe, f"{1:10d}{2:10d}", cubic, "".join(f"{n:10d}" for n in range(1, 9)),
                                                                      f"{9:10d}")))
        for said in ("1 of type 31 (the first at line ", "1 of type 43 (line "):
            self.assertIn(said, self.done.stderr)


if __name__ == "__main__":
    unittest.main()
