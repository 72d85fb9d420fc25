"""Tests of bielle-rainflow and its counting with the example of the standard, and with histories of known cycles."""

import os
import sys
import tempfile
import unittest

import h5py
import numpy as np

from box_mesh import REPOSITORY
from python_tool import run_python_tool

sys.path.insert(0, os.path.join(REPOSITORY, "tools"))

from bielle_tools.quantities.rainflow import count_cycles, in_bins, miner_damage, reversals, stress_signal  # noqa: E402


class Counting(unittest.TestCase):
    STANDARD = [-2, 1, -3, 5, -1, 3, -4, 4, -2]  # points A to I of figure 6 in ASTM E1049-85

    def test_the_example_of_the_standard(self):
        counts = {}
        for size, _, number in count_cycles(self.STANDARD):
            counts[size] = counts.get(size, 0) + number
        self.assertEqual(counts, {3: 0.5, 4: 1.5, 6: 0.5, 8: 1.0, 9: 0.5})  # the table of figure 6
        whole = [(size, mean) for size, mean, number in count_cycles(self.STANDARD) if number == 1]
        self.assertEqual(whole, [(4, 1)])  # E to F, the only closed cycle

    def test_points_between_reversals_and_repeated_ones_change_nothing(self):
        fine = np.interp(np.linspace(0, 8, 801), np.arange(9), self.STANDARD)
        np.testing.assert_array_equal(reversals(np.repeat(fine, 2)), self.STANDARD)
        np.testing.assert_array_equal(count_cycles(fine), count_cycles(self.STANDARD))

    def test_a_constant_amplitude_is_so_many_halves_of_one_range(self):
        cycles = count_cycles([5, -1] * 10)
        self.assertTrue((cycles[:, 0] == 6).all() and (cycles[:, 1] == 2).all())
        self.assertEqual(cycles[:, 2].sum(), 9.5)  # 19 half cycles

    def test_what_does_not_change_has_no_cycles(self):
        for signal in ([], [3], [3, 3, 3]):
            self.assertEqual(count_cycles(signal).shape, (0, 3))

    def test_damage_is_the_sum_over_the_line(self):
        cycles = np.array([[80e6, 0, 1e6], [160e6, 0, 1e4]])
        self.assertAlmostEqual(miner_damage(cycles, 80e6, 2e6, 3), 0.5 + 8 * 1e4 / 2e6, delta=1e-15)

    def test_bins_keep_the_number_of_cycles(self):
        cycles = count_cycles(np.random.default_rng(1).normal(size=500))
        table = in_bins(cycles, 10)
        self.assertLessEqual(len(table), 10)
        self.assertAlmostEqual(table[:, 2].sum(), cycles[:, 2].sum(), delta=1e-9)

    def test_signals_of_a_stress(self):
        pull, push, shear = [3, 0, 0, 0, 0, 0], [-5, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 2]
        stress = np.array([pull, push, shear], float)
        np.testing.assert_allclose(stress_signal(stress, "principal"), [3, -5, 2], rtol=1e-14)
        np.testing.assert_allclose(stress_signal(stress, "von_mises"), [3, -5, 2 * np.sqrt(3)], rtol=1e-14)
        np.testing.assert_allclose(stress_signal(stress, "xy"), [0, 0, 2])


class Command(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = os.path.join(folder.name, "run.h5")
        with h5py.File(self.path, "w") as file:
            file.attrs.update({"format": "bielle results", "version": 1, "complete": True})
            signal = np.array(Counting.STANDARD, float) * 1e6
            file["time"] = np.arange(len(signal)) * 1.0
            stress = np.zeros((len(signal), 6))
            stress[:, 0] = signal
            file["elements/rod/stress_at_root"] = stress
            file["elements/rod/stress_at_root"].attrs["units"] = "Pa"
            file["elements/rod/coordinates"] = np.column_stack([0 * signal, signal])

    def run_tool(self, *arguments):
        return run_python_tool(os.path.join(REPOSITORY, "tools", "bielle-rainflow"), [self.path, *arguments])

    def test_columns_count_from_1(self):
        second = self.run_tool("elements/rod/coordinates", "--component", "2")
        self.assertEqual(second.returncode, 0, second.stderr)
        self.assertEqual(second.stdout.splitlines()[2:], self.run_tool("elements/rod/coordinates[2]").stdout.splitlines()[2:])
        self.assertIn("does not change", self.run_tool("elements/rod/coordinates", "--component", "1").stderr)

    def test_it_prints_ranges_means_counts_and_damage(self):
        done = self.run_tool("elements/rod/stress_at_root", "--component", "xx", "--sn", "4e6,100,1")
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = [tuple(map(float, line.split())) for line in done.stdout.splitlines()[2:-1]]
        self.assertEqual(sum(number for _, _, number in rows), 4)
        self.assertIn((4e6, 1e6, 1.0), rows)
        # With slope 1, damage is proportional to the sum of the ranges.
        total = 3 * 0.5 + 4 * 1.5 + 6 * 0.5 + 8 * 1 + 9 * 0.5
        self.assertIn(f"Miner's damage {total / 400:.6g}", done.stdout)

    def test_slips_are_answered_with_what_there_is(self):
        for arguments, words in ((["elements/rod/stress_at_rot"], "did you mean 'elements/rod/stress_at_root'"),
                                 (["elements/rod/stress_at_root", "--component", "xxx"], "did you mean 'xx'"),
                                 (["elements/rod/coordinates", "--component", "0"], "--component, from 1; there is no number 0"),
                                 (["elements/rod/coordinates", "--component", "99"], "by --component, from 1"),
                                 (["elements/rod/coordinates"], "by --component, from 1"),
                                 (["elements/rod/stress_at_root", "--sn", "80e6,3"], "RANGE,CYCLES,EXPONENT")):
            done = self.run_tool(*arguments)
            self.assertEqual(done.returncode, 1)
            self.assertIn(words, done.stderr)
            self.assertNotIn("Traceback", done.stderr)


if __name__ == "__main__":
    unittest.main()
