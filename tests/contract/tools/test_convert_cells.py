"""Tests convert_mesh.py with all solid cells of Nastran's and Abaqus' decks. gmsh reads the results: its reference
cells give the order of the nodes, and its integrals the volumes."""

import itertools
import os
import unittest

import meshio  # noqa: F401  (loaded once for all runs of the tool)
import numpy as np

from box_mesh import REPOSITORY, InFolder
from cell_decks import ABAQUS, SIDE, SIZE, TYPES, VOLUME, Box, card
from gmsh_library import GmshFile
from python_tool import run_python_tool
from shares import share_of_tests as load_tests  # noqa: E402,F401

CONVERT = os.path.join(REPOSITORY, "tools", "convert_mesh.py")
CORNERS = {"triangle": 3, "quad": 4, "tetra": 4, "hexahedron": 8, "wedge": 6, "pyramid": 5}
SHAPES = ("tetra", "hexahedron", "wedge", "pyramid")
MIXTURE = ("hexahedron", "wedge", "end")


def corners_of(kind):
    return CORNERS[kind.rstrip("0123456789")]


def area(points, faces):
    total = 0.0
    for kind, nodes in faces.items():
        for three in ((0, 1, 2), (0, 2, 3))[:corners_of(kind) - 2]:
            a, b, c = (points[nodes[:, k]] for k in three)
            total += 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()
    return total


def of_pyramids(mesh, kind):
    """Returns the volumes of pyramids with plane faces, since gmsh's rule of integration gives 4/3 of them."""
    a, b, c, d, top = (mesh.points[mesh.cells[kind][:, k]] for k in range(5))
    return np.einsum("ij,ij->i", np.cross(c - a, d - b), top - a) / 6


def cell_set(mesh):
    """Returns the cells as places, independently of numbers and of the first corner."""
    return sorted((kind, tuple(sorted(map(tuple, mesh.points[row].round(5).tolist())))) for kind, cells in mesh.cells.items() for row in cells)


class CellConverter(InFolder):
    def run_tool(self, name):
        return run_python_tool(CONVERT, [self.path(name), self.path("out.msh")], timeout=120)

    def convert(self, name, text, tolerance=1e-9, volume=VOLUME):
        self.write(name, text)
        done = self.run_tool(name)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.notes = done.stderr
        mesh = GmshFile(self.path("out.msh"))
        self.check(mesh, tolerance, volume)
        return mesh

    def check(self, mesh, tolerance, volume):
        """Asserts the volume, and that each node after the corners is the middle of the corners that gmsh defines."""
        volumes = {**mesh.volumes, **{kind: of_pyramids(mesh, kind) for kind in mesh.volumes if kind.startswith("pyramid")}}
        self.assertAlmostEqual(sum(v.sum() for v in volumes.values()) / volume, 1, delta=1e-5 if tolerance > 1e-8 else 1e-9)
        self.assertGreater(mesh.least_determinant, 0)
        for kind, cells in mesh.cells.items():
            place, count = mesh.reference[kind], corners_of(kind)
            for node in range(count, cells.shape[1]):
                parts = [part for size in (2, 4, 8) for part in itertools.combinations(range(count), size)
                         if np.allclose(place[list(part)].mean(axis=0), place[node])]
                middle = mesh.points[cells[:, list(parts[0])]].mean(axis=1)
                np.testing.assert_allclose(mesh.points[cells[:, node]], middle, atol=tolerance, err_msg=f"{kind} {node}")

    def refuse(self, name, text, *parts):
        self.write(name, text)
        if os.path.exists(self.path("out.msh")):
            os.remove(self.path("out.msh"))
        done = self.run_tool(name)
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)
        for part in parts:
            self.assertIn(part, done.stderr)
        self.assertFalse(os.path.exists(self.path("out.msh")))


class EachType(CellConverter):
    def test_abaqus_with_surfaces_and_node_sets(self):
        for shape, order in itertools.product(SHAPES, (1, 2)):
            box = Box((shape,) * 3, order)
            text = box.abaqus(box.surface())
            mesh = self.convert("box.inp", text + "*NSET, NSET=LEFT\n" + ",\n".join(str(n + 1) for n in box.left()) + "\n")
            self.assertEqual(sum(len(cells) for kind, cells in mesh.groups[3, "BODY"].items()), len(box.shapes))
            for name in ("PRESS", "LEFT"):
                self.assertAlmostEqual(area(mesh.points, mesh.groups[2, name]) / SIDE, 1, delta=1e-9)
                flat = {kind for kind in mesh.groups[2, name]}
                self.assertEqual(flat, {("triangle" if shape == "tetra" else "quad") + ("", "6" if shape == "tetra" else "8")[order - 1]})
            self.assertNotIn("warning", self.notes)

    def test_corners_alone_name_a_face_of_second_order(self):
        box = Box(order=2)
        corners = {node for _, nodes in box.shapes for node in nodes}
        text = box.abaqus()
        mesh = self.convert("box.inp", text + "*NSET, NSET=LEFT\n" + ",\n".join(str(n + 1) for n in box.left() if n in corners) + "\n")
        self.assertAlmostEqual(area(mesh.points, mesh.groups[2, "LEFT"]) / SIDE, 1, delta=1e-9)

    def test_nastran_in_all_fields_with_rigid_elements(self):
        for shape, order, form in itertools.product(SHAPES, (1, 2), ("small", "large", "free")):
            box = Box((shape,) * 3, order)
            box.rows(ABAQUS)
            left = [n + 1 for n in box.left()]
            rbe2 = card("free", "GRID", 90001, "", "0.0", "0.1", "0.05") + card("free", "RBE2", 77, 90001, 123456, *left)
            mesh = self.convert("box.bdf", box.nastran(rbe2, form), 2e-6)
            self.assertAlmostEqual(area(mesh.points, mesh.groups[2, "rbe2_77"]) / SIDE, 1, delta=1e-4)
            self.assertEqual(sum(len(cells) for cells in mesh.groups[3, "property_1"].values()), len(box.shapes))

    def test_faces_of_groups_point_outwards(self):
        for shape in SHAPES:
            box = Box((shape,) * 3)
            mesh = self.convert("box.inp", box.abaqus(box.surface()))
            for cells in mesh.groups[2, "PRESS"].values():
                a, b, c = (mesh.points[cells[:, k]] for k in range(3))
                self.assertTrue((np.cross(b - a, c - a)[:, 0] < 0).all(), shape)

    def test_every_side_of_abaqus(self):
        """Each side of all cells has the place that the manual defines for its number."""
        from cell_decks import SIDES as sides
        for shape in SHAPES:
            box = Box((shape,) * 3)
            text = "".join(f"*SURFACE, NAME=SIDE{k}\nBODY, S{k}\n" for k in range(1, len(sides[shape].split()) + 1))
            mesh = self.convert("box.inp", box.abaqus(text))
            for k, side in enumerate(sides[shape].split(), 1):
                expected = {tuple(np.mean([box.points[corners[int(c) - 1]] for c in side], axis=0).round(9)) for _, corners in box.shapes}
                found = {tuple(mesh.points[row].mean(axis=0).round(9)) for cells in mesh.groups[2, f"SIDE{k}"].values() for row in cells}
                self.assertEqual(found, expected, (shape, k))
            self.refuse("box.inp", box.abaqus("*SURFACE, NAME=S\n1, S7\n"), "side 'S7'", f"S{len(sides[shape].split())}")

    def test_hexahedra_of_27_nodes_of_abaqus_and_in_other_orders(self):
        box = Box(order=2)
        edges = ABAQUS["hexahedron"]
        faces = ["1234", "5876", "1562", "2673", "3784", "4851"]
        gmsh = "12 14 15 23 26 34 37 48 56 58 67 78", ["1234", "1256", "1458", "2367", "3478", "5678"]
        for order in ([*edges.split(), "12345678", *faces], [*gmsh[0].split(), *gmsh[1], "12345678"]):
            rows = [f"{number}, " + ", ".join(str(n + 1) for n in corners + [box.add([corners[int(k) - 1] for k in each]) for each in order])
                    for number, (_, corners) in enumerate(box.shapes, 1)]
            text = box.nodes_of_abaqus() + "*ELEMENT, TYPE=C3D27, ELSET=BODY\n" + "\n".join(rows) + "\n"
            mesh = self.convert("box.inp", text + box.surface())
            self.assertEqual(set(mesh.cells), {"hexahedron27", "quad9"})
            self.assertAlmostEqual(area(mesh.points, mesh.groups[2, "PRESS"]) / SIDE, 1, delta=1e-9)
        self.assertIn("gmsh's order", self.notes)

    def test_formulations_are_told(self):
        box = Box(order=1)
        self.convert("box.inp", box.abaqus(types={"hexahedron": "C3D8R"}))
        self.assertIn("replaced by Bielle's own: 12 C3D8R", self.notes)
        self.convert("box.inp", box.abaqus())
        self.assertNotIn("replaced", self.notes)
        for shape, order, letters in (("hexahedron", 1, ("I", "H", "RH", "IH")), ("hexahedron", 2, ("R", "H", "RH")), ("tetra", 1, ("H",)),
                                      ("tetra", 2, ("M", "H", "HS", "I", "MH")), ("wedge", 1, ("H",)), ("wedge", 2, ("H",)), ("pyramid", 1, ("H",))):
            base = TYPES[shape][order - 1]
            text = Box((shape,) * 3, order).abaqus().split("*ELEMENT")
            rows = Box((shape,) * 3, order).abaqus().split(f"TYPE={base}, ELSET=BODY\n")[1].replace(",\n", ", ").strip().split("\n")
            labels = [base + letters[k % len(letters)] for k in range(len(rows))]
            self.convert("box.inp", text[0] + "".join(f"*ELEMENT, TYPE={label}\n{row}\n" for label, row in zip(labels, rows)))
            for label in set(labels):
                self.assertIn(f"{labels.count(label)} {label}", self.notes)
        self.refuse("box.inp", box.abaqus(types={"hexahedron": "COH3D8"}), "12 COH3D8 (the first at ", "box.inp:40)")

    def test_types_that_are_not_read_are_counted(self):
        """The message tells the place of the first one: for several blocks, in included elements and in continued
        lines."""
        box = Box(order=1)
        strange = "*ELEMENT, TYPE=U12\n201, 1, 2,\n3, 4\n202, 1, 2,\n3, 5\n*ELEMENT, TYPE=COH3D8\n301, 1, 2, 3, 4, 5, 6, 7, 8\n*ELEMENT, TYPE=u12\n203, 1,\n2, 3, 4\n"
        text = box.abaqus(strange)
        line = text.split("\n").index("*ELEMENT, TYPE=U12") + 1
        self.refuse("box.inp", text, f"3 U12 (the first at {self.path('box.inp')}:{line}), 1 COH3D8 (at {self.path('box.inp')}:{line + 5})")
        self.refuse("box.inp", box.abaqus("*ELEMENT, ELSET=X\n201, 1, 2\n"), "*ELEMENT: no type (TYPE=...)")
        self.convert("box.inp", box.abaqus("*ELEMENT, TYPE=MASS, ELSET=M\n201, 1\n202, 2\n*ELEMENT, TYPE=SPRINGA, ELSET=S\n203, 1, 2\n"))
        self.assertIn(f"left out: elements that have neither volume nor surface: 2 MASS (the first at {self.path('box.inp')}:", self.notes)
        self.assertIn(", 1 SPRINGA (at ", self.notes)
        nastran = box.nastran(form="free")
        self.refuse("box.bdf", nastran.replace("ENDDATA", "") + "CIHEX1,901,1,1,2,3,4,5,6\n,7,8\nCIHEX1,902,1,1,2,3,4,5,6\n,7,8\n",
                    "solid cells of types that Bielle does not read: 2 CIHEX1 (the first at line ")
        self.convert("box.bdf", nastran.replace("ENDDATA", "") + "CWEIRD,901,1,1,2\nCWEIRD,902,1,1,2\nCBAR,903,1,1,2\n", 1e-8)
        lines = len(nastran.replace("ENDDATA", "").split("\n"))
        self.assertIn(f"not read: 2 CWEIRD (the first at line {lines})", self.notes)
        self.assertIn(f"left out: 1 CBAR (903), the first at line {lines + 2}, which", self.notes)

    def test_sets_without_cells_and_long_names(self):
        box = Box(across=1)
        self.convert("box.inp", box.abaqus("*ELSET, ELSET=EMPTY\n*ELEMENT, TYPE=MASS, ELSET=M\n201, 1\n"))
        for name in ("EMPTY", "M"):
            self.assertIn(f"the set '{name}' holds no solid or surface cells and is left out", self.notes)
        mesh = self.convert("box.inp", box.abaqus().replace("BODY", "N" * 250))
        self.assertIn((3, "N" * 250), mesh.groups)
        self.refuse("box.inp", box.abaqus().replace("BODY", "N" * 251), "has 251 bytes: at most 250")
        self.refuse("box.inp", box.abaqus().replace("BODY", "\u00e4" * 126), "has 252 bytes: at most 250")

    def test_flat_cells_are_named(self):
        box = Box(across=1)
        box.points = [x * [1, 1, 0] for x in box.points]
        self.refuse("box.inp", box.abaqus(), "holds 3 hexahedra of no volume (the first: element 1, near ")

    def test_thin_cells_are_measured_by_themselves(self):
        # The first two cells of this wire of 100 m are 0.1 mm long. Their volume is 2.5e-17 of the cube of the length,
        # but they are far from flat.
        box, thick = Box(across=1), 5e-4
        ends = [0, 1e-4, 2e-4, 100]
        box.points = [np.array([ends[round(3 * x / SIZE[0])], thick * y / SIZE[1], thick * z / SIZE[2]]) for x, y, z in box.points]
        self.convert("box.inp", box.abaqus(), volume=100 * thick**2)

    def test_arcs_that_bulge_beyond_the_wall_keep_their_nodes(self):
        """The wall of this ring of C3D20 is thinner than the height of its arcs, so that the middle of an arc is closer
        to the chord of the other face than to its own."""
        around, radius, wall, height = 24, 1.0, 0.01, 0.1
        numbers, points = {}, []

        def node(i, j, k):
            key = (i % (2 * around), j, k)
            if key not in numbers:
                angle, r = np.pi * key[0] / around, radius + wall * j / 2
                points.append((r * np.cos(angle), r * np.sin(angle), height * k / 2))
                numbers[key] = len(points)
            return numbers[key]

        text = ""
        for cell in range(around):
            level = [[(0, 0, k), (0, 2, k), (2, 2, k), (2, 0, k)] for k in (0, 2)]
            edges = [[(0, 1, k), (1, 2, k), (2, 1, k), (1, 0, k)] for k in (0, 2)]
            places = [*level[0], *level[1], *edges[0], *edges[1], (0, 0, 1), (0, 2, 1), (2, 2, 1), (2, 0, 1)]
            nodes = [str(node(2 * cell + i, j, k)) for i, j, k in places]
            text += f"{cell + 1}, {', '.join(nodes[:10])},\n{', '.join(nodes[10:])}\n"
        head = "*NODE\n" + "".join(f"{n + 1}, {x:.17g}, {y:.17g}, {z:.17g}\n" for n, (x, y, z) in enumerate(points))
        self.write("ring.inp", f"{head}*ELEMENT, TYPE=C3D20, ELSET=BODY\n{text}")
        done = self.run_tool("ring.inp")
        self.assertEqual(done.returncode, 0, done.stderr)
        mesh = GmshFile(self.path("out.msh"))
        # Parabolas through three points of a circle have an error of the area of about (pi/n)^4/20.
        exact = np.pi * ((radius + wall)**2 - radius**2) * height
        self.assertAlmostEqual(sum(v.sum() for v in mesh.volumes.values()) / exact, 1, delta=1e-4)
        self.assertEqual(sum(len(nodes) for nodes in mesh.cells.values()), around)
        self.assertIn("mid-side nodes of 24 hexahedra lie nearer to another edge than to their own", done.stderr)

    def test_cells_keep_their_numbers(self):
        """bielle-reduce names cells by the numbers of the deck, which are gmsh's element numbers."""
        for numbers in ([7, 3, 2**31 - 2], [11, 11 + 10**6, 12]):
            box = Box(across=1)
            rows = box.abaqus().split("ELSET=BODY\n")
            lines = rows[1].split("\n")
            for k, number in enumerate(numbers):
                lines[k] = f"{number}," + lines[k].split(",", 1)[1]
            self.write("box.inp", rows[0] + "ELSET=BODY\n" + "\n".join(lines))
            done = self.run_tool("box.inp")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(GmshFile(self.path("out.msh")).numbers["hexahedron"].tolist()[:3], numbers)

    def test_left_handed_cells_are_turned_over(self):
        mirrored = {"hexahedron": [0, 3, 2, 1, 4, 7, 6, 5], "wedge": [0, 2, 1, 3, 5, 4], "pyramid": [0, 3, 2, 1, 4], "tetra": [0, 2, 1, 3]}
        for shape, order in itertools.product(SHAPES, (1, 2)):
            box = Box((shape,) * 3, order)
            box.shapes = [(shape, [corners[k] for k in mirrored[shape]] if number % 3 == 0 else corners)
                          for number, (_, corners) in enumerate(box.shapes)]
            self.convert("box.inp", box.abaqus())
            self.assertIn("left-handed", self.notes)

    def test_a_cell_turned_at_a_corner_is_told(self):
        box = Box(across=1)
        box.points[1] = box.points[1] + [0.15, 0.18, 0.08]
        self.write("box.inp", box.abaqus())
        self.assertIn("turned inside out at a corner (the first: element ", self.run_tool("box.inp").stderr)

    def test_wrong_order_of_middle_nodes(self):
        text = Box(order=2).abaqus()
        lines = text.split("\n")
        for k, line in enumerate(lines):
            if line.startswith("*ELEMENT"):
                break
        for row in range(k + 1, len(lines) - 1, 2):
            words = lines[row].rstrip(",").split(",")
            words[9], words[10], words[12] = words[12], words[9], words[10]
            lines[row] = ",".join(words) + ","
        self.refuse("box.inp", "\n".join(lines), "mid-side nodes of 12 of 12 hexahedra", "element 1")


class Mixtures(CellConverter):
    def test_both_decks_of_a_mixture_give_equal_meshes(self):
        for order in (1, 2):
            box = Box(MIXTURE, order)
            one = self.convert("box.inp", box.abaqus())
            for word in ("mixture", "4 hexahedra", "8 wedges", "20 pyramids", "8 tetrahedra"):
                self.assertIn(word, self.notes)
            two = self.convert("box.bdf", box.nastran(form="free"), 1e-8)
            self.assertEqual(cell_set(one), cell_set(two))

    def test_each_type_is_the_same_in_both_decks(self):
        for shape, order in itertools.product(SHAPES, (1, 2)):
            box = Box((shape,), order)
            self.assertEqual(cell_set(self.convert("box.inp", box.abaqus())), cell_set(self.convert("box.bdf", box.nastran(form="large"), 1e-8)))


class Degenerate(CellConverter):
    """The hexahedra have repeated corners as in the manuals of the programs."""

    def collapsed(self, shape, order):
        as_hexahedron = {"wedge": [0, 1, 2, 2, 3, 4, 5, 5], "pyramid": [0, 1, 2, 3, 4, 4, 4, 4], "tetra": [0, 1, 2, 2, 3, 3, 3, 3]}[shape]
        box = Box((shape,) * 3, order)
        box.shapes = [("hexahedron", [corners[k] for k in as_hexahedron]) for _, corners in box.shapes]
        return box

    def test_hexahedra_that_are_other_cells(self):
        for shape, order in itertools.product(("wedge", "pyramid", "tetra"), (1, 2)):
            whole = cell_set(self.convert("box.inp", Box((shape,) * 3, order).abaqus()))
            for name, text in (("box.inp", self.collapsed(shape, order).abaqus()), ("box.bdf", self.collapsed(shape, order).nastran(form="free"))):
                mesh = self.convert(name, text, 1e-8)
                self.assertEqual(cell_set(mesh), whole)
                self.assertIn(f"{len(Box((shape,) * 3).shapes)} hexahedra of {(8, 20)[order - 1]} nodes with repeated nodes are", self.notes)
                group = mesh.groups[3, "BODY" if name.endswith("inp") else "property_1"]
                self.assertEqual(sum(len(cells) for cells in group.values()), len(whole))

    def test_other_collapsed_edges(self):
        """Every set of edges is collapsed: the remaining cell has the volume of the original, or the cell is
        refused."""
        edges = [[int(c) - 1 for c in edge] for edge in ABAQUS["hexahedron"].split()]
        seen = set()
        for some in itertools.chain(*(itertools.combinations(edges, count) for count in (1, 2, 3, 4))):
            corners = list(range(8))
            for a, b in some:
                corners = [corners[a] if c == corners[b] else c for c in corners]
            seen.add(tuple(corners))
        kinds = {}
        import sys
        sys.path.insert(0, os.path.join(REPOSITORY, "tools"))
        from bielle_tools.mesh.cells import CELLS, six_volumes
        from bielle_tools.mesh.repeated_nodes import without_repeated
        points = CELLS["hexahedron"].reference + 0.1 * np.random.default_rng(2).random((8, 3))
        for corners in sorted(seen):
            found = without_repeated("hexahedron", corners)
            if found:
                kind, nodes = found
                before = six_volumes(points, "hexahedron", np.array([corners]))[0]
                self.assertAlmostEqual(six_volumes(points, kind, np.array([nodes]))[0], before, places=12)
                kinds.setdefault(kind, []).append(corners)
        self.assertEqual({kind: len(found) for kind, found in kinds.items()}.keys(), {"wedge", "pyramid", "tetra"})
        self.assertGreaterEqual(len(kinds["wedge"]), 12)
        self.assertIn((0, 1, 2, 3, 4, 4, 4, 4), kinds["pyramid"])

    def test_surfaces_and_sets_of_collapsed_hexahedra(self):
        box = self.collapsed("wedge", 1)
        text = box.abaqus("*ELSET, ELSET=FIRST\n1\n" + "".join(f"*SURFACE, NAME=SIDE{k}\nBODY, S{k}\n" for k in (1, 3, 5)))
        mesh = self.convert("box.inp", text)
        self.assertEqual({kind: len(cells) for kind, cells in mesh.groups[3, "FIRST"].items()}, {"wedge": 1})
        self.assertEqual(set(mesh.groups[2, "SIDE1"]), {"triangle"})
        self.assertEqual(set(mesh.groups[2, "SIDE3"]), {"quad"})
        self.assertNotIn((2, "SIDE5"), mesh.groups)
        self.assertIn("surface 'SIDE5' holds only faces of repeated nodes", self.notes)

    def test_other_repetitions_are_refused_by_number(self):
        for corners in ([0, 1, 2, 3, 4, 5, 6, 0], [0, 1, 0, 3, 4, 5, 6, 7], [0, 1, 2, 2, 4, 5, 6, 7], [0, 0, 0, 0, 0, 0, 0, 0]):
            box = Box(across=1)
            box.shapes[1] = ("hexahedron", [box.shapes[1][1][k] for k in corners])
            self.refuse("box.inp", box.abaqus(), "element 2, a hexahedron of 8 nodes, repeats nodes")
            self.refuse("box.bdf", box.nastran(), "element 2")
        box = Box(("tetra",))
        box.shapes[4] = ("tetra", [box.shapes[4][1][k] for k in (0, 1, 2, 2)])
        self.refuse("box.inp", box.abaqus(), "element 5", "no volume")


class Shells(CellConverter):
    def skin(self, box, edges):
        left, found = set(box.left()), []
        for shape, corners in box.shapes:
            for side in ("1234", "5876", "1562", "2673", "3784", "4851"):
                nodes = [corners[int(c) - 1] for c in side]
                if set(nodes) <= left:
                    found.append(nodes + [box.add(pair) for pair in zip(nodes, nodes[1:] + nodes[:1])] * (edges > 4))
        return found

    def test_shells_over_hexahedra_are_surfaces(self):
        for order, label, count, flat in ((1, "S4", 4, "quad"), (1, "S4R", 4, "quad"), (2, "S8R", 8, "quad8"), (2, "S4", 4, "quad8")):
            box = Box(order=order)
            rows = "".join(f"{900 + k}, " + ", ".join(str(n + 1) for n in nodes) + "\n" for k, nodes in enumerate(self.skin(box, count)))
            mesh = self.convert("box.inp", box.abaqus(f"*ELEMENT, TYPE={label}, ELSET=SKIN\n{rows}*SURFACE, NAME=TOP\nSKIN, SPOS\n"))
            for name in ("SKIN", "TOP"):
                self.assertEqual({kind: len(cells) for kind, cells in mesh.groups.get((2, name), mesh.groups.get((2, "SKIN"))).items()}, {flat: 4})
            self.assertAlmostEqual(area(mesh.points, mesh.groups[2, "SKIN"]) / SIDE, 1, delta=1e-9)
            self.assertEqual("other mid-side nodes" in self.notes, label == "S4" and order == 2)

    def test_shells_of_nastran(self):
        for order, name, count, flat in ((1, "CQUAD4", 4, "quad"), (2, "CQUAD8", 8, "quad8"), (2, "CQUAD8", 4, "quad8"), (2, "CQUAD4", 4, "quad8")):
            box = Box(order=order)
            extra = "".join(card("free", name, 900 + k, 9, *(n + 1 for n in nodes)) for k, nodes in enumerate(self.skin(box, count)))
            mesh = self.convert("box.bdf", box.nastran(extra, "free"), 1e-8)
            self.assertEqual({kind: len(cells) for kind, cells in mesh.groups[2, "property_9"].items()}, {flat: 4})
            self.assertAlmostEqual(area(mesh.points, mesh.groups[2, "property_9"]) / SIDE, 1, delta=1e-7)

    def test_a_quadrilateral_of_three_corners_is_a_triangle_and_a_loose_one_is_told(self):
        box = Box(("wedge",), across=1)
        a, b, c = (n + 1 for n in box.shapes[0][1][:3])
        mesh = self.convert("box.inp", box.abaqus(f"*ELEMENT, TYPE=S4, ELSET=SKIN\n901, {a}, {b}, {c}, {c}\n"))
        self.assertEqual({kind: len(cells) for kind, cells in mesh.groups[2, "SKIN"].items()}, {"triangle": 1})
        self.convert("box.inp", box.abaqus("*ELEMENT, TYPE=S3, ELSET=SKIN\n901, 1, 4, 6\n"))
        self.assertIn("1 surface cell is no face of a solid cell", self.notes)


class MissingMiddleNodes(CellConverter):
    """Returns CHEXA cells without some mid-side nodes, for a bar of three in a row, and the places of these nodes
    between the grid points."""

    def deck(self, leave_out, order=2):
        box = Box(across=1, order=order)
        text = box.nastran(form="free").split("\n")
        for k, line in enumerate(text):
            if line.startswith("CHEXA"):
                words = ",".join(text[k:k + 3]).replace(",+", "").split(",")
                for field in leave_out.get(int(words[1]), {}):
                    words[field + 2] = leave_out[int(words[1])][field]
                text[k:k + 3] = [",".join(words[:9])] + ["+," + ",".join(words[j:j + 8]) for j in (9, 17)]
        return "\n".join(text)

    def test_nodes_that_all_cells_at_an_edge_leave_out_are_made(self):
        # Edge 41 (G12) and 15 (G13) of the first cell belong to it alone.
        mesh = self.convert("box.bdf", self.deck({1: {12: "", 13: "0"}}), 1e-8)
        self.assertIn("1 cell of order 2 leaves out some mid-side nodes (the first: CHEXA 1): 2 nodes have been made", self.notes)
        self.assertEqual({kind: cells.shape for kind, cells in mesh.cells.items()}, {"hexahedron20": (3, 20)})
        # Edge 23 (G10) of the first cell is 41 (G12) of the second.
        self.convert("box.bdf", self.deck({1: {10: ""}, 2: {12: ""}}), 1e-8)
        self.assertIn("2 cells of order 2 leave out some mid-side nodes (the first: CHEXA 1): 1 node has been made", self.notes)

    def test_neighbours_that_have_the_node_or_are_of_order_1(self):
        self.refuse("box.bdf", self.deck({1: {10: ""}}), "CHEXA 1 has no mid-side node between the grid points 2 and 6", "CHEXA 2", "has one")
        first = "\n".join(self.deck({1: {10: ""}}).split("\n"))
        lines = first.split("\n")
        start = next(k for k, line in enumerate(lines) if line.startswith("CHEXA,2,"))
        lines[start + 1] = "+," + ",".join(lines[start + 1].split(",")[1:3])
        del lines[start + 2]
        self.refuse("box.bdf", "\n".join(lines), "CHEXA 1", "CHEXA 2", "is of order 1")

    def test_cards_without_corners_are_refused_by_line(self):
        self.refuse("box.bdf", self.deck({2: {3: ""}}), "line", "CHEXA 2 has 19 nodes, but Bielle reads those of 8 or 20")
        self.refuse("box.bdf", self.deck({2: {3: "9999"}}), "CHEXA 2 names the grid point 9999")
        self.refuse("box.bdf", self.deck({2: {14: "x"}}), "expected an integer in field 17, found 'X'")
        for name, count, known in (("CPENTA", 5, "6 or 15"), ("CPYRAM", 4, "5 or 13"), ("CQUAD4", 3, "those of 4"), ("CTETRA", 3, "4 or 10")):
            self.refuse("box.bdf", Box().nastran(card("free", name, 7001, 1, *range(1, count + 1))), f"{name} 7001 has {count} nodes", known)


class Sizes(unittest.TestCase):
    def test_the_box_of_the_decks(self):
        self.assertAlmostEqual(np.prod(SIZE), VOLUME)


if __name__ == "__main__":
    unittest.main()
