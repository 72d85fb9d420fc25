"""Surfaces of *TIE whose meshes coincide: their nodes become common ones.

Abaqus ties each node of the first surface, the secondary one, to the second. If the meshes coincide this is the same as
common nodes; otherwise Bielle has no counterpart. (Abaqus Keywords Guide, "*TIE".)
"""

from dataclasses import dataclass

import numpy as np

from ..mesh.cells import CELLS, SOLIDS, face_keys, solid_faces
from ..messages import InputError, counted, place, require

SAME_PLACE = 1e-3  # largest gap / shortest edge of both surfaces: coordinates have few digits in large bodies of small elements
NOT_READ = ("CYCLIC SYMMETRY",)


@dataclass
class Tie:
    name: str
    where: str
    pairs: list  # names of the secondary and the main surface


def read_tie(keyword):
    """@raises InputError with the line"""
    for option in NOT_READ:
        if option in keyword.options:
            raise InputError(f"{keyword.where}: *TIE, {option}: sectors are not read; write the whole body out")
    pairs = keyword.table(lambda words: [word.strip('"') for word in words if word][:2])
    for pair, (path, line) in zip(pairs, keyword.places):
        if len(pair) < 2:
            raise InputError(f"{path}:{line}: *TIE: expected the names of two surfaces, found {counted(len(pair), 'name')}")
    return Tie(keyword.options.get("NAME", "?"), keyword.where, pairs)


def join_ties(mesh, ties):
    """Gives tied surfaces common nodes, in place. @param mesh: RawMesh; its face sets and point sets have the names of the ties.
    @returns the new row of each point @raises InputError for surfaces whose meshes do not coincide"""
    pairs = [_coinciding(mesh, f"{tie.where}: *TIE, NAME={tie.name}", names) for tie in ties for names in tie.pairs]
    if pairs:
        rows = _renumber(mesh, _main_nodes(len(mesh.points), np.concatenate(pairs)))
        _drop_inner(mesh, {name for tie in ties for names in tie.pairs for name in names})
        return rows
    return np.arange(len(mesh.points))


class _Surface:
    """faces: sets of all nodes of each face, of none for a surface of nodes; nodes: rows of points; edge: its shortest one."""

    def __init__(self, mesh, name, told):
        self.faces, self.edge = [], np.inf
        if name not in mesh.face_sets:
            self.nodes = mesh.point_sets.get(name, np.zeros(0, np.int64))
        else:
            self._take_faces(mesh, {_key(corners) for corners in mesh.face_sets[name]})
            self.nodes = np.unique([node for face in self.faces for node in face]).astype(np.int64)
        if not len(self.nodes):
            raise InputError(f"{told}: the surface '{name}' has no faces of solid cells, and no nodes")

    def _take_faces(self, mesh, wanted):
        for flat, block in solid_faces(_solids(mesh)).items():
            inside = np.array([key in wanted for key in map(tuple, face_keys(flat, block).tolist())], bool)
            self.faces += [frozenset(face) for face in block[inside].tolist()]
            ends = mesh.points[block[inside][:, :CELLS[flat].corners]]
            if len(ends):
                self.edge = min(self.edge, np.linalg.norm(ends - np.roll(ends, 1, axis=1), axis=2).min())


def _solids(mesh):
    found = {}
    for kind, cells in mesh.cells:
        if kind in SOLIDS:
            found.setdefault(kind, []).append(cells)
    return {kind: np.concatenate(blocks) for kind, blocks in found.items()}


def _coinciding(mesh, told, names):
    """(n,2) nodes of the secondary surface and of the main one."""
    require("scipy")
    from scipy.spatial import cKDTree
    one, other = (_Surface(mesh, name, told) for name in names)
    edge = min(one.edge, other.edge)
    gaps, nearest = cKDTree(mesh.points[other.nodes]).query(mesh.points[one.nodes])
    apart = gaps > (SAME_PLACE * edge if np.isfinite(edge) else 0.0)
    if apart.any():
        worst = int(np.argmax(gaps))
        raise InputError(f"{told}: {int(apart.sum())} of {len(one.nodes)} nodes of '{names[0]}' do not coincide with nodes of "
                         f"'{names[1]}' (the largest gap is {gaps[worst]:.4g}, at {place(mesh.points[one.nodes[worst]])}): mesh both "
                         "surfaces alike, or the parts in one")
    mains = other.nodes[nearest]
    if len(np.unique(mains)) < len(mains):
        raise InputError(f"{told}: several nodes of '{names[0]}' coincide with one of '{names[1]}'")
    _check_faces(mesh, told, names, one, other, dict(zip(one.nodes.tolist(), mains.tolist())))
    mesh.notes.append(f"*TIE, NAME={told.rpartition('=')[2]}: {counted(len(mains), 'node')} of '{names[0]}' and '{names[1]}' "
                      f"{'has become a common one' if len(mains) == 1 else 'have become common ones'} (the largest gap was {gaps.max():.3g})")
    return np.column_stack([one.nodes, mains])


def _check_faces(mesh, told, names, one, other, main_of):
    """Refuses surfaces of coinciding nodes whose faces differ, such as a coarse one on a fine one."""
    known = set(other.faces)
    apart = [face for face in one.faces if frozenset(main_of[node] for node in face) not in known]
    if other.faces and apart:
        raise InputError(f"{told}: {len(apart)} of {len(one.faces)} faces of '{names[0]}' are no faces of '{names[1]}', though their nodes "
                         f"coincide (the first near {place(mesh.points[sorted(apart[0])].mean(axis=0))}): mesh both surfaces alike")


def _main_nodes(count, pairs):
    """(count) the node that replaces each one: among all nodes that are tied to each other, the first that belongs to
    main surfaces only."""
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components
    _, group = connected_components(coo_matrix((np.ones(len(pairs)), pairs.T), shape=(count, count)), directed=False)
    secondary = np.zeros(count, bool)
    secondary[pairs[:, 0]] = True
    order = np.lexsort((np.arange(count), secondary, group))
    first = order[np.searchsorted(group[order], np.arange(group.max() + 1))]
    return first[group]


def _renumber(mesh, main_of):
    """Replaces the joined nodes everywhere and leaves them out of the points. @returns the new row of each point"""
    kept = np.flatnonzero(main_of == np.arange(len(main_of)))
    number = np.zeros(len(main_of), np.int64)
    number[kept] = np.arange(len(kept))
    number = number[main_of]
    mesh.points = mesh.points[kept]
    mesh.cells = [(kind, number[cells]) for kind, cells in mesh.cells]
    mesh.point_sets = {name: np.unique(number[nodes]) for name, nodes in mesh.point_sets.items()}
    mesh.face_sets = {name: [number[corners] for corners in faces] for name, faces in mesh.face_sets.items()}
    return number


def _drop_inner(mesh, names):
    """Removes from tied surfaces the faces that lie inside the body now."""
    count = {}
    for flat, block in solid_faces(_solids(mesh)).items():
        for key in map(tuple, face_keys(flat, block).tolist()):
            count[key] = count.get(key, 0) + 1
    for name in sorted(names & mesh.face_sets.keys()):
        faces = [face for face in mesh.face_sets[name] if count.get(_key(face), 0) < 2]
        if len(faces) < len(mesh.face_sets[name]):
            inner = len(mesh.face_sets[name]) - len(faces)
            mesh.notes.append(f"surface '{name}': {counted(inner, 'tied face')} {'is' if inner == 1 else 'are'} inside of the body and left out")
            mesh.face_sets[name] = faces
        if not faces:
            del mesh.face_sets[name]


def _key(corners):
    corners = sorted(set(corners.tolist()))
    return (-1, *corners) if len(corners) == 3 else tuple(corners)
