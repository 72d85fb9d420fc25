"""Ties of nodes to one node, and point masses, as the readers of decks deliver them."""

from dataclasses import dataclass, field

import numpy as np

DIRECTIONS = ("x", "y", "z", "rx", "ry", "rz")
TRANSLATIONS = {1, 2, 3}


class TieRefusal(Exception):
    """The reason why an interface cannot stand for a tie, or why a mass cannot be used: part of a sentence after its name."""


@dataclass
class Tie:
    """A tie. Rows are those of the points of RawMesh.

    kind: "rigid" or "average"; reference: row of the reference node, something else if it is no point of the mesh; position, axes
    (columns): its own; weights: {row: weight} of the tied nodes; surface: name of a set of faces in place of nodes;
    refused: the reason why it can be no interface.
    """

    name: str
    kind: str = "rigid"
    reference: int = None
    position: np.ndarray = None
    axes: np.ndarray = field(default_factory=lambda: np.eye(3))
    directions: list = field(default_factory=lambda: list(DIRECTIONS))
    weights: dict = field(default_factory=dict)
    surface: str = ""
    refused: str = ""


@dataclass
class PointMass:
    """A mass at a node. position: centre of mass; inertia (3,3): about it, in basic axes; node: as the reference of a Tie;
    refused: the reason why it cannot be used, with which the other values are not set."""

    name: str
    mass: float = 0.0
    position: np.ndarray = field(default_factory=lambda: np.zeros(3))
    inertia: np.ndarray = field(default_factory=lambda: np.zeros((3, 3)))
    node: int = None
    refused: str = ""

    def has_effect(self):
        """Tells whether it has mass or inertia, or values that are not known."""
        return bool(self.refused) or self.mass != 0 or np.any(self.inertia)


def direction_words(components):
    """The directions of components 1 to 6."""
    return [word for k, word in enumerate(DIRECTIONS, 1) if k in components]


def check_translations(components, whose):
    """@raises TieRefusal unless all three translations are among the components"""
    if not TRANSLATIONS <= components:
        shown = "".join(str(k) for k in sorted(components)) or "none"
        raise TieRefusal(f"it takes the components {shown} of {whose}; an interface ties all three translations (123)")


def check_weight(weight, node):
    """@raises TieRefusal for a weight that no mean can have"""
    if not 0 <= weight < float("inf"):
        raise TieRefusal(f"the weight {weight:g} of the node {node} is not positive")
