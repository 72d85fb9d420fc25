"""Parameters of rotations that follow each other, continued from row to row.

A rotation has many rotation vectors, (phi + 2 pi n) e, two sets of Euler or Bryant angles up to whole turns, and two
unit quaternions. These functions take rows of any of them and give those that continue the row before:

- Angles count turns. They are the one of the two sets that is nearer to the row before, also where the middle angle
  goes through its singularity. Within `LOCKED` of the singularity the first and last angle are not told apart: each
  takes half of what their sum (or difference) changes. Rows that begin there take the values of the first row that
  tells them.
- The rotation vector goes through half a turn and counts turns about an axis that moves by less than a right angle
  from row to row. Within `LOCKED` of full turns the axis is not determined: that of the row before is kept.

No rule can tell the number of turns between rows that are more than half a turn apart. Source: A. Cardona, An Integrated
Approach to Mechanism Analysis (thesis, Liege, 1989), ch. 1, on complements of rotation vectors; what is done at the
singularities of angles is this module's own.
"""

import numpy as np

LOCKED = 1e-8  # [rad] half of the digits: below it rounding of R moves the undetermined angles by as much


def continuous_quaternions(q, keep_first=False):
    """(rows, 4) w x y z of the sign that continues the row before. The first row stays, with w >= 0 unless keep_first.
    """
    q = np.asarray(q, float)
    if not len(q):
        return q.copy()
    signs = np.where(np.einsum("ij,ij->i", q[1:], q[:-1]) < 0, -1.0, 1.0)
    first = -1.0 if q[0, 0] < 0 and not keep_first else 1.0
    return q * np.cumprod(np.concatenate([[first], signs]))[:, None]


def continuous_vectors(psi, keep_first=False):
    """(rows, 3) rotation vectors [rad]. The first row is a principal one, or stays as it is with keep_first."""
    psi = np.asarray(psi, float)
    if not len(psi):
        return psi.copy()
    size = np.linalg.norm(psi, axis=1)
    turn = size - 2 * np.pi * np.round(size / (2 * np.pi))  # about the axis, in [-pi, pi]
    axis = psi / np.where(size > 0, size, 1)[:, None]
    principal = turn[:, None] * axis
    known = np.abs(turn) > LOCKED
    known[0] |= keep_first and size[0] > 0
    if not known.any():
        return principal
    rows = np.flatnonzero(known)
    signs = np.where(np.einsum("ij,ij->i", axis[rows[1:]], axis[rows[:-1]]) < 0, -1.0, 1.0)
    last = np.maximum(np.cumsum(known) - 1, 0)  # the known row that a row continues
    axis = (axis[rows] * np.cumprod(np.concatenate([[1.0], signs]))[:, None])[last]
    angle = np.einsum("ij,ij->i", principal, axis)
    if keep_first and known[0]:
        angle[0] = size[0]
    angle = np.unwrap(angle)
    result = angle[:, None] * axis
    exact = ~known & (np.abs(angle) < np.pi)
    result[exact] = principal[exact]
    return result


def continuous_euler(angles, keep_first=False):
    """(rows, 3) Euler angles z-x-z [rad], R = Rz(a) Rx(b) Rz(c). The first row stays, unless it is locked."""
    return _continuous_angles(angles, np.sin, np.cos, 0.0, keep_first)


def continuous_bryant(angles, keep_first=False):
    """(rows, 3) Bryant angles x-y-z [rad], R = Rx(a) Ry(b) Rz(c). The first row stays, unless it is locked."""
    return _continuous_angles(angles, np.cos, np.sin, np.pi, keep_first)


def _continuous_angles(angles, zero, sign, mirror, keep_first):
    """zero(b) = 0 is the singularity, where a + sign(b) c is determined; the complement is (a + pi, mirror - b, c +
    pi).
    """
    angles = np.asarray(angles, float)
    if not len(angles):
        return angles.copy()
    locked = np.abs(zero(angles[:, 1])) < LOCKED
    if keep_first:
        locked[0] = False
    side = np.where(locked, np.sign(sign(angles[:, 1])), 0.0)  # 0: all angles are determined
    runs = np.split(np.arange(len(angles)), np.flatnonzero(np.diff(side)) + 1)
    result = angles.copy()
    begin = 0 if side[0] == 0 or len(runs) == 1 else 1  # a run that begins locked comes last, backwards

    def go_on(rows, before):
        if side[rows[0]]:
            result[rows] = _within_lock(angles[rows], side[rows[0]], before)
        else:
            result[rows] = _nearer_ones(angles[rows], mirror, before)

    before = None
    for rows in runs[begin:]:
        go_on(rows, before)
        before = result[rows[-1]]
    if begin:
        go_on(runs[0][::-1], result[runs[1][0]])
    return result


def _nearer_ones(angles, mirror, before):
    """Returns the angles of each row or their complement, whichever is nearer to the row before, plus turns."""
    rows = angles if before is None else np.vstack([before, angles])
    other = np.column_stack([rows[:, 0] + np.pi, mirror - rows[:, 1], rows[:, 2] + np.pi])
    # The two sets of a row are as far from one set of the row before as, in exchange, from its other set. A change from
    # one set to the other is therefore seen without knowing which of the two the row before has.
    change = _distance(other[1:], rows[:-1]) < _distance(rows[1:], rows[:-1])
    taken = np.concatenate([[False], np.cumsum(change) % 2 == 1])
    rows = np.unwrap(np.where(taken[:, None], other, rows), axis=0)
    return rows if before is None else rows[1:]


def _within_lock(angles, side, before):
    """Rows of which a + side c alone is determined."""
    total = angles[:, 0] + side * angles[:, 2]
    if before is None:
        return np.column_stack([np.unwrap(total), np.unwrap(angles[:, 1]), np.zeros(len(angles))])
    start = before[0] + side * before[2]
    change = np.unwrap(np.concatenate([[start], total]))[1:] - start
    middle = np.unwrap(np.concatenate([[before[1]], angles[:, 1]]))[1:]
    return np.column_stack([before[0] + change / 2, middle, before[2] + side * change / 2])


def _distance(angles, others):
    difference = angles - others
    return ((difference - 2 * np.pi * np.round(difference / (2 * np.pi))) ** 2).sum(axis=1)
