"""Motion of the bones of a scene as tracks: one per different motion, quantised to 16 bits.

Positions and stretches have a scale for each track and component, so that their error is 1/131068 of the range of that component;
components of quaternions have the error 1/65534. A row without numbers is marked.
"""

import numpy as np

from .pack import quantised

MISSING = -32768  # in place of w: the bone has no pose in this row


class Tracks:
    """Collects poses in units of the scene: `add` returns the numbers of tracks, equal motions share one."""

    def __init__(self, rows):
        self.rows, self._numbers, self._poses = rows, {}, []
        self.rests = []  # [number of a track that is magnified, number of that at rest]

    def add(self, poses, rest=None):
        """poses (rows, bones, 8), single precision is sufficient; rest: the same without deformation, for magnified ones.
        @returns the numbers of their tracks"""
        poses = np.ascontiguousarray(np.moveaxis(poses.astype(np.float32), 0, 1))
        numbers = []
        at_rest = [None] * len(poses) if rest is None else self.add(rest)
        for pose, other in zip(poses, at_rest):
            key = pose.tobytes(), other
            if key not in self._numbers:
                self._numbers[key] = len(self._poses)
                if other is not None:
                    self.rests.append([len(self._poses), other])
                self._poses.append(pose)
            numbers.append(self._numbers[key])
        return numbers

    def stored(self, pack):
        """Stores the tracks. @returns (description for the page, largest error of positions, largest error of rotations [rad])"""
        count = len(self._poses)
        if not count or not self.rows:
            return {"count": count, "rows": self.rows}, 0.0, 0.0
        poses = np.stack(self._poses).astype(float)  # (tracks, rows, 8)
        known = np.isfinite(poses).all(axis=2)
        poses = _continued(poses, known)
        poses[..., 3:7] = _same_sense(poses[..., 3:7])
        lengths = poses[..., [0, 1, 2, 7]]
        whole, low, step = quantised(lengths, (1,))
        turns = np.clip(np.round(32767 * poses[..., 3:7]), -32767, 32767).astype(np.int16)
        back = turns / 32767.0
        back /= np.linalg.norm(back, axis=-1, keepdims=True)
        positions = low + step * (whole.astype(int) + 32767)
        exact = poses[..., 3:7] / np.linalg.norm(poses[..., 3:7], axis=-1, keepdims=True)
        errors = np.linalg.norm((positions - lengths)[..., :3], axis=-1).max(), 2 * np.linalg.norm(back - exact, axis=-1).max()
        turns[..., 0][~known] = MISSING
        data = np.concatenate([whole, turns], axis=2).transpose(0, 2, 1)  # (tracks, 8, rows): x y z stretch, w x y z
        return {"count": count, "rows": self.rows, "data": pack.add(data, "i2", True), "low": pack.add(low[:, 0], "f4"),
                "step": pack.add(step[:, 0], "f4")}, float(errors[0]), float(errors[1])


def _continued(poses, known):
    """Poses with the last known row, or the first, in place of those without numbers."""
    rows = np.where(known, np.arange(poses.shape[1]), -1)
    last = np.maximum.accumulate(rows, axis=1)
    first = np.where(known.any(axis=1), known.argmax(axis=1), 0)
    last = np.where(last < 0, first[:, None], last)
    found = np.take_along_axis(poses, last[..., None], axis=1)
    return np.where(np.isfinite(found).all(axis=2, keepdims=True), found, np.array([0, 0, 0, 1.0, 0, 0, 0, 1]))


def _same_sense(q):
    """Quaternions of the sign that continues the row before."""
    sense = np.where((q[:, 1:] * q[:, :-1]).sum(axis=-1) < 0, -1.0, 1.0)
    return q * np.concatenate([np.ones((len(q), 1)), np.cumprod(sense, axis=1)], axis=1)[..., None]


def in_units(poses, centre, size):
    """Poses with positions relative to the centre in units of the size; points of meshes are in units of the size as well."""
    scaled = np.array(poses, float)
    scaled[..., :3] = (scaled[..., :3] - centre) / size
    return scaled

