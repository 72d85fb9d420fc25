"""Tests of bielle-reduce with solid cells of every type: meshes of one bar give the same body."""

import os
import subprocess
import sys
import unittest

import h5py
import numpy as np

from command import PROGRAMS, CommandTest
from quick_tools import WithQuickTools

REPOSITORY = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", "..", ".."))
sys.path.insert(0, os.path.join(REPOSITORY, "tests", "contract", "tools"))
import cell_decks  # noqa: E402
from shares import share_of_tests as load_tests  # noqa: E402,F401

TOOLS, MECHANISM = os.path.join(REPOSITORY, "tools"), os.path.join(PROGRAMS, "bielle-mechanism")
KINDS = {kind: (kind,) * 12 for kind in cell_decks.TYPES} | {"mixture": ("hexahedron", "wedge", "pyramid") * 3 + ("wedge", "pyramid", "end")}
BODY = """\
body: bar
geometry: {name}.msh
materials: {{steel: {{young: 210e9, poisson: 0.3, density: 7850}}}}
regions: {{all: steel}}
interfaces:
  left: {{surface: {{plane: {{point: [0, 0, 0], normal: [1, 0, 0]}}}}, tie: average}}
  right: {{surface: {{plane: {{point: [0.6, 0, 0], normal: [1, 0, 0]}}}}, tie: average}}
modes: {{count: 4}}
loads: {{snow: {{surface: {{plane: {{point: [0, 0, 0.1], normal: [0, 0, 1]}}}}, pressure: 1e5}}}}
recovery: {{displacement: {kept}, stress: {kept}}}
"""
MODEL = """\
nodes: {tip: {position: [0.6, 0.1, 0.05]}}
elements: {bar: {type: superelement, file: NAME.h5, nodes: {right: tip}}}
joints: {clamp: {type: rigid, nodes: [ground, bar.left]}}
loads: {pull: {node: tip, force: [1e6, 0, 0]}}
analysis: [{type: static}]
output: {fields: {bar: [von_mises]}}
"""


class Cells(WithQuickTools, CommandTest):
    program = "bielle-reduce"

    def mesh(self, name, kinds, order):
        box = cell_decks.Box(kinds, order)
        self.write(name + ".inp", box.abaqus())
        done = self.run_tool("convert_mesh.py", name + ".inp", name + ".msh")
        self.assertEqual(done.returncode, 0, done.stderr)

    def write(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)

    def run_tool(self, tool, *arguments):
        return self.run_other(os.path.join(TOOLS, tool), *arguments)

    def run_other(self, path, *arguments):
        return subprocess.run([path, *arguments], cwd=self.folder, capture_output=True, text=True, timeout=300)

    def reduced(self, name, kept="all"):
        self.write(name + ".yaml", BODY.format(name=name, kept=kept))
        done = self.run_program(name + ".yaml", "-o", name + ".h5", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        return h5py.File(self.path(name + ".h5"))

    def test_every_type_makes_the_same_body(self):
        """The reduction checks itself. Types of order 2 agree on the first bending frequency, and hex8 nearly does."""
        within = {"tetra1": 0.5, "wedge1": 0.05, "pyramid1": 0.2, "hexahedron1": 0.02, "mixture1": 0.2}
        first = {}
        for kind, cells in KINDS.items():
            for order in (1, 2):
                name = f"{kind}{order}"
                self.mesh(name, cells, order)
                with self.reduced(name) as file:
                    self.assertAlmostEqual(float(file["mass_properties/mass"][()]) / (7850 * cell_decks.VOLUME), 1, delta=1e-12)
                    first[name] = float(file["adequacy/free_frequencies"][0])
                    locks = name in ("tetra1", "wedge1", "pyramid1", "mixture1")
                    self.assertEqual(float(file["adequacy/element_order"][()]), 1 if locks else 2)
        for name, frequency in first.items():
            with self.subTest(name):
                self.assertAlmostEqual(frequency / first["hexahedron2"], 1, delta=within.get(name, 0.002))
                self.assertGreater(frequency, 0.999 * first["hexahedron2"])

    def test_stress_of_a_pulled_bar(self):
        for kind, cells in KINDS.items():
            name = kind + "2"
            with self.subTest(name):
                self.mesh(name, cells, 2)
                self.reduced(name).close()
                self.write("model.yaml", MODEL.replace("NAME", name))
                done = self.run_other(MECHANISM, "model.yaml", "-o", "run.h5", "--quiet")
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertEqual(self.run_tool("bielle-paraview", "run.h5", "-o", "figures").returncode, 0)
                with h5py.File(self.path("run.h5")) as file:
                    stress = np.array(file["analysis_1/elements/bar/von_mises"])[-1]
                # The stress away from the ends is force over area.
                self.assertAlmostEqual(np.median(stress) / (1e6 / cell_decks.SIDE), 1, delta=0.02)

    def test_a_file_that_keeps_the_skin_alone_is_drawn(self):
        self.mesh("wedge2", ("wedge",) * 6, 2)
        with self.reduced("wedge2", kept="surface") as file:
            self.assertEqual(set(file["mesh/cells"]), {"9", "16"})  # triangles and quadrilaterals
        self.write("model.yaml", MODEL.replace("NAME", "wedge2"))
        self.assertEqual(self.run_other(MECHANISM, "model.yaml", "-o", "run.h5", "--quiet").returncode, 0)
        done = self.run_tool("bielle-paraview", "run.h5", "-o", "figures")
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_pieces(self):
        for kind in ("hexahedron", "mixture"):
            name = kind + "2"
            with self.subTest(name):
                self.mesh(name, KINDS[kind], 2)
                self.write("cut.yaml", BODY.format(name=name, kept="all").replace("loads:", "# loads:") +
                           "pieces: {planes: {point: [0.3, 0, 0], normal: [1, 0, 0]}}\n")
                done = self.run_program("cut.yaml", "-o", "cut.h5", "--quiet")
                self.assertEqual(done.returncode, 0, done.stderr)
                with h5py.File(self.path("cut.h5")) as file:
                    self.assertEqual(len(file["pieces"]), 2)

    def test_cells_that_do_not_fit_are_refused_with_the_place(self):
        self.mesh("mixed", ("hexahedron", "tetra"), 1)
        self.write("mixed.yaml", BODY.format(name="mixed", kept="all"))
        self.expect_refusal(1, "mixed.yaml", "-o", "mixed.h5",
                            says=("mixed.yaml:2: geometry", "4 quadrilateral faces of solid cells stand against two triangles", "(0.3, "))

    def test_reduced_integration_is_judged(self):
        """A bar one cell thick is singular; a thicker one has hourglass modes among its higher modes."""
        for across, says in ((1, "singular at the point"), (3, "is an hourglass mode")):
            box = cell_decks.Box(("hexahedron",) * (6 if across == 1 else 3), 2, across)
            self.write("bar.inp", box.abaqus())
            for integration, wanted in (("standard", False), ("reduced", True)):
                with self.subTest(across=across, integration=integration):
                    text = BODY.format(name="bar", kept="all").replace("bar.msh", "bar.inp").replace("count: 4", "count: 60")
                    text = text.split("  right:")[0] + "modes:" + text.split("modes:")[1]
                    self.write("bar.yaml", f"integration: {integration}\n" + text)
                    done = self.run_program("bar.yaml", "-o", "bar.h5")
                    self.assertEqual(done.returncode, 2 if wanted and across == 1 else 0)
                    self.assertEqual(says in done.stderr, wanted)
                    self.assertEqual("integration: reduced' out" in done.stderr, wanted)

    def test_warnings_of_pieces_have_their_names(self):
        """Tests hourglass modes of a bar in two pieces, the second of which is held by the cut alone."""
        self.write("bar.inp", cell_decks.Box(("hexahedron",) * 3, 2, 3).abaqus())
        text = BODY.format(name="bar", kept="all").replace("bar.msh", "bar.inp").replace("count: 4", "count: 60")
        text = text.split("  right:")[0] + "modes:" + text.split("modes:")[1].split("loads:")[0]
        self.write("bar.yaml", "integration: reduced\n" + text + "pieces: {planes: {axis: x, at: 0.2}, compare: false}\n")
        done = self.run_program("bar.yaml", "-o", "bar.h5")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stderr, r"warning: bar.yaml:1: bar\.2: integration: fixed-boundary mode [0-9]+ at .* is an hourglass mode")

    def test_plain_integration_locks(self):
        """hex8 without internal modes is far too stiff in bending, like C3D8 of other programs."""
        self.mesh("bar", ("hexahedron",) * 12, 1)
        first = {}
        for integration in ("standard", "plain"):
            text = BODY.format(name="bar", kept="all")
            self.write("bar.yaml", f"integration: {integration}\n" + text)
            done = self.run_program("bar.yaml", "-o", "bar.h5", "--quiet")
            self.assertEqual(done.returncode, 0, done.stderr)
            with h5py.File(self.path("bar.h5")) as file:
                first[integration] = float(file["adequacy/free_frequencies"][0])
                self.assertEqual(float(file["adequacy/element_order"][()]), 1 if integration == "plain" else 2)
        self.assertGreater(first["plain"], 1.05 * first["standard"])
        self.mesh("tets", ("tetra",) * 3, 2)
        for integration in ("plain", "reduced"):
            self.write("tets.yaml", f"integration: {integration}\n" + BODY.format(name="tets", kept="all"))
            self.expect_refusal(1, "tets.yaml", "-o", "tets.h5", says=("tets.yaml:1: integration", f"'{integration}'", "the mesh has none"))

    def test_cells_that_stand_twice_are_named_by_the_numbers_of_the_deck(self):
        """The duplicate cells have the nodes of the first ones, or separate nodes; the advice to merge nodes would be
        wrong then."""
        text = cell_decks.Box(("hexahedron",) * 3, 1).abaqus()
        head, rows = text.split("*ELEMENT, TYPE=C3D8, ELSET=BODY\n")
        count = len(rows.strip().split("\n"))

        def again(raised):
            return "*ELEMENT, TYPE=C3D8\n" + "".join(f"{900 + k}, " + ", ".join(str(int(word) + raised) for word in row.split(",")[1:] if word.strip()) + "\n"
                                                     for k, row in enumerate(rows.strip().split("\n"), 1))

        nodes = [line for line in head.split("\n") if line and line[0].isdigit()]
        moved = "*NODE\n" + "".join(f"{int(line.split(',')[0]) + 1000},{line.split(',', 1)[1]}\n" for line in nodes)
        self.write("bar.yaml", BODY.format(name="bar", kept="all").replace("bar.msh", "bar.inp"))
        for extra, says in ((again(0), f"{count} of {2 * count} elements have the same corners as another one (the first: elements 1 and 901 at "),
                            (moved + again(1000), f"{count} of {2 * count} elements lie on another one with nodes of their own (the first: elements 1 and 901 ")):
            self.write("bar.inp", text.rstrip("\n") + "\n" + extra)
            self.expect_refusal(1, "bar.yaml", "-o", "bar.h5", says=("bar.yaml:2: geometry: ", says))

    def test_wedges_of_first_order_get_a_warning(self):
        self.mesh("wedge1", ("wedge",) * 3, 1)
        self.write("wedge1.yaml", BODY.format(name="wedge1", kept="all"))
        done = self.run_program("wedge1.yaml", "-o", "wedge1.h5")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("warning: wedge1.yaml:2: geometry: 24 of 24 elements are wedge6, which are far too stiff in bending: use wedge15", done.stderr)

    def test_inverted_cells_are_named(self):
        box = cell_decks.Box(("hexahedron",) * 2, 1)
        middle = next(k for k, x in enumerate(box.points) if np.allclose(x, [0.3, 0, 0.05]))
        box.points[middle] = np.array([0.95, 0, 0.05])
        self.write("bad.msh", gmsh_text(box))
        self.write("bad.yaml", BODY.format(name="bad", kept="all"))
        self.expect_refusal(1, "bad.yaml", "-o", "bad.h5", says=("inverted",))


def gmsh_text(box):
    """A file of gmsh's format 2.2 with hexahedra of order 1."""
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$Nodes", str(len(box.points))]
    lines += [f"{k} {x[0]} {x[1]} {x[2]}" for k, x in enumerate(box.points, 1)]
    lines += ["$EndNodes", "$Elements", str(len(box.shapes))]
    lines += [f"{k} 5 2 1 1 " + " ".join(str(n + 1) for n in corners) for k, (_, corners) in enumerate(box.shapes, 1)]
    return "\n".join(lines + ["$EndElements", ""])


if __name__ == "__main__":
    unittest.main()
