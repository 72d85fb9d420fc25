"""Symbols of joints by type: the part on the first node and the part on the second, with axis z, for a symbol size of 1.

n: number of corners around an axis.
"""

import functools

from . import templates as t
from .parts import Mesh


def _hinge(n):
    return t.tube(1, 0.6, 1.2, n), t.cylinder(0.58, 2.2, n)


def _spherical(n):
    return t.tube(1.12, 0.8, 0.7, n), t.sphere(0.95, n // 2 - 1, n)


def _prismatic(n):
    sleeve = t.merged([t.moved(t.box([1.8, 0.35, 2.0]), (0, side * 0.725, 0)) for side in (1, -1)]
                      + [t.moved(t.box([0.35, 1.1, 2.0]), (side * 0.725, 0, 0)) for side in (1, -1)])
    return sleeve, t.box([1.0, 1.0, 4.4])


def _cylindrical(n):
    return t.tube(1, 0.6, 1.8, n), t.cylinder(0.56, 4.4, n)


def _universal(n):
    pins = t.moved(t.cylinder(0.35, 2.6, n), axes=t.ALONG_X), t.moved(t.cylinder(0.35, 2.6, n), axes=t.ALONG_Y)
    return t.merged([pins[0], t.moved(t.box([0.3, 0.9, 0.9]), (1.3, 0, 0)), t.moved(t.box([0.3, 0.9, 0.9]), (-1.3, 0, 0))]), \
        t.merged([pins[1], t.moved(t.box([0.9, 0.3, 0.9]), (0, 1.3, 0)), t.moved(t.box([0.9, 0.3, 0.9]), (0, -1.3, 0)), t.sphere(0.55, n // 2 - 1, n)])


def _constant_velocity(n):
    return t.merged([t.tube(1.2, 0.85, 1.1, n), t.tube(1.2, 0.3, 0.1, n)]), t.merged([t.sphere(0.8, n // 2 - 1, n), t.cylinder(0.35, 2.4, n)])


def _planar(n):
    return t.moved(t.cylinder(2.4, 0.15, n + n // 2), (0, 0, -0.1)), t.moved(t.cylinder(1.0, 0.3, n), (0, 0, 0.15))


def _line(n):
    return t.cylinder(0.2, 5.0, n), t.sphere(0.7, n // 2 - 1, n)


def _rigid(n):
    return t.box([1.3, 1.3, 0.5]), t.box([0.8, 0.8, 1.3])


def _screw(n):
    profile = [(0, -2.2)] + [(0.62 if k % 2 else 0.42, -2.2 + 0.2 * k) for k in range(23)] + [(0, 2.2)]
    return t.lathe(profile, around=18), t.lathe([(0.6, -0.5), (1.1, -0.5), (1.1, 0.5), (0.6, 0.5)], around=6)


def _bearing(n):
    return t.tube(1.25, 0.95, 0.8, n), t.merged([t.cylinder(0.6, 1.6, n)] + [
        t.moved(t.sphere(0.17, 6, 10), (0.78 * x, 0.78 * y, 0)) for x, y in t.circle(8)])


def _bushing(n):
    return t.tube(1.2, 1.0, 1.4, n), t.merged([t.tube(1.0, 0.5, 1.2, n), t.cylinder(0.5, 2.0, n)])


def _other(n):
    return None, t.octahedron(0.8)


SYMBOLS = {"hinge": _hinge, "clearance_hinge": _hinge, "spherical": _spherical, "clearance_spherical": _spherical, "prismatic": _prismatic,
           "cylindrical": _cylindrical, "slider": _cylindrical, "universal": _universal, "constant_velocity": _constant_velocity,
           "planar": _planar, "point_on_plane": _planar, "point_on_line": _line, "rigid": _rigid, "screw": _screw, "bearing": _bearing,
           "ball_bearing": _bearing, "roller_bearing": _bearing, "journal_bearing": _bearing, "bushing": _bushing}


@functools.lru_cache(maxsize=64)
def joint_symbol(kind, size, around=24):
    """Meshes on the first and on the second frame of a joint; None for a side without one. around: number of corners around an axis"""
    return [None if shape is None else Mesh(size * shape.points, shape.triangles, shape.lines, shape.bones)
            for shape in SYMBOLS.get(kind, _other)(around)]


def support_symbol(size, complete):
    """A support below the origin: a pyramid on a hatched foot; without the foot if directions are free."""
    foot = t.moved(t.box([2.6, 2.6, 0.25]), (0, 0, -1.7))
    return scaled(t.merged([t.moved(t.cone((1.0, 0.08), 1.6, around=4), (0, 0, -0.8)), *([foot] if complete else [])]), size)


def held_rotations_symbol(size, rotations):
    """A ring about each axis whose rotation is held, with a bar across it. rotations: of "rx", "ry", "rz" """
    ring = t.merged([t.tube(1.9, 1.65, 0.3), t.box([3.5, 0.25, 0.25])])
    axes = {"rx": t.ALONG_X, "ry": t.ALONG_Y, "rz": None}
    return scaled(t.merged([t.moved(ring, axes=axes[each]) for each in rotations]), size)


def scaled(shape, size):
    return Mesh(size * shape.points, shape.triangles, shape.lines, shape.bones)
