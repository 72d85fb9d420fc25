"""Tests for leaks: sessions, motions, results, callbacks and errors are created and released."""

import gc
import tracemalloc
import unittest
import weakref

import bielle
from samples import BEAM, PENDULUM


def resident():
    """Returns the memory of this process [kB]."""
    with open("/proc/self/status", encoding="ascii") as file:
        return next(int(line.split()[1]) for line in file if line.startswith("VmRSS"))


def live():
    """Creates and releases a session, with every object that could keep a reference to it."""
    model = bielle.read(PENDULUM)
    session = model.session()
    session.on_step(lambda at: session.time)  # a circular reference between session and callback
    session.on_event(lambda at, time, name: session)
    with session.record() as recording:
        motion = session.dynamics(0.02, 1e-3)
        motion.finish()
    view = recording[0]["nodes/upper/position"]
    state = session.state.positions
    session.restore(session.save())
    session.assemble()
    for wrong in (motion.step, lambda: session["no"], lambda: session.dynamics(0, 0), lambda: bielle.read({"nodes": 1})):
        try:
            wrong()
        except bielle.Error:
            pass
    return weakref.ref(session), weakref.ref(model), view, state


class Leaks(unittest.TestCase):
    def test_a_thousand_sessions(self):
        for _ in range(100):  # makes the allocations that happen only once
            live()
        gc.collect()
        before = resident()
        for _ in range(1000):
            live()
        gc.collect()
        # One session of this model takes 45 kB, and 1000 of them would be 45 MB.
        self.assertLess(resident() - before, 10_000)

    def test_python_keeps_nothing_of_them(self):
        tracemalloc.start()
        self.addCleanup(tracemalloc.stop)
        for _ in range(100):
            live()
        gc.collect()
        before = tracemalloc.get_traced_memory()[0]
        for _ in range(1000):
            live()
        gc.collect()
        # NumPy keeps small blocks, about 20 kB for any number of objects; a leak of the smallest object would be 50 kB.
        self.assertLess(tracemalloc.get_traced_memory()[0] - before, 40_000)

    def test_circles_are_collected(self):
        session, model, _, _ = live()
        gc.collect()
        self.assertIsNone(session())
        self.assertIsNone(model())

    def test_views_keep_what_they_show_and_no_more(self):
        run = bielle.read(BEAM).run()
        view = run["nodes/tip/position"]
        last = view[-1].tolist()
        reference = weakref.ref(run)
        del run
        gc.collect()
        self.assertIsNone(reference())
        self.assertEqual(view[-1].tolist(), last)


if __name__ == "__main__":
    unittest.main()
