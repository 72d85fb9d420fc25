"""A scene for the page: meshes of rigid parts in one batch, flexible bodies with quantised shapes, tracks, labels."""

import numpy as np

from ..scene.arrows import arrows_of
from ..scene.style import marked, muted
from .body_data import BodyData
from .tracks import Tracks, in_units

UNIT_TRACK = 127  # normals are bytes


class SceneData:
    """Describes scenes in units of one size about one centre; bodies of several scenes are stored once."""

    def __init__(self, pack, centre, size):
        self.pack, self.centre, self.size = pack, centre, size
        self.bodies, self._numbers, self._data = [], {}, []
        self._errors = {"position": 0.0, "rotation": 0.0, "shape": 0.0, "stress": 0.0, "of stress": 0.0}

    def described(self, scene, rows, arrows=True):
        """The scene at these rows, for the page."""
        tracks = Tracks(len(rows))
        units = lambda poses: in_units(poses, self.centre, self.size)  # noqa: E731
        parts = [(part, tracks.add(units(scene.poses(part, rows)), units(part.rest(rows)) if part.rest else None)) for part in scene.parts]
        found = {"batch": self._batch(parts), "parts": [self._part(part, numbers) for part, numbers in parts],
                 "stressed": [self._stressed(part, rows) for part in scene.parts if part.stress],
                 "flexible": [self._flexible(part, rows, tracks) for part in scene.flexible],
                 "anchors": self._anchors(scene, parts), "arrows": self._arrows(scene, rows) if arrows else []}
        found["tracks"], position, rotation = tracks.stored(self.pack)
        found["tracks"]["rests"] = tracks.rests
        self._largest(position=position, rotation=rotation)
        return found

    def _largest(self, **errors):
        for name, value in errors.items():
            self._errors[name] = max(self._errors[name], float(value))

    @property
    def errors(self):
        """Errors by quantised numbers: {position, shape} in sizes, {rotation} [rad], {stress} relative to the largest of all scenes."""
        stress, largest = self._errors["stress"], self._errors["of stress"]
        return {**{name: self._errors[name] for name in ("position", "rotation", "shape")}, "stress": stress / largest if largest > 0 else 0.0}

    @staticmethod
    def _part(part, numbers):
        return {"entry": part.entry, "type": part.type, "colour": part.colour, "marked": marked(part.colour), "muted": muted(part.colour), "opacity": part.opacity, "group": part.group,
                "track": numbers[0] if numbers else 0, "endless": bool(part.mesh.lines.size)}

    def _batch(self, parts):
        """All rigid meshes as one: points, normals, number of track and of part of each point."""
        points, normals, bones, owners, cells, triangles, lines, start, first_cell = [], [], [], [], [], [], [], 0, 0
        for number, (part, tracks) in enumerate(parts):
            mesh = part.mesh
            points.append(mesh.points / self.size)
            normals.append(_normals(mesh))
            bones.append(np.asarray(tracks, int)[mesh.bones] if len(mesh.points) else np.zeros(0, int))
            owners.append(np.full(len(mesh.points), number))
            cells.append(first_cell + np.asarray(part.cells) if part.stress else np.full(len(mesh.points), -1))
            first_cell += int(np.max(part.cells)) + 1 if part.stress else 0
            triangles.append(mesh.triangles + start)
            lines.append(mesh.lines + start)
            start += len(mesh.points)
        add, join = self.pack.add, lambda pieces, width: np.concatenate(pieces) if pieces else np.zeros((0, width))
        return {"points": add(join(points, 3), "f4"), "normals": add(np.round(127 * join(normals, 3)), "i1"), "bones": add(join(bones, 1), "i4"),
                "owners": add(join(owners, 1), "i4"), "cells": add(join(cells, 1), "i4"), "triangles": add(join(triangles, 3), "i4"), "lines": add(join(lines, 2), "i4")}

    def _stressed(self, part, rows):
        """Stresses of the cells of a part over the rows [Pa], -1 where there are none."""
        values = part.stress(rows).T
        largest = float(np.fmax.reduce(values, axis=None, initial=0))
        step = largest / 32767
        whole = np.where(np.isfinite(values), np.round(values / (step or 1)), -1)
        self._largest(**{"stress": np.fmax.reduce(np.abs(step * whole - values), axis=None, initial=0), "of stress": largest})
        return {"count": len(values), "values": self.pack.add(whole, "i2", True), "step": step, "largest": largest}

    def _flexible(self, part, rows, tracks):
        frame, q = part.frame(rows), part.coordinates(rows)
        pose = np.concatenate([frame, np.ones((len(frame), 1))], axis=1)[:, None]
        known = q[np.isfinite(q).all(axis=1)]
        number = self._body(part.body)
        self._largest(**self._data[number].errors(known))
        return {"entry": part.entry, "type": part.type, "colour": part.colour, "marked": marked(part.colour), "muted": muted(part.colour), "opacity": part.opacity, "group": "body", "body": number,
                "track": tracks.add(in_units(pose, self.centre, self.size))[0], "coordinates": self.pack.add(np.nan_to_num(q), "f4"),
                "missing": [int(row) for row in np.flatnonzero(~np.isfinite(q).all(axis=1))], **self._data[number].peaks(known, self.pack)}

    def _body(self, body):
        """The number of a body among those of the page."""
        key = (body.path, body.piece)
        if key not in self._numbers:
            self._numbers[key] = len(self.bodies)
            add, data = self.pack.add, BodyData(body, self.size)
            levels = [{"cell": level.cell / self.size, "count": level.count, "triangles": add(level.triangles, "i4")} for level in body.levels]
            self.bodies.append({"points": add(body.points / self.size, "f4"), "levels": levels, "count": len(body.shapes), "nodes": add(body.nodes, "i4"),
                                **data.describe(self.pack)})
            self._data.append(data)
        return self._numbers[key]

    def _anchors(self, scene, parts):
        numbers = {id(part): tracks for part, tracks in parts}
        flexible = {id(part): k for k, part in enumerate(scene.flexible)}
        found = []
        for anchor in scene.anchors:
            point = [float(x) for x in anchor.point / self.size]
            if id(anchor.part) in numbers:
                found.append({"entry": anchor.entry, "track": numbers[id(anchor.part)][anchor.bone], "point": point})
            else:
                found.append({"entry": anchor.entry, "flexible": flexible[id(anchor.part)], "point": point})
        return found

    def _arrows(self, scene, rows):
        found = []
        for arrow in arrows_of(scene, rows):
            x = (arrow.origin - self.centre) / self.size
            found.append({"entry": arrow.entry, "kind": arrow.kind, "units": arrow.units, "origin": self.pack.add(np.nan_to_num(x), "f4"),
                          "vector": self.pack.add(np.nan_to_num(arrow.vector), "f4"), "largest": arrow.largest})
        return found


def _normals(mesh):
    """(n,3) unit normals: sums of those of the triangles at each point, weighted by area."""
    normals = np.zeros((len(mesh.points), 3))
    if len(mesh.triangles):
        a, b, c = (mesh.points[mesh.triangles[:, k]] for k in range(3))
        each = np.cross(b - a, c - a)
        for k in range(3):
            normals[:, k] = np.bincount(mesh.triangles.ravel(), weights=np.repeat(each[:, k], 3), minlength=len(normals))
    length = np.linalg.norm(normals, axis=1, keepdims=True)
    return np.where(length > 0, normals / np.where(length > 0, length, 1), [0, 0, 1.0])
