"""Inertia of a body in free motion: its moments of mass with rigid motions and elastic shapes, and the components S_kl.

With the mass dm at x and the shapes phi_j: mass, first = sum x dm, second = sum x x^T dm, linear_j = sum phi_j dm,
product_j = sum phi_j x^T dm, square_kl = sum phi_k^T phi_l dm (row k of all shapes with row l). S_kl = sum u_k^T u_l dm
of the coordinates (rigid motions: 3 displacements, 3 rotations about the origin, then the shapes) holds the same
numbers.
"""

from dataclasses import dataclass

import numpy as np

PAIRS = ((0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1))  # order of S_kl
EPSILON = np.zeros((3, 3, 3))
for _i, _j, _k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
    EPSILON[_i, _j, _k], EPSILON[_i, _k, _j] = 1, -1


@dataclass
class Moments:
    """The moments of m shapes, in axes of the body about its origin."""

    mass: float
    first: np.ndarray    # (3)
    second: np.ndarray   # (3,3)
    linear: np.ndarray   # (m,3)
    product: np.ndarray  # (m,3,3): component of the shape, of the place
    square: np.ndarray   # (3,3,m,m)

    @property
    def inertia(self):
        """Inertia about the origin (3,3)."""
        return np.trace(self.second) * np.eye(3) - self.second

    @property
    def centre(self):
        """Centre of mass (3)."""
        return self.first / self.mass

    def turning(self):
        """sum x cross phi_j dm (m,3)."""
        return np.einsum("abc,jcb->ja", EPSILON, self.product)


def second_moment(inertia):
    """sum x x^T dm of an inertia about the same point."""
    return np.trace(inertia) / 2 * np.eye(3) - inertia


def inertia_about(inertia, mass, arm):
    """Inertia of a body about a point, of that about its centre. @param arm: from the point to the centre"""
    return inertia + mass * (arm @ arm * np.eye(3) - np.outer(arm, arm))


def pair(components, k, l):
    """S_kl out of the six."""
    return components[PAIRS.index((k, l))] if (k, l) in PAIRS else components[PAIRS.index((l, k))].T


def moments_of(components, rigid, shapes):
    """Moments out of S_kl of n unknowns. @param rigid: (n,6) rigid motions about the origin; shapes: (n,m)"""
    move, turn = rigid[:, :3], rigid[:, 3:]

    def arm(row, l):
        """The rotation whose component `row` is +-x_l, and the sign."""
        axis = 3 - row - l
        return EPSILON[row, axis, l] * turn[:, axis]

    other = (1, 2, 0)  # a row that is not l
    first = np.array([move[:, other[l]] @ pair(components, other[l], other[l]) @ arm(other[l], l) for l in range(3)])
    second = np.array([[arm(other[l], l) @ pair(components, other[l], other[n]) @ arm(other[n], n) for n in range(3)] for l in range(3)])
    linear = np.array([move[:, a] @ pair(components, a, a) @ shapes for a in range(3)]).T
    product = np.empty((shapes.shape[1], 3, 3))
    for a in range(3):
        for l in range(3):
            row = a if a != l else other[l]
            product[:, a, l] = arm(row, l) @ pair(components, row, a) @ shapes
    square = np.array([[shapes.T @ pair(components, k, l) @ shapes for l in range(3)] for k in range(3)])
    mass = np.mean([move[:, a] @ pair(components, a, a) @ move[:, a] for a in range(3)])
    return Moments(float(mass), first, (second + second.T) / 2, linear, product, square)


def components_of(moments):
    """S_kl (6,6+m,6+m) of rigid motions about the origin and of the shapes."""
    gram = np.block([[np.array([[moments.mass]]), moments.first[None]], [moments.first[:, None], moments.second]])
    rigid = np.zeros((3, 4, 6))  # coefficients of 1, x, y, z in component a of each rigid motion
    for a in range(3):
        rigid[a, 0, a] = 1
        rigid[a, 1:, 3:] = EPSILON[a].T
    mixed = np.concatenate([moments.linear.T[:, None], moments.product.transpose(1, 2, 0)], axis=1)  # (3,4,m)
    return np.array([np.block([[rigid[k].T @ gram @ rigid[l], rigid[k].T @ mixed[l]],
                               [mixed[k].T @ rigid[l], moments.square[k, l]]]) for k, l in PAIRS])


def moments_of_points(points, masses, displacement):
    """Moments of point masses. @param displacement: (p,3,m)"""
    weighted = masses[:, None, None] * displacement
    return Moments(float(masses.sum()), masses @ points, np.einsum("p,pk,pl->kl", masses, points, points), weighted.sum(axis=0).T,
                   np.einsum("paj,pl->jal", weighted, points), np.einsum("pkj,pli->klji", weighted, displacement))
