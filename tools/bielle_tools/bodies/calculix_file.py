"""Writes input files of CalculiX with a body's mesh, its material, and one static step per instant."""

import numpy as np

from ..mesh.cells import CELLS, SOLIDS
from ..messages import InputError, counted

TYPES = {"tetra": "C3D4", "tetra10": "C3D10", "hexahedron": "C3D8", "hexahedron20": "C3D20", "wedge": "C3D6", "wedge15": "C3D15"}
ON_A_LINE = 16  # numbers; CalculiX goes on reading after a comma
NO_FORCE = 1e-14  # relative to the largest of a step
# Numbers have 13 digits: CalculiX reads fields of up to 20 characters.


def write_case(path, loaded, loads, source):
    """loaded: LoadedBody; loads: its BodyLoads, one step each. @raises InputError for cells that CalculiX does not have"""
    for kind, cells in loaded.body.cells.items():
        if kind in SOLIDS and kind not in TYPES and len(cells):
            raise InputError(f"the mesh has {counted(len(cells), CELLS[kind].singular, CELLS[kind].plural)} of {CELLS[kind].nodes} "
                             "nodes, which "
                             "CalculiX does not know")
    with open(path, "w", encoding="utf-8") as file:
        file.write(_head(loaded, loads, source))
        _write_mesh(file, loaded)
        references = _write_ties(file, loaded)
        _write_support(file, loaded, references)
        for number, load in enumerate(loads, 1):
            _write_step(file, loaded, references, load, number)


def _head(loaded, loads, source):
    return (f"** {loaded.element} of {source}: {counted(len(loads), 'instant')}, by bielle-loads.\n"
            "** SI units, axes of the body's mesh. Each step holds the forces on the interfaces and the body's inertia with gravity,\n"
            "** as nodal forces. They balance each other: supports keep the body in place and bear nothing.\n")


def _write_mesh(file, loaded):
    file.write("*NODE, NSET=NALL\n")
    for k, x in enumerate(loaded.points, 1):
        file.write(f"{k}, {x[0]:.12e}, {x[1]:.12e}, {x[2]:.12e}\n")
    materials, number = loaded.materials, 0
    for m, name in enumerate(materials.names):
        blocks = [(kind, cells[materials.number[kind] == m]) for kind, cells in loaded.body.cells.items() if kind in TYPES]
        blocks = [(kind, cells) for kind, cells in blocks if len(cells)]
        for kind, cells in blocks:
            file.write(f"*ELEMENT, TYPE={TYPES[kind]}, ELSET=E{m + 1}\n")
            for cell in cells:
                number += 1
                words = [str(n) for n in [number, *(cell + 1)]]
                lines = [", ".join(words[begin:begin + ON_A_LINE]) for begin in range(0, len(words), ON_A_LINE)]
                file.write(",\n".join(lines) + "\n")
        if blocks:
            file.write(f"** {name}\n*MATERIAL, NAME=M{m + 1}\n*ELASTIC\n{materials.young[m]:.12e}, {materials.poisson[m]:.12e}\n"
                       f"*DENSITY\n{materials.densities[m]:.12e}\n*SOLID SECTION, ELSET=E{m + 1}, MATERIAL=M{m + 1}\n")


def _write_ties(file, loaded):
    """Writes rigid ties as rigid bodies. @returns {interface: (reference node, rotational node)}"""
    references, number = {}, len(loaded.points)
    for k, surface in enumerate(loaded.surfaces, 1):
        if not surface.rigid:
            continue
        file.write(f"** interface {surface.name}: rigid\n*NODE\n")
        for _ in range(2):
            number += 1
            file.write(f"{number}, " + ", ".join(f"{x:.12e}" for x in surface.position) + "\n")
        file.write(f"*NSET, NSET=I{k}\n")
        for begin in range(0, len(surface.nodes), 12):
            file.write(", ".join(str(n + 1) for n in surface.nodes[begin:begin + 12]) + "\n")
        file.write(f"*RIGID BODY, NSET=I{k}, REF NODE={number - 1}, ROT NODE={number}\n")
        references[surface.name] = (number - 1, number)
    return references


def _write_support(file, loaded, references):
    """Writes statically determinate supports: a rigid interface, or three nodes far apart."""
    file.write("*BOUNDARY\n")
    if references:
        for node in next(iter(references.values())):
            file.write(f"{node}, 1, 3\n")
        return
    for node, direction in three_supports(loaded.points):
        file.write(f"{node + 1}, {direction + 1}\n")


def three_supports(points):
    """Returns six pairs (node, direction) that hold a body statically determinate, on a node, one far away, and one far
    from both."""
    a = int(np.argmin(points @ np.array([1, 0.9, 0.8])))
    b = int(np.argmax(np.linalg.norm(points - points[a], axis=1)))
    axis = (points[b] - points[a]) / np.linalg.norm(points[b] - points[a])
    r = points - points[a]
    c = int(np.argmax(np.linalg.norm(r - np.outer(r @ axis, axis), axis=1)))
    # b must not rotate about a, nor c about the line between them, so that the two best directions of b and the best
    # one of c are held.
    along = int(np.argmax(np.abs(axis)))
    normal = np.cross(axis, points[c] - points[a])
    second = [k for k in range(3) if k != along]
    return [(a, 0), (a, 1), (a, 2), (b, second[0]), (b, second[1]), (c, int(np.argmax(np.abs(normal))))]


def _write_step(file, loaded, references, load, number):
    file.write(f"** t = {load.time:.9g} s\n*STEP\n*STATIC\n*CLOAD" + (", OP=NEW" if number > 1 else "") + "\n")
    forces = load.inertia.copy()
    for surface, force in zip(loaded.surfaces, load.interface):
        if not surface.rigid:
            forces[surface.nodes] += surface.spread @ force
    least = NO_FORCE * np.abs(forces).max(initial=0)
    for node, direction in zip(*np.nonzero(np.abs(forces) > least)):
        file.write(f"{node + 1}, {direction + 1}, {forces[node, direction]:.12e}\n")
    for surface, force in zip(loaded.surfaces, load.interface):
        if surface.rigid:
            for node, values in zip(references[surface.name], (force[:3], force[3:])):
                for direction, value in enumerate(values, 1):
                    file.write(f"{node}, {direction}, {value:.12e}\n")
    file.write("*NODE FILE\nU\n*EL FILE\nS\n*END STEP\n")
