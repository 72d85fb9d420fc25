"""Consistent mass of tetrahedra with 4 or 10 nodes, and surface integrals on their faces."""

import numpy as np
from scipy.sparse import coo_matrix
from scipy.special import roots_jacobi

DEGREE = 4  # points along each direction: exact up to polynomials of degree 7
EDGES = ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))  # edges of the mid-side nodes, in VTK's order
SIDES = ((0, 1), (1, 2), (2, 0))


def simplex_points(dimension):
    """Barycentric coordinates (m, dimension + 1) and weights (m), which add up to 1/dimension!, by conical products of Gauss
    and Jacobi's rules (A. H. Stroud, Approximate Calculation of Multiple Integrals, 1971)."""
    rules = [roots_jacobi(DEGREE, power, 0) for power in range(dimension - 1, -1, -1)]
    rules = [((x + 1) / 2, w / 2 ** (power + 1)) for (x, w), power in zip(rules, range(dimension - 1, -1, -1))]
    points, weights = np.ones((1, 0)), np.ones(1)
    left = np.ones(1)
    for x, w in rules:
        points = np.column_stack([np.repeat(points, len(x), axis=0), np.outer(left, x).ravel()])
        weights = np.outer(weights, w).ravel()
        left = np.outer(left, 1 - x).ravel()
    return np.column_stack([1 - points.sum(axis=1), points]), weights


def shapes(barycentric, pairs, quadratic):
    """N (nodes) and its derivatives with respect to the barycentric coordinates (nodes, corners) at one point."""
    L = barycentric
    corners = len(L)
    if not quadratic:
        return L.copy(), np.eye(corners)
    N = np.concatenate([L * (2 * L - 1), [4 * L[a] * L[b] for a, b in pairs]])
    dN = np.zeros((len(N), corners))
    dN[:corners] = np.diag(4 * L - 1)
    for k, (a, b) in enumerate(pairs):
        dN[corners + k, [a, b]] = 4 * L[b], 4 * L[a]
    return N, dN


def scalar_mass(points, cells, density):
    """The mass matrix of one direction, sparse (p,p) [kg]. cells: {type: (n,k)} in VTK's order; density: {type: (n)} [kg/m^3]"""
    rows, columns, values = [], [], []
    for kind, nodes in cells.items():
        if not kind.startswith("tetra") or not len(nodes):
            continue
        at, weights = simplex_points(3)
        mass = np.zeros((len(nodes), nodes.shape[1], nodes.shape[1]))
        for L, weight in zip(at, weights):
            N, dN = shapes(L, EDGES, nodes.shape[1] == 10)
            J = np.einsum("enk,nj->ekj", points[nodes], dN[:, 1:] - dN[:, :1])
            mass += (weight * density[kind] * np.linalg.det(J))[:, None, None] * np.outer(N, N)
        rows.append(np.repeat(nodes, nodes.shape[1], axis=1).ravel())
        columns.append(np.tile(nodes, (1, nodes.shape[1])).ravel())
        values.append(mass.ravel())
    size = len(points)
    return coo_matrix((np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))), shape=(size, size)).tocsr()


def volumes(points, cells):
    """{type: (n)} [m^3]"""
    found = {}
    for kind, nodes in cells.items():
        if not kind.startswith("tetra"):
            continue
        found[kind] = np.zeros(len(nodes))
        for L, weight in zip(*simplex_points(3)):
            _, dN = shapes(L, EDGES, nodes.shape[1] == 10)
            found[kind] += weight * np.linalg.det(np.einsum("enk,nj->ekj", points[nodes], dN[:, 1:] - dN[:, :1]))
    return found


def surface_integrals(points, faces, apply):
    """Sums over the surface of N_i f dA: (p, ...) with f = apply(x) of points (m,3). faces: {type: (n,k)}"""
    total = None
    for nodes in faces.values():
        for L, weight in zip(*simplex_points(2)):
            N, dN = shapes(L, SIDES, nodes.shape[1] == 6)
            tangents = np.einsum("enk,nj->ejk", points[nodes], dN[:, 1:] - dN[:, :1])
            area = weight * np.linalg.norm(np.cross(tangents[:, 0], tangents[:, 1]), axis=1)
            f = apply(np.einsum("enk,n->ek", points[nodes], N))
            if total is None:
                total = np.zeros((len(points),) + f.shape[1:])
            for k in range(nodes.shape[1]):
                np.add.at(total, nodes[:, k], N[k] * (area.reshape((-1,) + (1,) * (f.ndim - 1)) * f))
    return total
