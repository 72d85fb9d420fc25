"""MBDyn's modal joint (.fem): shapes of a body in its floating frame, with their mass, stiffness and inertia invariants.

The writer stores all free modes at the nodes and recovery points, the global inertia (group 12) and, if the inertia
inside is known, the invariants 3, 4, 8, 5 and 9 (groups 14 to 18); MBDyn takes lumped masses of nodes (group 11) in
their place. The reader accepts all of these groups. (MBDyn Input Manual, "Modal joint"; the invariants are those of its
theory manual, as mbdyn/struct/modal.cc computes them.)
"""

import os

import numpy as np

from ..messages import InputError, note
from ..text_lines import lines_of
from .free_modes import free_modes, moments, rigid_moments
from .inertia_moments import EPSILON, Moments, components_of, inertia_about, moments_of_points, second_moment
from .job_files import stem
from .matrix_set import MassProperties
from .mbdyn_file import GROUP, ModalFile, write_groups
from .modal_body import body_of_modes, rigid_mass

INVARIANTS = (14, 15, 16, 18)


def recognises(path):
    """Whether a file has groups, or no text: decks of OptiStruct have the same ending."""
    texts = lines_of(path)
    return any(GROUP.match(text) for text in texts) or not any(text.strip() for text in texts)


def read(path, options):
    """@raises InputError"""
    file = ModalFile(path)
    numbers, notes = _numbers(file)
    positions = np.column_stack([file.array(group, file.nodes) for group in (5, 6, 7)])
    shapes = file.array(8, file.rejected + file.modes, file.nodes, 6)[file.rejected:].transpose(1, 2, 0)
    modal_mass, stiffness = (file.array(group, file.modes, file.modes) for group in (9, 10))
    damping = file.array(13, file.modes, file.modes) if file.has(13) else None
    inertia, coupling, components, lumped = _inertia(file, positions, shapes)
    if not file.has(11) and not file.has(14, 15):
        notes.append("the file tells no coupling of the shapes with rigid motions: it is taken to be zero, as of free "
                     "modes")
    if file.has(19):
        notes.append("the geometric stiffness (group 19) is left out")
    mass = np.block([[rigid_mass(inertia), coupling.T], [coupling, modal_mass]])
    body = body_of_modes(path, options, numbers, positions, shapes, stiffness, mass, damping, components)
    body.name, body.source, body.notes = options.name or stem(path), f"MBDyn modal joint, {os.path.basename(path)}", notes
    centre = inertia.centre
    body.mass_properties = MassProperties(inertia.mass, centre, inertia_about(inertia.inertia, -inertia.mass, centre))
    if lumped is not None and body.shapes is not None:
        _lump(body, numbers, *lumped)
    return body


def _numbers(file):
    """Numbers of the nodes; names are numbered."""
    words = [word for _, word in file.words(2, file.nodes)]
    if len(set(words)) < len(words):
        raise InputError(f"'{file.path}': RECORD GROUP 2 names a node twice")
    if all(word.isdecimal() and 0 < int(word) < 2**31 for word in words) and len({int(word) for word in words}) == len(words):
        return np.array([int(word) for word in words], np.int64), []
    return np.arange(1, len(words) + 1), ["nodes have names that are no numbers: they are counted from 1"]


def _inertia(file, positions, shapes):
    """Moments of the rigid body, coupling of the shapes with rigid motions (m,6), S_kl or None, masses and inertias of nodes or None."""
    modes = file.modes
    lumped = None
    if file.has(11):
        table = file.array(11, file.nodes, 6)
        lumped = table[:, 0], table[:, 3:]
        inertia = moments_of_points(positions, lumped[0], shapes[:, :3])
        turning = inertia.turning() + np.einsum("pk,pkj->jk", lumped[1], shapes[:, 3:])
        coupling = np.column_stack([inertia.linear, turning])
        inertia.second = second_moment(inertia.inertia + np.diag(lumped[1].sum(axis=0)))
    elif not file.has(12):
        raise InputError(f"'{file.path}': the inertia is missing (RECORD GROUP 11 or 12)")
    else:
        coupling = np.zeros((modes, 6))
    if file.has(12):
        values = file.array(12, 13)
        if not values[0] > 0:
            raise InputError(f"'{file.path}': RECORD GROUP 12: the mass is {values[0]:g}")
        about = inertia_about(values[4:].reshape(3, 3), values[0], values[1:4])
        rigid = Moments(values[0], values[0] * values[1:4], second_moment(about), None, None, None)
    else:
        rigid = inertia
        if not rigid.mass > 0:
            raise InputError(f"'{file.path}': RECORD GROUP 11: the masses sum up to {rigid.mass:g}")
    components = None
    if file.has(14, 15):
        coupling = np.column_stack([file.array(14, 3, modes).T, file.array(15, 3, modes).T])
    if file.has(*INVARIANTS):
        rigid.linear = coupling[:, :3]
        rigid.product = _halved(file.array(16, 3, modes, 3).transpose(1, 0, 2), -1)
        outer = _halved(file.array(18, 3, modes, modes, 3).transpose(1, 2, 0, 3), 1)  # sum phi_k phi_j^T
        rigid.square = outer.transpose(3, 2, 0, 1)
        components = components_of(rigid)
    return rigid, coupling, components, lumped


def _halved(matrices, sign):
    """The matrix P out of sign (P - trace(P) I)."""
    return sign * (matrices - np.trace(matrices, axis1=-2, axis2=-1)[..., None, None] / 2 * np.eye(3))


def _lump(body, numbers, masses, inertias):
    """Gives the points the masses that the file has, those of interfaces as further points."""
    size, shapes = body.size, body.shapes
    order = [np.flatnonzero(numbers == each)[0] for each in [*shapes.numbers, *body.numbers]]
    at_nodes = np.zeros((len(body.numbers), 6, size))
    for row, (node, component) in enumerate(zip(body.unknown_nodes, body.unknown_components)):
        if node >= 0:
            at_nodes[node, component, row] = 1
    shapes.numbers = np.concatenate([shapes.numbers, body.numbers])
    shapes.points = np.concatenate([shapes.points, body.positions])
    shapes.displacement = np.concatenate([shapes.displacement, at_nodes[:, :3].reshape(-1, size)])
    if shapes.rotation is not None:
        shapes.rotation = np.concatenate([shapes.rotation, at_nodes[:, 3:].reshape(-1, size)])
    shapes.masses = masses[order]
    shapes.inertias = np.array([np.diag(each) for each in inertias[order]]) if inertias.any() else None


def write(matrices, path, options):
    """@returns the path, in a list. @raises InputError"""
    free = free_modes(matrices)
    shapes = (free.motions @ free.modes).transpose(2, 0, 1)
    rigid, known = rigid_moments(free), moments(free)
    groups = {
        5: ("NODAL X COORDINATES", free.positions[:, 0]), 6: ("NODAL Y COORDINATES", free.positions[:, 1]),
        7: ("NODAL Z COORDINATES", free.positions[:, 2]), 8: ("NON-ORTHOGONALIZED MODE SHAPES", shapes),
        9: ("MODAL MASS MATRIX. COLUMN-MAJOR FORM", np.diag(np.diag(free.mass))),
        10: ("MODAL STIFFNESS MATRIX. COLUMN-MAJOR FORM", np.diag(np.diag(free.stiffness))),
        12: ("GLOBAL INERTIA", [[rigid.mass], rigid.centre, *inertia_about(rigid.inertia, -rigid.mass, rigid.centre)])}
    if free.damping is not None:
        groups[13] = ("MODAL DAMPING MATRIX. COLUMN-MAJOR FORM", free.damping)
    if known is None:
        note("the inertia inside the body is not known: the file has no invariants, and MBDyn takes the body's "
             "inertia to be constant")
    else:
        groups |= _invariants(known)
    write_groups(path, matrices.name, free.numbers, groups)
    return [path]


def _invariants(known):
    """Groups 14 to 18."""
    eye = np.eye(3)
    eighth = np.trace(known.product, axis1=1, axis2=2)[:, None, None] * eye - known.product
    outer = known.square.transpose(2, 3, 1, 0)  # (j,k): sum phi_k phi_j^T
    ninth = outer - np.trace(outer, axis1=2, axis2=3)[..., None, None] * eye
    fifth = np.einsum("abc,bcjk->ajk", EPSILON, known.square)
    return {14: ("INVARIANT 3", known.linear.T), 15: ("INVARIANT 4", known.turning().T), 16: ("INVARIANT 8", eighth.transpose(1, 0, 2)),
            17: ("INVARIANT 5", fifth), 18: ("INVARIANT 9", ninth.transpose(2, 0, 1, 3))}
