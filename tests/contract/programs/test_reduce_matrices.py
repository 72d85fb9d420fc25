"""Tests of bodies from matrices of other programs: `--from`, body files with `matrices`, and their motion in a
mechanism."""

import os
import subprocess
import unittest

import h5py
import numpy as np

from command import PROGRAMS, CommandTest
from shares import share_of_tests as load_tests  # noqa: E402,F401

MECHANISM = os.path.join(PROGRAMS, "bielle-mechanism")
LENGTH = 1.0
SPIN = """\
mechanism: spin
nodes:
  a: {position: [0, 0, 0], velocity: [0.3, -10, 0.2], angular_velocity: [0, 0, 20]}
  b: {position: [1, 0, 0], velocity: [0.3, 10, 0.2], angular_velocity: [0, 0, 20]}
elements: {rod: {type: superelement, file: body.h5, nodes: {node_1: a, node_2: b}}}
analysis: [{type: dynamic, duration: 0.35, step: 0.0005}]
"""


def beam(EA=1e6, GJ=1e3, EI=2e3, rho=2.0, polar=2e-4):
    """Returns K and M of an Euler-Bernoulli beam of length 1 along x between two nodes (J. S. Przemieniecki, Theory of
    Matrix Structural Analysis, 1968)."""
    K, M = np.zeros((12, 12)), np.zeros((12, 12))
    for places, stiffness, mass in (((0, 6), EA, rho), ((3, 9), GJ, polar)):
        K[np.ix_(places, places)] += stiffness * np.array([[1, -1], [-1, 1]])
        M[np.ix_(places, places)] += mass / 6 * np.array([[2, 1], [1, 2]])
    for places, s in (((1, 5, 7, 11), 1), ((2, 4, 8, 10), -1)):
        K[np.ix_(places, places)] += EI * np.array([[12, 6 * s, -12, 6 * s], [6 * s, 4, -6 * s, 2], [-12, -6 * s, 12, -6 * s], [6 * s, 2, -6 * s, 4]])
        M[np.ix_(places, places)] += rho / 420 * np.array([[156, 22 * s, 54, -13 * s], [22 * s, 4, 13 * s, -3], [54, 13 * s, 156, -22 * s],
                                                           [-13 * s, -3, -22 * s, 4]])
    return K, M


class Matrices(CommandTest):
    program = "bielle-reduce"

    def write(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)

    def write_beam(self, K=None, M=None, **more):
        found = beam()
        np.savez(self.path("beam.npz"), K=found[0] if K is None else K, M=found[1] if M is None else M, positions=[[0, 0, 0], [LENGTH, 0, 0]],
                 unknown_nodes=np.repeat([1, 2], 6), unknown_components=np.tile(np.arange(6), 2), **more)

    def run_mechanism(self, model):
        self.write("model.yaml", model)
        done = subprocess.run([MECHANISM, "model.yaml", "-o", "run.h5", "--quiet"], cwd=self.folder, capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, 0, done.stderr)
        return h5py.File(self.path("run.h5"))


class Files(Matrices):
    def test_a_file_becomes_a_superelement(self):
        self.write_beam()
        done = self.run_program("--from", "beam.npz", "-o", "body.h5")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("inertia of large rotations", done.stderr)
        K, M = beam()
        with h5py.File(self.path("body.h5")) as file:
            self.assertEqual(list(file["interface/names"].asstr()), ["node_1", "node_2"])
            np.testing.assert_allclose(file["reduced/stiffness"], K, rtol=0, atol=1e-9 * np.abs(K).max())
            np.testing.assert_allclose(file["reduced/mass"], M, rtol=0, atol=1e-12)
            np.testing.assert_allclose(np.sum(file["reduced/inertia_components"][:3], axis=0), M, rtol=0, atol=1e-12)
        self.assertEqual(self.run_program("--inspect", "body.h5").returncode, 0)

    def test_a_free_spinning_beam_keeps_momentum_and_energy(self):
        self.write_beam()
        self.assertEqual(self.run_program("--from", "beam.npz", "-o", "body.h5").returncode, 0)
        with self.run_mechanism(SPIN) as file:
            run = file["analysis_1"]
            time = run["time"][:]
            a, b = run["nodes/a/position"][:], run["nodes/b/position"][:]
            # The centre moves straight on; the ends rotate about it at 20 rad/s like a rigid body, except for the
            # stretching by the spin.
            np.testing.assert_allclose((a + b)[:, 0] / 2, 0.5 + 0.3 * time, atol=2e-4)
            np.testing.assert_allclose((a + b)[:, 2] / 2, 0.2 * time, atol=1e-6)
            angle = np.unwrap(np.arctan2(*(b - a)[:, 1::-1].T))
            np.testing.assert_allclose(angle, 20 * time, atol=2e-3 * 7)
            # The elongation of a free rod in steady rotation is u = rho w^2 L^3 / (12 EA) to first order.
            stretch = np.linalg.norm(b - a, axis=1) - 1
            self.assertAlmostEqual(np.mean(stretch[len(stretch) // 4:]) / (2.0 * 400 / 12e6), 1, delta=0.1)

    def test_units(self):
        K, M = beam()
        scale = np.tile([1e3] * 3 + [1] * 3, 2)  # unknowns in millimetres: energies in mJ
        np.savez(self.path("beam.npz"), K=1e3 * K / np.outer(scale, scale), M=1e3 * M / np.outer(scale, scale), positions=[[0, 0, 0], [1e3, 0, 0]],
                 unknown_nodes=np.repeat([1, 2], 6), unknown_components=np.tile(np.arange(6), 2))
        done = self.run_program("--from", "beam.npz", "--units", "mm-t-s", "-o", "body.h5")
        self.assertEqual(done.returncode, 0, done.stderr)
        with h5py.File(self.path("body.h5")) as file:
            np.testing.assert_allclose(file["reduced/stiffness"], K, rtol=0, atol=1e-9 * np.abs(K).max())
            np.testing.assert_allclose(file["mass_properties/mass"], 2)

    def test_a_body_file(self):
        self.write_beam()
        self.write("body.yaml", """\
body: beam
matrices: {file: beam.npz}
interfaces:
  hub: {node: 1}
  end: {node: 2, directions: [x, y, z, rx, ry], axes: {x: [1, 0, 0], y: [0, 1, 0]}}
points: {tip: {node: 2}}
damping: {ratio: 0.01}
""")
        done = self.run_program("body.yaml")
        self.assertEqual(done.returncode, 0, done.stderr)
        with h5py.File(self.path("body.h5")) as file:
            self.assertEqual(list(file["interface/names"].asstr()), ["hub", "end"])
            # There are 11 directions, and a mode of the released one.
            self.assertEqual(file["reduced/stiffness"].shape, (12, 12))
            self.assertIn("tip", file["points"])

    def test_wrong_body_files(self):
        self.write_beam()
        head = "body: beam\nmatrices: beam.npz\n"
        for text, says in ((head + "mesh: {size: 1}\n", "belongs to a geometry"), (head + "interfaces: {}\n", "at least one"),
                           (head + "interfaces: {a: {node: 3}}\n", "no node 3"), (head + "interfaces: {a: {surface: left}}\n", "no surfaces"),
                           (head + "interfaces: {a: {node: 1, nodes: [1, 2]}}\n", "either `node`"), (head + "interfaces: {a: {}}\n", "either `node`"),
                           (head + "interfaces: {a: {nodes: [1, 2], tie: free}}\n", "rigid or average"),
                           (head + "interfaces: {a: {nodes: [1, 2], tie: average, weights: [1]}}\n", "one weight for each of the 2 nodes"),
                           (head + "interfaces: {a: {nodes: [1], weights: [1]}}\n", "weights belong to 'tie: average'"),
                           (head + "modes: {count: 2, proof: true}\n", "modes of matrices are not counted"),
                           (head + "modes: {count: 7}\n", "7 fixed-boundary modes are asked for"), (head + "points: {p: {group: x}}\n", "either `node`"),
                           (head + "points: {p: {node: 9}}\n", "no node 9"), (head + "spin: [0, 0, 1]\n", "no geometric stiffness"),
                           ("body: b\nmatrices: {file: beam.npz, units: furlongs}\n", "units"),
                           ("body: b\nmatrices: {file: beam.npz, fromat: npz}\n", "did you mean 'format'"),
                           ("body: b\nmatrices: nothing.npz\n", "nothing.npz"),
                           ("body: b\ngeometry: x.geo\nspin: [0, 0, 1]\nmaterials: {}\ninterfaces: {}\nmodes: {count: 1}\n", "geometric stiffness of `matrices`"),
                           ("body: b\n", "'geometry' is missing")):
            with self.subTest(says):
                self.write("body.yaml", text)
                self.expect_refusal(1, "body.yaml", says=["body.yaml", says] if "nothing" not in says else [says])

    def test_wrong_matrices(self):
        K, M = beam()
        grounded, turned, mirrored = K.copy(), K.copy(), M.copy()
        grounded[2, 2] += 1e6
        turned[1, 5] *= 1.1
        mirrored[0, 6] = 0
        for matrices, says in (({"K": grounded}, "held to the ground"), ({"K": turned}, "node 1 rz"), ({"M": mirrored}, "mass is not symmetric"),
                               ({"M": 0 * M}, "a mass matrix is needed"), ({"M": 1e-300 * M}, "a mass matrix is needed"),
                               ({"K": 1e150 * K}, "the stiffness holds the number 1e+156"),
                               ({"C": -1e-3 * K}, "the matrices make no superelement: /reduced/damping: is not positive"),
                               ({"inertia_components": np.zeros((6, 12, 12))}, "translated, the body has inertia components that differ from its mass by 100 %"),
                               ({"interface_names": ["", "b"], "interface_nodes": [1, 2]}, "the interface at node 1 has no name"), ({"K": 0 * K, "M": 0 * M}, "are zero"), ({"M": -M}, "mass")):
            with self.subTest(says):
                self.write_beam(**matrices)
                self.expect_refusal(1, "--from", "beam.npz", "-o", "x.h5", says=[says])
                self.assertFalse(os.path.exists(self.path("x.h5")))

    def test_wrong_commands(self):
        self.write_beam()
        self.expect_refusal(1, "--from", "beam.npz", "body.yaml", says=["expected one of"])
        self.expect_refusal(1, "--from", "none.npz", says=["none.npz"])
        self.expect_refusal(1, "--from", "beam.npz", "-o", "beam.npz", says=["replace its own input"])
        self.expect_refusal(1, "body.yaml", "--units", "mm-t-s", says=["--units goes with --from and --verify"])


if __name__ == "__main__":
    unittest.main()
