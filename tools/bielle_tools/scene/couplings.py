"""Couplings of joints without a shape of their own: gears by a ratio, differentials, cams by a lift; and the racks of pinions.

Each coupled coordinate has a small toothed wheel on the axis of its joint, or a toothed bar if it is a displacement; lines between them
show which belong together.
"""

import numpy as np

from ..messages import InputError
from ..results.model_text import entries_of
from ..results.quaternions import conjugate, rotated
from . import templates as t
from .drawing import place_of, positive
from .links import rope_mesh
from .parts import Part, on_bones
from .style import COLOURS
from .transforms import between

TYPES = ("gear", "differential", "rack_and_pinion", "cam")
SLIDING = ("prismatic",)  # types of joints whose only coordinate is a displacement
TEETH = 12
RADIUS, WIDTH, STEP = 2.0, 0.4, 0.6  # radius and width of a wheel, distance of those on one axis, in sizes of symbols


def coupling_items(results, items):
    """Items of the shape `coupling` for the couplings that no other item draws: `frames`, a place for each coordinate that is known;
    `sliding` tells which of them are displacements; `level`: how many others are on the joint of each."""
    joints = {item["entry"].partition("/")[2]: item for item in items if item["shape"] == "joint"}
    drawn, levels, found = {item["entry"] for item in items}, {}, []
    for entry, keys in entries_of(results).items() if hasattr(results, "root") else ():
        if not entry.startswith("joints/") or entry in drawn or keys.get("type") not in TYPES or not isinstance(keys.get("joints"), list):
            continue
        item = {"entry": entry, "type": keys["type"], "shape": "coupling", "frames": [], "sliding": [], "level": []}
        for given in keys["joints"]:
            name, coordinate = _named(given, joints)
            if name is None or len(joints[name].get("frames", ())) != 2:
                continue
            item["frames"].append(joints[name]["frames"][1])
            item["sliding"].append(coordinate == "displacement" or not coordinate and joints[name]["type"] in SLIDING)
            item["level"].append(levels.get(name, 0))
            levels[name] = levels.get(name, 0) + 1
        found += [item] if item["frames"] else []
    return found + _rack_items(results, items, joints)


def _rack_items(results, items, joints):
    """Items of the shape `rack` for pinions that are drawn by their radius: `slide`, the frame of the joint that slides, and the gear."""
    found = []
    for gear in items:
        if gear["shape"] == "gear" and gear["type"] == "rack_and_pinion" and hasattr(results, "root"):
            given = entries_of(results).get(gear["entry"], {}).get("joints")
            named = [_named(each, joints) for each in (given if isinstance(given, list) else [])]
            slides = [name for name, coordinate in named if name and (coordinate == "displacement" or not coordinate and joints[name]["type"] in SLIDING)]
            if slides and len(joints[slides[0]].get("frames", ())) == 2:
                found.append({**gear, "shape": "rack", "slide": joints[slides[0]]["frames"][1]})
    return found


def _named(given, joints):
    """Joint and coordinate of `main`, `main.angle` or {joint: main, coordinate: angle}; (None, None) for a formula."""
    if isinstance(given, dict):
        return (given["joint"], given.get("coordinate", "")) if given.get("joint") in joints else (None, None)
    if not isinstance(given, str):
        return None, None
    name, _, coordinate = given.rpartition(".")
    return (given, "") if given in joints else (name, coordinate) if name in joints else (None, None)


def coupling(b, item):
    """Parts of an item, for the table BUILDERS. b: the Builder"""
    places = [place_of(frame) for frame in item["frames"]]
    parts = []
    for place, sliding, level in zip(places, item["sliding"], item["level"]):
        mesh = t.moved(_rack() if sliding else _wheel(), (0, 0, STEP * (1 + level)))
        mesh = t.mesh(b.symbol * mesh.points, mesh.triangles)
        parts.append(b.rigid(item, mesh, "joint", COLOURS["coupling"], place, opacity=0.9))
    if len(places) > 1:
        parts.append(Part(item["entry"], item["type"], on_bones(rope_mesh(0.12 * b.symbol), len(places) - 1), b.colour(item, COLOURS["coupling"]), 0.6, "joint",
                          lambda rows: np.stack([between(b.motion.position(one, rows), b.motion.position(other, rows))
                                                 for one, other in zip(places, places[1:])], axis=1)))
    if not parts:
        raise InputError("none of its joints is drawn")
    return parts


def rack(b, item):
    """The toothed bar of a pinion, for the table BUILDERS: along the axis of the joint that slides, on the side of the pinion where that is."""
    pinion, slide = place_of(item), place_of(item["slide"])
    radius, = positive(item["radius"])
    (centre, q), (start, r) = ((pose[:3], pose[3:7]) for pose in (b.motion.poses(place, np.array([0]))[0] for place in (pinion, slide)))
    axis, along = (rotated(turn, np.array([0.0, 0, 1])) for turn in (q, r))
    outward = np.cross(along, axis)
    if not np.linalg.norm(outward) > 0.1:
        raise InputError("the rack would slide along the axis of its pinion")
    outward *= np.copysign(1 / np.linalg.norm(outward), (start - centre) @ outward if abs((start - centre) @ outward) > 1e-9 * radius else 1)
    height, width, pitch = 0.25 * radius, 0.3 * radius, 0.18 * radius
    bar = t.moved(t.box([height, width, 4 * radius]), (0.7 * height, 0, 0))
    teeth = [t.moved(t.box([0.5 * height, width, 0.5 * pitch]), (0, 0, k * pitch)) for k in range(-10, 11)]
    mesh = t.moved(t.merged([bar, *teeth]), centre + radius * outward - start, np.column_stack([outward, np.cross(along, outward), along]))
    back = conjugate(r)
    return [b.rigid(item, t.mesh(rotated(back, mesh.points), mesh.triangles), "joint", COLOURS["coupling"], slide)]


def _wheel():
    angles = 2 * np.pi / TEETH * (np.arange(TEETH)[:, None] + [0.05, 0.35, 0.5, 0.9]).ravel()
    radii = RADIUS * np.tile([1, 1, 0.78, 0.78], TEETH)
    shape = t.extruded(np.column_stack([radii * np.cos(angles), radii * np.sin(angles)]), WIDTH)
    return t.creased(shape.points, shape.triangles)


def _rack():
    bar = t.moved(t.box([0.5, 0.5, 2.4 * RADIUS]), (RADIUS, 0, 0))
    teeth = [t.moved(t.box([0.4, 0.5, 0.25]), (RADIUS - 0.4, 0, z)) for z in np.linspace(-RADIUS, RADIUS, 7)]
    return t.merged([bar, *teeth])
