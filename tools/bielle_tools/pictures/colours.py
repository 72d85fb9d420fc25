"""Colours of parts in pictures."""

DARKEST = 0.13


def rgb(colour):
    """`#rrggbb` -> three shares of 1, not so dark that shading does not show."""
    number = int(colour[1:], 16)
    return tuple(max((number >> shift & 255) / 255, DARKEST) for shift in (16, 8, 0))


def muted(colour):
    """A colour of a part (3 shares of 1) beside coloured stresses: nearly grey, so that it is not read as a stress."""
    grey = 0.30 * colour[0] + 0.59 * colour[1] + 0.11 * colour[2]
    return tuple(0.3 * share + 0.7 * (0.75 * grey + 0.2) for share in colour)
