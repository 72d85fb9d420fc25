"""The items that are drawn: `/drawing` of the results file, or for files without it what the results tell.

An item that is damaged is left out, with a note; the file as a whole never fails.
"""

import json

import numpy as np

from ..messages import InputError
from ..results.results_file import reading
from ..results.rigid_bodies import rigid_bodies
from .motion import Place

FORMAT, VERSION = "bielle drawing", 1
LARGEST_NUMBER = 1e30


class Drawing:
    """items: dicts as in the file, each with `entry`, `type` and `shape`; cuts {entry: items that are removed from its others}; gravity (3) or
    None; meshes {name: (points, triangles)}."""

    def __init__(self, results):
        self.file = _file_of(results)
        self.notes, self.gravity, self.name, self.from_file = [], None, "", False
        text = _text(self.file)
        if text:
            self._parse(text)
        if not self.from_file:
            self.items = _items_of(results)
        usable, self.cuts = [item for item in self.items if self._usable(item)], {}
        for item in usable:
            if item.get("role") == "cut":
                self.cuts.setdefault(item["entry"], []).append(item)
        self.items = [item for item in usable if item.get("role") != "cut"]

    def _parse(self, text):
        try:
            found = json.loads(text)
            if found.get("format") != FORMAT or not isinstance(found.get("items"), list):
                raise ValueError(f"it is no '{FORMAT}'")
            if found.get("version") != VERSION:
                raise ValueError(f"its version is {found.get('version')}, not {VERSION}")
            self.items, self.name, self.from_file = found["items"], str(found.get("name", "")), True
            gravity = np.asarray(found.get("gravity", [0, 0, 0]), float)
            self.gravity = gravity if gravity.shape == (3,) and np.isfinite(gravity).all() and gravity.any() else None
        except (ValueError, TypeError, AttributeError, ArithmeticError, RecursionError) as error:
            self.notes.append(("/drawing", f"it cannot be read: {error}"))

    def _usable(self, item):
        if isinstance(item, dict) and all(isinstance(item.get(key), str) for key in ("entry", "shape")):
            if not isinstance(item.setdefault("type", item["shape"]), str):
                item["type"] = item["shape"]
            if _bounded(item):
                return True
            self.notes.append((item["entry"], "it holds numbers that are infinite or beyond all bounds"))
            return False
        self.notes.append(("/drawing", "an item has no entry or no shape"))
        return False

    def mesh(self, name):
        """Points (n,3) and triangles (m,3) of a mesh in the file. @raises InputError"""
        group = f"drawing_meshes/{name}"
        with reading(self.file.filename, group):
            found = self.file[group] if group in self.file else None
            if found is None:
                raise InputError(f"the results hold no mesh '{name}'")
            points, triangles = np.asarray(found["points"], float), np.asarray(found["triangles"], np.int64)
        if points.ndim != 2 or points.shape[1:] != (3,) or triangles.ndim != 2 or triangles.shape[1:] != (3,) or not np.isfinite(points).all() \
                or triangles.size and not 0 <= triangles.min() <= triangles.max() < len(points):
            raise InputError(f"the mesh '{name}' is damaged")
        return points, triangles


def _bounded(value):
    """Tells whether all numbers in a tree of lists and dicts are of a size that a machine can have."""
    if isinstance(value, (dict, list)):
        return all(_bounded(each) for each in (value.values() if isinstance(value, dict) else value))
    return not isinstance(value, (int, float)) or abs(value) < LARGEST_NUMBER


def place_of(item):
    """The place of an item, or of one of its ends or frames. @raises ValueError"""
    position, rotation = (np.asarray(item.get(key, default), float) for key, default in (("position", [0, 0, 0]), ("rotation", [1, 0, 0, 0])))
    if position.shape != (3,) or rotation.shape != (4,) or not np.isfinite(position).all() or not np.linalg.norm(rotation) > 0 \
            or not isinstance(item.get("node", "ground"), str):
        raise ValueError("a place is damaged")
    return Place(item.get("node", "ground"), tuple(position), tuple(rotation / np.linalg.norm(rotation)))


def places_of(item):
    """All places of an item."""
    if item["shape"] == "beam" or item["shape"] == "superelement":
        return []
    parts = [*item.get("ends", []), *item.get("frames", []), *item.get("places", [])]
    if item["shape"] == "course":
        parts = item.get("points", [])
    return [place_of(part) for part in (parts or [item])]


def positive(*numbers):
    """Sizes as a list of positive numbers. @raises ValueError"""
    values = [float(number) for number in numbers]
    if not all(np.isfinite(value) and value > 0 for value in values):
        raise ValueError("a size is not positive")
    return values


def _file_of(results):
    return (results.modes.results if hasattr(results, "modes") else results).file


def _text(file):
    try:
        with reading(file.filename, "drawing"):
            text = file["drawing"][()] if "drawing" in file else ""
            return text.decode() if isinstance(text, bytes) else str(text)
    except InputError:
        return "damaged"


def _items_of(results):
    """Nodes, beams, superelements, and rigid bodies as ellipsoids."""
    items = []
    for name in results.elements_with("frame", "coordinates"):
        items.append({"entry": f"elements/{results.entry_of(name)}", "type": "superelement", "shape": "superelement", "element": f"elements/{name}"})
    for name in results.elements_with("position", "rotation"):
        items.append({"entry": f"elements/{name}", "type": "beam", "shape": "beam", "element": f"elements/{name}", "sections": []})
    for body in rigid_bodies(results) if hasattr(results, "root") else []:
        kind = results.text(f"elements/{body.name}", "type") or "rigid_body"
        entry = {"entry": f"elements/{body.name}", "type": kind, "node": body.node}
        items.append({**entry, "shape": "body", "centre": [float(c) for c in body.centre]})
        if body.extended:
            items.append({**entry, "shape": "ellipsoid", "points": body.points, "triangles": body.triangles, "opacity": 0.6})
    items += [{"entry": f"nodes/{name}", "type": "node", "shape": "node", "node": name} for name in results.names("nodes")]
    return items
