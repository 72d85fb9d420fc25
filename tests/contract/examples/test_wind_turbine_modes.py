"""Compares mechanism/examples/wind_turbine_modes.yaml with Rayleigh's quotient of the tower, with its critical speeds,
and with finer beams."""

import math
import os
import subprocess
import tempfile
import unittest

import numpy as np

from example import EXAMPLES, PROGRAM, ExampleTest, Results

LENGTH, ARM = 39, 1  # height of the tower, distance from its top to the axis [m]
OUTER, INNER, YOUNG, DENSITY = 0.95, 0.92, 2.1e11, 7850
BLADE_DENSITY, ROOT, TIP = 1900, 1.5, 20


def blade():
    """Returns the mass of a blade, and its moment of inertia about the axis of the shaft."""
    s = (np.arange(4000) + 0.5) / 4000
    width, height, wall = 1.6 - 1.1 * s, 0.45 - 0.35 * s, 0.02 - 0.014 * s
    line = BLADE_DENSITY * (width * height - (width - 2 * wall) * (height - 2 * wall))
    r = ROOT + (TIP - ROOT) * s
    return np.mean(line) * (TIP - ROOT), np.mean(line * r ** 2) * (TIP - ROOT)


def tower_sideways():
    """Returns the frequency [Hz] of the tower across the shaft at rest by Rayleigh's quotient, with the deflection by a
    force at the top.

    The shaft turns freely, so that the rotor does not resist a rotation of the tower's top about the shaft.
    """
    inertia, area = math.pi / 4 * (OUTER ** 4 - INNER ** 4), math.pi * (OUTER ** 2 - INNER ** 2)
    z = (np.arange(4000) + 0.5) / 4000
    shape = (3 * z ** 2 - z ** 3) / 2
    tilt = 1.5 / LENGTH  # rotation of the top for a unit displacement
    moved = 1 + tilt * ARM
    kinetic = DENSITY * area * LENGTH * np.mean(shape ** 2) + (7000 + 2000 + 3 * blade()[0]) * moved ** 2
    kinetic += 7000 / 12 * (2 ** 2 + 2 ** 2) * tilt ** 2
    return math.sqrt(3 * YOUNG * inertia / LENGTH ** 3 / kinetic) / (2 * math.pi)


class WindTurbineModes(ExampleTest):
    model = "wind_turbine_modes.yaml"

    def setUp(self):
        found = self.results.file["/campbell"]
        self.names = list(found["name"].asstr())
        self.speed, self.frequency = found["speed"][:], found["damped_frequency"][:]
        self.critical = {key: found[f"critical_{key}"][:] for key in ("speed", "frequency", "order", "mode")}

    def test_the_tower_at_rest_has_rayleighs_frequency(self):
        # The quotient is an upper bound. Blades that bend at 5.4 Hz lower their share of it by (0.88/5.4)^2.
        self.assertEqual(self.speed[0], 0)
        expected = tower_sideways()
        nearest = self.frequency[0][np.argmin(np.abs(self.frequency[0] - expected))]
        self.assertLess(nearest, expected)
        self.assertGreater(nearest, 0.985 * expected)

    def test_every_mode_is_followed_to_the_end_and_occurs_once(self):
        self.assertEqual(self.frequency.shape, (7, 5))
        self.assertTrue(np.all(np.isfinite(self.frequency)))
        for row in self.frequency[1:]:
            self.assertGreater(np.diff(np.sort(row)).min(), 1e-6 * row.max())

    def test_modes_have_different_names_of_blades_and_tower(self):
        self.assertEqual(len(set(self.names)), 5)
        for name in ("1st tower fore-aft", "1st tower side-side", "1st blade flap, backward", "1st blade flap, forward"):
            self.assertIn(name, self.names)

    def test_critical_speeds_are_where_orders_meet_frequencies(self):
        self.assertEqual(set(self.critical["order"]), {1, 3})
        columns = [self.critical[key] for key in ("speed", "frequency", "order", "mode")]
        for speed, frequency, order, mode in zip(*columns):
            self.assertAlmostEqual(order * speed / (2 * math.pi * frequency), 1, delta=1e-6)
            line = self.frequency[:, int(mode) - 1]
            self.assertAlmostEqual(np.interp(speed, self.speed, line) / frequency, 1, delta=0.02)
        # The frequency of the tower hardly depends on the speed, so that 3P crosses it at a third of the speed of 1P.
        tower = tower_sideways() * 2 * math.pi
        for order in (1, 3):
            speeds = self.critical["speed"][self.critical["order"] == order]
            self.assertLess(np.abs(speeds * order / tower - 1).min(), 0.05)


class Convergence(unittest.TestCase):
    """Returns the frequencies at 6 rad/s with 1, 2 and 4 times as many elements of blades and tower as in the
    example."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        with open(os.path.join(EXAMPLES, "wind_turbine_modes.yaml"), encoding="utf-8") as file:
            text = file.read()
        begin = text.index("  - {type: campbell")
        cls.found = []
        for times in (1, 2, 4):
            finer = text[:begin] + "  - {type: eigen, count: 8, shapes: false, rotation: {joint: shaft, rate: 6, state: mean}}\n"
            for elements in (4, 3):
                assert finer.count(f"elements: {elements}\n") == 1
                finer = finer.replace(f"elements: {elements}\n", f"elements: {times * elements} \n")
            path = os.path.join(folder.name, f"{times}.yaml")
            with open(path, "w", encoding="utf-8") as file:
                file.write(finer)
            subprocess.run([PROGRAM, path, "-o", path + ".h5", "--quiet"], check=True, timeout=600)
            cls.finest = path
            results = Results(path + ".h5")
            modes = results.file["/eigen"]
            cls.found.append(dict(zip(modes["name"].asstr(), modes["damped_frequency"][:])))
            results.file.close()
        # The order is 4, so that the error of the finest beams is a fifteenth of the difference from the previous ones.
        cls.limit = {name: fine + (fine - cls.found[1][name]) / 15 for name, fine in cls.found[2].items()}

    def test_the_modes_of_the_example_are_within_half_a_percent_of_the_limit(self):
        for name in ("1st tower fore-aft", "1st tower side-side", "1st blade flap, backward", "1st blade flap, collective", "1st blade flap, forward"):
            self.assertAlmostEqual(self.found[0][name] / self.limit[name], 1, delta=5e-3, msg=name)

    def test_faster_modes_are_within_one_percent_of_the_limit(self):
        for name, frequency in self.found[0].items():
            if frequency > 1e-3:
                self.assertAlmostEqual(frequency / self.limit[name], 1, delta=1e-2, msg=name)

    def test_fine_beams_have_constant_coefficients(self):
        """The rounding of their stiffness must not count as coupling with further harmonics, of which up to 64 would be
        tried."""
        path = self.finest + ".more.yaml"
        with open(self.finest, encoding="utf-8") as file:
            text = file.read().replace("count: 8", "count: 16").replace("rate: 6", "rate: 5.3926")
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        done = subprocess.run([PROGRAM, path, "-o", path + ".h5"], check=True, capture_output=True, text=True, timeout=300)
        self.assertIn("constant in multiblade coordinates", done.stdout)

    def test_blades_converge_with_the_fourth_order(self):
        coarse, middle, fine = self.found
        for name in ("1st blade flap, backward", "1st blade flap, collective", "1st blade flap, forward", "2nd blade flap, backward"):
            order = math.log2((middle[name] - coarse[name]) / (fine[name] - middle[name]))
            self.assertGreater(order, 3.5, name)


if __name__ == "__main__":
    unittest.main()
