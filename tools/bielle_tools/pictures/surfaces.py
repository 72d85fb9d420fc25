"""The parts of a scene as a few large meshes, whose points follow from the poses of bones and from coordinates of bodies.

VTK draws one large mesh much faster than thousands of small ones. Everything that moves is kept in memory, so that
processes that draw need no results file.
"""

from dataclasses import dataclass

import numpy as np

from ..bodies.stress_invariants import von_mises
from ..results.quaternions import conjugate, rotated
from ..results.rotations import rotation_matrices
from ..scene.beam_deformation import magnified
from ..scene.stress_scale import stress_colours
from ..scene.style import marked, muted, shares_of
from ..scene.transforms import placed
from .normals import corner_normals, split_at_edges


LEAST_STRESS = 1.0  # [Pa]; rounding leaves less in a body at rest, which gets no colours


@dataclass
class Moment:
    """A row as it is drawn: points (n,3) inertial [m], normals (n,3), colours (n,4) uint8 with opacity."""

    points: np.ndarray
    normals: np.ndarray
    colours: np.ndarray


class Surfaces:
    """Rigid and flexible parts at `rows`. triangles (m,3) and lines (k,2) are numbers of points; translucent (m) tells
    which triangles are; highest: the largest stress over the rows [Pa], None without stresses."""

    def __init__(self, scene, rows, scale=1.0, paint=None, hidden=lambda part: False, marks=()):
        """scale: magnifies elastic displacements of bodies and beams; paint: ("#rrggbb", opacity) instead of colours and stresses; marks: entries whose
        colours are those of marked ones"""
        self.scale, self.paint, self.marks = scale, paint, marks
        shown = [part for part in [*scene.parts, *scene.flexible] if not hidden(part)]
        self.muted = not paint and any((part.body.stress if hasattr(part, "body") else part.stress) is not None for part in shown)
        self.stressed = []  # (place of points among all, their cells, stresses (rows,cells)) of beams
        self._points, self._normals, self._colours, self._endless = [], [], [], []
        self._triangles, self._lines, self._bones, self.flexible = [], [], [], []
        self.count, poses, bones = 0, [], 0
        for part in scene.parts:
            if not hidden(part) and len(part.mesh.points):
                poses.append(np.asarray(scene.poses(part, rows), float))
                if scale != 1 and part.rest:
                    poses[-1] = magnified(poses[-1], part.rest(rows), scale)
                if part.stress and not paint:
                    self.stressed.append((slice(self.count, self.count + len(part.mesh.points)), part.cells, part.stress(rows)))
                self._add_rigid(part, poses[-1], bones)
                bones += poses[-1].shape[1]
        self.poses = np.concatenate(poses, axis=1) if poses else np.zeros((len(rows), 0, 8))
        shapes = {}
        for part in scene.flexible:
            if not hidden(part):
                if id(part.body) not in shapes:
                    shapes[id(part.body)] = FlexibleShape(part.body)
                self._add_flexible(part, shapes[id(part.body)], rows)
        self._join()
        largest = [each.highest for each in self.flexible] + [float(np.fmax.reduce(values, axis=None, initial=0)) for _, _, values in self.stressed]
        self.highest = max((each for each in largest if each > LEAST_STRESS), default=None)

    def _add_rigid(self, part, poses, first_bone):
        mesh = part.mesh
        self._add(mesh.points, _bone_normals(mesh, poses), mesh.triangles, mesh.lines, part)
        self._bones.append(first_bone + np.asarray(mesh.bones, np.int64))

    def _add_flexible(self, part, shape, rows):
        first = self.count
        self._add(shape.points, shape.normals, shape.triangles, np.zeros((0, 2), np.int64), part)
        self._bones.append(np.full(len(shape.points), -1))
        self.flexible.append(FlexibleMotion(slice(first, self.count), shape, part.frame(rows), part.coordinates(rows), bool(self.paint)))

    def _add(self, points, normals, triangles, lines, part):
        colour, opacity = self.paint or (part.colour, part.opacity)
        known = part.entry in self.marks and not self.paint
        colour = marked(colour) if known else muted(colour) if self.muted else colour
        rgba = np.array([*shares_of(colour), np.rint(255 * np.clip(opacity, 0, 1))], np.uint8)
        self._endless.append(np.full(len(points), len(lines) > 0))  # planes have no end
        self._points.append(points)
        self._normals.append(normals)
        self._colours.append(np.tile(rgba, (len(points), 1)))
        self._triangles.append(np.asarray(triangles, np.int64).reshape(-1, 3) + self.count)
        self._lines.append(np.asarray(lines, np.int64).reshape(-1, 2) + self.count)
        self.count += len(points)

    def _join(self):
        def joined(blocks, shape, kind):
            return np.concatenate([np.zeros(shape, kind), *blocks])

        self.points, self.normals = (joined(blocks, (0, 3), float) for blocks in (self._points, self._normals))
        self.colours = joined(self._colours, (0, 4), np.uint8)
        self.triangles, self.lines = joined(self._triangles, (0, 3), np.int64), joined(self._lines, (0, 2), np.int64)
        self.bones = joined(self._bones, (0,), np.int64)
        self.fitted = ~joined(self._endless, (0,), bool)
        self.rigid = np.flatnonzero(self.bones >= 0)
        self.translucent = self.colours[self.triangles[:, 0], 3] < 255

    def at(self, k, highest=None):
        """The Moment of the k-th row. highest: the stress at the end of the colours [Pa]"""
        points, normals, colours = np.empty_like(self.points), np.empty_like(self.normals), self.colours
        if len(self.rigid):
            poses = self.poses[k][self.bones[self.rigid]]
            points[self.rigid] = placed(poses, self.points[self.rigid])
            normals[self.rigid] = rotated(poses[:, 3:7], self.normals[self.rigid])
        if highest and (self.stressed or self.flexible):
            colours = colours.copy()
        for place, cells, values in self.stressed if highest else ():
            colours[place, :3] = stress_colours(values[k] / highest)[cells]
        for each in self.flexible:
            points[each.place], normals[each.place] = each.at(k, self.scale)
            stress = each.stress(k) if highest else None
            if stress is not None:
                colours[each.place, :3] = stress_colours(stress / highest)
        return Moment(points, normals, colours)


def _bone_normals(mesh, poses):
    """(n,3) normals in the axes of the bones, as they are in the first row that is known: a triangle may join several bones,
    and a bone may be stretched."""
    known = np.flatnonzero(np.isfinite(poses).all(axis=(1, 2)))
    if not len(known):
        return np.zeros((len(mesh.points), 3))
    pose = poses[known[0]][mesh.bones]
    normals = corner_normals(placed(pose, mesh.points), mesh.triangles)
    return rotated(conjugate(pose[:, 3:7]), normals)


class FlexibleShape:
    """The surface of a flexible body with a point for each side of its edges, shared by its instances."""

    def __init__(self, body):
        self.body = body
        self.origin, self.normals, self.triangles = split_at_edges(body.points, body.triangles)
        self.points = body.points[self.origin]
        n = len(body.shapes)
        self.shapes = np.ascontiguousarray(body.shapes.reshape(n, -1).T, np.float32)
        self.stresses = None if body.stress is None else np.ascontiguousarray(
            body.stress.reshape(n, -1, 6)[:, body.stressed].reshape(n, -1).T, np.float32)

    def displacement(self, q):
        """(p,3) of the points [m]"""
        return (self.shapes @ q.astype(np.float32)).reshape(-1, 3)[self.origin]

    def von_mises(self, q):
        """(points of the body) [Pa], not a number if no stress was kept"""
        found = np.full(len(self.body.points), np.nan)
        found[self.body.stressed] = von_mises((self.stresses @ q.astype(np.float32)).reshape(-1, 6).astype(float))
        return found


class FlexibleMotion:
    """An instance of a flexible body over the rows. highest: its largest stress over them [Pa], not a number without stresses."""

    def __init__(self, place, shape, frame, coordinates, plain):
        """place: its points among all; frame (rows,7); coordinates (rows,n); plain: without stresses"""
        self.place, self.shape, self.frame, self.coordinates = place, shape, np.asarray(frame, float), np.asarray(coordinates, float)
        self.stressed = shape.stresses is not None and len(shape.stresses) > 0 and not plain
        largest = [np.fmax.reduce(shape.von_mises(q)) for q in self.coordinates] if self.stressed else []
        self.highest = float(np.fmax.reduce(largest)) if len(largest) else np.nan

    def at(self, k, scale):
        """Points and normals, inertial. Normals turn with the frame: elastic rotations are small."""
        R = rotation_matrices(self.frame[k, 3:])
        local = self.shape.points + scale * self.shape.displacement(self.coordinates[k])
        return self.frame[k, :3] + local @ R.T, self.shape.normals @ R.T

    def stress(self, k):
        """Von Mises stress of its points [Pa], or None."""
        return self.shape.von_mises(self.coordinates[k])[self.shape.origin] if self.stressed else None
