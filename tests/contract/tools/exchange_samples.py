"""MatrixSets of bodies for tests of the formats of matrices, and their comparison."""

import dataclasses

import numpy as np
import scipy.linalg
import scipy.sparse

import box_mesh  # noqa: F401  (it puts the tools on the path)
from bielle_tools.exchange.matrix_set import MatrixSet, Shapes

MATRICES = ("stiffness", "mass", "damping", "geometric_stiffness")


def beam(young, density, length, width, turn=None):
    """Returns a straight beam along x with a square section and two nodes: stiffness of Euler's beam, consistent mass,
    damping of a thousandth of the stiffness, geometric stiffness of a tension that stretches it by 1e-4 (Przemieniecki,
    Theory of Matrix Structural Analysis, sections 5.6, 11.7 and 15.3). @param turn:  (3,3) axes of the second node"""
    area, inertia = width**2, width**4 / 12
    torsion = 2 * inertia
    line, bend, twist = young * area / length, young * inertia / length**3, young / 2.6 * torsion / length
    stiffness, mass, geometric = np.zeros((3, 12, 12))
    line_mass = density * area * length
    for first, factor, moment in ((0, line, line_mass), (3, twist, density * torsion * length)):
        place = np.ix_([first, first + 6], [first, first + 6])
        stiffness[place] = factor * np.array([[1, -1], [-1, 1]])
        mass[place] = moment / 6 * np.array([[2, 1], [1, 2]])
    for across, turning, sign in ((1, 5, 1), (2, 4, -1)):
        place = np.ix_([across, turning, across + 6, turning + 6], [across, turning, across + 6, turning + 6])
        s = np.diag([1, sign * length, 1, sign * length])
        stiffness[place] = bend * s @ np.array([[12, 6, -12, 6], [6, 4, -6, 2], [-12, -6, 12, -6], [6, 2, -6, 4]]) @ s
        mass[place] = line_mass / 420 * s @ np.array([[156, 22, 54, -13], [22, 4, 13, -3], [54, 13, 156, -22], [-13, -3, -22, 4]]) @ s
        geometric[place] = 1e-4 * young * area / (30 * length) * s @ np.array(
            [[36, 3, -36, 3], [3, 4, -3, -1], [-36, -3, 36, -3], [3, -1, -3, 4]]) @ s
    axes = None
    if turn is not None:
        axes = np.array([np.eye(3), turn])
        to_node = scipy.linalg.block_diag(np.eye(6), turn, turn)
        stiffness, mass, geometric = (to_node.T @ matrix @ to_node for matrix in (stiffness, mass, geometric))
    sparse = scipy.sparse.csr_matrix
    return MatrixSet(name="beam", source="test", numbers=np.array([7, 12]), positions=np.array([[0.0, 0, 0], [length, 0, 0]]),
                     unknown_nodes=np.repeat([0, 1], 6), unknown_components=np.tile(np.arange(6), 2), stiffness=sparse(stiffness),
                     mass=sparse(mass), damping=sparse(1e-3 * stiffness), geometric_stiffness=sparse(geometric), axes=axes,
                     interfaces={"node_7": 0, "node_12": 1})


def turned(seed=3):
    """Returns axes of a node, a rotation that changes each of the three axes."""
    axes, _ = np.linalg.qr(np.random.default_rng(seed).standard_normal((3, 3)))
    return axes * np.sign(np.linalg.det(axes))


def with_modes(body, count=3, seed=5, shapes=True):
    """Returns a body with scalar coordinates in addition to nodes, whose masses are coupled, and with shapes at three
    points."""
    random = np.random.default_rng(seed)
    n = body.size
    stiffness = scipy.linalg.block_diag(body.stiffness.toarray(), np.diag(10.0 ** np.arange(5, 5 + count)))
    mass = scipy.linalg.block_diag(body.mass.toarray(), np.eye(count))
    mass[:n, n:] = 0.1 * random.standard_normal((n, count))
    mass[n:, :n] = mass[:n, n:].T
    damping = scipy.linalg.block_diag(body.damping.toarray(), np.diag(random.random(count)))
    points = random.standard_normal((3, 3))
    return dataclasses.replace(
        body, stiffness=scipy.sparse.csr_matrix(stiffness), mass=scipy.sparse.csr_matrix(mass), damping=scipy.sparse.csr_matrix(damping),
        geometric_stiffness=None, unknown_nodes=np.concatenate([body.unknown_nodes, np.full(count, -1)]),
        unknown_components=np.concatenate([body.unknown_components, np.arange(count)]), notes=[],
        shapes=Shapes(numbers=np.array([101, 103, 107]), points=points, displacement=random.standard_normal((9, n + count)),
                      rotation=random.standard_normal((9, n + count))) if shapes else None)


def shuffled(body, seed=11):
    """Returns the same body with its unknowns in another order."""
    order = np.random.default_rng(seed).permutation(body.size)
    members = {name: getattr(body, name)[order][:, order] for name in MATRICES if getattr(body, name) is not None}
    shapes = body.shapes and dataclasses.replace(body.shapes, displacement=body.shapes.displacement[:, order],
                                                 rotation=body.shapes.rotation[:, order])
    return dataclasses.replace(body, **members, shapes=shapes, unknown_nodes=body.unknown_nodes[order],
                               unknown_components=body.unknown_components[order], notes=[])


def order_of(body):
    """Returns the indices of the unknowns, sorted by node numbers and components, with scalars last."""
    return np.lexsort((body.unknown_components, [body.numbers[node] if node >= 0 else 2**40 for node in body.unknown_nodes]))


def assert_same(test, found, expected, relative):
    """Compares positions, axes, matrices and shapes of two bodies, whose unknowns may have different orders.
    @param relative: to the largest entry of each matrix"""
    def close(one, other, told):
        one, other = np.asarray(one), np.asarray(other)
        test.assertEqual(one.shape, other.shape, told)
        test.assertLessEqual(abs(one - other).max(), relative * abs(other).max(), told)

    rows = [list(found.numbers).index(number) for number in expected.numbers]
    close(found.positions[rows], expected.positions, "positions")
    identity = np.tile(np.eye(3), (len(rows), 1, 1))
    close(identity if found.axes is None else found.axes[rows], identity if expected.axes is None else expected.axes, "axes")
    here, there = order_of(found), order_of(expected)
    test.assertEqual(found.scalars, expected.scalars)
    for name in MATRICES:
        one, other = getattr(found, name), getattr(expected, name)
        test.assertEqual(one is None, other is None, name)
        if one is not None:
            close(one.toarray()[here][:, here], other.toarray()[there][:, there], name)
    if expected.shapes is not None and found.shapes is not None:
        close(found.shapes.points, expected.shapes.points, "points")
        close(found.shapes.displacement[:, here], expected.shapes.displacement[:, there], "displacement")
        close(found.shapes.rotation[:, here], expected.shapes.rotation[:, there], "rotation")
