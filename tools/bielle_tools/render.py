"""Draws the mechanism at one time with matplotlib: bodies coloured by stress, rigid ones grey, beams as lines, nodes as dots.

An orthographic view, painted from back to front: no graphics card, no display, small files. ParaView serves larger
needs.
"""

import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import Normalize, to_rgb

from .cells import triangles_of
from .messages import InputError
from .plot_style import COLOURS, plt
from .rigid_bodies import rigid_bodies
from .superelement_body import superelement_of

RIGID = "#b0b0b0"
STRESS = plt.cm.YlOrRd  # pale to dark: shading shows on it, and so does the order without colours
LIGHT = np.array([0.35, 0.5, 0.8])  # direction towards the light, in view axes (right, up, towards the viewer)
VIEWS = {  # rows: right, up; the viewer looks from right x up
    "x": ([0, 1, 0], [0, 0, 1]), "y": ([-1, 0, 0], [0, 0, 1]), "z": ([1, 0, 0], [0, 1, 0]),
    "-x": ([0, -1, 0], [0, 0, 1]), "-y": ([1, 0, 0], [0, 0, 1]), "-z": ([-1, 0, 0], [0, 1, 0]),
}


class Scene:
    """All drawn parts, prepared once; `draw` paints them for one row of the results."""

    def __init__(self, results, view=None, scale=1.0, superelements=None):
        self.results = results
        self.scale = scale
        self.axes = _view_axes(results, view)
        self.bodies = []
        for name in results.elements_with("frame", "coordinates"):
            body = superelement_of(results, name, superelements or {})
            self.bodies.append((name, body, triangles_of(body.surface())))
        self.rigid = rigid_bodies(results)
        self.beams = results.elements_with("position", "rotation")
        self.nodes = results.names("nodes")
        carriers = {name: results.text(f"nodes/{name}", "carrier") for name in self.nodes}
        self.links = [(carrier, name) for name, carrier in carriers.items() if carrier in self.nodes]
        self.limits = None
        self.norm = None

    def prepare(self, rows):
        """Fixes the frame of the picture and the range of stresses over the given rows."""
        low, high, stress = np.full(2, np.inf), np.full(2, -np.inf), 0.0
        for row in rows:
            points = [self.project(positions) for positions, _ in self._bodies_at(row)]
            points += [self.project(body.place(self.results, row)[0]) for body in self.rigid]
            points += [self.project(self.results.rows(f"elements/{b}/position", row)) for b in self.beams]
            points += [self.project(self.results.rows(f"nodes/{n}/position", row)[None]) for n in self.nodes]
            for p in points:
                low, high = np.fmin(low, np.fmin.reduce(p[:, :2])), np.fmax(high, np.fmax.reduce(p[:, :2]))
            for _, values in self._bodies_at(row):
                if values is not None:
                    stress = max(stress, float(np.fmax.reduce(values)))
        if not np.all(np.isfinite([low, high])):
            raise InputError(f"'{self.results.path}' holds no positions that can be drawn")
        margin = 0.06 * max((high - low).max(), 1e-9)
        self.limits = low - margin, high + margin
        self.norm = Normalize(0, 1e-6 * stress if stress > 0 else 1)

    def draw(self, panel, row):
        """Paints the mechanism at a row of the results. @returns the object that a colour bar needs, or None without
        stresses"""
        panel.set_aspect("equal")
        panel.set_axis_off()
        panel.set_xlim(self.limits[0][0], self.limits[1][0])
        panel.set_ylim(self.limits[0][1], self.limits[1][1])
        coloured, depths = None, []
        for (_, _, corners), (positions, stress) in zip(self.bodies, self._bodies_at(row)):
            artist, depth = self._paint_body(panel, positions, stress, corners)
            coloured = coloured or (stress is not None and plt.cm.ScalarMappable(self.norm, STRESS))
            depths.append((depth, artist))
        for body in self.rigid:
            positions, centre = body.place(self.results, row)
            if body.extended:
                artist, depth = self._paint_body(panel, positions, None, body.triangles, RIGID)
                artist.set(alpha=0.5, edgecolor="none")
                depths.append((depth, artist))
            spoke = np.array([self.project(centre[None])[0], self._node(body.node, row)])
            depths.append((spoke[:, 2].mean(), self._paint_line(panel, spoke, "#8c8c8c", 6)))
        for ends in self.links:
            line = np.array([self._node(name, row) for name in ends])
            depths.append((line[:, 2].mean(), self._paint_line(panel, line, "#8c8c8c", 6)))
        for name in self.beams:
            line = self.project(self.results.rows(f"elements/{name}/position", row))
            depths.append((line[:, 2].mean(), self._paint_line(panel, line, COLOURS[1], 4)))
        nearer = 0.05 * (self.limits[1] - self.limits[0]).max()  # a dot in the middle of a body shows on it
        for name in self.nodes:
            x, y, depth = self._node(name, row)
            dot, = panel.plot(x, y, "o", color="white", markeredgecolor="black", markersize=4)
            depths.append((depth + nearer, dot))
        for order, (_, artist) in enumerate(sorted(depths, key=lambda item: item[0])):
            artist.set_zorder(2 + order)
        return coloured or None

    def _paint_body(self, panel, positions, stress, corners, plain="#7f9db9"):
        view = self.project(positions)
        triangles = view[corners]  # (f,3,3)
        normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
        length = np.linalg.norm(normals, axis=1)
        facing = normals[:, 2] > 0
        order = np.flatnonzero(facing)[np.argsort(triangles[facing][:, :, 2].mean(axis=1))]
        shade = 0.65 + 0.35 * np.clip(normals[order] @ (LIGHT / np.linalg.norm(LIGHT)) / length[order], 0, 1)
        values = None if stress is None else 1e-6 * stress[corners[order]].mean(axis=1)
        base = np.array([to_rgb(plain)]) if values is None else STRESS(self.norm(np.nan_to_num(values)))[:, :3]
        faces = PolyCollection(triangles[order][:, :, :2], facecolors=base * shade[:, None], edgecolors="face", linewidths=0.4)
        return panel.add_collection(faces), view[:, 2].mean()

    @staticmethod
    def _paint_line(panel, line, colour, width):
        return panel.add_collection(LineCollection([line[:, :2]], colors=colour, linewidths=width, capstyle="round"))

    def _bodies_at(self, row):
        for name, body, _ in self.bodies:
            q = self.results.rows(f"elements/{name}/coordinates", row)
            positions, _ = body.at(self.results.rows(f"elements/{name}/frame", row), q, self.scale)
            yield positions, body.von_mises(q)

    def _node(self, name, row):
        return self.project(self.results.rows(f"nodes/{name}/position", row)[None])[0]

    def project(self, points):
        """Inertial points (n,3) -> right, up, towards the viewer."""
        return points @ self.axes.T


def _view_axes(results, view):
    """(3,3): right, up, towards the viewer. The default looks slightly from above on the plane of the largest
    motion."""
    if view in VIEWS:
        right, up = (np.array(v, float) for v in VIEWS[view])
        return np.array([right, up, np.cross(right, up)])
    reach = np.zeros(3)
    paths = [] if hasattr(results, "reach") else [results.rows(f"nodes/{n}/position") for n in results.names("nodes")]
    if hasattr(results, "reach"):
        reach = results.reach()
    elif paths:
        reach = np.nanmax([np.fmax.reduce(path) - np.fmin.reduce(path) for path in paths], axis=0)
        reach = np.where(np.isfinite(reach), reach, 0)
    towards = np.zeros(3)
    normal = int(np.argmin(reach))
    towards[normal] = -1 if normal == 1 else 1
    up = np.array([0, 0, 1.0]) if normal != 2 else np.array([0, 1.0, 0])
    right = np.cross(up, towards)
    if view is None:
        towards = towards + 0.35 * right + 0.4 * up
    towards /= np.linalg.norm(towards)
    right = np.cross(up, towards)
    right /= np.linalg.norm(right)
    return np.array([right, np.cross(towards, right), towards])
