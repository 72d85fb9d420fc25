"""Free linear bodies for the formats of matrices.

A body is a cloud of point masses whose displacements are linear in the unknowns. Its stiffness and mass are exact by
construction: K u = 0 for rigid motions u; M and the components S_kl are sums over the points.
"""

import os
import sys

import numpy as np

REPOSITORY = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", "..", ".."))
sys.path[:0] = [os.path.join(REPOSITORY, "tools"), os.path.join(REPOSITORY, "tests", "contract")]

from bielle_tools.exchange import formats  # noqa: E402
from bielle_tools.exchange.matrix_set import MassProperties, MatrixSet, Shapes, sparse  # noqa: E402
from bielle_tools.messages import InputError  # noqa: E402
from in_folder import InFolder  # noqa: E402

PAIRS = ((0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1))


def rigid_of(positions, components=6):
    """Returns the motions (count * components, 6) of nodes in rigid motions about the origin, by cross products."""
    rows = []
    for x in positions:
        for k in range(components):
            rows.append([float(a == k) if a < 3 else np.cross(np.eye(3)[a - 3], x)[k] if k < 3 else float(a == k) for a in range(6)])
    return np.array(rows)


def turn(a, b):
    """Returns a rotation matrix."""
    c, s, C, S = np.cos(a), np.sin(a), np.cos(b), np.sin(b)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]) @ np.array([[1, 0, 0], [0, C, -S], [0, S, C]])


def cloud_body(nodes=2, scalars=3, points=12, components=6, seed=1, damping=True):
    """Returns a MatrixSet in body axes, with masses at its points and S_kl."""
    random = np.random.default_rng(seed)
    positions, places = random.normal(size=(nodes, 3)), random.normal(size=(points, 3)) + (0.3, 0.1, -0.2)
    masses, n = random.uniform(0.5, 2, points), components * nodes + scalars
    rigid = np.concatenate([rigid_of(positions, components), np.zeros((scalars, 6))])
    inverse = np.linalg.pinv(rigid)
    elastic = np.eye(n) - rigid @ inverse
    T = rigid_of(places, 3) @ inverse + random.normal(size=(3 * points, n)) @ elastic
    by_axis = T.reshape(points, 3, n)
    components_of = np.array([np.einsum("p,pi,pj->ij", masses, by_axis[:, k], by_axis[:, l]) for k, l in PAIRS])
    M = components_of[:3].sum(axis=0)
    A = random.normal(size=(n, n))
    K = 1e4 * elastic.T @ (A @ A.T + np.diag(np.arange(n) + 1.0)) @ elastic
    # Amplitudes do not couple with the nodes, like those of fixed-interface modes.
    K = sparse(np.block([[K[:n - scalars, :n - scalars], np.zeros((n - scalars, scalars))],
                         [np.zeros((scalars, n - scalars)), K[n - scalars:, n - scalars:]]])) if scalars else sparse(K)
    centre = masses @ places / masses.sum()
    arms = places - centre
    inertia = sum(m * (r @ r * np.eye(3) - np.outer(r, r)) for m, r in zip(masses, arms))
    return MatrixSet(
        name="cloud", source="test", numbers=np.arange(nodes) * 7 + 3, positions=positions,
        unknown_nodes=np.concatenate([np.repeat(np.arange(nodes), components), np.full(scalars, -1)]),
        unknown_components=np.concatenate([np.tile(np.arange(components), nodes), np.arange(scalars)]), stiffness=K, mass=sparse(M),
        damping=sparse(1e-4 * K + elastic.T @ elastic) if damping else None, inertia_components=components_of,
        mass_properties=MassProperties(masses.sum(), centre, inertia),
        shapes=Shapes(np.arange(1, points + 1), places, T, None, masses))


def turned(body, seed=2):
    """Returns the same body with its own axes at each node."""
    random = np.random.default_rng(seed)
    axes = np.array([turn(*random.uniform(0, 6, 2)) for _ in body.numbers])
    T = np.eye(body.size)
    for row, (node, component) in enumerate(zip(body.unknown_nodes, body.unknown_components)):
        for other, (node_of, component_of) in enumerate(zip(body.unknown_nodes, body.unknown_components)):
            if node >= 0 and node == node_of:
                same = component // 3 == component_of // 3
                T[row, other] = axes[node][component % 3, component_of % 3] if same else 0.0
    return MatrixSet(
        name=body.name, source=body.source, numbers=body.numbers, positions=body.positions, unknown_nodes=body.unknown_nodes,
        unknown_components=body.unknown_components, axes=axes, stiffness=sparse(T.T @ body.stiffness.toarray() @ T),
        mass=sparse(T.T @ body.mass.toarray() @ T), damping=sparse(T.T @ body.damping.toarray() @ T))


class Exchange(InFolder):
    """Tests of the round trips of a format."""

    def options(self, **given):
        return formats.Options(**given)

    def read_back(self, name, body, path, **given):
        """Returns the body from the first file that the format writes."""
        paths = formats.module_of(name).write(body, path, self.options())
        self.assertTrue(all(os.path.exists(each) for each in paths))
        return self.read(name, paths[0], **given)

    def read(self, name, path, **given):
        found = formats.module_of(name).read(path, self.options(**given))
        found.check()
        return found

    def refuse(self, name, path, told, **given):
        with self.assertRaises(InputError) as caught:
            self.read(name, path, **given)
        self.assertIn(told, str(caught.exception))
        self.assertNotIn("\n", str(caught.exception))

    def same(self, found, body, within=1e-12, damping=True):
        """Asserts that positions, order and matrices are equal, relative to the largest number."""
        np.testing.assert_array_equal(found.numbers, body.numbers)
        np.testing.assert_allclose(found.positions, body.positions, rtol=0, atol=within * np.abs(body.positions).max())
        place = [self.row_of(body, found, row) for row in range(found.size)]
        for name in ("stiffness", "mass") + (("damping",) if damping else ()):
            expected = getattr(body, name).toarray()[np.ix_(place, place)]
            np.testing.assert_allclose(getattr(found, name).toarray(), expected, rtol=0, atol=within * np.abs(expected).max())

    @staticmethod
    def row_of(body, found, row):
        """Returns the unknown of the body for a row of the set that was read."""
        node, component = found.unknown_nodes[row], found.unknown_components[row]
        match = (body.unknown_nodes == node) & (body.unknown_components == component)
        return int(np.flatnonzero(match)[0])
