"""Tests of models from files, texts and dictionaries; wrong ones are refused with the messages of the program."""

import ast
import os
import pathlib
import subprocess
import unittest

import numpy as np

import bielle
from samples import BEAM, PENDULUM, WHEEL, WithModel

PROGRAM = os.path.join(os.environ["BIELLE_PROGRAMS"], "bielle-mechanism")
# Two parts are fixed to the ground, and the bar between them is longer than their distance.
OPEN = """\
nodes: {a: {position: [1, 0, 0]}, b: {position: [2, 0, 0]}}
elements:
  a: {type: point_mass, node: a, mass: 1}
  b: {type: point_mass, node: b, mass: 1}
joints:
  one: {type: rigid, nodes: [ground, a]}
  two: {type: rigid, nodes: [ground, b]}
  bar: {type: distance, nodes: [a, b], length: 3}
analysis: [{type: assembly}]
"""
# Nothing holds the wheel, so that a static analysis finds no equilibrium under a torque.
SINGULAR = """\
nodes: {wheel: {}}
elements: {wheel: {type: rigid_body, node: wheel, mass: 1, inertia: [1, 1, 2]}}
joints: {axle: {type: hinge, nodes: [ground, wheel], axis: [0, 0, 1]}}
loads: {turn: {node: wheel, moment: [0, 0, 1]}}
analysis: [{type: static}]
"""


class Models(WithModel):
    def expect_same_refusal(self, kind, status, path):
        """Python raises the message that the program prints."""
        done = subprocess.run([PROGRAM, path, "-o", os.path.join(self.folder, "out.h5"), "--quiet"], text=True,
                              capture_output=True, stdin=subprocess.DEVNULL)
        self.assertEqual(done.returncode, status, done.stderr)
        with self.assertRaises(kind) as caught:
            bielle.run(path)
        self.assertEqual("bielle-mechanism: error: " + str(caught.exception), done.stderr.splitlines()[-1])
        self.assertIsInstance(caught.exception, bielle.Error)
        return str(caught.exception)

    def test_a_wrong_key(self):
        sentence = self.expect_same_refusal(bielle.InputError, 1, self.write_model(PENDULUM.replace("damping:", "dampng:")))
        self.assertIn("did you mean 'damping'?", sentence)
        self.assertIn("model.yaml:11: joints.shoulder:", sentence)

    def test_messages_are_explained(self):
        message = "t = 0.1 s: the equations are singular at rz of node 'wheel': it has no mass"
        self.assertTrue(bielle.explain(message).startswith("singular-equations\n"))
        self.assertRegex(bielle.explain("all"), r"(?m)^singular-equations  ")
        with self.assertRaisesRegex(bielle.InputError, "did you mean 'singular-equations'"):
            bielle.explain("singular-equatons")
        with self.assertRaises(TypeError):
            bielle.explain(7)
        self.assertRegex(bielle.__commit__, r"^([0-9a-f]{12}(-modified)?|unknown)$")

    def test_a_missing_file(self):
        self.expect_same_refusal(bielle.InputError, 1, os.path.join(self.folder, "nowhere.yaml"))

    def test_a_model_that_cannot_be_assembled(self):
        self.expect_same_refusal(bielle.ComputationError, 2, self.write_model(OPEN))

    def test_a_singular_model(self):
        self.assertIn("wheel", self.expect_same_refusal(bielle.ComputationError, 2, self.write_model(SINGULAR)))

    def test_no_analysis(self):
        with self.assertRaisesRegex(bielle.InputError, "nothing to do"):
            bielle.read(WHEEL).run()

    def refusal(self, call, kind=bielle.InputError):
        with self.assertRaises(kind) as caught:
            call()
        return str(caught.exception)

    def test_dictionaries_are_refused_with_a_path(self):
        def refused(keys):
            return self.refusal(lambda: bielle.read(keys, name="crank"))

        self.assertEqual(refused({"nodes": {"pin": {"positon": [0, 0, 0]}}}),
                         "crank: nodes.pin: 'positon' is not a key of a node; did you mean 'position'?")
        self.assertEqual(refused({"nodes": {"pin": {"position": [0, np.nan, 0]}}}),
                         "crank: nodes.pin.position[2]: expected a finite number, found '.nan'")
        self.assertEqual(refused({"nodes": {"pin": {"position": [0, -np.inf, 0]}}}),
                         "crank: nodes.pin.position[2]: expected a finite number, found '-.inf'")
        self.assertEqual(refused({"nodes": {"pin": {"position": [0, {1, 2}, 0]}}}),
                         "crank: nodes.pin.position[2]: expected a number, a text, a list or keys with values, found a set")
        self.assertEqual(refused({"nodes": {1: {}}}), "crank: nodes: a key must be a text, found an int")
        self.assertEqual(refused([1]), "crank: expected keys with values, found a list")
        self.assertEqual(refused({}), "crank: the mechanism has no elements, joints or loads")

    def test_texts_are_refused_with_a_line(self):
        self.assertEqual(self.refusal(lambda: bielle.read("nodes:\n  pin: {positon: [0, 0, 0]}\n")),
                         "model:2: nodes.pin: 'positon' is not a key of a node; did you mean 'position'?")
        self.assertIn("no valid YAML", self.refusal(lambda: bielle.read("nodes: [")))

    def test_files_and_texts_are_told_apart(self):
        self.assertEqual(self.refusal(lambda: bielle.read("engine.yaml")),
                         "model: 'engine.yaml' is the name of a file, which bielle.load reads")
        self.assertIn("bielle.load reads", self.refusal(lambda: bielle.read(pathlib.Path("engine"))))
        self.assertIn("bielle.read reads texts", self.refusal(lambda: bielle.run(PENDULUM)))
        path = self.write_model(PENDULUM)
        self.assertEqual(bielle.load(pathlib.Path(path)).path, path)

    def test_words_of_yaml_in_dictionaries_stay_texts(self):
        def titled(title):
            return bielle.read({"mechanism": title, "elements": {"m": {"type": "point_mass", "node": "p", "mass": 1}},
                                "nodes": {"p": {}}}).title

        for title in ("null", "~", "yes", "1e3", "a: b", "# no comment", "- x", "", " two  spaces ", "'quoted'", '"', "\\",
                      "line\nbreak", "\ttab", "Zähler", "漢字", "🙂", "{a: b}", "&anchor", "*alias", "!tag", "%x", "@", "`"):
            self.assertEqual(titled(title), title)

    def test_parameters(self):
        path = self.write_model(PENDULUM)
        self.assertEqual(bielle.load(path).parameters, {"mass": 2, "length": 1})
        self.assertEqual(bielle.load(path, parameters={"mass": 1 / 3}).parameters["mass"], 1 / 3)
        self.assertEqual(bielle.load(path, parameters={"length": "2*mass"}).parameters["length"], 4)
        self.assertEqual(bielle.read(PENDULUM, {"mass": np.float64(3)}).parameters["mass"], 3)
        self.assertEqual(self.refusal(lambda: bielle.read(PENDULUM, {"mas": 3})),
                         "parameters: mas=3.0: model has no parameter 'mas'; did you mean 'mass'?")
        self.assertIn("parameters: mass=2*: ", self.refusal(lambda: bielle.read(PENDULUM, {"mass": "2*"})))
        self.assertIn("model has been read", self.refusal(lambda: bielle.run(bielle.load(path), parameters={"mass": 1})))

    def test_what_a_model_tells(self):
        model = bielle.read(PENDULUM)
        self.assertEqual(model.title, "a double pendulum")
        self.assertEqual(model.nodes, ["ground", "upper", "lower"])
        self.assertEqual(model.entries["joints"], ["shoulder", "elbow"])
        self.assertEqual(model.entries["measures"], ["reach"])
        self.assertEqual((model.analyses, model.inputs, model.path), (["dynamic"], [], ""))
        self.assertIn("2 degrees of freedom", model.describe())
        self.assertEqual(bielle.read(WHEEL).inputs, ["torque"])

    def test_describe_is_what_check_prints(self):
        path = self.write_model(BEAM)
        done = subprocess.run([PROGRAM, path, "--check"], text=True, capture_output=True, check=True)
        self.assertEqual(bielle.load(path).describe(), done.stdout)

    def test_warnings(self):
        warnings = bielle.read({"gravity": [0, 0, -9810], "nodes": {"p": {}},
                              "elements": {"m": {"type": "point_mass", "node": "p", "mass": 1}}}).warnings
        self.assertEqual(len(warnings), 1)
        self.assertTrue(warnings[0].startswith("model: gravity: "), warnings[0])

    def test_files_are_relative_to_the_folder(self):
        self.write_model("0 0\n1 1\n", "way.csv")
        keys = {"nodes": {"p": {"motion": {"x": "table('way.csv', t)"}}},
                "elements": {"m": {"type": "point_mass", "node": "p", "mass": 1}}}
        bielle.read(keys, folder=self.folder)
        self.assertIn("way.csv", self.refusal(lambda: bielle.read(keys)))

    def test_a_run_replaces_results_only(self):
        path = self.write_model(PENDULUM)
        sentence = self.refusal(lambda: bielle.run(path, path))
        self.assertIn("no results file", sentence)
        session = bielle.load(path).session()
        with self.assertRaisesRegex(bielle.InputError, "no results file"):
            with session.record(path):
                pass

    def test_the_stub_is_that_of_the_compiled_part(self):
        with open(os.path.join(os.path.dirname(bielle.__file__), "_core.pyi"), encoding="utf-8") as file:
            stub = ast.parse(file.read())
        described = {}
        for item in stub.body:
            if isinstance(item, ast.ClassDef):
                described[item.name] = {part.name for part in item.body if isinstance(part, ast.FunctionDef)}
                described[item.name].update(part.target.id for part in item.body if isinstance(part, ast.AnnAssign))
            elif isinstance(item, (ast.FunctionDef, ast.AnnAssign)):
                described[item.name if isinstance(item, ast.FunctionDef) else item.target.id] = None
        core = bielle.models._core
        self.assertEqual(set(described), {name for name in vars(core) if not name.startswith("__")})
        for name, members in described.items():
            if members:
                there = {part for part in vars(getattr(core, name)) if not part.startswith("__")}
                self.assertEqual({part for part in members if not part.startswith("__")}, there, name)

    def test_everything_has_a_docstring(self):
        for name in bielle.__all__:
            thing = getattr(bielle, name)
            if name.startswith("__"):
                continue
            self.assertTrue(thing.__doc__, name)
            for part, member in vars(thing).items() if isinstance(thing, type) else ():
                if not part.startswith("_") and (callable(member) or isinstance(member, property)):
                    self.assertTrue(member.__doc__, f"{name}.{part}")


if __name__ == "__main__":
    unittest.main()
