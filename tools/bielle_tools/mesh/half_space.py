"""Integrals of the shape functions over the part of a mesh that is in front of a plane.

    W_i = integral of rho N_i dV [kg],   V_i = integral of rho x N_i dV [kg m]

give the resultant of any field a = sum N_i a_i there: force sum W_i a_i, and moment sum V_i x a_i about the origin.
Cells that the plane cuts are divided into tetrahedra in their reference cell, which the plane clips: this is exact for
cells with straight edges and plane faces; curved ones have the error of their curvature in the cells that are cut.
"""

import numpy as np

from .cell_integrals import cell_points, shape_functions, simplex_points
from .cells import CELLS

# Tetrahedra of each shape, by its corners.
TETRAHEDRA = {"tetra": ((0, 1, 2, 3),), "pyramid": ((0, 1, 2, 4), (0, 2, 3, 4)),
              "wedge": ((0, 1, 2, 3), (1, 2, 3, 4), (2, 3, 4, 5)),
              "hexahedron": ((0, 1, 3, 4), (1, 2, 3, 6), (1, 3, 4, 6), (1, 4, 5, 6), (3, 4, 6, 7))}
DEGREE = 2  # points of a clipped tetrahedron along each direction: exact up to polynomials of degree 3


def moments_in_front(points, cells, density, place, normal):
    """(p) W_i and (p,3) V_i of the part with normal . (x - place) > 0. cells: {type: (n,k)} in VTK's order; density:
    {type: (n)} [kg/m^3]"""
    height = (points - place) @ normal
    W, V = np.zeros(len(points)), np.zeros((len(points), 3))
    inside, cut = {}, {}
    for kind in density:
        corners = height[cells[kind][:, :CELLS[kind].corners]]
        inside[kind] = (corners >= 0).all(axis=1)
        cut[kind] = (corners > 0).any(axis=1) & (corners < 0).any(axis=1)
    whole = {kind: cells[kind][inside[kind]] for kind in density if inside[kind].any()}
    for kind, first, nodes, N, volume in cell_points(points, whole):
        mass = volume * density[kind][inside[kind]][first:first + len(nodes)]
        _add(W, V, nodes, mass, np.broadcast_to(N, nodes.shape), points)
    for kind in density:
        for nodes, rho in zip(cells[kind][cut[kind]], density[kind][cut[kind]]):
            N, volume = _clipped(points[nodes], kind, height[nodes])
            mass = rho * volume[:, None] * N
            W[nodes] += mass.sum(axis=0)
            V[nodes] += mass.T @ (N @ points[nodes])
    return W, V


def _add(W, V, nodes, mass, N, points):
    x = np.einsum("ek,ekj->ej", N, points[nodes])
    np.add.at(W, nodes, mass[:, None] * N)
    np.add.at(V, nodes, (mass[:, None] * N)[:, :, None] * x[:, None, :])


def _clipped(x, kind, height):
    """N (m,nodes) and volumes (m) at the points of integration of the part of a cell with nodes x (k,3) where the
    height is positive."""
    cell = CELLS[kind]
    L, weights = simplex_points(3, DEGREE)
    places, volumes = [np.zeros((0, 3))], [np.zeros(0)]
    for four in TETRAHEDRA[cell.shape]:
        four = list(four)
        volume = abs(np.linalg.det(x[four[1:]] - x[four[0]]))
        for part in _parts_above(height[four]):  # (4,4) corners as shares of those of the tetrahedron
            places.append(L @ part @ cell.reference[four])
            volumes.append(weights * abs(np.linalg.det(part)) * volume)
    places = np.concatenate(places)
    several = cell.shape == "tetra"
    N = shape_functions(kind, places) if several else np.array([shape_functions(kind, each) for each in places])
    return N.reshape(len(places), cell.nodes), np.concatenate(volumes)


def _parts_above(height):
    """Tetrahedra into which the part of a tetrahedron with positive heights (4) of its corners is divided."""
    corners = np.eye(4)
    above, below = np.flatnonzero(height > 0), np.flatnonzero(height <= 0)

    def crossing(a, b):
        s = height[a] / (height[a] - height[b])
        return (1 - s) * corners[a] + s * corners[b]

    if len(below) == 0:
        return [corners]
    if len(above) == 1:
        return [np.array([corners[above[0]], *(crossing(above[0], b) for b in below)])]
    if len(above) == 2:  # a wedge between two edges
        (a, b), (c, d) = above, below
        first, second = [corners[a], crossing(a, c), crossing(a, d)], [corners[b], crossing(b, c), crossing(b, d)]
        return _of_wedge(first, second)
    if len(above) == 3:
        return _of_wedge([corners[a] for a in above], [crossing(a, below[0]) for a in above])
    return []


def _of_wedge(first, second):
    (a, b, c), (d, e, f) = first, second
    return [np.array(four) for four in ((a, b, c, d), (b, c, d, e), (c, d, e, f))]
