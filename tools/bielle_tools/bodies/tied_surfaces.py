"""Surfaces of a mesh to which the interfaces of a superelement are tied."""

from dataclasses import dataclass

import h5py
import numpy as np
import yaml

from ..mesh import cell_integrals
from ..messages import InputError, did_you_mean
from .interface_ties import spread_over_nodes, tie_of_interface, weighted_nodes
from .superelement_body import decoded


@dataclass
class TiedSurface:
    name: str
    rigid: bool
    position: np.ndarray  # position of the interface, body axes [m]
    nodes: np.ndarray     # mesh nodes, from 0
    spread: np.ndarray    # (nodes,3,6) forces on the nodes per unit force and moment on the interface; of rigid ones None


def tied_surfaces(path, group, body, interfaces, positions, given):
    """Returns one surface for each interface. A rigid tie is recognised in the displacements: its nodes move with the
    interface alone. For an average tie the surface is the group that the body file names, or `given` {interface:
    group}; or it is the nodes of a tie of a deck."""
    with h5py.File(path) as file:
        opened = file[group] if group else file
        text = (opened["input"] if "input" in opened else file["input"])[()]
        body_file = yaml.safe_load(text.decode() if isinstance(text, bytes) else text)
        groups = {decoded(name): np.asarray(nodes, int)
                  for name, nodes in opened["mesh/groups"].items()} if "mesh/groups" in opened else {}
    faces, found, first = body.surface(), [], 0
    for name in given:
        if name not in [each for each, _, _ in interfaces]:
            raise InputError(f"--surface {name}: there is no interface '{name}'{did_you_mean(name, [each for each, _, _ in interfaces])}")
    for (name, kept, axes), position in zip(interfaces, positions):
        columns = np.arange(first, first + kept.sum())
        first += int(kept.sum())
        entry = body_file.get("interfaces", {}).get(name, {})
        if "from" in entry:
            tie, of_deck = tie_of_interface(path, name, body_file)
            if tie["tie"] == "average" and "nodes" in tie:
                nodes, weights = weighted_nodes(path, name, body.points, tie, of_deck)
                found.append(TiedSurface(name, False, position, nodes, spread_over_nodes(body.points[nodes], weights, position)))
                continue
            entry = {"tie": tie["tie"], "surface": tie.get("surface")}
        if entry.get("tie", "rigid") == "rigid":
            found.append(TiedSurface(name, True, position, _carried(name, path, body, kept, axes, position, columns), None))
        elif entry["tie"] == "average":
            nodes = _group_nodes(name, path, given.get(name, entry.get("surface")), groups)
            found.append(TiedSurface(name, False, position, nodes, _spread(name, path, body.points, faces, nodes, position)))
        else:
            raise InputError(f"'{path}': interface '{name}' has a free tie: each of its nodes is an interface, whose force is not "
                             "spread; loads are exported for rigid and average ties")
    return found


def _carried(name, path, body, kept, axes, position, columns):
    """Returns the nodes that move with the interface alone, as a rigid body."""
    if not kept.all():
        raise InputError(f"'{path}': the rigid interface '{name}' does not keep all directions: its surface moves by itself")
    T = body.displacement.reshape(len(body.points), 3, -1)
    r = body.points - position
    expected = np.zeros_like(T)
    for k in range(3):
        expected[:, :, columns[k]] = axes[:, k]
        expected[:, :, columns[3 + k]] = np.cross(axes[:, k], r)
    size = np.abs(T).max(axis=(0, 1))
    nodes = np.flatnonzero((np.abs(T - expected) <= 1e-9 * np.where(size > 0, size, 1)).all(axis=(1, 2)))
    if not len(nodes):
        raise InputError(f"'{path}': no node of the mesh moves with the rigid interface '{name}'")
    return nodes


def _group_nodes(name, path, surface, groups):
    names = surface if isinstance(surface, list) else [surface]
    if not all(isinstance(each, str) for each in names):
        raise InputError(f"'{path}': the surface of interface '{name}' is given by a shape; say which group of the mesh it is: "
                         f"--surface {name}=GROUP (there are: {', '.join(groups) or 'none'})")
    for each in names:
        if each not in groups:
            raise InputError(f"'{path}': its mesh has no group '{each}'{did_you_mean(each, groups)}")
    return np.unique(np.concatenate([groups[each] for each in names]))


def _spread(name, path, points, faces, nodes, position):
    """Returns the forces for the surface's mean motion: force F and moment M about the centroid are the traction F/A +
    (J^-1 M) x r."""
    on = np.zeros(len(points), bool)
    on[nodes] = True
    chosen = {kind: block[on[block].all(axis=1)] for kind, block in faces.items()}
    if not any(len(block) for block in chosen.values()):
        raise InputError(f"'{path}': the group of interface '{name}' holds no faces of the surface")
    weights = cell_integrals.surface_integrals(points, chosen, lambda x: np.ones(len(x)))
    first = cell_integrals.surface_integrals(points, chosen, lambda x: x).sum(axis=0)
    area = weights.sum()
    centre = first / area
    moments = cell_integrals.surface_integrals(points, chosen, lambda x: np.einsum("ea,eb->eab", x - centre, x - centre)).sum(axis=0)
    inverse = np.linalg.inv(np.trace(moments) * np.eye(3) - moments)

    def tractions(x):
        found = np.zeros((len(x), 3, 6))
        for k in range(3):
            about = np.cross(position - centre, np.eye(3)[k])  # moment about the centroid of a force on the interface
            found[:, :, k] = np.eye(3)[k] / area + np.cross(inverse @ about, x - centre)
            found[:, :, 3 + k] = np.cross(inverse @ np.eye(3)[k], x - centre)
        return found

    return cell_integrals.surface_integrals(points, chosen, tractions)[nodes]
