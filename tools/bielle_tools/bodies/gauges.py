"""Virtual strain gauges on the surface of a superelement.

The strain at a node is C^-1 S q, from the stress S q that the superelement recovers and the elasticity C of its
material. Within a face of the surface it is interpolated by the shape functions of the face. A gauge at the angle theta
from the first direction, anticlockwise seen from outside, in the plane of the surface, has the strain
    e(theta) = (e_x + e_y)/2 + (e_x - e_y)/2 cos 2 theta + g_xy/2 sin 2 theta.
The strain is that of the superelement, linear in its coordinates q: no motion of the frame strains it. It is that of a
point; a real gauge shows the mean over its grid.
"""

import numpy as np

from ..mesh.surface_point import SAME_PLACE, nearest_on_surface
from ..messages import InputError, did_you_mean, note, place as shown

ROSETTES = {"rectangular": np.deg2rad([0.0, 45.0, 90.0]), "delta": np.deg2rad([0.0, 60.0, 120.0])}
NO_DIRECTION = 1e-3  # below this sine of its angle to the normal, a direction does not determine one in the surface


def plane_strain_of(body, place, direction):
    """(3,n) e_x, e_y and g_xy per coordinate, x along the direction in the plane of the surface. place (3), direction
    (3): body axes. @raises InputError if the body keeps no strain there"""
    if body.stress is None or body.elasticity is None:
        missing = "stress" if body.stress is None else "elasticity of its materials"
        raise InputError(f"'{body.path}' keeps no {missing}, of which strain is made: "
                         "set 'recovery: {stress: surface}' in its body file and reduce it again")
    point = nearest_on_surface(body.points, body.surface(), place)
    size = float(np.linalg.norm(np.ptp(body.points, axis=0)))
    if point.distance > SAME_PLACE * size:
        note(f"the gauge at {shown(place)} is moved by {point.distance:.3g} m onto the surface, to "
             f"{shown(point.position)}")
    x = _in_surface(direction, point.normal)
    y = np.cross(point.normal, x)
    return np.stack([_projection(x, x), _projection(y, y), 2 * _projection(x, y)]) @ _strain(body, point)


def gauge_strains(plane, angles):
    """Returns strains (...,k) of gauges at angles (k) [rad] from plane strains (...,3)."""
    mean, half, shear = (plane[..., 0] + plane[..., 1]) / 2, (plane[..., 0] - plane[..., 1]) / 2, plane[..., 2] / 2
    return mean[..., None] + half[..., None] * np.cos(2 * angles) + shear[..., None] * np.sin(2 * angles)


def principal_strains(plane):
    """(...,3) largest and least strain in the surface and the angle of the largest from x [rad], above -pi/2 to pi/2; 0
    if all directions are alike."""
    mean, half, shear = (plane[..., 0] + plane[..., 1]) / 2, (plane[..., 0] - plane[..., 1]) / 2, plane[..., 2] / 2
    radius = np.hypot(half, shear)
    return np.stack([mean + radius, mean - radius, np.arctan2(shear, half) / 2], axis=-1)


def angles_of_rosette(word):
    """@raises InputError for an unknown kind of rosette"""
    if word not in ROSETTES:
        raise InputError(f"a rosette is rectangular (0, 45 and 90 degrees) or delta (0, 60 and 120), not '{word}'"
                         f"{did_you_mean(word, list(ROSETTES))}")
    return ROSETTES[word]


def _in_surface(direction, normal):
    """Returns the unit vector of the direction in the plane of the surface. @raises InputError if the direction is
    normal to it"""
    length = np.linalg.norm(direction)
    if not length > 0:
        raise InputError("the direction of a gauge has no length")
    across = direction / length @ normal
    in_plane = direction / length - across * normal
    if np.linalg.norm(in_plane) < NO_DIRECTION:
        raise InputError(f"the direction {shown(direction)} of a gauge is normal to the surface, whose normal there is "
                         f"{shown(normal)}")
    if abs(across) > NO_DIRECTION:
        angle = np.rad2deg(np.arcsin(min(1.0, abs(across))))
        note(f"the direction {shown(direction)} of a gauge is turned by {angle:.3g} degrees into the surface")
    return in_plane / np.linalg.norm(in_plane)


def _strain(body, point):
    """Returns the strain xx yy zz yz xz xy (engineering shears) per coordinate (6,n)."""
    rows = np.full(len(body.points), -1)
    rows[body.stressed] = np.arange(len(body.stressed))
    used = np.abs(point.weights) > 1e-12
    nodes, weights = rows[point.nodes[used]], point.weights[used]
    if (nodes < 0).any():
        raise InputError(f"'{body.path}' keeps no stress at {shown(point.position)}: set 'recovery: {{stress: surface}}' "
                         "in its body file and reduce it again")
    stress = body.stress.reshape(len(body.stressed), 6, -1)
    return sum(weight * np.linalg.solve(body.elasticity[body.stress_materials[node]], stress[node])
               for node, weight in zip(nodes, weights))


def _projection(a, b):
    """(6) factors by which strains xx yy zz yz xz xy with engineering shears give a . e b."""
    return np.array([a[0] * b[0], a[1] * b[1], a[2] * b[2], (a[1] * b[2] + a[2] * b[1]) / 2,
                     (a[0] * b[2] + a[2] * b[0]) / 2, (a[0] * b[1] + a[1] * b[0]) / 2])
