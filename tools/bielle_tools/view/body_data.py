"""Shapes of a flexible body as the page stores them, with their errors, and the largest stresses of its instances."""

import numpy as np

from ..bodies.stress_invariants import distortion
from .pack import quantised

ROWS, NUMBERS = 32, 1 << 19  # rows, and numbers, of a block of stresses, which stays in the processor's cache
JUDGED = 8         # rows at which errors are measured


class BodyData:
    """Computed once for all instances of a body. size: length that is 1 in the page [m]."""

    def __init__(self, body, size):
        self.body = body
        self.shapes = _whole(body.shapes / size)
        self.stress = None if body.stress is None else _whole(body.stress)
        self._errors = {"shape": _errors(body.shapes / size, *self.shapes)}
        if body.stress is not None:
            self._errors["stress"] = _errors(body.stress, *self.stress)
            self._unit = float(np.abs(body.stress).max(initial=0)) or 1.0  # [Pa]: squares of numbers about 1 stay within 32 bits
            self._distortion = np.moveaxis(distortion(body.stress / self._unit), 2, 1).astype(np.float32, order="C")  # (n,5,p)

    def describe(self, pack):
        """Adds the shapes to a pack. @returns their places for the page"""
        found = {"shapes": pack.add(self.shapes[0], "i2"), "scale": pack.add(self.shapes[1], "f4")}
        if self.stress:
            found.update(stress=pack.add(self.stress[0], "i2"), stress_scale=pack.add(self.stress[1], "f4"), stressed=pack.add(self.body.stressed, "u1"))
        return found

    def errors(self, q):
        """Largest errors of deformation [sizes] and stress [Pa] by stored shapes, and the largest stress component [Pa], at some rows of the
        coordinates q (rows,n)."""
        picked = q[np.unique(np.linspace(0, len(q) - 1, JUDGED).astype(int))] if len(q) else q
        largest = {name: _largest(picked, errors) for name, errors in self._errors.items()}
        return largest if self.stress is None else {**largest, "of stress": _largest(picked, self.body.stress)}

    def peaks(self, q, pack):
        """Largest von Mises stress of each point over the coordinates q (rows,n) [Pa], and of all points."""
        if self.stress is None:
            return {}
        unit = float(np.abs(q).max(initial=0)) or 1.0
        peak = unit * self._unit * np.sqrt(self._largest_squares((q / unit).astype(np.float32)).astype(float))
        whole, low, step = quantised(peak, (0,))
        return {"peak": {"data": pack.add(whole, "i2"), "low": float(low[0]), "step": float(step[0])}, "largest": float(peak.max(initial=0))}

    def _largest_squares(self, q):
        n, parts, count = self._distortion.shape
        found = np.zeros(count, np.float32)
        points = max(1, NUMBERS // (ROWS * parts))
        for first in range(0, count, points):
            shapes = np.ascontiguousarray(self._distortion[:, :, first:first + points]).reshape(n, -1)
            for row in range(0, len(q), ROWS):
                y = (q[row:row + ROWS] @ shapes).reshape(-1, parts, shapes.shape[1] // parts)
                np.square(y, out=y)
                np.maximum(found[first:first + points], y.sum(axis=1).max(axis=0), out=found[first:first + points])
        return found


def _whole(shapes):
    """(16-bit integers, factors): shape k is factor k times its integers."""
    scale = np.abs(shapes).reshape(len(shapes), -1).max(axis=1, initial=0).astype(np.float32) / np.float32(32767)
    whole = np.round(shapes / np.where(scale > 0, scale, 1)[:, None, None])
    return np.clip(whole, -32767, 32767).astype(np.int16), scale


def _errors(shapes, whole, scale):
    return (whole * scale.astype(float)[:, None, None] - shapes).astype(np.float32)


def _largest(q, shapes):
    return float(np.abs(np.tensordot(q, shapes, axes=1)).max(initial=0))
