"""A superelement and a results file with a motion known in closed form, in the layout of the two programs.

A box rotates about z with OMEGA, the origin of its frame moves along x with SPEED, and it is stretched along its own x
axis by the strain STRAIN sin(2 pi t / DURATION), with the von Mises stress YOUNG |strain|. A beam is at rest, and a
hinge rotates. A solid ellipsoid of uniform density with the semi-axes SEMI_AXES is fixed to the node of the box, at
CENTRE.
"""

import h5py
import numpy as np

from box_mesh import box

OMEGA, SPEED, STRAIN, YOUNG, DURATION = 30.0, 0.5, 1e-3, 210e9, 0.1
VTK_TO_GMSH = [0, 1, 2, 3, 4, 5, 6, 7, 9, 8]
BEAM_NODES = 5
SEMI_AXES, CENTRE, MASS = np.array([0.03, 0.02, 0.01]), np.array([0.0, 0.05, 0.0]), 2.0


def strain(time):
    return STRAIN * np.sin(2 * np.pi * time / DURATION)


def positions(points, time, scale=1.0):
    """Returns the positions of the points (p,3) of the box at a time."""
    c, s = np.cos(OMEGA * time), np.sin(OMEGA * time)
    stretched = points * [1 + scale * strain(time), 1, 1]
    return stretched @ np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]).T + [SPEED * time, 0, 0]


def write_superelement(path, divisions=(4, 2, 2)):
    points, cells = box(divisions, (0.3, 0.05, 0.05))
    n = 2  # an idle coordinate, and the stretch
    with h5py.File(path, "w") as file:
        file.attrs.update({"format": "bielle superelement", "version": 1, "name": "box", "complete": True})
        put(file, "mesh/points", points, "m")
        put(file, "mesh/cells/11", cells[:, VTK_TO_GMSH], "")
        u = np.zeros((len(points), 3, n))
        u[:, 0, 1] = points[:, 0]
        put(file, "recovery/displacement", u.reshape(-1, n), "m")
        surface = np.flatnonzero((points[:, 2] == 0) | (points[:, 2] == 0.05))
        sigma = np.zeros((len(surface), 6, n))
        sigma[:, 0, 1] = YOUNG
        put(file, "recovery/stress", sigma.reshape(-1, n), "Pa")
        put(file, "recovery/stress_nodes", surface, "")
    return points, cells


def write_results(path, superelement, rows=41, complete=True, extra_rows=0, analysis=""):
    """Writes the results file. If `analysis` is a type, the results are in a group with links at the root, as the
    program writes them."""
    time = np.linspace(0, DURATION, rows)
    more = np.concatenate([time, np.zeros(extra_rows)])
    half = 0.5 * OMEGA * more
    zero = np.zeros_like(more)
    turn = np.column_stack([np.cos(half), zero, zero, np.sin(half)])
    origin = np.column_stack([SPEED * more, zero, zero])
    with h5py.File(path, "w") as root:
        root.attrs.update({"format": "bielle results", "version": 1, "complete": complete})
        file = root.create_group("analysis_1") if analysis else root
        file.attrs.update({"type": analysis} if analysis else {})
        put(file, "time", time, "s")
        put(file, "nodes/hub/position", origin, "m")
        put(file, "nodes/hub/rotation", turn, "")
        put(file, "nodes/hub/velocity", np.column_stack([zero + SPEED, zero, zero, zero, zero, zero + OMEGA]), "")
        put(file, "joints/main/coordinate", np.column_stack([SPEED * more, OMEGA * more]), "m, rad")
        put(file, "joints/main/rate", np.column_stack([zero + SPEED, zero + OMEGA]), "m/s, rad/s")
        for name in ("coordinate", "rate"):
            file[f"joints/main/{name}"].attrs["description"] = "displacement, angle"
        put(file, "joints/main/reaction", np.column_stack([zero + 3, zero + 4, zero, zero, zero, np.sin(more)]), "N, N m")
        put(file, "joints/main/reaction_inertial", np.column_stack([zero + 3, zero + 4, zero, zero, zero, zero]), "N, N m")
        put(file, "joints/main/drive_force", np.column_stack([zero, 7 + more]), "N, N m")
        file["joints/main"].attrs.update({"first_node": "ground", "second_node": "hub"})
        put(file, "elements/rod/frame", np.column_stack([origin, turn]), "m")
        put(file, "elements/rod/coordinates", np.column_stack([zero, strain(more)]), "m")
        file["elements/rod"].attrs["file"] = superelement
        line = np.zeros((len(more), BEAM_NODES, 3))
        line[:, :, 2] = np.linspace(0, 0.2, BEAM_NODES)
        put(file, "elements/shaft/position", line, "m")
        put(file, "elements/shaft/rotation", np.tile([1.0, 0, 0, 0], (len(more), BEAM_NODES, 1)), "")
        resultants = np.zeros((len(more), BEAM_NODES - 1, 6))
        resultants[:, :, 0] = 10 * np.arange(1, BEAM_NODES)
        put(file, "elements/shaft/resultants", resultants, "N, N m")
        put(file, "elements/shaft/von_mises", np.abs(resultants[:, :, :2]) * [1e6, 2e6], "Pa")
        squares = SEMI_AXES ** 2
        moments = MASS / 5 * (squares.sum() - squares)
        ball = file.create_group("elements/ball")
        ball.attrs.update({"type": "rigid_body", "node": "hub", "mass": str(MASS), "centre": " ".join(map(str, CENTRE)),
                           "inertia": " ".join(map(str, [*moments, 0.0, 0.0, 0.0]))})
        put(file, "elements/ball/centre", origin, "m")
        put(file, "elements/ball/angular_momentum", origin, "N m s")
        put(file, "elements/ram/pressure", np.column_stack([1e5 + more, 2e5 - more]), "Pa")
        for name, values in (("kinetic", 5 + more), ("elastic", more ** 2), ("input", more), ("balance", 1e-9 * more)):
            put(file, f"energy/{name}", values, "J")
        put(file, "solver/newton_iterations", np.minimum(3, np.arange(len(more))), "")
        for name in file if analysis else ():
            root[name] = h5py.SoftLink(f"/analysis_1/{name}")
    return time


def stack(path):
    """Converts a results file by names to the stacked layout of the program: entries that record the same quantities
    are one kind."""
    with h5py.File(path, "r+") as file:
        root = file["analysis_1"] if "analysis_1" in file else file
        for section in ("nodes", "elements", "joints"):
            entries = {name: root[section][name] for name in root[section]}
            kinds = {}
            for name, group in entries.items():
                signature = (group.attrs.get("type", "thing"), tuple((d, group[d].shape) for d in group))
                kinds.setdefault(signature, []).append(name)
            stacked = root.create_group("stacked")
            for number, ((kind, fields), names) in enumerate(kinds.items()):
                group = stacked.create_group(f"{kind}_{number}")
                group.attrs["type"] = kind
                text = h5py.string_dtype()
                group.create_dataset("name", data=names, dtype=text)
                for field, _ in fields:
                    group[field] = np.stack([entries[name][field][()] for name in names], axis=1)
                    group[field].attrs.update(dict(entries[names[0]][field].attrs))
                for key in {key for name in names for key in entries[name].attrs} - {"type"}:
                    group.create_dataset(f"attributes/{key}", dtype=text,
                                         data=[str(entries[name].attrs.get(key, "")) for name in names])
            del root[section]
            root.move("stacked", section)
        file.attrs["layout"] = "stacked"


def put(file, place, values, units):
    file[place] = values
    file[place].attrs["units"] = units
