"""Parts of entries that act no more: they are drawn in the rows alone in which their entries act."""

import numpy as np

from ..results.activity import Activity

# Shapes that stand for what an entry does; those of bodies and of contacts remain.
ACTING = ("joint", "bar", "rope", "coil", "damper", "coil_damper", "jack", "course", "stiffness", "force", "coupling")


class Released:
    """Leaves parts out while they are released."""

    def __init__(self, results):
        self._activity = Activity(results) if hasattr(results, "root") else None

    def apply(self, item, parts):
        """Lets the poses of the parts of an item have no numbers while its entry is released."""
        acts = self._activity.acts(item["entry"]) if self._activity and item["shape"] in ACTING else None
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
