"""Boxes, cylinders and tubes with what is cut out of them: outlines with holes, extruded in layers.

A cut is drawn if it is a cylinder or a box along an axis of the solid and lies inside of its outline: holes, blind holes, pockets, windows.
Layers end where cuts do, so that a blind hole has a bottom. All other cuts (across a cylinder, a sphere, over an edge) are left out.
"""

import numpy as np

from ..results.quaternions import conjugate, product, rotated
from . import templates as t
from .drawing import place_of, positive
from .outlines import apart, inside, triangulated

ALONG = {"box": (0, 1, 2), "cylinder": (2,), "tube": (2,)}
PARALLEL, NEAR, ROUND = 1e-6, 1e-6, 36  # directions; ends of cuts, relative to half the length; corners of a circle


def solid_mesh(item, cuts):
    """The mesh of a solid without those of `cuts`, items of the same entry, that can be drawn, and how many cannot."""
    found = [(axis, *_layers(item, axis, cuts)) for axis in ALONG[item["shape"]]] if cuts else []
    axis, count, layers = max(found, key=lambda each: each[1], default=(2, 0, []))
    if not count:
        return _whole(item), len(cuts)
    outline, holes, _ = _outline(item, axis)
    try:
        pieces = [_extruded(outline, holes + own, low, high) for low, high, own in layers]
    except ValueError:  # holes of very different sizes, next to each other to the last digits
        return _whole(item), len(cuts)
    turn = np.roll(np.eye(3), -axis - 1, axis=1)  # columns: images of the two axes of the outline and of the axis
    return t.moved(t.merged(pieces), axes=turn), len(cuts) - count


def _whole(item):
    if item["shape"] == "box":
        return t.box(positive(*item["size"]))
    if item["shape"] == "tube":
        return t.tube(*positive(item["radius"], item["inner_radius"], item["length"]), ROUND)
    return t.cylinder(*positive(item["radius"], item["length"]), ROUND)


def _circle(radius, centre=(0, 0)):
    return np.asarray(centre, float) + radius * t.circle(ROUND)


def _outline(item, axis):
    """The outline across an axis, anticlockwise, its own holes, and half the length."""
    if item["shape"] == "box":
        a, b, length = (size / 2 for size in np.roll(positive(*item["size"]), -axis - 1))
        return np.array([[-a, -b], [a, -b], [a, b], [-a, b]]), [], length
    radius, length = positive(item["radius"], item["length"])
    return _circle(radius), [_circle(*positive(item["inner_radius"]))] if item["shape"] == "tube" else [], length / 2


def _layers(item, axis, cuts):
    """The number of cuts along an axis that are drawn, and [(low, high, their holes)] between the ends of the solid."""
    outline, own, half = _outline(item, axis)
    host, found = place_of(item), []
    for cut in cuts:
        try:
            hole = _hole(cut, host, axis, half)
        except (KeyError, TypeError, ValueError):
            continue  # it is damaged
        others = own + [other for other, low, high in found if hole and min(high, hole[2]) - max(low, hole[1]) > NEAR * half]
        if hole and inside(hole[0], outline) and all(apart(hole[0], other) for other in others):
            found.append(hole)
    ends = np.unique([-half, half, *[end for _, low, high in found for end in (low, high)]])
    ends = ends[np.concatenate([[True], np.diff(ends) > NEAR * half])]
    ends[-1] = half
    middles = (ends[:-1] + ends[1:]) / 2
    return len(found), [(low, high, [hole for hole, begin, end in found if begin < middle < end]) for low, high, middle in zip(ends[:-1], ends[1:], middles)]


def _hole(cut, host, axis, half):
    """Outline of a cut across the axis of a solid, and where it begins and ends between -half and half; None if it is not along the axis."""
    place = place_of(cut)
    if place.node != host.node or cut["shape"] not in ("cylinder", "box"):
        return None
    back = conjugate(np.array(host.rotation))
    centre = np.roll(rotated(back, np.array(place.position) - host.position), -axis - 1)
    axes = np.roll(rotated(product(back, np.array(place.rotation)), np.eye(3)), -axis - 1, axis=1)  # rows: axes of the cut
    if cut["shape"] == "cylinder":
        radius, length = positive(cut["radius"], cut["length"])
        if abs(axes[2, 2]) < 1 - PARALLEL:
            return None
        outline, length = _circle(radius, centre[:2]), length / 2
    else:
        sizes = np.array(positive(*cut["size"])) / 2
        along = int(np.argmax(np.abs(axes[:, 2])))
        if abs(axes[along, 2]) < 1 - PARALLEL:
            return None
        u, v = (sizes[k] * axes[k, :2] for k in range(3) if k != along)
        outline, length = centre[:2] + np.array([-u - v, u - v, u + v, v - u]), sizes[along]
        if u[0] * v[1] < u[1] * v[0]:
            outline = outline[::-1]
    low, high = max(centre[2] - length, -half), min(centre[2] + length, half)
    low, high = (-half if low + half < NEAR * half else low), (half if half - high < NEAR * half else high)
    return (outline, low, high) if low < high else None


def _extruded(outline, holes, low, high):
    """A closed layer. Corners are edges; sides of circles are smooth."""
    points, triangles = triangulated(outline, holes)
    lids = [t.mesh(np.column_stack([points, np.full(len(points), z)]), turned) for z, turned in ((low, triangles[:, ::-1]), (high, triangles))]
    sides = []
    for ring in [outline, *[hole[::-1] for hole in holes]]:
        rings = np.stack([np.column_stack([ring, np.full(len(ring), z)]) for z in (low, high)])
        sides += [t.strip(rings)] if len(ring) == ROUND else [t.strip(rings[:, [k, (k + 1) % len(ring)]], closed=False) for k in range(len(ring))]
    return t.merged([*lids, *sides])
