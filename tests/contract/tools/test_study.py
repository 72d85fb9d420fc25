"""Tests of bielle-study: every line of a table becomes a run, including failed ones. A stand-in replaces
bielle-mechanism."""

import os
import signal
import subprocess
import time
import unittest

import h5py

from study_stand_in import PROGRAM, STAND_IN, STUDY, WithStandIn
from shares import share_of_tests as load_tests  # noqa: E402,F401


class Study(WithStandIn):
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
        self.assertEqual([name for name in os.listdir(self.folder) if "study" in name], ["study.h5"])

    def test_the_file_names_the_programs_of_its_runs(self):
        first, second = PROGRAM, PROGRAM.replace("stand-in", "replaced")
        self.assertEqual(self.study("speed,mass\n1,2\n1,-2\n2,2\n").returncode, 2)
        with h5py.File(self.path("study.h5")) as file:
            self.assertEqual(file.attrs["created_by"], first)
        self.write("bielle-mechanism", STAND_IN.replace(f'PROGRAM = "{first}"', f'PROGRAM = "{second}"'))
        self.assertEqual(self.study("speed,mass\n1,2\n2,2\n3,2\n").returncode, 0)  # two runs are kept
        with h5py.File(self.path("study.h5")) as file:
            found = [file[f"runs/{number}"].attrs["created_by"] for number in (1, 2, 3)]
            self.assertEqual(file.attrs["created_by"].split(", "), list(dict.fromkeys(found)))
            self.assertEqual(found[2], second)

    def test_keeps_what_is_asked_for(self):
        self.assertEqual(self.study("speed,mass\n1,2\n", "--keep", "nodes").returncode, 0)
        with h5py.File(self.path("study.h5")) as file:
            self.assertEqual(sorted(file["runs/1"]), ["nodes", "time"])

    def test_a_failed_run_is_told_and_the_others_are_kept(self):
        done = self.study("speed,mass\n1,2\n1,-2\n2,2\n")
        self.assertEqual(done.returncode, 2)
        self.assertIn("run 2: speed = 1, mass = -2: FAILED: model.yaml:3: mass: expected a positive number", done.stdout)
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
        self.refuse("sped,mass\n1,2\n2,2\n1,3\n", "bielle-study: --set sped=1: model.yaml has no parameter 'sped'; did you mean 'speed'?")
        self.assertEqual([name for name in os.listdir(self.folder) if "study." in name], [])

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
            self.assertEqual(sorted(file["runs/1"]), ["crossings", "eigen", "events", "joints", "measures", "time"])
        for _ in range(2):  # a reused run keeps its links
            self.assertEqual(self.study("speed,mass\n1,2\n", "--keep", "all").returncode, 0)
            with h5py.File(self.path("study.h5")) as file:
                self.assertEqual(file["runs/1"].get("joints", getlink=True).path, "/runs/1/analysis_1/joints")
                self.assertEqual(file["runs/1/joints/main/rate"][1, 0], 2)
        self.assertEqual(self.runs(), ["1 2", "1 2"])  # `all` keeps more than the first time

    def test_runs_with_the_same_values_and_a_run_that_was_killed_are_told(self):
        done = self.study("speed,mass\n1,2\n13,2\n1,2\n")
        self.assertIn("run 3 has the values of run 1", done.stderr)
        self.assertEqual(done.returncode, 2)
        self.assertIn("speed = 13, mass = 2: FAILED: ended by signal 9", done.stdout)
        self.assertEqual(self.runs(), ["1 2", "13 2"])
        with h5py.File(self.path("study.h5")) as file:
            self.assertEqual(file["status"][:].tolist(), [0, -9, 0])
            self.assertEqual(file["runs/3/joints/main/rate"][1, 0], 2)

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


class Resumed(WithStandIn):
    def test_finished_runs_are_not_made_again(self):
        self.study("speed,mass\n1,2\n1,-2\n2,2\n")
        self.assertEqual(self.runs(), ["1 -2", "1 2", "2 2"])
        done = self.study("mass,speed\n2,3\n2,2\n-2,1\n2,1\n")  # in another order, with a new run
        self.assertEqual(self.runs(), ["-2 1", "2 3"])
        self.assertIn("2 of 4 runs are there from before", done.stdout)
        with h5py.File(self.path("study.h5")) as file:
            self.assertEqual(file["status"][:].tolist(), [0, 0, 1, 0])
            self.assertEqual([file[f"runs/{k}/joints/main/rate"][1, 0] for k in (1, 2, 4)], [6, 4, 2])

    def test_what_has_changed_is_made_anew(self):
        table = "speed,mass\n1,2\n"
        self.write("cam.csv", "0, 1\n")
        self.write("model.yaml", "cam: {file: cam.csv}\n")
        self.study(table)
        self.assertEqual(self.runs(), ["1 2"])
        self.study(table)
        self.assertEqual(self.runs(), [])
        for change in (lambda: self.write("cam.csv", "0, 2\n"), lambda: self.write("model.yaml", "cam: {file:  cam.csv}\n"),
                       lambda: self.write("bielle-mechanism", STAND_IN + "\n")):
            change()
            self.study(table)
            self.assertEqual(self.runs(), ["1 2"])
        self.study(table, "--fresh")
        self.assertEqual(self.runs(), ["1 2"])

    def test_a_study_that_is_interrupted_or_killed_goes_on(self):
        for number in (signal.SIGINT, signal.SIGKILL):
            self.goes_on_after(number)

    def goes_on_after(self, number):
        table = "speed,mass\n1,2\n2,2\n1000,2\n"
        self.write("table.csv", table)
        child = subprocess.Popen(["/usr/bin/python3", "-B", STUDY, "model.yaml", "table.csv", "--jobs", "1"], cwd=self.folder,
                                 env={**os.environ, "BIELLE_BIN": self.folder}, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                 text=True, start_new_session=True, preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
        for _ in range(600):
            if os.path.exists(self.path("log")):
                with open(self.path("log"), encoding="utf-8") as log:
                    if "1000" in log.read():
                        break
            time.sleep(0.1)
        os.killpg(child.pid, number)
        said = child.communicate()[1]
        if number == signal.SIGINT:
            self.assertEqual(child.returncode, 130)
            self.assertIn("note: interrupted: finished runs are kept in", said)
            self.assertNotIn("Traceback", said)
        self.runs()
        done = self.call("model.yaml", "--grid", "speed=1,2,3", "--set", "mass=2", "-o", "table.h5")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.runs(), ["2 3"])
        self.assertFalse(os.path.exists(self.path("table.runs")))
        os.remove(self.path("table.h5"))

    def test_gathering_something_else_needs_runs_only_where_it_was_not_kept(self):
        self.study("speed,mass\n1,2\n")
        self.runs()
        self.study("speed,mass\n1,2\n", "--gather", "rate=max joints/main/rate")
        self.assertEqual(self.runs(), [])
        self.study("speed,mass\n1,2\n", "--gather", "reach=last nodes/hub/position[z]")
        self.assertEqual(self.runs(), ["1 2"])
        with h5py.File(self.path("study.h5")) as file:
            self.assertEqual(list(file["runs/1/nodes/hub"]), ["position"])
            self.assertEqual(file["gathered/reach"][0], 2)


if __name__ == "__main__":
    unittest.main()
