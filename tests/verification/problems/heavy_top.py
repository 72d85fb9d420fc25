"""The heavy top of Bruls, Cardona and Arnold."""

from harness import Problem, Quantity, Study, vector
from harness.motions import moved

MODEL = """
gravity: [0, 0, -9.81]
nodes: {top: {position: [0, 1, 0], velocity: [4.61538, 0, 0], angular_velocity: [0, 150, -4.61538]}}
elements: {top: {type: rigid_body, node: top, mass: 15, inertia: [0.234375, 0.46875, 0.234375]}}
joints: {pivot: {type: spherical, nodes: [ground, top], position: [0, 0, 0]}}
"""
EXACT = "Euler and Poinsot's equations about the fixed point, quaternions, DOP853 (tests/references/heavy_top.py)"


def top(constraints):
    """Study.compute for a form of the constraints."""
    def compute(step):
        session = moved(MODEL, 1, step, rho=0.9, constraints=constraints)
        return {"centre": session["nodes/top/position"], "Omega": session.node("top").angular_velocity,
                "force": session["joints/pivot/reaction_inertial"][:3]}
    return compute


def quantities(factor):
    """@param factor  expected errors relative to those of the textbook's form"""
    return [
        Quantity("centre", "centre of mass at 1 s", "m", **vector("heavy_top", "1.centre", components="xyz"),
                 source=EXACT, tolerance=1e-3 * factor, order=2,
                 reason="the textbook's scheme has 4.5e-4 m at h = 0.25 ms (tests/references/index_three.py)"),
        Quantity("Omega", "angular velocity in the body's axes at 1 s", "rad/s",
                 **vector("heavy_top", "1.Omega", components="xyz"), source=EXACT,
                 tolerance=1.4e-2 * factor, order=2, reason="the textbook's scheme has 6.3e-3 rad/s"),
        Quantity("force", "force of the pivot at 1 s", "N", **vector("heavy_top", "1.force", components="xyz"),
                 source=EXACT, tolerance=1.2 * factor, order=2,
                 reason="the textbook's scheme has 0.54 N of 770 N"),
    ]


PROBLEM = Problem(
    title="Heavy top",
    subject="Rigid mechanisms",
    source="O. Bruls, A. Cardona, M. Arnold, Lie group generalized-alpha time integration of constrained flexible "
           "multibody systems, Mech. Mach. Theory 48 "
           "(2012) 121; "
           "subject of A. Cardona, An Integrated Approach to Mechanism Analysis, thesis, Liege 1989, ch. 2",
    model="A body of 15 kg, J = diag(0.234375, 0.46875, 0.234375) kg m^2 about its centre, 1 m from a fixed ball "
          "joint, spins with 150 rad/s in gravity and "
          "precesses with 4.6 rad/s, for 1 s. The node is the centre, so that the joint is a constraint. "
          "Generalised-alpha on the Lie group, rho = 0.9.",
    quick=True,
    studies=[
        Study("Constraints of positions, corrected velocities (default)", top("corrected"), [1e-3, 5e-4, 2.5e-4],
              quantities(1)),
        Study("Positions and velocities together", top("stabilized"), [1e-3, 5e-4, 2.5e-4], quantities(1)),
    ])
