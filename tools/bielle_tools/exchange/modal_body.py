"""A body given by elastic shapes in a floating frame, as a MatrixSet with unknowns of nodes.

The coordinates q (6 rigid motions about the origin, m amplitudes) become y = A q: displacements and rotations of the
chosen nodes, and as many scalars as remain, orthogonal to them.
"""

from dataclasses import dataclass

import numpy as np
import scipy.linalg

from ..messages import InputError, counted
from .entries import symmetric_part
from .inertia_moments import EPSILON
from .matrix_set import MatrixSet, Shapes, sparse

INDEPENDENT = 1e-9  # smallest singular value of the nodes' motions, relative to the largest


@dataclass
class NodeUnknowns:
    """Unknowns y = A q of chosen nodes: q are rigid motions about the origin, then amplitudes."""

    nodes: np.ndarray       # (n) row of the chosen node, -1: scalar
    components: np.ndarray  # (n)
    inverse: np.ndarray     # (6+m,6+m): q = inverse @ y

    def matrix(self, matrix):
        """K or M of y, of that of q."""
        return symmetric_part(self.inverse.T @ matrix @ self.inverse)


def node_unknowns(motions, mass, names):
    """@param motions: (p,6,6+m) of the chosen nodes as functions of q; mass: (6+m,6+m) of q, for scales; names: for the message
    @raises InputError if the shapes cannot move the nodes independently"""
    count, size = motions.shape[0], motions.shape[2]
    kept = 6 if np.abs(motions[:, 3:, 6:]).max(initial=0) > 0 else 3
    scale = np.sqrt(np.where(np.diag(mass) > 0, np.diag(mass), 1))
    rows = motions[:, :kept].reshape(kept * count, size) / scale
    norms = np.linalg.norm(rows, axis=1)
    told = (f"{counted(kept * count, 'motion')} of the nodes {', '.join(map(str, names))} do not follow from 6 rigid "
            "motions and "
            f"{counted(size - 6, 'shape')}: name fewer nodes (--interfaces), or more shapes are needed")
    if kept * count > size or (norms == 0).any():
        raise InputError(told)
    values = np.linalg.svd(rows / norms[:, None], compute_uv=False)
    if values[-1] < INDEPENDENT * values[0]:
        raise InputError(told)
    rest = scipy.linalg.null_space(rows / norms[:, None], rcond=INDEPENDENT)
    inverse = np.linalg.inv(np.concatenate([rows, rest.T])) / scale[:, None]
    scalars = size - kept * count
    return NodeUnknowns(np.concatenate([np.repeat(np.arange(count), kept), np.full(scalars, -1)]),
                        np.concatenate([np.tile(np.arange(kept), count), np.arange(scalars)]), inverse)


def rigid_rows(points):
    """(p,6,6) motions of places in rigid motions about the origin."""
    rows = np.tile(np.eye(6), (len(points), 1, 1))
    rows[:, :3, 3:] = np.cross(np.eye(3)[None], points[:, None]).transpose(0, 2, 1)
    return rows


def chosen_rows(path, numbers, wanted, most):
    """Rows of the nodes that become interfaces: the wanted ones, or all if they are few. @param most: unknowns
    @raises InputError"""
    if not wanted:
        if 3 * len(numbers) > most:
            raise InputError(f"'{path}': {counted(len(numbers), 'node')} are more than {most - 6} shapes can move: "
                             "name those that become "
                             "interfaces, by --interfaces 12,40 of bielle-exchange or the interfaces of a body file")
        return np.arange(len(numbers))
    place = {int(number): row for row, number in enumerate(numbers)}
    for number in wanted:
        if number not in place:
            raise InputError(f"'{path}': there is no node {number} for an interface")
    return np.array([place[number] for number in wanted])


def rigid_mass(moments):
    """(6,6) mass of rigid motions about the origin."""
    coupling = np.einsum("arl,l->ar", EPSILON, moments.first)
    return np.block([[moments.mass * np.eye(3), coupling], [coupling.T, moments.inertia]])


def body_of_modes(path, options, numbers, positions, shapes, stiffness, mass, damping=None, components=None, stress=None):
    """A MatrixSet without its name. @param shapes: (p,6,m) motions of the nodes; stiffness, damping: (m,m); mass: (6+m,6+m) with rigid
    motions about the origin; components: (6,6+m,6+m) S_kl, or None; stress: (p,6,m) of the nodes, or None. @raises InputError"""
    size = len(mass)
    for what, matrix in (("the mass", mass), ("the stiffness", stiffness)):
        if not np.isfinite(matrix).all():
            raise InputError(f"'{path}': {what} holds numbers that are not finite")
    if not (np.isfinite(positions).all() and np.isfinite(shapes).all()):
        raise InputError(f"'{path}': positions or shapes hold numbers that are not finite")
    motions = np.concatenate([rigid_rows(positions), shapes], axis=2)
    chosen = chosen_rows(path, numbers, options.interfaces, size)
    unknowns = node_unknowns(motions[chosen], mass, numbers[chosen])

    def elastic(matrix):
        full = np.zeros((size, size))
        full[6:, 6:] = matrix
        return sparse(unknowns.matrix(full))

    rest = np.setdiff1d(np.arange(len(numbers)), chosen)
    inner = motions[rest] @ unknowns.inverse
    turned = np.abs(shapes[:, 3:]).max(initial=0) > 0
    return MatrixSet(
        name="", source="", numbers=numbers[chosen], positions=positions[chosen], unknown_nodes=unknowns.nodes,
        unknown_components=unknowns.components, stiffness=elastic(stiffness), mass=sparse(unknowns.matrix(mass)),
        damping=None if damping is None else elastic(damping),
        inertia_components=None if components is None else np.array([unknowns.inverse.T @ each @ unknowns.inverse for each in components]),
        shapes=Shapes(numbers[rest], positions[rest], inner[:, :3].reshape(-1, size),
                      inner[:, 3:].reshape(-1, size) if turned else None, **_stress_of(stress, rest, unknowns)) if len(rest) else None)


def _stress_of(stress, rest, unknowns):
    """Stress at the points as a function of the unknowns, as keywords of Shapes; rigid motions cause none."""
    if stress is None:
        return {}
    return {"stress": (stress[rest] @ unknowns.inverse[6:]).reshape(-1, unknowns.inverse.shape[1]), "stress_points": np.arange(len(rest))}
