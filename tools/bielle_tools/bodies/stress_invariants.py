"""Scalars of stress tensors."""

import numpy as np


def von_mises(stress):
    """Equivalent stress (...) of the components (...,6) xx yy zz yz xz xy, in their unit."""
    xx, yy, zz, yz, xz, xy = np.moveaxis(stress, -1, 0)
    return np.sqrt(0.5 * ((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) + 3 * (yz ** 2 + xz ** 2 + xy ** 2))


def distortion(stress):
    """Linear combinations (...,5) of the components (...,6): the sum of their squares is the square of the von Mises stress.

    The largest of many superposed stresses is found by products of matrices and squares of these."""
    xx, yy, zz, *shears = np.moveaxis(stress, -1, 0)
    root = np.sqrt(3.0)
    return np.stack([0.5 * (xx + yy) - zz, 0.5 * root * (xx - yy), *(root * shear for shear in shears)], axis=-1)
