"""The path of a rope or belt over pulleys: tangents and arcs, for each row.

Consecutive points are circles with radius r (0: a point) and side s; the tangent of two circles with signed radii s r leaves the line of
centres by the angle whose sine is (s1 r1 - s2 r2) / distance. A pulley turns about z of its place; with side +1 the path runs round it
anticlockwise seen along -z. Arcs have a fixed number of pieces, so that the number of bones does not change.
"""

import numpy as np

from ..results.quaternions import rotated
from .transforms import between

PIECES = 14  # number of straight pieces that an arc is drawn with


class Course:
    """points: [(place, radius, side)]; closed: the last is joined to the first."""

    def __init__(self, motion, points, closed):
        self.motion, self.points, self.closed = motion, points, closed

    @property
    def bone_count(self):
        return sum(1 if k == "straight" else PIECES for k, _ in self._sequence())

    def _sequence(self):
        n = len(self.points)
        for k, (_, radius, _) in enumerate(self.points):
            if radius > 0 and (self.closed or 0 < k < n - 1):
                yield "arc", k
            if k < n - 1 or self.closed:
                yield "straight", k

    def poses(self, rows):
        """(rows, bones, 8)"""
        n = len(self.points)
        x = [self.motion.position(place, rows) for place, _, _ in self.points]
        axes = [rotated(self.motion.poses(place, rows)[:, 3:7], np.array([0, 0, 1.0])) for place, _, _ in self.points]
        leave, arrive = [None] * n, [None] * n
        for k in range(n if self.closed else n - 1):
            following = (k + 1) % n
            leave[k], arrive[following] = self._tangent(k, following, x, axes)
        bones = []
        for kind, k in self._sequence():
            if kind == "straight":
                bones.append(between(leave[k], arrive[(k + 1) % n])[:, None])
            else:
                line = self._arc(arrive[k], leave[k], x[k], axes[k], self.points[k][2])
                bones.append(between(line[:, :-1], line[:, 1:]))
        return np.concatenate(bones, axis=1) if bones else np.zeros((len(rows), 0, 8))

    def _tangent(self, a, b, x, axes):
        """Points (rows,3) at which the straight part from a to b leaves a and meets b."""
        axis = axes[a] if self.points[a][1] > 0 else axes[b]
        along = x[b] - x[a]
        along = along - (along * axis).sum(axis=-1, keepdims=True) * axis
        distance = np.linalg.norm(along, axis=-1, keepdims=True)
        distance = np.where(distance > 0, distance, 1)
        u = along / distance
        v = np.cross(axis, u)
        reach = [radius * side for _, radius, side in (self.points[a], self.points[b])]
        same = [1.0, 1.0 if (axes[a] * axes[b]).sum() >= 0 or not self.points[b][1] else -1.0]
        signed = [reach[0] * same[0], reach[1] * same[1]]
        sine = np.clip((signed[0] - signed[1]) / distance, -1, 1)
        cosine = np.sqrt(1 - sine * sine)
        # Anticlockwise (+): the path is on the right of the centre, at -v for a belt of equal pulleys.
        normal = sine * u - cosine * v
        return x[a] + signed[0] * normal, x[b] + signed[1] * normal

    @staticmethod
    def _arc(start, end, centre, axis, side):
        """(rows, PIECES + 1, 3) from start to end about the axis, in the sense of the side."""
        a = start - centre
        height = (a * axis).sum(axis=-1, keepdims=True)
        a = a - height * axis
        c = np.cross(axis, a)
        b = end - centre
        angle = np.arctan2((b * c).sum(axis=-1), (b * a).sum(axis=-1))
        angle = np.mod(angle, 2 * np.pi) if side > 0 else -np.mod(-angle, 2 * np.pi)
        angle = np.where(np.abs(angle) > 2 * np.pi - 1e-6, 0, angle)
        phi = angle[:, None, None] * np.linspace(0, 1, PIECES + 1)[:, None]
        return centre[:, None] + (height * axis)[:, None] + np.cos(phi) * a[:, None] + np.sin(phi) * c[:, None]
