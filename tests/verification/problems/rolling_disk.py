"""A thin disk that rolls without slip."""

import numpy as np
from harness import Problem, Quantity, Study, row, vector
from harness.motions import EnergyDrift, axes, moved

EXACT = "equations of the rolling disk, DOP853 (tests/references/rolling_disk.py)"


def model():
    """Attitude R_x(110 degrees), the disk's axis is z of the node; rates (0, 0, 4) rad/s, contact at the origin."""
    lean, radius = np.radians(110), 0.5
    axis = np.array([0, -np.sin(lean), np.cos(lean)])
    up = np.array([0, 0, 1]) - axis[2] * axis
    centre = radius * up / np.linalg.norm(up)
    return {"gravity": [0, 0, -9.81],
            "nodes": {"hub": {"position": centre, "rotation_vector": [lean, 0, 0], "angular_velocity": [0, 0, 4],
                              "velocity": np.cross(4 * axis, centre)}},
            "elements": {"disk": {"type": "rigid_body", "node": "hub", "mass": 1, "inertia": [0.0625, 0.0625, 0.125]}},
            "joints": {"rim": {"type": "wheel", "nodes": ["ground", "hub"], "normal": [0, 0, 1], "position": [0, 0, 0],
                               "axis": axis, "radius": radius}}}


def roll(step):
    drift = EnergyDrift()
    session = moved(model(), 1, step, drift)
    return {"centre": session["nodes/hub/position"], "axis": axes(session, "hub")[:, 2],
            "force": session["joints/rim/reaction_inertial"][:3],
            "drift": drift.largest}


PROBLEM = Problem(
    title="Rolling disk",
    subject="Rigid mechanisms",
    source="J. I. Neimark, N. A. Fufaev, Dynamics of Nonholonomic Systems (1972), ch. I",
    model="A thin disk of 1 kg and radius 0.5 m leans by 20 degrees and rolls without slip on a plane, from the spin "
          "4 rad/s, for 1 s. "
          "A rigid body with a joint `wheel`, whose constraints hold velocities (non-holonomic), rho = 0.8.",
    quick=True,
    studies=[Study("Motion at 1 s", roll, [1e-2, 5e-3, 2.5e-3, 1.25e-3], [
        Quantity("centre", "centre", "m", **vector("rolling_disk", "centre", components="xyz"), source=EXACT,
                 tolerance=1e-4, order=2, order_within=0.15,
                 reason="(w h)^2/12 to (w h)^2/4 with w = 8 rad/s of a way of 2 m: 2e-5 to 5e-5"),
        Quantity("axis", "axis of the disk", "-", **vector("rolling_disk", "axis", components="xyz"), source=EXACT,
                 tolerance=1e-4, order=2, order_within=0.15,
                 reason="likewise"),
        Quantity("force", "force of the plane", "N", **vector("rolling_disk", "force", components="xyz"), source=EXACT,
                 tolerance=1e-3, order=2, order_within=0.15,
                 reason="1e-4 of the weight"),
        Quantity("drift", "largest drift of the energy", "J", 0.0, source="conservation of energy", tolerance=1e-3,
                 order=2, order_within=0.15,
                 reason=f"1e-4 of {row('rolling_disk', 'energy')['reference']:.4g} J"),
    ])])
