"""Arms from the shapes of a body, or from a node without any, to what is attached to it apart from them."""

import contextlib

import numpy as np

from ..messages import InputError
from . import templates as t
from .motion import Place

NEAR = 0.6   # in sizes of symbols: what is attached so near needs no arm
THIN = 0.3   # radius of an arm, in sizes of symbols
INSIDE = 0.1  # share of the way to the middle of a shape by which an arm begins in it: corners of its box may be empty
FEWEST = 2   # things attached to a node without a shape, from which on arms are drawn


def arms_of(builder, items):
    """Parts. builder.covered: {node: [(entry, type, low (3), high (3))]}, boxes of shapes in the axes of the node"""
    bodies, nodes = ({item.get("node") for item in items if item["shape"] == shape and isinstance(item.get("node"), str)}
                     for shape in ("body", "node"))
    flexible = {item["element"].partition("/")[2] for item in items if item["shape"] in ("beam", "superelement")}
    found = []
    for node, points in builder.attached.items():
        boxes = builder.covered.get(node, [])
        if node in bodies or node.rpartition(".")[0] in flexible or not boxes and (node not in nodes or len(points) < FEWEST):
            continue
        pieces = [_arm(np.asarray(point), boxes, builder.symbol) for point in np.unique(np.round(points, 12), axis=0)]
        pieces = [piece for piece in pieces if piece is not None]
        if pieces:
            entry, kind = boxes[0][:2] if boxes else (f"nodes/{node}", "node")
            with contextlib.suppress(InputError):  # the node is not recorded, which is reported elsewhere
                found.append(builder.rigid({"entry": entry, "type": kind}, t.merged(pieces), place=Place(node)))
    return found


def _arm(point, boxes, symbol):
    """A rod to a point from the nearest place in a shape, or from the node; None if the point is there already."""
    start, distance = np.zeros(3), np.linalg.norm(point) if not boxes else np.inf
    for _, _, low, high in boxes:
        nearest, middle = np.clip(point, low, high), 0.5 * (low + high)
        if np.linalg.norm(point - nearest) < distance:
            start, distance = nearest + INSIDE * (middle - nearest), np.linalg.norm(point - nearest)
    return t.rod(start, point, (THIN * symbol, THIN * symbol)) if distance > NEAR * symbol else None
