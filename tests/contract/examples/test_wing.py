"""Tests mechanism/examples/wing.yaml: twist and bending under lift, flutter, and the response to a gust."""

import os
import subprocess
import unittest

import numpy as np

from example import EXAMPLES, PROGRAM, ExampleTest
from bielle_tools.gallery.machines import wing
from bielle_tools.results import Results


class Wing(ExampleTest):
    model = "wing.yaml"

    def run_at(self, speed):
        target = os.path.join(self.folder, f"at_{speed}.h5")
        if not os.path.exists(target):
            subprocess.run([PROGRAM, os.path.join(EXAMPLES, self.model), "--set", f"speed={speed}", "-o", target, "--quiet"], check=True,
                           timeout=100)
        return target

    def test_twist_bend_and_flutter_are_those_of_a_uniform_rod(self):
        self.assert_gallery_checks("wing", {"wing": self.path, "slow": self.run_at(wing.SLOW), "fast": self.run_at(wing.FAST)})

    def test_the_twist_grows_faster_than_the_pressure(self):
        # The twist is the closed form, up to the divergence at 72.3 m/s.
        for speed in (15, 45):
            with Results(self.run_at(speed), 1) as results:
                twist = float(np.squeeze(results.rows("measures/twist"))[-1])
            self.assertAlmostEqual(twist / wing.loaded(speed)[0], 1, delta=5e-3, msg=speed)
        self.assertGreater(wing.loaded(45)[0], 1.5 * 9 * wing.loaded(15)[0])

    def test_a_gust_dies_out_below_the_flutter_and_grows_above(self):
        for path, sign in ((self.path, -1), (self.run_at(42), 1)):
            with Results(path, 3) as results:
                twist, time = np.squeeze(results.rows("measures/twist")), results.time
            parts = [np.ptp(twist[(time > start) & (time < start + 0.25)]) for start in (0.7, 1.2)]
            self.assertGreater(sign * np.log(parts[1] / parts[0]), 0.2)

    def test_energy_balance_closes(self):
        with Results(self.path, 3) as results:
            balance, moved = np.squeeze(results.rows("energy/balance")), np.squeeze(results.rows("energy/input"))
        self.assertLess(np.abs(balance).max(), 1e-3 * np.abs(moved).max())


if __name__ == "__main__":
    unittest.main()
