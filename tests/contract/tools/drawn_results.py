"""Writes results files with `/drawing`, with nodes on known paths and items of every shape."""

import json

import h5py
import numpy as np


def write_results(path, nodes, items, times=None, gravity=(0, 0, -9.81), name="drawn", meshes=None, complete=1, extra=None):
    """Writes a file. `nodes` is {name: (positions (nt,3), quaternions (nt,4))}, `meshes` is {name: (points,
    triangles)}, and `extra(file)` adds more."""
    rows = len(next(iter(nodes.values()))[0]) if nodes else 0
    times = np.arange(rows) * 0.01 if times is None else times
    with h5py.File(path, "w") as file:
        file.attrs.update({"format": "bielle results", "version": 1, "name": name, "layout": "named", "complete": complete})
        group = file.create_group("analysis_1")
        group.attrs["type"] = "dynamic"
        group["time"] = times
        for node, (x, q) in nodes.items():
            entry = group.create_group(f"nodes/{node}")
            entry["position"], entry["rotation"], entry["velocity"] = x, q, np.zeros((len(times), 6))
            entry["position"].attrs["units"] = "m"
        for each in ("time", "nodes"):
            if each in group:
                file[each] = group[each]
        if items is not None:
            file["drawing"] = json.dumps({"format": "bielle drawing", "version": 1, "name": name, "gravity": list(gravity), "items": items})
        for mesh, (points, triangles) in (meshes or {}).items():
            file[f"drawing_meshes/{mesh}/points"] = np.asarray(points, np.float32)
            file[f"drawing_meshes/{mesh}/triangles"] = np.asarray(triangles, np.int32)
        if extra:
            extra(file)
    return path


def turning(rows, axis, rate=0.1):
    """Returns quaternions (rows,4) of a rotation about an axis that increases by `rate` per row [rad]."""
    half = 0.5 * rate * np.arange(rows)
    return np.column_stack([np.cos(half), np.sin(half)[:, None] * np.asarray(axis, float)])


def resting(rows, position=(0, 0, 0)):
    """Returns a node at rest."""
    return np.tile(np.asarray(position, float), (rows, 1)), np.tile([1.0, 0, 0, 0], (rows, 1))


def write_check(path, failure="", redundant=(), apart=0.0):
    """Writes the file of a model that was only checked: a bar on two hinges. The frames of the second one have the
    distance `apart` along y [m]."""
    items = [{"entry": f"joints/{name}", "type": "hinge", "shape": "joint", "frames": [{"node": "ground", "position": [x, 0, 0]}, {"node": "n", "position": [x, y, 0]}]}
             for name, x, y in (("first", 0, 0), ("second", 1, apart))]
    items.append({"entry": "elements/bar", "type": "rigid_body", "shape": "box", "node": "n", "position": [0.5, 0, 0], "size": [1, 0.1, 0.1]})

    def extra(file):
        file["analysis_1"].attrs.update({"type": "check", "assembled": int(not failure), **({"failure": failure} if failure else {})})
        if redundant:
            file["redundant"] = list(redundant)
    return write_results(path, {"n": resting(1)}, items, extra=extra)


def stressed_beam(name="beam", turn=None):
    """Returns an item and a function that adds its records: a beam along x of 2 elements in 3 rows, whose sections have
    two points. Its largest stresses [Pa] are STRESSES."""
    item = {"entry": f"elements/{name}", "type": "beam", "shape": "beam", "element": f"elements/{name}", **({"turn": turn} if turn else {}),
            "sections": [{"at": 0, "outer": [[0.1, 0.1], [-0.1, 0.1], [-0.1, -0.1], [0.1, -0.1]]}]}

    def records(file):
        group = file.create_group(f"analysis_1/elements/{name}")
        group.attrs["type"] = "beam"
        group["position"] = np.tile([[0.0, 0, 0], [1, 0, 0], [2, 0, 0]], (3, 1, 1))
        group["rotation"] = np.tile([1.0, 0, 0, 0], (3, 3, 1))
        group["von_mises"] = np.stack([0.25 * STRESSES, STRESSES], axis=2)
        group["von_mises"].attrs["units"] = "Pa"
        file["elements"] = file["analysis_1/elements"]
    return item, records


STRESSES = 1e6 * np.array([[0.0, 10.0], [20.0, 40.0], [100.0, np.nan]])  # (rows, elements)
JOINTS = ("hinge", "spherical", "prismatic", "cylindrical", "universal", "constant_velocity", "planar", "point_on_line", "rigid", "screw", "bearing",
          "bushing", "slider", "gear")


def every_shape(rows=31):
    """Returns (nodes, items, meshes) with every shape."""
    nodes = {"wheel": (resting(rows, (0, 0, 0))[0], turning(rows, (0, 0, 1))),
             "crank": (resting(rows, (1, 0, 0))[0], turning(rows, (0, 1, 0), 0.05)),
             "end": (np.column_stack([1.6 + 0.2 * np.sin(0.2 * np.arange(rows)), np.zeros(rows), 0.6 * np.ones(rows)]), resting(rows)[1])}
    tilt = [np.cos(np.pi / 4), np.sin(np.pi / 4), 0, 0]
    items = [{"entry": f"joints/{kind}", "type": kind, "shape": "joint",
              "frames": [{"node": "ground", "position": [0.4 * k, 1.5, 0], "rotation": tilt}, {"node": "ground", "position": [0.4 * k, 1.5, 0], "rotation": tilt}]}
             for k, kind in enumerate(JOINTS)]
    solids = [("box", {"size": [0.3, 0.2, 0.1]}), ("cylinder", {"radius": 0.1, "length": 0.3}), ("tube", {"radius": 0.12, "inner_radius": 0.08, "length": 0.3}),
              ("cone", {"radii": [0.12, 0.03], "length": 0.3}), ("sphere", {"radius": 0.12}), ("gear", {"radius": 0.15}), ("gear", {"radius": 0.15, "inner": True}),
              ("pulley", {"radius": 0.15}), ("tyre", {"radius": 0.18}), ("cam", {"contour": [[0.1, 0], [0.05, 0.1], [-0.08, 0.05], [-0.08, -0.05], [0.05, -0.1]]}),
              ("curve", {"points": [[0, 0, 0], [0.2, 0, 0.1], [0.3, 0.1, 0.1]], "closed": True}), ("mesh", {"mesh": "stone"})]
    items += [{"entry": f"elements/{shape}_{k}", "type": "rigid_body", "shape": shape, "node": "ground", "position": [0.4 * k, -1.2, 0], **keys}
              for k, (shape, keys) in enumerate(solids)]
    items += [{"entry": f"elements/{shape}", "type": "spring_damper", "shape": shape, **keys,
               "ends": [{"node": "ground", "position": [2 + 0.3 * k, 0, 0]}, {"node": "end", "position": [0.4 + 0.3 * k, 0, 0]}]}
              for k, (shape, keys) in enumerate([("bar", {}), ("coil", {}), ("damper", {}), ("coil_damper", {}), ("jack", {"stroke": [0.5, 0.9]}), ("rope", {})])]
    items += [{"entry": "elements/crank", "type": "rigid_body", "shape": "body", "node": "crank", "centre": [0.2, 0, 0]},
              {"entry": "joints/pin", "type": "hinge", "shape": "joint", "frames": [{"node": "ground", "position": [1, 0, 0], "rotation": tilt},
                                                                                    {"node": "crank", "rotation": tilt}]},
              {"entry": "joints/belt", "type": "belt", "shape": "course", "closed": True,
               "points": [{"node": "wheel", "radius": 0.2, "side": 1}, {"node": "ground", "position": [0.7, 0, 0], "radius": 0.1, "side": 1}]},
              {"entry": "elements/wheel", "type": "rigid_body", "shape": "pulley", "node": "wheel", "radius": 0.2},
              {"entry": "elements/field", "type": "stiffness_field", "shape": "stiffness", "places": [{"node": "wheel"}, {"node": "crank"}, {"node": "end"}]},
              {"entry": "contacts/floor", "type": "contact", "shape": "plane", "node": "ground", "position": [0, 0, -0.5]},
              {"entry": "nodes/end", "type": "node", "shape": "node", "node": "end"},
              {"entry": "nodes/wheel", "type": "node", "shape": "support", "node": "wheel", "fixed": ["x", "y", "z", "rx", "ry", "rz"]},
              {"entry": "elements/push", "type": "force", "shape": "force", "node": "end"},
              {"entry": "elements/odd", "type": "odd", "shape": "hyperboloid", "node": "end"}]
    stone = (0.1 * np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], float), [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])
    return nodes, items, {"stone": stone}
