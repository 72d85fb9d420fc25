"""Quaternions w x y z over rows, vectorised."""

import numpy as np

IDENTITY = np.array([1.0, 0.0, 0.0, 0.0])


def cross(a, b):
    """(...,3); several times as fast as numpy's for few vectors."""
    a, b = np.asarray(a), np.asarray(b)
    result = np.empty(np.broadcast(a, b).shape)
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        result[..., i] = a[..., j] * b[..., k] - a[..., k] * b[..., j]
    return result


def product(a, b):
    """(...,4) of R(a) R(b)."""
    a, b = np.asarray(a), np.asarray(b)
    result = np.empty(np.broadcast(a, b).shape)
    result[..., 0] = a[..., 0] * b[..., 0] - (a[..., 1:] * b[..., 1:]).sum(axis=-1)
    result[..., 1:] = a[..., :1] * b[..., 1:] + b[..., :1] * a[..., 1:] + cross(a[..., 1:], b[..., 1:])
    return result


def rotated(q, v):
    """(...,3) R(q) v."""
    q, v = np.asarray(q, float), np.asarray(v, float)
    if not v.any():
        return np.broadcast_to(v, np.broadcast_shapes(q.shape[:-1], v.shape[:-1]) + (3,)) + 0 * q[..., 1:]
    t = 2 * cross(q[..., 1:], v)
    return v + q[..., :1] * t + cross(q[..., 1:], t)


def conjugate(q):
    return np.asarray(q) * np.array([1.0, -1.0, -1.0, -1.0])


def from_z(directions):
    """(...,4) smallest rotations that take z to the directions (...,3), which need not be unit vectors; zero vectors give the identity."""
    d = np.asarray(directions, float)
    length = np.linalg.norm(d, axis=-1, keepdims=True)
    d = np.where(length > 0, d / np.where(length > 0, length, 1), np.array([0.0, 0.0, 1.0]))
    q = np.stack([1 + d[..., 2], -d[..., 1], d[..., 0], np.zeros(d.shape[:-1])], axis=-1)
    opposite = d[..., 2] < -1 + 1e-12
    q[opposite] = [0.0, 1.0, 0.0, 0.0]
    return q / np.linalg.norm(q, axis=-1, keepdims=True)


def from_axes(x, y, z):
    """(...,4) rotation whose columns are the orthonormal axes (...,3)."""
    m = np.stack([x, y, z], axis=-1)
    trace = [np.ones(m.shape[:-2]) + s[0] * m[..., 0, 0] + s[1] * m[..., 1, 1] + s[2] * m[..., 2, 2]
             for s in ((1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1))]
    a, b, c = m[..., 2, 1] - m[..., 1, 2], m[..., 0, 2] - m[..., 2, 0], m[..., 1, 0] - m[..., 0, 1]
    d, e, f = m[..., 0, 1] + m[..., 1, 0], m[..., 0, 2] + m[..., 2, 0], m[..., 1, 2] + m[..., 2, 1]
    choices = np.stack([np.stack(row, axis=-1) for row in ((trace[0], a, b, c), (a, trace[1], d, e), (b, d, trace[2], f),
                                                          (c, e, f, trace[3]))], axis=-2)
    best = np.argmax(np.nan_to_num(np.stack(trace, axis=-1)), axis=-1)
    q = np.take_along_axis(choices, best[..., None, None], axis=-2)[..., 0, :]
    return q / np.linalg.norm(q, axis=-1, keepdims=True)
