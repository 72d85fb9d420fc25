"""Colours and sizes."""

from dataclasses import dataclass

BODIES = ("#5b84b1", "#d98c4a", "#6aa56f", "#b3687f", "#8a7bb8", "#c9b04d", "#4f9ba3", "#a77b5a", "#7f93a8", "#9aaa4e")
COLOURS = {"outer": "#5c6a7c", "inner": "#d5d9de", "spring": "#3f9b62", "damper": "#707884", "rod": "#d3d7dc", "rope": "#6e5638",
           "node": "#20242a", "support": "#8b8f96", "ground": "#9aa3ad", "contact": "#d9a441", "force": "#cf3d3d", "mark": "#2d3138",
           "bar": "#8791a0", "coupling": "#b08d3c", "stiffness": "#3f9b62", "marked": "#d3262f"}
MARKED = 0.65  # share of the colour of marks
DARKEST = 33  # least share of red, green and blue, up to 255: shading does not show on darker colours


@dataclass
class Style:
    """symbols: factor of the size of all symbols; unit: colours of bodies in turn."""
    symbols: float = 1.0
    bodies: tuple = BODIES


class Palette:
    """Gives every body (a node, or a flexible element) a colour of its own, in the order in which they are asked for."""

    def __init__(self, style):
        self.style, self._given = style, {}

    def of(self, body):
        if body not in self._given:
            self._given[body] = self.style.bodies[len(self._given) % len(self.style.bodies)]
        return self._given[body]


def visible(colour):
    """`#rrggbb`, not so dark that shading does not show."""
    return _hexadecimal([max(share, DARKEST) for share in shares_of(colour)])


def marked(colour):
    """`#rrggbb` of a part with a gap or with redundant constraints in a model that is only assembled."""
    return _mixed(shares_of(colour), shares_of(COLOURS["marked"]), MARKED)


def muted(colour):
    """`#rrggbb` of a part next to coloured stresses: nearly grey, so that it is not read as a stress."""
    red, green, blue = shares_of(colour)
    return _mixed((red, green, blue), [0.75 * (0.30 * red + 0.59 * green + 0.11 * blue) + 51] * 3, 0.88)


def lighter(colour, share=0.45):
    """`#rrggbb` mixed with white."""
    return _mixed(shares_of(colour), (255, 255, 255), share)


def _mixed(first, second, share):
    return _hexadecimal([(1 - share) * a + share * b for a, b in zip(first, second)])


def shares_of(colour):
    """Red, green and blue of `#rrggbb`, up to 255."""
    return [int(colour[k:k + 2], 16) for k in (1, 3, 5)]


def _hexadecimal(shares):
    return "#" + "".join(f"{round(share):02x}" for share in shares)
