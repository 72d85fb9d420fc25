"""Rotations as quaternions record them: matrices, and the quantities of nodes that are made of them.

`bielle.rotations` of the Python package has all of this, and rates; the tools work without it.
"""

import numpy as np

from .continuous_rotations import continuous_bryant, continuous_euler, continuous_vectors

# Quantities of nodes, made of their `rotation` and continuous over turns, with the attributes of a dataset.
ROTATION_QUANTITIES = {
    "rotation_vector": {"units": "rad",
                        "description": "axis times angle of R (node -> inertial axes), over turns: x, y, z"},
    "bryant": {"units": "rad", "description": "R = Rx(a) Ry(b) Rz(c) (node -> inertial axes), over turns: a, b, c"},
    "euler": {"units": "rad", "description": "R = Rz(a) Rx(b) Rz(c) (node -> inertial axes), over turns: a, b, c"},
}
SMALLEST_SINE = 4e-16  # sine of the middle angle below which nothing but rounding tells the first angle from the last


def made_of(place):
    """Which quantity is made of which dataset: ("bryant", "nodes/pin/rotation") of `nodes/pin/bryant`; ("", place) of
    others.
    """
    words = place.strip("/").split("/")
    if words[0] != "nodes" or len(words) < 3 or words[-1] not in ROTATION_QUANTITIES:
        return "", place
    return words[-1], "/".join([*words[:-1], "rotation"])


def rotation_matrices(quaternions):
    """(...,4) unit quaternions w x y z -> (...,3,3) matrices R: body -> inertial."""
    w, x, y, z = np.moveaxis(np.asarray(quaternions, float), -1, 0)
    return np.stack([1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),
                     2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
                     2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)], axis=-1).reshape(*w.shape, 3, 3)


def rotation_quantity(name, quaternions):
    """(nt, 3) [rad] one of ROTATION_QUANTITIES of rows (nt, 4) of unit quaternions. Rows that are no numbers stay so."""
    q = np.asarray(quaternions, float)
    known = np.isfinite(q).all(axis=1) & (np.linalg.norm(q, axis=1) > 0)
    result = np.full((len(q), 3), np.nan)
    q = q[known] / np.linalg.norm(q[known], axis=1)[:, None]
    if name == "rotation_vector":
        result[known] = continuous_vectors(rotation_vectors(q))
    elif name == "bryant":
        result[known] = continuous_bryant(bryant_angles(rotation_matrices(q)))
    else:
        result[known] = continuous_euler(euler_angles(rotation_matrices(q)))
    return result


def rotation_vectors(quaternions):
    """(n, 4) unit quaternions -> (n, 3) of up to half a turn [rad]."""
    q = np.where(quaternions[:, :1] < 0, -quaternions, quaternions)
    sine = np.linalg.norm(q[:, 1:], axis=1)
    small = sine < 1e-8  # 2 asin(s)/s = 2 + s^2/3: exact to rounding
    factor = np.where(small, 2.0, 2 * np.arctan2(sine, q[:, 0]) / np.where(small, 1.0, sine))
    return factor[:, None] * q[:, 1:]


def bryant_angles(R):
    """(n, 3, 3) -> (n, 3) a, b, c [rad], b in [-pi/2, pi/2]; c = 0 where cos b = 0."""
    cosine = np.hypot(R[:, 1, 2], R[:, 2, 2])
    locked = cosine < SMALLEST_SINE
    a = np.where(locked, np.arctan2(R[:, 2, 1], R[:, 1, 1]), np.arctan2(-R[:, 1, 2], R[:, 2, 2]))
    sine_a, cosine_a = np.sin(a), np.cos(a)
    c = np.arctan2(cosine_a * R[:, 1, 0] + sine_a * R[:, 2, 0], cosine_a * R[:, 1, 1] + sine_a * R[:, 2, 1])
    return np.column_stack([a, np.arctan2(R[:, 0, 2], cosine), np.where(locked, 0.0, c)])


def euler_angles(R):
    """(n, 3, 3) -> (n, 3) a, b, c [rad], b in [0, pi]; c = 0 where sin b = 0."""
    sine = np.hypot(R[:, 0, 2], R[:, 1, 2])
    locked = sine < SMALLEST_SINE
    a = np.where(locked, np.arctan2(R[:, 1, 0], R[:, 0, 0]), np.arctan2(R[:, 0, 2], -R[:, 1, 2]))
    sine_a, cosine_a = np.sin(a), np.cos(a)
    c = np.arctan2(-(cosine_a * R[:, 0, 1] + sine_a * R[:, 1, 1]), cosine_a * R[:, 0, 0] + sine_a * R[:, 1, 0])
    return np.column_stack([a, np.arctan2(sine, R[:, 2, 2]), np.where(locked, 0.0, c)])
