"""The loads of a superelement at an instant, on the nodes of its mesh: the forces on its interfaces and its own
inertia.

By d'Alembert's principle, a moving body is in equilibrium under its interface forces and -M a, the inertia of its mesh.
The acceleration is
    a = w x (w x (X + u)) + T b,
with the angular velocity w of the body's frame and the reduced equations for b,
    M~ b = F - K~ q - T^T M (w x (w x (X + u))),
in which F are the interface forces and q the coordinates of the deformation, all recorded. T b contains the
acceleration and the angular acceleration of the body, the contribution of its deformation, and, with the opposite sign,
gravity. If it is supported anywhere, the mesh then has K~ q as its reduced stiffness forces, and hence the deformation
q, as far as the superelement represents it; the supports carry no load.

Other loads inside the body (load patterns, forces on points) are not recorded: they appear as inertia.
"""

from dataclasses import dataclass
from functools import cached_property

import h5py
import numpy as np

from ..mesh import cell_integrals
from ..messages import InputError
from ..results.rotations import rotation_matrices
from .materials import densities
from .superelement_body import find_superelement, interfaces_of, superelement_of
from .tied_surfaces import tied_surfaces


@dataclass
class BodyLoad:
    """The loads at one time, in the body's axes. Moments are about the origin of the mesh, unless stated otherwise."""

    time: float
    interface: np.ndarray     # (nb,6) force [N] and moment [N m] about each interface
    inertia: np.ndarray       # (p,3) on the nodes [N]
    field: np.ndarray         # (p,3) acceleration of the nodes less gravity, of which the inertia is made [m/s^2]
    angular_velocity: np.ndarray
    acceleration: np.ndarray  # (3) of the mass centre less gravity [m/s^2]
    angular_acceleration: np.ndarray
    corrected: float          # the largest change of a sum by the balance, relative to the largest force of the body
    unbalance: tuple          # residual force [N] and moment [N m]
    q: np.ndarray             # (n)


class LoadedBody:
    """A superelement of results with its mesh and the masses of its nodes."""

    def __init__(self, results, element, superelements, surfaces=None):
        """surfaces: {interface: group of the mesh} for interfaces whose group the body file does not name."""
        self.results, self.element, self.given_surfaces = results, element, surfaces or {}
        self.body = superelement_of(results, element, superelements)
        path = find_superelement(results, element, superelements)
        self.group = group = results.text(f"elements/{element}", "group")
        if len(self.body.displaced) != len(self.body.points):
            raise InputError(f"'{path}' keeps displacements of its surface alone: set 'recovery: {{displacement: all}}' in its body file "
                             "and reduce it again")
        self.path, self.points = path, self.body.points
        self.interfaces = interfaces_of(path, group)
        with h5py.File(path) as file:
            opened = file[group] if group else file
            self.positions = opened["interface/positions"][:]
            self.K, self.M = opened["reduced/stiffness"][:], opened["reduced/mass"][:]
            self.materials = densities(opened, self.body, path)
        self.mesh_mass = cell_integrals.scalar_mass(self.points, self.body.cells, self.materials.density)
        self.T = self.body.displacement.reshape(len(self.points), 3, -1)
        rigid = self._rigid()
        of_mass = np.stack([self.mesh_mass @ rigid[:, :, k] for k in range(6)], axis=2)
        self.rigid, self.rigid_inertia = rigid, np.linalg.inv(np.einsum("pka,pkb->ab", rigid, of_mass))
        self._read = {}

    @cached_property
    def surfaces(self):
        """Surfaces to which the interfaces are tied. @raises InputError if one is not known"""
        return tied_surfaces(self.path, self.group, self.body, self.interfaces, self.positions, self.given_surfaces)

    def _row(self, place, row):
        if place not in self._read:
            self._read[place] = self.results.rows(place)
        return self._read[place][row]

    def at(self, row):
        """The loads of a row of the results."""
        results, place = self.results, f"elements/{self.element}"
        frame, q, interface = (self._row(f"{place}/{name}", row) for name in ("frame", "coordinates", "interface_force"))
        omega = self._angular_velocity(row, frame)
        u = (self.T @ q)
        centrifugal = np.cross(omega, np.cross(omega, self.points + u))
        generalised = np.concatenate([np.concatenate([R.T @ force[:3], R.T @ force[3:]])[kept]
                                      for (_, kept, R), force in zip(self.interfaces, interface)])
        right = -self.K @ q - np.einsum("pkn,pk->n", self.T, self.mesh_mass @ centrifugal)
        right[:len(generalised)] += generalised
        field, change = self._balanced(interface, centrifugal + self.T @ np.linalg.solve(self.M, right))
        inertia = -(self.mesh_mass @ field)
        acceleration, angular = self._rigid_acceleration(inertia, omega)
        return BodyLoad(float(results.time[row]), interface, inertia, field, omega, acceleration, angular, change,
                        self._sums(interface, inertia), q)

    def _angular_velocity(self, row, frame):
        """Returns the angular velocity of the rigid motion nearest to those of the interfaces, in body axes."""
        R, L = rotation_matrices(frame[3:]), max(float(np.ptp(self.points, axis=0).max()), 1e-300)
        rows, right = [], []
        for (name, _, _), X in zip(self.interfaces, self.positions):
            node = self.results.text(f"elements/{self.element}", f"interface {name}")
            place = f"nodes/{node}"
            if not self.results.has(f"{place}/velocity"):
                raise InputError(f"'{self.results.path}' has no velocity of node '{node}': its rotation is not known. Record it (`output: only`)")
            v = self._row(f"{place}/velocity", row)
            axes = rotation_matrices(self._row(f"{place}/rotation", row))
            y = X + 0.0
            cross = np.array([[0, -y[2], y[1]], [y[2], 0, -y[0]], [-y[1], y[0], 0]])
            rows += [np.hstack([np.eye(3), -cross]), np.hstack([np.zeros((3, 3)), L * np.eye(3)])]
            right += [R.T @ v[:3], L * (R.T @ axes @ v[3:])]
        return np.linalg.lstsq(np.vstack(rows), np.concatenate(right), rcond=None)[0][3:]

    def _sums(self, interface, inertia):
        """Returns the force, and the moment about the origin of the mesh."""
        force = interface[:, :3].sum(axis=0) + inertia.sum(axis=0)
        moment = interface[:, 3:].sum(axis=0) + np.cross(self.positions, interface[:, :3]).sum(axis=0) \
            + np.cross(self.points, inertia).sum(axis=0)
        return force, moment

    def _rigid(self):
        """Returns rigid motions (p,3,6) about the origin."""
        rigid = np.zeros((len(self.points), 3, 6))
        rigid[:, range(3), range(3)] = 1
        for k in range(3):
            rigid[:, :, 3 + k] = np.cross(np.eye(3)[k], self.points)
        return rigid

    def _balanced(self, interface, field):
        """Adds a rigid acceleration whose inertia balances the remainder due to rounding, turned interfaces and terms of
        second order."""
        first = inertia = -(self.mesh_mass @ field)
        for _ in range(2):  # the second time for rounding
            field = field + self.rigid @ (self.rigid_inertia @ np.concatenate(self._sums(interface, inertia)))
            inertia = -(self.mesh_mass @ field)
        size = max(np.abs(interface[:, :3]).max(initial=0), np.linalg.norm(np.abs(first).sum(axis=0)), 1e-300)
        return field, float(np.linalg.norm((inertia - first).sum(axis=0)) / size)

    def _rigid_acceleration(self, inertia, omega):
        """Returns the acceleration of the mass centre, and the angular acceleration, by Newton's and Euler's equations
        of the undeformed body."""
        lumped = np.asarray(self.mesh_mass.sum(axis=1)).ravel()
        centre = lumped @ self.points / lumped.sum()
        r = self.points - centre
        J = np.einsum("pk,pk->", r, self.mesh_mass @ r) * np.eye(3) - r.T @ (self.mesh_mass @ r)
        moment = -np.cross(r, inertia).sum(axis=0)
        return -inertia.sum(axis=0) / lumped.sum(), np.linalg.solve(J, moment - np.cross(omega, J @ omega))
