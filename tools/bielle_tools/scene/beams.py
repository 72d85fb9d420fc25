"""Beams: the outline of the section swept along the stations, which are the bones."""

import numpy as np

from ..messages import InputError
from ..results.quaternions import conjugate, from_z, product
from . import templates as t
from .beam_deformation import undeformed_motion
from .parts import Mesh
from .transforms import pose


def beam_motion(results, place, turns=None):
    """(rows -> (rows, stations, 8), number of stations) of the element at `place`, in axes of its sections. turns: as `turns_of` gives them"""
    if not (results.has(f"{place}/position") and results.has(f"{place}/rotation")):
        raise InputError("the results do not record its position and rotation")
    kept = []

    def poses(rows):
        if not kept:
            kept.append((results.rows(f"{place}/position"), _section_rotations(results, place, turns)))
        x, q = kept[0]
        return pose(x[rows], q[rows])
    return poses, results.shape(f"{place}/position")[1]


def beam_rest(results, place, turns=None):
    """rows -> (rows, stations, 8) of the undeformed beam where it would be, see beam_deformation.py; None if its strain is not recorded."""
    stations = results.shape(f"{place}/position")[1]
    if not results.has(f"{place}/strain") or results.shape(f"{place}/strain")[1:] != (stations - 1, 6) or stations < 2:
        return None
    return undeformed_motion(results.rows(f"{place}/position"), _section_rotations(results, place, turns), results.rows(f"{place}/strain"))


def turns_of(item):
    """(2,4) rotations from the axes of the first and last node of a beam to those of its sections there, or None. @raises InputError"""
    if item.get("turn") is None:
        return None
    try:
        turns = np.asarray(item["turn"], float).reshape(2, 4)
    except (TypeError, ValueError):
        turns = np.zeros((2, 4))
    length = np.linalg.norm(turns, axis=1, keepdims=True)
    if not (np.isfinite(length) & (length > 0)).all():
        raise InputError(f"'turn' of '{item['entry']}' in the drawing is damaged: two quaternions are expected")
    return turns / length


def _section_rotations(results, place, turns):
    """(nt, stations, 4) of the sections. Both ends are recorded as the nodes there, whose axes are any. Older drawings have no turns: the section
    that each node carries is then taken from its neighbours in the first known row, as if the curvature was constant."""
    q = results.rows(f"{place}/rotation")
    if turns is not None:
        q = q.copy()
        q[:, [0, -1]] = product(q[:, [0, -1]], turns)
        return q
    if q.shape[1] < 3:
        return _along(results.rows(f"{place}/position"), q)
    if hasattr(results, "scenery"):  # a mode: the state about which it is
        reference = results.modes.orientation[[results.scenery.index[node] for node in results.scenery.beams[place.split("/", 1)[1]]]]
    else:
        known = np.flatnonzero(np.isfinite(q).all(axis=(1, 2)))
        if not len(known):
            return q
        reference = q[known[0]]
    q = q.copy()
    for end, first, second in ((0, 1, 2), (-1, -2, -3)):
        bend = product(conjugate(reference[second]), reference[first]) if q.shape[1] > 4 else np.array([1.0, 0, 0, 0])
        q[:, end] = product(q[:, end], product(conjugate(reference[end]), product(reference[first], bend)))
    return q


def _along(x, q):
    """Rotations of a beam without inner nodes: its sections, round their axis anyhow, are across the line between its ends."""
    known = np.flatnonzero(np.isfinite(x).all(axis=(1, 2)) & np.isfinite(q).all(axis=(1, 2)))
    if not len(known) or q.shape[1] < 2:
        return q
    across = product(from_z(x[known[0], 1] - x[known[0], 0]), [np.sqrt(0.5), 0, -np.sqrt(0.5), 0])  # z of from_z is their x
    return product(q, product(conjugate(q[known[0]]), across))


def beam_stress(results, place):
    """rows -> (rows, elements) von Mises stress [Pa] of the element at `place`, the largest of the points of the section; not a number where
    there is none. None if it is not recorded. @raises InputError"""
    if not results.has(f"{place}/von_mises"):
        return None
    shape, stations = results.shape(f"{place}/von_mises"), results.shape(f"{place}/position")[1]
    if len(shape) != 3 or shape[1] != stations - 1 or not shape[2]:
        raise InputError("its 'von_mises' does not fit its nodes")
    kept = []

    def largest(rows):
        if not kept:
            kept.append(np.fmax.reduce(results.rows(f"{place}/von_mises"), axis=2))
        return kept[0][rows]
    return largest


def beam_mesh(stations, sections, thin):
    """(mesh, element of each point). sections: [{at, outer, inner}] as in the drawing. Outlines between sections are interpolated if their
    numbers of points agree. Without sections: a round bar with radius `thin`. Elements have points of their own, so that each has its colour."""
    sections = sorted(sections, key=lambda section: section["at"]) or [{"at": 0.0, "outer": thin * t.circle(10)}]
    at = np.linspace(0, 1, stations)
    outlines = [np.stack([_outline(sections, s, key) for s in at]) for key in ("outer", "inner") if all(section.get(key) is not None for section in sections)]
    points, triangles, bones, elements, n = [], [], [], [], 0
    rings = np.repeat(np.arange(stations), 2)[1:-1] if stations > 1 else np.zeros(1, int)  # both ends of each element
    for outline, outward in zip(outlines, (True, False)):
        corners = outline.shape[1]
        smooth = corners > 8
        columns = [np.arange(corners)] if smooth else [np.array([k, (k + 1) % corners]) for k in range(corners)]
        for column in columns:
            ring = t.strip(np.pad(outline[rings][:, column], ((0, 0), (0, 0), (1, 0))), closed=smooth)
            of_elements = ring.triangles[ring.triangles.min(axis=1) // len(column) % 2 == 0]
            # Rings lie in the plane y, z and follow each other along x: anticlockwise about x is outward.
            points.append(ring.points)
            triangles.append((of_elements if outward else of_elements[:, ::-1]) + n)
            bones.append(np.repeat(rings, len(column)))
            elements.append(np.repeat(np.arange(len(rings)) // 2, len(column)))
            n += len(ring.points)
    for station, sign in ((0, -1), (stations - 1, 1)):
        lid = _lid(outlines, station, sign)
        points.append(lid.points)
        triangles.append(lid.triangles + n)
        bones.append(np.full(len(lid.points), station))
        elements.append(np.full(len(lid.points), min(station, stations - 2)))
        n += len(lid.points)
    return Mesh(np.concatenate(points), np.concatenate(triangles), t.NO_LINES, np.concatenate(bones)), np.concatenate(elements)


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
