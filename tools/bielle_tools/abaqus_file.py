"""Reads meshes of Abaqus and CalculiX input files (.inp).

meshio reads .inp too, but drops *SURFACE, stops at the triangles CPS6 that gmsh writes, and assigns element sets to the
wrong blocks when several *ELEMENT blocks have none or share one. This reader knows
    *NODE, *ELEMENT (INPUT), *SYSTEM, *NSET, *ELSET (GENERATE, sets of sets), *SURFACE (TYPE=ELEMENT, NODE), *INCLUDE,
    *NGEN, *NFILL, *NCOPY, *ELGEN, *ELCOPY (abaqus_generators), *TIE (abaqus_ties), and
    *PART and *INSTANCE, moved and turned (abaqus_assembly).
It refuses other keywords that generate or move nodes and elements, and reports those that have no counterpart in a
superelement (abaqus_extras). Labels are compared without regard to case, as Abaqus does. cells.py has the faces S1, S2,
.. of each type.
"""

import re

import numpy as np

from . import abaqus_generators
from .abaqus_assembly import STRIDE, Assembly
from .abaqus_extras import Extras
from .abaqus_lines import integer, numbers, read_keywords
from .abaqus_systems import kind_of_coordinates, of_cylinder, system
from .abaqus_ties import join_ties, read_tie
from .cells import CELLS, FLATS, SIDES, permutation
from .messages import InputError, counted, did_you_mean
from .solid_mesh import RawMesh

# Element families of the two programs: label pattern, meshio type (None: points, lines and couplings, left out), nodes.
FAMILIES = [
    (r"(C|DC|AC|F)3D4([A-Z]*)", "tetra", 4),
    (r"(C|DC|AC|F)3D10([A-Z]*)", "tetra10", 10),
    (r"(C|DC|AC|F)3D8([A-Z]*)", "hexahedron", 8),
    (r"(C|DC|AC|F)3D20([A-Z]*)", "hexahedron20", 20),
    (r"(C|DC|AC|F)3D27([A-Z]*)", "hexahedron27", 27),
    (r"(C|DC|AC|F)3D6([A-Z]*)", "wedge", 6),
    (r"(C|DC|AC|F)3D15([A-Z]*)", "wedge15", 15),
    (r"(C|DC|AC|F)3D5([A-Z]*)", "pyramid", 5),
    (r"(C|DC|AC|F)3D13([A-Z]*)", "pyramid13", 13),
    (r"(S|CPS|CPE|DS|DC2D|M3D|SFM3D|STRI|R3D)3[A-Z]*", "triangle", 3),
    (r"(S|CPS|CPE|DS|DC2D|M3D|SFM3D)6[A-Z]*|STRI65", "triangle6", 6),
    (r"(S|CPS|CPE|DS|DC2D|M3D|SFM3D|R3D)4[A-Z]*5?", "quad", 4),
    (r"(S|CPS|CPE|DS|DC2D|M3D|SFM3D)8[A-Z]*5?", "quad8", 8),
    (r"(S|M3D)9[A-Z]*5?", "quad9", 9),
    (r"(MASS|ROTARYI|SPRING[12A]|DASHPOT[12A]|DCOUP3D|CONN3D2|GAPUNI|B[23][123]|T[23]D[23]|FRAME3D)[A-Z]*", None, None),
]
# Keywords that generate or move nodes and elements, which this reader does not support.
GENERATING = ("NMAP", "SYMMETRIC MODEL GENERATION", "MODEL CHANGE", "TRANSFORM COORDINATES", "SUBSTRUCTURE GENERATE", "IMPORT")
CELL_SIDES = ("SPOS", "SNEG", "")  # both sides of a shell or membrane element
LABELS = 2**31       # numbers of nodes and elements are less
MOST = 2 * 10**7     # numbers that one line of a set generates
SAME_PLACE = 1e-12   # distance of a node that is given twice, relative to its largest coordinate: by rounding


def read_abaqus(path):
    """@returns RawMesh. @raises InputError with file and line."""
    return read_contents(path).raw_mesh(path)


def read_sections(path):
    """The materials and *SOLID SECTIONs of a file, as Extras; sets have the names that they get as groups."""
    reader = read_contents(path)
    for section in reader.extras.sections:
        key = reader.key("ELSET", section.set)
        if key is None:
            raise InputError(f"'{path}': *SOLID SECTION: there is no element set '{section.set}'")
        section.set = reader.sets["ELSET"][key][0]
    return reader.extras


def read_contents(path):
    """Nodes, elements, sets and surfaces of the body, with their numbers. @raises InputError with file and line."""
    reader = _Reader()
    assembly = Assembly(reader, _Reader)
    for keyword in read_keywords(path):
        assembly.keyword(keyword)
    assembly.finish()
    return reader


class _Reader:
    """The contents of a file, of a part or of an instance."""

    def __init__(self):
        self.numbers = {}  # node label -> row of points
        self.points = []
        self.blocks = []   # (type, labels, connectivity)
        self.cell_place = {}  # element label -> (block, row)
        self.sets = {"NSET": {}, "ELSET": {}}  # upper-case name -> (name, entries)
        self.unsorted = set()  # upper-case names of node sets in the order of the file
        self.surfaces = {}  # upper-case name -> (name, kind, entries, where)
        self.ties = []  # Tie
        self.skipped = {}  # element type -> count
        self.formulations = {}  # element type with a letter for its formulation -> count
        self.system = None  # origin and axes (columns) that *NODE is given in
        self.assembly = None  # the one that names entries of sets and surfaces, where several instances stand
        self.notes = []
        self.extras = Extras()

    # ---- reading ------------------------------------------------------------------------------------------------
    def keyword(self, keyword):
        try:
            self._keyword(keyword)
        except ValueError as error:
            raise InputError(f"{keyword.where}: *{keyword.name}: {error}") from None

    def _keyword(self, keyword):
        name = keyword.name
        if name == "NODE":
            self._nodes(keyword)
        elif name == "ELEMENT":
            self._elements(keyword)
        elif name in ("NSET", "ELSET"):
            self._set(keyword)
        elif name == "SURFACE":
            self._surface(keyword)
        elif name == "TIE":
            self.ties.append(read_tie(keyword))
        elif name == "SYSTEM":
            self.system = system(keyword)
        elif name in abaqus_generators.NAMES:
            abaqus_generators.generate(self, keyword)
        elif name in GENERATING:
            raise InputError(f"{keyword.where}: *{name} makes or moves nodes or elements, which Bielle does not do: write the mesh out in full "
                             "(a preprocessor that reads the file exports it so)")
        else:
            self.extras.keyword(name, keyword.options, keyword.rows)

    def _nodes(self, keyword):
        cylindrical = kind_of_coordinates(keyword)
        labels, points = [], []
        for label, x in keyword.table(_node):
            labels.append(label)
            points.append(of_cylinder(x) if cylindrical else x)
        if self.system and points:
            points = self.system[0] + np.array(points) @ self.system[1].T
        self.add_nodes(keyword.places, labels, points)
        if "NSET" in keyword.options:
            self.extend("NSET", keyword.options["NSET"], labels)

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

    def _elements(self, keyword):
        label = keyword.options.get("TYPE", "").upper()
        for pattern, kind, count in FAMILIES:
            found = re.fullmatch(pattern, label)
            if found:
                break
        else:
            raise InputError(f"{keyword.where}: elements of type '{label}': Bielle reduces solid cells (C3D4, C3D10, C3D8, C3D20, C3D27, C3D6, "
                             "C3D15, C3D5) and reads shells (S3, S4, S8R, CPS6, ...) as surfaces; remesh the body with these")
        if kind is None:
            self.skipped[label] = self.skipped.get(label, 0) + len(keyword.rows)
            return
        table = _element_table(keyword, label, count)
        if CELLS[kind].dimension == 3 and found.group(2):
            self.formulations[label] = self.formulations.get(label, 0) + len(table)
        if len(table):
            self.add_elements((keyword.path, keyword.line), kind, table[:, 0], table[:, 1:][:, permutation(kind, "abaqus", "vtk")])
        if "ELSET" in keyword.options:
            self.extend("ELSET", keyword.options["ELSET"], table[:, 0].tolist())

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
            raise InputError("{}:{}: there is no element {} before this line".format(*where, label))
        block, row = self.cell_place[label]
        return self.blocks[block][0], self.blocks[block][2][row]

    def members(self, kind, name, where):
        """Numbers of a set as it is before a keyword, each once. @raises InputError if there is no set"""
        key = self.key(kind, name)
        if key is None:
            raise InputError("{}:{}: there is no *{} '{}' before this line".format(*where, kind, name))
        found = list(dict.fromkeys(self._resolve(kind, key)))
        return found if key in self.unsorted else sorted(found)

    def key(self, kind, name):
        """The key of a set among those of its kind, or of a surface; None if there is none."""
        others, known = self.assembly.other_names(name) if self.assembly else [], self.sets.get(kind, self.surfaces)
        return next((key for key in (name.upper(), *others) if key in known), None)

    def copy(self):
        """A reader with the same contents, to which more can be added."""
        other = _Reader()
        other.numbers, other.points, other.blocks, other.cell_place = dict(self.numbers), list(self.points), list(self.blocks), dict(self.cell_place)
        other.sets = {kind: {key: (name, list(entries)) for key, (name, entries) in sets.items()} for kind, sets in self.sets.items()}
        other.unsorted, other.surfaces = set(self.unsorted), dict(self.surfaces)
        other.ties = list(self.ties)
        other.skipped, other.formulations, other.notes = dict(self.skipped), dict(self.formulations), list(self.notes)
        other.extras.join(self.extras, str, False)
        return other

    def _set(self, keyword):
        name = keyword.options.get(keyword.name)
        if not name:
            raise ValueError(f"no name ({keyword.name}=...)")
        shift = self.assembly.shift(keyword) if self.assembly else 0
        entries = []
        for words in keyword.table(lambda words: [word for word in words if word]):
            if "GENERATE" in keyword.options:
                entries.extend(_generated(keyword, words, shift))
            else:
                entries.extend(self._entry(word, shift) for word in words)
        if keyword.name == "NSET" and "ELSET" in keyword.options:
            entries.append(("nodes of", keyword.options["ELSET"]))
        if "UNSORTED" in keyword.options:
            self.unsorted.add(name.upper())
        if "INSTANCE" in keyword.options:
            entries = [entry if isinstance(entry, int) else f"{keyword.options['INSTANCE']}.{entry}" for entry in entries]
        self.extend(keyword.name, name, entries)

    def extend(self, kind, name, entries):
        self.sets[kind].setdefault(name.upper(), (name, []))[1].extend(entries)

    def _surface(self, keyword):
        name = keyword.options.get("NAME")
        if not name:
            raise ValueError("no name (NAME=...)")
        kind = keyword.options.get("TYPE", "ELEMENT").upper()
        if kind not in ("ELEMENT", "NODE"):
            self.notes.append(f"surface '{name}' of type {kind} is left out")
            return
        shift = self.assembly.shift(keyword) if self.assembly else 0
        entries = [(self._entry(words[0], shift) if words[0] else None, words[1].upper() if len(words) > 1 else "")
                   for words in keyword.table(lambda words: words)]
        if "COMBINE" in keyword.options:
            raise ValueError("surfaces that are combined are not read; name the faces")
        self.surfaces[name.upper()] = (name, kind, entries, keyword.where)

    def _entry(self, word, shift):
        """A number, or the name of a set; `Part-1-1.12` is number 12 of an instance."""
        word = word.strip('"')
        if word.lstrip("+-").isdigit():
            return int(word) + shift
        return self.assembly.entry(word) if self.assembly else word

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
        for count, kind in ((count, kind) for kind, count in self.skipped.items()):
            mesh.notes.append(f"left out: {counted(count, 'element')} of type {kind}, which has neither volume nor surface")
        for key, (name, _) in self.sets["ELSET"].items():
            if not name.startswith("_"):  # Abaqus' own helpers of surfaces
                mesh.cell_sets[name] = self._cells_of(key)
        for key, (name, _) in self.sets["NSET"].items():
            if not name.startswith("_"):
                nodes = self._nodes_of(key, mesh.notes)
                if len(nodes):
                    mesh.point_sets[name] = nodes
                else:
                    mesh.notes.append(f"node set '{name}' has no nodes and is left out")
        for surface in self.surfaces.values():
            self._resolve_surface(mesh, *surface)
        for tie in self.ties:
            tie.pairs = [[self._tied(tie, name) for name in names] for names in tie.pairs]
        join_ties(mesh, self.ties)
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

    def _resolve(self, keyword, key, seen=()):
        """Labels of a set, including those of the sets that it names."""
        known = self.key(keyword, key)
        if known is None or known in seen:
            raise InputError(f"set '{key}' is named but not defined" if known is None else f"set '{key}' contains itself")
        key, labels = known, []
        for entry in self.sets[keyword][key][1]:
            if isinstance(entry, int):
                labels.append(entry)
            elif isinstance(entry, tuple):
                for block, rows in enumerate(self._cells_of(entry[1])):
                    labels.extend(np.unique(self.blocks[block][2][rows]).tolist())
            else:
                labels.extend(self._resolve(keyword, entry, seen + (key,)))
        return labels

    def _cells_of(self, key):
        """Rows per block; omitted elements are skipped."""
        rows = [[] for _ in self.blocks]
        for label in self._resolve("ELSET", key):
            if label in self.cell_place:
                block, row = self.cell_place[label]
                rows[block].append(row)
        return [np.array(r, dtype=np.int64) for r in rows]

    def _nodes_of(self, key, notes):
        """Rows of points; numbers of no node are told, but for reference points of an assembly."""
        labels = self._resolve("NSET", key)
        missing = [label for label in labels if label not in self.numbers and label > 0]
        if missing:
            notes.append(f"node set '{key}' names {counted(len(missing), 'node')} that {'does' if len(missing) == 1 else 'do'} not exist "
                         f"(the first: {self.assembly.told(missing[0])})")
        return np.unique([self.numbers[n] for n in labels if n in self.numbers]).astype(np.int64)

    def _resolve_surface(self, mesh, name, kind, entries, where):
        if kind == "NODE":
            nodes = [node for entry, _ in entries for node in ([self._node_of(entry, name, where)] if isinstance(entry, int) else
                                                               self._nodes_of(str(entry), mesh.notes).tolist())]
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
                      [(block, row) for block, rows in enumerate(self._cells_of(str(entry))) for row in rows])
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


def _node(words):
    """Label and coordinates of a data line; direction cosines after them are not needed."""
    return integer(words[0]), numbers(words[1:4], 3)


def _element_table(keyword, label, count):
    """(n, count + 1) numbers and nodes of elements, each of which may stand in several lines and ends with one."""
    found, row = [], []
    for k, text in enumerate(keyword.rows):
        try:
            row += [int(word) for word in text.split(",") if word and not word.isspace()]
        except ValueError:
            word = next(word.strip() for word in text.split(",") if not re.fullmatch(r"\s*([+-]?\d+)?\s*", word))
            raise InputError("{}:{}: *ELEMENT: expected an integer, found '{}'".format(*keyword.places[k], word)) from None
        if len(row) > count:
            if len(row) > count + 1:
                break
            found.append(row)
            row = []
    if row:
        raise InputError("{}:{}: {} needs {} nodes per element: element {} has {}".format(
            *keyword.places[k], label, count, row[0], len(row) - 1))
    try:
        return np.array(found, dtype=np.int64).reshape(-1, count + 1)
    except OverflowError:
        worst = max(found, key=lambda each: max(map(abs, each)))
        raise ValueError(f"element {worst[0]} has the number {max(worst, key=abs)}, but numbers are from 1 to {LABELS - 1}") from None


def _generated(keyword, words, shift):
    if not 2 <= len(words) <= 3:
        raise ValueError(f"GENERATE needs the first number, the last one and the step, found {counted(len(words), 'word')}")
    first, last, step = (integer(word) for word in (words + ["1"])[:3])
    if step < 1 or last < first:
        raise ValueError(f"GENERATE makes no numbers from {first} to {last} in steps of {step}")
    if (last - first) // step >= MOST:
        raise ValueError(f"GENERATE makes more than {MOST} numbers from {first} to {last} in steps of {step}")
    return range(first + shift, last + shift + 1, step)
