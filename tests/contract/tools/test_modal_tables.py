"""Tests of bielle-table --modes and --response: their numbers are those of the results file and of closed forms."""

import csv
import io
import math
import os
import subprocess
import unittest

import h5py
import numpy as np

import synthetic_modes
from box_mesh import REPOSITORY, InFolder
from python_tool import run_python_tool  # box_mesh sets the path

PROGRAMS = os.environ["BIELLE_PROGRAMS"]
TOOL = os.path.join(REPOSITORY, "tools", "bielle-table")
DISC = """\
mechanism: a disc in an elastic bearing
parameters: {speed: 0}
nodes: {disc: {position: [0, 0, 0], angular_velocity: [0, 0, speed]}}
elements: {disc: {type: rigid_body, node: disc, mass: 10, inertia: [0.1, 0.1, 0.18]}}
joints: {shaft: {type: bearing, nodes: [ground, disc], axis: [0, 0, 1], radial: 1e5, axial: 4e5, tilting: 1000}}
analysis:
  - {type: eigen}
  - {type: campbell, parameter: speed, speeds: {from: 50, to: 150, count: 3}, modes: 5}
"""
OSCILLATOR = """\
mechanism: an oscillator
parameters: {k: 1000}
nodes: {mass: {position: [0, 0, 0], fixed: [rx, ry, rz]}}
elements: {mass: {type: point_mass, node: mass, mass: 2}}
joints: {guide: {type: prismatic, nodes: [ground, mass], axis: [1, 0, 0], stiffness: k, damping: 4}}
measures: {speed: {node: mass, quantity: velocity, direction: x}}
analysis:
  - {type: eigen}
  - {type: frequency_response, inputs: [{node: mass, direction: x}], outputs: [{node: mass, direction: x}, speed], frequencies: [1, 3.5, 20]}
"""


class ModalTables(InFolder):
    def run_tool(self, *arguments):
        return run_python_tool(TOOL, arguments, self.folder)

    def table(self, *arguments):
        """Returns [{head: cell}] of a table that the tool writes as CSV."""
        done = self.run_tool(*arguments, "--csv", "-")
        self.assertEqual(done.returncode, 0, done.stderr)
        return list(csv.DictReader(io.StringIO(done.stdout)))

    def compute(self, name, model, *options):
        self.write(f"{name}.yaml", model)
        subprocess.run([os.path.join(PROGRAMS, "bielle-mechanism"), f"{name}.yaml", "--quiet", *options], cwd=self.folder, check=True, timeout=120)

    def refuse(self, arguments, part):
        done = self.run_tool(*arguments)
        self.assertEqual((done.returncode, len(done.stderr.splitlines())), (1, 1), done.stderr)
        self.assertIn(part, done.stderr)

    def test_modes_of_a_disc_over_its_speed(self):
        self.compute("disc", DISC)
        with h5py.File(self.path("disc.h5")) as file:
            stored = {name: file["campbell"][name][()] for name in ("frequency", "damped_frequency", "damping_ratio", "whirl")}
            names = file["campbell/name"].asstr()[:].tolist()
            eigen = file["eigen/frequency"][:]
        table = self.table("disc.h5", "--modes", "--analysis", "2")
        self.assertEqual([(line["parameter"], float(line["value"]), float(line["speed [rad/s]"]), line["mode"], line["name"]) for line in table],
                         [("speed", speed, speed, str(k + 1), name) for speed in (50.0, 100.0, 150.0) for k, name in enumerate(names)])
        for head, name in (("frequency [Hz]", "frequency"), ("damped frequency [Hz]", "damped_frequency"), ("damping ratio", "damping_ratio"), ("whirl", "whirl")):
            np.testing.assert_array_equal([float(line[head] or "nan") for line in table], stored[name].ravel(), name)
        self.assertTrue(any(line["whirl"] == "" for line in table), "a motion along the axis has no sense")
        for line in table:  # a tilting disc has A w^2 -+ C speed w - k = 0
            if line["name"].startswith("disc tilting"):
                speed, sense = float(line["speed [rad/s]"]), 1 if "forward" in line["name"] else -1
                w = (sense * 0.18 * speed + math.sqrt((0.18 * speed) ** 2 + 4 * 0.1 * 1000)) / (2 * 0.1)
                self.assertAlmostEqual(float(line["damped frequency [Hz]"]), w / (2 * math.pi), delta=1e-9 * w)
                self.assertEqual(np.sign(float(line["whirl"])), sense)
        modes = self.table("disc.h5", "--modes", "--analysis", "1")
        np.testing.assert_array_equal([float(line["frequency [Hz]"]) for line in modes], eigen)
        self.assertEqual([line["kind"] for line in modes], ["rigid"] + 5 * ["oscillating"])
        shown = self.run_tool("disc.h5", "--modes").stdout.splitlines()  # both tables
        self.assertEqual([line.split()[0] for line in shown], ["mode", *"123456", "parameter", *15 * ["speed"]])

    def test_the_list_has_the_datasets_of_small_motions(self):
        self.compute("disc", DISC)
        shown = self.run_tool("disc.h5").stdout.splitlines()
        self.assertIn("campbell/frequency 3 x 5 Hz", [" ".join(line.split()[:5]) for line in shown])
        self.refuse(("disc.h5", "--quantity", "campbell/frequency"), "bielle-table --modes shows the results of 'campbell'")

    def test_response_of_an_oscillator(self):
        self.compute("oscillator", OSCILLATOR)
        table = self.table("oscillator.h5", "--response")
        self.assertEqual([float(line["frequency [Hz]"]) for line in table], [1.0, 1.0, 3.5, 3.5, 20.0, 20.0])
        for number, line in enumerate(table):
            w = 2 * math.pi * float(line["frequency [Hz]"])
            H = (1j * w if number % 2 else 1) / (1000 - 2 * w**2 + 4j * w)
            for head, value in (("amplitude", abs(H)), ("phase [rad]", np.angle(H)), ("real part", H.real), ("imaginary part", H.imag)):
                self.assertAlmostEqual(float(line[head]), value, delta=1e-9 * (1 if "phase" in head else abs(H)))
        self.assertIn("frequency [Hz]  output", self.run_tool("oscillator.h5", "--response").stdout)
        self.refuse(("oscillator.h5", "--quantity", "frequency_response.response"), "bielle-table --response shows")

    def test_several_files_are_told_apart(self):
        self.compute("soft", OSCILLATOR)
        self.compute("stiff", OSCILLATOR, "--set", "k=4000")
        table = self.table("soft.h5", "stiff.h5", "--modes")
        self.assertEqual([line["run"] for line in table], ["soft", "stiff"])
        for line, k in zip(table, (1000, 4000)):
            self.assertAlmostEqual(float(line["frequency [Hz]"]), math.sqrt(k / 2) / (2 * math.pi), places=9)
            self.assertAlmostEqual(float(line["damping ratio"]), 4 / (2 * math.sqrt(2 * k)), places=9)

    def test_results_without_names_have_empty_ones(self):
        synthetic_modes.write_whirl(self.path("whirl.h5"))
        with h5py.File(self.path("whirl.h5"), "r+") as file:
            file["eigen/damped_frequency"] = np.array([4.0, 0.0])
        self.assertEqual([line["name"] for line in self.table("whirl.h5", "--modes")], ["", ""])

    def test_slips_are_answered_with_one_sentence(self):
        synthetic_modes.write_whirl(self.path("whirl.h5"))
        self.refuse(("whirl.h5", "--modes"), "'eigen/damped_frequency' cannot be read")
        with h5py.File(self.path("whirl.h5"), "r+") as file:
            file["eigen/damped_frequency"] = np.zeros(3)
        self.refuse(("whirl.h5", "--modes"), "'eigen' is damaged")
        for wrong, part in ((3.0, "'eigen' is damaged"), (["x", "y"], "it holds no numbers")):
            with h5py.File(self.path("whirl.h5"), "r+") as file:
                del file["eigen/frequency"]
                file["eigen/frequency"] = wrong
            self.refuse(("whirl.h5", "--modes"), part)
        self.compute("oscillator", OSCILLATOR)
        self.compute("disc", DISC)
        for arguments, part in ((("whirl.h5", "--response"), "holds no frequency response"), (("oscillator.h5", "--modes", "--peaks"), "say one of"),
                                (("oscillator.h5", "--modes", "--rpc", "x.rsp"), "say one of"), (("oscillator.h5", "--response", "--every", "2"), "rows over time"),
                                (("disc.h5", "--modes", "--csv", "x.csv"), "pick the analysis by --analysis N"),
                                (("disc.h5", "--modes", "--analysis", "1", "--csv", "disc.h5"), "is an input"),
                                (("disc.h5", "--modes", "--analysis", "1", "--csv", "x.parquet"), "is written as CSV"),
                                (("disc.h5", "--csv", "x.csv"), "--modes and --response write")):
            with self.subTest(arguments=arguments):
                self.refuse(arguments, part)
        self.assertFalse(os.path.exists(self.path("x.csv")))


if __name__ == "__main__":
    unittest.main()
