"""Keywords of Abaqus and CalculiX files that tie nodes to one node, put masses on nodes, or turn their axes."""

from dataclasses import dataclass, field, replace

import numpy as np

from .abaqus_lines import Keyword, number
from .abaqus_systems import axes_of, rotation
from .tie_model import TieRefusal

TIES = ("COUPLING", "KINEMATIC COUPLING", "DISTRIBUTING COUPLING", "RIGID BODY", "MPC")
MASSES = ("MASS", "ROTARY INERTIA")


@dataclass
class Scope:
    """An instance. prefix: before the names of its sets; raised: amount by which its numbers are raised; turn: its rotation;
    shown: before the names of its constraints."""

    prefix: str = ""
    raised: int = 0
    turn: np.ndarray = field(default_factory=lambda: np.eye(3))
    shown: str = ""


@dataclass
class Constraint:
    """A keyword. scope: the instance whose numbers and names its words are; None if they are those of the file or the assembly."""

    keyword: Keyword
    scope: Scope = None
    detail: object = None  # the *KINEMATIC or *DISTRIBUTING of a *COUPLING

    @property
    def name(self):
        return self.keyword.name

    @property
    def options(self):
        return self.keyword.options

    @property
    def where(self):
        return self.keyword.where

    def words(self):
        """Returns the words of each data line."""
        return [[word.strip() for word in row.rstrip(",").split(",")] for row in self.keyword.rows]

    def prefix(self):
        return self.scope.prefix.upper() if self.scope else ""

    def shown(self, name):
        """Returns the name of a constraint in messages and among the ties of the body."""
        return (self.scope.shown if self.scope else "") + name

    def turned(self, axes):
        """Converts axes (columns) from the system of the part to that of the assembly."""
        return self.scope.turn @ axes if self.scope else axes


class Constraints:
    """All constraints of a file, in its order."""

    def __init__(self):
        self.ties, self.masses, self.transforms, self.orientations = [], [], [], {}

    def keyword(self, keyword):
        constraint = Constraint(keyword)
        if keyword.name in TIES:
            self.ties.append(constraint)
        elif keyword.name in ("KINEMATIC", "DISTRIBUTING") and self.ties and self.ties[-1].name == "COUPLING":
            self.ties[-1].detail = constraint
        elif keyword.name in MASSES:
            self.masses.append(constraint)
        elif keyword.name == "TRANSFORM":
            self.transforms.append(constraint)
        elif keyword.name == "ORIENTATION":
            self.orientations[keyword.options.get("NAME", "").upper()] = constraint

    def join(self, other, scope_of):
        """Adds the constraints of a part. @param scope_of: their scope from that which they have there"""
        for own, more in ((self.ties, other.ties), (self.masses, other.masses), (self.transforms, other.transforms)):
            own += [replace(each, scope=scope_of(each.scope)) for each in more]
        for name, each in other.orientations.items():
            moved = replace(each, scope=scope_of(each.scope))
            self.orientations[moved.prefix() + name] = moved

    def oriented_axes(self, constraint, name):
        """Returns the axes (columns) of an *ORIENTATION that a constraint names. @raises TieRefusal unless it is
        rectangular and given by coordinates"""
        found = self.orientations.get(constraint.prefix() + name.upper()) or self.orientations.get(name.upper())
        if not found:
            raise TieRefusal(f"there is no *ORIENTATION, NAME={name}")
        system, definition = (found.options.get(key, default).upper() for key, default in (("SYSTEM", "RECTANGULAR"), ("DEFINITION", "COORDINATES")))
        if not "RECTANGULAR".startswith(system) or definition != "COORDINATES":
            raise TieRefusal(f"its *ORIENTATION, NAME={name} is {system}, DEFINITION={definition}; RECTANGULAR ones of COORDINATES are read")
        lines = found.words()
        values = _numbers(found, lines[0] if lines else [])
        if len(values) not in (6, 9):
            raise TieRefusal(f"its *ORIENTATION, NAME={name} has {len(values)} numbers on its first line; two or three points are expected")
        points = np.array(values + [0.0] * (9 - len(values))).reshape(3, 3)
        axes = _axes(found, points[0] - points[2], points[1] - points[2])
        return found.turned(axes @ _turn(*_numbers(found, lines[1])[:2]) if len(lines) > 1 and len(lines[1]) > 1 else axes)

    @staticmethod
    def transformed_axes(transform):
        """Returns the axes (columns) of a *TRANSFORM. @raises TieRefusal unless it is rectangular"""
        kind = transform.options.get("TYPE", "R").upper()
        if kind != "R":
            raise TieRefusal(f"its reference node has a *TRANSFORM of TYPE={kind}; TYPE=R is read")
        values = _numbers(transform, [word for words in transform.words() for word in words])
        if len(values) != 6:
            raise TieRefusal(f"the *TRANSFORM of its reference node has {len(values)} numbers; two points are expected")
        return transform.turned(_axes(transform, np.array(values[:3]), np.array(values[3:])))


def _numbers(keyword, words):
    try:
        return [number(word) if word else 0.0 for word in words]
    except ValueError:
        raise TieRefusal(f"*{keyword.name} at {keyword.where} has a word where a number belongs") from None


def _axes(keyword, x, in_plane):
    axes = axes_of(x, np.cross(x, in_plane), np.linalg.norm(in_plane))
    if axes is None:
        raise TieRefusal(f"the points of *{keyword.name} at {keyword.where} stand in one line")
    return axes


def _turn(axis, degrees):
    """Returns the rotation about axis 1, 2 or 3."""
    if axis not in (1, 2, 3):
        raise TieRefusal("the additional rotation of its *ORIENTATION is about axis 1, 2 or 3")
    return rotation(np.eye(3)[int(axis) - 1], np.radians(degrees))
