"""Coarser triangles of a surface for pictures in motion, in which the body is small.

Points that share a cell of a grid, and on whose side the surface faces the same way, are drawn as the one of them that
is nearest to their mean. Each level takes its points from the finer one before it. The points are sorted so that a
level uses the first ones: a coarse picture computes no others.
"""

from dataclasses import dataclass

import numpy as np

FINEST = 1.5      # cell of the first coarse level relative to the mean edge
FEWEST = 150      # triangles
GROWTH = 1.5      # from the cell of a level to that of the next
LEAST_GAIN = 0.8  # a level has at most this share of the triangles of the finer one
MOST_LEVELS = 12


@dataclass
class Level:
    """cell: size of its cells [m], 0 for the surface itself; count: it uses the points before this number; triangles
    (m,3)"""

    cell: float
    count: int
    triangles: np.ndarray


def levels_of(points, triangles):
    """The order in which points (p,3) are to be sorted, and levels in this order, the surface itself first."""
    found = [(0.0, np.arange(len(points)), triangles)]
    if len(triangles):
        found += _coarser(points, triangles)
    depth = np.zeros(len(points), int)
    for number, (_, kept, _) in enumerate(found):
        depth[kept] = number  # the coarsest level to which a point belongs
    order = np.argsort(-depth, kind="stable")
    place = np.empty(len(points), int)
    place[order] = np.arange(len(points))
    return order, [Level(cell, len(kept), place[block]) for cell, kept, block in found]


def _coarser(points, triangles):
    """[(cell, numbers of its points, triangles (m,3) of numbers)], the finest first."""
    found, facing, drawn = [], _facing(points, triangles), np.arange(len(points))
    edges = points[triangles] - points[np.roll(triangles, 1, axis=1)]
    cell, before = FINEST * float(np.linalg.norm(edges, axis=2).mean()), len(triangles)
    while cell > 0 and before > FEWEST and len(found) < MOST_LEVELS:
        kept = np.unique(drawn)
        image = np.arange(len(points))
        image[kept] = kept[_representatives(points[kept], facing[kept], cell)]
        coarse = _without_repeated(image[drawn][triangles])
        if len(coarse) < FEWEST / 4:
            break
        if len(coarse) < LEAST_GAIN * before:
            drawn, before = image[drawn], len(coarse)
            found.append((cell, np.unique(drawn), coarse))
        cell *= GROWTH
    return found


def _facing(points, triangles):
    """(p) the axis along which the surface faces at each point, and its sense: 0 to 5."""
    a, b, c = (points[triangles[:, k]] for k in range(3))
    normals = np.zeros_like(points)
    for k in range(3):
        np.add.at(normals, triangles[:, k], np.cross(b - a, c - a))
    axis = np.abs(normals).argmax(axis=1)
    return 2 * axis + (np.take_along_axis(normals, axis[:, None], axis=1)[:, 0] < 0)


def _representatives(points, facing, cell):
    """(p) the point as which each of the points is drawn."""
    keys = np.column_stack([np.floor((points - points.min(axis=0)) / cell).astype(int), facing])
    _, group, count = np.unique(keys, axis=0, return_inverse=True, return_counts=True)
    group = group.ravel()
    mean = np.stack([np.bincount(group, weights=points[:, k]) / count for k in range(3)], axis=1)
    order = np.lexsort((np.linalg.norm(points - mean[group], axis=1), group))
    return order[np.searchsorted(group[order], np.arange(len(count)))][group]


def _without_repeated(triangles):
    """Triangles with three different corners, each once."""
    a, b, c = triangles.T
    block = triangles[(a != b) & (b != c) & (c != a)]
    first = block.argmin(axis=1)[:, None]
    block = np.take_along_axis(block, (first + np.arange(3)) % 3, axis=1)  # the least number first, of the same sense
    return np.unique(block, axis=0)
