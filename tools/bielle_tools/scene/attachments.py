"""Points at which something is attached to the nodes of bodies, also through nodes that they carry."""

import numpy as np

from ..messages import InputError
from ..results.quaternions import conjugate, rotated
from .drawing import places_of

NOT_ATTACHED = ("body", "node", "ellipsoid", "plane", "support", "mesh", "box", "cylinder", "tube", "cone", "sphere", "gear", "pulley", "tyre", "cam")
CARRIED = ("node", "body", "ellipsoid", "mesh", "box", "cylinder", "tube", "cone", "sphere", "gear", "pulley", "tyre", "cam")  # if on a carried node


def attachments(items, motion):
    """{node: positions (3) in its axes}. A node that another carries counts for the one that carries all."""
    found = {}
    for item in items:
        try:
            for place in places_of(item):
                node, position = _carried(place.node, np.array(place.position), motion)
                if item["shape"] not in NOT_ATTACHED or item["shape"] in CARRIED and node != place.node:
                    found.setdefault(node, []).append(position)
        except (InputError, KeyError, TypeError, ValueError, AttributeError, ArithmeticError):
            continue  # the error is reported when the item is built
    found.pop("ground", None)
    return found


def _carried(node, position, motion):
    """The node that carries a node, or itself, and the position in its axes, by the first row that has both."""
    for _ in range(20):
        carrier = motion.results.text(f"nodes/{node}", "carrier") if node != "ground" and motion.results.has(f"nodes/{node}") else ""
        if not carrier or carrier == node:
            break
        (x, q), (x_c, q_c) = motion.node(node), motion.node(carrier)
        known = np.flatnonzero(np.isfinite(x).all(axis=1) & np.isfinite(q).all(axis=1) & np.isfinite(x_c).all(axis=1) & np.isfinite(q_c).all(axis=1))
        if not len(known):
            break
        row = known[0]
        node, position = carrier, rotated(conjugate(q_c[row]), x[row] + rotated(q[row], position) - x_c[row])
    return node, position
