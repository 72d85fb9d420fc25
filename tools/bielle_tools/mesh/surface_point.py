"""The point of a surface that is nearest to a place, with its normal and the shape functions of its face.

The surface is divided into the triangles between the nodes of its faces. The nearest of them gives a first point, from
which Newton's method finds the one of the curved face.
"""

from dataclasses import dataclass

import numpy as np

from ..messages import InputError, place as shown
from .cell_integrals import shape_functions, shape_gradients
from .cells import CELLS

DIVIDED = {"triangle": ((0, 1, 2),), "triangle6": ((0, 3, 5), (3, 1, 4), (5, 4, 2), (3, 4, 5)),
           "quad": ((0, 1, 2), (0, 2, 3)),
           "quad8": ((0, 4, 7), (4, 1, 5), (5, 2, 6), (6, 3, 7), (4, 5, 6), (4, 6, 7)),
           "quad9": ((0, 4, 8), (4, 1, 8), (1, 5, 8), (5, 2, 8), (2, 6, 8), (6, 3, 8), (3, 7, 8), (7, 0, 8))}
SAME_PLACE = 1e-6   # distance relative to the size of the surface
OFF_SURFACE = 0.05  # largest distance of a place from the surface, relative to its size
SAME_SIDE = np.cos(np.deg2rad(40.0))  # faces whose normals differ more belong to two sides of an edge
STEPS = 20


@dataclass
class SurfacePoint:
    """position (3) and distance from the place [m]; normal (3), outward; nodes (k) of the face, weights (k) at the
    point"""

    position: np.ndarray
    distance: float
    normal: np.ndarray
    nodes: np.ndarray
    weights: np.ndarray


def nearest_on_surface(points, faces, place):
    """faces: {type: (n,k)}, outward. The normal is the mean of those of all faces at the point.
    @raises InputError for a place that is far from the surface, or on an edge between two of its sides"""
    triangles, owners = _triangles(faces)
    corners = points[triangles]
    share = _nearest_in_triangles(corners, place)
    distance = np.linalg.norm(np.einsum("nk,nkj->nj", share, corners) - place, axis=1)
    size = float(np.linalg.norm(np.ptp(points, axis=0)))
    touching, found = np.flatnonzero(distance <= distance.min() + SAME_PLACE * size), {}
    for row in touching[np.argsort(distance[touching], kind="stable")]:
        kind, face, inside = owners[row]
        if (kind, face) not in found:
            start = share[row] @ CELLS[kind].reference[list(inside)]
            found[kind, face] = _on_face(points, kind, faces[kind][face], start, place)
    at = list(found.values())
    nearest = min(at, key=lambda point: point.distance)
    if nearest.distance > OFF_SURFACE * size:
        raise InputError(f"the place {shown(place)} is not on the surface of the body, the nearest point "
                         f"{shown(nearest.position)} of which is {nearest.distance:.3g} m away: places are in m, in the axes of the mesh")
    normals = np.array([point.normal for point in at])
    worst = np.unravel_index(np.argmin(normals @ normals.T), (len(at), len(at)))
    if normals[worst[0]] @ normals[worst[1]] < SAME_SIDE:
        raise InputError(f"the place {shown(place)} is on an edge, between the sides of the surface with the normals "
                         f"{shown(normals[worst[0]])} and {shown(normals[worst[1]])}: say one inside a side")
    mean = normals.sum(axis=0)
    nearest.normal = mean / np.linalg.norm(mean)
    return nearest


def _triangles(faces):
    """Triangles (n,3) of nodes, and for each the type of its face, its number, and the corners as nodes of the face."""
    triangles, owners = [], []
    for kind, block in faces.items():
        for inside in DIVIDED[kind]:
            triangles.append(block[:, list(inside)])
            owners += [(kind, face, inside) for face in range(len(block))]
    return np.concatenate(triangles), owners


def _nearest_in_triangles(corners, place):
    """(n,3) shares of the corners in the point of each triangle (n,3,3) that is nearest to the place."""
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    normal = np.cross(b - a, c - a)
    twice = np.maximum(np.einsum("ij,ij->i", normal, normal), 1e-300)
    shares = np.stack([np.einsum("ij,ij->i", np.cross(q - p, place - p), normal) / twice
                       for p, q in ((b, c), (c, a), (a, b))], axis=1)
    candidates = [np.where((shares >= 0).all(axis=1)[:, None], shares, np.nan)]
    for first, second in ((0, 1), (1, 2), (2, 0)):
        p, q = corners[:, first], corners[:, second]
        length = np.maximum(np.einsum("ij,ij->i", q - p, q - p), 1e-300)
        along = np.clip(np.einsum("ij,ij->i", q - p, place - p) / length, 0, 1)
        on_edge = np.zeros((len(corners), 3))
        on_edge[:, first], on_edge[:, second] = 1 - along, along
        candidates.append(on_edge)
    candidates = np.stack(candidates)
    distances = np.linalg.norm(np.einsum("cnk,nkj->cnj", candidates, corners) - place, axis=2)
    return candidates[np.nanargmin(distances, axis=0), np.arange(len(corners))]


def _on_face(points, kind, nodes, x, place):
    """The point of a curved face from a first one `x` in the reference cell, by Newton's method within the cell."""
    corners = points[nodes]
    for _ in range(STEPS):
        tangents = shape_gradients(kind, x).T @ corners
        step = np.linalg.lstsq(tangents.T, place - shape_functions(kind, x) @ corners, rcond=None)[0]
        new = _within(kind, x + step)
        if np.abs(new - x).max() < 1e-14:
            break
        x = new
    weights = shape_functions(kind, x)
    normal = np.cross(*(shape_gradients(kind, x).T @ corners))
    position = weights @ corners
    distance = float(np.linalg.norm(position - place))
    return SurfacePoint(position, distance, normal / np.linalg.norm(normal), nodes, weights)


def _within(kind, x):
    if CELLS[kind].shape == "quad":
        return np.clip(x, -1, 1)
    x = np.maximum(x, 0)
    return x / max(1.0, x.sum())
