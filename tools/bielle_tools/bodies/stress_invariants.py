"""Scalars of stress tensors."""

import numpy as np


def von_mises(stress):
    """Equivalent stress (...) of the components (...,6) xx yy zz yz xz xy, in their unit."""
    xx, yy, zz, yz, xz, xy = np.moveaxis(stress, -1, 0)
    return np.sqrt(0.5 * ((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) + 3 * (yz ** 2 + xz ** 2 + xy ** 2))
