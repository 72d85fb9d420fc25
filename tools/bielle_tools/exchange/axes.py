"""Matrices in axes of the body, for formats whose nodes have no axes of their own."""

from dataclasses import replace

import numpy as np
import scipy.sparse

from ..messages import InputError
from .matrix_set import sparse
from .recovery import with_columns


def in_body_axes(matrices):
    """The same body with unknowns in axes of the body. @raises InputError when a turned node lacks some of its unknowns"""
    if matrices.axes is None:
        return matrices
    T = _turn(matrices)
    turned = {name: sparse(T @ getattr(matrices, name) @ T.T) for name in ("stiffness", "mass", "damping", "geometric_stiffness")
              if getattr(matrices, name) is not None}
    back = T.T.toarray()
    if matrices.inertia_components is not None:
        turned["inertia_components"] = np.einsum("ia,kij,jb->kab", back, matrices.inertia_components, back)
    if matrices.shapes is not None:
        shapes = matrices.shapes
        turned["shapes"] = replace(shapes, **{name: getattr(shapes, name) @ back for name in ("displacement", "rotation", "stress")
                                              if getattr(shapes, name) is not None})
    return replace(matrices, axes=None, quantities=with_columns(matrices.quantities, back), **turned)


def _turn(matrices):
    """Matrix T with u_body = T u."""
    T = scipy.sparse.identity(matrices.size, format="lil")
    place = {(node, component): row for row, (node, component) in
             enumerate(zip(matrices.unknown_nodes.tolist(), matrices.unknown_components.tolist()))}
    for node, axes in enumerate(matrices.axes):
        if np.abs(axes - np.eye(3)).max() < 1e-14:
            continue
        for begin in (0, 3):
            rows = [place.get((node, begin + k)) for k in range(3)]
            if all(row is None for row in rows):
                continue
            if any(row is None for row in rows):
                raise InputError(f"node {matrices.numbers[node]} has axes of its own and lacks some of its three "
                                 f"{'rotations' if begin else 'displacements'}: this format has body axes only")
            for i in range(3):
                for j in range(3):
                    T[rows[i], rows[j]] = axes[i, j]
    return sparse(T)
