"""Items of a drawing -> parts of the scene: one function per shape, in the table BUILDERS."""

import numpy as np

from ..messages import counted
from ..results.quaternions import conjugate, from_z, rotated
from . import symbols
from . import templates as t
from .beams import beam_mesh, beam_motion, beam_rest, beam_stress, turns_of
from .couplings import coupling, rack
from .course import Course
from .cuts import solid_mesh
from .drawing import place_of, positive
from .links import Ends, bar_mesh, rope_mesh
from .parts import Part, on_bones
from .springs import coil, coil_radius, telescopic
from .style import COLOURS, lighter, visible
from .transforms import between


class Builder:
    """Makes the parts of items. symbol: size of symbols [m]; extent: of the scene [m]; centre (3) of it."""

    def __init__(self, motion, drawing, palette, flexible):
        self.motion, self.drawing, self.palette, self.flexible = motion, drawing, palette, flexible
        self.symbol, self.extent, self.centre = 1.0, 1.0, np.zeros(3)
        self.planes = []  # DrawnPlanes
        self.notes = []  # [(entry, what of it is not drawn)]
        self.around = 24  # corners of symbols around an axis
        self.attached = {}  # node -> positions in its axes of what is attached to it
        self.covered = {}  # node -> (entry, type, low (3), high (3)): boxes of its shapes in its axes

    def parts(self, item):
        """@raises InputError, ValueError, KeyError, TypeError"""
        return BUILDERS[item["shape"]](self, item)

    def rigid(self, item, mesh, group="body", colour=None, place=None, opacity=1.0):
        """A part on one place."""
        place = place or place_of(item)
        self.motion.node(place.node)
        if item.get("role") == "contact":
            group, opacity = "contact", min(opacity, 0.5)
        elif item.get("role") == "support":
            group = "ground"
        elif group == "body" and place.node != "ground":
            points = np.array(place.position) + rotated(np.array(place.rotation), mesh.points)
            self.covered.setdefault(place.node, []).append((item["entry"], item["type"], points.min(axis=0), points.max(axis=0)))
        colour = self.colour(item, colour or (COLOURS["ground"] if place.node == "ground" else self.palette.of(place.node)))
        return Part(item["entry"], item["type"], mesh, colour, float(item.get("opacity", opacity)), group,
                    lambda rows: self.motion.poses(place, rows)[:, None])

    @staticmethod
    def colour(item, default):
        given = item.get("colour", "")
        try:
            return visible(given) if len(given) == 7 and given[0] == "#" and int(given[1:], 16) >= 0 else default
        except (TypeError, ValueError):
            return default

    def link(self, item, mesh, colour, group="spring"):
        ends = self.ends(item)
        return Part(item["entry"], item["type"], mesh, self.colour(item, colour), float(item.get("opacity", 1)), group, ends.straight)

    def ends(self, item):
        places = [place_of(end) for end in item["ends"]]
        if len(places) != 2:
            raise ValueError("it has not two ends")
        for place in places:
            self.motion.node(place.node)
        return Ends(self.motion, places)


def _body(b, item):
    centre = np.asarray(item.get("centre", [0, 0, 0]), float)
    ends = np.array(b.attached.get(item["node"], [])).reshape(-1, 3)
    ends = ends[np.linalg.norm(ends - centre, axis=1) > 0.6 * b.symbol]
    thin = max(0.42 * b.symbol, 0.012 * max(np.linalg.norm(ends - centre, axis=1), default=0))
    pieces = [t.rod(centre, end, (thin, 0.62 * thin), b.around // 3 + 2) for end in np.unique(np.round(ends, 12), axis=0)]
    return [b.rigid(item, t.merged([t.moved(t.sphere(1.25 * thin if len(pieces) else 0.6 * b.symbol, b.around // 3 + 2, b.around // 2 + 4), centre), *pieces]))]


def _gear(b, item):
    radius, = positive(item["radius"])
    width, = positive(item.get("width", 0.22 * radius))
    inner = bool(item.get("inner"))
    body = t.tube(1.18 * radius, radius, width, 48) if inner else \
        t.merged([t.tube(radius, 0.82 * radius, width, 48), t.cylinder(0.82 * radius, 0.55 * width), t.cylinder(0.25 * radius, 1.15 * width)])
    mark = t.moved(t.box([0.12 * radius, 0.07 * radius, 1.04 * width]), (1.09 * radius if inner else 0.91 * radius, 0, 0))
    return [b.rigid(item, body), b.rigid(item, mark, colour=COLOURS["mark"])]


def _pulley(b, item):
    radius, = positive(item["radius"])
    width = float(item.get("width", min(0.4 * radius, 1.2 * b.symbol)))
    h, groove = width / 2, min(0.12 * radius, 0.4 * width)
    rim = t.lathe([(0, -h), (radius + groove, -h), (radius + groove, -0.8 * h), (radius, -0.35 * h), (radius, 0.35 * h),
                   (radius + groove, 0.8 * h), (radius + groove, h), (0, h)], around=40)
    mark = t.moved(t.box([0.5 * radius, 0.1 * radius, 1.06 * width]), (0.6 * radius, 0, 0))
    return [b.rigid(item, rim), b.rigid(item, mark, colour=COLOURS["mark"])]


def _tyre(b, item):
    radius, = positive(item["radius"])
    width, = positive(item.get("width", 0.45 * radius))
    rim = t.merged([t.tube(0.68 * radius, 0.6 * radius, 0.7 * width, 36), t.cylinder(0.62 * radius, 0.12 * width, 36), t.cylinder(0.16 * radius, 0.5 * width)]
                   + [t.moved(t.box([0.46 * radius, 0.12 * radius, 0.3 * width]), (0.38 * radius * x, 0.38 * radius * y, 0), [[x, -y, 0], [y, x, 0], [0, 0, 1]])
                      for x, y in t.circle(5)])
    return [b.rigid(item, t.torus(radius, 0.36 * radius, width), colour="#2f3237"), b.rigid(item, rim, colour="#b9bec5")]


def _cam(b, item):
    contour = np.asarray(item["contour"], float).reshape(-1, 2)
    reach = np.linalg.norm(contour, axis=1).max()
    return [b.rigid(item, t.extruded(contour, float(item.get("width", 0.3 * reach))))]


def _plane(b, item):
    place, own = place_of(item), next((plane for plane in b.planes if plane.item is item), None)
    if own is None:
        return []  # another entry has the same plane
    alone = len(b.planes) < 2
    size = float(np.max(item["size"])) if "size" in item else 1.15 * b.extent if alone else min([0.15 * b.extent, *own.distances(b.planes, b.extent)])
    shift = np.zeros(3)
    if "size" not in item and alone and place.node == "ground":  # the part of the plane under the machine
        shift = rotated(conjugate(np.array(place.rotation)), b.centre - np.array(place.position)) * [1, 1, 0]
    h, n = size / 2, 14
    quad = t.mesh([[-h, -h, 0], [h, -h, 0], [h, h, 0], [-h, h, 0]], [[0, 1, 2], [0, 2, 3]])
    s = np.linspace(-2 * h, 2 * h, 2 * n + 1)[1:-1]
    a = np.column_stack([np.maximum(s - h, -h), np.minimum(s + h, h), np.zeros_like(s)])
    c = np.column_stack([np.minimum(s + h, h), np.maximum(s - h, -h), np.zeros_like(s)])
    border = np.array([[-h, -h, 0], [h, -h, 0], [h, h, 0], [-h, h, 0]])
    hatch = t.mesh(np.concatenate([a, c, border]), lines=[[k, k + len(s)] for k in range(len(s))]
                   + [[2 * len(s) + k, 2 * len(s) + (k + 1) % 4] for k in range(4)])
    return [b.rigid(item, t.moved(t.merged([quad, hatch]), shift), "ground", COLOURS["ground"], opacity=0.16)]


def _curve(b, item):
    points = np.asarray(item["points"], float).reshape(-1, 3)
    if item.get("closed"):
        points = np.vstack([points, points[:1]])
    return [b.rigid(item, t.polyline(points, 0.14 * b.symbol), colour=COLOURS["bar"])]


def _course(b, item):
    points = [(place_of(point), float(point.get("radius", 0)), 1 if point.get("side", 1) >= 0 else -1) for point in item["points"]]
    for place, _, _ in points:
        b.motion.node(place.node)
    course = Course(b.motion, points, bool(item.get("closed")))
    return [Part(item["entry"], item["type"], on_bones(rope_mesh(0.16 * b.symbol), course.bone_count), b.colour(item, COLOURS["rope"]),
                 1.0, "rope", course.poses)]


def _beam(b, item):
    turns = turns_of(item)
    poses, stations = beam_motion(b.motion.results, item["element"], turns)
    mesh, elements = beam_mesh(stations, list(item.get("sections") or []), 0.3 * b.symbol)
    stress = beam_stress(b.motion.results, item["element"])
    return [Part(item["entry"], item["type"], mesh, b.colour(item, b.palette.of(item["element"])), float(item.get("opacity", 1)), "beam", poses, stress, elements,
                 beam_rest(b.motion.results, item["element"], turns))]


def _superelement(b, item):
    if not b.flexible.has_rows:
        return []
    name = item["element"].split("/", 1)[1]
    return [b.flexible.part(name, item["type"], b.colour(item, b.palette.of(item["entry"])), float(item.get("opacity", 1)), b.symbol)]


def _joint(b, item):
    places = [place_of(frame) for frame in item["frames"]]
    if len(places) != 2:
        raise ValueError("it has not two frames")
    meshes = symbols.joint_symbol(item["type"], b.symbol, b.around)
    parts = [b.rigid(item, mesh, "joint", colour, place) for mesh, place, colour in zip(meshes, places, (COLOURS["outer"], COLOURS["inner"])) if mesh]
    if item.get("colour"):
        parts[-1].colour = lighter(b.colour(item, COLOURS["inner"]))
    return parts


def _support(b, item):
    fixed, place = item.get("fixed", []), place_of(item)
    if any(direction in fixed for direction in "xyz"):
        down = b.drawing.gravity
        mesh, turn = symbols.support_symbol(b.symbol, len(fixed) == 6), from_z(-down) if down is not None else np.array([1.0, 0, 0, 0])
    else:
        rotations = tuple(direction for direction in ("rx", "ry", "rz") if direction in fixed)
        if len(rotations) not in (1, 2):
            return []  # a node that may move everywhere and only keeps its direction has no support
        mesh, turn = symbols.held_rotations_symbol(b.symbol, rotations), np.asarray(item.get("axes", [1, 0, 0, 0]), float)
        if turn.shape != (4,) or not np.isfinite(turn).all() or not np.linalg.norm(turn) > 0:
            raise ValueError("its axes are damaged")
        turn = turn / np.linalg.norm(turn)
    part = b.rigid(item, mesh, "ground", COLOURS["support"])

    def poses(rows):
        found = b.motion.poses(place, rows)[:, None]
        found[..., 3:7] = turn
        return found
    part.motion = poses
    return [part]


def _stiffness(b, item):
    places = [place_of(place) for place in item["places"]]
    for place in places:
        b.motion.node(place.node)
    if len(places) < 2:
        raise ValueError("it joins fewer than two places")
    return [Part(item["entry"], item["type"], on_bones(rope_mesh(0.08 * b.symbol), len(places) - 1), b.colour(item, COLOURS["stiffness"]), 1.0, "spring",
                 lambda rows: np.stack([between(b.motion.position(places[0], rows), b.motion.position(place, rows)) for place in places[1:]], axis=1))]


def _mesh(b, item):
    points, triangles = b.drawing.mesh(item["mesh"])
    return [b.rigid(item, t.creased(points, triangles))]


def _solid(b, item):
    mesh, left_out = solid_mesh(item, b.drawing.cuts.get(item["entry"], []))
    if left_out:
        b.notes.append((item["entry"], f"{counted(left_out, 'cut')} across its axis, over its edge, or of another shape than a hole or a pocket"))
    return [b.rigid(item, mesh)]


def _ellipsoid(b, item):
    return [b.rigid(item, t.mesh(item["points"], item["triangles"]))]


BUILDERS = {
    "box": _solid, "cylinder": _solid, "tube": _solid,
    "cone": lambda b, item: [b.rigid(item, t.cone([float(r) for r in item["radii"]], *positive(item["length"]), 36))],
    "sphere": lambda b, item: [b.rigid(item, t.sphere(*positive(item["radius"]), 16, 32))],
    "mesh": _mesh, "ellipsoid": _ellipsoid, "gear": _gear, "pulley": _pulley, "tyre": _tyre, "cam": _cam, "plane": _plane, "curve": _curve,
    "body": _body, "support": _support, "joint": _joint, "stiffness": _stiffness, "coupling": coupling, "rack": rack, "beam": _beam, "superelement": _superelement, "course": _course,
    "node": lambda b, item: [b.rigid(item, t.sphere(0.28 * b.symbol, b.around // 4, b.around // 2), "node", COLOURS["node"])],
    "bar": lambda b, item: [b.link(item, bar_mesh(float(item.get("radius", 0.3 * b.symbol))), COLOURS["bar"], "body")],
    "rope": lambda b, item: [b.link(item, rope_mesh(0.16 * b.symbol), COLOURS["rope"], "rope")],
    "coil": lambda b, item: [coil(b, item)],
    "damper": telescopic, "jack": telescopic,
    "coil_damper": lambda b, item: [coil(b, item), *telescopic(b, item, 0.5 * coil_radius(b, item))],
    "force": lambda b, item: [b.rigid(item, t.octahedron(0.4 * b.symbol), "force", COLOURS["force"])],
}
