"""Motion of nodes and of places fixed on them, over the rows of results."""

from dataclasses import dataclass

import numpy as np

from ..messages import InputError
from ..results.quaternions import IDENTITY, product, rotated
from .transforms import pose


@dataclass(frozen=True)
class Place:
    """A frame on a node, in the node's axes; `ground` is the inertial frame."""
    node: str
    position: tuple = (0.0, 0.0, 0.0)
    rotation: tuple = (1.0, 0.0, 0.0, 0.0)


class NotRecorded(InputError):
    """The results do not have the motion of a node."""


class Motion:
    """Positions and rotations of nodes, each read once."""

    def __init__(self, results):
        self.results, self._kept = results, {}

    def node(self, name):
        """Positions (nt,3) and quaternions (nt,4). @raises InputError if they are not recorded"""
        if name not in self._kept:
            self._kept[name] = self._read(name)
        return self._kept[name]

    def _read(self, name):
        count = len(self.results.time)
        if name == "ground":
            return np.zeros((count, 3)), np.tile(IDENTITY, (count, 1))
        place = f"nodes/{name}"
        if self.results.has(f"{place}/position") and self.results.has(f"{place}/rotation"):
            return self.results.rows(f"{place}/position"), self.results.rows(f"{place}/rotation")
        beam, _, number = name.rpartition(".")  # inner nodes are in the group of their beam
        place = f"elements/{beam}"
        if number.isdigit() and self.results.has(f"{place}/position") and self.results.has(f"{place}/rotation") \
                and int(number) < self.results.shape(f"{place}/position")[1]:
            return self.results.rows(f"{place}/position")[:, int(number)], self.results.rows(f"{place}/rotation")[:, int(number)]
        raise NotRecorded(f"the results do not record the node '{name}'")

    def position(self, place, rows):
        """(rows,3) of a place."""
        x, q = self.node(place.node)
        return x[rows] + rotated(q[rows], np.array(place.position))

    def poses(self, place, rows):
        """(rows,8) of a place."""
        x, q = self.node(place.node)
        return pose(x[rows] + rotated(q[rows], np.array(place.position)), product(q[rows], np.array(place.rotation)))

    def first(self, place):
        """(3) position of a place in the first row that has one; nan without any."""
        x, q = self.node(place.node)
        known = np.flatnonzero(np.isfinite(x).all(axis=1) & np.isfinite(q).all(axis=1))
        return self.position(place, known[:1])[0] if len(known) else np.full(3, np.nan)
