"""Coordinate systems and motions of nodes in Abaqus and CalculiX input files.

A motion is a pair (R, t): the point x goes to R x + t.
"""

import numpy as np

from ..messages import InputError, counted
from .abaqus_lines import numbers

IN_LINE = 1e-12  # sine of the angle below which directions are parallel


def system(keyword):
    """Origin a and axes of *SYSTEM: b on the first axis, c in the plane of the first two; None if it ends a system.
    (Abaqus Keywords Guide, "*SYSTEM".)"""
    values = [value for row in keyword.table(lambda words: numbers(words, len(words))[:len(words) - (not words[-1])]) for value in row]
    if not values:
        return None
    if len(values) > 9:
        raise InputError(f"{keyword.where}: *SYSTEM: expected three points at most, found {counted(len(values), 'number')}")
    values += [0.0] * (-len(values) % 3)
    points = np.array(values).reshape(-1, 3)
    if len(points) == 1:
        return points[0], np.eye(3)
    x = points[1] - points[0]
    if len(points) == 2:
        if x[2] != 0:
            raise InputError(f"{keyword.where}: *SYSTEM: without a third point the first axis must stand in the plane of x and y")
        z = np.array([0.0, 0.0, 1.0])
    else:
        z = np.cross(x, points[2] - points[0])
    axes = axes_of(x, z, np.linalg.norm(points[-1] - points[0]))
    if axes is None:
        raise InputError(f"{keyword.where}: *SYSTEM: the points stand in one line")
    return points[0], axes


def axes_of(x, z, length):
    """Axes (columns) along x and along z, which is normal to x; None if the points that define them stand in one line. @param
    length: distance of the point that defines the plane of x and y"""
    size = np.linalg.norm(x)
    if size == 0 or np.linalg.norm(z) <= IN_LINE * size * max(length, 1e-300):
        return None
    x, z = x / size, z / np.linalg.norm(z)
    return np.column_stack([x, np.cross(z, x), z])


def kind_of_coordinates(keyword, cartesian="R"):
    """Tells whether the option SYSTEM is C, cylindrical. @raises InputError for others than this and `cartesian`"""
    kind = keyword.options.get("SYSTEM", cartesian).upper()
    if kind not in (cartesian, "C"):
        told = ("spherical coordinates are not read; write Cartesian or cylindrical ones" if kind == "S" else
                f"expected SYSTEM={cartesian} or C, found {kind}")
        raise InputError(f"{keyword.where}: *{keyword.name}: {told}")
    return kind == "C"


def of_cylinder(x):
    """Cartesian coordinates of radius, angle [degree] and height."""
    angle = np.radians(x[1])
    return [x[0] * np.cos(angle), x[0] * np.sin(angle), x[2]]


def motion(keyword):
    """The motion of one line with a translation and one with a rotation, which follows it: points a and b of the axis, and the
    angle [degree]. (Abaqus Keywords Guide, "*INSTANCE", "*NCOPY".)"""
    rows = keyword.table(lambda words: words)
    if len(rows) > 2:
        path, line = keyword.places[2]
        raise InputError(f"{path}:{line}: *{keyword.name}: expected a line with a translation and one with a rotation, found {len(rows)} lines")
    lines = iter((3, 7))
    values = keyword.table(lambda words: numbers(words, next(lines)))
    shift = np.array(values[0]) if values else np.zeros(3)
    if len(values) < 2 or values[1][6] == 0:
        return np.eye(3), shift
    a, b = np.array(values[1][:3]), np.array(values[1][3:6])
    if not np.any(b - a):
        path, line = keyword.places[1]
        raise InputError(f"{path}:{line}: *{keyword.name}: the two points of the axis of rotation are the same")
    turn = rotation(b - a, np.radians(values[1][6]))
    return turn, turn @ (shift - a) + a


def rotation(axis, angle):
    """Rodrigues' rotation about a direction; angle [rad]."""
    x, y, z = axis / np.linalg.norm(axis)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


def reflection(keyword):
    """The motion of *NCOPY, REFLECT: through a line or a plane or a point."""
    kind = keyword.options["REFLECT"].upper()
    given = {"LINE": 6, "MIRROR": 9, "POINT": 3}
    if kind not in given:
        raise InputError(f"{keyword.where}: *NCOPY: expected REFLECT=LINE, MIRROR or POINT, found {kind or 'nothing'}")
    values = [value for row in keyword.table(lambda words: numbers(words, len(words))[:len(words) - (not words[-1])]) for value in row]
    if len(values) != given[kind]:
        raise InputError(f"{keyword.where}: *NCOPY, REFLECT={kind}: expected {given[kind]} coordinates, found {len(values)}")
    points = np.array(values).reshape(-1, 3)
    if kind == "POINT":
        return -np.eye(3), 2 * points[0]
    along = points[1] - points[0]
    n = along if kind == "LINE" else np.cross(along, points[2] - points[0])
    if np.linalg.norm(n) <= IN_LINE * max(np.ptp(points, axis=0).max(), 1e-300) ** (1 if kind == "LINE" else 2):
        raise InputError(f"{keyword.where}: *NCOPY, REFLECT={kind}: the points stand in one line or coincide")
    n = n / np.linalg.norm(n)
    turn = 2 * np.outer(n, n) - np.eye(3) if kind == "LINE" else np.eye(3) - 2 * np.outer(n, n)
    return turn, points[0] - turn @ points[0]
