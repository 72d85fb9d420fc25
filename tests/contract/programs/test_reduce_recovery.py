"""Tests of stress and other quantities that the file of another program recovers: they are read, reduced and recorded
in a mechanism."""

import os
import subprocess
import sys
import unittest

import h5py
import numpy as np

from command import PROGRAMS, CommandTest

REPOSITORY = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", "..", ".."))
sys.path.insert(0, os.path.join(REPOSITORY, "tools"))
from bielle_tools.exchange import formats, superelement_set  # noqa: E402
from bielle_tools.exchange.recovery import Quantity  # noqa: E402
from shares import share_of_tests as load_tests  # noqa: E402,F401

MECHANISM = os.path.join(PROGRAMS, "bielle-mechanism")
GEOMETRY = """SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 0.1, 0.1};
Physical Volume("bar") = {1};
Physical Surface("root") = {1};
Physical Surface("tip") = {2};
"""
BODY = """body: bar
geometry: bar.geo
mesh: {size: 0.1, order: 2}
materials: {steel: {young: 210e9, poisson: 0.3, density: 7800}}
regions: {bar: steel}
interfaces: {root: {surface: root, tie: rigid}, tip: {surface: tip, tie: average}}
modes: {count: 4}
recovery: {displacement: all, stress: all}
"""
CANTILEVER = """mechanism: cantilever
nodes: {{wall: {{position: [0, 0.05, 0.05], fixed: true}}}}
elements: {{bar: {{type: superelement, file: {file}, nodes: {{{root}: wall}}}}}}
loads: {{push: {{node: bar.{tip}, force: [0, 0.3, -1]}}}}
analysis: [{{type: static}}]
output: {{fields: {{bar: [stress]}}{more}}}
"""


class Recovery(CommandTest):
    program = "bielle-reduce"

    def write(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)

    def reduce(self, *arguments):
        done = self.run_program(*arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def body_of_the_mesh(self):
        """Reduces the bar, and writes its matrices with a quantity, the stress xx and xy of node 5."""
        self.write("bar.geo", GEOMETRY)
        self.write("bar.yaml", BODY)
        self.reduce("bar.yaml")
        body = superelement_set.read(self.path("bar.h5"))
        place = 6 * list(body.shapes.stress_points).index(5)
        body.quantities = {"gauges": Quantity(["front", "shear"], ["Pa", "Pa"], body.shapes.stress[[place, place + 5]])}
        return body

    def mechanism(self, file, root, tip, more=""):
        self.write("model.yaml", CANTILEVER.format(file=file, root=root, tip=tip, more=more))
        return subprocess.run([MECHANISM, "model.yaml", "-o", "run.h5", "--quiet"], cwd=self.folder, capture_output=True, text=True, timeout=300)

    def rows(self, field, *arguments):
        done = self.mechanism(*arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        with h5py.File(self.path("run.h5")) as file:
            return file[f"analysis_1/elements/bar/{field}"][-1]

    def test_own_stress_through_output4_and_back(self):
        """Bielle's own bodies have a geometric stiffness of their loads, which no format contains; it changes the
        stress by 2e-9 under 1 N. Text has eleven digits, two of which are lost in a bar ten times as long as thick,
        where stress is a difference of larger terms."""
        self.body_of_the_mesh()
        expected = self.rows("stress", "bar.h5", "root", "tip")
        for name, path, within in (("op4", "bar.op4", 5e-9), ("dmig", "bar.pch", 1e-7)):
            with self.subTest(name):
                formats.module_of(name).write(superelement_set.read(self.path("bar.h5")), self.path(path), formats.Options(format=name))
                self.reduce("--from", path, "-o", "back.h5")
                found = self.rows("stress", "back.h5", "node_1", "node_2")
                self.assertEqual(found.shape, expected.shape)
                np.testing.assert_allclose(found, expected, rtol=0, atol=within * np.abs(expected).max())
        self.assertGreater(np.abs(expected).max(), 1e3)

    def test_gauges(self):
        formats.module_of("op4").write(self.body_of_the_mesh(), self.path("bar.op4"), formats.Options(format="op4"))
        text = ("body: bar\nmatrices: {{file: bar.op4, quantities: {{gauges: {{matrix: OTM1, kind: stress{rows}}}}}}}\n"
                "interfaces: {{root: {{node: 1}}, tip: {{node: 2}}}}\ninertia_relief: true\n")
        self.write("gauged.yaml", text.format(rows=", rows: [front, shear]"))
        self.reduce("gauged.yaml")
        more = ", quantities: {bar: [gauges]}"
        found, stress = (self.rows(field, "gauged.h5", "root", "tip", more) for field in ("gauges", "stress"))
        with h5py.File(self.path("gauged.h5")) as file:
            self.assertEqual(list(file["quantities/gauges/rows"].asstr()), ["front", "shear"])
            place = list(file["recovery/stress_nodes"]).index(5)
        np.testing.assert_allclose(found, stress[place][[0, 5]], rtol=1e-12)
        with h5py.File(self.path("run.h5")) as file:
            dataset = file["analysis_1/elements/bar/gauges"]
            self.assertEqual((dataset.attrs["units"], dataset.attrs["description"]), ("Pa", "front, shear"))
        self.write("one.yaml", text.format(rows=", rows: {shear: 2}"))
        self.reduce("one.yaml")
        np.testing.assert_allclose(self.rows("gauges", "one.h5", "root", "tip", more), found[1:], rtol=1e-12)
        self.refusals(text)

    def refusals(self, text):
        """Tests of mistakes in the body file and in the mechanism."""
        for rows, says in ((", rows: [front]", "a name for each of the 2 rows, found 1"), (", rows: {far: 3}", "'far' is row 3, but the matrix has the rows 1"),
                           (", rows: [a, a]", "two rows 'a'"), (", rows: []", "at least one"), (", rows: {a: 0}", "rows"), (", row: [a]", "did you mean 'rows'")):
            with self.subTest(says):
                self.write("slip.yaml", text.format(rows=rows))
                self.expect_refusal(1, "slip.yaml", says=["slip.yaml", says])
        for change, says in ((("OTM1", "OTM9"), "there is no matrix 'OTM9'"), (("kind: stress", "kind: stres"), "stress"), (("kind: stress", ""), "kind")):
            with self.subTest(says):
                self.write("slip.yaml", text.format(rows="").replace(*change))
                self.expect_refusal(1, "slip.yaml", says=["slip.yaml", says])
        for file, more, says in (("gauged.h5", ", quantities: {bar: [gauge]}", "'gauge' is no quantity of 'bar'; did you mean 'gauges'"),
                                 ("bar.h5", ", quantities: {bar: [gauges]}", "holds no quantities of another program"),
                                 ("gauged.h5", ", quantities: {bar: [gauges, gauges]}", "'gauges' is recorded already"),
                                 ("gauged.h5", ", quantities: {bar: []}", "one or more quantities of the superelement's file")):
            with self.subTest(says):
                done = self.mechanism(file, "root", "tip", more)
                self.assertEqual(done.returncode, 1)
                self.assertIn(says, done.stderr)

    def test_words_of_the_body_file(self):
        """Messages of the converter name keys of the body file, not options, which the user did not write."""
        formats.module_of("op4").write(self.body_of_the_mesh(), self.path("bar.op4"), formats.Options(format="op4"))
        for key, says in (("units: mm-t", "`units: mm-t`: units of length"), ("names: {stiffness: KXX}", "`names`"), ("unknowns: bar.yaml", "`unknowns`")):
            with self.subTest(says):
                self.write("slip.yaml", f"body: bar\nmatrices: {{file: bar.op4, {key}}}\n")
                done = self.expect_refusal(1, "slip.yaml", says=["slip.yaml", says])
                self.assertNotIn("--", done.stderr if done else "")
        os.rename(self.path("bar-nodes.bdf"), self.path("elsewhere.bdf"))
        self.expect_refusal(1, "--from", "bar.op4", "-o", "x.h5", says=["`matrices: {.., nodes: DECK}` of a body file"])
        self.expect_refusal(1, "--from", "bar.op4", "-o", "x.h5", "--units", "mm-t", says=["--units mm-t: units of length"])


if __name__ == "__main__":
    unittest.main()
