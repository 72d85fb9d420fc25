"""Tests of bodies in pieces, from the body file to the results of a mechanism: the output, the layout of the file,
refusals."""

import os
import re
import subprocess
import unittest

import h5py
import numpy

from bar_body import BarTest
from command import PROGRAMS

BAR = """\
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 200, 20, 20};
Physical Volume("bar") = {1};
Physical Surface("left") = {1};
Physical Surface("right") = {2};
Physical Surface("bottom") = {3};
"""

BODY = """\
body: bar
geometry: bar.geo
length_unit: mm
mesh: {size: 0.02}
materials:
  steel: {young: 210e9, poisson: 0.3, density: 7850}
regions: {bar: steel}
interfaces:
  left: {surface: left}
  right: {surface: right}
modes: {count: 2}
damping: {ratio: 0.01}
loads:
  wind: {surface: bottom, force: [0, 8, 0]}
pieces: {count: 4, line: {from: [0, 0, 0], to: [0.2, 0, 0]}}
"""

MODEL = """\
nodes:
  base: {position: [0, 0.01, 0.01], fixed: true}
elements:
  bar: {type: superelement, file: body.h5, nodes: {left: base}, loads: {wind: 1}}
analysis:
  - {type: static}
output: {only: {elements: [bar]}, fields: {bar: [displacement], bar.4: [von_mises]}}
"""


class ReducePieces(BarTest):
    geometry = BAR

    def refuse(self, old, new, *says):
        self.assertIn(old, BODY)
        self.write("body.yaml", BODY.replace(old, new))
        self.expect_refusal(1, "body.yaml", says=says)
        self.assertEqual([name for name in os.listdir(self.folder) if ".h5" in name], [])

    def run_model(self, model):
        self.write("model.yaml", model)
        done = subprocess.run([os.path.join(PROGRAMS, "bielle-mechanism"), "model.yaml", "-o", "run.h5"], cwd=self.folder,
                              text=True, capture_output=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr)
        return os.path.join(self.folder, "run.h5")

    def test_one_run_makes_all_pieces_and_says_what_the_cuts_do(self):
        said = self.reduce(BODY).stdout
        for text in ("bar: 4 pieces, mass 0.628 kg", "bar.2: mass 0.157 kg, 14 coordinates, 2 of modes, interfaces cut_1, cut_2",
                     "cut_3: between pieces 3 and 4, at (0.15, 0.01, 0.01) m, area 0.0004 m^2, in its plane",
                     "the mass of all pieces is that of the uncut mesh", "uncut body", "written: body.h5"):
            self.assertIn(text, said)
        raised = re.search(r"the cuts raise the first free frequency by ([0-9.]+) %, from ([0-9.]+) to ([0-9.]+) Hz", said)
        self.assertIsNotNone(raised, said)
        percent, uncut, cut = map(float, raised.groups())
        self.assertAlmostEqual(percent, 100 * (cut / uncut - 1), delta=0.06)
        self.assertRegex(said, r"between its interfaces the body in pieces is [0-9.]+ to [0-9.]+ % stiffer")
        with h5py.File(os.path.join(self.folder, "body.h5")) as file:
            self.assertEqual((file.attrs["format"], file.attrs["complete"]), ("bielle cut body", 1))
            self.assertEqual(list(file["pieces"]), ["1", "2", "3", "4"])
            self.assertEqual(file["pieces/3"].attrs["format"], "bielle superelement")
            self.assertEqual(file["pieces/3/reduced/stiffness"].shape, (14, 14))
            self.assertAlmostEqual(file["assembled/free_frequencies"][0], cut, delta=1e-3 * cut)
            self.assertAlmostEqual(file["uncut/free_frequencies"][0], uncut, delta=1e-3 * uncut)
            missing = []
            file.visititems(lambda name, item: missing.append(name) if isinstance(item, h5py.Dataset) and
                            item.dtype.kind == "f" and "units" not in item.attrs else None)
            self.assertEqual(missing, [])

    def test_masses_of_pieces_are_told(self):
        said = self.reduce(BODY + "masses: {pump: {at: [0.1, 0.01, 0.02], mass: 2}, paint: {surface: bottom, per_area: 3}}\n").stderr
        self.assertIn("masses.pump: 2 kg with the centre (0.1, 0.01, 0.02) m follow", said)
        self.assertIn("masses.paint: 3 kg/m^2 on 0.004 m^2 are 0.012 kg", said)

    def test_inspect_checks_every_piece_again(self):
        self.reduce(BODY.replace("]}}", "]}, compare: false}"))
        done = self.run_program("--inspect", "body.h5")
        self.assertEqual(done.returncode, 0, done.stderr)
        for text in ("bar: 4 pieces", "piece 4", "bar.4: 14 coordinates", "passed"):
            self.assertIn(text, done.stdout)
        self.assertNotIn("first free frequency by", done.stdout)
        with h5py.File(os.path.join(self.folder, "body.h5"), "r+") as file:
            file["pieces/2/reduced/mass"][...] *= 1.0005
            del file["pieces/2"].attrs["checksum"]
        self.expect_refusal(2, "--inspect", "body.h5", says=["body.h5: /pieces/2", "mass_error"])

    def test_what_does_not_fit_is_refused(self):
        self.refuse("right: {surface: right}", "side: {surface: bottom}", "body.yaml:10: interfaces.side",
                    "its surface lies in 4 pieces, on both sides of 'cut_1', 'cut_2', 'cut_3'")
        self.refuse("{count: 4, line: {from: [0, 0, 0], to: [0.2, 0, 0]}}", "{planes: {axis: x, at: 0.3}}",
                    "body.yaml:15: pieces.planes", "does not cut the body", "between -0.3 m and -0.1 m")
        self.refuse("damping: {ratio: 0.01}", "damping: {ratio: [0.01, 0.02]}", "body.yaml:12: a body in pieces has one ratio")
        self.refuse("pieces: {count", "piecs: {count", "did you mean 'pieces'?")

    def test_a_mechanism_places_the_pieces_by_one_entry(self):
        self.reduce(BODY)
        with h5py.File(self.run_model(MODEL)) as file:
            elements = file["analysis_1/elements"]
            self.assertEqual(sorted(elements), ["bar.1", "bar.2", "bar.3", "bar.4"])
            for name in elements:
                self.assertEqual(elements[name].attrs["group"], "/pieces/" + name[-1])
                self.assertIn("displacement", elements[name])
                self.assertEqual("von_mises" in elements[name], name == "bar.4")
            forces = elements["bar.1/interface_force"][-1]
            names = [name for name in elements["bar.1"].attrs if name.startswith("interface")]
            self.assertEqual(sorted(names), ["interface cut_1", "interface left"])
            # The wall carries the whole wind load, in body axes that hardly rotate.
            self.assertAlmostEqual(forces[0, 1], -8, delta=1e-3)
            # The uncut bar is a cantilever under q = 40 N/m, with q L^4/(8 EI) and shear; the coarse mesh causes errors
            # of some per cent.
            tip = file["analysis_1/nodes/bar.right/position"][-1, 1] - 0.01
            deflection = 40 * 0.2 ** 4 / (8 * 210e9 * 0.02 ** 4 / 12)
            self.assertTrue(0.93 * deflection < tip < 1.03 * deflection, (tip, deflection))
            self.assertTrue(numpy.isfinite(elements["bar.4/von_mises"][-1]).all())

    def test_results_of_single_pieces(self):
        self.reduce(BODY)
        model = MODEL.replace("[bar]}", "[bar.2]}").replace(", fields: {bar: [displacement], bar.4: [von_mises]}", "")
        with h5py.File(self.run_model(model)) as file:
            self.assertEqual(list(file["analysis_1/elements"]), ["bar.2"])


if __name__ == "__main__":
    unittest.main()
