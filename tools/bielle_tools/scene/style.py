"""Colours and sizes."""

from dataclasses import dataclass

BODIES = ("#5b84b1", "#d98c4a", "#6aa56f", "#b3687f", "#8a7bb8", "#c9b04d", "#4f9ba3", "#a77b5a", "#7f93a8", "#9aaa4e")
COLOURS = {"outer": "#5c6a7c", "inner": "#d5d9de", "spring": "#3f9b62", "damper": "#707884", "rod": "#d3d7dc", "rope": "#6e5638",
           "node": "#20242a", "support": "#8b8f96", "ground": "#9aa3ad", "contact": "#d9a441", "force": "#cf3d3d", "mark": "#2d3138",
           "bar": "#8791a0", "stiffness": "#3f9b62", "marked": "#d3262f"}
MARKED = 0.65  # share of the colour of marks


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


def marked(colour):
    """`#rrggbb` of a part with a gap or with redundant constraints in a model that is only assembled."""
    return "#" + "".join(f"{round((1 - MARKED) * int(colour[k:k + 2], 16) + MARKED * int(COLOURS['marked'][k:k + 2], 16)):02x}" for k in (1, 3, 5))


def lighter(colour, share=0.45):
    """`#rrggbb` mixed with white; a negative share mixes with black."""
    target = 255 if share > 0 else 0
    return "#" + "".join(f"{round(int(colour[k:k + 2], 16) * (1 - abs(share)) + target * abs(share)):02x}" for k in (1, 3, 5))
