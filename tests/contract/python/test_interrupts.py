"""Tests that Ctrl-C ends long computations, and that the session remains usable."""

import os
import signal
import tempfile
import threading
import time
import unittest

import h5py
import numpy as np

import bielle
from samples import BEAM, PENDULUM

LONG = PENDULUM.replace("duration: 1.2", "duration: 1e5")  # hours


class Interrupts(unittest.TestCase):
    def interrupted(self, call):
        """Raises KeyboardInterrupt, soon after the signal."""
        sent = []

        def send():
            sent.append(time.monotonic())
            os.kill(os.getpid(), signal.SIGINT)

        timer = threading.Timer(0.3, send)
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            call()
        # A step takes far less, but the machine may be busy.
        self.assertLess(time.monotonic() - sent[0], 5)
        timer.join()

    def test_a_motion(self):
        session = bielle.read(LONG).session()
        motion = session.dynamics(1e5, 2e-3)
        self.interrupted(motion.finish)
        reached = motion.time
        self.assertGreater(reached, 0)
        self.assertTrue(motion.step())
        self.assertGreater(motion.time, reached)
        self.interrupted(lambda: motion.advance_to(9e4))
        # The motion is the same as without the interruption, up to Newton's tolerance while it is not chaotic.
        session.dynamics(0.1, 2e-3).finish()
        self.assertTrue(np.isfinite(session.state.positions).all())

    def test_an_interrupted_motion_goes_on_as_if_it_had_not_been(self):
        def end(interrupt):
            session = bielle.read(PENDULUM).session()
            if interrupt:
                callback = session.on_step(lambda at: at.time > 0.3 and os.kill(os.getpid(), signal.SIGINT))
            motion = session.dynamics(0.5, 1e-3)
            if interrupt:
                with self.assertRaises(KeyboardInterrupt):
                    motion.finish()
                session.remove_callback(callback)
            motion.finish()
            return session.state.positions

        np.testing.assert_allclose(end(True), end(False), atol=1e-9)

    def test_a_callback_does_not_keep_signals_away(self):
        session = bielle.read(LONG).session()
        session.on_step(lambda at: None)
        self.interrupted(session.dynamics(1e5, 2e-3).finish)

    def test_an_analysis(self):
        session = bielle.read(LONG).session()
        self.interrupted(lambda: session.run(0, record=False))
        self.assertGreater(session.time, 0)
        self.assertEqual(session.run({"type": "assembly"}).type, "assembly")

    def test_statics(self):
        session = bielle.read(BEAM).session()
        self.interrupted(lambda: session.statics(steps=100000000, record=False))
        session.statics()

    def test_a_run_with_a_file(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "run.h5")
            self.interrupted(lambda: bielle.run(bielle.read(LONG), path))
            with h5py.File(path) as file:
                self.assertEqual(file.attrs["complete"], 0)
                self.assertGreater(len(file["time"]), 10)

    def test_the_handler_of_python_stays(self):
        before = signal.getsignal(signal.SIGINT)
        bielle.read(PENDULUM).run()
        self.assertIs(signal.getsignal(signal.SIGINT), before)


if __name__ == "__main__":
    unittest.main()
