"""Flexible bodies: surfaces of superelements with the shapes of their coordinates. Instances of a file share one body."""

import os

import numpy as np

from ..bodies.superelement_body import find_superelement, superelement_of
from ..mesh.cells import triangles_of
from ..results.quaternions import rotated
from .levels import levels_of
from .parts import FlexibleBody, FlexiblePart


class FlexibleBodies:
    """Reads each superelement once."""

    def __init__(self, results, superelements):
        # A mode is drawn with the superelements of the state about which it is.
        self.results, self.superelements, self._kept = results, superelements or {}, {}
        scenery = getattr(results, "scenery", None)
        self._source = getattr(scenery, "base", None) or results
        self.has_rows = scenery is None or scenery.base is not None  # a mode without rows of its state has told so

    def part(self, name, kind, colour, opacity):
        """The instance that the element `name` is. @raises InputError"""
        path = os.path.realpath(find_superelement(self._source, name, self.superelements))
        piece = self.results.text(f"elements/{name}", "group")
        if (path, piece) not in self._kept:
            self._kept[path, piece] = self._body(name, path, piece)
        place = f"elements/{name}"
        kept = {}

        def rows_of(quantity):
            def read(rows):
                if quantity not in kept:
                    kept[quantity] = self.results.rows(f"{place}/{quantity}")
                return kept[quantity][rows]
            return read
        return FlexiblePart(f"elements/{self.results.entry_of(name)}", kind, self._kept[path, piece], colour, opacity,
                            rows_of("frame"), rows_of("coordinates"))

    def _body(self, name, path, piece):
        whole = superelement_of(self._source, name, self.superelements)
        triangles = np.asarray(triangles_of(whole.surface()), int)
        nodes, triangles = np.unique(triangles, return_inverse=True)
        triangles = triangles.reshape(-1, 3)
        count = whole.displacement.shape[1]
        shapes = np.zeros((count, len(nodes), 3))
        index = np.full(len(whole.points), -1)
        index[nodes] = np.arange(len(nodes))
        drawn = index[whole.displaced] >= 0
        shapes[:, index[whole.displaced[drawn]]] = whole.displacement.reshape(-1, 3, count)[drawn].transpose(2, 0, 1)
        stress, stressed = None, np.zeros(len(nodes), bool)
        if whole.stress is not None:
            stress = np.zeros((count, len(nodes), 6))
            drawn = index[whole.stressed] >= 0
            stress[:, index[whole.stressed[drawn]]] = whole.stress.reshape(-1, 6, count)[drawn].transpose(2, 0, 1)
            stressed[index[whole.stressed[drawn]]] = True
        order, levels = levels_of(whole.points[nodes], triangles)
        return FlexibleBody(path, piece, whole.points[nodes[order]], levels[0].triangles, shapes[:, order], None if stress is None else stress[:, order],
                            stressed[order], nodes[order], levels)


def surface_points(part, rows, every=1):
    """(rows, p, 3) inertial points of a flexible part, every `every`-th one."""
    frame, q = part.frame(rows), part.coordinates(rows)
    local = part.body.points[::every] + np.tensordot(q, part.body.shapes[:, ::every], axes=1)
    return frame[:, None, :3] + rotated(frame[:, None, 3:], local)
