"""Writes MSH 4.1 (binary), gmsh's own format, with every group kept.

meshio's writer gives each block of cells one physical tag, so that overlapping groups are lost. Here the cells of each
combination of groups become one discrete entity that carries all their tags.
Reference: Gmsh reference manual, "MSH file format version 4.1"; node order is gmsh's.
"""

import os

import numpy as np

from ..messages import InputError
from .cells import CELLS, SOLIDS
from .solid_mesh import repeated_numbers

LONGEST_NAME = 250  # bytes; gmsh cuts longer ones off


def write_msh(mesh, path):
    """Writes a SolidMesh next to `path` and renames it. @raises InputError if the file cannot be written"""
    beside = f"{path}.part"
    try:
        with open(beside, "wb") as file:
            _write(mesh, file)
        os.replace(beside, path)
    except OSError as error:
        raise InputError(f"cannot write '{path}': {error.strerror}") from None


def _write(mesh, file):
    tags = {}  # (dimension, name) -> physical tag
    for dimension, groups in ((2, mesh.surfaces), (3, mesh.volumes)):
        for name in groups:
            if len(name.encode()) > LONGEST_NAME or '"' in name:
                raise InputError(f"the name of the group '{name[:40]}{'...' if len(name) > 40 else ''}' has {len(name.encode())} bytes: at most {LONGEST_NAME}, "
                                 "and no quotation marks, are possible")
            tags[dimension, name] = len(tags) + 1
    entities = _entities(mesh, tags)  # (dimension, entity tag, physical tags, [(type, cells, labels)])

    file.write(b"$MeshFormat\n4.1 1 8\n" + np.int32(1).tobytes() + b"\n$EndMeshFormat\n")
    if tags:
        file.write(f"$PhysicalNames\n{len(tags)}\n".encode())
        for (dimension, name), tag in tags.items():
            file.write(f'{dimension} {tag} "{name}"\n'.encode())
        file.write(b"$EndPhysicalNames\n")

    file.write(b"$Entities\n")
    counts = [sum(1 for e in entities if e[0] == dimension) for dimension in range(4)]
    file.write(np.array(counts, np.uint64).tobytes())
    for dimension, tag, physical, blocks in entities:
        nodes = np.unique(np.concatenate([cells.ravel() for _, cells, _ in blocks]))
        box = np.concatenate([mesh.points[nodes].min(axis=0), mesh.points[nodes].max(axis=0)])
        file.write(np.int32(tag).tobytes() + box.astype(np.float64).tobytes())
        file.write(np.uint64(len(physical)).tobytes() + np.array(physical, np.int32).tobytes())
        file.write(np.uint64(0).tobytes())  # bounding entities: unknown
    file.write(b"\n$EndEntities\n")

    # All nodes are stored with the first volume: the entity that owns a node does not matter to readers of cells.
    owner = next(e for e in entities if e[0] == 3)
    count = len(mesh.points)
    file.write(b"$Nodes\n" + np.array([1, count, 1, count], np.uint64).tobytes())
    file.write(np.array([3, owner[1], 0], np.int32).tobytes() + np.uint64(count).tobytes())
    file.write(np.arange(1, count + 1, dtype=np.uint64).tobytes())
    file.write(np.ascontiguousarray(mesh.points, np.float64).tobytes() + b"\n$EndNodes\n")

    blocks = [(e[0], e[1], *block) for e in entities for block in e[3]]
    all_numbers = _numbers([labels for *_, labels in blocks])
    together = np.concatenate(all_numbers)
    file.write(b"$Elements\n" + np.array([len(blocks), len(together), together.min(), together.max()], np.uint64).tobytes())
    for (dimension, tag, kind, cells, _), numbers in zip(blocks, all_numbers):
        file.write(np.array([dimension, tag, CELLS[kind].gmsh], np.int32).tobytes() + np.uint64(len(cells)).tobytes())
        file.write(np.column_stack([numbers, cells + 1]).astype(np.uint64).tobytes())
    file.write(b"\n$EndElements\n")


def _numbers(all_labels):
    """Numbers of the cells of each block: the labels of the file if they are positive and differ, so that messages name the
    cells by them; others follow them."""
    keep = repeated_numbers(all_labels) == 0
    last, result = max((int(labels.max(initial=0)) for labels in all_labels), default=0) if keep else 0, []
    for labels in all_labels:
        numbers, new = labels.copy(), (labels <= 0) if keep else np.ones(len(labels), bool)
        numbers[new] = last + 1 + np.arange(new.sum())
        last += int(new.sum())
        result.append(numbers)
    return result


def _entities(mesh, tags):
    """One entity per combination of groups, per dimension."""
    found = {}  # (dimension, physical tags) -> [(type, cells, labels)]
    for kind, cells in mesh.cells.items():
        labels = mesh.labels.get(kind, np.full(len(cells), -1))
        dimension, groups = (3, mesh.volumes) if kind in SOLIDS else (2, mesh.surfaces)
        which, combinations = np.zeros(len(cells), np.int64), [()]
        for name in (name for name in groups if kind in groups[name]):
            inside = np.zeros(len(cells), np.int64)
            inside[groups[name][kind]] = 1
            pairs, which = np.unique(2 * which + inside, return_inverse=True)
            combinations = [combinations[pair // 2] + ((tags[dimension, name],) if pair % 2 else ()) for pair in pairs]
        for row, physical in enumerate(combinations):
            found.setdefault((dimension, physical), []).append((kind, cells[which == row], labels[which == row]))
    ordered = sorted(found.items())
    count = {2: 0, 3: 0}
    entities = []
    for (dimension, physical), blocks in ordered:
        count[dimension] += 1
        entities.append((dimension, count[dimension], physical, blocks))
    return entities
