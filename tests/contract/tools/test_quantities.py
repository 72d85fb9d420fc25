"""Compares names and components of quantities with the datasets of files, in both layouts, with names that contain
dots, slashes and commas."""

import contextlib
import io
import os
import subprocess
import unittest

import h5py
import numpy as np

import synthetic_results as synthetic
from box_mesh import InFolder

from bielle_tools.messages import InputError  # box_mesh sets the path
from bielle_tools.quantities.quantities import Quantities, arguments_of, split_names
from bielle_tools.results import Results

PROGRAMS = os.environ["BIELLE_PROGRAMS"]
# The arm is a part, whose names contain a dot. Others contain slashes, commas, spaces and words of components.
MODEL = """\
gravity: [0, 0, -9.81]
nodes:
  a.b: {position: [1, 0, 0]}
  left/arm: {position: [2, 0, 0]}
  "x, y": {position: [3, 0, 0]}
  swing: {position: [0, 1, 0]}
elements:
  a.b: {type: point_mass, node: a.b, mass: 1}
  left/arm: {type: point_mass, node: left/arm, mass: 2}
  "x, y": {type: point_mass, node: "x, y", mass: 3}
  max: {type: rigid_body, node: swing, mass: 1, inertia: [1, 1, 1]}
joints:
  a.b: {type: hinge, nodes: [ground, a.b], position: [0, 0, 0], axis: [0, 1, 0]}
  left/arm: {type: hinge, nodes: [ground, left/arm], position: [0, 0, 0], axis: [0, 1, 0]}
  "x, y": {type: hinge, nodes: [ground, "x, y"], position: [0, 0, 0], axis: [0, 1, 0]}
  swing: {type: cylindrical, nodes: [ground, swing], position: [0, 0, 0], axis: [1, 0, 0]}
measures: {depth: {formula: "-'a.b'.position.z", units: m}}
analysis:
  - {type: dynamic, duration: 0.02, step: 1e-3}
  - {type: dynamic, duration: 0.01, step: 1e-3}
"""


class OfSynthetic(InFolder):
    def setUp(self):
        super().setUp()
        synthetic.write_superelement(self.path("box.h5"))
        self.time = synthetic.write_results(self.path("run.h5"), "box.h5")
        with h5py.File(self.path("run.h5")) as file:
            self.data = {}
            file.visititems(lambda name, found: self.data.update({name: found[()]}) if isinstance(found, h5py.Dataset) else None)

    def read(self, text, **options):
        with Results(self.path("run.h5")) as results:
            return Quantities(results).read(text, **options)

    def expect(self, text, values, unit):
        quantity = self.read(text)
        np.testing.assert_array_equal(quantity.values, np.reshape(values, (len(self.time), -1)), text)
        self.assertEqual(set(quantity.units), {unit}, text)

    def test_names_and_components_are_those_of_the_datasets(self):
        reaction, stress = self.data["joints/main/reaction"], self.data["elements/shaft/von_mises"]
        resultants = self.data["elements/shaft/resultants"]
        for layout in ("named", "stacked"):
            for text, values, unit in (
                    ("joints/main/reaction.x", reaction[:, 0], "N"), ("main.reaction.rz", reaction[:, 5], "N m"), ("main/reaction[2]", reaction[:, 1], "N"),
                    ("main.reaction[rz]", reaction[:, 5], "N m"), ("'main'.reaction.y", reaction[:, 1], "N"),
                    ("main.reaction.norm", np.full(len(self.time), 5.0), "N"), ("main.reaction.force", np.full(len(self.time), 5.0), "N"),
                    ("main.reaction.moment", np.abs(reaction[:, 5]), "N m"), ("main.angle", self.data["joints/main/coordinate"][:, 1], "rad"),
                    ("main.displacement.rate", self.data["joints/main/rate"][:, 0], "m/s"), ("main.coordinate.angle", self.data["joints/main/coordinate"][:, 1], "rad"),
                    ("main.drive_force.angle", self.data["joints/main/drive_force"][:, 1], "N m"), ("kinetic", self.data["energy/kinetic"], "J"),
                    ("time", self.time, "s"), ("shaft.von_mises", stress, "Pa"), ("shaft.von_mises.max", stress.max(axis=(1, 2)), "Pa"),
                    ("shaft.von_mises.min", stress.min(axis=(1, 2)), "Pa"), ("shaft.von_mises[3]", stress[:, 2], "Pa"),
                    ("shaft.von_mises[3,2]", stress[:, 2, 1], "Pa"), ("shaft.von_mises[3][2]", stress[:, 2, 1], "Pa"),
                    ("shaft.resultants.x", resultants[:, :, 0], "N"), ("shaft.resultants[4].x", resultants[:, 3, 0], "N"),
                    ("shaft.resultants.norm.max", resultants[:, :, 0].max(axis=1), "N"), ("shaft.resultants.x[2]", resultants[:, 1, 0], "N"),
                    ("ram.pressure.abs", np.abs(self.data["elements/ram/pressure"]).max(axis=1), "Pa"), ("hub.position.x", self.data["nodes/hub/position"][:, 0], "m")):
                with self.subTest(text=text, layout=layout):
                    self.expect(text, values, unit)
            if layout == "named":
                synthetic.stack(self.path("run.h5"))

    def test_columns_have_names_and_units_of_their_own(self):
        quantity = self.read("main.reaction")
        self.assertEqual(quantity.labels, [f"main.reaction.{name}" for name in ("x", "y", "z", "rx", "ry", "rz")])
        self.assertEqual(quantity.units, ["N"] * 3 + ["N m"] * 3)
        self.assertEqual(self.read("shaft.resultants").labels[6:8], ["shaft.resultants[2].x", "shaft.resultants[2].y"])
        for label in self.read("shaft.resultants").labels + self.read("main.coordinate").labels + self.read("shaft.position").labels:
            self.assertEqual(self.read(label).labels, [label])

    def test_stress_points_of_beams_and_quaternions_have_names(self):
        stress = np.arange(len(self.time) * 4 * 2 * 3).reshape(len(self.time), 4, 2, 3)
        with h5py.File(self.path("run.h5"), "r+") as file:
            synthetic.put(file, "elements/shaft/stress", stress, "Pa")
            synthetic.put(file, "elements/shaft/strain", stress.reshape(len(self.time), 4, 6), "1, 1/m")
            # The description has one word for each of two points.
            file["elements/shaft/von_mises"].attrs["description"] = "sqrt(sigma^2 + 3 tau^2) at the stress points, in the middle"
        self.expect("shaft.stress[3].p2.xz", stress[:, 2, 1, 2], "Pa")
        self.expect("shaft.stress.p1.xy", stress[:, :, 0, 1], "Pa")
        self.expect("shaft.stress[4,2].xx", stress[:, 3, 1, 0], "Pa")
        self.expect("hub.rotation.w", self.data["nodes/hub/rotation"][:, 0], "")
        self.expect("shaft.rotation[2].z", self.data["elements/shaft/rotation"][:, 1, 3], "")
        for name in ("shaft.stress", "shaft.von_mises", "hub.rotation", "shaft.strain"):
            for label in self.read(name).labels:
                self.assertEqual(self.read(label).labels, [label])
        self.assertEqual(self.read("shaft.von_mises").labels[1], "shaft.von_mises[1].p2")
        self.assertEqual(self.read("shaft.stress").labels[5], "shaft.stress[1].p2.xz")
        self.assertEqual(self.read("hub.rotation").labels, [f"hub.rotation.{name}" for name in "wxyz"])
        for text in ("shaft.strain.force", "shaft.strain.moment", "shaft.strain.norm", "shaft.stress.p3", "hub.rotation.norm", "shaft.stress.von_mises"):
            with self.subTest(text=text), self.assertRaises(InputError) as caught:
                self.read(text)
            self.assertIn("has no component", str(caught.exception))

    def test_beams_have_the_names_of_formulas_too(self):
        stress, resultants = np.arange(len(self.time) * 4 * 2 * 3).reshape(len(self.time), 4, 2, 3), self.data["elements/shaft/resultants"]
        with h5py.File(self.path("run.h5"), "r+") as file:
            synthetic.put(file, "elements/shaft/stress", stress, "Pa")
            synthetic.put(file, "elements/pin.a/resultants", resultants[:, :1], "N, N m")
        von_mises = self.data["elements/shaft/von_mises"]
        for text, values, unit in (("shaft.element_3.von_mises.p2", von_mises[:, 2, 1], "Pa"), ("'shaft'.element_3.von_mises.max", von_mises[:, 2].max(axis=1), "Pa"),
                                   ("shaft.element_4.stress.p1.xz", stress[:, 3, 0, 2], "Pa"), ("shaft.element_2.force.y", resultants[:, 1, 1], "N"),
                                   ("shaft.element_2.moment.y", resultants[:, 1, 4], "N m"), ("shaft.element_1.moment", np.linalg.norm(resultants[:, 0, 3:], axis=1), "N m"),
                                   ("elements/shaft/element_1/force", np.linalg.norm(resultants[:, 0, :3], axis=1), "N"),
                                   ("pin.a.force.x", resultants[:, 0, 0], "N"), ("'pin.a'.element_1.moment.z", resultants[:, 0, 5], "N m")):
            with self.subTest(text=text):
                self.expect(text, values, unit)
        self.assertEqual(self.read("shaft.element_3.von_mises.p2").labels, ["shaft.element_3.von_mises.p2"])
        for text in ("shaft.element_5.force.x", "shaft.element_0.force.x", "shaft.element_1.force.q", "shaft.force.x", "main.element_1.force.x", "pin.a.von_mises.max"):
            with self.subTest(text=text), self.assertRaises(InputError):
                self.read(text)

    def test_rotations_count_turns_and_stress_follows_from_the_body(self):
        np.testing.assert_allclose(self.read("hub.bryant.c").one, synthetic.OMEGA * self.time, atol=1e-12)
        np.testing.assert_allclose(self.read("hub.rotation_vector.norm").one, synthetic.OMEGA * self.time, atol=1e-7)
        np.testing.assert_allclose(self.read("rod.von_mises.max").one, synthetic.YOUNG * np.abs(synthetic.strain(self.time)), rtol=1e-9, atol=1e-3)

    def test_largest_values_ignore_what_is_no_number(self):
        with h5py.File(self.path("run.h5"), "r+") as file:
            file["elements/shaft/von_mises"][3, 0, 0] = np.nan
            file["elements/shaft/von_mises"][4] = np.nan
        quantity = self.read("shaft.von_mises.max").one
        self.assertEqual(quantity[3], 4e7)
        self.assertEqual(np.flatnonzero(np.isnan(quantity)).tolist(), [4])

    def test_invariants_of_stress_and_of_strain_with_engineering_shears(self):
        with h5py.File(self.path("run.h5"), "r+") as file:
            shear = np.tile([0, 0, 0, 0, 0, 2.0], (len(self.time), 1))
            for name, units in (("stress_at_root", "Pa"), ("strain_at_root", "-")):
                synthetic.put(file, f"elements/rod/{name}", shear, units)
        for text, value in (("rod.stress_at_root.xy", 2), ("rod.stress_at_root.principal", 2), ("rod.stress_at_root.von_mises", 2 * 3 ** 0.5),
                            ("rod.strain_at_root.xy", 2), ("rod.strain_at_root.principal", 1)):
            np.testing.assert_allclose(self.read(text).one, value, rtol=1e-14, err_msg=text)
        with self.assertRaises(InputError) as caught:
            self.read("rod.strain_at_root.von_mises")
        self.assertIn("has no component 'von_mises'", str(caught.exception))

    def test_rows_in_blocks_are_the_rows(self):
        from bielle_tools.quantities import quantities
        whole, made = self.read("shaft.resultants").values, self.read("rod.von_mises").values
        before, quantities.AT_ONCE = quantities.AT_ONCE, 600
        try:
            np.testing.assert_array_equal(self.read("shaft.resultants").values, whole)
            np.testing.assert_array_equal(self.read("rod.von_mises").values, made)
            some = self.read("shaft.resultants", select=lambda results: results.frames(7)).values
        finally:
            quantities.AT_ONCE = before
        np.testing.assert_array_equal(some, whole[::7])

    def test_slips_are_answered_with_what_there_is(self):
        for text, part in (("main.reactoin", "did you mean 'main.reaction'?"), ("joints/main/reactoin", "did you mean 'joints/main/reaction'?"),
                           ("mian.angle", "did you mean 'main.angle'?"), ("main.reaction.xx", "has no component 'xx'"),
                           ("main.reaction.nrom", "did you mean 'norm'?"), ("main.reaction[7]", "count from 1 to 6"), ("main.reaction[0]", "count from 1 to 6"),
                           ("main.reaction.max", "columns in N and N m"), ("kinetic[1]", "one number at each time"), ("main.reaction..x", "'..x' is not understood"),
                           ("main.reaction[1", "is not understood"), ("shaft.von_mises[1,1,1]", "are too many"), ("qqq", "bielle-table --list"),
                           ("hub.position.moment", "is one vector"), ("rod.deflection", "expected a point"), ("rod.deflection(1, 2", "a bracket is not closed"),
                           ("analysis_3/main.angle", "holds no analysis 3"), ("", "has no quantity ''"),
                           ("main.angle + 1", "an entry of 'measures'"), ("kinetic/2^3", "an entry of 'measures'"), ("hub.z", "did you mean 'hub.position.z'?")):
            with self.subTest(text=text), self.assertRaises(InputError) as caught:
                self.read(text)
            self.assertIn(part, str(caught.exception))

    def test_words_in_brackets_keep_commas_and_brackets_in_quotes(self):
        for text, words, rest in (("(a, 'b, c' , d).x", ("a", "b, c", "d"), ".x"), ("('b) c')", ("b) c",), ""), ("(o'brien,1 0 0)", ("o'brien", "1 0 0"), ""),
                                  ("()", ("",), ""), ("( , a)", ("", "a"), ""), ("[1]", (), "[1]")):
            self.assertEqual(arguments_of(text), (words, rest))
        for text in ("(a, b", "("):
            self.assertRaisesRegex(InputError, "is not closed", arguments_of, text)

    def test_names_in_lists_are_split_outside_of_brackets_and_quotes(self):
        self.assertEqual(split_names("a.x, b.deflection(p, q, 0 1 2).y , 'c, d'.z,e[1,2]"), ["a.x", "b.deflection(p, q, 0 1 2).y", "'c, d'.z", "e[1,2]"])
        for text in ("", "a,", ",a", "a,,b"):
            self.assertRaises(InputError, split_names, text)


class OfRuns(InFolder):
    def test_names_with_dots_slashes_and_commas(self):
        for layout in ("named", "stacked"):
            self.write("model.yaml", MODEL + f"output: {{layout: {layout}}}\n")
            subprocess.run([os.path.join(PROGRAMS, "bielle-mechanism"), "model.yaml", "-o", f"{layout}.h5", "--quiet"], cwd=self.folder, check=True, timeout=60)
        with Results(self.path("named.h5")) as named, Results(self.path("stacked.h5")) as stacked, h5py.File(self.path("named.h5")) as file:
            for results in (named, stacked):
                quantities = Quantities(results)
                self.assertEqual(sorted(quantities.places.recorded), sorted(Quantities(named).places.recorded))
                for text, place, column in (("a.b.angle", "joints/a.b/coordinate", 0), ("left/arm.angle", "joints/left/arm/coordinate", 0),
                                            ("left/arm/reaction.z", "joints/left/arm/reaction", 2), ("'x, y'.reaction.z", "joints/x, y/reaction", 2),
                                            ("nodes/a.b/position.x", "nodes/a.b/position", 0), ("a.b.position.x", "nodes/a.b/position", 0),
                                            ("depth", "measures/depth", None), ("elements/max/momentum.z", "elements/max/momentum", 2),
                                            ("swing.angle.rate", "joints/swing/rate", 1), ("swing.reaction.ry", "joints/swing/reaction", 4),
                                            ("analysis_1/depth", "analysis_1/measures/depth", None), ("analysis_1/left/arm.angle", "analysis_1/joints/left/arm/coordinate", 0)):
                    with self.subTest(text=text):
                        expected = file[place][()] if column is None else file[place][:, column]
                        np.testing.assert_array_equal(quantities.read(text).one, expected)
            self.assertEqual(len(Quantities(named).read("analysis_1/time").one), 21)
            self.assertEqual(len(Quantities(named).read("time").one), 11)

    def test_deflection_takes_names_with_commas_of_a_body_whose_name_has_one(self):
        synthetic.write_superelement(self.path("box.h5"))
        synthetic.write_results(self.path("run.h5"), "box.h5")
        with h5py.File(self.path("run.h5"), "r+") as file, h5py.File(self.path("box.h5"), "r+") as box:
            file["elements"].move("rod", "rod, left")
            for k, name in enumerate(("a, b", "c) d", "e%2Ff")):
                synthetic.put(box, f"points/{name}/position", [0.1 * k, 0.01 * k * k, 0], "m")
                synthetic.put(box, f"points/{name}/shapes", np.arange(12.0).reshape(6, 2) * k, "m")
        with Results(self.path("run.h5")) as results:
            quantities = Quantities(results)
            found = quantities.read("'rod, left'.deflection('a, b', 'c) d', e/f)").values
            self.assertEqual(found.shape, (41, 3))
            np.testing.assert_array_equal(found, quantities.read("elements/rod, left/deflection('a, b','c) d','e/f')").values)
            self.assertEqual(quantities.read("'rod, left'.deflection('a, b', 'c) d', e/f).x").labels, ["'rod, left'.deflection('a, b', 'c) d', e/f).x"])

    def test_names_with_slashes_in_the_layout_by_names(self):
        nodes = ", ".join(f"{name}: {{position: [{k}, 0, 0], fixed: [{'' if name == 'left/arm' else 'x, y, z, '}rx, ry, rz]}}" for k, name in enumerate(("left", "left/arm", "left/arm/tip", "right/arm", "plain"), 1))
        with self.run_model(f"nodes: {{{nodes}}}\nelements: {{left/arm: {{type: point_mass, node: left/arm, mass: 1}}}}\n"
                            "analysis: [{type: dynamic, duration: 1, step: 0.5}]\noutput: {layout: named}\n") as results:
            self.assertEqual(sorted(results.names("nodes")), ["left", "left/arm", "left/arm/tip", "plain", "right/arm"])
            self.assertEqual(results.names("elements"), ["left/arm"])
            self.assertEqual(results.names("joints"), [])
        with h5py.File(self.path("run.h5"), "r+") as file:  # damage by a circular reference
            nodes = file["analysis_1/nodes"]
            nodes["left/again"] = nodes["left"]
            nodes["plain/above"] = nodes
        with Results(self.path("run.h5")) as results:
            self.assertEqual({"left", "left/arm", "left/arm/tip", "right/arm", "plain"} - {name.removeprefix("plain/above/") for name in results.names("nodes")}, set())
            self.assertEqual(len(results.names("nodes")), 5)

    def test_a_note_is_said_once_for_quantities_of_one_analysis(self):
        synthetic.write_superelement(self.path("box.h5"))
        synthetic.write_results(self.path("run.h5"), "box.h5", analysis="dynamic")
        with h5py.File(self.path("run.h5"), "r+") as file:
            file["joints/main/reaction"][3, 0] = np.nan
        with Results(self.path("run.h5")) as results, contextlib.redirect_stderr(io.StringIO()) as said:
            quantities = Quantities(results)
            for name in ("x", "y", "norm"):
                quantities.read(f"analysis_1/main.reaction.{name}")
        self.assertEqual(said.getvalue().count("holds values that are no numbers"), 1)

    def run_model(self, text):
        self.write("model.yaml", text)
        subprocess.run([os.path.join(PROGRAMS, "bielle-mechanism"), "model.yaml", "-o", "run.h5", "--quiet"], cwd=self.folder, check=True, timeout=60)
        return Results(self.path("run.h5"))

    def test_paths_tell_names_apart_that_differ_by_dots_and_slashes_and_apostrophes_stay(self):
        nodes, elements = ("\n".join(f'  "{name}": {{{keys.format(name=name, mass=k)}}}' for k, name in enumerate(("a/b", "a.b", "o'brien"), 1))
                           for keys in ("position: [1, 0, 0], fixed: [rx, ry, rz]", 'type: point_mass, node: "{name}", mass: {mass}'))
        model = f"nodes:\n{nodes}\nelements:\n{elements}\n" + "gravity: [0, 0, -9]\nanalysis: [{type: dynamic, duration: 1, step: 0.5}]\n"
        with self.run_model(model) as results:
            quantities = Quantities(results)
            for text, mass in (("elements/a/b/momentum.z", 1), ("elements/a.b/momentum.z", 2), ("o'brien.momentum.z", 3), ("elements/o'brien/momentum.z", 3)):
                with self.subTest(text=text):
                    self.assertAlmostEqual(quantities.read(text).one[-1], -9 * mass, delta=1e-9)
            with self.assertRaises(InputError) as caught:
                quantities.read("a.b.momentum")
            self.assertIn("say which", str(caught.exception))

    def test_torques_of_a_planetary_set_are_no_vector(self):
        wheels, factors = ("sun", "ring", "carrier"), (20, 60, -80)
        lines = {"nodes": "{position: [0, 0, 0]}", "elements": "{{type: rigid_body, node: {0}, mass: 1, inertia: [1, 1, 1]}}",
                 "joints": "{{type: hinge, nodes: [ground, {0}], axis: [0, 0, 1]}}"}
        model = "".join(f"{section}:\n" + "".join(f"  {name}: {line.format(name) if '0}' in line else line}\n" for name in wheels) for section, line in lines.items())
        model += f"  set: {{type: gear, joints: [{', '.join(wheels)}], factors: {list(factors)}}}\ndrives: {{motor: {{joint: sun, torque: 5}}}}\n"
        with self.run_model(model + "analysis: [{type: dynamic, duration: 0.1, step: 0.01}]\n") as results:
            torques = Quantities(results).read("set.force")
            self.assertEqual(torques.labels, [f"set.force.{name}.angle" for name in wheels])
            np.testing.assert_allclose(torques.values / torques.values[:, :1], np.tile(np.array(factors) / factors[0], (len(torques.time), 1)), rtol=1e-9)
            with self.assertRaises(InputError) as caught:
                Quantities(results).read("set.force.norm")
            self.assertIn("no component 'norm'", str(caught.exception))


if __name__ == "__main__":
    unittest.main()
