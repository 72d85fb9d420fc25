"""Writes results as a time series for ParaView: one .pvd to open, and per time one .vtu for each kind of thing.

    <element>   a superelement: its surface (or whole mesh), with elastic displacement and von Mises stress
    rigid       rigid bodies as ellipsoids of their mass and inertia
    beams       lines through the beams' nodes, with section axes, resultants and stress
    nodes       points with axes and velocity, to be drawn as glyphs
    joints      points with the reaction on the second node, to be drawn as arrows, and the forces of drives
"""

import contextlib
import io
import os
import re

import numpy as np

from .bodies.superelement_body import superelement_of
from .mesh.cells import SOLIDS
from .mesh.meshio_library import meshio_library
from .messages import InputError
from .results.results_file import modes_to_show
from .results.rigid_bodies import rigid_bodies
from .results.rotations import rotation_matrices
from .scene.beams import beam_motion, beam_stress, turns_of
from .scene.drawing import Drawing

RESULTANTS = ["axial_force", "shear_force_y", "shear_force_z", "torque", "bending_moment_y", "bending_moment_z"]


def export(results, folder, name, *, every=None, count=100, span=(None, None), scale=1.0, volume=False, superelements=None):
    """Writes `folder/name.pvd` and `folder/name/*.vtu`.

    every: every so many recorded times, or count: about so many, within span = (from, to) [s]; scale: magnifies elastic displacements of
    superelements; volume: their solid cells, not only the surface; superelements: {element: path} to override.
    @returns path of the .pvd
    """
    if not len(results.time):
        raise InputError(f"'{results.path}' holds no motion to show" + modes_to_show(results))
    rows = results.frames(every, count, span)
    parts = [_superelement(results, element, superelements or {}, scale, volume, rows)
             for element in results.elements_with("frame")]
    parts += [part for part in (_rigid(results), _beams(results), _nodes(results), _joints(results)) if part]
    if not parts:
        raise InputError(f"'{results.path}' records no nodes, beams or superelements")

    inside = os.path.join(folder, name)
    os.makedirs(inside, exist_ok=True)
    for file in os.listdir(inside):  # frames of an earlier export would mix with the new ones; the folder may hold other things
        if re.fullmatch(r".+_\d{4,}\.vtu", file):
            os.remove(os.path.join(inside, file))
    lines = []
    for frame, row in enumerate(rows):
        for index, (part, mesh_at) in enumerate(parts):
            file = f"{_file_name(part)}_{frame:04d}.vtu"
            try:
                _write(os.path.join(inside, file), mesh_at(row))
            except (IndexError, ValueError):
                raise InputError(f"'{results.path}' is damaged: what it holds of '{part}' does not fit together") from None
            lines.append(f'    <DataSet timestep="{results.time[row]:.9g}" part="{index}" name="{part}" file="{name}/{file}"/>')
    path = os.path.join(folder, f"{name}.pvd")
    with open(path, "w", encoding="utf-8") as pvd:
        pvd.write('<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1" byte_order="LittleEndian">\n  <Collection>\n')
        pvd.write("\n".join(lines) + "\n  </Collection>\n</VTKFile>\n")
    return path


def _superelement(results, element, given, scale, volume, rows):
    body = superelement_of(results, element, given)
    if not body.cells:
        cells = {"vertex": np.arange(len(body.points))[:, None]}  # matrices without cells have nodes alone
    else:
        cells = {kind: c for kind, c in body.cells.items() if kind in SOLIDS} if volume else body.surface()
    used = np.unique(np.concatenate([c.ravel() for c in cells.values()]))
    number = np.full(len(body.points), -1)
    number[used] = np.arange(len(used))
    cells = [(kind, number[c]) for kind, c in cells.items()]
    place = f"elements/{element}"

    blocks = body.blocks(list(rows))
    ready = {}  # fields of the rows of a block, by row

    def mesh_at(row):
        if row not in ready:
            ready.clear()
            block = next(block for block in blocks if row in block)
            q = np.stack([results.rows(f"{place}/coordinates", other) for other in block])
            stresses = body.von_mises(q)
            for k, (other, u) in enumerate(zip(block, body.local_displacement(q))):
                ready[other] = u, None if stresses is None else stresses[k]
        u, stress = ready[row]
        positions, displacement = body.placed(results.rows(f"{place}/frame", row), u, scale)
        data = {"displacement": displacement[used]}
        if stress is not None:
            data["von_mises"] = stress[used]
        return positions[used], cells, data, {}

    return element, mesh_at


def _rigid(results):
    bodies = [body for body in rigid_bodies(results) if body.extended]
    if not bodies:
        return None
    first = np.cumsum([0] + [len(body.points) for body in bodies])
    triangles = np.concatenate([body.triangles + start for body, start in zip(bodies, first)])
    number = [np.repeat(np.arange(len(bodies)), [len(body.triangles) for body in bodies])]

    def mesh_at(row):
        points = np.concatenate([body.place(results, row)[0] for body in bodies])
        return points, [("triangle", triangles)], {}, {"rigid_body": number}

    return "rigid", mesh_at


def _beams(results):
    names = results.elements_with("position", "rotation")
    if not names:
        return None
    counts = [len(results.rows(f"elements/{name}/position", 0)) for name in names]
    first = np.cumsum([0] + counts)
    lines = np.concatenate([np.column_stack([np.arange(n - 1), np.arange(1, n)]) + start for n, start in zip(counts, first)])
    turns = {item.get("element"): turns_of(item) for item in Drawing(results).items if item["shape"] == "beam"}
    stresses = [beam_stress(results, f"elements/{name}") for name in names]
    motions = [beam_motion(results, f"elements/{name}", turns.get(f"elements/{name}"))[0] for name in names]

    def mesh_at(row):
        poses = np.concatenate([poses_of([row])[0] for poses_of in motions])
        points, axes = poses[:, :3], rotation_matrices(poses[:, 3:7])
        data = {"section_y": axes[:, :, 1], "section_z": axes[:, :, 2]}
        cell_data = {"beam": [np.repeat(np.arange(len(names)), np.array(counts) - 1)]}
        if all(results.has(f"elements/{name}/resultants") for name in names):
            table = np.concatenate([results.rows(f"elements/{name}/resultants", row) for name in names])
            cell_data.update({title: [table[:, k]] for k, title in enumerate(RESULTANTS)})
        if any(stresses):
            cell_data["von_mises"] = [np.concatenate([stress([row])[0] if stress else np.full(n - 1, np.nan) for stress, n in zip(stresses, counts)])]
        return points, [("line", lines)], data, cell_data

    return "beams", mesh_at


def _nodes(results):
    names = results.names("nodes")
    if not names:
        return None
    vertices = np.arange(len(names))[:, None]

    def mesh_at(row):
        def of(quantity):
            return np.array([results.rows(f"nodes/{name}/{quantity}", row) for name in names])

        axes = rotation_matrices(of("rotation"))
        data = {"axis_x": axes[:, :, 0], "axis_y": axes[:, :, 1], "axis_z": axes[:, :, 2],
                "velocity": of("velocity")[:, :3], "node": np.arange(len(names))}
        return of("position"), [("vertex", vertices)], data, {}

    return "nodes", mesh_at


def _joints(results):
    """Joints are drawn at their second node, which the results name in an attribute."""
    places = {}
    for joint in results.names("joints"):
        node = results.text(f"joints/{joint}", "second_node")
        if results.has(f"nodes/{node}") and results.has(f"joints/{joint}/reaction_inertial"):
            places[joint] = node
    if not places:
        return None
    vertices = np.arange(len(places))[:, None]
    driven = [joint for joint in places if results.has(f"joints/{joint}/drive_force")]
    width = max((len(results.rows(f"joints/{joint}/drive_force", 0)) for joint in driven), default=0)

    def mesh_at(row):
        points = np.array([results.rows(f"nodes/{node}/position", row) for node in places.values()])
        reaction = np.array([results.rows(f"joints/{joint}/reaction_inertial", row) for joint in places])
        data = {"reaction_force": reaction[:, :3], "reaction_moment": reaction[:, 3:], "joint": np.arange(len(places))}
        if driven:
            force = np.zeros((len(places), width))  # along the joints' coordinates, in their order
            for index, joint in enumerate(places):
                if joint in driven:
                    values = results.rows(f"joints/{joint}/drive_force", row)
                    force[index, :len(values)] = values
            data["drive_force"] = force
        return points, [("vertex", vertices)], data, {}

    return "joints", mesh_at


def _write(path, mesh):
    meshio = meshio_library()
    points, cells, point_data, cell_data = mesh
    with contextlib.redirect_stdout(io.StringIO()):
        meshio.Mesh(points, cells, point_data=point_data, cell_data=cell_data).write(path, file_format="vtu", binary=True)


def _file_name(part):
    return re.sub(r"[^A-Za-z0-9_.-]", "_", part)


def legend(results):
    """Lines that map the numbers in the files to nodes, beams and rigid bodies, and give the meaning of the time in
    statics."""
    numbered = (("node", results.names("nodes")), ("beam", results.elements_with("position", "rotation")),
                ("rigid_body", [body.name for body in rigid_bodies(results) if body.extended]))
    lines = [f"array '{title}': " + ", ".join(f"{k} {name}" for k, name in enumerate(names))
             for title, names in numbered if names]
    return lines + (["time in ParaView is the load factor of a static analysis"] if results.static else [])
