"""Tests of bielle.rotations: round trips, comparison of tangent operators and accelerations with differences, SciPy,
and wrong arguments."""

import math
import unittest

import numpy as np
from scipy.linalg import expm
from scipy.spatial.transform import Rotation

import bielle
from bielle import rotations

KINDS = rotations.PARAMETRISATIONS
ANGLES = {"euler": "ZXZ", "bryant": "XYZ"}  # SciPy's words for rotations about moving axes
EPSILON = np.finfo(float).eps


def skew(v):
    x, y, z = v
    return np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])


def samples(kind):
    """Returns random matrices, and rotations by critical angles. Rodrigues vectors have no half turns."""
    random = np.random.default_rng(1)
    matrices = [Rotation.random(random_state=k).as_matrix() for k in range(60)]
    axes = [v / np.linalg.norm(v) for v in random.normal(size=(5, 3))] + [np.eye(3)[k] for k in range(3)]
    turns = [0, 1e-9, 1e-4, 1, math.pi / 2, math.pi - 1e-3, math.pi - 1e-9, math.pi, 3, 2 * math.pi, 40]
    for angle in turns:
        if kind == "rodrigues" and abs(angle - math.pi) < 1e-6:
            continue  # the first one is near infinity, where digits are lost; another test has half turns
        matrices += [expm(angle * skew(axis)) for axis in axes]
    return np.array(matrices)


def regular_parameters(kind, count=40):
    """Returns parameters away from singularities, not all of them principal."""
    random = np.random.default_rng(2)
    p = random.uniform(-1.4, 1.4, size=(count, 4 if kind == "quaternion" else 3))
    if kind == "euler":
        p[:, 1] = random.uniform(0.3, 2.8, size=count)
    if kind == "rotation_vector":
        p *= 2  # up to 4.8
    return p


class RoundTrips(unittest.TestCase):
    def test_matrices_come_back(self):
        for kind in KINDS:
            with self.subTest(kind):
                R = samples(kind)
                p = rotations.from_matrix(kind, R)
                # The tolerance is the rounding of R and of both conversions; Rodrigues vectors lose a factor of 1/(pi -
                # phi).
                np.testing.assert_allclose(rotations.to_matrix(kind, p), R, atol=2e-13 if kind == "rodrigues" else 2e-14)

    def test_parameters_of_half_turns(self):
        R = np.array([np.diag([1.0, -1, -1]), np.diag([-1.0, 1, -1]), np.diag([-1.0, -1, 1])])
        np.testing.assert_allclose(np.abs(rotations.from_matrix("rotation_vector", R)), math.pi * np.eye(3), atol=1e-15)
        np.testing.assert_allclose(np.abs(rotations.from_matrix("conformal", R)), 4 * np.eye(3), atol=1e-15)
        with self.assertRaisesRegex(bielle.ComputationError, r"item \(1\): a half turn has no Rodrigues vector"):
            rotations.from_matrix("rodrigues", [np.eye(3), R[0]])

    def test_small_rotations_keep_their_digits(self):
        psi = np.array([3e-9, -2e-9, 1e-9])
        q = rotations.convert(psi, "rotation_vector", "quaternion")
        np.testing.assert_allclose(q[1:], psi / 2, rtol=1e-7)  # R = 1 + 1e-9, of which rounding leaves seven digits
        for kind, factor in (("rodrigues", 0.5), ("conformal", 1.0)):
            np.testing.assert_allclose(rotations.convert(psi, "rotation_vector", kind), factor * psi, rtol=1e-7)

    def test_many_turns(self):
        axis = np.array([2, -1, 2]) / 3
        angles = np.array([1.0, 1 + 2 * math.pi, 1 - 2 * math.pi, 1 + 200 * math.pi])
        psi = angles[:, None] * axis
        np.testing.assert_allclose(rotations.to_matrix("rotation_vector", psi), [expm(skew(axis))] * 4, atol=2e-13)  # 628 eps
        np.testing.assert_allclose(rotations.principal("rotation_vector", psi), [axis] * 4, atol=2e-13)

    def test_scipy_says_the_same(self):
        for R in samples("euler"):
            known = Rotation.from_matrix(R)
            p = rotations.from_matrix("quaternion", R)
            q = np.roll(known.as_quat(), 1)
            self.assertLess(min(np.abs(p - q).max(), np.abs(p + q).max()), 1e-14)
            psi = known.as_rotvec()
            if np.linalg.norm(psi) < math.pi - 1e-6:  # at half turns the sign of the axis is arbitrary
                np.testing.assert_allclose(rotations.from_matrix("rotation_vector", R), psi, atol=1e-13)
        random = np.random.default_rng(3)
        for kind, axes in ANGLES.items():
            angles = random.uniform(-7, 7, size=(50, 3))
            np.testing.assert_allclose(rotations.to_matrix(kind, angles), Rotation.from_euler(axes, angles).as_matrix(), atol=3e-15)
            p = rotations.principal(kind, angles)
            np.testing.assert_allclose(p, Rotation.from_matrix(rotations.to_matrix(kind, angles)).as_euler(axes), atol=1e-12)

    def test_conversions_go_through_every_pair(self):
        for kind in KINDS:
            p = rotations.principal(kind, regular_parameters(kind))
            for other in KINDS:
                q = rotations.convert(p, kind, other)
                np.testing.assert_allclose(rotations.to_matrix(other, q), rotations.to_matrix(kind, p), atol=2e-14)

    def test_rounding_of_matrices_is_corrected(self):
        R = expm(skew([0.3, -0.4, 0.8]))
        for noisy in (R.astype(np.float32), R.round(4)):
            p = rotations.from_matrix("bryant", noisy)
            found = rotations.to_matrix("bryant", p)
            np.testing.assert_allclose(found.T @ found, np.eye(3), atol=1e-15)
            u, _, v = np.linalg.svd(np.asarray(noisy, float))
            np.testing.assert_allclose(found, u @ v, atol=3e-15)


class Composition(unittest.TestCase):
    def test_is_the_product_of_matrices(self):
        for kind in KINDS:
            p, q = regular_parameters(kind), regular_parameters(kind)[::-1]
            R = rotations.to_matrix(kind, p) @ rotations.to_matrix(kind, q)
            r = rotations.compose(kind, p, q)
            np.testing.assert_allclose(rotations.to_matrix(kind, r), R, atol=1e-14)
            np.testing.assert_allclose(r, rotations.principal(kind, r), atol=1e-13)

    def test_one_with_many(self):
        q = regular_parameters("bryant")
        np.testing.assert_array_equal(rotations.compose("bryant", q[0], q)[7], rotations.compose("bryant", q[0], q[7]))
        grid = rotations.compose("bryant", q[:4, None], q[None, :5])
        self.assertEqual(grid.shape, (4, 5, 3))
        np.testing.assert_array_equal(grid[3, 2], rotations.compose("bryant", q[3], q[2]))


class Complements(unittest.TestCase):
    def test_are_other_parameters_of_the_same_rotation(self):
        for kind in KINDS:
            if kind == "rodrigues":
                continue
            p = rotations.principal(kind, regular_parameters(kind))
            other = rotations.complement(kind, p)
            np.testing.assert_allclose(rotations.to_matrix(kind, other), rotations.to_matrix(kind, p), atol=1e-14)
            self.assertGreater(np.abs(other - p).max(axis=1).min(), 0.1)
            np.testing.assert_allclose(rotations.complement(kind, other), p, atol=1e-13)

    def test_there_are_none(self):
        with self.assertRaisesRegex(bielle.ComputationError, "only one of its rotation"):
            rotations.complement("rodrigues", [0.1, 0.2, 0.3])
        with self.assertRaisesRegex(bielle.ComputationError, r"item \(1, 0\): .* no complement"):
            rotations.complement("rotation_vector", [[[1, 0, 0]], [[0, 0, 0]]])


class Derivatives(unittest.TestCase):
    """Central differences with steps h have a truncation of h^2 times numbers of about 10, and a rounding of
    1e-16/h."""

    H, TOLERANCE = 1e-5, 3e-9

    def test_the_tangent_is_the_derivative_of_the_matrix(self):
        for kind in KINDS:
            for p in regular_parameters(kind):
                T, spatial = rotations.tangent(kind, p), rotations.tangent(kind, p, frame="spatial")
                R = rotations.to_matrix(kind, p)
                for k, unit in enumerate(np.eye(len(p))):
                    ahead, behind = (rotations.to_matrix(kind, p + s * self.H * unit) for s in (1, -1))
                    dR = (ahead - behind) / (2 * self.H)
                    size = 1 / min(1, np.linalg.norm(p)) ** 3 if kind == "quaternion" else 1  # R depends on p/|p|
                    np.testing.assert_allclose(R.T @ dR, skew(T[:, k]), atol=self.TOLERANCE * size)
                    np.testing.assert_allclose(dR @ R.T, skew(spatial[:, k]), atol=self.TOLERANCE * size)

    def test_inverses(self):
        for kind in KINDS:
            p = regular_parameters(kind)
            for frame in ("material", "spatial"):
                T, inverse = rotations.tangent(kind, p, frame=frame), rotations.tangent_inverse(kind, p, frame=frame)
                np.testing.assert_allclose(T @ inverse, np.broadcast_to(np.eye(3), T.shape[:1] + (3, 3)), atol=1e-13)

    def test_derivatives_of_both(self):
        random = np.random.default_rng(4)
        for kind in KINDS:
            for p in regular_parameters(kind, 15):
                u = random.normal(size=p.shape)
                for frame in ("material", "spatial"):
                    for function, derivative in ((rotations.tangent, rotations.tangent_derivative),
                                                 (rotations.tangent_inverse, rotations.tangent_inverse_derivative)):
                        slope = (function(kind, p + self.H * u, frame=frame) - function(kind, p - self.H * u, frame=frame)) / (2 * self.H)
                        D = derivative(kind, p, u, frame=frame)
                        np.testing.assert_allclose(slope, D, atol=1e-7 * (1 + np.abs(D).max()))
                        self.assertGreater(np.abs(D).max(), 1e-3)

    def test_velocities_and_accelerations_along_a_motion(self):
        a, b, c = (np.random.default_rng(5).normal(size=(3, 3)) * 0.4)
        h = 1e-3

        def R(t):  # the rotation is neither about a fixed axis nor steady
            return expm(skew(a * t + b * t * t)) @ expm(skew(c * np.sin(2 * t))) @ expm(skew([0.5, 0.9, -0.4]))

        for kind in KINDS:
            for t in (0.2, 0.7):
                def at(s):
                    return rotations.nearest(kind, rotations.from_matrix(kind, R(s)), rotations.from_matrix(kind, R(t))) \
                        if kind in ("rotation_vector", "quaternion", "euler", "bryant") else rotations.from_matrix(kind, R(s))

                # Differences of fourth order have an error of h^4 = 1e-12 for first derivatives, and a rounding of
                # 1e-15/h^2 = 1e-9 for second ones.
                p = at(t)
                rate = (8 * (at(t + h) - at(t - h)) - (at(t + 2 * h) - at(t - 2 * h))) / (12 * h)
                acceleration = (16 * (at(t + h) + at(t - h)) - (at(t + 2 * h) + at(t - 2 * h)) - 30 * p) / (12 * h * h)
                dR = (8 * (R(t + h) - R(t - h)) - (R(t + 2 * h) - R(t - 2 * h))) / (12 * h)
                ddR = (16 * (R(t + h) + R(t - h)) - (R(t + 2 * h) + R(t - 2 * h)) - 30 * R(t)) / (12 * h * h)
                for frame in ("material", "spatial"):
                    with self.subTest(kind, t=t, frame=frame):
                        W = R(t).T @ dR if frame == "material" else dR @ R(t).T
                        dW = dR.T @ dR + R(t).T @ ddR if frame == "material" else ddR @ R(t).T + dR @ dR.T
                        omega, alpha = (np.array([A[2, 1] - A[1, 2], A[0, 2] - A[2, 0], A[1, 0] - A[0, 1]]) / 2 for A in (W, dW))
                        np.testing.assert_allclose(rotations.angular_velocity(kind, p, rate, frame=frame), omega, atol=1e-9)
                        np.testing.assert_allclose(rotations.angular_acceleration(kind, p, rate, acceleration, frame=frame), alpha,
                                                   atol=1e-7)
                        np.testing.assert_allclose(rotations.parameter_rate(kind, p, omega, frame=frame), rate, atol=1e-8)
                        np.testing.assert_allclose(rotations.parameter_acceleration(kind, p, omega, alpha, frame=frame), acceleration,
                                                   atol=1e-6)
                        self.assertGreater(np.abs(alpha).max(), 0.1)


class Singularities(unittest.TestCase):
    def test_the_table_is_true(self):
        self.assertEqual(tuple(rotations.SINGULARITIES), KINDS)
        axis = np.array([2, -1, 2]) / 3
        for kind, about in rotations.SINGULARITIES.items():
            for value in [v + n * about.period for v in about.values for n in (0, 1, 2)]:
                with self.subTest(kind, angle=value):
                    if about.angle == "b":
                        p = np.array([0.3, value, -0.4])
                        self.assertLess(abs(np.linalg.det(rotations.tangent(kind, p))), 1e-14)
                        self.assertRaises(bielle.ComputationError, rotations.parameter_rate, kind, p, [1, 0, 0])
                    elif kind == "rotation_vector":
                        self.assertLess(abs(np.linalg.det(rotations.tangent(kind, value * axis))), 1e-14)
                        self.assertRaises(bielle.ComputationError, rotations.parameter_rate, kind, value * axis, [1, 0, 0])
                    else:  # the parameters grow beyond all bounds
                        fraction = {"rodrigues": 2, "conformal": 4}[kind]
                        self.assertGreater(abs(math.tan(value / fraction)), 1e14)
            for value in [v + 0.5 for v in about.values]:  # elsewhere the value is the closed form, which is not zero
                p = np.array([0.3, value, -0.4]) if about.angle == "b" else value * axis
                closed = {"euler": -math.sin(value), "bryant": math.cos(value),
                          "rotation_vector": 2 * (1 - math.cos(value)) / value ** 2}
                if kind in closed:
                    self.assertAlmostEqual(np.linalg.det(rotations.tangent(kind, p)), closed[kind], delta=1e-14)


class Rows(unittest.TestCase):
    def follow(self, kind, R, step):
        """Asserts that continuous parameters of rows of matrices give the matrices, and make no larger step than
        `step`."""
        p = rotations.continuous(kind, rotations.from_matrix(kind, R))
        # An accuracy of 1e-8 remains next to the singularity.
        np.testing.assert_allclose(rotations.to_matrix(kind, p), R, atol=2e-8)
        self.assertLess(np.abs(np.diff(p, axis=0)).max(), step)
        return p

    def test_turns_are_counted(self):
        t = np.linspace(0, 1, 401)
        for axis in (np.array([0, 0, 1.0]), np.array([2, -1, 2]) / 3):
            angle = 30 * np.sin(2 * math.pi * t) + 5 * t
            psi = self.follow("rotation_vector", rotations.to_matrix("rotation_vector", angle[:, None] * axis), 0.6)
            np.testing.assert_allclose(psi, angle[:, None] * axis, atol=1e-12)

    def test_rows_exactly_at_full_and_half_turns(self):
        angle = np.pi * np.arange(-9, 10) / 2
        axis = np.array([0, 1.0, 0])
        psi = self.follow("rotation_vector", rotations.to_matrix("rotation_vector", angle[:, None] * axis), 1.6)
        np.testing.assert_allclose(psi - psi[0], (angle - angle[0])[:, None] * axis, atol=1e-12)

    def test_angles_go_through_their_singularities(self):
        t = np.linspace(0, 1, 501)
        for kind in ANGLES:
            # The middle angle makes several turns while the others change slowly.
            angles = np.column_stack([0.4 + 0.3 * t, 0.2 + 40 * t, -0.3 + 0.5 * t * t])
            p = self.follow(kind, rotations.to_matrix(kind, angles), 0.1)
            start = rotations.principal(kind, angles[0])
            np.testing.assert_allclose(start, angles[0], atol=1e-13)
            np.testing.assert_allclose(p, angles, atol=1e-9)

    def test_rows_within_a_singularity(self):
        # First b rises to its singularity, then the body rotates there about the outer axis, then b continues.
        n = 200
        for kind, top in (("bryant", math.pi / 2), ("euler", math.pi)):
            rise = np.column_stack([np.full(n, 0.4), np.linspace(top - 1, top, n), np.full(n, -0.3)])
            turn = np.column_stack([0.4 + np.linspace(0, 8, n), np.full(n, top), np.full(n, -0.3)])
            p = self.follow(kind, rotations.to_matrix(kind, np.concatenate([rise, turn])), 0.1)
            side = 1 if kind == "bryant" else -1
            np.testing.assert_allclose(p[n:, 0] + side * p[n:, 2], turn[:, 0] + side * turn[:, 2], atol=1e-9)
            np.testing.assert_allclose(p[:n - 1], rise[:-1], atol=1e-9)

    def test_rows_that_begin_within_a_singularity(self):
        b = np.linspace(0, 1, 50)
        angles = np.column_stack([np.full(50, 1.1), b, np.full(50, -1.1)])
        p = self.follow("euler", rotations.to_matrix("euler", angles), 0.1)
        np.testing.assert_allclose(p, angles, atol=1e-12)
        always = np.column_stack([np.linspace(0, 20, 100), np.zeros((100, 2))])  # a rotation about z alone
        np.testing.assert_allclose(self.follow("euler", rotations.to_matrix("euler", always), 0.3), always, atol=1e-12)

    def test_a_tumbling_motion_has_no_jumps(self):
        t = np.linspace(0, 10, 20001)
        R = np.array([expm(skew([0.3 * s, 2 * math.sin(s), 0])) @ expm(skew([0, 0, 5 * s])) for s in t])
        for kind in ("bryant", "euler", "quaternion"):
            # The body rotates by 5 mrad between rows, and angles change by 1/sin(b) times that.
            p = rotations.continuous(kind, rotations.from_matrix(kind, R))
            np.testing.assert_allclose(rotations.to_matrix(kind, p), R, atol=2e-8)
            self.assertLess(np.abs(np.diff(p, axis=0)).max(), 0.5)
        self.assertGreater(np.ptp(rotations.continuous("bryant", rotations.from_matrix("bryant", R))[:, 2]), 40)

    def test_several_bodies_at_once(self):
        t = np.linspace(0, 9, 200)
        angles = np.stack([np.column_stack([t, 0.1 * t, -t]), np.column_stack([-2 * t, 0.3 + 0 * t, t])], axis=1)
        p = rotations.continuous("bryant", rotations.principal("bryant", angles))
        np.testing.assert_allclose(p, angles, atol=1e-12)

    def test_nearest(self):
        np.testing.assert_allclose(rotations.nearest("bryant", [0.1, 0.2, 0.3], [12, 0, 0]), [0.1 + 4 * math.pi, 0.2, 0.3], atol=1e-14)
        np.testing.assert_allclose(rotations.nearest("bryant", [0.1, 1.5, 0.3], [3.2, 1.7, 3.5]),
                                   [0.1 + math.pi, math.pi - 1.5, 0.3 + math.pi], atol=1e-14)
        np.testing.assert_allclose(rotations.nearest("rotation_vector", [0, 0, 0.1], [0, 0, -19]), [0, 0, 0.1 - 6 * math.pi], atol=1e-14)
        np.testing.assert_allclose(rotations.nearest("rotation_vector", [0, 0, 0], [0, 0, 4 * math.pi]), [0, 0, 4 * math.pi], atol=1e-14)
        np.testing.assert_allclose(rotations.nearest("quaternion", [1, 0, 0, 0], [-0.9, 0.1, 0, 0]), [-1, 0, 0, 0])

    def test_what_cannot_be_continued(self):
        for kind in ("rodrigues", "conformal"):
            with self.assertRaisesRegex(bielle.InputError, "infinite at some angle"):
                rotations.continuous(kind, [[0.1, 0, 0]])
        with self.assertRaisesRegex(bielle.InputError, r"expected rows of Bryant angles"):
            rotations.continuous("bryant", [0.1, 0, 0])


class Arrays(unittest.TestCase):
    def test_shapes(self):
        for kind in KINDS:
            width = 4 if kind == "quaternion" else 3
            for leading in ((), (1,), (5,), (2, 3), (0,), (2, 0)):
                p = np.full((*leading, width), 0.1)
                self.assertEqual(rotations.to_matrix(kind, p).shape, (*leading, 3, 3))
                self.assertEqual(rotations.from_matrix(kind, rotations.to_matrix(kind, p)).shape, p.shape)
                self.assertEqual(rotations.tangent(kind, p).shape, (*leading, 3, width))
                self.assertEqual(rotations.tangent_inverse(kind, p, frame="spatial").shape, (*leading, width, 3))
                self.assertEqual(rotations.tangent_derivative(kind, p, p, frame="spatial").shape, (*leading, 3, width))
                self.assertEqual(rotations.angular_velocity(kind, p, p, frame="spatial").shape, (*leading, 3))
                self.assertEqual(rotations.parameter_acceleration(kind, p, np.zeros((*leading, 3)), np.zeros(3)).shape, p.shape)
        self.assertEqual(rotations.continuous("euler", np.zeros((0, 3))).shape, (0, 3))
        self.assertEqual(rotations.continuous("quaternion", np.ones((1, 4))).shape, (1, 4))

    def test_each_item_is_what_it_is_alone(self):
        p = regular_parameters("euler").reshape(4, 5, 2, 3)
        R = rotations.to_matrix("euler", p)
        np.testing.assert_array_equal(R[3, 1, 1], rotations.to_matrix("euler", p[3, 1, 1]))
        strided = np.asfortranarray(p)[::2, ::-1]
        np.testing.assert_array_equal(rotations.to_matrix("euler", strided), R[::2, ::-1])

    def test_kinds_of_numbers(self):
        exact = rotations.to_matrix("bryant", [1.0, 0, 2])
        for p in ([1, 0, 2], (1, 0, 2), np.array([1, 0, 2], np.int8), np.array([1, 0, 2], np.float32)):
            np.testing.assert_array_equal(rotations.to_matrix("bryant", p), exact)
        self.assertEqual(exact.dtype, float)

    def test_arguments_stay_as_they_are(self):
        p = regular_parameters("rotation_vector")
        before = p.copy()
        rotations.continuous("rotation_vector", p)
        rotations.principal("rotation_vector", p)[:] = 0
        np.testing.assert_array_equal(p, before)


class Refusals(unittest.TestCase):
    def refuse(self, pattern, function, *arguments, **options):
        with self.assertRaisesRegex(bielle.InputError, pattern):
            function(*arguments, **options)

    def test_names(self):
        self.refuse("'briant' is no parametrisation of rotations; did you mean 'bryant'", rotations.to_matrix, "briant", [0, 0, 0])
        self.refuse("'quaternions' is no", rotations.convert, [0, 0, 0], "bryant", "quaternions")
        self.refuse("3 is no parametrisation", rotations.to_matrix, 3, [0, 0, 0])
        self.refuse("'spacial' is no frame; did you mean 'spatial'", rotations.tangent, "bryant", [0, 0, 0], frame="spacial")

    def test_shapes(self):
        self.refuse(r"`p`: Bryant angles have the shape \(..., 3\), found \(4,\)", rotations.to_matrix, "bryant", [1, 0, 0, 0])
        self.refuse(r"`p`: quaternions w x y z have the shape \(..., 4\), found \(3,\)", rotations.to_matrix, "quaternion", [1, 0, 0])
        self.refuse(r"`R`: rotation matrices have the shape \(..., 3, 3\), found \(9,\)", rotations.from_matrix, "euler", np.eye(3).ravel())
        self.refuse(r"found \(\)", rotations.to_matrix, "euler", 1.0)
        self.refuse(r"found \(3,\)", rotations.from_matrix, "euler", [1, 2, 3])
        self.refuse("do not fit together", rotations.compose, "euler", np.zeros((2, 3)), np.zeros((4, 3)))
        self.refuse(r"`velocity`: expected the shape \(..., 3\)", rotations.parameter_rate, "quaternion", [1, 0, 0, 0], [1, 0, 0, 0])
        self.refuse(r"`rate`: expected the shape \(..., 4\)", rotations.angular_velocity, "quaternion", [1, 0, 0, 0], [1, 0, 0])

    def test_numbers(self):
        self.refuse(r"`p`: the number at \[1, 2\] is nan", rotations.to_matrix, "bryant", [[0, 0, 0], [0, 0, math.nan]])
        self.refuse(r"is inf: finite numbers", rotations.to_matrix, "rotation_vector", [math.inf, 0, 0])
        for wrong in ("abc", [[1, 2, 3], [1, 2]], [1j, 0, 0], None, ["a", "b", "c"]):
            self.refuse("expected an array of real numbers|found", rotations.to_matrix, "bryant", wrong)
        with self.assertRaisesRegex(bielle.ComputationError, "length is zero"):
            rotations.to_matrix("quaternion", [0, 0, 0, 0])

    def test_matrices_that_are_no_rotations(self):
        self.refuse(r"item \(1\): expected a rotation matrix, .* off by up to 3", rotations.from_matrix, "bryant", [np.eye(3), 2 * np.eye(3)])
        self.refuse("left-handed", rotations.from_matrix, "quaternion", np.diag([1, 1, -1]))
        self.refuse("off by up to 1", rotations.from_matrix, "quaternion", np.zeros((3, 3)))


MODEL = {
    "nodes": {"body": {"position": [0, 0, 0], "angular_velocity": [0.3, 4, 0.2], "bryant": [0.4, 0.7, -0.9]}},
    "elements": {"body": {"type": "rigid_body", "node": "body", "mass": 1, "inertia": [1, 2, 2.7]}},
    "measures": {"a": "body.bryant.a", "rate": "body.euler.b.rate"},
}


class Quantities(unittest.TestCase):
    """Tests of orientations as results and in formulas."""

    def test_results_are_continuous(self):
        session = bielle.read(MODEL).session()
        with session.record() as recording:
            session.dynamics(duration=8, step=5e-3).finish()
        results = recording[0]
        R = rotations.to_matrix("quaternion", results["nodes/body/rotation"])
        for kind in ("rotation_vector", "bryant", "euler"):
            p = results[f"nodes/body/{kind}"]
            self.assertIn(f"nodes/body/{kind}", results)
            self.assertFalse(p.flags.writeable)
            np.testing.assert_allclose(rotations.to_matrix(kind, p), R, atol=1e-12)
            # The body rotates by 21 mrad between rows. Angles change by up to 1/cos b = 58 times that, 1.2 rad; a jump
            # would be 3 rad.
            self.assertLess(np.abs(np.diff(p, axis=0)).max(), 2.0)
            self.assertGreater(np.ptp(p, axis=0).max(), 2 * math.pi)
            principal = session[f"nodes/body/{kind}"]
            np.testing.assert_allclose(principal, rotations.principal(kind, p[-1]), atol=1e-12)
            names = "xyz" if kind == "rotation_vector" else "abc"
            np.testing.assert_allclose([session.measure(f"body.{kind}.{n}") for n in names], principal, atol=1e-12)
        np.testing.assert_allclose(results["measures/a"][0], 0.4, atol=1e-15)
        bryant = rotations.from_matrix("bryant", R)
        # R is a product of 1600 rounded rotations, and cos b is 0.017 next to the singularity, so that 2e-11 is the
        # accuracy.
        np.testing.assert_allclose(results["measures/a"], bryant[:, 0], atol=1e-10)
        euler, Omega = rotations.from_matrix("euler", R), results["nodes/body/velocity"][:, 3:]
        np.testing.assert_allclose(results["measures/rate"], rotations.parameter_rate("euler", euler, Omega)[:, 1], atol=1e-10)

    def test_others_are_refused(self):
        session = bielle.read(MODEL).session()
        self.assertRaises(bielle.InputError, lambda: session["nodes/bdy/bryant"])
        self.assertRaises(bielle.InputError, lambda: session["nodes/body/briant"])


if __name__ == "__main__":
    unittest.main()
