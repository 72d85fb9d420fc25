"""Flexible bodies: surfaces of superelements with the shapes of their coordinates, or lines that join interfaces. Instances of a file share one body."""

import os

import numpy as np

from ..bodies.superelement_body import NoSurface, check_coordinates, find_superelement, interface_motions, mass_centre, superelement_of
from ..messages import InputError
from ..mesh.cells import triangles_of
from ..results.quaternions import rotated
from .interface_lines import interface_lines
from .levels import Level, levels_of
from .parts import FlexibleBody, FlexiblePart


class FlexibleBodies:
    """Reads each superelement once."""

    def __init__(self, results, superelements):
        # A mode is drawn with the superelements of the state about which it is.
        self.results, self.superelements, self._kept = results, superelements or {}, {}
        scenery = getattr(results, "scenery", None)
        self._source = getattr(scenery, "base", None) or results
        self.has_rows = scenery is None or scenery.base is not None  # a mode without rows of its state has already been
                                                                     # reported

    def part(self, name, kind, colour, opacity, symbol):
        """The instance that the element `name` is. symbol: size of symbols [m]. @raises InputError"""
        path = os.path.realpath(find_superelement(self._source, name, self.superelements))
        piece = self.results.text(f"elements/{name}", "group")
        if (path, piece) not in self._kept:
            self._kept[path, piece] = self._body(name, path, piece, symbol)
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

    def _body(self, name, path, piece, symbol):
        try:
            whole = superelement_of(self._source, name, self.superelements)
            surface = whole.surface()
        except NoSurface as error:
            return self._lines(name, path, piece, symbol, error)
        triangles = np.asarray(triangles_of(surface), int)
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

    def _lines(self, name, path, piece, symbol, error):
        """A body without a surface: its interfaces, and the centre of mass if there is one interface alone. @raises the error if the file does not
        have them either"""
        try:
            positions, displacements = interface_motions(path, piece)
            if len(positions) == 1:
                positions = np.vstack([positions, mass_centre(path, piece)])
                displacements = np.concatenate([displacements, np.zeros_like(displacements)])
        except InputError:
            raise error from None
        if not len(positions):
            raise error
        check_coordinates(self._source, name, path, displacements.shape[2])
        points, triangles, shapes = interface_lines(positions, displacements, symbol)
        return FlexibleBody(path, piece, points, triangles, shapes, None, np.zeros(len(points), bool), np.full(len(points), -1),
                            [Level(0.0, len(points), triangles)], str(error))


def surface_points(part, rows, every=1):
    """(rows, p, 3) inertial points of a flexible part, every `every`-th one."""
    frame, q = part.frame(rows), part.coordinates(rows)
    local = part.body.points[::every] + np.tensordot(q, part.body.shapes[:, ::every], axes=1)
    return frame[:, None, :3] + rotated(frame[:, None, 3:], local)
