"""The contents of an Abaqus or CalculiX file, of a part or of an instance: nodes, elements, sets and surfaces by their names.

Sets and surfaces name numbers and other sets, which are resolved when the whole file has been read.
"""

import re

import numpy as np

from ..mesh.cells import CELLS, FLATS, SIDES
from ..mesh.solid_mesh import RawMesh
from ..messages import InputError, counted, did_you_mean
from .abaqus_constraints import Constraints
from .abaqus_extras import Extras
from .abaqus_tied_surfaces import join_ties
from .left_out import LeftOut

LABELS = 2**31       # numbers of nodes and elements are less
STRIDE = LABELS      # numbers of the k-th instance are raised by k times this; those of an assembly's own nodes are lowered by it
SAME_PLACE = 1e-12   # largest distance between two definitions of a node, relative to its largest coordinate: they
                     # differ by rounding
CELL_SIDES = ("SPOS", "SNEG", "")  # both sides of a shell or membrane element


class Contents:
    """Labels may be raised or lowered by STRIDE (abaqus_assembly)."""

    def __init__(self):
        self.numbers = {}  # node label -> row of points
        self.points = []
        self.blocks = []   # (type, labels, connectivity)
        self.cell_place = {}  # element label -> (block, row)
        self.sets = {"NSET": {}, "ELSET": {}}  # upper-case name -> (name, entries)
        self.unsorted = set()  # upper-case names of node sets in the order of the file
        self.surfaces = {}  # upper-case name -> (name, kind, entries, where)
        self.ties = []  # Tie
        self.skipped = LeftOut()  # elements that have neither volume nor surface
        self.unknown = LeftOut()  # elements of types that are not read
        self.formulations = {}  # element type with a letter for its formulation -> count
        self.system = None  # origin and axes (columns) that *NODE is given in
        self.assembly = None  # the assembly, which resolves the names in sets and surfaces if there are several
                              # instances
        self.notes = []
        self.extras = Extras()
        self.constraints = Constraints()
        self.reference_points = {}  # label -> place, of an assembly's own nodes
        self.single_nodes = {}      # label of an element with one node -> (type, label of the node)

    def add_nodes(self, places, labels, points):
        """@param places: file and line of each, or of all. @raises InputError if a number is taken by a node in another
        place, or is none"""
        points = np.asarray(points, float).reshape(-1, 3).tolist()
        for k, (label, x) in enumerate(zip(labels, points)):
            if self.numbers.setdefault(label, len(self.points)) == len(self.points):
                self.points.append(x)
                if 0 < label < LABELS:
                    continue
                told = f"a node has the number {label}, but numbers are from 1 to {LABELS - 1}"
            elif np.abs(np.subtract(self.points[self.numbers[label]], x)).max() <= SAME_PLACE * np.abs(x).max():
                continue
            else:
                told = f"there is a second node {label}, in another place"
            raise InputError("{}:{}: {}".format(*(places if isinstance(places, tuple) else places[k]), told))

    def place(self, where, label):
        """Coordinates of a node. @raises InputError if there is none; where: file and line for it"""
        if label not in self.numbers:
            raise InputError("{}:{}: there is no node {} before this line".format(*where, label))
        return np.array(self.points[self.numbers[label]])

    def add_elements(self, where, kind, labels, nodes):
        """@param nodes: (n,k) in VTK's order. @raises InputError, with file and line, if a number is taken or is none"""
        for told, found in (("an element has", labels), ("an element names a node of", nodes)):
            if len(labels) and not 0 < found.min() <= found.max() < LABELS:
                raise InputError("{}:{}: {} the number {}, but numbers are from 1 to {}".format(
                    *where, told, found.min() if found.min() < 1 else found.max(), LABELS - 1))
        for row, label in enumerate(labels.tolist()):
            if self.cell_place.setdefault(label, (len(self.blocks), row)) != (len(self.blocks), row):
                raise InputError("{}:{}: there is a second element {}".format(*where, label))
        self.blocks.append((kind, labels, nodes))

    def element(self, where, label):
        """Type and nodes, in VTK's order. @raises InputError if there is none; where: file and line for it"""
        if label not in self.cell_place:
            raise InputError("{}:{}: there is no element {} of a type that is read before this line".format(*where, label))
        block, row = self.cell_place[label]
        return self.blocks[block][0], self.blocks[block][2][row]

    def extend(self, kind, name, entries):
        self.sets[kind].setdefault(name.upper(), (name, []))[1].extend(entries)

    def members(self, kind, name, where):
        """Numbers of a set as it is before a keyword, each once. @raises InputError if there is no set"""
        key = self.key(kind, name)
        if key is None:
            raise InputError("{}:{}: there is no *{} '{}' before this line".format(*where, kind, name))
        found = list(dict.fromkeys(self.labels_of(kind, key)))
        return found if key in self.unsorted else sorted(found)

    def key(self, kind, name):
        """The key of a set among those of its kind, or of a surface; None if there is none."""
        others, known = self.assembly.other_names(name) if self.assembly else [], self.sets.get(kind, self.surfaces)
        return next((key for key in (name.upper(), *others) if key in known), None)

    def copy(self):
        """A reader with the same contents, to which more can be added."""
        other = type(self)()
        other.numbers, other.points, other.blocks, other.cell_place = dict(self.numbers), list(self.points), list(self.blocks), dict(self.cell_place)
        other.sets = {kind: {key: (name, list(entries)) for key, (name, entries) in sets.items()} for kind, sets in self.sets.items()}
        other.unsorted, other.surfaces = set(self.unsorted), dict(self.surfaces)
        other.ties = list(self.ties)
        other.skipped, other.unknown = self.skipped.copy(), self.unknown.copy()
        other.formulations, other.notes = dict(self.formulations), list(self.notes)
        other.extras.join(self.extras, str, False)
        other.constraints.join(self.constraints, lambda scope: scope)
        other.single_nodes = dict(self.single_nodes)
        return other

    # ---- result -------------------------------------------------------------------------------------------------
    def raw_mesh(self, path):
        if not self.points:
            raise InputError(f"'{path}' holds no *NODE: it is no Abaqus or CalculiX mesh")
        self.cells = [(kind, self._rows_of(labels, nodes)) for kind, labels, nodes in self.blocks]
        mesh = RawMesh(np.array(self.points), self.cells, notes=self.notes, labels=[labels % STRIDE for _, labels, _ in self.blocks])
        mesh.notes += self.extras.notes()
        if self.formulations:
            counts = ", ".join(f"{count} {label}" for label, count in self.formulations.items())
            mesh.notes.append(f"reduced, hybrid, incompatible and modified formulations are replaced by Bielle's own: {counts}")
        if self.skipped:
            mesh.notes.append(f"left out: elements that have neither volume nor surface: {self.skipped.text()}")
        for key, (name, _) in self.sets["ELSET"].items():
            if not name.startswith("_"):  # Abaqus' own helpers of surfaces
                mesh.cell_sets[name] = self.cells_of(key)
        for key, (name, _) in self.sets["NSET"].items():
            if not name.startswith("_"):
                nodes = self.nodes_of(key, mesh.notes)
                if len(nodes):
                    mesh.point_sets[name] = nodes
                else:
                    mesh.notes.append(f"node set '{name}' has no nodes and is left out")
        for surface in self.surfaces.values():
            self._resolve_surface(mesh, *surface)
        for tie in self.ties:
            tie.pairs = [[self._tied(tie, name) for name in names] for names in tie.pairs]
        rows = join_ties(mesh, self.ties)
        self.numbers = {label: int(rows[row]) for label, row in self.numbers.items()}
        self.points, self.cells = mesh.points, mesh.cells
        return mesh

    def _tied(self, tie, name):
        """The name in the mesh of a surface that a tie names."""
        key = self.key("SURFACE", name)
        if key is None:
            known = [each for each, _, _, _ in self.surfaces.values()]
            raise InputError(f"{tie.where}: *TIE, NAME={tie.name}: there is no surface '{name}'{did_you_mean(name, known)}")
        return self.surfaces[key][0]

    def _rows_of(self, labels, nodes):
        try:
            return np.array([[self.numbers[n] for n in row] for row in nodes.tolist()], dtype=np.int64).reshape(nodes.shape)
        except KeyError as error:
            row = int(np.argmax((nodes == error.args[0]).any(axis=1)))
            told = self.assembly.told
            raise InputError(f"element {told(labels[row])} names node {told(error.args[0])}, which is not defined") from None

    def labels_of(self, keyword, key, seen=()):
        """Labels of a set, including those of the sets that it names."""
        known = self.key(keyword, key)
        if known is None or known in seen:
            raise InputError(f"set '{key}' is named but not defined" if known is None else f"set '{key}' contains itself")
        key, labels = known, []
        for entry in self.sets[keyword][key][1]:
            if isinstance(entry, int):
                labels.append(entry)
            elif isinstance(entry, tuple):
                for block, rows in enumerate(self.cells_of(entry[1])):
                    labels.extend(np.unique(self.blocks[block][2][rows]).tolist())
            else:
                labels.extend(self.labels_of(keyword, entry, seen + (key,)))
        return labels

    def cells_of(self, key):
        """Rows per block; omitted elements are skipped."""
        rows = [[] for _ in self.blocks]
        for label in self.labels_of("ELSET", key):
            if label in self.cell_place:
                block, row = self.cell_place[label]
                rows[block].append(row)
        return [np.array(r, dtype=np.int64) for r in rows]

    def nodes_of(self, key, notes):
        """Rows of points. Numbers without a node are reported, except for reference points of an assembly."""
        labels = self.labels_of("NSET", key)
        missing = [label for label in labels if label not in self.numbers and label > 0]
        if missing:
            notes.append(f"node set '{key}' names {counted(len(missing), 'node')} that {'does' if len(missing) == 1 else 'do'} not exist "
                         f"(the first: {self.assembly.told(missing[0])})")
        return np.unique([self.numbers[n] for n in labels if n in self.numbers]).astype(np.int64)

    def _resolve_surface(self, mesh, name, kind, entries, where):
        if kind == "NODE":
            nodes = [node for entry, _ in entries for node in ([self._node_of(entry, name, where)] if isinstance(entry, int) else
                                                               self.nodes_of(str(entry), mesh.notes).tolist())]
            if nodes:
                mesh.point_sets.setdefault(name, np.unique(np.array(nodes, np.int64)))
            else:
                mesh.notes.append(f"surface '{name}' has no nodes and is left out")
            return
        faces = []
        for entry, side in entries:
            if entry is None:
                raise InputError(f"{where}: surface '{name}' without elements (all exterior faces); name its faces")
            if isinstance(entry, int) and entry not in self.cell_place:
                raise InputError(f"{where}: surface '{name}' names element {self.assembly.told(entry)}, which is no solid or shell of this file")
            places = ([self.cell_place[entry]] if isinstance(entry, int) else
                      [(block, row) for block, rows in enumerate(self.cells_of(str(entry))) for row in rows])
            for block, row in places:
                kind_of_cell, cells = self.cells[block]
                cell = CELLS[kind_of_cell]
                sides = SIDES[cell.shape]
                if kind_of_cell in FLATS and side in CELL_SIDES:
                    faces.append(cells[row, :cell.corners])
                elif re.fullmatch("S[1-9]", side) and int(side[1]) <= len(sides):
                    faces.append(cells[row, list(sides[int(side[1]) - 1])])
                else:
                    known = f"{cell.plural} have sides S1 to S{len(sides)}" if sides else "shells have sides SPOS and SNEG"
                    raise InputError(f"{where}: surface '{name}': side '{side}' of a {cell.singular}; {known}")
        if faces:
            mesh.face_sets[name] = faces
        else:
            mesh.notes.append(f"surface '{name}' has no faces and is left out")

    def _node_of(self, label, name, where):
        if label not in self.numbers:
            raise InputError(f"{where}: surface '{name}' names node {self.assembly.told(label)}, which does not exist")
        return self.numbers[label]
