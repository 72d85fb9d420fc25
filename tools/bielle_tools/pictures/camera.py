"""The camera: its direction, and the shortest distance at which the whole motion stays in the picture."""

import numpy as np

VIEWS = {  # rows: right, up; the viewer looks from right x up
    "x": ([0, 1, 0], [0, 0, 1]), "y": ([-1, 0, 0], [0, 0, 1]), "z": ([1, 0, 0], [0, 1, 0]),
    "-x": ([0, -1, 0], [0, 0, 1]), "-y": ([1, 0, 0], [0, 0, 1]), "-z": ([-1, 0, 0], [0, 1, 0]),
}
OBLIQUE = "iso"
TOWARDS = (0.58, -0.72, 0.38)  # the viewer of the oblique view
ANGLE = np.deg2rad(24)         # of the picture's height in perspective: little distortion
MARGIN = 0.04                  # of the picture, on each side
SLOPE = float(np.tan(ANGLE / 2)) * (1 - 2 * MARGIN)  # between the middle and the edge of what has to be seen, in perspective
ASPECTS = np.array([0, 0.25, 0.5, 1, 1.5, 2, 3, 6, 12, 100])


def view_axes(view, normal=None):
    """(3,3): right, up, towards the viewer. view: one of VIEWS or OBLIQUE; None: obliquely, or along the normal (0, 1,
    2: an inertial axis) of a motion in a plane."""
    if view is None and normal is not None:
        view = ("x", "-y", "z")[normal]
    if view in VIEWS:
        right, up = (np.array(axis, float) for axis in VIEWS[view])
        return np.array([right, up, np.cross(right, up)])
    towards = np.array(TOWARDS) / np.linalg.norm(TOWARDS)
    right = np.cross([0, 0, 1], towards)
    right /= np.linalg.norm(right)
    return np.array([right, np.cross(towards, right), towards])


class Extent:
    """Bounds of everything that is to be seen: `low` and `high` (3) in view axes [m], and, for a perspective, how far points
    reach across lines that converge to the eye."""

    def __init__(self, axes):
        """axes: view_axes"""
        self.axes = axes
        self.low, self.high = np.full(3, np.inf), np.full(3, -np.inf)
        self._across = np.full((4, len(ASPECTS)), -np.inf)  # largest x + t z, -x + t z, y + t z, -y + t z, t = ASPECTS * SLOPE

    def include(self, points):
        """Adds inertial points (n,3). Those that are no numbers are left out."""
        seen = np.asarray(points, float) @ self.axes.T
        seen = seen[np.isfinite(seen).all(axis=1)]
        if not len(seen):
            return
        self.low, self.high = np.minimum(self.low, seen.min(axis=0)), np.maximum(self.high, seen.max(axis=0))
        x, y, z = seen.T
        for k, aspect in enumerate(ASPECTS):
            towards = aspect * SLOPE * z
            self._across[:, k] = np.maximum(self._across[:, k], [(towards + x).max(), (towards - x).max(), (towards + y).max(),
                                                                 (towards - y).max()])

    def across(self, aspect):
        """(4) the largest x + t z, -x + t z, y + t z and -y + t z for t = aspect SLOPE; or a little more, since they are
        convex functions of t and interpolated."""
        return np.array([np.interp(aspect, ASPECTS, row) for row in self._across])

    @property
    def known(self):
        return bool(np.isfinite(self.low).all())

    @property
    def aspect(self):
        """Height over width."""
        width, height = np.maximum((self.high - self.low)[:2], 1e-9 * np.ptp([self.low, self.high]) + 1e-30)
        return float(height / width)


class Camera:
    """Projects points to pixels, as VTK's camera with the same numbers does.

    axes (3,3): right, up, towards the viewer; size: width and height of the picture in pixels; flat: parallel projection;
    focus (3): the inertial point in the middle [m]; half: half the height of what is seen at the focus [m]; distance of the
    eye from the focus [m].
    """

    def __init__(self, extent, size, flat):
        """extent: an Extent with points in it"""
        self.axes, self.size, self.flat = extent.axes, size, flat
        ratio = size[0] / size[1]
        smallest = 1e-10 * max(float(np.abs([extent.low, extent.high]).max()), 1e-9)
        middle = 0.5 * (extent.low + extent.high)
        self.depth = max(float(extent.high[2] - extent.low[2]), smallest)
        if flat:
            width, height, _ = np.maximum(extent.high - extent.low, smallest)
            self.half = float(max(height, width / ratio) / (2 * (1 - 2 * MARGIN)))
            self.distance = 2 * self.depth + 4 * self.half
        else:
            right, left = extent.across(ratio)[:2]
            up, down = extent.across(1)[2:]
            middle[:2] = 0.5 * (right - left), 0.5 * (up - down)
            eye = max((right + left) / (2 * SLOPE * ratio), (up + down) / (2 * SLOPE))
            self.distance = float(max(eye - middle[2], 0.51 * self.depth + smallest))
            self.half = float(self.distance * np.tan(ANGLE / 2))
        self.focus = self.axes.T @ middle

    def seen(self, points, moved=0.0):
        """(n,3) right, up and towards the viewer from the focus, in units of `half`. moved (3): how far the camera has
        followed a node [m]."""
        return (points - (self.focus + moved)) @ (self.axes.T / self.half)

    def pixels(self, points, moved=0.0):
        """(n,2) right and down from the upper left corner, of inertial points (n,3). moved: as in `seen`"""
        x, y, z = self.seen(np.atleast_2d(points), moved).T
        width, height = self.size
        scale = height / 2 * (1.0 if self.flat else self.distance / (self.distance - self.half * z))
        return np.column_stack([width / 2 + scale * x, height / 2 - scale * y])

    def place(self, camera):
        """Sets a vtkCamera that looks at points as `seen` gives them: float numbers of any model are then about 1."""
        distance, room = self.distance / self.half, self.depth / self.half + 1
        camera.SetFocalPoint(0, 0, 0)
        camera.SetPosition(0, 0, distance)
        camera.SetViewUp(0, 1, 0)
        camera.SetParallelProjection(self.flat)
        camera.SetParallelScale(1)
        camera.SetViewAngle(np.rad2deg(ANGLE))
        camera.SetClippingRange(max(distance - room, 1e-3 * distance), distance + room)
