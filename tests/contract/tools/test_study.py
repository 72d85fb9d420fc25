"""study: every line of a table becomes a run, failed ones among them; a stand-in plays bielle-mechanism."""

import os
import stat
import subprocess
import tempfile
import unittest

import h5py

from box_mesh import REPOSITORY

STUDY = os.path.join(REPOSITORY, "tools", "study")
# Takes the arguments of bielle-mechanism; doubles the parameter `speed`, fails when `mass` is negative.
STAND_IN = """#!/usr/bin/python3
import sys, h5py
arguments = sys.argv[1:]
values = dict(a.split("=", 1) for k, a in enumerate(arguments) if arguments[k - 1] == "--set")
if float(values["mass"]) < 0:
    print("model.yaml:3: mass: expected a positive number", file=sys.stderr)
    sys.exit(1)
with h5py.File(arguments[arguments.index("-o") + 1], "w") as file:
    file.attrs["format"] = "bielle results"
    file["analysis_1/time"] = [0.0, 1.0]
    file["analysis_1/joints/main/rate"] = [[0.0], [2 * float(values["speed"])]]
    file["analysis_1/nodes/hub/position"] = [[0.0, 0, 0], [1, 0, 0]]
    for name in ("time", "joints", "nodes"):
        file[name] = h5py.SoftLink("/analysis_1/" + name)
"""


class Study(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.write("bielle-mechanism", STAND_IN)
        os.chmod(self.path("bielle-mechanism"), stat.S_IRWXU)
        self.write("model.yaml", "mechanism: a\nparameters: {speed: 1, mass: 2}\n")

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)

    def study(self, table, *options):
        self.write("table.csv", table)
        return subprocess.run(["/usr/bin/python3", "-B", STUDY, self.path("model.yaml"), self.path("table.csv"), "-o",
                               self.path("study.h5"), *options], capture_output=True, text=True, timeout=120,
                              env={**os.environ, "BIELLE_BIN": self.folder})

    def test_gathers_all_runs_in_order(self):
        done = self.study("speed, mass\n1, 2\n2, 2\n\n# a comment\n3.5, 4\n", "--jobs", "2")
        self.assertEqual(done.returncode, 0, done.stderr)
        with h5py.File(self.path("study.h5")) as file:
            self.assertEqual(file["parameters/speed"].asstr()[:].tolist(), ["1", "2", "3.5"])
            self.assertEqual(file["status"][:].tolist(), [0, 0, 0])
            self.assertTrue(file.attrs["complete"])
            for number, speed in ((1, 1), (2, 2), (3, 3.5)):
                self.assertEqual(file[f"runs/{number}/joints/main/rate"][1, 0], 2 * speed)
                self.assertNotIn("nodes", file[f"runs/{number}"])

    def test_keeps_what_is_asked_for(self):
        self.assertEqual(self.study("speed,mass\n1,2\n", "--keep", "nodes").returncode, 0)
        with h5py.File(self.path("study.h5")) as file:
            self.assertEqual(sorted(file["runs/1"]), ["nodes", "time"])

    def test_a_failed_run_is_told_and_the_others_are_kept(self):
        done = self.study("speed,mass\n1,2\n1,-2\n2,2\n")
        self.assertEqual(done.returncode, 2)
        self.assertIn("expected a positive number", done.stdout)
        with h5py.File(self.path("study.h5")) as file:
            self.assertEqual(file["status"][:].tolist(), [0, 1, 0])
            self.assertIn("positive", file["message"].asstr()[1])
            self.assertEqual(sorted(file["runs"]), ["1", "3"])

    def test_wrong_tables_are_told_with_their_line(self):
        for table, part in (("", "is empty"), ("speed,mass\n", "no runs"),
                            ("speed,mass\n1,2\n1\n", "table.csv:3: 1 value for 2 parameters"),
                            ("speed,speed\n1,2\n", "table.csv:1")):
            done = self.study(table)
            self.assertEqual(done.returncode, 1)
            self.assertIn(part, done.stderr)
            self.assertNotIn("Traceback", done.stderr)


if __name__ == "__main__":
    unittest.main()
