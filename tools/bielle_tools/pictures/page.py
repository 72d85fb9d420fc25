"""Texts around a drawing: title and time above it, the colours of stresses below it, labels on it."""

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from ..messages import InputError, installation
from ..scene.stress_scale import stress_colours

INK, QUIET = (30, 33, 38), (95, 102, 112)


class Paper:
    """Draws strips of texts in one size of letters."""

    def __init__(self, size):
        """size: of letters in pixels"""
        self.size, self.plain, self.bold = size, _font(size, False), _font(size, True)

    @property
    def line(self):
        """Height of a strip with one line in pixels."""
        return 2 * self.size

    def heading(self, width, title, moment):
        """A strip with a title on the left and a time on the right."""
        strip, draw = _strip(width, self.line)
        middle, gap = self.line / 2, self.size
        room = width - 2 * gap - (draw.textlength(moment, self.plain) + gap if moment else 0)
        draw.text((width - gap, middle), moment, QUIET, self.plain, anchor="rm")
        draw.text((gap, middle), _shortened(draw, title, self.bold, room), INK, self.bold, anchor="lm")
        return strip

    def lines(self, sentences, width):
        """Sentences as lines that a picture of this width has room for."""
        _, draw = _strip(1, 1)
        found = []
        for sentence in sentences:
            line = ""
            for word in sentence.split():
                if line and draw.textlength(f"{line} {word}", self.plain) > width - 2 * self.size:
                    found.append(line)
                    line = ""
                line = f"{line} {word}".strip()
            found.append(_shortened(draw, line, self.plain, width - 2 * self.size))
        return found

    def written(self, width, lines):
        """A list of one strip with lines, empty without any."""
        if not lines:
            return []
        strip, draw = _strip(width, self.line * len(lines) * 3 // 4)
        for k, line in enumerate(lines):
            draw.text((self.size, (k + 0.5) * self.line * 3 / 4), line, INK, self.plain, anchor="lm")
        return [strip]

    def bar(self, width, highest, label):
        """A strip with the colours of stresses from 0 on the left to `highest` [MPa] on the right."""
        strip, draw = _strip(width, self.line)
        left, right = self.bar_ends(width)
        top, bottom = self.size // 2, self.line - self.size // 2
        colours = stress_colours(np.linspace(0, 1, right - left))
        strip.paste(Image.fromarray(np.broadcast_to(colours, (bottom - top, *colours.shape)).copy()), (left, top))
        draw.rectangle((left - 1, top - 1, right, bottom), outline=QUIET)
        middle = self.line / 2
        draw.text((left - self.size // 2, middle), f"{label}  0", INK, self.plain, anchor="rm")
        draw.text((right + self.size // 2, middle), f"{highest:.0f}" if 1e3 <= highest < 1e6 else f"{highest:.3g}", INK, self.plain, anchor="lm")
        return strip

    def bar_ends(self, width):
        """First pixel of the colours, and the first one after them."""
        return int(0.45 * width), int(width - 7 * self.size) if width > 20 * self.size else int(0.8 * width)

    def write_labels(self, picture, texts, pixels):
        """Writes texts next to points (n,2) of a picture, those further up first; one that would cover another is left out."""
        draw, taken = ImageDraw.Draw(picture), []
        for text, (x, y) in sorted(zip(texts, pixels), key=lambda pair: tuple(pair[1][::-1])):
            if not (np.isfinite([x, y]).all() and 0 <= x < picture.width and 0 <= y < picture.height):
                continue
            box = draw.textbbox((x + self.size // 2, y), text, self.plain, anchor="lm")
            if all(box[2] < other[0] or box[0] > other[2] or box[3] < other[1] or box[1] > other[3] for other in taken):
                taken.append(box)
                draw.text(box[:2], text, INK, self.plain, anchor="lt", stroke_width=max(1, self.size // 8), stroke_fill=(255, 255, 255))


def stacked(pictures):
    """Pictures of one width below one another."""
    whole = Image.new("RGB", (pictures[0].width, sum(each.height for each in pictures)), "white")
    top = 0
    for each in pictures:
        whole.paste(each, (0, top))
        top += each.height
    return whole


def side_by_side(pictures, columns):
    """Pictures of one size in lines of `columns`, or of fewer if there are no more; four in a square."""
    columns = 2 if len(pictures) == 4 else min(columns, len(pictures))
    width, height = pictures[0].size
    whole = Image.new("RGB", (width * columns, height * -(-len(pictures) // columns)), "white")
    for k, each in enumerate(pictures):
        whole.paste(each, (width * (k % columns), height * (k // columns)))
    return whole


def _strip(width, height):
    strip = Image.new("RGB", (width, height), "white")
    return strip, ImageDraw.Draw(strip)


def _shortened(draw, text, font, room):
    """The text, or as much of it as there is room for, with three dots."""
    text = " ".join(text.split())
    if draw.textlength(text, font) <= room:
        return text
    while text and draw.textlength(text + " ...", font) > room:
        text = text[:-1]
    return text + " ..." if text else ""


def _font(size, bold):
    try:
        return ImageFont.truetype(f"DejaVuSans{'-Bold' if bold else ''}.ttf", size)
    except OSError:
        raise InputError("drawing needs the letters DejaVu Sans (Debian package fonts-dejavu-core): run "
                         + installation("fonts-dejavu-core")) from None
