"""A mesh of solid cells with named groups, checked and put into gmsh's node order.

Readers deliver a RawMesh: any cells, in VTK's node order (cells.py), and named sets of cells, of cell faces and of nodes.
`solid_mesh` converts it to the mesh that the reduction reads: solid cells and surface cells of positive orientation with
gmsh's node order, every set as a surface or a volume group.
"""

from collections import Counter
from dataclasses import dataclass, field

import numpy as np

from ..messages import InputError, counted, place
from .cells import CELLS, FLATS, SOLIDS, has_turned_corner, permutation, six_volumes
from .face_table import FaceTable
from .repeated_nodes import refusal, turn_repeated

FARTHEST = 1e15  # in whatever unit: no body reaches there
# Cells that have neither volume nor surface: axes, springs, point masses, corner points.
IGNORED = ("vertex", "line", "line3", "line4")
AT_ONCE = 20000  # cells


@dataclass
class RawMesh:
    """The result of a reader. Sets may overlap; names are those of the file.

    points (p,3); cells: list of (meshio type, (n,k) node numbers from 0);
    cell_sets: name -> one index array per entry of `cells`; point_sets: name -> node numbers;
    face_sets: name -> list of the corner nodes of faces; notes: sentences about omitted parts;
    labels: the file's numbers of the cells, one array per entry of `cells`, or nothing.
    """

    points: np.ndarray
    cells: list
    cell_sets: dict = field(default_factory=dict)
    point_sets: dict = field(default_factory=dict)
    face_sets: dict = field(default_factory=dict)
    notes: list = field(default_factory=list)
    labels: list = field(default_factory=list)


@dataclass
class SolidMesh:
    """Points (p,3), cells by meshio type in gmsh's node order, and groups {name: {type: cell numbers}} by dimension.

    numbers: the row of each point of the RawMesh, -1 if it is left out; surface_of: the surface group of each of its sets of
    faces; labels: the file's number of each solid cell by type, -1 if it has none.
    """

    points: np.ndarray
    cells: dict
    surfaces: dict
    volumes: dict
    notes: list
    numbers: np.ndarray
    surface_of: dict
    labels: dict


def solid_mesh(raw):
    """Checks a RawMesh and completes it. @raises InputError if it is not a mesh of solid cells."""
    notes = list(raw.notes)
    cells, labels, place_of = _merge_blocks(raw, notes)
    _check_numbers(raw.points, cells)
    for kind in cells:
        if kind in SOLIDS and CELLS[kind].order == 2:
            cells[kind] = _order_mid_nodes(raw.points, kind, cells[kind], labels[kind], notes)
        if kind in SOLIDS:
            cells[kind] = _orient(raw.points, kind, cells[kind], labels[kind], notes)

    faces = FaceTable(raw.points, cells, notes)
    volumes, surfaces, surface_of = {}, {}, {}
    for name, parts in raw.cell_sets.items():
        members = _members(parts, place_of, cells)
        solid = {kind: index for kind, index in members.items() if kind in SOLIDS}
        flat = faces.renamed({kind: index for kind, index in members.items() if kind in FLATS})
        if solid:
            volumes[name] = solid
        if flat:
            _add_surface(surfaces, volumes, name, flat, notes)
        if not members:
            notes.append(f"the set '{name}' holds no solid or surface cells and is left out")
    for name, corners in raw.face_sets.items():
        members = faces.of_corners(corners, name)
        if members:
            surface_of[name] = _add_surface(surfaces, volumes, name, members, notes)
        else:
            notes.append(f"surface '{name}' holds only faces of repeated nodes, which have no area, and is left out")
    for name, nodes in raw.point_sets.items():
        members = faces.of_nodes(nodes)
        if members:
            _add_surface(surfaces, volumes, name, members, notes)
        else:
            notes.append(f"node set '{name}' ({counted(len(nodes), 'node')}) covers no boundary face and is left out")
    cells = faces.all_cells()
    _tell_mixture(cells, notes)
    points, cells, numbers = _drop_unused(raw.points, cells, notes)
    _tell_repeated_numbers([labels[kind] for kind in cells if kind in SOLIDS], notes)
    cells = {kind: block[:, permutation(kind, "vtk", "gmsh")] for kind, block in cells.items()}
    return SolidMesh(points, cells, surfaces, volumes, notes, numbers, surface_of, {kind: labels[kind] for kind in cells if kind in SOLIDS})


def _merge_blocks(raw, notes):
    """Joins blocks of one type. Returns cells and labels by type, and for each block its types and its row in them."""
    _check_blocks(raw)
    given = raw.labels or [None] * len(raw.cells)

    def refuse(block, row):
        kind, nodes = raw.cells[block]
        return refusal(kind, _name(kind, row, given[block]), nodes[row])

    parts, changes = turn_repeated([(kind, np.asarray(block, dtype=np.int64)) for kind, block in raw.cells], refuse)
    blocks, labels, place_of = {}, {}, []
    for (_, cells), pieces, names in zip(raw.cells, parts, given):
        kinds, rows = np.zeros(len(cells), object), np.zeros(len(cells), np.int64)
        for kind, which, nodes in (piece for piece in pieces if len(piece[1])):
            before = blocks.setdefault(kind, [])
            kinds[which] = None if kind in IGNORED else kind
            rows[which] = sum(len(b) for b in before) + np.arange(len(which))
            before.append(nodes)
            labels.setdefault(kind, []).append(np.full(len(which), -1) if names is None else np.asarray(names)[which])
        place_of.append((kinds, rows))
    ignored = _counts(raw, lambda kind: kind in IGNORED)
    if ignored:
        notes.append(f"left out: cells of points or lines: {ignored}")
    for (old, new), count in changes.items():
        old, new = CELLS[old], CELLS[new]
        notes.append(f"{counted(count, old.singular, old.plural)} of {old.nodes} nodes with repeated nodes {'is a' if count == 1 else 'are'} "
                     f"{new.singular if count == 1 else new.plural} of {new.nodes} nodes")
    kept = [kind for kind in blocks if kind not in IGNORED]
    return ({kind: np.concatenate(blocks[kind]) for kind in kept}, {kind: np.concatenate(labels[kind]) for kind in kept}, place_of)


def _counts(raw, is_wanted):
    """"3 line, 2 vertex": numbers of the cells of some types."""
    counts = Counter()
    for kind, block in raw.cells:
        if len(block) and is_wanted(kind):
            counts[kind] += len(block)
    return ", ".join(f"{count} {kind}" for kind, count in sorted(counts.items()))


def _check_blocks(raw):
    unknown = _counts(raw, lambda kind: kind not in IGNORED and kind not in CELLS)
    if unknown:
        raise InputError(f"holds cells of types that Bielle does not read: {unknown}; it reads tetrahedra, hexahedra, wedges and pyramids of order 1 "
                         "and 2: remesh the body with these")
    if not any(kind in SOLIDS and len(block) for kind, block in raw.cells):
        what = _counts(raw, lambda kind: True) or "no cells at all"
        raise InputError(f"holds no tetrahedra, hexahedra, wedges or pyramids ({what}); Bielle reduces solids")


def repeated_numbers(labels):
    """Number of elements that share their number with another one. @param labels  numbers of the elements of each
    block; not positive: the element has none"""
    given = np.concatenate([np.zeros(0, np.int64), *labels])
    given = given[given > 0]
    return len(given) - len(np.unique(given))


def _tell_repeated_numbers(labels, notes):
    """Later messages name elements by these numbers, unless instances of parts repeat them."""
    repeated = repeated_numbers(labels)
    if repeated:
        notes.append(f"{counted(repeated, 'element')} {'has' if repeated == 1 else 'have'} the number of another one (of another instance): messages "
                     "name elements by running numbers and their places")


def _name(kind, row, labels):
    """The name of a cell in messages."""
    return f"element {labels[row]}" if labels is not None and labels[row] >= 0 else f"cell {row + 1} of type '{kind}'"


def _check_numbers(points, cells):
    sound = (np.abs(points) < FARTHEST).all(axis=1)
    if not sound.all():
        first = int(np.argmin(sound))
        raise InputError(f"point {first + 1} has a coordinate that is not finite, or larger than {FARTHEST:g}: "
                         f"({', '.join(f'{x:g}' for x in points[first])})")
    for kind, block in cells.items():
        if len(block) and (block.min() < 0 or block.max() >= len(points)):
            raise InputError(f"a cell of type '{kind}' names a node that does not exist")


def _misplaced(points, cell, cells):
    """(n) whether a node after the corners lies nearer to another edge, or face, than to its own."""
    wrong = np.zeros(len(cells), bool)
    for begin in range(0, len(cells), AT_ONCE):
        block = cells[begin:begin + AT_ONCE]
        middles = np.stack([points[block[:, list(each)]].mean(axis=1) for each in cell.middles], axis=1)
        for own in range(len(cell.middles)):
            distance = np.linalg.norm(points[block[:, cell.corners + own]][:, None, :] - middles, axis=2)
            wrong[begin:begin + AT_ONCE] |= distance.argmin(axis=1) != own
    return wrong


def _beyond_arcs(points, cell, cells):
    """(n) whether a node after the corners lies farther from the middle of its edge, or face, than on any arc of 150 degrees
    over its corners."""
    found = np.zeros(len(cells), bool)
    for own, each in enumerate(cell.middles):
        corners = points[cells[:, list(each)]]
        middle = corners.mean(axis=1)
        radius = np.linalg.norm(corners - middle[:, None, :], axis=2).max(axis=1)
        found |= np.linalg.norm(points[cells[:, cell.corners + own]] - middle, axis=1) > 0.8 * radius
    return found


def _order_mid_nodes(points, kind, cells, labels, notes):
    """VTK's order of the mid-side nodes, verified: each must lie nearer to the middle of its own edge than to others', unless its
    edge is curved by more than the cell is thick."""
    cell = CELLS[kind]
    wrong = _misplaced(points, cell, cells)
    if wrong.mean() > 0.5:
        for program, name in (("gmsh", "gmsh"), ("vtk", "VTK"), ("nastran", "Nastran"), ("abaqus", "Abaqus")):
            for read_as in ("vtk", "nastran", "abaqus"):  # the order in which the reader took them
                columns = np.array(permutation(kind, "vtk", read_as))[permutation(kind, program, "vtk")]
                if not _misplaced(points, cell, cells[:, columns]).any():
                    which = "last two mid-side nodes of the tetrahedra" if kind == "tetra10" else f"mid-side nodes of the {cell.plural}"
                    notes.append(f"the {which} stand in {name}'s order, not the format's; read so")
                    return cells[:, columns]
    lost = wrong & _beyond_arcs(points, cell, cells)
    if lost.mean() > 0.01:
        first = int(np.argmax(lost))
        told = f"element {labels[first]}" if labels[first] >= 0 else f"cell {first + 1} of its type"
        raise InputError(f"mid-side nodes of {int(lost.sum())} of {len(cells)} {cell.plural} do not lie on their edges "
                         f"(the first is {told}, near {place(points[cells[first, 0]])}): "
                         "the node order is not that of the format")
    if wrong.any():
        notes.append(f"mid-side nodes of {int(wrong.sum())} {cell.plural} lie nearer to another edge than to their own")
    return cells


def _orient(points, kind, cells, labels, notes):
    cell, volumes = CELLS[kind], six_volumes(points, kind, cells)
    corners = points[cells[:, :cell.corners]]
    flat = np.abs(volumes) <= 1e-15 * np.ptp(corners, axis=1).max(axis=1) ** 3

    def told(row):
        return f"element {labels[row]}, " if labels[row] >= 0 else ""

    if flat.any():
        first = int(np.argmax(flat))
        raise InputError(f"holds {counted(int(flat.sum()), cell.singular, cell.plural)} of no volume "
                         f"(the first: {told(first)}near {place(points[cells[first, 0]])})")
    negative = volumes < 0
    if negative.any():
        cells = cells.copy()
        cells[negative] = cells[negative][:, cell.mirrored]
        notes.append(f"{int(negative.sum())} of {len(cells)} {cell.plural} were left-handed and have been turned over")
    turned = has_turned_corner(points, kind, cells) if cell.shape != "tetra" else np.zeros(0, bool)
    if turned.any():
        first = int(np.argmax(turned))
        notes.append(f"{int(turned.sum())} of {len(cells)} {cell.plural} {'is' if turned.sum() == 1 else 'are'} turned inside out at a "
                     "corner "
                     f"(the first: {told(first)}near {place(points[cells[first, 0]])})")
    return cells


def _members(parts, place_of, cells):
    """Cell numbers by type of a set given as one index array per block of the file."""
    found = {}
    for (kinds, rows), index in zip(place_of, parts):
        index = np.asarray(index, dtype=np.int64)
        if not len(index):
            continue
        if index.min() < 0 or index.max() >= len(rows):
            raise InputError(f"a set names a cell of type '{next((kind for kind in kinds if kind), 'line')}' that does not exist")
        for kind in {kind for kind in kinds[index] if kind}:
            found.setdefault(kind, []).append(rows[index[kinds[index] == kind]])
    return {kind: np.unique(np.concatenate(index)) for kind, index in found.items()}


def _tell_mixture(cells, notes):
    solids = {kind: block for kind, block in cells.items() if kind in SOLIDS and len(block)}
    if len(solids) > 1:
        counts = [f"{counted(len(block), CELLS[kind].singular, CELLS[kind].plural)} of {CELLS[kind].nodes} nodes" for kind, block in solids.items()]
        notes.append("the body is a mixture of " + ", ".join(counts))


def _add_surface(surfaces, volumes, name, members, notes):
    """Adds a surface group; if its name is taken by another group, with `_surface` or a number appended. @returns its name"""
    if name in surfaces and _same(surfaces[name], members):
        return name
    free, count = name, 1
    while free in surfaces or free in volumes:
        free = f"{name}_surface" if count == 1 else f"{name}_surface{count}"
        count += 1
    if free != name:
        notes.append(f"the name '{name}' belongs to another group too; the surface is called '{free}'")
    surfaces[free] = members
    return free


def _same(one, other):
    return one.keys() == other.keys() and all(np.array_equal(one[kind], other[kind]) for kind in one)


def _drop_unused(points, cells, notes):
    used = np.unique(np.concatenate([block.ravel() for block in cells.values()]))
    if len(used) < len(points):
        shapes = [kind for kind, cell in CELLS.items() if kind == cell.shape]
        present = {CELLS[kind].shape for kind in cells} | {CELLS[flat].shape for kind in cells for flat, _ in CELLS[kind].faces}
        names = [CELLS[shape].singular for shape in sorted(present, key=lambda each: (-CELLS[each].dimension, shapes.index(each)))]
        notes.append(f"left out: {counted(len(points) - len(used), 'point')} of no {', '.join(names[:-1])} or {names[-1]}")
    number = np.full(len(points), -1, dtype=np.int64)
    number[used] = np.arange(len(used))
    return points[used], {kind: number[block] for kind, block in cells.items()}, number
