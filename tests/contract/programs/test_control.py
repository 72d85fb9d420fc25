"""Tests of states and controllers in the files of bielle-mechanism: rows, restarts, and messages of refusals."""

import os
import unittest

import h5py
import numpy as np

from command import CommandTest
from equal_runs import end_at_checkpoint, expect_equal_runs

MODEL = """\
gravity: [0, -9.81, 0]
nodes: {arm: {position: [0.5, 0, 0]}}
elements: {arm: {type: rigid_body, node: arm, mass: 2, inertia: [0.1, 0.1, 0.1]}}
joints: {main: {type: hinge, nodes: [ground, arm], position: [0, 0, 0], axis: [0, 0, 1]}}
states:
  seen: {filter: main.angle, time_constant: 0.005}
  plant: {state_space: {A: [[-8, 2], [0, -3]], B: [[1], [1]]}, inputs: [seen], units: [rad, N]}
  way: {rate: "abs(main.angle.rate)", units: rad}
drives:
  motor: {joint: main, pid: {measure: seen, target: 0.6, kp: 60, ki: 90, kd: 8, filter: 0.01, limit: 16}, release: 0.9}
output: {checkpoint: EVERY}
analysis:
  - {type: dynamic, duration: 1.2, step: 2e-3}
"""


class Control(CommandTest):
    program = "bielle-mechanism"

    def run_model(self, name, every, *arguments, old="EVERY", new=""):
        self.assertIn(old, MODEL)
        self.write(f"{name}.yaml", MODEL.replace("EVERY", str(every)).replace(old, new))
        return self.run_program(f"{name}.yaml", *arguments)

    def test_states_are_recorded_as_measures(self):
        self.assertEqual(self.run_model("run", 1000).returncode, 0)
        with h5py.File(os.path.join(self.folder, "run.h5")) as file:
            count = len(file["time"])
            self.assertEqual(file["measures/seen"].attrs["units"], "rad")
            self.assertEqual(file["measures/plant.y2"].attrs["units"], "N")
            rate = file["joints/main/rate"][:count, 0]
            way = file["measures/way"][:count]
            # The path is the trapezoidal sum of the recorded rates, with errors of h^2/12 at their kinks.
            np.testing.assert_allclose(way[-1], np.sum(np.abs(rate[1:]) + np.abs(rate[:-1])) * 1e-3, rtol=1e-4)
            self.assertNotIn("states", file)
            torque = file["joints/main/drive_force"][:count, 0]
            self.assertEqual(np.abs(torque).max(), 16)
            self.assertEqual(torque[-1], 0)

    def test_a_restarted_run_equals_the_whole_one(self):
        self.assertEqual(self.run_model("whole", 50).returncode, 0)
        with h5py.File(self.path("whole.h5")) as file:
            checkpoints = len(file["checkpoints/analysis_1/rows"])
        for keep in (2, 8, checkpoints - 1):
            end_at_checkpoint(self.path("whole.h5"), self.path("part.h5"), keep)
            done = self.run_model("part", 50, "--restart", "part.h5")
            self.assertEqual(done.returncode, 0, done.stderr)
            expect_equal_runs(self.path("part.h5"), self.path("whole.h5"), f"after {keep} checkpoints")

    def test_a_restart_notices_another_controller(self):
        self.assertEqual(self.run_model("run", 100).returncode, 0)
        for old, new, name in (("[0, -3]", "[0, -4]", "'plant'"), ("time_constant: 0.005", "time_constant: 0.006", "'seen'"),
                               ("kp: 60", "kp: 61", "'motor'"), ("release: 0.9", "release: 1", "'motor'"),
                               ("limit: 16", "limit: 17", "'motor'")):
            done = self.run_model("other", 100, "--restart", "run.h5", old=old, new=new)
            self.assertEqual(done.returncode, 1, done.stdout)
            self.assertIn(f"{name} differs", done.stderr)

    def refuse(self, old, new, *says):
        self.assertIn(old, MODEL)
        self.write("model.yaml", MODEL.replace("EVERY", "10").replace(old, new))
        self.expect_refusal(1, "model.yaml", says=says)

    def test_slips(self):
        self.refuse("filter: main.angle", "filter: main.angel", "model.yaml:6: states.seen.filter: ", "did you mean 'angle'")
        self.refuse("time_constant: 0.005", "time_constant: -1", "model.yaml:6: states.seen.time_constant: ", "at least 0")
        self.refuse("B: [[1], [1]]", "B: [[1, 1]]", "model.yaml:7: states.plant.state_space.B")
        self.refuse("rate: ", "rat: ", "model.yaml:8: states.way: 'rat' is not a key of a state", "did you mean 'rate'")
        self.refuse("measure: seen", "measure: plant.y3", "model.yaml:10: drives.motor.pid.measure: ", "'plant' has no 'y3'")
        self.refuse("filter: 0.01, ", "", "model.yaml:10: drives.motor.pid.measure: ", "rate that is not known", "`filter`")
        self.refuse("limit: 16", "limit: [16, -16]", "drives.motor.pid.limit: expected the lower limit first")
        self.refuse("release: 0.9", "release: {event: landed}", "drives.motor.release.event: there is no 'landed' among the events")
        self.refuse("joint: main, ", "joint: main, limit: 3, ", "drives.motor.limit: stands within `pid`")


if __name__ == "__main__":
    unittest.main()
