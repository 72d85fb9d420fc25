"""The instant of a motion that tells most in one picture."""

import numpy as np

from ..messages import InputError
from ..results.results_file import Results
from ..scene import make_scene

MOST_ROWS = 80    # among which the instant is chosen
LARGEST = 4.0     # diagonal of the first position together with the chosen one, relative to that of the first
LEAST = 0.02      # displacement relative to the machine from which on the first position is drawn as well
WIDE = 0.5        # weight of the machine's second longest side next to the displacement
ARM = 0.3         # of rotations, relative to the machine


def telling_moment(path):
    """(time or load factor, whether the first position belongs to the picture). The instant is the one that is most unlike the
    first position, by the mean displacement of the nodes, and least like a line, among those that leave the machine large enough
    in a picture of both; the first one if there is none.
    A load that grows is drawn at its end. None for results without rows or nodes."""
    with Results(path) as results:
        if not len(results.time):
            return None
        rows = results.frames(count=MOST_ROWS)
        scene = make_scene(results)
        if not scene.parts and not scene.flexible:
            return None
        if results.static or len(rows) == 1:
            return float(results.time[rows[-1]]), False
        low, high = scene.bounds(rows[:1])
        size = float(np.linalg.norm(high - low)) or 1.0
        moved = _displacements(scene, rows) / size
        near = np.array([_diagonal(scene, rows[[0, k]]) <= LARGEST * size for k in range(len(rows))])
        width = np.array([np.sort(np.ptp(scene.bounds(rows[[k]]), axis=0))[1] for k in range(len(rows))])  # second longest side
        score = moved / max(moved[near].max(), LEAST) + WIDE * width / max(width.max(), 1e-12 * size)
        best = int(np.argmax(np.where(near, score, -1)))
        if moved[best] < LEAST and moved.max() >= LEAST:  # the machine moves away within one row
            best = 0
        return float(results.time[rows[best]]), bool(near[best] and moved[best] >= LEAST)


def _diagonal(scene, rows):
    low, high = scene.bounds(rows)
    return np.linalg.norm(high - low)


def _displacements(scene, rows):
    """Mean over the nodes of how far they are from the first row, rotations as those of an arm [m]."""
    low, high = scene.bounds(rows[:1])
    arm, found = ARM * np.linalg.norm(high - low), [np.zeros(len(rows))]
    for name in scene.results.names("nodes"):
        try:
            x, q = (values[rows] for values in scene.motion_of_nodes.node(name))
        except InputError:
            continue
        angle = 2 * np.arccos(np.clip(np.abs((q * q[:1]).sum(axis=1)), 0, 1))
        found.append(np.nan_to_num(np.linalg.norm(x - x[0], axis=1) + arm * angle))
    return np.mean(found, axis=0)
