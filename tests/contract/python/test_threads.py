"""Tests of threads of Python: others run while a session computes, several sessions compute at the same time, and a
session belongs to one thread."""

import os
import tempfile
import threading
import time
import unittest
from concurrent.futures import ThreadPoolExecutor

import h5py
import numpy as np

import bielle
from samples import BEAM, PENDULUM


class Threads(unittest.TestCase):
    def test_sessions_of_one_model_at_the_same_time(self):
        for text in (PENDULUM, BEAM):
            model = bielle.read(text)

            def ends(_, model=model):
                session = model.session()
                if "static" in model.analyses:
                    session.statics(record=False)
                return [session["energy/kinetic"] for _ in session.dynamics(0.1, 2e-4)], session.save()

            alone = ends(0)
            with ThreadPoolExecutor(4) as pool:
                for energies, saved in pool.map(ends, range(8)):
                    self.assertEqual(energies, alone[0])
                    np.testing.assert_array_equal(saved, alone[1])

    def test_runs_with_files_at_the_same_time(self):
        with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(4) as pool:
            paths = [os.path.join(folder, f"{k}.h5") for k in range(8)]
            runs = list(pool.map(lambda path: bielle.run(bielle.read(BEAM), path), paths))
            for path, run in zip(paths, runs):
                with h5py.File(path) as file:
                    np.testing.assert_array_equal(file["analysis_2/nodes/tip/position"][:len(run.time)], run["nodes/tip/position"])
                np.testing.assert_array_equal(run["nodes/tip/position"], runs[0]["nodes/tip/position"])

    def in_the_background(self, session, motion, act):
        """Calls act() while another thread continues the motion."""
        started, end = threading.Event(), []

        def watch(at):
            started.set()
            if end:
                at.stop()

        session.on_step(watch)
        thread = threading.Thread(target=motion.finish)
        thread.start()
        self.assertTrue(started.wait(60))
        try:
            act()
        finally:
            end.append(True)
            thread.join()
        self.assertTrue(motion.step())

    def test_python_runs_while_a_session_computes(self):
        session = bielle.read(PENDULUM).session()
        motion = session.dynamics(1e5, 2e-3)
        turns = []

        def work():
            begin = time.monotonic()
            while time.monotonic() - begin < 0.3:
                turns.append(len(turns))

        self.in_the_background(session, motion, work)
        self.assertGreater(len(turns), 100)

    def test_another_thread_is_refused(self):
        session = bielle.read(PENDULUM).session()
        motion = session.dynamics(1e5, 2e-3)

        def ask():
            for call in (lambda: session["time"], session.save, lambda: session.time, motion.step, lambda: motion.time,
                         lambda: session.state, session.statics, lambda: session.set_input("x", 1), session.stop,
                         lambda: session.record().__enter__()):
                refusals = 0
                for _ in range(200):
                    try:
                        call()
                    except bielle.Error as error:
                        self.assertIn("the session is computing in another thread", str(error))
                        refusals += 1
                self.assertEqual(refusals, 200)

        self.in_the_background(session, motion, ask)
        self.assertGreater(session.time, 0)


if __name__ == "__main__":
    unittest.main()
