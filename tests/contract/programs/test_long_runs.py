"""Tests of long runs of bielle-mechanism: killed, interrupted, continued and logged ones, and constant memory.

BIELLE_STEPS is the number of steps of the run whose memory is watched (default 40 000; the long test takes a million).
"""

import csv
import os
import re
import signal
import subprocess
import time
import unittest

import h5py
import numpy as np

from command import PROGRAMS, CommandTest
from equal_runs import datasets, expect_equal_runs

MODEL = """\
mechanism: double pendulum
gravity: [0, 0, -9.81]
nodes:
  upper: {position: [0.5, 0, 0]}
  lower: {position: [1.5, 0, 0]}
elements:
  upper: {type: rigid_body, node: upper, mass: 2, inertia: [0.01, 0.2, 0.2]}
  lower: {type: rigid_body, node: lower, mass: 1, inertia: [0.01, 0.1, 0.1]}
joints:
  shoulder: {type: hinge, nodes: [ground, upper], position: [0, 0, 0], axis: [0, 1, 0]}
  elbow: {type: hinge, nodes: [upper, lower], position: [1, 0, 0], axis: [0, 1, 0]}
output: {checkpoint: 500}
analysis:
  - {type: dynamic, duration: DURATION, step: 1e-3}
"""


class LongRuns(CommandTest):
    program = "bielle-mechanism"

    def start(self, *arguments):
        return subprocess.Popen([os.path.join(PROGRAMS, self.program), *arguments], cwd=self.folder,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def wait_for_checkpoints(self, run, count):
        """Waits until the file of the running program has this number of checkpoints; other programs may read it at any
        time."""
        until = time.monotonic() + 60
        while time.monotonic() < until and run.poll() is None:
            try:
                with h5py.File(os.path.join(self.folder, "model.h5"), "r", locking=False) as results:
                    if results["checkpoints/analysis_1/rows"].shape[0] >= count:
                        return
            except (OSError, KeyError, RuntimeError):
                pass
            time.sleep(0.02)
        self.fail("the run wrote no checkpoints, or ended before")

    def test_a_killed_run_keeps_its_steps_and_goes_on_as_if_nothing_had_happened(self):
        self.write("model.yaml", MODEL.replace("DURATION", "30"))
        run = self.start("model.yaml", "--quiet")
        self.wait_for_checkpoints(run, 3)
        run.send_signal(signal.SIGKILL)
        run.communicate()
        self.assertEqual(run.returncode, -signal.SIGKILL)
        with h5py.File(os.path.join(self.folder, "model.h5")) as results:
            self.assertEqual(results.attrs["complete"], 0)
            group = results["analysis_1"]
            rows = group["time"].shape[0]
            self.assertGreater(rows, 1000)
            np.testing.assert_allclose(group["time"][:], 1e-3 * np.arange(rows), atol=1e-9)
            for name, dataset in datasets(group).items():
                self.assertGreaterEqual(dataset.shape[0], rows, name)
            # Every row is a valid state: the rod has its length, also in the last row.
            ends = group["nodes/upper/position"][:rows]
            np.testing.assert_allclose(np.linalg.norm(ends, axis=1), 0.5, atol=1e-9)
        done = self.run_program("model.yaml", "--restart", "model.h5")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.write("whole.yaml", MODEL.replace("DURATION", "30"))
        self.assertEqual(self.run_program("whole.yaml", "--quiet").returncode, 0)
        expect_equal_runs(self.path("model.h5"), self.path("whole.h5"))

    def test_an_interrupted_run_says_how_to_go_on_and_the_summary_counts_what_it_did(self):
        self.write("model.yaml", MODEL.replace("DURATION", "30"))
        run = self.start("model.yaml")
        self.wait_for_checkpoints(run, 2)
        run.send_signal(signal.SIGINT)
        _, errors = run.communicate(timeout=60)
        self.assertEqual(run.returncode, 2)
        self.assertRegex(errors, r"interrupted at t = .*--restart model\.h5")
        with h5py.File(os.path.join(self.folder, "model.h5")) as results:
            done = results["analysis_1/time"].shape[0] - 1
        rest = self.run_program("model.yaml", "--restart", "model.h5")
        self.assertEqual(rest.returncode, 0, rest.stderr)
        counts = re.search(r"(\d+) steps, .* (\d+) rows recorded", rest.stdout)
        self.assertEqual(int(counts[1]), 30000 - done)
        self.assertEqual(int(counts[2]), 30000 - done)

    def test_a_log_of_all_steps_on_request(self):
        self.write("model.yaml", MODEL.replace("DURATION, step: 1e-3", "1, step: 0.02, tolerance: 1e-6")
                   .replace("checkpoint: 500", "log: true"))
        done = self.run_program("model.yaml")
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(os.path.join(self.folder, "model.steps.csv"), newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        accepted = [row for row in rows if row["outcome"] == "accepted"]
        refused = [row for row in rows if row["outcome"] == "local error too large"]
        self.assertTrue(refused)
        self.assertTrue(all(float(row["error over tolerance"]) >= 1 for row in refused))
        self.assertTrue(all(float(row["residual over tolerance"]) <= 1 for row in accepted))
        self.assertTrue(any(re.search(r"of joint|at node", row["equation"]) for row in accepted))
        with h5py.File(os.path.join(self.folder, "model.h5")) as results:
            names = results["equations"][()].decode().splitlines()
            worst = results["solver/worst_equation"][1:].astype(int)
            times = results["time"][1:]
        self.assertEqual(len(accepted), len(times))
        for row, equation, when in zip(accepted, worst, times):
            self.assertAlmostEqual(float(row["time [s]"]), when, places=9)
            if equation >= 0:
                self.assertEqual(f"{row['equation']} [{row['units']}]", names[equation])
        self.assertIn(f"{len(refused)} steps refused for the local error", done.stdout)

    def test_a_run_does_not_grow(self):
        steps = int(os.environ.get("BIELLE_STEPS", "200000"))
        self.write("model.yaml", MODEL.replace("DURATION", f"{steps * 1e-3}").replace("checkpoint: 500", "every: 2, log: true"))
        run = self.start("model.yaml", "--quiet")
        sizes = []  # (rows recorded, resident memory in kB)
        while run.poll() is None:
            try:
                with h5py.File(os.path.join(self.folder, "model.h5"), "r", locking=False) as results:
                    rows = results["analysis_1/time"].shape[0]
                with open(f"/proc/{run.pid}/status", encoding="ascii") as status:
                    sizes.append((rows, int(re.search(r"VmRSS:\s+(\d+) kB", status.read())[1])))
            except (OSError, KeyError, RuntimeError, TypeError):
                pass
            time.sleep(0.02)
        _, errors = run.communicate()
        self.assertEqual(run.returncode, 0, errors)
        early = [size for rows, size in sizes if 0.1 * steps / 2 < rows < 0.4 * steps / 2]
        late = [size for rows, size in sizes if rows > 0.8 * steps / 2]
        self.assertTrue(early and late, sizes)
        # The buffers of rows vary by some MB; a leak of a thousandth of the written rows would exceed this bound.
        self.assertLess(np.median(late), np.median(early) + 4000, sizes)


if __name__ == "__main__":
    unittest.main()
