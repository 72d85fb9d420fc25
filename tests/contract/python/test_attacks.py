"""Tests of numbers and objects with wrong values, and of programs that end early: they give a message, never a
crash."""

import os
import random
import subprocess
import sys
import textwrap
import unittest

import numpy as np

import bielle
from samples import PENDULUM, WHEEL

SWITCHED = """
gravity: [0, 0, -9.81]
nodes: {rod: {position: [0.5, 0, 0]}, ball: {position: [2, 0, 0.101]}}
elements:
  rod: {type: rigid_body, node: rod, mass: 2, inertia: [0, 0.1666667, 0.1666667]}
  ball: {type: rigid_body, node: ball, solid: {sphere: 0.1, density: 1000}}
joints:
  pivot: {type: hinge, nodes: [ground, rod], position: [0, 0, 0], axis: [0, 1, 0], friction: {coefficient: 0.3, radius: 0.02, model: stick_slip}}
  floor: {type: contact, shapes: [{node: ground, plane: [0, 0, 1]}, {node: ball, sphere: 0.1}], stiffness: 1e6, restitution: 0.5,
          friction: {coefficient: 0.3, model: lugre, bristle_stiffness: 1e3, bristle_damping: 1}}
drives: {m: {joint: pivot, torque: "u"}}
inputs: {u: {start: 0, units: N m}}
events: {down: {when: pivot.angle, crosses: 0.5}}
"""
OTHERS = [np.nan, np.inf, 1e300, -1.0, 0.0, 0.5, 2.0, 2.0**31, 2.0**53, -1e18]


class Numbers(unittest.TestCase):
    def setUp(self):
        self.model = bielle.read(SWITCHED)
        session = self.model.session()
        session.assemble()
        self.motion = session.dynamics(1, 0.01)
        for _ in range(3):
            self.motion.step()
        self.session, self.saved = session, session.save()

    def test_each_number_of_what_was_saved(self):
        """A changed number is refused, or the motion continues, or it fails with a message."""
        refused = 0
        other = self.model.session()
        for place in range(len(self.saved)):
            for value in (np.nan, random.Random(place).choice(OTHERS)):
                saved = self.saved.copy()
                saved[place] = value
                try:
                    other.dynamics(1, 0.01, saved=saved).step()
                except bielle.InputError:
                    refused += 1
                except bielle.ComputationError:
                    pass
        self.assertGreater(refused, len(self.saved))
        other.dynamics(1, 0.01, saved=self.saved).step()

    def test_what_is_refused_names_the_number(self):
        saved = self.saved.copy()
        saved[29] = np.nan  # when the motion began
        for call in (lambda: self.model.session().dynamics(1, 0.01, saved=saved), lambda: self.session.restore(saved)):
            with self.assertRaisesRegex(bielle.InputError, r"number 29 \(from 0\), nan, is not finite"):
                call()
        self.assertTrue(self.motion.step())  # the refused value had no effect

    def test_states_that_are_none(self):
        session = bielle.read(PENDULUM).session()
        before = session.state
        for change, says in ((lambda s: s.axes.__setitem__((1, 0, 0), 2), "the axes of node 'upper' are no rotation"),
                             (lambda s: s.axes.__setitem__(1, np.zeros((3, 3))), "the axes of node 'upper' are no rotation"),
                             (lambda s: s.axes.__setitem__(1, np.diag([1, 1, -1])), "a reflection"),
                             (lambda s: s.axes.__setitem__(2, np.nan), "the axes of node 'lower' are no rotation"),
                             (lambda s: s.positions.__setitem__((2, 1), np.inf), "the position of node 'lower' is not finite"),
                             (lambda s: s.velocities.__setitem__((1, 1), np.nan), "the velocity of node 'upper' is not finite"),
                             (lambda s: s.multipliers.__setitem__(0, np.nan), "number 0 of the multipliers is not finite"),
                             (lambda s: setattr(s, "time", np.nan), "its time is not finite")):
            state = bielle.State(before)
            change(state)
            with self.assertRaisesRegex(bielle.InputError, says):
                session.state = state
            np.testing.assert_array_equal(session.state.positions, before.positions)
        state = bielle.State(before)
        angle = 0.3
        state.axes[1] = [[np.cos(angle), 0, np.sin(angle)], [0, 1, 0], [-np.sin(angle), 0, np.cos(angle)]]
        session.state = state  # a rotation up to rounding
        single = state.axes[1].astype(np.float32)
        state.axes[1] = single
        session.state = state
        with self.assertRaisesRegex(bielle.InputError, "another model"):
            session.state = bielle.read(WHEEL).session().state

    def test_objects_that_are_others(self):
        for make, says in ((lambda: bielle.Model(3), "bielle.load reads"), (lambda: bielle.Session(None), "model.session"),
                           (lambda: bielle.Session("model.yaml"), "model.session"), (lambda: bielle.Motion(None, None), "Session.dynamics")):
            with self.assertRaisesRegex(bielle.InputError, says):
                make()


class Ends(unittest.TestCase):
    def test_a_program_that_ends_while_a_thread_computes(self):
        program = textwrap.dedent("""
            import sys, threading
            import bielle
            session = bielle.read(sys.stdin.read()).session()
            begun = threading.Event()
            if "{listening}" == "yes":
                session.on_step(lambda at: begun.set())
            else:
                begun.set()
            motion = session.dynamics(1e5, 1e-3)
            def compute():
                while True:
                    {call}
            threading.Thread(target=compute, daemon=True).start()
            begun.wait()
            print("ends")
            """)
        for listening in ("yes", "no"):
            for call in ("motion.finish()", "motion.step()", "session.assemble()"):
                if call == "session.assemble()" and listening == "yes":
                    continue
                done = subprocess.run([sys.executable, "-B", "-c", program.format(listening=listening, call=call)], input=PENDULUM,
                                      capture_output=True, text=True, timeout=120, env=os.environ, check=False)
                self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "ends\n", ""), (listening, call))


if __name__ == "__main__":
    unittest.main()
