"""Tests of motions: steps, ends, callbacks."""

import gc
import unittest

import numpy as np

import bielle
from samples import BEAM, PENDULUM, WHEEL


class Motions(unittest.TestCase):
    def test_steps(self):
        session = bielle.read(PENDULUM).session()
        motion = session.dynamics(0.1, 1e-2)
        self.assertEqual((motion.begin, motion.end, motion.time, motion.done), (0, 0.1, 0, False))
        self.assertTrue(motion.step())
        self.assertTrue(motion.advance_to(0.05))
        self.assertAlmostEqual(motion.time, 0.05)
        times = [each.time for each in motion]
        np.testing.assert_allclose(times, [0.06, 0.07, 0.08, 0.09, 0.1])
        self.assertTrue(motion.done)
        self.assertFalse(motion.step())
        self.assertEqual(list(motion), [])
        self.assertEqual(motion.log["steps"], 10)
        self.assertFalse(motion.advance_to(0.2))

    def test_the_state_within_a_step(self):
        session = bielle.read(WHEEL).session()
        session.inputs["torque"] = 2
        motion = session.dynamics(1, 0.1)
        motion.step()
        angular = motion.interpolated(0.05).angular_velocities[1, 2]
        self.assertAlmostEqual(angular, 0.05, places=12)
        self.assertAlmostEqual(motion.state.time, 0.1)
        self.assertEqual(motion.interpolated(motion.time).time, motion.time)

    def test_there_is_no_state_outside_of_the_last_step(self):
        session = bielle.read(WHEEL).session()
        motion = session.dynamics(1, 0.1)
        self.assertEqual(motion.interpolated(0).time, 0)

        def refusal(time):
            with self.assertRaises(bielle.InputError) as caught:
                motion.interpolated(time)
            return str(caught.exception)

        self.assertEqual(refusal(0.05), "t = 0.05 s is not within the last step, of which there is none yet")
        motion.advance_to(0.2)
        for time in (0.05, 0.25, float("nan")):
            self.assertIn("is not within the last step, from 0.1 to 0.2 s", refusal(time))
        session.restore(session.save())
        self.assertIn("none yet", refusal(0.15))

    def test_a_motion_that_was_ended_says_so(self):
        session = bielle.read(BEAM).session()
        motion = session.dynamics(0.1, 1e-3)
        motion.advance_to(0.05)
        for begin_another in (session.statics, lambda: session.dynamics(0.1, 1e-3)):
            another = begin_another()
            for call in (motion.step, motion.finish, lambda: motion.advance_to(0.06), lambda: next(iter(motion))):
                with self.assertRaisesRegex(bielle.Error, "this motion has ended: its session was asked for something else"):
                    call()
            self.assertAlmostEqual(motion.time, 0.05)  # the motion can still be read
            self.assertEqual(motion.state.positions.shape[1], 3)
            motion = another if isinstance(another, bielle.Motion) else motion
        self.assertTrue(session.moving)

    def test_lifetimes(self):
        """Each object keeps the objects to which it refers, in any order of deletion."""
        motion = bielle.read(PENDULUM).session().dynamics(0.1, 1e-2)
        gc.collect()
        motion.finish()
        self.assertEqual(motion.session.model.title, "a double pendulum")
        session = motion.session
        del motion
        gc.collect()
        self.assertAlmostEqual(session.time, 0.1)
        self.assertFalse(session.moving)
        # Runs a motion while another one is in progress.
        first = session.dynamics(0.1, 1e-2)
        second = session.dynamics(0.1, 1e-2)
        del first
        self.assertTrue(session.moving)
        second.finish()

    def test_a_motion_that_is_dropped_by_a_callback(self):
        session = bielle.read(PENDULUM).session()
        held = [session.dynamics(0.1, 1e-2)]
        second = session.dynamics(0.1, 1e-2)
        session.on_step(lambda at: held.clear())
        second.finish()
        self.assertEqual(held, [])

    def test_events_stop(self):
        session = bielle.read(PENDULUM + "events: {turned: {when: shoulder.angle, crosses: 1, action: stop}}\n").session()
        met = []
        session.on_event(lambda at, time, name: met.append((time, name, at.measure("shoulder.angle"))))
        motion = session.dynamics(2, 1e-3)
        self.assertTrue(motion.finish())
        self.assertTrue(motion.done and motion.stopped_by_event)
        self.assertEqual(motion.last_event, "event 'turned'")
        (time, name, angle), = met
        self.assertEqual((time, name), (motion.time, "event 'turned'"))
        self.assertAlmostEqual(angle, 1, places=6)

    def test_callbacks_may_stop(self):
        session = bielle.read(PENDULUM).session()
        times = []

        @session.on_step
        def watch(at):
            times.append(at.time)
            if at.time > 0.05:
                at.stop()

        motion = session.dynamics(1, 1e-2)
        self.assertFalse(motion.finish())
        self.assertAlmostEqual(motion.time, 0.06)
        self.assertEqual(len(times), 6)
        session.remove_callback(watch)
        self.assertTrue(motion.finish())
        self.assertEqual(len(times), 6)

    def test_callbacks_see_points_of_statics(self):
        session = bielle.read(BEAM).session()
        seen = []
        session.on_step(lambda at: seen.append((at["time"], at.node("tip").position[2])))
        session.statics(steps=3)
        np.testing.assert_allclose([factor for factor, _ in seen], [1 / 3, 2 / 3, 1])
        self.assertGreater(seen[2][1], seen[1][1])

    def test_callbacks_must_not_compute(self):
        session = bielle.read(PENDULUM).session()
        saved = session.save()
        for wrong in (lambda at: at.statics(), lambda at: at.dynamics(1, 0.1), lambda at: at.restore(saved),
                      lambda at: at.record().__enter__(), lambda at: motion.step()):
            callback = session.on_step(wrong)
            motion = session.dynamics(0.1, 1e-2)
            with self.assertRaisesRegex(bielle.Error, "the session is computing"):
                motion.finish()
            session.remove_callback(callback)
            self.assertTrue(motion.finish())

    def test_what_callbacks_raise_comes_out_and_the_motion_goes_on(self):
        session = bielle.read(PENDULUM).session()

        def wrong(at):
            if at.time > 0.045:
                raise KeyError("no")

        session.on_step(wrong)
        motion = session.dynamics(0.1, 1e-2)
        with self.assertRaisesRegex(KeyError, "no"):
            motion.finish()
        self.assertAlmostEqual(motion.time, 0.05)
        session.remove_callback(wrong)
        motion.finish()
        other = bielle.read(PENDULUM).session()
        other.dynamics(0.1, 1e-2).finish()
        # A run that ends early can be continued. Tangents are computed again there, so that results are equal up to
        # Newton's tolerance.
        np.testing.assert_allclose(session.state.positions, other.state.positions, atol=1e-9)

    def test_callbacks_may_save(self):
        session = bielle.read(PENDULUM).session()
        saved = []
        session.on_step(lambda at: saved.append(at.save()))
        motion = session.dynamics(0.1, 1e-2)
        motion.finish()
        end = session.state.positions
        session.restore(saved[3])
        self.assertAlmostEqual(motion.time, 0.04)
        motion.finish()
        np.testing.assert_array_equal(session.state.positions, end)


if __name__ == "__main__":
    unittest.main()
