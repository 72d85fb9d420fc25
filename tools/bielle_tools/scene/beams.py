"""Beams: the outline of the section swept along the stations, which are the bones."""

import numpy as np

from ..messages import InputError
from . import templates as t
from .parts import Mesh
from .transforms import IDENTITY, conjugate, from_z, pose, product, rotated


def beam_motion(results, element):
    """rows -> (rows, stations, 8)"""
    place = f"{element}"
    if not (results.has(f"{place}/position") and results.has(f"{place}/rotation")):
        raise InputError("the results do not record its position and rotation")
    kept = []

    def poses(rows):
        if not kept:
            kept.append(with_section_axes(results.rows(f"{place}/position"), results.rows(f"{place}/rotation")))
        x, q = kept[0]
        return pose(x[rows], q[rows])
    return poses, results.shape(f"{place}/position")[1]


def with_section_axes(x, q):
    """Positions (nt,n,3), and rotations (nt,n,4) of the section: those of inner nodes are recorded so, but those of the ends are of
    nodes with axes of their own. The section is fixed to an end node; its axes there continue those of the inner nodes in the first
    row, with their curvature and twist, or are along the beam if it has no inner nodes."""
    known = np.flatnonzero(np.isfinite(x).all(axis=(1, 2)) & np.isfinite(q).all(axis=(1, 2)))
    if not len(known) or x.shape[1] < 2:
        return x, q
    q, first = q.copy(), known[0]
    for end, next_one, third, sign in ((0, 1, 2, 1), (-1, -2, -3, -1)):
        node, inner = q[first, end], q[first, 1:-1]
        if len(inner) > 1:
            section = product(q[first, next_one], product(conjugate(q[first, third]), q[first, next_one]))
        elif len(inner):
            section = inner[0]
        else:
            tangent = sign * (x[first, next_one] - x[first, end])
            section = product(_turn(rotated(node, [1.0, 0, 0]), tangent), node)
        q[:, end] = product(q[:, end], product(conjugate(node), section))
    return x, q


def _turn(start, to):
    """(4) a rotation from one direction to another: the smallest, unless they are opposite."""
    axis, cosine = np.cross(start, to), float(np.dot(start, to))
    sine = float(np.linalg.norm(axis))
    if sine < 1e-9 * abs(cosine):
        return IDENTITY if cosine > 0 else product(from_z(to), conjugate(from_z(start)))
    half = 0.5 * np.arctan2(sine, cosine)
    return np.concatenate([[np.cos(half)], np.sin(half) * axis / max(sine, 1e-300)])


def beam_mesh(stations, sections, thin):
    """sections: [{at, outer, inner}] as in the drawing. Outlines between sections are interpolated if their numbers of points agree.
    Without sections: a round bar with radius `thin`."""
    sections = sorted(sections, key=lambda section: section["at"]) or [{"at": 0.0, "outer": thin * t.circle(10)}]
    at = np.linspace(0, 1, stations)
    outlines = [np.stack([_outline(sections, s, key) for s in at]) for key in ("outer", "inner") if all(section.get(key) is not None for section in sections)]
    pieces, n = [], 0
    for outline, outward in zip(outlines, (True, False)):
        pieces.append((outline, outward))
    points, triangles, lines, bones = [], [], [], []
    for outline, outward in pieces:
        corners = outline.shape[1]
        smooth = corners > 8
        columns = [np.arange(corners)] if smooth else [np.array([k, (k + 1) % corners]) for k in range(corners)]
        for column in columns:
            ring = t.strip(np.pad(outline[:, column], ((0, 0), (0, 0), (1, 0))), closed=smooth)
            # Rings lie in the plane y, z and follow each other along x: anticlockwise about x is outward.
            points.append(ring.points)
            triangles.append((ring.triangles if outward else ring.triangles[:, ::-1]) + n)
            bones.append(np.repeat(np.arange(stations), len(column)))
            n += len(ring.points)
    for station, sign in ((0, -1), (stations - 1, 1)):
        lid = _lid(outlines, station, sign)
        points.append(lid.points)
        triangles.append(lid.triangles + n)
        bones.append(np.full(len(lid.points), station))
        n += len(lid.points)
    lines.append(t.NO_LINES)
    return Mesh(np.concatenate(points), np.concatenate(triangles), np.concatenate(lines), np.concatenate(bones))


def _lid(outlines, station, sign):
    """The end face at a station."""
    outer = outlines[0][station]
    n = len(outer)
    a, b = np.arange(n), (np.arange(n) + 1) % n
    if len(outlines) > 1 and len(outlines[1][station]) == n:
        points = np.concatenate([outer, outlines[1][station]])
        triangles = np.concatenate([np.column_stack([a, b, b + n]), np.column_stack([a, b + n, a + n])])
    else:
        points = np.vstack([outer, outer.mean(axis=0)])
        triangles = np.column_stack([a, b, np.full(n, n)])
    return t.mesh(np.pad(points, ((0, 0), (1, 0))), triangles if sign > 0 else triangles[:, ::-1])


def _outline(sections, s, key):
    """(n,2) anticlockwise."""
    places = [section["at"] for section in sections]
    after = int(np.clip(np.searchsorted(places, s), 1, len(sections) - 1)) if len(sections) > 1 else 0
    before = max(after - 1, 0)
    first, second = (_anticlockwise(sections[k][key]) for k in (before, after))
    if len(first) != len(second):
        return _resampled(first if s <= places[after] - 1e-9 else second, max(len(_anticlockwise(section[key])) for section in sections))
    span = places[after] - places[before]
    share = np.clip((s - places[before]) / span, 0, 1) if span > 0 else 0.0
    result = (1 - share) * first + share * second
    most = max(len(section[key]) for section in sections)
    return result if all(len(section[key]) == most for section in sections) else _resampled(result, most)


def _anticlockwise(outline):
    outline = np.asarray(outline, float).reshape(-1, 2)
    if len(outline) > 3 and np.allclose(outline[0], outline[-1]):
        outline = outline[:-1]
    if len(outline) < 3:
        raise ValueError("a section has fewer than three points")
    x, y = outline.T
    return outline if (x * np.roll(y, -1) - y * np.roll(x, -1)).sum() >= 0 else outline[::-1]


def _resampled(outline, count):
    closed = np.vstack([outline, outline[:1]])
    s = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(closed, axis=0), axis=1))])
    wanted = np.linspace(0, s[-1], count, endpoint=False)
    return np.column_stack([np.interp(wanted, s, closed[:, k]) for k in (0, 1)])
