"""Tests of state spaces that are read from results and reduced, with a free chain of masses that has a wide
spectrum."""

import os
import sys
import tempfile
import unittest

import h5py
import numpy as np

from box_mesh import REPOSITORY

sys.path.insert(0, os.path.join(REPOSITORY, "tools"))
from bielle_tools.messages import InputError  # noqa: E402
from bielle_tools.results import state_space  # noqa: E402


def chain(stiffness=(1e4, 2e4, 3e10), damping=1e-5):
    """Four free masses of 1 kg. The input is a force on the first mass, the outputs are the position of the last and
    the velocity of the first; the rigid motion has a double zero eigenvalue."""
    n = len(stiffness) + 1
    K = np.zeros((n, n))
    for i, k in enumerate(stiffness):
        K[i : i + 2, i : i + 2] += k * np.array([[1, -1], [-1, 1]])
    zero, one = np.zeros((n, n)), np.eye(n)
    # The coordinates are mixed, and E has no special form.
    mix = np.linalg.qr(np.random.default_rng(1).normal(size=(2 * n, 2 * n)))[0]
    A = mix @ np.block([[zero, one], [-K, -damping * K]])
    C = np.zeros((2, 2 * n))
    C[0, n - 1] = C[1, n] = 1
    B = mix @ np.eye(2 * n)[:, n : n + 1]
    return state_space.StateSpace(mix, A, B, C, np.zeros((2, 1)), ["force [N]"], ["place [m]", "speed [m/s]"])


class Reduction(unittest.TestCase):
    def test_reads_what_a_run_writes(self):
        system = chain()
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "run.h5")
            with h5py.File(path, "w") as file:
                file.create_group("empty")
            with self.assertRaisesRegex(InputError, "holds no state space"):
                state_space.read(path)
            with h5py.File(path, "w") as file:
                for name in "EABCD":
                    file[f"state_space/{name}"] = getattr(system, name)
                for name in ("inputs", "outputs"):
                    file[f"state_space/{name}"] = getattr(system, name)
            found = state_space.read(path)
        np.testing.assert_array_equal(found.A, system.A)
        self.assertEqual(found.outputs, system.outputs)

    def test_slow_modes_stay_and_fast_ones_act_at_once(self):
        system = chain()
        small = state_space.reduced(system, below=1000)  # the last spring vibrates at 39 kHz
        self.assertEqual(small.A.shape, (6, 6))
        slow = np.sort(np.abs(np.linalg.eigvals(np.linalg.solve(small.E, small.A))))[2:]
        exact = np.sort(np.abs(np.linalg.eigvals(np.linalg.solve(system.E, system.A))))[2:6]
        np.testing.assert_allclose(slow, exact, rtol=1e-7)
        for frequency in (1.0, 10.0, 25.0, 60.0):
            whole, part = state_space.response(system, frequency), state_space.response(small, frequency)
            # The static approximation of the omitted part has a relative error of (f/39 kHz)^2.
            self.assertLess(np.max(np.abs(part - whole) / np.abs(whole)), 1e-6)

    def test_without_static_part_the_response_is_worse(self):
        system = chain(stiffness=(1e4, 2e4, 3e6))
        small = state_space.reduced(system, below=100)
        whole, with_statics = state_space.response(system, 30.0), state_space.response(small, 30.0)
        small.D = system.D
        without = state_space.response(small, 30.0)
        error = np.abs(with_statics - whole)[0, 0]
        self.assertLess(error, 0.1 * np.abs(without - whole)[0, 0])

    def test_all_or_nothing(self):
        system = chain()
        everything = state_space.reduced(system, below=1e9)
        self.assertEqual(everything.A.shape, (8, 8))
        np.testing.assert_allclose(state_space.response(everything, 5.0), state_space.response(system, 5.0), rtol=1e-6)
        with self.assertRaisesRegex(InputError, "above 0 Hz"):
            state_space.reduced(system, below=0)


if __name__ == "__main__":
    unittest.main()
