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
import os, sys, h5py
arguments = sys.argv[1:]
values = dict(a.split("=", 1) for k, a in enumerate(arguments) if arguments[k - 1] == "--set")
if "sped" in values:
    print("bielle-mechanism: error: --set sped=1: model.yaml has no parameter 'sped'; did you mean 'speed'?", file=sys.stderr)
    sys.exit(1)
if values["speed"] == "13":
    os.kill(os.getpid(), 9)
if float(values["mass"]) < 0:
    print("model.yaml:3: mass: expected a positive number", file=sys.stderr)
    sys.exit(1)
with h5py.File(arguments[arguments.index("-o") + 1], "w") as file:
    file.attrs["format"] = "bielle results"
    file["analysis_1/time"] = [0.0, 1.0]
    file["analysis_1/joints/main/rate"] = [[0.0], [2 * float(values["speed"])]]
    file["analysis_1/nodes/hub/position"] = [[0.0, 0, 0], [1, 0, 0]]
    file["analysis_1/measures/power"] = [0.0, 1.0]
    file["analysis_1/events/time"] = [0.5]
    file["crossings"] = "event 'landed'"
    for name in ("time", "joints", "nodes", "measures", "events"):
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
        with open(self.path(name), "w", encoding="utf-8", errors="surrogatepass") as file:
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

    def refuse(self, table, *parts, output="study.h5"):
        done = self.study(table, "-o", self.path(output))
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        for part in parts:
            self.assertIn(part, done.stderr)

    def test_a_parameter_that_no_run_has_ends_the_study(self):
        self.refuse("sped,mass\n1,2\n2,2\n1,3\n", "study: --set sped=1: model.yaml has no parameter 'sped'; did you mean 'speed'?")
        self.assertEqual([name for name in os.listdir(self.folder) if "study.h5" in name], [])

    def test_only_studies_are_replaced(self):
        os.mkdir(self.path("folder"))
        for output, says in (("folder", "is a folder or a device"), ("no/study.h5", "there is no folder"),
                             ("table.csv", "exists and is no study"), ("model.yaml", "exists and is no study")):
            self.refuse("speed,mass\n1,2\n", output, says, output=output)
        with h5py.File(self.path("run.h5"), "w") as file:
            file.attrs["format"] = "bielle results"
        self.refuse("speed,mass\n1,2\n", "exists and is no study", output="run.h5")
        for _ in range(2):
            self.assertEqual(self.study("speed,mass\n1,2\n").returncode, 0)

    def test_measures_and_events_are_kept_and_all_is_kept_once(self):
        self.assertEqual(self.study("speed,mass\n1,2\n").returncode, 0)
        with h5py.File(self.path("study.h5")) as file:
            self.assertEqual(sorted(file["runs/1"]), ["crossings", "events", "joints", "measures", "time"])
        self.assertEqual(self.study("speed,mass\n1,2\n", "--keep", "all").returncode, 0)
        with h5py.File(self.path("study.h5")) as file:
            self.assertEqual(file["runs/1"].get("joints", getlink=True).path, "/runs/1/analysis_1/joints")
            self.assertEqual(file["runs/1/joints/main/rate"][1, 0], 2)

    def test_runs_with_the_same_values_and_a_run_that_was_killed_are_told(self):
        done = self.study("speed,mass\n1,2\n13,2\n1,2\n")
        self.assertIn("run 3 has the values of run 1", done.stderr)
        self.assertEqual(done.returncode, 2)
        self.assertIn("speed = 13, mass = 2: FAILED: ended by signal 9", done.stdout)

    def test_wrong_tables_are_told_with_their_line(self):
        for table, part in (("", "is empty"), ("speed,mass\n", "no runs"),
                            ("speed,mass\n1,2\n1\n", "table.csv:3: 1 value for 2 parameters"),
                            ("speed,speed\n1,2\n", "table.csv:1"),
                            ("speed;mass\n1;2\n", "table.csv:1: columns are separated by commas"),
                            ("speed mass\n1 2\n", "table.csv:1: columns are separated by commas"),
                            ("speed,mass\n\0\ud8ff,2\n", "is no table")):
            done = self.study(table)
            self.assertEqual(done.returncode, 1)
            self.assertIn(part, done.stderr)
            self.assertNotIn("Traceback", done.stderr)


if __name__ == "__main__":
    unittest.main()
