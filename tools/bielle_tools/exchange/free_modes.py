"""A body in free motion: rigid motions and elastic modes of its matrices.

Formats of a floating frame hold amplitudes of elastic shapes. They get all n - 6 free modes of K and M, so that nothing
is lost.
"""

from dataclasses import dataclass

import numpy as np
import scipy.linalg

from ..messages import InputError, counted
from .axes import in_body_axes
from .entries import symmetric_part
from .inertia_moments import PAIRS, Moments, inertia_about, moments_of, moments_of_points, second_moment

FREE = 1e-6        # largest force of a rigid motion, relative to the largest of the same displacements one by one
ROUNDING = 1e-12   # of forces, relative to the largest stiffness
LARGEST = 6000     # unknowns
SAME_MASS = 1e-12  # difference of the masses of the three directions, relative to the largest


@dataclass
class FreeModes:
    """The elastic modes of a free body in its own axes, and its nodes and recovery points."""

    rigid: np.ndarray       # (n,6) rigid motions about the origin
    modes: np.ndarray       # (n,m) with phi^T M phi = 1
    stiffness: np.ndarray   # (m,m) of the modes
    mass: np.ndarray        # (m,m)
    damping: np.ndarray | None
    numbers: np.ndarray     # (p) of the nodes, then of the points
    positions: np.ndarray   # (p,3)
    motions: np.ndarray     # (p,6,n): displacement and rotation of each as functions of the unknowns
    nodes: int              # number of nodes, which stand before the recovery points
    body: object            # the MatrixSet in axes of the body


def free_modes(matrices):
    """FreeModes of a MatrixSet. @raises InputError if it is no free body, or too large"""
    body = in_body_axes(matrices)
    if body.size > LARGEST:
        raise InputError(f"a body with {counted(body.size, 'unknown')} is too large for a format of modes: reduce it "
                         "first")
    K, M = (symmetric_part(matrix.toarray()) for matrix in (body.stiffness, body.mass))
    rigid = rigid_motions(body, K)
    forces, parts = np.abs(K @ rigid).max(axis=0), (np.abs(K) @ np.abs(rigid)).max(axis=0)
    held = forces > np.maximum(FREE * parts, ROUNDING * np.abs(K).max() * np.abs(rigid).max(axis=0))
    if held.any():
        raise InputError(f"a rigid motion of the body has forces of {(forces[held] / parts[held]).max():.1g} of their "
                         "parts: it is held, or "
                         "positions of nodes are wrong")
    try:
        modes = scipy.linalg.eigh(K, M)[1][:, 6:]
    except np.linalg.LinAlgError:
        raise InputError("the mass matrix is not positive definite: a format of modes needs mass in each "
                         "unknown") from None
    modes = modes - rigid @ np.linalg.solve(rigid.T @ M @ rigid, rigid.T @ M @ modes)
    damping = None if body.damping is None else modes.T @ body.damping.toarray() @ modes
    numbers, positions, motions = _places(body)
    return FreeModes(rigid, modes, symmetric_part(modes.T @ K @ modes), symmetric_part(modes.T @ M @ modes), damping, numbers,
                     positions, motions, len(body.numbers), body)


def rigid_motions(body, K):
    """(n,6) displacements of the unknowns in rigid motions about the origin; scalars follow from the stiffness."""
    rigid = np.zeros((body.size, 6))
    for row, (node, component) in enumerate(zip(body.unknown_nodes, body.unknown_components)):
        if node < 0:
            continue
        if component < 3:
            rigid[row, component] = 1
            rigid[row, 3:] = np.cross(np.eye(3), body.positions[node])[:, component]
        else:
            rigid[row, component] = 1
    scalar = body.unknown_nodes < 0
    forces = K[np.ix_(scalar, ~scalar)] @ rigid[~scalar]
    if np.abs(forces).max(initial=0) > 0:
        rigid[scalar] = -np.linalg.lstsq(K[np.ix_(scalar, scalar)], forces, rcond=None)[0]
    return rigid


def _places(body):
    """Numbers, positions and motions (p,6,n) of nodes and recovery points."""
    motions = np.zeros((len(body.numbers), 6, body.size))
    for row, (node, component) in enumerate(zip(body.unknown_nodes, body.unknown_components)):
        if node >= 0:
            motions[node, component, row] = 1
    if body.shapes is None:
        return body.numbers, body.positions, motions
    shapes = body.shapes
    more = np.zeros((len(shapes.points), 6, body.size))
    more[:, :3] = shapes.displacement.reshape(-1, 3, body.size)
    if shapes.rotation is not None:
        more[:, 3:] = shapes.rotation.reshape(-1, 3, body.size)
    first = int(body.numbers.max(initial=0))
    numbers = shapes.numbers if not np.isin(shapes.numbers, body.numbers).any() else shapes.numbers + first
    return (np.concatenate([body.numbers, numbers]), np.concatenate([body.positions, shapes.points]), np.concatenate([motions, more]))


def moments(free):
    """Moments of the modes (`inertia_moments`); None if the matrices do not tell the directions of the motion inside."""
    body = free.body
    components = body.inertia_components
    if components is None:
        components = _of_displacements(body)
    if components is not None:
        return moments_of(components, free.rigid, free.modes)
    if body.shapes is not None and body.shapes.masses is not None and body.shapes.inertias is None:
        return moments_of_points(body.shapes.points, body.shapes.masses, body.shapes.displacement.reshape(-1, 3, body.size) @ free.modes)
    return None


def _of_displacements(body):
    """S_kl of a displacement field: all unknowns are x, y, z of nodes, and the masses of the three directions are equal."""
    rows = [np.flatnonzero((body.unknown_nodes >= 0) & (body.unknown_components == k)) for k in range(3)]
    if sum(map(len, rows)) < body.size or any(set(body.unknown_nodes[each]) != set(body.unknown_nodes[rows[0]]) for each in rows):
        return None
    rows = [each[np.argsort(body.unknown_nodes[each])] for each in rows]
    M = body.mass.toarray()
    blocks = [[M[np.ix_(rows[k], rows[l])] for l in range(3)] for k in range(3)]
    scalar = blocks[0][0]
    if max(np.abs(blocks[k][l] - (scalar if k == l else 0)).max() for k in range(3) for l in range(3)) > SAME_MASS * np.abs(scalar).max():
        return None
    components = np.zeros((6, body.size, body.size))
    for each, (k, l) in zip(components, PAIRS):
        each[np.ix_(rows[k], rows[l])] = scalar
    return components


def rigid_moments(free):
    """Moments of the rigid body alone: those of the file, or of the mass matrix."""
    properties = free.body.mass_properties
    M = free.rigid.T @ (free.body.mass @ free.rigid)
    mass = float(np.trace(M[:3, :3]) / 3)
    centre = np.array([M[5, 1] - M[4, 2], M[3, 2] - M[5, 0], M[4, 0] - M[3, 1]]) / (2 * mass)
    inertia = M[3:, 3:]
    if properties is not None:
        mass, centre = float(properties.mass), np.asarray(properties.centre)
        inertia = inertia_about(np.asarray(properties.inertia), mass, centre)
    none = np.zeros((0, 3))
    return Moments(mass, mass * centre, second_moment(inertia), none, np.zeros((0, 3, 3)), np.zeros((3, 3, 0, 0)))
