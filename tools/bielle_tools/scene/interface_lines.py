"""The drawing of a flexible body without a surface: balls at its interfaces, and rods that join each with a near one.

The rods form the shortest tree over the interfaces. Their points move as the interfaces between which they are, linearly along the rod.
"""

import numpy as np

from . import templates as t

BALL, ROD = 0.45, 0.25  # radii in sizes of symbols


def interface_lines(positions, displacements, symbol):
    """Points (p,3), triangles (m,3), and shapes (n,p,3) of the coordinates. positions (k,3) [m] and displacements (k,3,n) of the interfaces; symbol:
    size of symbols [m]"""
    pieces, shapes = [], []
    for position, own in zip(positions, displacements):
        pieces.append(t.moved(t.sphere(BALL * symbol, 6, 10), position))
        shapes.append(np.tile(own.T[:, None], (1, len(pieces[-1].points), 1)))
    for first, second in shortest_tree(positions):
        way = positions[second] - positions[first]
        if np.linalg.norm(way) > BALL * symbol:  # nearer interfaces are within one ball
            pieces.append(t.rod(positions[first], positions[second], (ROD * symbol, ROD * symbol)))
            share = np.clip((pieces[-1].points - positions[first]) @ way / (way @ way), 0, 1)[:, None]
            shapes.append(np.stack([(1 - share) * a + share * b for a, b in zip(displacements[first].T, displacements[second].T)]))
    mesh = t.merged(pieces)
    return mesh.points, np.asarray(mesh.triangles, int), np.concatenate(shapes, axis=1)


def shortest_tree(points):
    """Pairs of numbers of points (k,3) whose lines join all points and are shortest together (Prim's algorithm)."""
    inside, nearest = np.zeros(len(points), bool), np.zeros(len(points), int)
    distance, latest, pairs = np.full(len(points), np.inf), 0, []
    for _ in range(len(points) - 1):
        inside[latest] = True
        new = np.linalg.norm(points - points[latest], axis=1)
        closer = new < distance
        distance[closer], nearest[closer] = new[closer], latest
        latest = int(np.argmin(np.where(inside, np.inf, distance)))
        pairs.append((int(nearest[latest]), latest))
    return pairs
