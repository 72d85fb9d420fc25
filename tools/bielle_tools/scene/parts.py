"""Parts of a scene: rigid pieces on moving bones, and flexible bodies with modal shapes."""

from dataclasses import dataclass, field
from typing import Any, Callable

import numpy as np

GROUPS = ("body", "beam", "joint", "spring", "rope", "contact", "node", "ground", "force")


@dataclass
class Mesh:
    """points (n,3) in the axes of their bone [m]; triangles (m,3) and lines (k,2): numbers of points; bones (n): number of the
    bone of each point. Points that several triangles share are shaded smoothly; edges have a point for each side."""
    points: np.ndarray
    triangles: np.ndarray
    lines: np.ndarray
    bones: np.ndarray

    @property
    def bone_count(self):
        return int(self.bones.max()) + 1 if len(self.bones) else 1


@dataclass
class Part:
    """A piece of an entry. entry: `joints/main`; colour `#rrggbb`; group: one of GROUPS."""
    entry: str
    type: str
    mesh: Mesh
    colour: str
    opacity: float
    group: str
    motion: Callable = field(repr=False)  # rows -> (rows, bones, 8)
    stress: Callable = field(default=None, repr=False)  # rows -> (rows, cells): von Mises stress [Pa] by which it is coloured, or None
    cells: Any = None  # (n) cell of each point of the mesh if there is stress
    rest: Callable = field(default=None, repr=False)  # rows -> (rows, bones, 8) without deformation, or None: it is not magnified


@dataclass
class FlexibleBody:
    """The surface of a superelement, shared by its instances. points (p,3) as meshed [m]; triangles (m,3); shapes (n,p,3): displacements
    per coordinate; stress (n,p,6) xx yy zz yz xz xy [Pa] per coordinate, or None; stressed (p) tells which points have stress."""
    path: str
    piece: str
    points: np.ndarray
    triangles: np.ndarray
    shapes: np.ndarray
    stress: Any
    stressed: np.ndarray
    nodes: np.ndarray  # numbers of the points in the mesh of the file; -1 for points that are not of the mesh
    levels: list  # scene/levels.py: the triangles, then coarser ones on the first points
    reason: str = ""  # why lines that join the interfaces stand for the surface; empty for a surface


@dataclass
class FlexiblePart:
    """An instance of a flexible body: x + R(q) (points + sum of coordinates * shapes)."""
    entry: str
    type: str
    body: FlexibleBody
    colour: str
    opacity: float
    frame: Callable = field(repr=False)  # rows -> (rows, 7): x y z, w x y z
    coordinates: Callable = field(repr=False)  # rows -> (rows, n)
    group: str = "body"


@dataclass
class Anchor:
    """Place of the label of an entry: a point in the axes of a bone."""
    entry: str
    part: Any
    bone: int
    point: np.ndarray


def joined(*meshes):
    """One mesh of several on the same bones."""
    offsets = np.cumsum([0] + [len(mesh.points) for mesh in meshes])
    return Mesh(np.concatenate([mesh.points for mesh in meshes]),
                np.concatenate([mesh.triangles + offset for mesh, offset in zip(meshes, offsets)]),
                np.concatenate([mesh.lines + offset for mesh, offset in zip(meshes, offsets)]),
                np.concatenate([mesh.bones for mesh in meshes]))


def on_bones(mesh, count):
    """Copies of a mesh of one bone, for `count` bones."""
    n = len(mesh.points)
    shifts = n * np.arange(count)[:, None, None]
    return Mesh(np.tile(mesh.points, (count, 1)), (mesh.triangles[None] + shifts).reshape(-1, 3),
                (mesh.lines[None] + shifts).reshape(-1, 2), np.repeat(np.arange(count), n))


def with_bone(mesh, bone):
    """The same mesh on another bone."""
    return Mesh(mesh.points, mesh.triangles, mesh.lines, np.full(len(mesh.points), bone))
