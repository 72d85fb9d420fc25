"""Tests of units of sets of matrices, and of the command bielle-exchange: formats, options, messages."""

import dataclasses
import os
import unittest

import numpy as np

from box_mesh import REPOSITORY, InFolder
from exchange_samples import MATRICES, assert_same, beam, shuffled, turned, with_modes
from python_tool import run_python_tool
from bielle_tools.exchange import matrix_file
from bielle_tools.exchange.matrix_set import MassProperties
from bielle_tools.exchange.units import ALIASES, SI, converted, declared_units, read_units
from bielle_tools.messages import InputError
from shares import share_of_tests as load_tests  # noqa: E402,F401

TOOL = os.path.join(REPOSITORY, "tools", "bielle-exchange")
# Young's modulus, density, length and width of a steel beam in several systems of units.
LBF = 4.4482216152605
BEAMS = {"m-kg-s": (210e9, 7800.0, 0.5, 0.02), "mm-t-s": (210e3, 7.8e-9, 500.0, 20.0), "mm-kg-ms": (210.0, 7.8e-6, 500.0, 20.0),
         "cm-g-s": (210e10, 7.8, 50.0, 2.0),
         "in-slinch-s": (210e9 * 0.0254**2 / LBF, 7800 * 0.0254**4 / LBF, 0.5 / 0.0254, 0.02 / 0.0254)}


class Conversion(unittest.TestCase):
    def test_a_beam_is_the_same_in_all_systems(self):
        for turn in (None, turned()):
            expected = beam(*BEAMS["m-kg-s"], turn)
            for name, numbers in BEAMS.items():
                with self.subTest(name, turned=turn is not None):
                    found = converted(beam(*numbers, turn), read_units(name, "--units"))
                    time = 1e-3 if name.endswith("ms") else 1.0  # damping is 1e-3 stiffness times the unit of time
                    found.damping = found.damping / time
                    assert_same(self, found, expected, 1e-13)
                    self.assertEqual((found.length_unit, found.mass_unit), ("m", "kg"))
                    if turn is None:  # compares entries of displacements and of rotations
                        for matrix in MATRICES:
                            np.testing.assert_allclose(getattr(found, matrix).toarray(), getattr(expected, matrix).toarray(), rtol=1e-13)

    def test_rigid_motion_stays_without_energy(self):
        motion = np.zeros((12, 3))
        motion[[1, 7], 0] = motion[[5, 11], 1] = 1
        motion[7, 1] = 0.5  # about z
        body = beam(*BEAMS["m-kg-s"])
        self.assertLessEqual(abs(body.stiffness @ motion).max(), 1e-12 * abs(body.stiffness).max())
        found = converted(beam(*BEAMS["mm-t-s"]), read_units("mm-t-s", "--units"))
        self.assertLessEqual(abs(found.stiffness @ motion).max(), 1e-12 * abs(found.stiffness).max())

    def test_shapes_inertia_and_mass_properties(self):
        body = with_modes(beam(*BEAMS["m-kg-s"]))
        n = body.size
        components = np.random.default_rng(1).standard_normal((6, n, n))
        body = dataclasses.replace(body, inertia_components=components,
                                   mass_properties=MassProperties(1.56, np.array([0.25, 0, 0]), np.diag([1e-4, 0.03, 0.03])))
        body.shapes.masses, body.shapes.inertias = np.array([1.0, 2, 3]), np.ones((3, 3, 3))
        there = converted(body, SI, read_units("mm-t-s", "--to-units"))
        random = np.random.default_rng(2)
        u = random.standard_normal(n)
        scale = np.where(body.unknown_nodes < 0, 1.0, np.where(body.unknown_components < 3, 1e3, 1.0))
        v = scale * u  # the same motion in mm
        for tell, here, other in (("energy [N mm]", 1e3 * (u @ body.stiffness @ u), v @ there.stiffness @ v),
                                  ("kinetic energy [N mm]", 1e3 * (u @ body.mass @ u), v @ there.mass @ v),
                                  ("power [N mm/s]", 1e3 * (u @ body.damping @ u), v @ there.damping @ v)):
            self.assertAlmostEqual(other / here, 1, delta=1e-12, msg=tell)
        np.testing.assert_allclose(there.shapes.displacement @ v, 1e3 * (body.shapes.displacement @ u), rtol=1e-12)
        np.testing.assert_allclose(there.shapes.rotation @ v, body.shapes.rotation @ u, rtol=1e-12)
        np.testing.assert_allclose(there.inertia_components @ v @ v, 1e3 * (components @ u @ u), rtol=1e-12)  # t mm^2 and kg m^2
        np.testing.assert_allclose(there.shapes.points, 1e3 * body.shapes.points)
        np.testing.assert_allclose(there.shapes.masses, 1e-3 * body.shapes.masses)
        np.testing.assert_allclose(there.shapes.inertias, 1e3 * body.shapes.inertias)
        properties = there.mass_properties
        self.assertAlmostEqual(properties.mass, 1.56e-3)
        np.testing.assert_allclose(properties.centre, [250, 0, 0])
        np.testing.assert_allclose(np.diag(properties.inertia), [0.1, 30, 30])
        back = converted(there, read_units("mm-t-s", "--units"))
        assert_same(self, back, body, 1e-13)
        np.testing.assert_allclose(back.inertia_components, components, rtol=1e-13)

    def test_words(self):
        for text, told in (("mm", "units of length, mass and time are expected, such as mm-t-s"), ("mm-N-s", "this system is --units mm-t-s"),
                           ("SI", "this system is --units m-kg-s"), ("ips", "in-slinch-s"), ("mm-kgg-s", "'kgg' is no unit of mass; did you mean 'kg'?"),
                           ("mmm-t-s", "'mmm' is no unit of length; did you mean 'mm'?"), ("mm-t-h", "'h' is no unit of time"),
                           ("mm-N-ms", "a unit of force is not given, it follows from the others")):
            with self.assertRaisesRegex(InputError, "--units " + text):
                read_units(text, "--units")
            with self.assertRaises(InputError) as caught:
                read_units(text, "--units")
            self.assertIn(told, str(caught.exception))
        for alias, meant in ALIASES.items():
            self.assertEqual(str(read_units(meant, "--units")), meant, alias)

    def test_declared(self):
        body = beam(*BEAMS["mm-t-s"])
        self.assertEqual(declared_units(body, None), SI)
        body.length_unit, body.mass_unit = "mm", "t"
        self.assertEqual(str(declared_units(body, None)), "mm-t-s")
        self.assertEqual(str(declared_units(body, read_units("mm-t-ms", "--units"))), "mm-t-ms")
        with self.assertRaisesRegex(InputError, "--units m-t-s: the file declares the unit of length mm"):
            declared_units(body, read_units("m-t-s", "--units"))


class Command(InFolder):
    def setUp(self):
        super().setUp()
        self.body = with_modes(beam(*BEAMS["m-kg-s"], turned()))
        matrix_file.write(self.body, self.path("body.h5"))

    def run_tool(self, *arguments, status=0):
        done = run_python_tool(TOOL, list(arguments), self.folder)
        self.assertEqual(done.returncode, status, done.stderr)
        self.assertNotIn("unforeseen", done.stderr)
        return done

    def refuse(self, told, *arguments):
        errors = self.run_tool(*arguments, status=1).stderr
        self.assertEqual(errors.count("\n"), 1, errors)
        self.assertIn(told, errors)

    def test_there_and_back(self):
        for ending, format_, digits in (("pch", "dmig", 1e-11), ("op4", "op4", 0), ("op4", "op4-text", 0)):
            with self.subTest(format_):
                done = self.run_tool("body.h5", f"there.{ending}", "--to", format_, "--to-units", "mm-t-s")
                self.assertIn("15 unknowns, 2 nodes, 3 scalars, in mm-t-s, out of test", done.stdout)
                done = self.run_tool(f"there.{ending}", "back.h5", "--to", "matrices", "--units", "mm-t-s", "--name", "arm")
                self.assertIn("back.h5: 15 unknowns, 2 nodes, 3 scalars, in m-kg-s, out of Nastran", done.stdout)
                back = matrix_file.read(self.path("back.h5"))
                self.assertEqual((back.name, back.length_unit, back.mass_unit), ("arm", "m", "kg"))
                self.assertEqual(list(back.interfaces), ["node_7", "node_12"])
                assert_same(self, back, self.body, max(digits, 1e-13))

    def test_notes(self):
        self.assertNotIn("the shapes", self.run_tool("body.h5", "there.op4").stderr)  # MUG1 holds them
        errors = self.run_tool("there.op4", "back.h5", "--to", "matrices").stderr
        self.assertIn("there-nodes.bdf", errors)

    def test_the_matrix_file_itself(self):
        matrix_file.write(shuffled(self.body), self.path("other.h5"))
        self.run_tool("other.h5", "same.h5", "--to", "matrices")
        assert_same(self, matrix_file.read(self.path("same.h5")), self.body, 0)

    def test_losses_are_told(self):
        body = beam(*BEAMS["m-kg-s"])
        body = dataclasses.replace(body, inertia_components=np.zeros((6, body.size, body.size)), interfaces={"left end": 0},
                                   geometric_stiffness=body.stiffness)
        matrix_file.write(body, os.path.join(self.folder, "full.h5"))
        for ending, losses in ((".fmx", ("damping", "geometric stiffness", "inertia components", "names")),
                               (".mtx", ("geometric stiffness", "inertia components", "names")), (".npz", ("geometric stiffness",)),
                               (".pch", ("inertia components", "names"))):
            with self.subTest(ending):
                said = self.run_tool("full.h5", "out" + ending).stderr
                self.assertEqual(said.count("left out"), len(losses), said)
                for loss in losses:
                    self.assertRegex(said, f"left out: the {loss}|left out: the names of")

    def test_a_superelement(self):
        """The test replaces the program by one that writes its arguments and copies its matrices."""
        stand_in = self.write("bielle-reduce", '#!/bin/sh\necho "$1 $3 $4"; cp "$2" "$4" && exit ${BIELLE_TEST_STATUS:-0}\n')
        os.chmod(stand_in, 0o755)
        environment = {**os.environ, "BIELLE_BIN": self.folder}
        done = run_python_tool(TOOL, ["body.h5", "new.h5", "--name", "arm"], self.folder, environment)
        self.assertEqual((done.returncode, done.stdout), (0, "--from -o new.h5\n"), done.stderr)
        found = matrix_file.read(self.path("new.h5"))
        self.assertEqual((found.name, found.length_unit), ("arm", None))
        assert_same(self, found, self.body, 0)
        done = run_python_tool(TOOL, ["body.h5", "new.h5"], self.folder, {**environment, "BIELLE_TEST_STATUS": "1"})
        self.assertEqual(done.returncode, 1)
        self.assertIn("bielle-reduce made no superelement of the matrices (exit status 1); --to matrices writes them without it", done.stderr)

    def test_sentences(self):
        self.write("empty.pch", "")
        self.write("empty.npz", "")
        self.write("damaged.h5", "no HDF5")
        for told, arguments in (
                ("'none.pch' does not exist", ("none.pch", "a.h5")),
                ("'body.h5' is the file that is read", ("body.h5", "body.h5", "--to", "matrices")),
                ("'a.xyz': no format of matrices is known by this ending; known ones: ", ("body.h5", "a.xyz")),
                ("there is no format 'opt4'; did you mean 'op4'?", ("body.h5", "a.op4", "--to", "opt4")),
                ("there is no format 'dmigg'; did you mean 'dmig'?", ("body.h5", "a.op4", "--from", "dmigg")),
                ("'--unit-to' is not an option; did you mean '--units'?", ("body.h5", "a.op4", "--unit-to", "m")),
                ("--names 'stifness=K': there is no member 'stifness'; did you mean 'stiffness'?", ("empty.pch", "a.op4", "--names", "stifness=K")),
                ("--names 'K': MEMBER=NAME is expected", ("empty.pch", "a.op4", "--names", "K")),
                ("--nodes: the format 'matrices' does not use it (it takes none)", ("body.h5", "a.op4", "--nodes", "empty.pch")),
                ("--unknowns: the format 'dmig' does not use it (it takes --nodes and --mass and --names and --quantities)",
                 ("empty.pch", "a.op4", "--unknowns", "empty.pch")),
                ("--interfaces '3,x': numbers of nodes are expected, such as 12,40, found 'x'",
                 ("empty.npz", "a.op4", "--from", "exudyn", "--interfaces", "3,x")),
                ("the format 'matrices' is in SI units", ("body.h5", "a.h5", "--to", "matrices", "--to-units", "mm-t-s")),
                ("--units mm-t-s: the file declares", ("units.h5", "a.op4", "--units", "mm-t-s")),
                ("'none.bdf' does not exist", ("body.h5", "a.op4", "--nodes", "none.bdf")),
                ("'empty.pch': the deck holds no DMIG", ("empty.pch", "a.op4")),
                ("'damaged.h5' does not hold a superelement of one piece", ("damaged.h5", "a.op4"))):
            with self.subTest(told):
                self.body.length_unit = "m"
                matrix_file.write(self.body, self.path("units.h5"))
                self.refuse(told, *arguments)

    def test_damaged_matrix_file(self):
        with open(self.path("body.h5"), "rb") as file:
            content = file.read()
        random = np.random.default_rng(3)
        for case in range(20):
            damaged = bytearray(content)
            if case % 2:
                del damaged[random.integers(1, len(content)):]
            for place in random.integers(0, len(damaged), 4):
                damaged[place] = random.integers(0, 256)
            with open(self.path("damaged.h5"), "wb") as file:
                file.write(damaged)
            done = run_python_tool(TOOL, ["damaged.h5", "a.op4", "--from", "matrices"], self.folder)
            self.assertIn(done.returncode, (0, 1), done.stderr)
            self.assertNotIn("unforeseen", done.stderr)
            self.assertTrue(done.returncode == 0 or done.stderr.count("\n") == 1, done.stderr)


if __name__ == "__main__":
    unittest.main()
