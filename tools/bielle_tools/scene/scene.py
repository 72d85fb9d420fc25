"""The scene of a mechanism: its parts, their motion, its size, and the entries that could not be drawn."""

import numpy as np

from ..messages import InputError
from ..results.quaternions import conjugate, product
from ..results.results_file import LARGEST
from .arms import arms_of
from .attachments import attachments
from .builders import BUILDERS, Builder
from .couplings import coupling_items
from .drawing import Drawing, places_of
from .flexible import FlexibleBodies, surface_points
from .motion import Motion, NotRecorded
from .parts import Anchor, FlexiblePart
from .planes import drawn_planes
from .released import Released
from .style import Palette, Style
from .transforms import placed

SAMPLES = 24  # rows from which bounds are taken
MANY = 800  # items from which on symbols are coarser, and bounds are taken from spheres about bones


def make_scene(results, superelements=None, style=None):
    """The scene of an open results file, or of one mode of it. superelements: {element: path}; style: Style."""
    return Scene(results, superelements, style or Style())


class Scene:
    """parts, flexible: what is drawn; size: characteristic length [m]; symbol: size of symbols [m]; planar: 0, 1, 2 for the axis normal to a
    planar motion, or None; gravity (3) or None; notes: [(entry, reason)] of entries that are not drawn; by_lines: the same of flexible bodies
    without a surface, which lines between their interfaces stand for; released: the times
    in which entries act (Released); anchors of labels; low, high (3): bounds over the rows."""

    def __init__(self, results, superelements, style):
        self.results, self.rows = results, np.arange(len(results.time))
        self.motion_of_nodes = Motion(results)
        drawing = Drawing(results)
        self.gravity, self.notes, self.from_file = drawing.gravity, list(drawing.notes), drawing.from_file
        self.items = drawing.items + coupling_items(results, drawing.items)
        self.parts, self.flexible, self.anchors, self.by_lines = [], [], [], []
        builder = Builder(self.motion_of_nodes, drawing, Palette(style), FlexibleBodies(results, superelements))
        self._measure(builder, style)
        self._unknown, self.released = {}, Released(results)
        for item in self.items:
            self._add(builder, item)
        self.parts += arms_of(builder, self.items)
        self.notes += builder.notes
        self.notes += [("/drawing", f"items of the shape '{shape}' are not known here: {count}") for shape, count in self._unknown.items()]
        self.low, self.high = low, high = self.bounds(self._samples())
        self.size = float(np.linalg.norm(high - low)) or 1.0
        self.planar = self._planar()

    def poses(self, part, rows):
        """(rows, bones, 8): x y z, quaternion w x y z, stretch. A vertex is at position + R (point * [1, 1, stretch])."""
        return part.motion(np.asarray(rows))

    def bounds(self, rows):
        """Least and largest coordinates (3) of what is drawn in the rows."""
        low, high = np.full(3, np.inf), np.full(3, -np.inf)
        for part in self.parts:
            if part.mesh.lines.size:
                continue  # planes extend without end
            poses = self.poses(part, rows)
            if len(self.parts) > MANY:
                reach = np.abs(part.mesh.points).max(initial=0) * np.fmax(poses[..., 7:], 1)
                points = np.concatenate([poses[..., :3] - reach, poses[..., :3] + reach]).reshape(-1, 3)
            else:
                every = max(1, len(part.mesh.points) // 400)
                points = placed(poses[:, part.mesh.bones[::every]], part.mesh.points[::every]).reshape(-1, 3)
            low, high = np.fmin(low, np.fmin.reduce(points, initial=np.inf)), np.fmax(high, np.fmax.reduce(points, initial=-np.inf))
        for part in self.flexible:
            points = surface_points(part, rows, max(1, len(part.body.points) // 400)).reshape(-1, 3)
            low, high = np.fmin(low, np.fmin.reduce(points, initial=np.inf)), np.fmax(high, np.fmax.reduce(points, initial=-np.inf))
        known = np.isfinite(low) & np.isfinite(high)
        return np.where(known, low, -0.5), np.where(known, high, 0.5)

    def _samples(self):
        return self.rows if len(self.rows) <= SAMPLES else np.unique(np.linspace(0, len(self.rows) - 1, SAMPLES).astype(int))

    def _measure(self, builder, style):
        """Size of the machine and of symbols: a share of the machine, and less than the usual distance of neighbours."""
        first, joints, paths = [], [], []
        for item in self.items:
            try:
                own = []
                for place in places_of(item):
                    x = self.motion_of_nodes.first(place)
                    if item["shape"] != "plane" and np.isfinite(x).all():
                        own.append(x)
                        paths.append(self.motion_of_nodes.position(place, self._samples()))
                first += own
                if own and item["shape"] in ("joint", "node"):
                    joints.append(np.mean(own, axis=0))  # frames of an elastic joint are close to each other
                if item["shape"] in ("beam", "superelement"):
                    first += self._element_points(item)
            except (InputError, KeyError, TypeError, ValueError, AttributeError, ArithmeticError):
                continue  # the error is reported when the item is built
        builder.attached = attachments(self.items, self.motion_of_nodes)
        points = np.array(first + [row for path in paths for row in path]).reshape(-1, 3)
        points = points[np.isfinite(points).all(axis=1)]
        extent = self._own_extent()
        if len(points):
            low, high = points.min(axis=0), points.max(axis=0)
            builder.centre = (low + high) / 2
            extent = max(extent, float(np.linalg.norm(high - low)))
            still = np.array(first)
            extent_first = max(float(np.linalg.norm(np.ptp(still, axis=0))) if len(still) else 0.0, self._own_extent())
        else:
            extent_first = extent
        builder.extent = extent or 1.0
        builder.around = 24 if len(self.items) < MANY else 8
        builder.planes = drawn_planes(self.items, builder.extent)
        self.symbol = builder.symbol = style.symbols * _symbol_size(extent_first or extent or 1.0, np.array(joints).reshape(-1, 3), self._radii(), self._half_widths())

    def _own_extent(self):
        """Largest dimension of the shapes themselves."""
        sizes = [0.0]
        for item in self.items:
            for key in ("size", "radius", "length", "radii"):
                try:
                    sizes += [float(np.max(np.abs(item[key])))] if key in item and item["shape"] != "plane" else []
                except (TypeError, ValueError, ArithmeticError):
                    pass
            if item["shape"] == "ellipsoid":
                sizes.append(float(np.ptp(item["points"], axis=0).max()))
        return max(size for size in sizes if np.isfinite(size))

    def _radii(self):
        """Radii of wheels [m], which symbols of their bearings should not cover."""
        radii = [item.get("radius") for item in self.items if item["shape"] in ("gear", "pulley", "tyre")]
        return [radius for radius in radii if isinstance(radius, (int, float)) and 0 < radius < LARGEST]

    def _half_widths(self):
        """Half widths of the sections of beams [m]."""
        found = []
        for item in self.items:
            try:
                found += [0.5 * float(np.min(np.ptp(np.asarray(section["outer"], float), axis=0))) for section in item["sections"]] if item["shape"] == "beam" else []
            except (KeyError, TypeError, ValueError, ArithmeticError):
                continue  # the error is reported when the item is built
        return [half for half in found if 0 < half < LARGEST]

    def _element_points(self, item):
        place, results = item["element"], self.results
        if item["shape"] == "superelement":
            return [x for x in results.rows(f"{place}/frame")[:1, :3] if np.isfinite(x).all()]
        x = results.rows(f"{place}/position")
        return [point for point in x[0] if np.isfinite(point).all()] if len(x) else []

    def _add(self, builder, item):
        if item["shape"] not in BUILDERS:
            self._unknown[item["shape"]] = self._unknown.get(item["shape"], 0) + 1
            return
        try:
            parts = builder.parts(item)
            for part in parts:  # a part whose motion cannot be read is reported here, not during playback
                (part.frame if isinstance(part, FlexiblePart) else part.motion)(self.rows[:1])
            self.released.apply(item, parts)
        except (InputError, KeyError, TypeError, ValueError, AttributeError, IndexError, ArithmeticError) as error:
            if not (isinstance(error, NotRecorded) and item["shape"] == "node"):  # `output: only` left out the node itself
                self.notes.append((item["entry"], _reason(error)))
            return
        known = {anchor.entry for anchor in self.anchors[-8:]}
        for part in parts:
            if isinstance(part, FlexiblePart):
                self.flexible.append(part)
                if part.body.reason and (item["entry"], part.body.reason) not in self.by_lines:  # several pieces of a body have one entry
                    self.by_lines.append((item["entry"], part.body.reason))
                point = part.body.points.mean(axis=0)
            else:
                self.parts.append(part)
                point = part.mesh.points[part.mesh.bones == 0].mean(axis=0)
            if part.entry not in known:
                self.anchors.append(Anchor(part.entry, part, 0, point))
                known.add(part.entry)

    def _planar(self):
        """The axis along which no node moves and about which alone nodes turn."""
        rows, turning = self._samples(), np.zeros(3)
        moving = np.zeros(3)
        for name in self.results.names("nodes"):
            try:
                x, q = (values[rows] for values in self.motion_of_nodes.node(name))
            except InputError:
                continue
            known = np.isfinite(x).all(axis=1) & np.isfinite(q).all(axis=1)
            if known.any():
                moving = np.maximum(moving, np.ptp(x[known], axis=0))
                turning = np.maximum(turning, np.abs(product(q[known], conjugate(q[known][:1]))[:, 1:]).max(axis=0))
        if not moving.any() and not turning.any():
            return None
        for axis in range(3):
            others = [k for k in range(3) if k != axis]
            if moving[axis] <= 1e-6 * self.size and max(turning[k] for k in others) <= 1e-5 and moving[others].min() + turning[axis] > 1e-4 * self.size \
                    and (moving[others] > 1e-6 * self.size).all():
                return axis
        return None


def _symbol_size(extent, joints, radii, half_widths):
    """Two hundredths of the machine, less where neighbours are close or wheels are small; up to a half less where beams are thin."""
    size = min([0.02 * extent, *([0.35 * float(np.median(radii))] if radii else []),
                *([max(0.01 * extent, 1.2 * float(np.median(half_widths)))] if half_widths else [])])
    if len(joints) > 1:
        from scipy.spatial import cKDTree
        joints = np.unique(np.round(joints / extent, 6), axis=0) * extent
        if len(joints) > 1:
            distance = cKDTree(joints).query(joints, k=2)[0][:, 1]
            size = min(size, 0.3 * float(np.quantile(distance, 0.3)))
    return max(size, 0.0008 * extent)


def _reason(error):
    if isinstance(error, KeyError):
        return f"its key {error} is missing"
    text = str(error)
    return text[:1].lower() + text[1:] if text else "it is damaged"

