"""Events of bielle-mechanism: noted in the results file, ending runs, and the same across restarts."""

import math
import os
import re
import shutil
import unittest

import h5py
import numpy as np

from command import CommandTest
from test_long_runs import datasets

# An arm that falls on a stop again and again, with a flap that is locked for a time and clamped by a weak catch.
MODEL = """\
gravity: [0, 0, -9.81]
nodes:
  arm: {position: [0.5, 0, 0]}
  flap: {position: [1.2, 0, 0], velocity: [0, 0, 1.2], angular_velocity: [0, -6, 0]}
elements:
  arm: {type: rigid_body, node: arm, mass: 2, inertia: [0.01, 0.2, 0.2]}
  flap: {type: rigid_body, node: flap, mass: 0.3, inertia: [0.001, 0.01, 0.01]}
joints:
  main: {type: hinge, nodes: [ground, arm], position: [0, 0, 0], axis: [0, 1, 0],
         stops: {range: [~, 0.4], stiffness: 4000, damping: 20}}
  tip: {type: hinge, nodes: [arm, flap], position: [1, 0, 0], axis: [0, 1, 0],
        locked: {from: 0.1234, to: 0.6543}}
events:
  fast: {when: main.angle.rate, crosses: 2}
  level: {when: main.angle, crosses: 0.2, direction: falling}
output: {checkpoint: EVERY}
analysis:
  - {type: dynamic, duration: DURATION, step: 1e-3}
"""

# Actions: the catch opens and closes, a spring is let go and comes back, a force is set by formulas of events.
ACTIONS = """\
  again: {when: fast.count, crosses: 1.5, do: [{lock: tip}, {release: stay}, {set: {push: 2*fast.count}}]}
  later: {when: "t - again.time", crosses: 0.1, do: [{unlock: tip}, {activate: stay}, {set: {push: push - 1}}]}
inputs: {push: 0}
loads: {wind: {node: flap, force: [0, 0, push]}}
"""


class Events(CommandTest):
    program = "bielle-mechanism"

    model = MODEL

    def run_model(self, name, every, duration, *arguments):
        self.write(f"{name}.yaml", self.model.replace("EVERY", str(every)).replace("DURATION", str(duration)))
        done = self.run_program(f"{name}.yaml", *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        return int(re.search(r"(\d+) rows recorded", done.stdout)[1])

    def test_a_restarted_run_equals_the_whole_one_events_and_all(self):
        # Equality to the last bit requires the same checkpoints, since pivots are chosen anew there.
        self.run_model("whole", 70, 1.2)
        with h5py.File(os.path.join(self.folder, "whole.h5")) as whole:
            events = whole["analysis_1/events/time"][:]
            names = whole["crossings"][()].decode().splitlines()
            rows = whole["checkpoints/analysis_1/rows"][:].astype(int)
            checkpoints = len(rows)
            expected = {name: data[:] for name, data in datasets(whole["analysis_1"]).items()}
        self.assertGreater(len(events), 8)
        self.assertTrue(np.all(np.diff(events) >= 0))
        self.assertIn("joint 'main': angle at its upper stop", names)
        # Cut off after each of several checkpoints: before the lock, within, between contacts.
        for keep in (1, 3, 8, 12, checkpoints - 1):
            shutil.copy(os.path.join(self.folder, "whole.h5"), os.path.join(self.folder, "part.h5"))
            with h5py.File(os.path.join(self.folder, "part.h5"), "r+") as part:
                for data in datasets(part["checkpoints/analysis_1"]).values():
                    if data.shape and data.shape[0] == checkpoints:
                        data.resize(keep, axis=0)
                part.attrs["complete"] = 0
            recorded = self.run_model("part", 70, 1.2, "--restart", "part.h5")
            self.assertEqual(recorded, len(expected["time"]) - rows[keep - 1])
            with h5py.File(os.path.join(self.folder, "part.h5")) as part:
                self.assertEqual(part.attrs["complete"], 1)
                found = datasets(part["analysis_1"])
                self.assertEqual(sorted(found), sorted(expected))
                for name, data in found.items():
                    np.testing.assert_array_equal(data[:], expected[name], err_msg=f"{name}, {keep}")

    def test_a_restarted_run_with_actions_equals_the_whole_one(self):
        self.model = MODEL.replace("output:", ACTIONS + "output:").replace(
            "joints:", "  stay: {type: spring_damper, nodes: [ground, arm], stiffness: 20, damping: 1, length: 0.3}\njoints:")
        self.test_a_restarted_run_equals_the_whole_one_events_and_all()
        with h5py.File(os.path.join(self.folder, "whole.h5")) as whole:
            names = whole["crossings"][()].decode().splitlines()
            met = [names[int(k)] for k in whole["analysis_1/events/crossing"][:]]
            self.assertEqual(met.count("event 'again': locks 'tip', releases 'stay', sets 'push' to 2*fast.count"), 1)
            self.assertEqual(met.count("event 'later': unlocks 'tip', activates 'stay', sets 'push' to push - 1"), 1)
            # The rows show the force of the spring as zero between the two.
            time, force = whole["analysis_1/time"][:], whole["analysis_1/elements/stay/force"][:]
            events = dict(zip(met, whole["analysis_1/events/time"][:]))
            between = [moment for name, moment in events.items() if "'stay'" in name]
            off = (time > between[0] + 1e-9) & (time < between[1] - 1e-9)
            self.assertGreater(off.sum(), 50)
            self.assertTrue(np.all(force[off] == 0) and np.all(force[time < between[0]] != 0))
            np.testing.assert_array_equal(whole["measures/push"][:][time > between[1] + 1e-9], 3)

    def test_an_event_that_stops_ends_the_run_as_complete(self):
        self.write("model.yaml", """\
gravity: [0, 0, -10]
nodes: {stone: {position: [0, 0, 2], fixed: [rx, ry, rz]}}
elements: {stone: {type: point_mass, node: stone, mass: 1}}
events: {landed: {when: stone.position.z, crosses: 1.3, direction: falling, action: stop}}
analysis: [{type: dynamic, duration: 5, step: 0.1}]
""")
        done = self.run_program("model.yaml")
        self.assertEqual(done.returncode, 0, done.stderr)
        with h5py.File(os.path.join(self.folder, "model.h5")) as results:
            self.assertEqual(results.attrs["complete"], 1)
            landed = math.sqrt(0.7 / 5)  # exact for the scheme; located to 1e-10 of a step
            self.assertAlmostEqual(results["analysis_1/time"][-1], landed, delta=2e-11)
            self.assertEqual(results["analysis_1/events/time"][:].tolist(), [results["analysis_1/time"][-1]])
            name = results["crossings"][()].decode().splitlines()[int(results["analysis_1/events/crossing"][0])]
            self.assertEqual(name, "event 'landed'")


if __name__ == "__main__":
    unittest.main()
