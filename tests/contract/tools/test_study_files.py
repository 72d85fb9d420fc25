"""Tests that bielle-study does not overwrite its inputs, other files, and the runs of another study of the same
file."""

import fcntl
import glob
import os
import shlex
import signal
import subprocess
import threading
import time
import unittest

import h5py

from study_stand_in import STUDY, WithStandIn
from shares import share_of_tests as load_tests  # noqa: E402,F401

GATHER = ("--gather", "rate=max joints/main/rate")
TABLE = "speed,mass\n1,2\n2,2\n"


class Files(WithStandIn):
    def kept(self, name, text):
        with open(self.path(name), encoding="utf-8") as file:
            self.assertEqual(file.read(), text, name)

    def refused(self, part, *arguments):
        done = self.call(*arguments)
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertIn(part, done.stderr)
        self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)

    def test_no_input_is_written_over(self):
        for name in ("z-table.csv", "link-table.csv"):
            self.write("z-table.csv", TABLE)
            if name != "z-table.csv":
                os.symlink("z-table.csv", self.path(name))
            self.refused("would replace an input", "model.yaml", "z-table.csv", "-o", name.replace("-table.csv", ".h5"), *GATHER)
            self.kept("z-table.csv", TABLE)
        self.write("model.yaml", "cam: {file: w-table.csv}\n")
        self.write("w-table.csv", "0, 1\n")
        self.refused("would replace an input", "model.yaml", "z-table.csv", "-o", "w.h5", *GATHER)
        self.kept("w-table.csv", "0, 1\n")
        self.write("sweep.yaml", "model: model.yaml\ntable: z-table.csv\n")
        self.refused("would replace an input", "sweep.yaml", "-o", "z.h5", *GATHER)
        self.kept("z-table.csv", TABLE)

    def test_tables_of_others_stay(self):
        self.write("z-table.csv", "mine\n1\n")
        self.write("runs.csv", TABLE)
        self.refused("is no table of a study", "model.yaml", "runs.csv", "-o", "z.h5", *GATHER)
        self.kept("z-table.csv", "mine\n1\n")
        os.remove(self.path("z-table.csv"))
        for _ in range(2):  # its own file is replaced
            self.assertEqual(self.call("model.yaml", "runs.csv", "-o", "z.h5", *GATHER).returncode, 0)
        self.kept("z-table.csv", "run,speed,mass,status,rate\n1,1,2,0,2.0\n2,2,2,0,4.0\n")

    def test_folders_and_files_of_others_stay(self):
        self.write("runs.csv", TABLE)
        os.mkdir(self.path("out.runs"))
        for name in ("out.runs/mine", "out.h5.part", "out-table.csv.part"):
            self.write(name, "mine")
        os.mkdir(self.path("out.runs-x"))
        self.write("out.runs-x/plan.json", '{"mine": 1}')
        done = self.call("model.yaml", "runs.csv", "-o", "out.h5", "--fresh", *GATHER)
        self.assertEqual(done.returncode, 0, done.stderr)
        for name in ("out.runs/mine", "out.h5.part", "out-table.csv.part"):
            self.kept(name, "mine")
        self.kept("out.runs-x/plan.json", '{"mine": 1}')
        self.assertEqual(glob.glob(self.path("out.runs-*")), [self.path("out.runs-x")])

    def test_a_folder_of_jobs_loses_runs_alone(self):
        self.write("runs.csv", TABLE)
        schedule = ("model.yaml", "runs.csv", "-o", "out.h5", "--schedule", "jobs")
        self.assertEqual(self.call(*schedule).returncode, 0)
        self.assertEqual(self.call("--run", "jobs", "1").returncode, 0)
        self.write("jobs/notes", "mine")
        self.assertEqual(self.call(*schedule, "--fresh").returncode, 0)
        self.kept("jobs/notes", "mine")
        self.assertEqual(glob.glob(self.path("jobs/*.h5")), [])
        os.mkdir(self.path("others"))
        self.write("others/plan.json", "{}")
        self.refused("holds other things", *schedule[:-1], "others", "--fresh")
        self.kept("others/plan.json", "{}")

    def test_two_studies_of_one_file_do_not_meet(self):
        self.write("slow.csv", "speed,mass\n1,2\n1000,2\n")
        self.write("runs.csv", TABLE)
        child = subprocess.Popen(["/usr/bin/python3", "-B", STUDY, "model.yaml", "slow.csv", "-o", "out.h5", "--jobs", "1"], cwd=self.folder,
                                 env={**os.environ, "BIELLE_BIN": self.folder}, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                 start_new_session=True)
        try:
            for _ in range(600):
                if os.path.exists(self.path("log")):
                    with open(self.path("log"), encoding="utf-8") as log:
                        if "1000" in log.read():
                            break
                time.sleep(0.05)
            folder, = glob.glob(self.path("out.runs-*"))
            self.refused(f"another study is at work on '{self.path('out.h5')}' (process {child.pid}", "model.yaml", "runs.csv", "-o", "out.h5")
            self.assertEqual(self.call("model.yaml", "runs.csv", "-o", "other.h5").returncode, 0)
            self.assertEqual(len(glob.glob(folder + "/*.h5")), 1)  # the first run waits for the second
        finally:
            os.killpg(child.pid, signal.SIGKILL)
            child.wait()
        # The study continues in its folder.
        self.assertEqual(self.call("model.yaml", "runs.csv", "-o", "out.h5").returncode, 0)
        self.assertEqual(glob.glob(self.path("out.runs-*")), [])

    def test_studies_that_begin_together(self):
        self.write("runs.csv", TABLE)
        ends = []
        threads = [threading.Thread(target=lambda: ends.append(self.call("model.yaml", "runs.csv", "-o", "out.h5"))) for _ in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for done in ends:  # one after the other, or refused with a message
            self.assertTrue(done.returncode == 0 or "another study is at work" in done.stderr, done.stderr)
        self.assertIn(0, [done.returncode for done in ends])
        with h5py.File(self.path("out.h5")) as file:
            self.assertEqual(file["status"][:].tolist(), [0, 0])
        self.assertEqual(glob.glob(self.path("out.runs*")), [])

    def test_names_reach_the_scheduler_as_they_are(self):
        self.write("runs.csv", TABLE)
        done = self.call("model.yaml", "runs.csv", "-o", "a\n#SBATCH --uid=0\n b.h5", "--schedule", "jobs of %a 'x'")
        self.assertEqual(done.returncode, 0, done.stderr)
        for name in ("array.sbatch", "gather.sbatch"):
            with open(self.path(f"jobs of %a 'x'/{name}"), encoding="utf-8") as file:
                options = [line.rstrip("\n") for line in file if line.startswith("#SBATCH")]
            self.assertFalse(any("--uid" in line and not line.startswith("#SBATCH --job-name=") for line in options), options)
            for line in options:
                words = shlex.split(line[len("#SBATCH "):])
                self.assertEqual(len(words), 1, line)
                if words[0].startswith("--output="):
                    self.assertTrue(words[0].startswith("--output=" + self.path("jobs of %%a 'x'/")), line)
        self.refused("line break", "model.yaml", "runs.csv", "-o", "out.h5", "--schedule", "jobs\nof")
        self.refused("--sbatch", "model.yaml", "runs.csv", "-o", "out.h5", "--schedule", "jobs", "--sbatch=--time=1\r#SBATCH --x")

    def test_a_lock_alone_is_no_obstacle(self):
        os.mkdir(self.path("out.runs-left"))
        self.write("out.runs-left/lock", "")
        self.write("runs.csv", TABLE)
        self.assertEqual(self.call("model.yaml", "runs.csv", "-o", "out.h5").returncode, 0)
        self.assertEqual(glob.glob(self.path("out.runs*")), [])
        os.mkdir(self.path("out.runs-held"))
        with open(self.path("out.runs-held/lock"), "w", encoding="utf-8") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            self.refused("another study is at work", "model.yaml", "runs.csv", "-o", "out.h5")


if __name__ == "__main__":
    unittest.main()
