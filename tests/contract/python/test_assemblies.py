"""Tests that models that are assembled by calls equal those of files."""

import os
import tempfile
import unittest

import bielle
import numpy as np


def pendulum():
    model = bielle.Model("pendulum", gravity=[0, 0, -9.81])
    model.parameter("length", 0.5)
    model.node("bob", position=["length", 0, 0])
    model.rigid_body("bob", node="bob", mass=2, inertia=[0.01, 0.1, 0.1])
    model.hinge("pivot", nodes=["ground", "bob"], position=[0, 0, 0], axis=[0, 1, 0])
    return model


class Assemblies(unittest.TestCase):
    def test_a_model_is_the_same_as_its_file(self):
        model = pendulum()
        model.dynamic(duration=0.1, step=0.01)
        run = model.run()
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "pendulum.yaml")
            with open(path, "w", encoding="utf-8") as file:
                file.write(model.to_yaml())
            again = bielle.run(path)
        np.testing.assert_array_equal(run["nodes/bob/position"], again["nodes/bob/position"])
        self.assertEqual(model.title, "pendulum")

    def test_parts_are_placed(self):
        model = bielle.Model()
        arm = model.part("arm")
        arm.parameter("length", 1)
        arm.node("tip", position=["length", 0, 0])
        arm.rigid_body("tip", node="tip", mass=1, inertia=[1, 1, 1])
        arm.hinge("joint", nodes=["ground", "tip"], axis=[0, 0, 1])
        model.place("left", "arm")
        model.place("right", "arm", mirror="x", parameters={"length": 2})
        self.assertIn("right.tip", model.nodes)
        self.assertIn("right.joint", model.entries["joints"])

    def test_words_of_python_have_an_underscore(self):
        model = pendulum()
        model.hinge("locked", nodes=["ground", "bob"], axis=[0, 1, 0], if_="0")
        self.assertIn('if: "0"', model.to_yaml())
        self.assertNotIn("locked", model.entries["joints"])

    def test_a_change_makes_a_new_model(self):
        model = pendulum()
        self.assertNotIn("far", model.nodes)
        model.node("far", position=[1, 2, 3])
        model.point_mass("far", node="far", mass=1)
        self.assertIn("far", model.nodes)

    def test_wrong_calls_are_explained(self):
        model = pendulum()
        with self.assertRaisesRegex(bielle.InputError, "two entries 'bob'"):
            model.node("bob")
        with self.assertRaisesRegex(bielle.InputError, "'nods' is not a section.*nodes"):
            model.add("nods", "a", {})
        with self.assertRaises(TypeError):
            model.hinge("no_nodes", axis=[0, 0, 1])
        model.hinge("wrong", nodes=["ground", "bob"], axis=[0, 1, 0], dampng=3)
        with self.assertRaisesRegex(bielle.InputError, "joints.wrong.*dampng.*damping"):
            model.describe()
        read = bielle.read({"nodes": {"a": {}}, "elements": {"a": {"type": "point_mass", "node": "a", "mass": 1}}})
        with self.assertRaisesRegex(bielle.InputError, "was read is not changed"):
            read.node("b")


if __name__ == "__main__":
    unittest.main()
