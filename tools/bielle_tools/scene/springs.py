"""Springs, dampers and jacks of a drawing, for the table BUILDERS. b: the Builder."""

import numpy as np

from . import templates as t
from .drawing import positive
from .links import coil_mesh, telescope
from .parts import Mesh, Part
from .style import COLOURS


def coil_radius(b, item):
    """Radius of a coil [m]: that of symbols, or less if it is short."""
    length = np.nan_to_num(b.ends(item).lengths()[1]) or b.symbol
    return min(0.75 * b.symbol, 0.2 * length)


def coil(b, item):
    """The part of a coil between its ends."""
    ends, radius = b.ends(item), coil_radius(b, item)
    length = np.nan_to_num(ends.lengths()[1]) or b.symbol
    return b.link(item, coil_mesh(radius, min(0.13 * b.symbol, 0.35 * length / 8), length), COLOURS["spring"])


def telescopic(b, item, radius=None):
    """Parts of a damper or jack: barrel and rod."""
    ends = b.ends(item)
    shortest, longest = ends.lengths()
    shortest = float(item["stroke"][0]) if item.get("stroke") else shortest
    shortest, _ = positive(shortest, longest) if np.isfinite([shortest, longest]).all() and shortest > 0 else (b.symbol, b.symbol)
    radius = float(item.get("radius", radius or 0.5 * b.symbol))
    barrel = 0.82 * shortest
    mesh = telescope(min(radius, 0.3 * shortest), barrel)
    dark = mesh.bones == 0
    poses = ends.telescopic(barrel)
    group = "spring"

    def part(selected, colour):
        numbers = np.flatnonzero(selected)
        index = np.full(len(mesh.points), -1)
        index[numbers] = np.arange(len(numbers))
        triangles = index[mesh.triangles[selected[mesh.triangles[:, 0]]]]
        first = mesh.bones[numbers].min()
        last = mesh.bones[numbers].max() + 1
        return Part(item["entry"], item["type"], Mesh(mesh.points[numbers], triangles, t.NO_LINES, mesh.bones[numbers] - first),
                    colour, float(item.get("opacity", 1)), group, lambda rows: poses(rows)[:, first:last])
    return [part(dark, b.colour(item, COLOURS["damper"])), part(~dark, COLOURS["rod"])]
