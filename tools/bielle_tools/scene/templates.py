"""Meshes of simple shapes: axis z, middle at the origin, triangles outward."""

import numpy as np

from .parts import Mesh

NO_TRIANGLES, NO_LINES = np.zeros((0, 3), int), np.zeros((0, 2), int)


def mesh(points, triangles=NO_TRIANGLES, lines=NO_LINES):
    """A mesh on one bone."""
    points = np.asarray(points, float).reshape(-1, 3)
    return Mesh(points, np.asarray(triangles, int).reshape(-1, 3), np.asarray(lines, int).reshape(-1, 2), np.zeros(len(points), int))


def strip(rings, closed=True):
    """Points (k,n,3) of k rings, one after another along the normal of each ring, joined by triangles."""
    k, n = rings.shape[:2]
    around = np.arange(n if closed else n - 1)
    a = (np.arange(k - 1)[:, None] * n + around).ravel()
    b = (np.arange(k - 1)[:, None] * n + (around + 1) % n).ravel()
    return mesh(rings, np.column_stack([np.concatenate([a, a]), np.concatenate([b, b + n]), np.concatenate([b + n, a + n])]))


def circle(count):
    angles = 2 * np.pi * np.arange(count) / count
    return np.column_stack([np.cos(angles), np.sin(angles)])


def lathe(profile, smooth=False, around=24):
    """A solid of revolution about z of a profile of (radius, z). The outside is on the right of the profile's direction. Without `smooth`,
    corners of the profile are edges."""
    profile, ring = np.asarray(profile, float), circle(around)
    rings = np.stack([np.column_stack([r * ring, np.full(around, z)]) for r, z in profile])
    if smooth:
        return strip(rings)
    pieces = [strip(rings[k:k + 2]) for k in range(len(rings) - 1)]
    return merged(pieces)


def merged(pieces):
    """Several meshes of one bone as one."""
    offsets = np.cumsum([0] + [len(piece.points) for piece in pieces])
    return mesh(np.concatenate([piece.points for piece in pieces]),
                np.concatenate([piece.triangles + offset for piece, offset in zip(pieces, offsets)]),
                np.concatenate([piece.lines + offset for piece, offset in zip(pieces, offsets)]))


def moved(shape, offset=(0, 0, 0), axes=None):
    """A mesh turned by a matrix (columns: images of x, y, z) and moved."""
    points = shape.points if axes is None else shape.points @ np.asarray(axes, float).T
    return Mesh(points + np.asarray(offset, float), shape.triangles, shape.lines, shape.bones)


ALONG_X = [[0, 0, 1], [1, 0, 0], [0, 1, 0]]  # axes that take z to x
ALONG_Y = [[0, 1, 0], [0, 0, 1], [1, 0, 0]]  # axes that take z to y


def box(size):
    a, b, c = np.asarray(size, float) / 2
    faces = []
    for axes in (np.eye(3), ALONG_X, ALONG_Y):
        half = np.abs(np.asarray(axes, float).T @ [a, b, c])
        for sign in (1, -1):
            square = [[-half[0], -half[1] * sign, sign * half[2]], [half[0], -half[1] * sign, sign * half[2]],
                      [half[0], half[1] * sign, sign * half[2]], [-half[0], half[1] * sign, sign * half[2]]]
            faces.append(moved(mesh(square, [[0, 1, 2], [0, 2, 3]]), axes=axes))
    return merged(faces)


def cylinder(radius, length, around=24):
    return lathe([(0, -length / 2), (radius, -length / 2), (radius, length / 2), (0, length / 2)], around=around)


def tube(radius, inner, length, around=24):
    h = length / 2
    return lathe([(inner, -h), (radius, -h), (radius, h), (inner, h), (inner, -h)], around=around)


def cone(radii, length, around=24):
    h = length / 2
    return lathe([(0, -h), (radii[0], -h), (radii[1], h), (0, h)], around=around)


def sphere(radius, along=10, around=20):
    angles = np.linspace(-np.pi / 2, np.pi / 2, along + 1)
    return lathe(radius * np.column_stack([np.cos(angles), np.sin(angles)]), smooth=True, around=around)


def torus(radius, thickness, width=None, around=36):
    """Outer radius; the ring is `thickness` high along the radius, and `width` wide along z."""
    angles = np.linspace(-np.pi, np.pi, 15)
    half, wide = thickness / 2, (width or thickness) / 2
    return lathe(np.column_stack([radius - half + half * np.cos(angles), wide * np.sin(angles)]), smooth=True, around=around)


def octahedron(radius):
    corners = radius * np.array([[1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]], float)
    faces = [corners[[k, (k + 1) % 4, 4]] for k in range(4)] + [corners[[(k + 1) % 4, k, 5]] for k in range(4)]
    return mesh(np.concatenate(faces), np.arange(24).reshape(-1, 3))


def extruded(contour, length):
    """A contour (n,2), star-shaped about its mean, from -length/2 to length/2."""
    contour = np.asarray(contour, float)
    if len(contour) > 2 and np.allclose(contour[0], contour[-1]):
        contour = contour[:-1]
    x, y = contour.T
    if (x * np.roll(y, -1) - y * np.roll(x, -1)).sum() < 0:
        contour = contour[::-1]
    n, h = len(contour), length / 2
    rings = [np.column_stack([contour, np.full(n, z)]) for z in (-h, h)]
    lids = []
    for ring, upward in zip(rings, (False, True)):
        a, b = np.arange(n), (np.arange(n) + 1) % n
        lids.append(mesh(np.vstack([ring, ring.mean(axis=0)]), np.column_stack([a, b, np.full(n, n)] if upward else [b, a, np.full(n, n)])))
    side = strip(np.stack(rings)) if n > 16 else merged([strip(np.stack(rings)[:, [k, (k + 1) % n]], closed=False) for k in range(n)])
    return merged([side, *lids])


def rod(start, end, radii, around=10):
    """A tapered bar between two points."""
    start, end = np.asarray(start, float), np.asarray(end, float)
    z = (end - start) / np.linalg.norm(end - start)
    x = np.cross(np.eye(3)[np.argmin(np.abs(z))], z)
    x /= np.linalg.norm(x)
    return moved(cone(radii, np.linalg.norm(end - start), around), (start + end) / 2, np.column_stack([x, np.cross(z, x), z]))


def polyline(points, radius, around=6):
    """A thin pipe along points (n,3)."""
    return merged([rod(a, b, (radius, radius), around) for a, b in zip(points[:-1], points[1:]) if np.linalg.norm(b - a) > 0])


def creased(points, triangles, angle=0.6):
    """A mesh whose points are divided at edges that are sharper than the angle [rad], so that it can be shaded smoothly."""
    points, triangles = np.asarray(points, float), np.asarray(triangles, int)
    if not len(triangles):
        return mesh(points)
    a, b, c = (points[triangles[:, k]] for k in range(3))
    normals = np.cross(b - a, c - a)
    unit = normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
    # Each corner of a triangle takes the mean of those normals at its point that are close to its own.
    corner_points, faces = triangles.ravel(), np.repeat(np.arange(len(triangles)), 3)
    order = np.argsort(corner_points, kind="stable")
    start = np.searchsorted(corner_points[order], np.arange(len(points) + 1))
    count = np.diff(start)[corner_points]
    first = np.repeat(np.arange(len(faces)), count)
    within = np.arange(count.sum()) - np.repeat(np.cumsum(count) - count, count)
    other = order[np.repeat(start[corner_points], count) + within]
    close = (unit[faces[first]] * unit[faces[other]]).sum(axis=1) > np.cos(angle)
    mean = np.zeros((len(faces), 3))
    for k in range(3):
        mean[:, k] = np.bincount(first[close], weights=normals[faces[other[close]], k], minlength=len(faces))
    mean /= np.maximum(np.linalg.norm(mean, axis=1, keepdims=True), 1e-300)
    _, kept, inverse = np.unique(np.column_stack([corner_points, np.round(50 * mean).astype(int)]), axis=0, return_index=True, return_inverse=True)
    return mesh(points[corner_points[kept]], inverse.reshape(-1, 3))
