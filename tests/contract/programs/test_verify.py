"""Tests of bielle-reduce --verify and --against: exit statuses and messages, for superelements and matrix files."""

import os
import unittest

import h5py
import numpy

from command import CommandTest
from test_reduce import BAR, BODY

LENGTH, STIFFNESS, MASS = 0.5, 1e6, 0.4  # [m], [N], [kg/m]: EA = STIFFNESS, EI and GJ follow from a square of 20 mm


def beam(elements):
    """Returns K and the consistent M of a straight Euler-Bernoulli beam along x (Przemieniecki 1968, chapter 11)."""
    size, count = LENGTH / elements, 6 * (elements + 1)
    bending, torsion, polar = STIFFNESS * 0.02 ** 2 / 12, STIFFNESS * 0.02 ** 2 / 16, MASS * 0.02 ** 2 / 6
    K, M = numpy.zeros((count, count)), numpy.zeros((count, count))
    bar, line = numpy.array([[1, -1], [-1, 1]]), numpy.array([[2, 1], [1, 2]])
    for e in range(elements):
        at = 6 * e + numpy.arange(12)

        def add(matrix, places, part):
            matrix[numpy.ix_(at[places], at[places])] += part

        add(K, [0, 6], STIFFNESS / size * bar)
        add(K, [3, 9], torsion / size * bar)
        add(M, [0, 6], MASS * size / 6 * line)
        add(M, [3, 9], polar * size / 6 * line)
        for places, s in (([1, 5, 7, 11], size), ([2, 4, 8, 10], -size)):
            add(K, places, bending / size ** 3 * numpy.array([[12, 6 * s, -12, 6 * s], [6 * s, 4 * s * s, -6 * s, 2 * s * s],
                                                              [-12, -6 * s, 12, -6 * s], [6 * s, 2 * s * s, -6 * s, 4 * s * s]]))
            add(M, places, MASS * size / 420 * numpy.array([[156, 22 * s, 54, -13 * s], [22 * s, 4 * s * s, 13 * s, -3 * s * s],
                                                            [54, 13 * s, 156, -22 * s], [-13 * s, -3 * s * s, -22 * s, 4 * s * s]]))
    return K, M


class Verify(CommandTest):
    program = "bielle-reduce"

    def write_matrices(self, name, elements=6, scale=1.0, units=True, change=None):
        K, M = beam(elements)
        positions = numpy.zeros((elements + 1, 3))
        positions[:, 0] = numpy.linspace(0, LENGTH, elements + 1) * scale
        if change:
            change(K, M, positions)
        with h5py.File(self.path(name), "w") as file:
            file.attrs.update({"format": "bielle matrices", "version": 1, "name": "beam", "source": "beam of the test"})
            if units:
                file.attrs["length_unit"] = "m"
            file["nodes/numbers"] = numpy.arange(1, elements + 2)
            file["nodes/positions"] = positions
            file["unknowns/nodes"] = numpy.repeat(numpy.arange(elements + 1), 6)
            file["unknowns/components"] = numpy.tile(numpy.arange(6), elements + 1)
            for group, matrix in (("stiffness", K), ("mass", M)):
                rows, columns = numpy.nonzero(matrix)
                file[f"{group}/rows"], file[f"{group}/columns"], file[f"{group}/values"] = rows, columns, matrix[rows, columns]

    def verified(self, status, *arguments):
        done = self.run_program("--verify", *arguments)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        self.assertEqual(done.stderr, "")
        return done.stdout

    def test_sound_matrices_pass(self):
        self.write_matrices("beam.h5")
        said = self.verified(0, "beam.h5")
        self.assertRegex(said, r"(?m)^verified: \d+ checks passed$")
        for text in ("beam: beam of the test", "42 unknowns, 0 of them scalars, at 7 nodes", "mass 0.2 kg", "free-free:"):
            self.assertIn(text, said)

    def test_faults_come_first_by_name(self):
        def ground(K, M, positions):
            K[9, 9] *= 2  # node 2 rx

        self.write_matrices("beam.h5", change=ground)
        said = self.verified(1, "beam.h5")
        self.assertRegex(said.splitlines()[2], r"^\d of \d+ checks fail: ")
        self.assertIn("the stiffness holds the body to the ground: 1 of 6 rigid motions cause force; most at node 2 rx", said)

    def test_a_mass_that_is_not_positive_is_not_reduced(self):
        def negative(K, M, positions):
            M *= -1

        def none(K, M, positions):
            M *= 0

        def coupled(K, M, positions):
            M[8, 14] = M[14, 8] = 10 * M[8, 8]  # node 2 z and node 3 z

        for change, says in ((negative, "the mass is not positive: scaled to a unit diagonal its least eigenvalue is -"),
                             (none, "moved as a whole, the body has the mass 0 kg; a mass matrix is needed"), (coupled, "the mass is not positive")):
            with self.subTest(says):
                self.write_matrices("beam.h5", change=change)
                self.write("body.yaml", "body: beam\nmatrices: beam.h5\ninterfaces: {root: {node: 1}, tip: {node: 7}}\nmodes: {count: 8}\n")
                self.expect_refusal(1, "body.yaml", says=[says])
                self.assertFalse(os.path.exists(self.path("body.h5")))

    def test_a_body_that_cannot_move_as_a_whole(self):
        """A body with a spring to the ground has no rigid motions to verify."""
        numpy.savez(self.path("spring.npz"), K=[[1.0]], M=[[1.0]], positions=[[0.0, 0, 0]], unknown_nodes=[1], unknown_components=[0])
        self.assertIn("the body cannot move as a whole by its positions: the unknowns of its nodes cannot follow all six rigid motions",
                      self.verified(1, "spring.npz"))

    def test_a_wrong_unit_of_positions(self):
        self.write_matrices("beam.h5", scale=1000)
        self.assertIn("positions look like millimetres where the matrices are in metres", self.verified(1, "beam.h5"))

    def test_units_that_were_not_declared(self):
        def in_mm_t_s(K, M, positions):
            unit = numpy.tile([1e-3, 1e-3, 1e-3, 1, 1, 1], len(positions))  # m per mm
            K *= 1e3 * numpy.outer(unit, unit)  # energy: 1 J is 1000 N mm
            M *= 1e3 * numpy.outer(unit, unit)
            positions *= 1e3

        self.write_matrices("beam.h5", units=False, change=in_mm_t_s)
        self.assertIn("its units are probably mm-t-s: `--units mm-t-s`, or `units: mm-t-s` in a body file, converts them", self.verified(1, "beam.h5"))
        said = self.verified(0, "beam.h5", "--units", "mm-t-s")
        self.assertIn("mass 0.2 kg", said)
        self.expect_refusal(1, "--verify", "beam.h5", "--units", "mm-t-m", says=["'m' is no unit of time; did you mean 'ms'"])

    def test_a_reduced_body_against_itself_and_against_another(self):
        self.write("bar.geo", BAR)
        self.write("body.yaml", BODY)
        done = self.run_program("body.yaml")
        self.assertEqual(done.returncode, 0, done.stderr)
        said = self.verified(0, "body.h5", "--against", "body.h5")
        self.assertRegex(said, r"(?m)^verified: \d+ checks passed$")
        self.assertIn("cross-orthogonality in the mass, each with its counterpart: 1.0000", said)
        self.assertIn("fixed-base, 12 unknowns held:", said)
        self.write_matrices("beam.h5")
        self.assertIn("their masses differ: 0.628 and 0.2 kg", self.verified(1, "body.h5", "--against", "beam.h5"))

    def test_wrong_requests_are_refused(self):
        self.write_matrices("beam.h5")
        self.write("deck.bdf", "CEND\n")
        self.expect_refusal(1, "--verify", "deck.bdf", says=["deck.bdf", "holds no DMIG"])
        self.expect_refusal(1, "--verify", "none.h5", says=["none.h5"])
        self.expect_refusal(1, "--verify", "beam.h5", "--units", "mm-t-s", says=["the file declares the unit of length m"])
        self.expect_refusal(1, "--against", "beam.h5", says=["expected one of: a body file"])
        self.expect_refusal(1, "--list", "beam.h5", "--against", "beam.h5", says=["--against goes with --verify FILE"])


if __name__ == "__main__":
    unittest.main()
