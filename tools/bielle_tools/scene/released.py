"""Parts of entries that act no more: they are drawn in the rows alone in which their entries act."""

import numpy as np

from ..results.activity import Activity

# Shapes that stand for what an entry does; those of bodies and of contacts remain.
ACTING = ("joint", "bar", "rope", "coil", "damper", "coil_damper", "jack", "course", "stiffness", "force", "coupling")


class Released:
    """Leaves parts out while they are released."""

    def __init__(self, results):
        """results: an analysis of a file, or a mode, in which entries act as in the state about which it is"""
        state = results if hasattr(results, "root") else results.scenery.base
        self._activity = Activity(state) if state is not None else None
        self._rows = slice(None) if state is results or state is None else np.full(len(results.time), results.scenery.row)

    def acts(self, entry):
        """(rows) whether an entry acts; None if it always does, or if the file has no rows of the state."""
        acts = self._activity.acts(entry) if self._activity else None
        return None if acts is None else acts[self._rows]

    def apply(self, item, parts):
        """Lets the poses of the parts of an item have no numbers while its entry is released."""
        acts = self.acts(item["entry"]) if item["shape"] in ACTING else None
        if acts is None or acts.all():
            return
        for part in parts:
            part.motion = _where(acts, part.motion)


def _where(acts, motion):
    def poses(rows):
        found = np.array(motion(rows), float)
        found[~acts[rows]] = np.nan
        return found
    return poses
