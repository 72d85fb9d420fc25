"""Tests that the examples in Python do as documented."""

import os
import re
import subprocess
import sys
import unittest

import numpy as np

EXAMPLES = os.path.abspath(os.path.join(os.path.dirname(__file__), *[os.pardir] * 3, "mechanism", "python", "examples"))
sys.path.insert(0, EXAMPLES)

import controller  # noqa: E402
import identification  # noqa: E402
import optimisation  # noqa: E402
import sweep  # noqa: E402

import bielle  # noqa: E402


class Examples(unittest.TestCase):
    def run_script(self, name, *arguments):
        done = subprocess.run([os.path.join(EXAMPLES, name), *arguments], capture_output=True, text=True, timeout=300)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return done.stdout

    def test_the_controller_brings_the_arm_to_its_target(self):
        time, angle, torque = controller.lift(target=0.8, duration=3)
        self.assertAlmostEqual(angle[-1], 0.8, places=3)
        self.assertEqual(abs(torque).max(), 28)
        # At rest the motor carries the weight, m g l/2 cos(angle).
        self.assertAlmostEqual(torque[-1], 4 * 9.81 * 0.4 * np.cos(angle[-1]), places=2)
        self.assertIn("after 2.0 s the arm stands at 0.80", self.run_script("controller.py"))

    def test_the_identification_finds_what_was_measured(self):
        values, deviations = identification.identify(identification.measured())
        np.testing.assert_array_less(np.abs(values - [37, 0.4]), 4 * deviations)
        np.testing.assert_array_less(deviations, [0.1, 0.01])
        # Without noise the error is that of the steps: the period of the trapezoidal rule is longer by (omega h)^2/12.
        values, _ = identification.identify(identification.measured(noise=0))
        omega = np.sqrt(37 / identification.INERTIA)
        self.assertAlmostEqual(values[0] / 37 - 1, (omega * 2e-3)**2 / 6, delta=2e-6)
        self.assertAlmostEqual(values[1], 0.4, delta=1e-4)
        self.assertRegex(self.run_script("identification.py"), r"stiffness 3[67]\.\d+ \+- 0\.0\d+\ndamping 0\.[34]")

    def test_the_optimisation_finds_the_four_bar(self):
        lengths = np.array([0.32, 1.05, 0.85, 0.6, 0.45])
        target = optimisation.coupler_path(*lengths, 2 * np.pi * np.arange(optimisation.PLACES) / optimisation.PLACES)
        np.testing.assert_allclose(optimisation.computed(lengths), target, rtol=0, atol=1e-12)
        self.assertGreater(np.abs(optimisation.computed(optimisation.START) - target).max(), 0.2)
        found, missed = optimisation.synthesise(target)
        np.testing.assert_allclose(found, lengths, rtol=0, atol=1e-9)
        self.assertLess(missed, 1e-9)
        # No four-bar reaches these places: the result is a minimum, and the sum of squares grows in all directions.
        wanted = target + 0.01 * np.random.default_rng(2).standard_normal(target.shape)
        found, missed = optimisation.synthesise(wanted)
        self.assertLess(missed, 0.04)
        least = np.sum((optimisation.computed(found) - wanted) ** 2)
        for step in 1e-4 * np.vstack([np.eye(5), -np.eye(5)]):
            self.assertGreater(np.sum((optimisation.computed(found + step) - wanted) ** 2), least)
        self.assertIn("crank 0.320000, coupler 1.050000, rocker 0.850000", self.run_script("optimisation.py"))

    def test_the_sweep_equals_single_runs(self):
        masses = [1, 2, 0, 4]
        found = sweep.sweep(sweep.SERVO, "mass", masses, lambda run: run["joints/shoulder/coordinate"].copy(), threads=3)
        for mass, angles in zip(masses, found):
            if mass == 0:
                self.assertIsInstance(angles, bielle.InputError)
                continue
            np.testing.assert_array_equal(angles, bielle.run(sweep.SERVO, parameters={"mass": mass})["joints/shoulder/coordinate"])
        lines = self.run_script("sweep.py").splitlines()
        self.assertEqual(len(lines), 8)
        self.assertIn("mass = 8: largest coordinate of 'shoulder'", lines[-1])

    def test_the_code_of_the_readme_runs(self):
        root = os.path.join(EXAMPLES, os.pardir, os.pardir, os.pardir)
        with open(os.path.join(root, "README.md"), encoding="utf-8") as file:
            code = re.search(r"## From Python\n+```python\n(.*?)```", file.read(), re.DOTALL).group(1)
        done = subprocess.run([sys.executable, "-c", code], cwd=root, capture_output=True, text=True, timeout=300)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        lines = done.stdout.splitlines()
        self.assertGreater(len(lines), 500)  # a step of 2 ms in which the torque reaches its limit is divided
        self.assertRegex(lines[-1], r"^2\.4 0\.8\d+ \[Event\(time=0\.\d+, name=\"event 'arrived'\"\)\]$")


if __name__ == "__main__":
    unittest.main()
