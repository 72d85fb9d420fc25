"""Tests of tools/bielle-loads on meshes of hexahedra, wedges and mixtures: consistent nodal forces, balance, and decks
that are read back."""

import itertools
import os
import re
import subprocess
import tempfile
import unittest

import numpy as np

from box_mesh import REPOSITORY
from cell_decks import SIDE, SIZE, VOLUME, Box, card
from python_tool import run_python_tool
from quick_tools import WithQuickTools

from bielle_tools.bodies.loads import LoadedBody
from bielle_tools.decks.abaqus_file import read_abaqus
from bielle_tools.mesh import cell_integrals
from bielle_tools.mesh.cells import CELLS
from bielle_tools.results import Results
from shares import share_of_tests as load_tests  # noqa: E402,F401

PROGRAMS = os.environ["BIELLE_PROGRAMS"]
TOOL = os.path.join(REPOSITORY, "tools", "bielle-loads")
# Shares of the nodes in a constant pressure, which are integrals of the shape functions over the face: corners, edges,
# middle.
SHARES = {"triangle": (1 / 3,), "triangle6": (0, 1 / 3), "quad": (1 / 4,), "quad8": (-1 / 12, 1 / 3), "quad9": (1 / 36, 1 / 9, 4 / 9)}
BODY = """
body: bar
geometry: NAME.inp
materials: {steel: {young: 210e9, poisson: 0.3, density: 7800}}
regions: {BODY: steel}
interfaces:
  root: {surface: PRESS, tie: average}
  tip: {surface: END, tie: average}
modes: {count: 4}
recovery: {displacement: all}
"""
MODEL = """
gravity: [0, 0, -9.81]
nodes: {root: {position: [0, 0.1, 0.05]}, tip: {position: [0.6, 0.1, 0.05]}}
elements: {bar: {type: superelement, file: NAME.h5, nodes: {root: root, tip: tip}}}
joints: {pin: {type: hinge, nodes: [ground, root], axis: [0, 0, 1]}}
drives: {motor: {joint: pin, rate: "40*step(t, 0, 0.01)"}}
loads: {push: {node: tip, force: [0, 0, "2000*step(t, 0, 0.01)"]}}
analysis: [{type: dynamic, duration: 0.01, step: 5e-4}]
"""
KINDS = {"hexahedra": ("hexahedron",) * 3, "wedges": ("wedge",) * 3, "mixture": ("hexahedron", "wedge", "hexahedron")}


def shares(kind):
    cell = CELLS[kind]
    counts = (cell.corners, len(cell.edges), 1)
    return np.concatenate([np.full(count, share) for count, share in zip(counts, SHARES[kind])])


class ConsistentForces(unittest.TestCase):
    def test_a_constant_pressure(self):
        """Each node of a parallelogram or a triangle in space has its share; forces and moments are those of the
        pressure."""
        a, b, origin = np.array([0.3, 0.1, -0.2]), np.array([-0.1, 0.4, 0.05]), np.array([1.0, 2.0, 3.0])
        for kind in SHARES:
            x = (CELLS[kind].reference + 1) / 2 if CELLS[kind].shape == "quad" else CELLS[kind].reference
            points = origin + x[:, :1] * a + x[:, 1:] * b
            normal = np.cross(a, b) / (1 if CELLS[kind].shape == "quad" else 2)
            unit = normal / np.linalg.norm(normal)
            found = cell_integrals.surface_integrals(points, {kind: np.arange(len(points))[None]}, lambda at: np.tile(7.0 * unit, (len(at), 1)))
            np.testing.assert_allclose(found, 7 * shares(kind)[:, None] * normal, atol=1e-14, err_msg=kind)
            centre = origin + (a + b) / (2 if CELLS[kind].shape == "quad" else 3)
            np.testing.assert_allclose(np.cross(points, found).sum(axis=0), np.cross(centre, 7 * normal), atol=1e-13, err_msg=kind)


class MeshesOfOtherCells(WithQuickTools):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = folder.name
        for (name, kinds), order in itertools.product(KINDS.items(), (1, 2)):
            cls.prepare(f"{name}{order}", Box(kinds, order))

    @classmethod
    def at(cls, name):
        return os.path.join(cls.folder, name)

    @classmethod
    def prepare(cls, name, box):
        ends = ", ".join(str(k) for k, x in enumerate(box.points, 1) if x[0] == SIZE[0])
        for file, text in ((f"{name}.inp", box.abaqus(box.surface() + f"*NSET, NSET=END\n{ends}\n")), (f"{name}.yaml", BODY.replace("NAME", name)),
                           (f"{name}_model.yaml", MODEL.replace("NAME", name))):
            with open(cls.at(file), "w", encoding="utf-8") as out:
                out.write(text)
        for command in (["bielle-reduce", f"{name}.yaml", "-o", f"{name}.h5"], ["bielle-mechanism", f"{name}_model.yaml", "-o", f"{name}_run.h5"]):
            done = subprocess.run([os.path.join(PROGRAMS, command[0]), *command[1:]], cwd=cls.folder, capture_output=True, text=True, timeout=200,
                                  check=False)
            if done.returncode:
                raise AssertionError(f"{command}: {done.stderr}")

    def each(self):
        for name, order in itertools.product(KINDS, (1, 2)):
            with self.subTest(name, order=order):
                yield f"{name}{order}", LoadedBody(Results(self.at(f"{name}{order}_run.h5")), "bar", {"bar": self.at(f"{name}{order}.h5")})

    def test_masses_and_balance(self):
        for _, loaded in self.each():
            self.assertAlmostEqual(loaded.mesh_mass.sum() / (7800 * VOLUME), 1, delta=1e-12)
            M = np.einsum("pka,pkb->ab", loaded.T, np.stack([loaded.mesh_mass @ loaded.T[:, :, k] for k in range(loaded.T.shape[2])], axis=2))
            np.testing.assert_allclose(M, loaded.M, atol=1e-9 * np.abs(loaded.M).max())
            for row in (5, 20):
                load = loaded.at(row)
                size = np.abs(load.interface).max()
                self.assertLess(np.abs(load.unbalance).max(), 1e-12 * size)
                self.assertLess(load.corrected, 1e-11)

    def test_a_force_on_an_average_tie_is_a_constant_pressure(self):
        """Each node of a rectangle at the end has its share of the force on this rectangle."""
        for name, loaded in self.each():
            surface = loaded.surfaces[0]
            kind = "quad" if name.endswith("1") else "quad8"
            faces = [face for face in loaded.body.surface()[kind] if np.all(loaded.points[face, 0] == 0)]
            self.assertEqual(len(faces), 4)
            wanted = np.zeros(len(loaded.points))
            for face in faces:
                ends = loaded.points[face[:4]]
                wanted[face] += shares(kind) * np.linalg.norm(ends[1] - ends[0]) * np.linalg.norm(ends[2] - ends[1]) / SIDE
            for direction in range(3):
                np.testing.assert_allclose(surface.spread[:, direction, direction], wanted[surface.nodes], atol=1e-12)
            np.testing.assert_allclose(surface.spread.sum(axis=0), np.eye(3, 6), atol=1e-12)

    def test_written_decks_are_read_back(self):
        for name, loaded in self.each():
            done = run_python_tool(TOOL, [f"{name}_run.h5", "bar", "--time", "0.01", "-o", f"{name}_case.inp"], self.folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            raw = read_abaqus(self.at(f"{name}_case.inp"))
            np.testing.assert_allclose(raw.points, loaded.points, atol=1e-12)
            for kind, cells in loaded.body.cells.items():
                if CELLS[kind].dimension == 3:
                    np.testing.assert_array_equal(np.concatenate([block for each, block in raw.cells if each == kind]), cells)
            with open(self.at(f"{name}_case.inp"), encoding="utf-8") as file:
                rows = re.findall(r"^(\d+), ([123]), (\S+)$", file.read().split("*CLOAD")[1], re.MULTILINE)
            forces = np.zeros((len(loaded.points), 3))
            for node, direction, value in rows:
                forces[int(node) - 1, int(direction) - 1] += float(value)
            size = np.abs(forces).sum()
            self.assertLess(np.abs(forces.sum(axis=0)).max(), 1e-11 * size)
            self.assertLess(np.abs(np.cross(raw.points, forces).sum(axis=0)).max(), 1e-11 * size)
            load = loaded.at(20)
            inertia = forces.copy()
            for surface, force in zip(loaded.surfaces, load.interface):
                inertia[surface.nodes] -= surface.spread @ force
            np.testing.assert_allclose(inertia, load.inertia, atol=1e-11 * size)
            total = load.interface[:, :3].sum(axis=0)
            np.testing.assert_allclose(-inertia.sum(axis=0), total, atol=1e-11 * size)

    def test_pyramids_are_refused(self):
        self.prepare("pyramids", Box(("hexahedron", "pyramid", "hexahedron"), 1))
        done = run_python_tool(TOOL, ["pyramids_run.h5", "bar", "--time", "0.01", "-o", "case.inp"], self.folder)
        self.assertEqual(done.returncode, 1)
        self.assertIn("24 pyramids of 5 nodes, which CalculiX does not know", done.stderr)


class TiesOfDecks(WithQuickTools):
    """Tests interfaces with `from`, whose forces are distributed by the tie of the deck."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = folder.name
        cls.box = Box(("hexahedron",) * 3, 1)
        cls.left, cls.right = cls.box.left(), [k for k, x in enumerate(cls.box.points) if x[0] == SIZE[0]]
        cls.box.points = [1000 * x for x in cls.box.points]
        weights = [1.0 + 0.5 * (i % 3) for i in range(len(cls.right))]
        rbe3 = card("free", "RBE3", 7, "", 9002, 123456, *(word for w, k in zip(weights, cls.right) for word in (repr(w), "123", k + 1)))
        cls.write("bar.bdf", cls.box.nastran("MAT1,1,2.1+11,,.3,7800.\nGRID,9001,,0.,100.,50.\nGRID,9002,,650.,120.,50.\n"
                                             + card("free", "RBE2", 6, 9001, 123456, *(k + 1 for k in cls.left)) + rbe3, form="large"))
        cls.write("bar.yaml", cls.body())
        cls.write("bar_model.yaml", MODEL.replace("NAME", "bar").replace("0.6, 0.1", "0.65, 0.12"))
        cls.run_program("bielle-reduce", "bar.yaml", "-o", "bar.h5")
        cls.run_program("bielle-mechanism", "bar_model.yaml", "-o", "bar_run.h5")

    @staticmethod
    def body(more=""):
        return (BODY.replace("NAME.inp", "bar.bdf\nlength_unit: mm").replace("BODY", "property_1").replace("{surface: PRESS, tie: average}", "{from: RBE2 6}")
                .replace("{surface: END, tie: average}", "{from: rbe3  7}") + more)

    @classmethod
    def write(cls, name, text):
        with open(os.path.join(cls.folder, name), "w", encoding="utf-8") as file:
            file.write(text)

    @classmethod
    def run_program(cls, program, *arguments):
        done = subprocess.run([os.path.join(PROGRAMS, program), *arguments], cwd=cls.folder, capture_output=True, text=True, timeout=200, check=False)
        if done.returncode:
            raise AssertionError(f"{program}: {done.stderr}")

    def loaded(self, name="bar"):
        return LoadedBody(Results(os.path.join(self.folder, f"{name}_run.h5")), "bar", {"bar": os.path.join(self.folder, f"{name}.h5")})

    def test_the_forces_are_those_of_the_constraint_of_the_superelement(self):
        loaded = self.loaded()
        rigid, average = loaded.surfaces
        self.assertTrue(rigid.rigid)
        self.assertEqual(len(rigid.nodes), len(self.left))
        places = {tuple(np.round(1000 * loaded.points[k], 6)) for k in average.nodes}
        self.assertEqual(places, {tuple(np.round(self.box.points[k], 6)) for k in self.right})
        # By C u = q, the transpose of the distribution gives the motion of the interface for each shape, which is zero
        # for a mode.
        motion = np.einsum("akf,akn->fn", average.spread, loaded.T[average.nodes])
        expected = np.zeros_like(motion)
        expected[:, 6:12] = np.eye(6)
        np.testing.assert_allclose(motion, expected, atol=1e-10 * np.abs(loaded.T).max())
        load = loaded.at(20)
        self.assertLess(np.abs(load.unbalance).max(), 1e-12 * np.abs(load.interface).max())

    def test_a_deck_that_has_changed_is_told(self):
        loads = lambda: run_python_tool(TOOL, ["bar_run.h5", "bar", "--time", "0.01"], self.folder)  # noqa: E731
        self.assertEqual(loads().returncode, 0)
        with open(os.path.join(self.folder, "bar.bdf"), encoding="utf-8") as file:
            text = file.read()
        self.addCleanup(self.write, "bar.bdf", text)
        self.write("bar.bdf", text.replace("RBE3,7,", "RBE3,8,"))
        self.assertIn("has no tie 'rbe3  7' any more, which the interface 'tip'", loads().stderr)
        os.remove(os.path.join(self.folder, "bar.bdf"))
        self.assertIn("which has its nodes and weights and is not there", loads().stderr)

    def test_added_masses_are_refused(self):
        self.write("heavy.yaml", self.body("masses: {pump: {at: [0.3, 0.1, 0.05], mass: 2}}\n"))
        self.write("heavy_model.yaml", MODEL.replace("NAME", "heavy").replace("0.6, 0.1", "0.65, 0.12"))
        self.run_program("bielle-reduce", "heavy.yaml", "-o", "heavy.h5")
        self.run_program("bielle-mechanism", "heavy_model.yaml", "-o", "heavy_run.h5")
        done = run_python_tool(TOOL, ["heavy_run.h5", "bar", "--time", "0.01"], self.folder)
        self.assertIn("carries 2 kg of added `masses`", done.stderr)


if __name__ == "__main__":
    unittest.main()
