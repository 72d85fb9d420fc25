"""Tests mechanism/examples/slider_crank.yaml: it moves by the kinematics of a slider-crank, and its energy is balanced.

The rod deforms by less than 0.2 mm, and rigid kinematics hold within that.
"""

import os
import subprocess
import unittest

import numpy as np

from example import PROGRAM, ExampleTest, Results

R, L, SPEED, RUN_UP = 0.05, 0.2, 2 * np.pi * 50, 0.06


class SliderCrank(ExampleTest):
    model = "slider_crank.yaml"
    superelement = "conrod.h5"

    def test_motor_reaches_its_speed_and_keeps_it(self):
        rate = self.results.rows("joints/main/rate")[:, 0]
        self.assertTrue(bool(self.results.file.attrs["complete"]))
        s = np.clip(self.time / RUN_UP, 0, 1)
        np.testing.assert_allclose(rate, SPEED * (10 * s ** 3 - 15 * s ** 4 + 6 * s ** 5), atol=1e-6 * SPEED)
        # the integral of the smooth step over its own length is half of it
        angle = self.results.rows("joints/main/coordinate")[-1, 0]
        self.assertAlmostEqual(angle, SPEED * (self.time[-1] - RUN_UP / 2), delta=1e-3)

    def test_piston_follows_the_slider_crank_formula(self):
        angle = self.results.rows("joints/main/coordinate")[:, 0]
        formula = R * np.cos(angle) + np.sqrt(L ** 2 - (R * np.sin(angle)) ** 2)
        piston = self.results.rows("nodes/piston/position")
        self.assertLess(np.abs(piston[:, 0] - formula).max(), 3e-4)
        self.assertLess(np.abs(piston[:, 1:]).max(), 1e-9)

    def test_a_rod_that_is_drawn_roughly_is_assembled_without_deforming(self):
        """A flexible rod that is drawn 10 mm and 10 degrees off moves to its joints without deformation."""
        with open(os.path.join(self.folder, "slider_crank.yaml")) as file:
            text = file.read()
        bent = "rotation_vector: [0, 0, 0.17]"
        for old, new in (
                ('big_end:   {position: ["r", 0, 0]}', f'big_end: {{position: ["r + 0.008", 0.005, 0.003], {bent}}}'),
                ('small_end: {position: ["r + l", 0, 0]}',
                 f'small_end: {{position: ["r + 0.008 + l*cos(0.17)", "0.005 + l*sin(0.17)", 0.003], {bent}}}'),
                ('    position: ["r", 0, 0]\n', f'    position: ["r + 0.008", 0.005, 0.003]\n    {bent}\n'),
                ("nodes: [crank_pin, big_end], axis: [0, 0, 1]",
                 "nodes: [crank_pin, big_end], at: [[0, 0, 0], [0, 0, 0]], axis: [[0, 0, 1], [0, 0, 1]]"),
                ("nodes: [small_end, piston]}", "nodes: [small_end, piston], at: [[0, 0, 0], [0, 0, 0]]}")):
            self.assertIn(old, text)
            text = text.replace(old, new)
        rough = os.path.join(self.folder, "rough.yaml")
        with open(rough, "w") as file:
            file.write(text[:text.index("analysis:")] + "analysis: [{type: assembly}]\n")
        done = subprocess.run([PROGRAM, rough], capture_output=True, text=True, timeout=600)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("node 'small_end': 0.0393 m, 9.74 degrees", done.stdout)
        results = Results(rough.replace(".yaml", ".h5"))
        big, small = (results.rows(f"nodes/{end}_end/position")[-1] for end in ("big", "small"))
        np.testing.assert_allclose(big, [R, 0, 0], atol=1e-10)
        np.testing.assert_allclose(small, [R + L, 0, 0], atol=1e-10)
        results.file.close()

    def test_gas_and_inertia_load_the_wrist_as_a_piston_on_its_own(self):
        """Along the cylinder, m a = gas force + wrist force, since the guide has no friction."""
        rows = self.time > RUN_UP
        acceleration = self.results.rows("nodes/piston/acceleration")[rows, 0]
        t = self.time[rows]
        s = np.clip((t - RUN_UP) / 0.03, 0, 1)
        gas = -40e5 * np.pi * 0.04 ** 2 * (10 * s ** 3 - 15 * s ** 4 + 6 * s ** 5) * np.cos(SPEED * (t - RUN_UP / 2) / 2) ** 40
        wrist = self.results.rows("joints/wrist/reaction_inertial")[rows, 0]
        np.testing.assert_allclose(wrist, 0.5 * acceleration - gas, atol=1e-6 * np.abs(gas).max())

    def test_energy_balance_closes(self):
        stored = self.results.rows("energy/kinetic")
        self.assertLess(np.abs(self.results.rows("energy/balance")).max(), 5e-3 * stored.max())


if __name__ == "__main__":
    unittest.main()
