"""The deformation of beams, which pictures magnify.

The stations of the undeformed beam follow from those of the row in which the beam is strained least: the relative
motion of the ends of an element is exp(h (1 + Gamma_x, Gamma_y, Gamma_z, Kappa)) with its length h, and the recorded
strain is taken off. A run that starts undeformed has no error; otherwise the strain in the middle of an element stands
for its mean, which is off by about the square of the element's share of the beam. At each row the undeformed beam is
put where a rigid motion brings it nearest to all stations: least squares of places, and of axes with the beam's radius
of gyration as arm. A magnified station is

    x = x_0 + factor (x_1 - x_0),   R = R_0 exp(factor log(R_0^T R_1)),

with the undeformed pose (x_0, R_0) and the recorded one (x_1, R_1). (K. S. Arun et al., IEEE PAMI 9 (1987) 698, for the
fit.)
"""

import numpy as np

from ..results.quaternions import conjugate, cross, from_axes, product, rotated
from ..results.rotations import rotation_matrices
from .transforms import pose

SMALL = 1e-4  # [rad] below which series replace quotients


def undeformed_motion(x, q, strain):
    """rows -> (rows,n,8) poses of the undeformed beam. x (nt,n,3), q (nt,n,4): of its sections; strain (nt,n-1,6). None
    if no row is known."""
    size = np.abs(strain).max(axis=(1, 2), initial=0)
    known = np.isfinite(x).all(axis=(1, 2)) & np.isfinite(q).all(axis=(1, 2)) & np.isfinite(size)
    if not known.any():
        return None
    row = int(np.argmin(np.where(known, size, np.inf)))
    U, Q = _stations(x[row], q[row], strain[row])
    return lambda rows: _placed(x[rows], q[rows], U, Q)


def magnified(poses, rest, factor):
    """(...,8) poses (...,8) with their difference from those at rest times a factor."""
    q, v = rest[..., 3:7], logarithm(product(conjugate(rest[..., 3:7]), poses[..., 3:7]))
    return pose(rest[..., :3] + factor * (poses[..., :3] - rest[..., :3]), product(q, exponential(factor * v)), poses[..., 7])


def logarithm(q):
    """(...,3) rotation vectors up to half a turn of quaternions (...,4)."""
    q = np.where(q[..., :1] < 0, -q, q)
    size = np.linalg.norm(q[..., 1:], axis=-1, keepdims=True)
    return np.where(size > 1e-12, 2 * np.arctan2(size, q[..., :1]) / np.where(size > 1e-12, size, 1), 2.0) * q[..., 1:]


def exponential(v):
    """(...,4) quaternions of rotation vectors (...,3)."""
    half = np.linalg.norm(v, axis=-1, keepdims=True) / 2
    return np.concatenate([np.cos(half), v * np.sinc(half / np.pi) / 2], axis=-1)


def _stations(x, q, strain):
    """Places (n,3) and rotations (n,4) of the undeformed beam, the first at the origin."""
    turn = logarithm(product(conjugate(q[:-1]), q[1:]))
    along = _solved(turn, rotated(conjugate(q[:-1]), np.diff(x, axis=0)))
    h = along[:, :1] / (1 + strain[:, :1])
    along, turn = along - h * strain[:, :3], turn - h * strain[:, 3:]
    U, Q = np.zeros((len(q), 3)), np.tile([1.0, 0, 0, 0], (len(q), 1))
    for k, (d, r) in enumerate(zip(_integrated(turn, along), exponential(turn))):
        U[k + 1], Q[k + 1] = U[k] + rotated(Q[k], d), product(Q[k], r)
    return U, Q


def _factors(v):
    """(1 - cos a)/a^2 and (a - sin a)/a^3 for rotation vectors of the length a."""
    a = np.linalg.norm(v, axis=-1, keepdims=True)
    safe = np.where(a > SMALL, a, 1)
    return (np.where(a > SMALL, (1 - np.cos(a)) / safe ** 2, 0.5 - a ** 2 / 24),
            np.where(a > SMALL, (a - np.sin(a)) / safe ** 3, 1 / 6 - a ** 2 / 120))


def _integrated(v, d):
    """Displacement of exp(d, v): T(v) d."""
    b, c = _factors(v)
    once = cross(v, d)
    return d + b * once + c * cross(v, once)


def _solved(v, d):
    """T(v)^-1 d: T^-1 = 1 - [v]/2 + (1 - (1 - a^2 c)/(2 b))/a^2 [v]^2."""
    b, c = _factors(v)
    square = (v * v).sum(axis=-1, keepdims=True)
    factor = np.where(square > SMALL ** 2, (1 - (1 - square * c) / (2 * b)) / np.where(square > SMALL ** 2, square, 1), 1 / 12)
    once = cross(v, d)
    return d - 0.5 * once + factor * cross(v, once)


def _placed(x, q, U, Q):
    """(rows,n,8) poses of the undeformed beam after the rigid motion that brings it nearest to its stations."""
    local, centre = U - U.mean(axis=0), x.mean(axis=1, keepdims=True)
    arm = (local * local).sum(axis=1).mean()
    finite = np.isfinite(x).all(axis=(1, 2)) & np.isfinite(q).all(axis=(1, 2))
    M = np.einsum("tni,nj->tij", np.where(finite[:, None, None], x - centre, 0), local)
    M = M + arm * np.einsum("tnij,nkj->tik", rotation_matrices(np.where(finite[:, None, None], q, [1.0, 0, 0, 0])), rotation_matrices(Q))
    left, _, right = np.linalg.svd(M)
    left[:, :, 2] *= np.sign(np.linalg.det(left) * np.linalg.det(right))[:, None]
    R = left @ right
    turn = from_axes(R[:, :, 0], R[:, :, 1], R[:, :, 2])[:, None]
    found = pose(centre + rotated(turn, local[None]), product(turn, Q[None]))
    found[~finite] = np.nan
    return found
