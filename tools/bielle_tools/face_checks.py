"""Faces of solid cells that lie on each other but do not fit: their cells are not joined there."""

import numpy as np

from .cells import CELLS, face_keys
from .messages import counted


def nonconforming(points, boundary):
    """Sentences about quadrilaterals that stand against two triangles, among the `boundary_faces` of solid cells."""
    triangles = [face_keys(flat, faces)[:, 1:] for flat, faces in boundary.items() if CELLS[flat].shape == "triangle"]
    quadrilaterals = [faces[:, :4] for flat, faces in boundary.items() if CELLS[flat].shape == "quad"]
    if not triangles or not quadrilaterals:
        return []
    known = set(map(tuple, np.concatenate(triangles).tolist()))
    found = []
    for corners in np.concatenate(quadrilaterals).tolist():
        for halves in ((0, 1, 2), (0, 2, 3)), ((0, 1, 3), (1, 2, 3)):
            if all(tuple(sorted(corners[k] for k in half)) in known for half in halves):
                found.append(corners)
    if not found:
        return []
    return [f"{counted(len(found), 'quadrilateral face')} of solid cells {'stands' if len(found) == 1 else 'stand'} against two "
            "triangles (the first "
            f"near {place(points[found[0]].mean(axis=0))}): the cells on both sides have common nodes there, but their displacements part "
            "between them; pyramids would join them"]


def different_orders(points, faces):
    """Sentences about faces of order 1 that stand against faces of order 2. faces: those of `solid_faces`"""
    if len({CELLS[flat].nodes for flat in faces if CELLS[flat].shape == "triangle"}) < 2 \
            and len({CELLS[flat].nodes for flat in faces if CELLS[flat].shape == "quad"}) < 2:
        return []
    seen, count, first = {}, 0, None
    for flat, block in faces.items():
        for key, face in zip(map(tuple, face_keys(flat, block).tolist()), block.tolist()):
            if seen.setdefault(key, flat) != flat:
                count += 1
                first = first or face[:CELLS[flat].corners]
    if not count:
        return []
    return [f"{counted(count, 'face')} of solid cells {'has' if count == 1 else 'have'} more nodes on one side than on the other (the "
            "first near "
            f"{place(points[first].mean(axis=0))}): the displacements of both sides part between the corners"]


def place(point):
    return "(" + ", ".join(f"{x:g}" for x in point) + ")"
