"""Everything that is needed to draw a motion, kept in memory: parts, their motion, the camera, texts."""

from dataclasses import dataclass, field

import numpy as np

from ..messages import InputError, check_names
from ..results.checked_model import check_of
from ..scene import make_scene
from ..scene.marks import marks_of
from ..scene.transforms import placed
from .camera import VIEWS, Camera, Extent, view_axes
from .choice import hidden_parts
from .page import Paper, stacked
from .surfaces import Surfaces

UNDEFORMED = ("#9aa1a9", 0.28)  # colour and opacity of the state about which a mode swings
WIDTH, HEIGHTS = 960, (0.34, 1.0)  # default width of a picture in pixels, and bounds of the drawing's height over its width
MOST_NOTES = 5


@dataclass
class Look:
    """How to draw. view: one of VIEWS, OBLIQUE or None; scale: factor of elastic displacements; span: first and last time;
    superelements {element: path}; follow: a node that stays in place; hide: patterns; size: (width, height) or None; labels: names of
    entries on the picture; ghost: the first position of the analysis in grey behind each picture."""

    view: str = None
    scale: float = 1.0
    span: tuple = (None, None)
    superelements: dict = None
    follow: str = None
    hide: list = field(default_factory=list)
    size: tuple = None
    labels: bool = False
    ghost: bool = False


class Shot:
    """A prepared motion; `page` finishes what a Window drew. rows of the results; surfaces, moved (rows,3): how far the camera
    follows; camera; highest: stress at the end of the colours [Pa], or None."""

    def __init__(self, results, look, pictures, sheet=False):
        """pictures: about so many rows; sheet: several pictures have no title and no colour bar of their own.
        @raises InputError if there is nothing to draw"""
        self.rows = np.asarray(results.frames(count=pictures, span=look.span))
        scene = make_scene(results, look.superelements)
        _tell(scene, results)
        if not scene.parts and not scene.flexible:
            raise InputError(f"'{results.path}' records no nodes, beams or superelements")
        hidden = hidden_parts(look.hide, [*scene.parts, *scene.flexible])
        check = check_of(results)
        self.said = check.sentences if check else []
        marks = marks_of(scene, self.rows) if len(results.time) == 1 else ()
        self.surfaces = [Surfaces(scene, self.rows, look.scale, hidden=hidden, marks=marks)]
        if not self.surfaces[0].count:
            raise InputError("--hide leaves nothing to draw")
        if hasattr(results, "at_rest"):
            self.surfaces.insert(0, Surfaces(make_scene(results.at_rest(), look.superelements), [0], paint=UNDEFORMED, hidden=hidden))
        elif look.ghost:
            self.surfaces.insert(0, Surfaces(scene, [0], paint=UNDEFORMED, hidden=lambda part: part.group == "ground" or hidden(part)))
        self.highest = self.surfaces[-1].highest
        self.moved = self._moved(results, look.follow)
        extent = self._extent(view_axes(look.view, scene.planar), results)
        flat = scene.planar is not None if look.view is None else look.view in VIEWS
        self.title = results.title + (f" (deformation x {look.scale:g})" if look.scale != 1 else "")
        self.moments = [results.moment(row) for row in self.rows]
        self.label = getattr(results, "stress_label", "von Mises [MPa]")
        self._lay_out(extent, look.size, flat, sheet)
        self.anchors = self._anchors(scene, hidden) if look.labels else []

    def _moved(self, results, node):
        if node is None:
            return np.zeros((len(self.rows), 3))
        check_names("node", [node], results.names("nodes"))
        path = results.rows(f"nodes/{node}/position", None)[self.rows]
        known = np.isfinite(path).all(axis=1)
        if not known.any():
            raise InputError(f"'{results.path}': the position of the node '{node}' is not known at these times")
        # The last known position replaces unknown ones.
        path = path[np.maximum.accumulate(np.where(known, np.arange(len(path)), np.argmax(known)))]
        return path - path[0]

    def _extent(self, axes, results):
        extent = Extent(axes)
        for k in range(len(self.rows)):
            for surfaces, moment in zip(self.surfaces, self.at(k, coloured=False)):
                extent.include(moment.points[surfaces.fitted] - self.moved[k])
        if not extent.known:
            raise InputError(f"'{results.path}' holds no positions that can be drawn")
        return extent

    def _lay_out(self, extent, size, flat, sheet):
        """Determines the sizes of letters, strips and drawing."""
        width, height = size or (WIDTH, None)
        letters = int(np.clip(min(width, 1.5 * (height or width)) / 52, 8, 28))
        self.paper, self.sheet = Paper(letters), sheet and len(self.rows) > 1
        self.said = self.paper.lines(self.said, width)
        strips = self.paper.line * (2 if self.highest and not self.sheet else 1) + (self.paper.line * len(self.said) * 3 // 4)
        if height is None:
            height = 2 * round(width * float(np.clip(extent.aspect, *HEIGHTS)) / 2) + strips
        self.camera = Camera(extent, (width, max(height - strips, 8)), flat)

    def at(self, k, coloured=True):
        """Moments of the k-th row for all surfaces."""
        return [surfaces.at(min(k, len(surfaces.poses) - 1), self.highest if coloured else None) for surfaces in self.surfaces]

    def page(self, k, picture):
        """The finished picture of the k-th row: that of a Window with its texts."""
        if self.anchors:
            names, places = self.anchors
            self.paper.write_labels(picture, names, self.camera.pixels(places[k], self.moved[k]))
        return stacked([self.paper.heading(picture.width, "" if self.sheet else self.title, self.moments[k]), picture,
                        *([] if self.sheet else self.bar(picture.width)), *self.paper.written(picture.width, self.said)])

    def bar(self, width):
        """A list of the strip with the colours of stresses; empty without stresses."""
        return [self.paper.bar(width, 1e-6 * self.highest, self.label)] if self.highest else []

    def _anchors(self, scene, hidden):
        """Names of entries, and the places (rows,n,3) of their labels."""
        names, places = [], []
        for anchor in scene.anchors:
            name = anchor.entry.partition("/")[2] or anchor.entry
            if hidden(anchor.part) or name in names:  # a body often has the name of its node
                continue
            names.append(name)
            if hasattr(anchor.part, "frame"):
                frame = np.asarray(anchor.part.frame(self.rows), float)
                pose = np.column_stack([frame, np.ones(len(frame))])
            else:
                pose = scene.poses(anchor.part, self.rows)[:, anchor.bone]
            places.append(placed(pose, anchor.point))
        return (names, np.stack(places, axis=1)) if names else []


def _tell(scene, results):
    """Notes of entries that are not drawn. A body whose file cannot be used ends the command: pictures without it mislead."""
    bodies = {f"elements/{results.entry_of(name)}" for name in results.elements_with("frame", "coordinates")}
    for entry, reason in scene.notes:
        if entry in bodies:
            raise InputError(reason)
    tell = (results.modes.results if hasattr(results, "modes") else results).note_once
    for entry, reason in scene.by_lines[:MOST_NOTES]:
        tell(f"'{entry}' is drawn as lines between its interfaces: {reason}")
    for entry, reason in scene.notes[:MOST_NOTES]:
        tell(reason if entry.startswith("/") else f"'{entry}' is not drawn: {reason}")
    if len(scene.notes) > MOST_NOTES:
        tell(f"{len(scene.notes) - MOST_NOTES} more entries are not drawn")
    if len(scene.by_lines) > MOST_NOTES:
        tell(f"{len(scene.by_lines) - MOST_NOTES} more entries are drawn as lines")
