"""Normals of surfaces, by which they are shaded."""

import numpy as np

SHARP = np.cos(np.deg2rad(35))  # edges with a larger angle are shaded as edges


def corner_normals(points, triangles):
    """(n,3) unit normals of points, as means over their triangles weighted by the area; zero without triangles."""
    triangles = np.asarray(triangles, np.int64).reshape(-1, 3)
    total = np.zeros((len(points), 3))
    faces = _face_normals(points, triangles)
    for corner in range(3):
        for axis in range(3):
            total[:, axis] += np.bincount(triangles[:, corner], faces[:, axis], len(points))
    return _unit(total)


def split_at_edges(points, triangles):
    """Gives every point a copy for each smooth side: a corner of a triangle belongs to the copy whose triangles it can be
    reached through round the point without crossing a sharp edge.
    @returns number of the point of each copy, normals of the copies, triangles of copies"""
    triangles = np.asarray(triangles, np.int64).reshape(-1, 3)
    faces = _unit(_face_normals(points, triangles))
    sides = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    owner = np.tile(np.arange(len(triangles)), 3)
    at = np.concatenate([np.array([[0, 1]] * len(triangles)), np.array([[1, 2]] * len(triangles)),
                         np.array([[2, 0]] * len(triangles))]).reshape(-1, 2)
    turned = sides[:, 0] > sides[:, 1]
    keys, at = np.where(turned[:, None], sides[:, ::-1], sides), np.where(turned[:, None], at[:, ::-1], at)
    order = np.lexsort((keys[:, 1], keys[:, 0]))
    keys, owner, at = keys[order], owner[order], at[order]
    same = np.flatnonzero((keys[1:] == keys[:-1]).all(axis=1))
    smooth = same[np.einsum("ij,ij->i", faces[owner[same]], faces[owner[same + 1]]) > SHARP]
    first = (3 * owner[smooth, None] + at[smooth]).ravel()  # corners on both sides of a smooth edge are the same copy
    second = (3 * owner[smooth + 1, None] + at[smooth + 1]).ravel()
    copies = _connected(3 * len(triangles), first, second)
    origin = np.zeros(copies.max(initial=-1) + 1, np.int64)
    origin[copies] = triangles.ravel()
    split = copies.reshape(-1, 3)
    return origin, corner_normals(points[origin], split), split


def _connected(count, first, second):
    """(count) number of the group of each item, where items of the pairs are in one group."""
    group = np.arange(count)
    while True:
        lowest = np.minimum(group[first], group[second])
        following = group.copy()
        np.minimum.at(following, group[first], lowest)
        np.minimum.at(following, group[second], lowest)
        following = following[following]
        if np.array_equal(following, group):
            return np.unique(group, return_inverse=True)[1]
        group = following


def _face_normals(points, triangles):
    a, b, c = (points[triangles[:, k]] for k in range(3))
    return np.cross(b - a, c - a)


def _unit(vectors):
    length = np.linalg.norm(vectors, axis=1, keepdims=True)
    return vectors / np.where(length > 0, length, 1)
