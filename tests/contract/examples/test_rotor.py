"""Compares whirl frequencies of mechanism/examples/rotor.yaml over the speed with Euler-Bernoulli elements and a
gyroscopic disc."""

import os
import subprocess
import sys
import tempfile
import unittest

import h5py
import matplotlib.image
import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from python_tool import REPOSITORY, TOOLS, prepare_figures, run_python_tool  # noqa: E402

sys.path.insert(0, TOOLS)
PROGRAM = os.path.join(os.environ["BIELLE_PROGRAMS"], "bielle-mechanism")
MODEL = os.path.join(REPOSITORY, "mechanism", "examples", "rotor.yaml")

HEIGHT, ARM, YOUNG, DENSITY, WIDTH_X, WIDTH_Y = 1.2, 0.1, 2.1e11, 7850, 0.03, 0.02
RADIUS, THICKNESS = 0.25, 0.02


def bending(stiffness, mass, elements=20):
    """Returns K and M of a cantilever of cubic elements, over displacement and slope of each node except the first."""
    h = HEIGHT / elements
    k = stiffness / h**3 * np.array([[12, 6*h, -12, 6*h], [6*h, 4*h*h, -6*h, 2*h*h], [-12, -6*h, 12, -6*h], [6*h, 2*h*h, -6*h, 4*h*h]])
    m = mass * h / 420 * np.array([[156, 22*h, 54, -13*h], [22*h, 4*h*h, 13*h, -3*h*h], [54, 13*h, 156, -22*h], [-13*h, -3*h*h, -22*h, 4*h*h]])
    K, M = (np.zeros((2 * elements + 2, 2 * elements + 2)) for _ in range(2))
    for e in range(elements):
        K[2*e:2*e+4, 2*e:2*e+4] += k
        M[2*e:2*e+4, 2*e:2*e+4] += m
    return K[2:, 2:], M[2:, 2:]


def whirl(speed):
    """Returns the bending frequencies [Hz] in both planes, which the disc couples; with the slopes a = x' and b = y',
    it tilts by (-b, a)."""
    disc = np.pi * RADIUS**2 * THICKNESS * DENSITY
    across, along = disc * (RADIUS**2 / 4 + THICKNESS**2 / 12), disc * RADIUS**2 / 2
    area = WIDTH_X * WIDTH_Y
    planes = [bending(YOUNG * WIDTH_Y * WIDTH_X**3 / 12, DENSITY * area), bending(YOUNG * WIDTH_X * WIDTH_Y**3 / 12, DENSITY * area)]
    n = len(planes[0][0])
    K, M, G = (np.zeros((2 * n, 2 * n)) for _ in range(3))
    for p, (k, m) in enumerate(planes):
        m[-2:, -2:] += disc * np.array([[1, ARM], [ARM, ARM**2]]) + np.array([[0, 0], [0, across]])
        K[p*n:(p+1)*n, p*n:(p+1)*n], M[p*n:(p+1)*n, p*n:(p+1)*n] = k, m
    # Euler's equations of a disc that tilts by (-b, a) contain J_t a'' - J_p Om (-b)', and an antisymmetric
    # counterpart.
    G[n-1, 2*n-1], G[2*n-1, n-1] = along * speed, -along * speed
    inverse = np.linalg.inv(M)
    A = np.block([[np.zeros_like(K), np.eye(2 * n)], [-inverse @ K, -inverse @ G]])
    s = np.linalg.eigvals(A)
    return np.sort(s.imag[s.imag > 0]) / (2 * np.pi)


class Rotor(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder, cls.said = cls.enterClassContext(tempfile.TemporaryDirectory()), {}

    def run_at(self, speed):
        """Runs the model once at a speed [rad/s]. @returns the path of its results; its summary is in `said`"""
        target = os.path.join(self.folder, f"at_{speed}.h5")
        if speed not in self.said:
            done = subprocess.run([PROGRAM, MODEL, "-o", target, "--set", f"speed={speed}"], capture_output=True, text=True, timeout=100)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.said[speed] = done.stdout
        return target

    def modes(self, speed):
        with h5py.File(self.run_at(speed)) as file:
            modes = file["/eigen"]
            kinds = list(modes["kind"].asstr())
            return kinds, modes["frequency"][:], modes["damping_ratio"][:], self.said[speed]

    def test_frequencies_of_whirl_split_with_the_speed(self):
        for speed in (0, 30, 120):
            kinds, frequencies, ratios, summary = self.modes(speed)
            oscillating = [f for f, kind in zip(frequencies, kinds) if kind == "oscillating"][:5]
            # The reference neglects shear, which changes the sixth frequency by 3e-3, and axial motion.
            np.testing.assert_allclose(oscillating, whirl(speed)[:5], rtol=3e-3, err_msg=str(speed))
            self.assertEqual(kinds[:2], ["rigid", "decaying"])  # the disc's angle, and its speed against the bearing
            self.assertTrue(np.all(ratios[2:] > 0))
            self.assertEqual("axes that do not turn" in summary.split("campbell,")[0], speed > 0)
            self.assertNotIn("not steady", summary)

    def test_a_study_over_the_speed_has_its_modes(self):
        with tempfile.TemporaryDirectory() as folder:
            table, target = os.path.join(folder, "speeds.csv"), os.path.join(folder, "speeds.h5")
            with open(table, "w") as file:
                file.write("speed\n10\n80\n")
            done = run_python_tool(os.path.join(TOOLS, "bielle-study"), [MODEL, table, "-o", target],
                                   environment={**os.environ, "BIELLE_BIN": os.environ["BIELLE_PROGRAMS"]})
            self.assertEqual(done.returncode, 0, done.stderr)
            with h5py.File(target) as file:
                for k, speed in enumerate(file["/parameters/speed"], start=1):
                    frequencies = file[f"/runs/{k}/eigen/frequency"][:]
                    np.testing.assert_allclose(frequencies[2:6], whirl(float(speed))[:4], rtol=3e-3)

    def test_the_campbell_diagram_has_the_frequencies_of_every_speed_and_is_drawn(self):
        with tempfile.TemporaryDirectory() as folder:
            target = self.run_at(30)
            with h5py.File(target) as file:
                found = file["/campbell"]
                speeds, frequencies, senses = found["speed"][:], found["damped_frequency"][:], found["whirl"][:]
                critical, order = found["critical_speed"][:], found["critical_order"][:]
            np.testing.assert_allclose(speeds, np.linspace(0, 120, 25), atol=1e-12)
            for speed, row in zip(speeds, frequencies):
                np.testing.assert_allclose(np.sort(row), whirl(speed)[:5], rtol=3e-3)
            # Each line is smooth: its second differences are small, unlike those of lines with jumps.
            self.assertLess(np.abs(np.diff(frequencies, 2, axis=0)).max(), 0.05 * np.abs(np.diff(frequencies, axis=0)).max() + 0.05)
            self.assertEqual(sorted(np.sign(senses[-1, :4])), [-1, -1, 1, 1])
            # At a critical speed, one frequency of the reference equals the speed.
            self.assertTrue(np.all(order == 1))
            for speed in critical:
                self.assertLess(np.abs(2 * np.pi * whirl(speed) - speed).min(), 3e-3 * speed)
            prepare_figures()
            drawn = run_python_tool(os.path.join(TOOLS, "bielle-plot"), [target, "-o", folder])
            self.assertEqual(drawn.returncode, 0, drawn.stderr)
            self.assertIn("campbell.png", drawn.stdout)
            picture = matplotlib.image.imread(os.path.join(folder, "campbell.png"))[:, :, :3]
            self.assertGreater((picture < 0.8).any(axis=2).mean(), 0.005)

    def test_the_shapes_are_those_of_whirls(self):
        with h5py.File(self.run_at(120)) as file:
            modes = file["/eigen"]
            disc = list(modes["nodes"].asstr()).index("disc")
            shapes = modes["displacement"][:, disc] @ [1, 1j]
            turns = modes["rotation"][:, disc] @ [1, 1j]
        # The phase between x and y gives the sense of rotation of x + i y.
        senses = [np.sign((turn[0].conjugate() * turn[1]).imag) for turn in turns[2:6]]
        self.assertEqual(len(shapes), 9)  # the rigid rotation, and eight others
        self.assertEqual(sorted(senses), [-1, -1, 1, 1])


if __name__ == "__main__":
    unittest.main()
