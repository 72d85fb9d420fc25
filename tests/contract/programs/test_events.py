"""Tests of events of bielle-mechanism: they are recorded in the results file, end runs, and are the same after
restarts."""

import math
import os
import re
import unittest

import h5py
import numpy as np

from command import CommandTest
from equal_runs import end_at_checkpoint, expect_equal_runs

# An arm falls on a stop repeatedly; its flap is locked for a time, and clamped by a weak catch.
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

# The catch opens and closes, a spring is released and activated, and formulas of events set a force.
ACTIONS = """\
  again: {when: fast.count, crosses: 1.5, do: [{lock: tip}, {release: stay}, {set: {push: 2*fast.count}}]}
  later: {when: "t - again.time", crosses: 0.1, do: [{unlock: tip}, {activate: stay}, {set: {push: push - 1}}]}
inputs: {push: 0}
loads: {wind: {node: flap, force: [0, 0, push]}}
"""


# A valve sticks at 0.3 from the beginning, although its command would open it.
VALVE = """\
hydraulics:
  fluid: {density: 850, viscosity: 0.04, bulk_modulus: 1.4e9}
  supplies: {pump: {pressure: 4101325}, tank: {pressure: 101325}}
  volumes: {v: {volume: 1e-4, pressure: 1e6}}
  lines:
    gate: {from: pump, to: v, valve: {area: 1e-6, command: "0.3 + 0.6*min(t/0.1, 1)", DYNAMICS}}
    out: {from: v, to: tank, orifice: {area: 1e-6}}
events:
  stuck: {when: t, crosses: 0, direction: rising, at_start: true, do: [{lock: gate}]}
  free: {when: t, crosses: 0.2, do: [{unlock: gate}]}
measures: {opening: gate.opening}
analysis: [{type: dynamic, duration: 0.4, step: 1e-3}]
"""

BALL = """\
gravity: [0, 0, -10]
nodes: {ball: {position: [0, 0, HEIGHT], velocity: [0, 0, SPEED]}}
elements: {ball: {type: point_mass, node: ball, mass: 1}}
events: {low: {when: ball.position.z, crosses: 0.1, direction: DIRECTION, at_start: true, ACTION}}
analysis: [{type: dynamic, duration: 0.1, step: 0.01}ANALYSIS]
"""


class Start(CommandTest):
    """Tests of events whose values are reached when a motion begins."""

    program = "bielle-mechanism"

    def times(self, model, analysis="analysis_1"):
        text = self.summary(model)
        with h5py.File(os.path.join(self.folder, "model.h5")) as file:
            return text, list(file[analysis + "/events/time"]) if analysis + "/events" in file else []

    def ball(self, height, speed=0, direction="falling", action="action: note", analysis=""):
        return self.times(BALL.replace("HEIGHT", str(height)).replace("SPEED", str(speed)).replace("DIRECTION", direction)
                          .replace("ACTION", action).replace("ANALYSIS", analysis), "analysis_2" if analysis else "analysis_1")

    def test_a_valve_is_locked_from_the_start(self):
        for dynamics in ("time_constant: 0", "time_constant: 0.01", "frequency: 40"):
            with self.subTest(dynamics):
                _, times = self.times(VALVE.replace("DYNAMICS", dynamics))
                self.assertEqual(times[0], 0)
                self.assertAlmostEqual(times[1], 0.2, delta=1e-9)
                with h5py.File(os.path.join(self.folder, "model.h5")) as file:
                    time, opening = file["time"][:], file["measures/opening"][:]
                np.testing.assert_allclose(opening[time < 0.2], 0.3, rtol=0, atol=1e-12)
                self.assertAlmostEqual(opening[-1], 0.9, delta=1e-3)

    def test_a_value_that_is_reached_or_passed_counts_on_its_side(self):
        for height, direction, expected in ((0.1, "falling", 1), (0.05, "falling", 1), (0.1, "rising", 1), (0.3, "rising", 1),
                                            (0.3, "falling", 0), (0.05, "rising", 0)):
            with self.subTest(height=height, direction=direction):
                _, times = self.ball(height, direction=direction)
                self.assertEqual(times, [0] * expected)

    def test_it_occurs_at_each_later_crossing_and_at_the_start_of_each_motion(self):
        _, times = self.ball(0.1, 0.25)  # the value rises first, and returns after 0.05 s
        self.assertEqual(times[0], 0)
        self.assertAlmostEqual(times[1], 0.05, delta=1e-6)
        _, times = self.ball(0.05, analysis=", {type: dynamic, duration: 0.1, step: 0.01}")
        self.assertEqual(times, [0.1])
        _, times = self.ball(0.05, action="action: note, once: true", analysis=", {type: dynamic, duration: 0.1, step: 0.01}")
        self.assertEqual(times, [])

    def test_a_run_may_end_where_it_begins(self):
        for action in ("action: stop", "do: [{stop: true}]"):
            text, times = self.ball(0.05, action=action)
            self.assertEqual(times, [0])
            self.assertIn("which stopped the run", text)

    def test_gears_close_at_the_start_with_an_impulse(self):
        # The rates 10 rad/s and 0 become w and r w, with J_a (w - 10) + r J_b r w = 0.
        text, times = self.times("""\
nodes: {a: {angular_velocity: [0, 0, 10]}, b: {position: [1, 0, 0]}}
elements:
  a: {type: rigid_body, node: a, mass: 1, inertia: [0.02, 0.02, 0.02]}
  b: {type: rigid_body, node: b, mass: 1, inertia: [0.05, 0.05, 0.05]}
joints:
  ha: {type: hinge, nodes: [ground, a], axis: [0, 0, 1]}
  hb: {type: hinge, nodes: [ground, b], position: [1, 0, 0], axis: [0, 0, 1]}
  g: {type: gear, joints: [ha, hb], ratio: -2, active: false}
events: {e: {when: t, direction: rising, at_start: true, do: [{activate: g}]}}
measures: {wa: ha.angle.rate, wb: hb.angle.rate}
analysis: [{type: dynamic, duration: 0.05, step: 0.001}]
""")
        self.assertEqual(times, [0])
        with h5py.File(os.path.join(self.folder, "model.h5")) as file:
            first, second, lost = file["measures/wa"][-1], file["measures/wb"][-1], file["energy/dissipated"][-1]
            balance = file["energy/balance"][-1]
        ratio = second / first
        speed = 0.02 * 10 / (0.02 + 0.05 * ratio**2)
        self.assertAlmostEqual(abs(ratio), 0.5 if abs(ratio) < 1 else 2, places=9)
        self.assertAlmostEqual(first, speed, places=8)
        self.assertAlmostEqual(lost, 1 - 0.5 * (0.02 + 0.05 * ratio**2) * speed**2, places=8)
        self.assertLess(abs(balance), 1e-9)

    def test_both_directions_are_refused(self):
        ball = BALL.replace("HEIGHT", "1").replace("SPEED", "0").replace("ACTION", "action: note").replace("ANALYSIS", "")
        self.write("model.yaml", ball.replace("DIRECTION", "both"))
        self.expect_refusal(1, "model.yaml", says=("model.yaml:4: events.low.at_start: needs `direction: rising` or `falling`",))
        for value in ("maybe", "[true]", "2"):
            self.write("model.yaml", ball.replace("at_start: true", f"at_start: {value}").replace("DIRECTION", "rising"))
            self.expect_refusal(1, "model.yaml", says=("model.yaml:4: events.low.at_start",))


class Events(CommandTest):
    program = "bielle-mechanism"

    model = MODEL

    def run_model(self, name, every, duration, *arguments):
        self.write(f"{name}.yaml", self.model.replace("EVERY", str(every)).replace("DURATION", str(duration)))
        done = self.run_program(f"{name}.yaml", *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        return int(re.search(r"(\d+) rows recorded", done.stdout)[1])

    def test_a_restarted_run_equals_the_whole_one_events_and_all(self):
        # Results are equal to the last bit only with the same checkpoints, since pivots are chosen again there.
        self.run_model("whole", 70, 1.2)
        with h5py.File(self.path("whole.h5")) as whole:
            events = whole["analysis_1/events/time"][:]
            names = whole["crossings"][()].decode().splitlines()
            rows = whole["checkpoints/analysis_1/rows"][:].astype(int)
            recorded = len(whole["analysis_1/time"])
        self.assertGreater(len(events), 8)
        self.assertTrue(np.all(np.diff(events) >= 0))
        self.assertIn("joint 'main': angle at its upper stop", names)
        # The run ends after each of several checkpoints: before the lock, during it, between contacts.
        for keep in (1, 3, 8, 12, len(rows) - 1):
            end_at_checkpoint(self.path("whole.h5"), self.path("part.h5"), keep)
            self.assertEqual(self.run_model("part", 70, 1.2, "--restart", "part.h5"), recorded - rows[keep - 1])
            expect_equal_runs(self.path("part.h5"), self.path("whole.h5"), f"after {keep} checkpoints")

    def test_a_restarted_run_with_actions_equals_the_whole_one(self):
        self.model = MODEL.replace("output:", ACTIONS + "output:").replace(
            "joints:", "  stay: {type: spring_damper, nodes: [ground, arm], stiffness: 20, damping: 1, length: 0.3}\njoints:")
        self.test_a_restarted_run_equals_the_whole_one_events_and_all()
        with h5py.File(os.path.join(self.folder, "whole.h5")) as whole:
            names = whole["crossings"][()].decode().splitlines()
            met = [names[int(k)] for k in whole["analysis_1/events/crossing"][:]]
            self.assertEqual(met.count("event 'again': locks 'tip', releases 'stay', sets 'push' to 2*fast.count"), 1)
            self.assertEqual(met.count("event 'later': unlocks 'tip', activates 'stay', sets 'push' to push - 1"), 1)
            # The rows contain a zero force of the spring between the two events.
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
            landed = math.sqrt(0.7 / 5)  # exact for the scheme, and located to 1e-10 of a step
            self.assertAlmostEqual(results["analysis_1/time"][-1], landed, delta=2e-11)
            self.assertEqual(results["analysis_1/events/time"][:].tolist(), [results["analysis_1/time"][-1]])
            name = results["crossings"][()].decode().splitlines()[int(results["analysis_1/events/crossing"][0])]
            self.assertEqual(name, "event 'landed'")


if __name__ == "__main__":
    unittest.main()
