"""Marks of entries: joints whose frames do not meet, and constraints that are redundant."""

import numpy as np

from ..messages import InputError
from ..results.checked_model import check_of
from ..results.quaternions import conjugate, product, rotated
from .drawing import place_of

# Components of the way from the first to the second frame of a joint, in axes of the first, that its constraints make zero.
MEETING = {**dict.fromkeys(("hinge", "spherical", "universal", "constant_velocity", "rigid"), (0, 1, 2)),
           **dict.fromkeys(("prismatic", "cylindrical", "screw", "point_on_line"), (0, 1)), **dict.fromkeys(("planar", "point_on_plane"), (2,))}
PARALLEL = ("hinge", "prismatic", "cylindrical", "screw", "planar", "rigid")  # joints whose axes z are parallel
LEAST_GAP, LEAST_TILT = 1e-7, 1e-6  # a share of the machine; [rad]


def marks_of(scene, rows):
    """{entry: {gap: largest distance that the joint should make zero [m], tilt: largest angle between axes that should be parallel [rad],
    redundant: true}} of the entries that have such, where gap and tilt count while the joint acts."""
    found = {}
    for item in scene.items:
        if item["shape"] == "joint":
            try:
                facts = {**_distance(scene, item, _acting(scene, item["entry"], rows)), **_redundancy(scene.results, item["entry"])}
            except (InputError, KeyError, TypeError, ValueError, AttributeError):
                continue  # the error is reported when the item is built
            found.update({item["entry"]: facts} if facts else {})
    check = check_of(scene.results)
    for entry in check.redundant if check else ():
        found.setdefault(entry, {})["redundant"] = True
    return found


def _acting(scene, entry, rows):
    """The rows in which a joint acts: a released one has no frames that should meet."""
    acts = scene.released.acts(entry)
    return rows if acts is None else np.asarray(rows)[acts[rows]]


def _distance(scene, item, rows):
    first, second = (scene.motion_of_nodes.poses(place_of(frame), rows) for frame in item["frames"])
    back, facts = conjugate(first[:, 3:7]), {}
    way = rotated(back, second[:, :3] - first[:, :3])[:, MEETING.get(item["type"], ())]
    gap = float(np.fmax.reduce(np.linalg.norm(way, axis=1), initial=0))
    if gap > LEAST_GAP * scene.size:
        facts["gap"] = gap
    z = rotated(product(back, second[:, 3:7]), np.array([0.0, 0, 1]))
    tilt = float(np.fmax.reduce(np.arctan2(np.hypot(z[:, 0], z[:, 1]), z[:, 2]), initial=0))
    if item["type"] in PARALLEL and tilt > LEAST_TILT:
        facts["tilt"] = tilt
    return facts


def _redundancy(results, entry):
    place = f"{entry}/reaction_unique"
    return {"redundant": True} if results.has(place) and not np.all(results.array(place)) else {}
