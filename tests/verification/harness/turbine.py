"""The NREL 5 MW turbine on land as a mechanism of beams, from the section constants of tests/verification/data.

J. Jonkman, S. Butterfield, W. Musial, G. Scott, Definition of a 5-MW reference wind turbine for offshore system
development, NREL/TP-500-38060 (2009). The numbers are those of the input files of OpenFAST (ElastoDyn, BeamDyn). x
points downwind, z up; the foot of the tower is the origin. The report has no shear stiffness, and the blades are
Bernoulli beams in FAST: shear is a hundred times as stiff as stretching. Centres of mass lie on the axis of the blade,
as in BeamDyn's file.
"""

import os

import numpy as np

FOLDER = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "data")
GRAVITY = 9.80665                                  # [m/s^2]
BLADE_LENGTH, HUB_RADIUS, CONE, TILT = 61.5, 1.5, np.radians(2.5), np.radians(5)
TOWER_HEIGHT, SHAFT_ABOVE, OVERHANG = 87.6, 1.96256, 5.0191
BLADE_MASS = 17740.0                               # [kg], to which the report scales the table's 16845 kg
HUB_MASS, HUB_INERTIA = 56780.0, 115926.0
NACELLE_MASS, NACELLE_CENTRE, NACELLE_YAW_INERTIA = 240000.0, np.array([1.9, 0, 1.75]), 2607890.0
YAW_STIFFNESS, DRIVETRAIN_STIFFNESS = 9028320000.0, 867637000.0
STEEL = {"young": 210e9, "shear": 80.8e9, "density": 8500.0}
RATED = 12.1 * np.pi / 30                          # [rad/s]
UPWIND = np.array([-np.cos(TILT), 0, np.sin(TILT)])  # along the shaft, from the tower to the hub
CENTRE = [-OVERHANG * np.cos(TILT), 0.0, TOWER_HEIGHT + SHAFT_ABOVE + OVERHANG * np.sin(TILT)]


def table(name):
    """The columns of a table by name."""
    data = np.genfromtxt(os.path.join(FOLDER, name), delimiter=",", names=True)
    return {each: data[each] for each in data.dtype.names}


def constants(axial, torsion, flap, edge, mass, flap_inertia, edge_inertia):
    """A section with y chordwise and z normal to it, as keys of the model file."""
    return {"EA": axial, "GAy": 100 * axial, "GAz": 100 * axial, "GJ": torsion, "EIy": flap, "EIz": edge,
            "mass_per_length": mass, "Jx": flap_inertia + edge_inertia, "Jy": flap_inertia, "Jz": edge_inertia}


def blade_sections(mass=None):
    """Stations [m], twist [rad] and sections of the blade. @param mass  of the blade [kg], to which the table is scaled
    """
    t = table("nrel_5mw_blade.csv")
    z = BLADE_LENGTH * t["fraction"]
    factor = mass / np.trapz(t["mass"], z) if mass else 1.0
    return z, np.radians(t["twist_degrees"]), [
        constants(*(float(t[name][k]) for name in ("axial_stiffness", "torsion_stiffness", "flap_stiffness",
                                                   "edge_stiffness")),
                  *(float(factor * t[name][k]) for name in ("mass", "flap_inertia", "edge_inertia")))
        for k in range(len(z))]


def blade(prefix, root, position, axis, downwind, every=1, mass=None, each=1):
    """Nodes and beams of a blade.

    @param root  name of the node at its root  @param position  of the root  @param axis  direction of the blade
    @param downwind  normal to it, towards the tower  @param every  one beam for this number of intervals of the table
    @param each  elements of each beam
    """
    z, twist, sections = blade_sections(mass)
    rear = np.cross(axis, downwind)  # towards the trailing edge
    used = list(range(0, len(z), every))
    names = [root] + [f"{prefix}_{k}" for k in used[1:]]
    nodes = {name: {"position": (position + z[k] * axis).tolist()} for name, k in zip(names[1:], used[1:])}
    beams = {}
    for n, (k, after) in enumerate(zip(used, used[1:])):
        beams[f"{prefix}_{n}"] = {
            "type": "beam", "nodes": [names[n], names[n + 1]], "elements": each,
            "orientation": (np.sin(twist[k]) * downwind + np.cos(twist[k]) * rear).tolist(),
            "twist": float(twist[k] - twist[after]), "section": [sections[k], sections[after]]}
    return nodes, beams


def tower(foot, top, every):
    """Nodes and beams of the tower between two nodes, one beam for each `every` intervals of the table."""
    t = table("nrel_5mw_tower.csv")
    z = TOWER_HEIGHT * t["fraction"]
    sections = []
    for mass, bending in zip(t["mass"], t["bending_stiffness"]):
        inertia = bending * STEEL["density"] / STEEL["young"]
        sections.append(constants(float(mass * STEEL["young"] / STEEL["density"]),
                                  float(2 * bending * STEEL["shear"] / STEEL["young"]), float(bending), float(bending),
                                  float(mass), float(inertia), float(inertia)))
    used = list(range(0, len(z), every))
    names = [foot] + [f"tower_{k}" for k in used[1:-1]] + [top]
    nodes = {name: {"position": [0, 0, float(z[k])]} for name, k in zip(names, used)}
    return nodes, {f"tower_{n}": {"type": "beam", "nodes": [names[n], names[n + 1]], "elements": 1,
                                  "orientation": [1, 0, 0], "section": [sections[k], sections[after]]}
                   for n, (k, after) in enumerate(zip(used, used[1:]))}


def clamped_blade(rate, each):
    """Model of a blade that turns about x, through its hub, in the plane of rotation, along z.

    @param rate  speed [rad/s]  @param each  elements in each interval of the table
    """
    nodes, beams = blade("blade", "root", np.array([0, 0, HUB_RADIUS]), np.array([0, 0, 1.0]), np.array([1.0, 0, 0]),
                         each=each)
    hub = {"fixed": ["x", "y", "z", "ry", "rz"], "motion": {"rx": f"{rate!r}*t"}} if rate else {"fixed": True}
    return {"nodes": {"hub": hub, "root": {"position": [0, 0, HUB_RADIUS]}, **nodes}, "elements": beams,
            "joints": {"bolts": {"type": "rigid", "nodes": ["hub", "root"]}}}


def turbine(every, yaw_stiffness=YAW_STIFFNESS):
    """Model of the whole turbine, its generator locked: the joint `shaft`, whose rate a rotation prescribes. The spring
    of the drivetrain is in the joint `coupling`.

    @param every  one beam of a blade for this number of intervals of the table  @param yaw_stiffness [N m/rad]
    """
    nodes, elements = tower("foot", "top", 2)
    nodes["foot"]["fixed"] = True
    yaw_axis = [0, 0, TOWER_HEIGHT]
    # The yaw inertia of the report is about the tower's axis; that of the nacelle about its other axes is not given.
    yaw_inertia = NACELLE_YAW_INERTIA - NACELLE_MASS * NACELLE_CENTRE[0]**2
    nodes["nacelle"] = {"position": (np.array(yaw_axis) + NACELLE_CENTRE).tolist()}
    nodes["generator"] = {"position": CENTRE}
    nodes["hub"] = {"position": CENTRE}
    # No body has a moment about one axis alone, as the nacelle of FAST: a plate has half of it about the two others.
    elements["nacelle"] = {"type": "rigid_body", "node": "nacelle", "mass": NACELLE_MASS,
                           "inertia": [yaw_inertia / 2, yaw_inertia / 2, yaw_inertia]}
    elements["hub"] = {"type": "rigid_body", "node": "hub", "mass": HUB_MASS,
                       "inertia": [HUB_INERTIA, HUB_INERTIA, HUB_INERTIA]}
    shaft = (-UPWIND).tolist()
    joints = {
        "yaw": {"type": "hinge", "nodes": ["top", "nacelle"], "position": yaw_axis, "axis": [0, 0, 1],
                "stiffness": yaw_stiffness},
        "shaft": {"type": "hinge", "nodes": ["nacelle", "generator"], "position": CENTRE, "axis": shaft,
                  "locked": True},
        "coupling": {"type": "hinge", "nodes": ["generator", "hub"], "position": CENTRE, "axis": shaft,
                     "stiffness": DRIVETRAIN_STIFFNESS},
    }
    for k in range(3):
        a = 2 * np.pi * k / 3
        radial = np.cos(a) * np.array([np.sin(TILT), 0, np.cos(TILT)]) - np.sin(a) * np.array([0, 1.0, 0])
        axis = np.cos(CONE) * radial + np.sin(CONE) * UPWIND
        downwind = np.sin(CONE) * radial - np.cos(CONE) * UPWIND
        root = np.array(CENTRE) + HUB_RADIUS * axis
        more, beams = blade(f"blade_{k + 1}", f"root_{k + 1}", root, axis, downwind, every, BLADE_MASS)
        nodes[f"root_{k + 1}"] = {"position": root.tolist()}
        nodes.update(more)
        elements.update(beams)
        joints[f"bolts_{k + 1}"] = {"type": "rigid", "nodes": ["hub", f"root_{k + 1}"]}
    return {"gravity": [0, 0, -GRAVITY], "nodes": nodes, "elements": elements, "joints": joints}
