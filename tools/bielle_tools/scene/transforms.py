"""Poses of bones over rows: position, rotation (w x y z) and stretch along z."""

import numpy as np

from ..results.quaternions import from_z, rotated


def pose(x, q, stretch=1.0):
    """(...,8) of positions (...,3), rotations (...,4) and stretches (...)."""
    shape = np.broadcast_shapes(np.shape(x)[:-1], np.shape(q)[:-1], np.shape(stretch))
    return np.concatenate([np.broadcast_to(x, (*shape, 3)), np.broadcast_to(q, (*shape, 4)),
                           np.broadcast_to(stretch, shape)[..., None]], axis=-1)


def between(a, b):
    """(...,8) poses of unit-length templates along z from points a to points b (...,3)."""
    d = b - a
    return pose(a, from_z(d), np.linalg.norm(d, axis=-1))


def placed(poses, points):
    """Inertial points (...,3) of points in the axes of bones with poses (...,8)."""
    return poses[..., :3] + rotated(poses[..., 3:7], points * np.concatenate(
        [np.ones(poses.shape[:-1] + (2,)), poses[..., 7:]], axis=-1))
