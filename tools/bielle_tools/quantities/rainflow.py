"""Cycles of a load history by the rainflow method, and the damage that they do by Miner's rule.

ASTM E1049-85 (2017), Standard Practices for Cycle Counting in Fatigue Analysis, section 5.4.4.
"""

import numpy as np

from ..bodies.stress_invariants import von_mises


def reversals(signal):
    """The peaks and valleys of a signal, its ends among them."""
    signal = np.asarray(signal, float)
    changed = signal[np.concatenate([[True], np.diff(signal) != 0])] if len(signal) else signal
    if len(changed) < 3:
        return changed
    turns = np.diff(np.sign(np.diff(changed))) != 0
    return changed[np.concatenate([[True], turns, [True]])]


def count_cycles(signal):
    """(cycles, 3) range, mean and count (1 or 1/2) of each cycle, in the order in which they close."""
    cycles, open_points = [], []

    def count(a, b, number):
        cycles.append((abs(a - b), (a + b) / 2, number))

    for point in reversals(signal):
        open_points.append(point)
        while len(open_points) >= 3:
            first, second, third = open_points[-3:]
            if abs(third - second) < abs(second - first):
                break
            if len(open_points) == 3:  # the range holds the start of the history: half a cycle
                count(first, second, 0.5)
                del open_points[0]
            else:
                count(first, second, 1.0)
                del open_points[-3:-1]
    for a, b in zip(open_points, open_points[1:]):
        count(a, b, 0.5)
    return np.array(cycles).reshape(-1, 3)


def in_bins(cycles, bins):
    """(bins, 3) cycles sorted into bins of range: the middle of each non-empty bin, their mean stress, and their
    number."""
    edges = np.linspace(0, cycles[:, 0].max(), bins + 1)
    place = np.clip(np.digitize(cycles[:, 0], edges) - 1, 0, bins - 1)
    rows = []
    for k in np.unique(place):
        inside = cycles[place == k]
        number = inside[:, 2].sum()
        rows.append((edges[k:k + 2].mean(), (inside[:, 1] * inside[:, 2]).sum() / number, number))
    return np.array(rows)


def miner_damage(cycles, reference, life, exponent):
    """Sum of count / N with N = life (range / reference)^-exponent: 1 is the end of life. Means have no influence."""
    return float((cycles[:, 2] * (cycles[:, 0] / reference) ** exponent).sum() / life)


def stress_signal(stress, component):
    """A signal of a stress (nt, 6) xx yy zz yz xz xy.

    component: one of those; `principal`: the principal stress of largest magnitude, with its sign; `von_mises`: the equivalent
    stress with the sign of the mean stress, so that a reversal of the load is seen.
    """
    names = ["xx", "yy", "zz", "yz", "xz", "xy"]
    if component in names:
        return stress[:, names.index(component)]
    xx, yy, zz, yz, xz, xy = stress.T
    if component == "von_mises":
        value = von_mises(stress)
        return np.where(xx + yy + zz < 0, -value, value)
    values = np.linalg.eigvalsh(np.stack([xx, xy, xz, xy, yy, yz, xz, yz, zz], axis=-1).reshape(-1, 3, 3))
    return np.where(-values[:, 0] > values[:, 2], values[:, 0], values[:, 2])


COMPONENTS = ["xx", "yy", "zz", "yz", "xz", "xy", "principal", "von_mises"]
