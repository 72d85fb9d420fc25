"""Plane outlines (n,2): whether one lies inside of or apart from others, and triangles of one with holes, by cutting ears.

Holes are joined to the outline by bridges to a corner that sees them; then triangles without a corner inside are cut off one after
another (G. H. Meisters, Amer. Math. Monthly 82 (1975) 648).
"""

import numpy as np


def inside(inner, outline):
    """Tells whether an outline lies inside of a convex one (anticlockwise), without touching it."""
    edges = np.roll(outline, -1, axis=0) - outline
    across = edges[:, 0] * (inner[:, None, 1] - outline[:, 1]) - edges[:, 1] * (inner[:, None, 0] - outline[:, 0])
    return bool((across > 1e-9 * np.abs(edges).max() ** 2).all())


def apart(a, b):
    """Tells whether two convex outlines have a line between them: one of their own edges."""
    for one, other in ((a, b), (b, a)):
        edges = np.roll(one, -1, axis=0) - one
        across = edges[:, 0] * (other[:, None, 1] - one[:, 1]) - edges[:, 1] * (other[:, None, 0] - one[:, 0])
        if (across < -1e-9 * np.abs(edges).max() ** 2).all(axis=0).any():
            return True
    return False


def triangulated(outline, holes):
    """Points and triangles (m,3), anticlockwise. All outlines are anticlockwise, the holes inside and apart from each other."""
    points = np.concatenate([outline, *holes])
    starts = np.cumsum([len(outline)] + [len(hole) for hole in holes])
    ring = list(range(len(outline)))
    rings = [list(range(start, start + len(hole)))[::-1] for start, hole in zip(starts, holes)]
    rings.sort(key=lambda own: -points[own, 0].max())
    for k, hole in enumerate(rings):
        _bridge(points, ring, hole, rings[k + 1:])
    return points, np.array(_ears(points, ring))


def _bridge(points, ring, hole, others):
    """Puts a hole into the ring, by a line from its rightmost point to the nearest point of the ring that it sees."""
    start = int(np.argmax(points[hole, 0]))
    hole = hole[start:] + hole[:start]
    first = points[hole[0]]
    edges = np.array([(own[k], own[(k + 1) % len(own)]) for own in [ring, hole, *others] for k in range(len(own))])
    for k in np.argsort(np.linalg.norm(points[ring] - first, axis=1)):
        before, corner, after = points[ring[k - 1]], points[ring[k]], points[ring[(k + 1) % len(ring)]]
        if _opens(before, corner, after, first) and not _crosses(first, corner, points[edges], {hole[0], ring[k]}, edges):
            ring[k + 1:k + 1] = [*hole, hole[0], ring[k]]
            return
    raise ValueError("an outline sees none of its holes")


def _opens(before, corner, after, to):
    """Tells whether a line from a corner of an anticlockwise ring begins inside of it: a ring may pass a point twice."""
    if _turn(before, corner, after) >= 0:
        return _turn(corner, to, before) > 0 and _turn(to, corner, after) > 0
    return not (_turn(corner, to, after) >= 0 and _turn(to, corner, before) >= 0)


def _crosses(a, b, edges, ends, numbers):
    """Tells whether a line from a to b meets edges (n,2,2) that do not end where it does."""
    free = ~np.isin(numbers, list(ends)).any(axis=1)
    p, q = edges[free, 0], edges[free, 1]
    return bool(((_turn(a, b, p) * _turn(a, b, q) <= 0) & (_turn(p, q, a) * _turn(p, q, b) <= 0)).any())


def _turn(a, b, c):
    """Twice the area of a, b, c: positive if they are anticlockwise."""
    return (b[..., 0] - a[..., 0]) * (c[..., 1] - a[..., 1]) - (b[..., 1] - a[..., 1]) * (c[..., 0] - a[..., 0])


def _ears(points, ring):
    """Triangles of a ring that may pass points twice. @raises ValueError"""
    ring, triangles, tried, k = np.array(ring), [], 0, 0
    plain = points.tolist()
    while len(ring) > 3:
        k %= len(ring)
        a, b, c = ear = [int(ring[k - 1]), int(ring[k]), int(ring[(k + 1) % len(ring)])]
        (ax, ay), (bx, by), (cx, cy) = plain[a], plain[b], plain[c]
        if (bx - ax) * (cy - ay) > (by - ay) * (cx - ax) and not _any_within(points, ring, ear):
            triangles.append(ear)
            ring = np.delete(ring, k)
            tried, k = 0, k + 1  # ears next to each other would be needles
            continue
        tried, k = tried + 1, k + 1
        if tried > len(ring):
            raise ValueError("an outline cannot be divided into triangles")
    return [*triangles, ring.tolist()]


def _any_within(points, ring, ear):
    """Tells whether a point of a ring, other than its corners, lies in a triangle or on its border."""
    a, b, c = points[ear]
    x, y = points[ring].T
    near = ring[(x >= min(a[0], b[0], c[0])) & (x <= max(a[0], b[0], c[0])) & (y >= min(a[1], b[1], c[1])) & (y <= max(a[1], b[1], c[1]))]
    near = points[[k for k in near.tolist() if k not in ear]].reshape(-1, 2)
    return bool(((_turn(a, b, near) >= 0) & (_turn(b, c, near) >= 0) & (_turn(c, a, near) >= 0)).any())
