"""Colours of stresses in pictures and pages: pale to dark, so that shading shows on them, and so does the order without colours, as in print."""

import numpy as np

# ColorBrewer's YlOrRd of nine classes (Brewer and Harrower, 2002), interpolated between them. Its lightness falls throughout.
ANCHORS = np.array([[255, 255, 204], [255, 237, 160], [254, 217, 118], [254, 178, 76], [253, 141, 60], [252, 78, 42], [227, 26, 28],
                    [189, 0, 38], [128, 0, 38]], float)
UNKNOWN = (150, 160, 170)  # nodes without stress


def stress_colours(share):
    """(...,3) uint8: colours of stresses as shares of the largest; UNKNOWN for values that are no numbers."""
    known = np.isfinite(share)
    at = np.clip(np.where(known, share, 0), 0, 1)
    places = np.linspace(0, 1, len(ANCHORS))
    table = np.stack([np.interp(at, places, ANCHORS[:, k]) for k in range(3)], axis=-1)
    return np.where(known[..., None], np.rint(table), UNKNOWN).astype(np.uint8)


def hexadecimal(colour):
    """`#rrggbb` of three numbers up to 255."""
    return "#" + "".join(f"{int(share):02x}" for share in colour)
