"""Tests mechanism/examples/crane.yaml: the crane holds its load, lifts and lowers it with its valves, and its energy is
balanced."""

import os
import subprocess
import unittest

import numpy as np

from example import PROGRAM, ExampleTest
from python_tool import TOOLS, prepare_figures, run_python_tool
from bielle_tools.results import Results

AREAS, DEAD, AMBIENT = np.array([3.1e-3, 1.9e-3]), 1e-4, 101325
STROKES = {"lift": (1.1, 1.8), "fold": (0.65, 1.05)}


class Crane(ExampleTest):
    model = "crane.yaml"
    superelement = "boom.h5"

    def test_it_is_what_the_valves_are_told(self):
        """The crane is at rest before the first command; then the load goes up, and down while the boom is lowered."""
        height = self.rows("measures/load_height")
        before = self.time < 0.2
        np.testing.assert_allclose(height[before], height[0], atol=1e-3)
        raised, lowered = height[np.searchsorted(self.time, 3.9)], height[-1]
        self.assertGreater(raised, height[0] + 0.5)
        self.assertLess(lowered, raised - 0.2)

    def test_pressures_hold_the_load_at_the_start(self):
        """The moments about the foot and about the tip give the forces of the cylinders, since all hinges are free."""
        for jack in STROKES:
            pressure = self.rows(f"elements/{jack}/pressure")[0]
            force = self.rows(f"elements/{jack}/force")[0]
            self.assertAlmostEqual(force, AREAS @ ((pressure - AMBIENT) * [1, -1]), delta=1e-6 * abs(force) + 1)
        # The weight of the jib is 0.7 m and the load is 1.4 m from the hinge; the line of action of the cylinder
        # follows from the drawing.
        lug, end, tip = np.array([2.2, 0]), np.array([3.7 - 0.85, -0.3]), np.array([3, 0])
        along = (end - lug) / np.linalg.norm(end - lug)
        arm = (end - tip)[0] * along[1] - (end - tip)[1] * along[0]
        wanted = 9.81 * (60 * 0.7 + 300 * 1.4) / arm
        self.assertAlmostEqual(self.rows("elements/fold/force")[0] / wanted, 1, delta=0.02)  # the boom bends a little

    def test_mass_of_the_fluid_is_that_of_its_space_and_pressure(self):
        for jack, (shortest, longest) in STROKES.items():
            length = self.rows(f"elements/{jack}/length")
            self.assertGreater(length.min(), shortest)
            self.assertLess(length.max(), longest)
            hose, give = (2e-4, 2e-14) if jack == "lift" else (3e-4, 3e-14)
            for side, way in (("a", length - shortest), ("b", longest - length)):
                pressure = self.rows(f"hydraulics/{jack}_{side}/pressure")
                space = hose + give * (pressure - AMBIENT) + DEAD + AREAS["ab".index(side)] * way
                np.testing.assert_allclose(self.rows(f"hydraulics/{jack}_{side}/volume"), space, rtol=1e-9)
                self.assertGreater(pressure.min(), 0)

    def test_the_relief_valve_limits_the_line(self):
        line = self.rows("hydraulics/line/pressure")
        self.assertLess(line.max(), 19.1e6)
        self.assertGreater(line.min(), 12e6)

    def test_valves_that_close_stop_the_load(self):
        """The boom vibrates due to the compliance of oil and steel; the mean length of the cylinder is constant."""
        rate = self.rows("elements/lift/rate")
        self.assertGreater(np.abs(rate).max(), 0.1)
        for begin, end in ((2.5, 4.0), (5.5, 6.0)):
            still = (self.time > begin) & (self.time < end)
            self.assertLess(np.abs(rate[still].mean()), 0.03 * np.abs(rate).max())

    def test_its_circuit_is_drawn(self):
        folder = os.path.join(self.folder, "figures")
        prepare_figures()
        done = run_python_tool(os.path.join(TOOLS, "bielle-plot"), [self.path, "-o", folder])
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertLessEqual({"hydraulics.png", "element_lift.png", "element_fold.png"}, set(os.listdir(folder)))

    def test_energy_balance_closes(self):
        balance, put_in = self.rows("energy/balance"), self.rows("energy/input")
        self.assertLess(np.abs(balance).max(), 1e-5 * np.abs(put_in).max())

    def test_half_the_step_moves_the_load_alike(self):
        model, target = os.path.join(self.folder, "fine.yaml"), os.path.join(self.folder, "fine.h5")
        with open(os.path.join(self.folder, self.model), encoding="utf-8") as file:
            text = file.read()
        with open(model, "w", encoding="utf-8") as file:
            file.write(text.replace("step: 2.0e-3", "step: 1.0e-3"))
        subprocess.run([PROGRAM, model, "-o", target, "--quiet"], check=True, timeout=600)
        with Results(target) as fine:
            height, time = np.squeeze(fine.rows("measures/load_height")), fine.time
        self.assertLess(np.abs(np.interp(self.time, time, height) - self.rows("measures/load_height")).max(), 2e-3)


if __name__ == "__main__":
    unittest.main()
