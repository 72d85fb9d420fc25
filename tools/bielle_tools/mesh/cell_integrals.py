"""Shape functions of all types of cells, the consistent mass of solid cells, and integrals over surfaces.

The functions are those of the reduction (reduce/mesh/shape_functions.hpp), in VTK's node order. Order 2 has a node in the
middle of each edge (serendipity), quad9 and hexahedron27 also of each face and of the cell. Those of pyramids are
rational (G. Bedrosian, Int. J. Numer. Meth. Engng 35 (1992) 95-108). Derivatives are taken by complex steps: those of a
function f are Im f(x + i h)/h to rounding.
"""

from functools import lru_cache

import numpy as np
from scipy.sparse import coo_matrix
from scipy.special import roots_jacobi, roots_legendre

from .cells import CELLS

DEGREE = 4  # points of simplices along each direction: exact up to polynomials of degree 7
LINES = 5   # points of other cells along each direction: exact up to degree 9
STEP = 1e-30
AT_ONCE = 20000  # cells


@lru_cache(maxsize=None)
def simplex_points(dimension, count=DEGREE):
    """Barycentric coordinates (m, dimension + 1) and weights (m), which add up to 1/dimension!, by conical products of Gauss
    and Jacobi's rules with `count` points along each direction (A. H. Stroud, Approximate Calculation of Multiple Integrals, 1971)."""
    rules = [roots_jacobi(count, power, 0) for power in range(dimension - 1, -1, -1)]
    rules = [((x + 1) / 2, w / 2 ** (power + 1)) for (x, w), power in zip(rules, range(dimension - 1, -1, -1))]
    points, weights = np.ones((1, 0)), np.ones(1)
    left = np.ones(1)
    for x, w in rules:
        points = np.column_stack([np.repeat(points, len(x), axis=0), np.outer(left, x).ravel()])
        weights = np.outer(weights, w).ravel()
        left = np.outer(left, 1 - x).ravel()
    return np.column_stack([1 - points.sum(axis=1), points]), weights


def _product(first, second):
    """The rule of a product of two domains."""
    (x, v), (y, w) = first, second
    return np.column_stack([np.repeat(x, len(y), axis=0), np.tile(y, (len(x), 1))]), np.outer(v, w).ravel()


def reference_rule(shape):
    """Points (m, dimension) and weights (m) in the reference cell of a shape."""
    if shape in ("triangle", "tetra"):
        L, weights = simplex_points(2 if shape == "triangle" else 3)
        return L[:, 1:], weights
    x, w = roots_legendre(LINES)
    line = x[:, None], w
    square = _product(line, line)
    if shape == "quad":
        return square
    if shape == "hexahedron":
        return _product(square, line)
    if shape == "wedge":
        return _product(reference_rule("triangle"), line)
    t, v = roots_jacobi(LINES, 2, 0)  # the section of a pyramid shrinks as (1 - t)^2
    points, weights = _product(square, (((t + 1) / 2)[:, None], v / 8))
    return np.column_stack([points[:, :2] * (1 - points[:, 2:]), points[:, 2]]), weights


def shape_functions(kind, x):
    """N (nodes) at a point of the reference cell, real or complex; of simplices (..,nodes) at several points."""
    cell = CELLS[kind]
    if cell.shape in ("triangle", "tetra"):
        return _of_simplex(cell, x)
    if cell.shape in ("quad", "hexahedron"):
        full = cell.nodes in (9, 27)
        return np.array([_of_full_cube(s, x) if full else _of_cube(cell, s, x, a < cell.corners) for a, s in enumerate(cell.reference)])
    return _of_wedge(cell, x) if cell.shape == "wedge" else _of_pyramid(cell, x)


def shape_gradients(kind, x):
    """dN/dx (nodes, dimension)."""
    steps = 1j * STEP * np.eye(len(x))
    return np.column_stack([shape_functions(kind, x + step).imag / STEP for step in steps])


def _of_simplex(cell, x):
    L = np.concatenate([1 - x.sum(axis=-1, keepdims=True), x], axis=-1)
    if cell.order == 1:
        return L
    first, second = np.array(cell.edges).T
    return np.concatenate([L * (2 * L - 1), 4 * L[..., first] * L[..., second]], axis=-1)


def _of_cube(cell, s, x, at_corner):
    factors = np.where(s == 0, 1 - x * x, 0.5 * (1 + s * x))
    return factors.prod() * (s @ x + 1 - len(s) if cell.order == 2 and at_corner else 1)


def _of_full_cube(s, x):
    return np.where(s == 0, 1 - x * x, 0.5 * x * (x + s)).prod()


def _of_wedge(cell, x):
    L, z = np.array([1 - x[0] - x[1], x[0], x[1]]), x[2]
    up = cell.reference[:, 2]
    if cell.order == 1:
        return np.array([0.5 * L[a % 3] * (1 + up[a] * z) for a in range(6)])
    N = [0.5 * L[a % 3] * ((2 * L[a % 3] - 1) * (1 + up[a] * z) - (1 - z * z)) for a in range(6)]
    N += [L[a % 3] * (1 - z * z) if a % 3 == b % 3 else 2 * L[a % 3] * L[b % 3] * (1 + up[a] * z) for a, b in cell.edges]
    return np.array(N)


def _of_pyramid(cell, x):
    place, t, left = cell.reference, x[2], 1 - x[2]
    at = [(left + place[a, 0] * x[0]) * (left + place[a, 1] * x[1]) / left for a in range(4)]
    if cell.order == 1:
        return np.array([0.25 * each for each in at] + [t])
    N = [0.25 * each * (place[a, 0] * x[0] + place[a, 1] * x[1] - 1) for a, each in enumerate(at)] + [t * (2 * t - 1)]
    for a, b in cell.edges:
        if b == 4:
            N.append(t * at[a])
            continue
        along = 0 if place[a, 0] != place[b, 0] else 1
        N.append(0.5 * (left * left - x[along] ** 2) * (left + place[a, 1 - along] * x[1 - along]) / left)
    return np.array(N)


@lru_cache(maxsize=None)
def _rule(kind):
    """N (m, nodes), dN (m, nodes, dimension) and weights (m) at the points of integration."""
    x, weights = reference_rule(CELLS[kind].shape)
    return np.array([shape_functions(kind, each) for each in x]), np.array([shape_gradients(kind, each) for each in x]), weights


def _blocks(cells, dimension):
    """(type, first number, rows) of blocks of cells of one dimension."""
    for kind, nodes in cells.items():
        if CELLS[kind].dimension == dimension:
            for first in range(0, len(nodes), AT_ONCE):
                yield kind, first, nodes[first:first + AT_ONCE]


def _determinants(points, kind, nodes):
    """(cells, m) weights times the volume of the cell per volume of the reference cell."""
    _, gradients, weights = _rule(kind)
    x = points[nodes]
    return np.column_stack([weight * np.linalg.det(np.einsum("enk,nj->ekj", x, dN)) for dN, weight in zip(gradients, weights)])


def scalar_mass(points, cells, density):
    """The mass matrix of one direction, sparse (p,p) [kg]. cells: {type: (n,k)} in VTK's order; density: {type: (n)} [kg/m^3]"""
    rows, columns, values = [], [], []
    for kind, first, nodes in _blocks(cells, 3):
        N, count = _rule(kind)[0], nodes.shape[1]
        weights = _determinants(points, kind, nodes) * density[kind][first:first + len(nodes), None]
        rows.append(np.repeat(nodes, count, axis=1).ravel())
        columns.append(np.tile(nodes, (1, count)).ravel())
        values.append((weights @ np.einsum("ma,mb->mab", N, N).reshape(len(N), -1)).ravel())
    size = len(points)
    return coo_matrix((np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))), shape=(size, size)).tocsr()


def cell_points(points, cells):
    """The points of integration of solid cells, one of each cell at a time: (type, first number, nodes (n,k), N (k), volumes (n)
    that the point stands for). cells: {type: (n,k)} in VTK's order"""
    for kind, first, nodes in _blocks(cells, 3):
        for N, volume in zip(_rule(kind)[0], _determinants(points, kind, nodes).T):
            yield kind, first, nodes, N, volume


def volumes(points, cells):
    """{type: (n)} [m^3]"""
    found = {kind: [np.zeros(0)] for kind in cells if CELLS[kind].dimension == 3}
    for kind, _, nodes in _blocks(cells, 3):
        found[kind].append(_determinants(points, kind, nodes).sum(axis=1))
    return {kind: np.concatenate(parts) for kind, parts in found.items()}


def surface_points(points, faces):
    """The points of integration of a surface, one of each face at a time: (type, nodes (n,k), N (k), vectors (n,3)), the
    vectors being normal to the faces with the length of the area that the point stands for. faces: {type: (n,k)}"""
    for kind, nodes in faces.items():
        for N, dN, weight in zip(*_rule(kind)):
            tangents = np.einsum("enk,nj->ejk", points[nodes], dN)
            yield kind, nodes, N, weight * np.cross(tangents[:, 0], tangents[:, 1])


def surface_integrals(points, faces, apply):
    """Sums over the surface of N_i f dA: (p, ...) with f = apply(x) of points (m,3). faces: {type: (n,k)}"""
    total = None
    for _, nodes, N, normals in surface_points(points, faces):
        area = np.linalg.norm(normals, axis=1)
        f = apply(np.einsum("enk,n->ek", points[nodes], N))
        if total is None:
            total = np.zeros((len(points),) + f.shape[1:])
        for k in range(nodes.shape[1]):
            np.add.at(total, nodes[:, k], N[k] * (area.reshape((-1,) + (1,) * (f.ndim - 1)) * f))
    return total
