"""Parts between two places: bars, springs, dampers, jacks, ropes. Their templates have length 1 along z and are stretched."""

import numpy as np

from ..results.quaternions import from_z
from . import templates as t
from .parts import joined, with_bone
from .transforms import between, pose

TURNS = 8


def bar_mesh(radius):
    return t.moved(t.cylinder(radius, 1, around=12), (0, 0, 0.5))


def rope_mesh(radius):
    return t.moved(t.cylinder(radius, 1, around=8), (0, 0, 0.5))


def coil_mesh(radius, wire, length):
    """A helix of 8 turns with straight ends. length: at which the wire is round [m]"""
    turns = np.linspace(0, TURNS, 16 * TURNS + 1)
    centre = np.column_stack([radius * np.cos(2 * np.pi * turns), radius * np.sin(2 * np.pi * turns), 0.12 + 0.76 * turns / TURNS])
    ring, rings = t.circle(7), []
    for angle, point in zip(2 * np.pi * turns, centre):
        outward = np.array([np.cos(angle), np.sin(angle), 0])
        rings.append(point + wire * (ring[:, :1] * outward + ring[:, 1:] * np.array([0, 0, 1 / length])))
    ends = [t.moved(t.cylinder(wire, 0.12, around=8), (0, 0, z)) for z in (0.06, 0.94)]
    plates = [t.moved(t.cylinder(1.1 * radius, 0.5 * wire / length, around=20), (0, 0, z)) for z in (0.12, 0.88)]
    return t.merged([t.strip(np.stack(rings)), *ends, *plates])


def telescope(radius, barrel):
    """Two bones: a barrel of fixed length [m] at the first end, a rod from its middle to the second end."""
    tube = t.moved(t.merged([t.tube(radius, 0.5 * radius, barrel), t.cylinder(0.9 * radius, 0.98 * barrel)]), (0, 0, barrel / 2))
    eyes = t.sphere(0.75 * radius)
    return joined(with_bone(t.merged([tube, eyes]), 0), with_bone(bar_mesh(0.45 * radius), 1), with_bone(t.sphere(0.7 * radius), 2))


class Ends:
    """The motion of two places."""

    def __init__(self, motion, places):
        self.motion, self.places = motion, places

    def points(self, rows):
        return [self.motion.position(place, rows) for place in self.places]

    def lengths(self):
        """Shortest and longest distance over all rows; nan if there is none."""
        a, b = self.points(np.arange(len(self.motion.results.time)))
        length = np.linalg.norm(b - a, axis=1)
        length = length[np.isfinite(length)]
        return (length.min(), length.max()) if len(length) else (np.nan, np.nan)

    def straight(self, rows):
        return between(*self.points(rows))[:, None]

    def telescopic(self, barrel):
        def poses(rows):
            a, b = self.points(rows)
            d = b - a
            length = np.linalg.norm(d, axis=1)
            q = from_z(d)
            unit = d / np.where(length > 0, length, 1)[:, None]
            inside = np.minimum(0.5 * barrel, 0.5 * length)
            return np.stack([pose(a, q), pose(a + inside[:, None] * unit, q, length - inside), pose(b, q)], axis=1)
        return poses
