"""Colours of stresses: pale to dark, so that shading shows on them, and so does the order without colours."""

import numpy as np

# ColorBrewer's YlOrRd of nine classes (Brewer and Harrower, 2002), interpolated between them.
ANCHORS = np.array([[255, 255, 204], [255, 237, 160], [254, 217, 118], [254, 178, 76], [253, 141, 60], [252, 78, 42], [227, 26, 28],
                    [189, 0, 38], [128, 0, 38]], float)
DARKEST = 0.13
UNKNOWN = (150, 160, 170)  # nodes without stress


def stress_colours(share):
    """(n,3) uint8: colours of stresses as shares of the largest; UNKNOWN for values that are no numbers."""
    known = np.isfinite(share)
    at = np.clip(np.where(known, share, 0), 0, 1)
    places = np.linspace(0, 1, len(ANCHORS))
    table = np.stack([np.interp(at, places, ANCHORS[:, k]) for k in range(3)], axis=-1)
    return np.where(known[..., None], np.rint(table), UNKNOWN).astype(np.uint8)


def rgb(colour):
    """`#rrggbb` -> three shares of 1, not so dark that shading does not show."""
    number = int(colour[1:], 16)
    return tuple(max((number >> shift & 255) / 255, DARKEST) for shift in (16, 8, 0))


def muted(colour):
    """A colour of a part (3 shares of 1) beside coloured stresses: nearly grey, so that it is not read as a stress."""
    grey = 0.30 * colour[0] + 0.59 * colour[1] + 0.11 * colour[2]
    return tuple(0.3 * share + 0.7 * (0.75 * grey + 0.2) for share in colour)
