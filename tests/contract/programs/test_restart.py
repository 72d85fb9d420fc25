"""Tests of continued runs: they need the same model, equal uninterrupted runs to the last bit, and record no step twice
in the table of steps."""

import os
import signal
import subprocess
import time
import unittest

import h5py
import numpy as np

from command import PROGRAMS, CommandTest
from equal_runs import expect_equal_runs
from shares import share

# This model contains features that a later part of the motion may meet and that the probing state of a checkpoint does
# not show.
MODEL = """\
parameters: {push: 40, k: 3, duration: 0.15}
gravity: [0, 0, -9.81]
nodes:
  arm: {position: [1, 0, 0]}
  ball: {position: [3, 0, 0.3]}
  slide: {position: [5, 0, 0], fixed: [y, z, rx, ry, rz]}
elements:
  arm: {type: rigid_body, node: arm, mass: 1, inertia: [0.01, 0.01, 0.01]}
  ball: {type: rigid_body, node: ball, solid: {sphere: 0.1, density: 1000}}
  slide: {type: point_mass, node: slide, mass: 1}
joints:
  pin: {type: hinge, nodes: [ground, arm], axis: [0, 1, 0], position: [0, 0, 0], stops: {range: [-1, 1], stiffness: 1e4, damping: k}}
  floor: {type: contact, shapes: [{node: ground, plane: [0, 0, 1]}, {node: ball, sphere: 0.1}], stiffness: 1e6, restitution: 0.5}
drives: {motor: {joint: pin, torque: "k*step(t, 0.2, 0.25)", limit: 10}}
loads: {later: {node: arm, force: [0, 0, "push*pulse(t, 0.2, 0.3)"]}, table: {node: slide, force: ["table('pull.csv', t)", 0, 0]}}
states: {late: {rate: "if(t > 0.2, 1, 0)"}}
events: {far: {when: slide.position.x, crosses: 5.1, action: note}}
measures: {height: ball.position.z}
analysis: [{type: dynamic, duration: duration, step: 0.001}]
output: {every: 1, checkpoint: 20}
"""

TABLE = "0, 0\n0.2, 0\n1, 5\n"

# The model has sticking friction, bristles, stops, a bouncing contact, control, an event, and variable steps.
RICH = """\
gravity: [0, 0, -9.81]
nodes:
  upper: {position: [0.5, 0, 0]}
  lower: {position: [1.5, 0, 0]}
  slide: {position: [5, 0, 0], velocity: [1, 0, 0], fixed: [y, z, rx, ry, rz]}
  ball: {position: [3, 0, 0.5]}
elements:
  upper: {type: rigid_body, node: upper, mass: 1, inertia: [0.01, 0.1, 0.1]}
  lower: {type: rigid_body, node: lower, mass: 1, inertia: [0.01, 0.1, 0.1]}
  slide: {type: point_mass, node: slide, mass: 1}
  spring: {type: spring_damper, nodes: [ground, slide], stiffness: 500, length: 5}
  ball: {type: rigid_body, node: ball, solid: {sphere: 0.1, density: 1000}}
joints:
  shoulder: {type: hinge, nodes: [ground, upper], axis: [0, 1, 0], position: [0, 0, 0], friction: {coefficient: 0.3, radius: 0.02, model: stick_slip}}
  elbow: {type: hinge, nodes: [upper, lower], axis: [0, 1, 0], position: [1, 0, 0], stops: {range: [-1, 1], stiffness: 1e4, damping: 10}}
  floor: {type: contact, shapes: [{node: ground, plane: [0, 0, 1]}, {node: ball, sphere: 0.1}], stiffness: 1e6, restitution: 0.7,
          friction: {coefficient: 0.3, model: lugre, bristle_stiffness: 1e3, bristle_damping: 1}}
states: {lag: {rate: "-lag + slide.position.x"}, slow: {filter: shoulder.angle, frequency: 5}}
drives: {servo: {joint: elbow, pid: {target: "0.3*sin(5*t)", kp: 30, ki: 10, kd: 1, limit: 20}}}
events: {far: {when: slide.position.x, crosses: 5.01}}
analysis: [ANALYSIS]
output: {every: 1, checkpoint: 25, log: true}
"""

# A massless shaft drives two wheels through friction that sticks and slips; their teeth have play and rattle. The model
# contains counted angles, memory and many events.
GEARS = """\
nodes:
  shaft: {}
  first: {}
  second: {position: [0.1, 0, 0]}
elements:
  first: {type: rigid_body, node: first, mass: 1, inertia: [1e-3, 1e-3, 1e-3]}
  second: {type: rigid_body, node: second, mass: 2, inertia: [4e-3, 4e-3, 4e-3]}
joints:
  crank: {type: hinge, nodes: [ground, shaft], axis: [0, 0, 1]}
  plates: {type: hinge, nodes: [shaft, first], axis: [0, 0, 1], friction: {model: stick_slip, coefficient: 0.3, radius: 0.05, preload: 40}}
  middle: {type: hinge, nodes: [ground, second], axis: [0, 0, 1], damping: 0.002}
  teeth: {type: gear_mesh, nodes: [first, second], axes: [0, 0, 1], radii: [0.04, 0.06], stiffness: 2e6, damping: 50, backlash: 1e-4}
drives: {engine: {joint: crank, rate: "20*sin(40*t)"}}
analysis: [{type: dynamic, duration: 0.4, step: 2e-4}]
output: {every: 5, checkpoint: 100, log: true}
"""


class SameModel(CommandTest):
    program = "bielle-mechanism"

    def setUp(self):
        super().setUp()
        self.write("pull.csv", TABLE)
        self.write("model.yaml", MODEL)
        done = self.run_program("model.yaml", "-o", "first.h5", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)

    def go_on(self, model, *arguments):
        self.write("other.yaml", model)
        return self.run_program("other.yaml", "--restart", "first.h5", "-o", "on.h5", "--quiet", *arguments)

    def test_every_other_model_is_refused_by_the_name_of_what_differs(self):
        for old, new, says in (
                ("stiffness: 1e4", "stiffness: 1e5", "joints.pin.stops.stiffness was 10000 and is 100000"),
                ("damping: k", "damping: 4", "joints.pin.stops.damping was k (k = 3) and is 4"),
                ("k: 3", "k: 4", "drives.motor.torque was k*step(t, 0.2, 0.25) (k = 3) and is k*step(t, 0.2, 0.25) (k = 4); "
                                 "joints.pin.stops.damping was k (k = 3) and is k (k = 4)"),
                ("push: 40", "push: 41", "loads.later.force[3] was push*pulse(t, 0.2, 0.3) (push = 40) and is"),
                ("0.2, 0.25)", "0.2, 0.3)", "drives.motor.torque was k*step(t, 0.2, 0.25) (k = 3) and is k*step(t, 0.2, 0.3) (k = 3)"),
                ("limit: 10", "limit: 20", "drives.motor.limit was 10 and is 20"),
                (", limit: 10", "", "drives.motor.limit was 10 and is not given"),
                ("restitution: 0.5", "restitution: 0.6", "joints.floor.restitution was 0.5 and is 0.6"),
                ("1e6, restitution: 0.5", "1e6", "joints.floor.restitution was 0.5 and is not given"),
                ("restitution: 0.5", "restitution: 0.5, friction: {coefficient: 0.2}", "joints.floor.friction.coefficient was not given"),
                ("t > 0.2", "t > 0.3", "states.late.rate was if(t > 0.2, 1, 0) and is if(t > 0.3, 1, 0)"),
                ("action: note", "action: stop", "events.far.action was note and is stop"),
                ("crosses: 5.1", "crosses: 5.2", "events.far.crosses was 5.1 and is 5.2"),
                ("measures: {height", "measures: {depth: 0 - height, height", "measures.depth is new"),
                ("loads: {later", "loads: {new: {node: arm, force: [0, 0, 0]}, later", "loads.new is new"),
                ("events: {far: {when: slide.position.x, crosses: 5.1, action: note}}\n", "", "events.far is gone"),
                ("mass: 1}", "mass: 2}", "elements.slide.mass was 1 and is 2"),
                ("position: [1, 0, 0]}", "position: [1, 0, 0], velocity: [0, 0, 1]}", "nodes.arm.velocity[1] was not given"),
                ("-9.81", "-9.8", "gravity[3] was -9.81 and is -9.8"),
                ("nodes: [ground, arm]", "nodes: [arm, ground]", "joints.pin.nodes[1] was ground and is arm; joints.pin.nodes[2]")):
            with self.subTest(new=new):
                self.assertIn(old, MODEL)
                self.write("other.yaml", MODEL.replace(old, new, 1))
                self.expect_refusal(1, "other.yaml", "--restart", "first.h5", "-o", "on.h5", says=["first.h5: is of another model: ", " differs: ", says])

    def test_a_file_that_the_model_names_counts_by_its_contents(self):
        self.write("pull.csv", TABLE.replace("5", "6"))
        self.expect_refusal(1, "model.yaml", "--restart", "first.h5", "-o", "on.h5", says=["loads.table.force[1] was table('pull.csv', t)"])
        self.write("pull.csv", TABLE)
        self.assertEqual(self.go_on(MODEL).returncode, 0)

    def test_values_of_the_command_line_count(self):
        self.write("other.yaml", MODEL)
        self.expect_refusal(1, "other.yaml", "--restart", "first.h5", "-o", "on.h5", "--set", "push=41", says=["loads.later.force[3]"])

    def test_what_may_differ(self):
        same = MODEL.replace("stiffness: 1e4, damping: k", "damping: k, stiffness: 10000.0").replace("gravity", "# a comment\ngravity")
        for model, *arguments in (
                (MODEL, "--set", "duration=0.2"), (MODEL.replace("duration: 0.15", "duration: 0.3"),), (same,), ("mechanism: a\n" + MODEL,),
                (MODEL.replace("step: 0.001", "step: 0.002, scheme: hht, newton: {tolerance: 1e-8}"),),
                (MODEL.replace("step: 0.001", "step: 0.001, tolerance: 1e-5"),),
                (MODEL.replace("checkpoint: 20", "checkpoint: 7, log: true").replace("every: 1", "every: 5"),)):
            with self.subTest(model=model, arguments=arguments):
                done = self.go_on(model, *arguments)
                self.assertEqual(done.returncode, 0, done.stderr)

    def test_entries_in_another_order_are_another_model(self):
        arm, ball = MODEL.splitlines(True)[3:5]
        self.write("other.yaml", MODEL.replace(arm + ball, ball + arm))
        self.expect_refusal(1, "other.yaml", "--restart", "first.h5", "-o", "on.h5", says=["differs, or stands in another place"])


class SameMotion(CommandTest):
    program = "bielle-mechanism"

    def end_early(self, name, number, count):
        """Runs the model until it has written a number of checkpoints, and ends it by a signal."""
        for path in (name, name.replace(".h5", ".steps.csv")):
            if os.path.exists(self.path(path)):
                os.remove(self.path(path))
        run = subprocess.Popen([os.path.join(PROGRAMS, self.program), "model.yaml", "-o", name, "--quiet"], cwd=self.folder,
                               stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        until = time.monotonic() + 60
        there = 0
        while there < count and time.monotonic() < until and run.poll() is None:
            try:
                with h5py.File(self.path(name), "r", locking=False) as results:
                    there = results["checkpoints/analysis_1/rows"].shape[0]
            except (OSError, KeyError, RuntimeError):
                pass
        run.send_signal(number)
        errors = run.communicate(timeout=60)[1]
        self.assertEqual(run.returncode, 2 if number != signal.SIGKILL else -number, errors)

    def check_same(self, name, whole="whole.h5"):
        expect_equal_runs(self.path(name), self.path(whole), name)
        tables = []
        for path in (name, whole):
            with open(self.path(path.replace(".h5", ".steps.csv")), encoding="utf-8") as file:
                tables.append(file.read())
        self.assertEqual(tables[0], tables[1], name)

    def test_to_the_bit_after_any_end(self):
        signals = (signal.SIGTERM, signal.SIGINT, signal.SIGKILL)
        taken = share([(fixed, number) for number in signals for fixed in (False, True)])
        for fixed, analysis in enumerate(("{type: dynamic, duration: 3, tolerance: 1e-6, largest_step: 0.002}", "{type: dynamic, duration: 2, step: 1e-3}")):
            self.write("model.yaml", RICH.replace("ANALYSIS", analysis))
            self.assertEqual(self.run_program("model.yaml", "-o", "whole.h5", "--quiet").returncode, 0)
            for number in (number for step, number in taken if step == fixed):
                with self.subTest(analysis=analysis, number=number):
                    self.end_early("cut.h5", number, 4)
                    done = self.run_program("model.yaml", "--restart", "cut.h5", "-o", "on.h5", "--quiet")
                    self.assertEqual(done.returncode, 0, done.stderr)
                    self.check_same("on.h5")
                    done = self.run_program("model.yaml", "--restart", "cut.h5", "-o", "cut.h5", "--quiet")
                    self.assertEqual(done.returncode, 0, done.stderr)
                    self.check_same("cut.h5")

    def test_gears_with_play_to_the_bit(self):
        self.write("model.yaml", GEARS)
        self.assertEqual(self.run_program("model.yaml", "-o", "whole.h5", "--quiet").returncode, 0)
        with h5py.File(self.path("whole.h5")) as file:
            self.assertGreater(len(file["analysis_1/events/time"]), 20)
        for number in (signal.SIGTERM, signal.SIGKILL):
            with self.subTest(number=number):
                self.end_early("cut.h5", number, 3)
                done = self.run_program("model.yaml", "--restart", "cut.h5", "-o", "cut.h5", "--quiet")
                self.assertEqual(done.returncode, 0, done.stderr)
                self.check_same("cut.h5")

    def test_interrupted_twice(self):
        self.write("model.yaml", RICH.replace("ANALYSIS", "{type: dynamic, duration: 2, step: 1e-3}").replace("checkpoint: 25", "checkpoint: 400"))
        self.assertEqual(self.run_program("model.yaml", "-o", "whole.h5", "--quiet").returncode, 0)
        # The run ends before or soon after the first checkpoint that follows that of the start.
        self.end_early("cut.h5", signal.SIGTERM, 1)
        for _ in range(2):
            run = subprocess.Popen([os.path.join(PROGRAMS, self.program), "model.yaml", "--restart", "cut.h5", "-o", "cut.h5", "--quiet"],
                                   cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            time.sleep(0.15)
            run.send_signal(signal.SIGTERM)
            run.wait()
        if run.returncode != 0:
            self.assertEqual(self.run_program("model.yaml", "--restart", "cut.h5", "-o", "cut.h5", "--quiet").returncode, 0)
        self.check_same("cut.h5")

    def test_other_steps_go_on_from_where_the_run_was_interrupted(self):
        self.write("model.yaml", RICH.replace("ANALYSIS", "{type: dynamic, duration: 2, step: 1e-3}").replace("checkpoint: 25", "checkpoint: 300"))
        self.end_early("cut.h5", signal.SIGTERM, 2)
        with h5py.File(self.path("cut.h5")) as file:
            time_there = file["time"][:]
        self.write("model.yaml", RICH.replace("ANALYSIS", "{type: dynamic, duration: 2, step: 5e-4}").replace("checkpoint: 25", "checkpoint: 300"))
        done = self.run_program("model.yaml", "--restart", "cut.h5", "-o", "cut.h5", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        with h5py.File(self.path("cut.h5")) as file:
            np.testing.assert_array_equal(file["time"][:len(time_there)], time_there)
            self.assertTrue(np.all(np.diff(file["time"][:]) > 0))
            self.assertAlmostEqual(file["time"][-1], 2, places=12)


class Damaged(CommandTest):
    program = "bielle-mechanism"

    def test_a_checkpoint_without_sums_is_judged_number_by_number(self):
        self.write("model.yaml", RICH.replace("ANALYSIS", "{type: dynamic, duration: 0.1, step: 1e-3}"))
        self.assertEqual(self.run_program("model.yaml", "-o", "good.h5", "--quiet").returncode, 0)
        with h5py.File(self.path("good.h5"), "r+") as file:
            for name in ("checksum", "rows_checksum"):
                del file[f"checkpoints/analysis_1/{name}"]
            good = file["checkpoints/analysis_1/state"][-1]
        self.write("model.yaml", RICH.replace("ANALYSIS", "{type: dynamic, duration: 0.12, step: 1e-3}"))
        random = np.random.default_rng(7)
        refused, taken = 0, share([(value, place) for value in (np.nan, np.inf, -1e300, 0.5, 1e18) for place in random.integers(len(good), size=6)])
        for value, place in taken:
            with h5py.File(self.path("good.h5"), "r+") as file:
                changed = good.copy()
                changed[place] = value
                file["checkpoints/analysis_1/state"][-1] = changed
            done = self.run_program("model.yaml", "--restart", "good.h5", "-o", "on.h5", "--quiet")
            self.assertIn(done.returncode, (0, 1, 2), f"number {place} = {value}: {done.stderr}")
            self.assertNotIn("unforeseen", done.stderr)
            refused += done.returncode == 1
        self.assertGreater(3 * refused, len(taken))


if __name__ == "__main__":
    unittest.main()
