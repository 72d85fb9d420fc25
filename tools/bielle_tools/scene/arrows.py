"""Arrows of what the results record: reactions, contact forces, loads, velocities; with their points of application."""

from dataclasses import dataclass

import numpy as np

from ..messages import InputError
from .drawing import place_of

KINDS = ("reactions", "contact forces", "loads", "velocities")
MOST = 4000  # arrows of a scene


@dataclass
class Arrow:
    """origin (rows,3) [m]; vector (rows,3) in `units`, inertial; largest: its largest length in the rows."""
    entry: str
    kind: str
    units: str
    origin: np.ndarray
    vector: np.ndarray
    largest: float


def arrows_of(scene, rows):
    """All arrows of a scene that are not zero throughout."""
    found = []
    for entry, kind, units, origin, vector in _candidates(scene, rows):
        known = np.isfinite(origin).all(axis=1) & np.isfinite(vector).all(axis=1)
        vector = np.where(known[:, None], vector, 0)
        largest = float(np.linalg.norm(vector, axis=1).max(initial=0))
        if largest > 0:
            found.append(Arrow(entry, kind, units, np.where(known[:, None], origin, 0), vector, largest))
        if len(found) >= MOST:
            break
    return found


def _candidates(scene, rows):
    results, motion = scene.results, scene.motion_of_nodes
    for item in scene.items:
        try:
            if item["shape"] == "joint" and results.has(f"{item['entry']}/reaction_inertial"):
                yield (item["entry"], "reactions", "N", motion.position(place_of(item["frames"][1]), rows),
                       results.rows(f"{item['entry']}/reaction_inertial")[rows, :3])
            elif item["shape"] == "force" and results.has(f"{item['entry']}/force"):
                force = results.rows(f"{item['entry']}/force")
                if force.ndim == 2 and force.shape[1] == 3:
                    yield item["entry"], "loads", "N", motion.position(place_of(item), rows), force[rows]
            elif item["shape"] == "beam" and results.has(f"{item['entry']}/distributed_force"):
                yield item["entry"], "loads", "N", *_line_load(results, item["entry"], rows)
        except (InputError, KeyError, TypeError, ValueError, IndexError, ArithmeticError):
            continue
    for section, function in (("supports", _support), ("contacts", _contact), ("nodes", _velocity)):
        for name in results.names(section):
            try:
                yield from function(scene, name, rows)
            except (InputError, KeyError, ValueError):
                continue


def _line_load(results, entry, rows):
    """The resultant of the loads per length on a beam: the point of its line of action that is nearest to the middle of the beam's nodes, and the
    force. (A moment about the force does not show.)"""
    force, moment, position = (results.rows(f"{entry}/{name}")[rows] for name in ("distributed_force", "distributed_moment", "position"))
    middle = position.mean(axis=1)
    square = (force**2).sum(axis=1, keepdims=True)
    with np.errstate(invalid="ignore", divide="ignore"):
        from_middle = np.cross(force, moment - np.cross(middle, force)) / square
    return np.where(square > 0, middle + from_middle, middle), force


def _support(scene, name, rows):
    if scene.results.has(f"supports/{name}/reaction"):
        yield (f"nodes/{name}", "reactions", "N", scene.motion_of_nodes.node(name)[0][rows],
               scene.results.rows(f"supports/{name}/reaction")[rows, :3])


def _contact(scene, name, rows):
    place = f"contacts/{name}"
    if scene.results.has(f"{place}/point") and scene.results.has(f"{place}/force"):
        entry, force = f"joints/{name}", scene.results.rows(f"{place}/force")[rows]
        if force.ndim == 2:
            yield entry, "contact forces", "N", scene.results.rows(f"{place}/point")[rows], force
            return
        # The results hold the sum of the forces on each of several shapes, which acts at its middle as far as they tell.
        shapes = [item for item in scene.items if item["entry"] == entry and item.get("role") == "contact"]
        for k, item in enumerate(shapes if len(shapes) == force.shape[1] else []):
            if place_of(item).node != "ground":
                yield entry, "contact forces", "N", scene.motion_of_nodes.position(place_of(item), rows), force[:, k]


def _velocity(scene, name, rows):
    if scene.results.has(f"nodes/{name}/velocity"):
        yield (f"nodes/{name}", "velocities", "m/s", scene.motion_of_nodes.node(name)[0][rows],
               scene.results.rows(f"nodes/{name}/velocity")[rows, :3])
