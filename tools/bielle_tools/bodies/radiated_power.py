"""The equivalent radiated power of a surface: P = Z times the integral of v_n^2 over it [W].

v_n is the normal velocity of the surface, Z = rho c the impedance of air for plane waves. P is the sound power that the
surface would radiate if each part of it radiated as a plane does: an upper estimate without cancellation between parts
that move against each other. Its mean over a period is Z v^2 S/2 for an area S that oscillates with the amplitude v. In
a body that moves as x + R (X + U q), v_n is linear in w = (R^T x', Omega, q'), hence P = w^T F w with a constant matrix
F; the displacement is neglected compared with X in Omega x (X + U q).
Reference: F. Fahy, P. Gardonio, Sound and Structural Vibration, 2nd ed. 2007, section 3.3 (radiation efficiency 1).
"""

import numpy as np
from scipy.interpolate import CubicSpline

from ..mesh.cell_integrals import surface_points
from ..messages import InputError
from ..results.continuous_rotations import continuous_quaternions

IMPEDANCE = 1.204 * 343.2  # [N s/m^3] of air at 20 degrees Celsius and 101325 Pa


def velocity_form(points, faces, shapes):
    """F/Z (m,m) [m^2, ..]: the integral of (n . phi_i)(n . phi_j) over the surface. shapes: (p,3,m) displacements phi_i
    of the points"""
    total = np.zeros((shapes.shape[2],) * 2)
    for _, nodes, N, normals in surface_points(points, faces):
        area = np.linalg.norm(normals, axis=1)
        scaled = normals / np.sqrt(np.where(area > 0, area, 1))[:, None]
        along = np.zeros((len(nodes), shapes.shape[2]))
        for k in range(nodes.shape[1]):
            along += N[k] * np.einsum("ek,ekm->em", scaled, shapes[nodes[:, k]])
        total += along.T @ along
    return total


def body_form(body, path):
    """F/Z of a superelement's whole surface in w: three velocities, three angular velocities, rates of the coordinates.
    @raises InputError if the file keeps no displacements of the surface"""
    faces = body.surface()
    nodes = np.unique(np.concatenate([block.ravel() for block in faces.values()]))
    if not np.isin(nodes, body.displaced).all():
        raise InputError(f"'{path}' does not keep the displacements of the whole surface: set 'recovery: "
                         "{displacement: surface}' in its body file and reduce it again")
    count = body.displacement.shape[1]
    shapes = np.zeros((len(body.points), 3, 6 + count))
    for k in range(3):
        shapes[:, k, k] = 1
        shapes[:, :, 3 + k] = np.cross(np.eye(3)[k], body.points)
    shapes[body.displaced, :, 6:] = body.displacement.reshape(-1, 3, count)
    return velocity_form(body.points, faces, shapes)


def body_velocities(time, frame, q):
    """w (nt, 6 + n), by splines through the rows: of the frame's origin and the angular velocity, body axes, and of q
    (nt,n). frame: (nt,7) position and quaternion; rows that are not numbers have none."""
    x, p = rates(time, frame[:, :3]), continuous_quaternions(frame[:, 3:])  # recorded signs change at half turns
    dp = rates(time, p)
    size = (p * p).sum(axis=1)
    scalar, vector, ds, dv = p[:, :1], p[:, 1:], dp[:, :1], dp[:, 1:]
    omega = 2 * (scalar * dv - ds * vector - np.cross(vector, dv)) / size[:, None]
    cross = np.cross(vector, x)  # R^T x' = x' - 2 s v x x' + 2 v x (v x x')
    velocity = x + 2 * (np.cross(vector, cross) - scalar * cross) / size[:, None]
    return np.column_stack([velocity, omega, rates(time, q)])


def rates(time, values):
    """Returns derivatives (nt, k) of cubic splines through the rows of (nt, k); they are not a number next to gaps that
    leave no two rows together. @raises InputError if the time does not increase"""
    if np.any(np.diff(time) <= 0):
        row = int(np.flatnonzero(np.diff(time) <= 0)[0])
        raise InputError(f"velocities need times that increase: after {time[row]:g} s comes {time[row + 1]:g} s")
    result = np.full(values.shape, np.nan)
    known = np.flatnonzero(np.isfinite(values).all(axis=1))
    for rows in np.split(known, np.flatnonzero(np.diff(known) > 1) + 1):
        if len(rows) > 1:
            result[rows] = CubicSpline(time[rows], values[rows])(time[rows], 1)
    return result
