"""Stiffness and mass of a body as another program wrote them, full or reduced: the one model that all formats share."""

from dataclasses import dataclass, field
from typing import Any

import numpy as np
import scipy.sparse

from ..messages import InputError, counted
from . import recovery

COMPONENTS = ("x", "y", "z", "rx", "ry", "rz")
LARGEST = 1e100  # products of three larger numbers overflow


@dataclass
class Shapes:
    """Displacements inside a body as functions of its unknowns, and the masses there if the file has them."""

    numbers: np.ndarray                  # (p) the file's numbers of the points
    points: np.ndarray                   # (p,3)
    displacement: np.ndarray             # (3p,n): rows x y z of the first point, of the second ..., body axes
    rotation: np.ndarray | None = None   # (3p,n): the same for rotations
    masses: np.ndarray | None = None     # (p) point masses, whose sum is the body's mass
    inertias: np.ndarray | None = None   # (p,3,3) about each point, body axes
    cells: dict[int, np.ndarray] = field(default_factory=dict)  # by gmsh's element type: (cells, nodes), rows of `points`
    stress: np.ndarray | None = None     # (6s,n): xx yy zz yz xz xy at some of the points, body axes
    stress_points: np.ndarray | None = None  # (s) rows of these in `points`


@dataclass
class MassProperties:
    """Mass properties that a file gives besides the matrices."""

    mass: float
    centre: np.ndarray          # (3)
    inertia: np.ndarray         # (3,3) about the centre, body axes: positive moments, negative products


@dataclass
class MatrixSet:
    """Matrices over n unknowns: displacements and rotations of nodes, and scalar coordinates (modal amplitudes).

    All numbers are those of the file, in its units. Matrices hold both triangles as the file gives them (a file that
    gives one triangle means a symmetric matrix), so that a check can find a matrix that is not symmetric.
    """

    name: str
    source: str                         # format and file, for messages: "Nastran DMIG, arm.pch"
    numbers: np.ndarray                 # (N) numbers of the nodes in the file
    positions: np.ndarray               # (N,3) in body axes
    unknown_nodes: np.ndarray           # (n) row of the node in `numbers`; -1: a scalar coordinate
    unknown_components: np.ndarray      # (n) 0 to 5: x y z rx ry rz in the axes of the node; scalars: their count from 0
    stiffness: Any                      # (n,n) scipy.sparse
    mass: Any                           # (n,n) scipy.sparse
    axes: np.ndarray | None = None      # (N,3,3) columns: directions of the axes of each node in the body; None: the body's
    damping: Any = None                 # (n,n) scipy.sparse, viscous
    geometric_stiffness: Any = None     # (n,n) scipy.sparse; the file does not name its load
    interfaces: dict[str, int] = field(default_factory=dict)  # rows of nodes that the file itself declares as interfaces, by name
    inertia_components: np.ndarray | None = None  # (6,n,n) S_11 S_22 S_33 S_23 S_13 S_12, if the file has them
    mass_properties: MassProperties | None = None
    shapes: Shapes | None = None
    cells: dict[int, np.ndarray] = field(default_factory=dict)  # between nodes, for drawings: as in Shapes, rows of `numbers`
    quantities: dict[str, recovery.Quantity] = field(default_factory=dict)  # further recovered numbers, by name
    length_unit: str | None = None      # as `length_unit` of a body file, if the file declares one
    mass_unit: str | None = None        # as `mass_unit` of a body file
    notes: list[str] = field(default_factory=list)  # notes on parts that were left out

    @property
    def size(self):
        """Number of unknowns."""
        return len(self.unknown_nodes)

    @property
    def scalars(self):
        """Number of scalar coordinates."""
        return int(np.count_nonzero(self.unknown_nodes < 0))

    def check(self):
        """@raises InputError when shapes do not fit, an unknown stands twice, or numbers are not finite."""
        n, nodes = self.size, len(self.numbers)
        if n == 0:
            raise InputError("holds no unknowns")
        if self.positions.shape != (nodes, 3):
            raise InputError(f"holds positions of the shape {self.positions.shape} for {counted(nodes, 'node')}")
        check_positions(self.numbers, self.positions)
        if self.axes is not None:
            self._check_axes()
        for name, matrix in self.matrices().items():
            if matrix.shape != (n, n):
                raise InputError(f"the {name} has {matrix.shape[0]} x {matrix.shape[1]} entries for {counted(n, 'unknown')}")
            if not np.isfinite(matrix.data).all():
                raise InputError(f"the {name} holds numbers that are not finite")
            if abs(matrix.data).max(initial=0) > LARGEST:
                raise InputError(f"the {name} holds the number {abs(matrix.data).max():.3g}; expected numbers within {LARGEST:.0e}")
        for interface in self.interfaces:
            if not interface.strip():
                raise InputError(f"the interface at node {self.numbers[self.interfaces[interface]]} has no name")
        for name, quantity in self.quantities.items():
            recovery.check(name, quantity, n)
        if self.shapes is not None and self.shapes.stress is not None:
            self._check_stress()
        places = list(zip(self.unknown_nodes, self.unknown_components))
        if len(set(places)) < n:
            twice = next(place for place in places if places.count(place) > 1)
            raise InputError(f"the unknown {self.name_of(*twice)} stands twice")

    def _check_stress(self):
        points = np.asarray(self.shapes.stress_points)
        if self.shapes.stress.shape != (6 * len(points), self.size) or not np.isfinite(self.shapes.stress).all():
            raise InputError("holds a stress that does not fit its points and unknowns, or is no numbers")
        if len(set(points.tolist())) < len(points) or len(points) and not 0 <= points.min() <= points.max() < len(self.shapes.points):
            raise InputError("holds the stress of points that it does not have, or twice that of one")

    def _check_axes(self):
        if self.axes.shape != (len(self.numbers), 3, 3) or not np.isfinite(self.axes).all():
            raise InputError("holds axes of nodes that are no numbers")
        errors = np.abs(np.transpose(self.axes, (0, 2, 1)) @ self.axes - np.eye(3)).max(axis=(1, 2)) > 1e-6
        wrong = np.flatnonzero(errors | (np.linalg.det(self.axes) < 0))
        if len(wrong):
            raise InputError(f"the axes of node {self.numbers[wrong[0]]} are no rotation")

    def declare_interfaces(self, numbers):
        """Makes nodes the interfaces. @raises InputError for a number that no node has"""
        rows = {int(number): row for row, number in enumerate(self.numbers)}
        names = {row: name for name, row in self.interfaces.items()}
        for number in numbers:
            if number not in rows:
                raise InputError(f"there is no node {number} that could become an interface")
        self.interfaces = {names.get(rows[number], f"node_{number}"): rows[number] for number in numbers}

    def matrices(self):
        """The matrices that there are, by name."""
        named = {"stiffness": self.stiffness, "mass": self.mass, "damping": self.damping,
                 "geometric stiffness": self.geometric_stiffness}
        return {name: matrix for name, matrix in named.items() if matrix is not None}

    def name_of(self, node, component):
        """Name of an unknown, as messages show it."""
        return f"scalar {component + 1}" if node < 0 else f"node {self.numbers[node]} {COMPONENTS[component]}"


def check_positions(numbers, positions, before=""):
    """@param before: text before the sentence @raises InputError naming the first node whose position is not finite"""
    wrong = np.flatnonzero(~(np.abs(positions) <= LARGEST).all(axis=1))
    if len(wrong):
        told = ", ".join(f"{each:g}" for each in positions[wrong[0]])
        raise InputError(f"{before}node {numbers[wrong[0]]} has the position ({told}); expected finite numbers within {LARGEST:.0e}")


def sparse(matrix):
    """A matrix of any kind as scipy.sparse, without stored zeros."""
    result = scipy.sparse.csr_matrix(matrix, dtype=float)
    result.eliminate_zeros()
    return result


def mirrored(triangle):
    """The symmetric matrix of which one triangle is given (scipy.sparse), whichever it is."""
    triangle = sparse(triangle)
    return sparse(triangle + triangle.T - scipy.sparse.diags(triangle.diagonal()))
