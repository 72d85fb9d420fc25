"""Planes of a drawing: each is drawn once, and those in one plane next to each other, since overlapping ones darken."""

from dataclasses import dataclass

import numpy as np

from ..results.quaternions import rotated
from .drawing import place_of

SAME = 1e-6  # share of the machine within which planes are the same


@dataclass
class DrawnPlane:
    """item of the drawing; node; position and normal (3) in the axes of the node."""
    item: dict
    node: str
    position: np.ndarray
    normal: np.ndarray

    def distances(self, planes, extent):
        """Distances [m] from the middles of others in the same plane."""
        return [float(np.linalg.norm(other.position - self.position)) for other in planes if other is not self and self._holds(other, extent)]

    def repeats(self, other, extent):
        """Tells whether both are the same plane with the same middle."""
        return self._holds(other, extent) and bool(np.linalg.norm(other.position - self.position) < SAME * extent)

    def _holds(self, other, extent):
        return self.node == other.node and abs(self.normal @ other.normal) > 1 - 1e-9 and abs(self.normal @ (other.position - self.position)) < SAME * extent


def drawn_planes(items, extent):
    """The planes among the items of a drawing, each once. extent: of the machine [m]"""
    found = []
    for item in items:
        if item["shape"] == "plane":
            try:
                place = place_of(item)
            except (TypeError, ValueError, AttributeError):
                continue  # the error is reported when the item is built
            plane = DrawnPlane(item, place.node, np.array(place.position), rotated(np.array(place.rotation), np.array([0.0, 0, 1])))
            if "size" in item or not any(plane.repeats(other, extent) for other in found):
                found.append(plane)
    return found
