"""Small tetrahedral meshes of a box for tests of the tools: points, cells in VTK's node order, and sets by geometry."""

import os
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from in_folder import REPOSITORY, InFolder  # noqa: E402, F401
sys.path.insert(0, os.path.join(REPOSITORY, "tools"))

SIX = [[0, 1, 3, 7], [0, 3, 2, 7], [0, 2, 6, 7], [0, 6, 4, 7], [0, 4, 5, 7], [0, 5, 1, 7]]  # tetrahedra of a cube
EDGES = [[0, 1], [1, 2], [0, 2], [0, 3], [1, 3], [2, 3]]


def box(divisions=(3, 2, 2), size=(0.3, 0.2, 0.1), order=2):
    """@returns points (p,3) [m] and tetrahedra (n,4 or 10) of the box [0,size], right-handed."""
    nx, ny, nz = divisions
    x, y, z = (np.linspace(0, s, n + 1) for s, n in zip(size, divisions))
    points = np.array([[a, b, c] for c in z for b in y for a in x])

    def at(i, j, k):
        return i + (nx + 1) * (j + (ny + 1) * k)

    cells = []
    for k in range(nz):
        for j in range(ny):
            for i in range(nx):
                cube = [at(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2)) for c in range(8)]
                cells += [[cube[v] for v in four] for four in SIX]
    cells = np.array(cells)
    return (points, cells) if order == 1 else _with_mid_nodes(points, cells)


def _with_mid_nodes(points, cells):
    pairs = np.sort(cells[:, EDGES], axis=2)
    unique, inverse = np.unique(pairs.reshape(-1, 2), axis=0, return_inverse=True)
    middles = points[unique].mean(axis=1)
    return np.concatenate([points, middles]), np.concatenate([cells, len(points) + inverse.reshape(-1, 6)], axis=1)


def area(points, triangles):
    a, b, c = (points[triangles[:, k]] for k in range(3))
    return 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()
