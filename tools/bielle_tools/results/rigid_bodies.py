"""Shapes for rigid bodies: for each the ellipsoid of uniform density that has its mass, centre and inertia.

The results contain no shapes. An ellipsoid with semi-axes a, b, c has J_x = m (b^2 + c^2) / 5, ..., so that a^2 = 5
(J_y + J_z - J_x) / (2 m): about the size of the body, slightly larger if it is a box or a cylinder.
"""

import numpy as np

from .results_file import LARGEST, reading
from .rotations import rotation_matrices


class RigidBody:
    """An ellipsoid fixed to a node: points (p,3) in the node's axes [m], triangles (f,3), outward."""

    def __init__(self, name, node, mass, centre, inertia):
        """centre (3) of mass in the node's axes [m]; inertia (3,3) about it, in the node's axes [kg m^2]"""
        self.name, self.node, self.centre = name, node, centre
        moments, axes = np.linalg.eigh(inertia)
        squares = 2.5 / mass * (moments.sum() - 2 * moments)
        sphere, self.triangles = _sphere()
        self.points = centre + sphere * np.sqrt(np.maximum(squares, 0)) @ axes.T
        self.extended = moments.max() > 0  # a point mass has no size

    def place(self, results, row):
        """Points (p,3) and centre (3) at a row of the results, inertial."""
        x = results.rows(f"nodes/{self.node}/position", row)
        R = rotation_matrices(results.rows(f"nodes/{self.node}/rotation", row))
        return x + self.points @ R.T, x + R @ self.centre


def rigid_bodies(results):
    """The rigid bodies and point masses whose node and mass the results contain."""
    found = []
    for name in results.names("elements"):
        place = f"elements/{name}"
        node = results.text(place, "node")
        if not results.text(place, "mass") or not results.has(f"nodes/{node}"):
            continue
        xx, yy, zz, xy, xz, yz = _numbers(results, place, "inertia", 6)
        inertia = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        mass, = _numbers(results, place, "mass", 1)
        if mass > 0:
            found.append(RigidBody(name, node, mass, _numbers(results, place, "centre", 3), inertia))
    return found


def _numbers(results, place, attribute, count):
    words = results.text(place, attribute).split()
    if len(words) != count:
        return np.zeros(count)
    with reading(results.path, f"{place}: {attribute}"):
        numbers = np.array([float(word) for word in words])
        if not np.all(np.abs(numbers) < LARGEST):
            raise ValueError
    return numbers


def _sphere(around=16, along=8):
    """Unit sphere: points and outward triangles."""
    polar, azimuth = np.pi * np.arange(1, along) / along, 2 * np.pi * np.arange(around) / around
    ring = np.column_stack([np.cos(azimuth), np.sin(azimuth)])
    points = [[0, 0, 1]] + [[np.sin(p) * x, np.sin(p) * y, np.cos(p)] for p in polar for x, y in ring] + [[0, 0, -1]]
    last = len(points) - 1
    triangles = []
    for k in range(around):
        following = (k + 1) % around
        triangles.append([0, 1 + k, 1 + following])
        triangles.append([last, last - around + following, last - around + k])
        for line in range(along - 2):
            upper, lower = 1 + line * around, 1 + (line + 1) * around
            triangles += [[upper + k, lower + k, lower + following], [upper + k, lower + following, upper + following]]
    return np.array(points, float), np.array(triangles)
