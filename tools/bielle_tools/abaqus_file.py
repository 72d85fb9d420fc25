"""Reads meshes of Abaqus and CalculiX input files (.inp).

meshio reads .inp too, but drops *SURFACE, stops at the triangles CPS6 that gmsh writes, and assigns element sets to the
wrong blocks when several *ELEMENT blocks have none or share one. This reader knows
    *NODE, *ELEMENT (INPUT), *SYSTEM, *NSET, *ELSET (GENERATE, sets of sets), *SURFACE (TYPE=ELEMENT, NODE), *INCLUDE, and
    one *PART, or one *INSTANCE that holds a mesh,
It refuses keywords that generate or move nodes and elements, and reports those that have no counterpart in a
superelement (abaqus_extras). Labels are compared without regard to case, as Abaqus does. cells.py has the faces S1, S2,
.. of each type.
"""

import os
import re

import numpy as np

from .abaqus_constraints import Constraints, Keyword
from .abaqus_extras import Extras
from .abaqus_ties import read_abaqus_ties, tie_notes
from .cells import CELLS, FLATS, SIDES, permutation
from .messages import InputError, counted
from .solid_mesh import RawMesh
from .text_lines import lines_of

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
GENERATING = ("NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY", "SYMMETRIC MODEL GENERATION", "MODEL CHANGE", "TRANSFORM COORDINATES")
CELL_SIDES = ("SPOS", "SNEG", "")  # both sides of a shell or membrane element


def read_deck(path):
    """@returns Deck. @raises InputError with file and line."""
    deck = Deck()
    deck.read(path)
    return deck


def read_abaqus(path):
    """@returns RawMesh, with notes on ties. @raises InputError with file and line."""
    deck = read_deck(path)
    mesh = deck.raw_mesh(path)
    mesh.notes += tie_notes(read_abaqus_ties(deck))
    return mesh


def read_sections(path):
    """The materials and *SOLID SECTIONs of a file, as Extras; sets have the names that they get as groups."""
    reader = read_deck(path)
    for section in reader.extras.sections:
        if section.set.upper() not in reader.sets["ELSET"]:
            raise InputError(f"'{path}': *SOLID SECTION: there is no element set '{section.set}'")
        section.set = reader.sets["ELSET"][section.set.upper()][0]
    return reader.extras


class Deck:
    """The contents of a file. Labels of nodes and names of sets are resolved when all of it has been read."""

    def __init__(self):
        self.numbers = {}  # node label -> row of points
        self.points = []
        self.blocks = []   # (type, labels, connectivity)
        self.sets = {"NSET": {}, "ELSET": {}}  # upper-case name -> (name, entries)
        self.surfaces = {}  # upper-case name -> (name, kind, entries, where)
        self.skipped = {}  # element type -> count
        self.formulations = {}  # element type with a letter for its formulation -> count
        self.parts = 0
        self.in_assembly = self.in_instance = False
        self.instance = self.meshed_instance = None  # names of the one in hand, and of the one that holds the mesh
        self.system = None  # origin and axes (columns) that *NODE is given in
        self.notes = []
        self.extras = Extras()
        self.constraints = Constraints()
        self.reference_points = {}  # label -> place, of an assembly's own nodes
        self.single_nodes = {}      # label of an element with one node -> (type, node)

    # ---- reading ------------------------------------------------------------------------------------------------
    def read(self, path):
        lines = lines_of(path)
        index = 0
        while index < len(lines):
            line = lines[index].strip()
            if not line.startswith("*") or line.startswith("**"):
                index += 1
                continue
            first = index
            while line.endswith(",") and index + 1 < len(lines):  # a keyword line may go on
                index += 1
                line += lines[index].strip()
            index += 1
            data = index
            while index < len(lines) and (not lines[index].lstrip().startswith("*") or lines[index].lstrip().startswith("**")):
                index += 1
            rows = [text.strip() for text in lines[data:index] if text.strip() and not text.lstrip().startswith("**")]
            self._keyword(path, f"{path}:{first + 1}", line, rows)

    def _keyword(self, path, where, line, rows):
        words = [word.strip() for word in line[1:].split(",")]
        keyword = re.sub(r"\s+", " ", words[0]).upper()
        options = {}
        for word in words[1:]:
            key, _, value = word.partition("=")
            options[key.strip().upper()] = value.strip().strip('"')
        try:
            if keyword == "NODE":
                self._nodes(where, options, self._rows(path, where, options, rows))
            elif keyword == "ELEMENT":
                self._elements(where, options, self._rows(path, where, options, rows))
            elif keyword in ("NSET", "ELSET"):
                self._set(where, keyword, options, rows)
            elif keyword == "SURFACE":
                self._surface(where, options, rows)
            elif keyword == "INCLUDE":
                self.read(os.path.join(os.path.dirname(path), options.get("INPUT", "")))
            elif keyword == "SYSTEM":
                self.system = _system(where, rows)
            elif keyword in ("PART", "ASSEMBLY", "END ASSEMBLY", "INSTANCE", "END INSTANCE"):
                self._structure(where, keyword, options, rows)
            elif keyword in GENERATING:
                raise InputError(f"{where}: *{keyword} makes or moves nodes or elements, which Bielle does not do: write the mesh out in full "
                                 "(a preprocessor that reads the file exports it so)")
            else:
                self.extras.keyword(keyword, options, rows)
                self.constraints.keyword(Keyword(where, keyword, options, rows, self.in_assembly and not self.in_instance))
        except ValueError as error:
            raise InputError(f"{where}: *{keyword}: {error}") from None

    def _structure(self, where, keyword, options, rows):
        self.in_assembly = keyword in ("ASSEMBLY", "INSTANCE", "END INSTANCE")
        self.in_instance = keyword == "INSTANCE"
        if keyword == "PART":
            self.parts += 1
            if self.parts > 1:
                raise InputError(f"{where}: the file holds several parts; Bielle reduces one body at a time: export one part")
        if keyword == "INSTANCE":
            if rows:
                raise InputError(f"{where}: the instance is moved or turned; export the part where it was meshed")
            self.instance = options.get("NAME", "?")
            self.extras.instance(options.get("PART", ""), options.get("NAME", ""))

    def _rows(self, path, where, options, rows):
        """Data lines, with those of the file that INPUT names."""
        if "INPUT" not in options:
            return rows
        name = os.path.join(os.path.dirname(path), options["INPUT"])
        lines = [line.strip() for line in lines_of(name, f"{where}: ")]
        return rows + [line for line in lines if line and not line.startswith("*")]

    def _nodes(self, where, options, rows):
        if options.get("SYSTEM", "R").upper() != "R":
            raise InputError(f"{where}: nodes in cylindrical or spherical coordinates; write them in Cartesian ones")
        if self.in_assembly and not self.in_instance:
            self.notes.append(f"{len(rows)} reference points of the assembly are left out of the mesh")
            for row in rows:
                label, place = self._node(row)
                self.reference_points[label] = place
            if "NSET" in options:
                self._extend("NSET", options["NSET"], [("reference point", self._node(row)[0]) for row in rows])
            return
        if self.in_instance:
            if self.points and self.meshed_instance != self.instance:
                raise InputError(f"{where}: the instance '{self.instance}' holds a mesh as well as what stands before it; Bielle reduces one "
                                 "body at a time: export one instance")
            self.meshed_instance = self.instance
        labels = []
        for row in rows:
            label, xyz = self._node(row)
            if label in self.numbers and self.points[self.numbers[label]] != xyz:
                raise InputError(f"{where}: there is a second node {label}, in another place")
            self.numbers[label] = len(self.points)
            self.points.append(xyz)
            labels.append(label)
        if "NSET" in options:
            self._extend("NSET", options["NSET"], labels)

    def _node(self, row):
        """Label and place of a node."""
        values = row.split(",")
        xyz = [float(re.sub("[dD]", "e", word)) if word.strip() else 0.0 for word in values[1:4]]
        xyz += [0.0] * (3 - len(xyz))
        if self.system:
            xyz = (self.system[0] + self.system[1] @ np.array(xyz)).tolist()
        return int(values[0]), xyz

    def _elements(self, where, options, rows):
        label = options.get("TYPE", "").upper()
        for pattern, kind, count in FAMILIES:
            found = re.fullmatch(pattern, label)
            if found:
                break
        else:
            raise InputError(f"{where}: elements of type '{label}': Bielle reduces solid cells (C3D4, C3D10, C3D8, C3D20, C3D27, C3D6, C3D15, "
                             "C3D5) and reads shells (S3, S4, S8R, CPS6, ...) as surfaces; remesh the body with these")
        if kind is None:
            self.skipped[label] = self.skipped.get(label, 0) + len(rows)
            self._keep_single_nodes(label, options, rows)
            return
        numbers = [int(word) for row in rows for word in row.split(",") if word.strip()]
        if len(numbers) % (count + 1):
            raise InputError(f"{where}: {label} needs {count} nodes per element: {counted(len(numbers), 'number')} cannot be "
                             f"divided into rows of {count + 1}")
        table = np.array(numbers, dtype=np.int64).reshape(-1, count + 1)
        if CELLS[kind].dimension == 3 and found.group(2):
            self.formulations[label] = self.formulations.get(label, 0) + len(table)
        self.blocks.append((kind, table[:, 0], table[:, 1:][:, permutation(kind, "abaqus", "vtk")]))
        if "ELSET" in options:
            self._extend("ELSET", options["ELSET"], table[:, 0].tolist())

    def _keep_single_nodes(self, kind, options, rows):
        """Remembers point masses and distributing couplings, which stand at one node."""
        if not kind.startswith(("MASS", "ROTARYI", "DCOUP3D")):
            return
        labels = []
        for row in rows:
            words = [word.strip() for word in row.split(",") if word.strip()]
            if len(words) != 2:
                raise ValueError(f"an element of type {kind} has one node: expected two numbers, found '{row}'")
            labels.append(int(words[0]))
            self.single_nodes[labels[-1]] = (kind, self._own_label(options, words[1]))
        if "ELSET" in options:
            self._extend("ELSET", options["ELSET"], labels)

    def _own_label(self, options, word):
        """A label as `_label`; of a reference point where an assembly means its own nodes."""
        label = self.label(word)
        own = self.in_assembly and not self.in_instance and "INSTANCE" not in options and "." not in word
        return ("reference point", label) if own and label in self.reference_points else label

    def _set(self, where, keyword, options, rows):
        name = options.get(keyword)
        if not name:
            raise ValueError(f"no name ({keyword}=...)")
        entries = []
        for row in rows:
            words = [word.strip() for word in row.split(",") if word.strip()]
            if "GENERATE" in options:
                first, last, step = (int(word) for word in (words + ["1"])[:3])
                entries.extend(range(first, last + 1, step))
            else:
                entries.extend(self._own_label(options, word) if keyword == "NSET" else self.label(word) for word in words)
        if keyword == "NSET" and "ELSET" in options:
            entries.append(("nodes of", options["ELSET"]))
        self._extend(keyword, name, entries)

    def _extend(self, keyword, name, entries):
        self.sets[keyword].setdefault(name.upper(), (name, []))[1].extend(entries)

    def _surface(self, where, options, rows):
        name = options.get("NAME")
        if not name:
            raise ValueError("no name (NAME=...)")
        kind = options.get("TYPE", "ELEMENT").upper()
        if kind not in ("ELEMENT", "NODE"):
            self.notes.append(f"surface '{name}' of type {kind} is left out")
            return
        entries = []
        for row in rows:
            words = [word.strip() for word in row.split(",")]
            entries.append((self.label(words[0]) if words[0] else None, words[1].upper() if len(words) > 1 else ""))
        self.surfaces[name.upper()] = (name, kind, entries, where)

    @staticmethod
    def label(word):
        """A number, or the name of a set; `Part-1-1.12` is number 12 of an instance."""
        word = word.strip('"')
        last = word.rpartition(".")[2]
        return int(last) if last.lstrip("+-").isdigit() else last

    # ---- result -------------------------------------------------------------------------------------------------
    def raw_mesh(self, path):
        if not self.points:
            raise InputError(f"'{path}' holds no *NODE: it is no Abaqus or CalculiX mesh")
        self.cells = [(kind, self._rows_of(labels, nodes)) for kind, labels, nodes in self.blocks]
        self.cell_place = {}
        for block, (_, labels, _) in enumerate(self.blocks):
            for row, label in enumerate(labels.tolist()):
                self.cell_place[label] = (block, row)
        mesh = RawMesh(np.array(self.points), self.cells, notes=self.notes, labels=[labels for _, labels, _ in self.blocks])
        mesh.notes += self.extras.notes()
        if self.formulations:
            counts = ", ".join(f"{count} {label}" for label, count in self.formulations.items())
            mesh.notes.append(f"reduced, hybrid, incompatible and modified formulations are replaced by Bielle's own: {counts}")
        for count, kind in ((count, kind) for kind, count in self.skipped.items()):
            mesh.notes.append(f"left out: {counted(count, 'element')} of type {kind}, which has neither volume nor surface")
        for key, (name, _) in self.sets["ELSET"].items():
            if not name.startswith("_"):  # Abaqus' own helpers of surfaces
                mesh.cell_sets[name] = self.cells_of(key)
        for key, (name, _) in self.sets["NSET"].items():
            if not name.startswith("_"):
                nodes = self.nodes_of(key)
                if len(nodes):
                    mesh.point_sets[name] = nodes
        for surface in self.surfaces.values():
            self._resolve_surface(mesh, *surface)
        return mesh

    def _rows_of(self, labels, nodes):
        try:
            return np.array([[self.numbers[n] for n in row] for row in nodes.tolist()], dtype=np.int64).reshape(nodes.shape)
        except KeyError as error:
            row = int(np.argmax((nodes == error.args[0]).any(axis=1)))
            raise InputError(f"element {labels[row]} names node {error.args[0]}, which is not defined") from None

    def labels_of(self, keyword, key, seen=()):
        """Labels of a set, including those of the sets that it names."""
        if key not in self.sets[keyword] or key in seen:
            raise InputError(f"set '{key}' is named but not defined" if key not in seen else f"set '{key}' contains itself")
        labels = []
        for entry in self.sets[keyword][key][1]:
            if isinstance(entry, int):
                labels.append(entry)
            elif isinstance(entry, tuple) and entry[0] == "reference point":
                labels.append(entry)
            elif isinstance(entry, tuple):
                for block, rows in enumerate(self.cells_of(entry[1].upper())):
                    labels.extend(np.unique(self.blocks[block][2][rows]).tolist())
            else:
                labels.extend(self.labels_of(keyword, entry.upper(), seen + (key,)))
        return labels

    def cells_of(self, key):
        """Rows per block; omitted elements are skipped."""
        rows = [[] for _ in self.blocks]
        for label in self.labels_of("ELSET", key):
            if label in self.cell_place:
                block, row = self.cell_place[label]
                rows[block].append(row)
        return [np.array(r, dtype=np.int64) for r in rows]

    def nodes_of(self, key):
        return np.unique([self.numbers[n] for n in self.labels_of("NSET", key) if n in self.numbers]).astype(np.int64)

    def _resolve_surface(self, mesh, name, kind, entries, where):
        if kind == "NODE":
            nodes = [[self.numbers[entry]] if isinstance(entry, int) else self.nodes_of(entry.upper()).tolist()
                     for entry, _ in entries]
            mesh.point_sets.setdefault(name, np.unique(np.concatenate([np.array(n, np.int64) for n in nodes])))
            return
        faces = []
        for entry, side in entries:
            if entry is None:
                raise InputError(f"{where}: surface '{name}' without elements (all exterior faces); name its faces")
            places = ([self.cell_place[entry]] if isinstance(entry, int) and entry in self.cell_place else
                      [(block, row) for block, rows in enumerate(self.cells_of(str(entry).upper())) for row in rows])
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


def _system(where, rows):
    """Origin a and axes of *SYSTEM: b on the first axis, c in the plane of the first two; None if it ends a system.
    (Abaqus Keywords Guide, "*SYSTEM".)"""
    words = [word.strip() for row in rows for word in row.rstrip(",").split(",")]
    values = [float(word) if word else 0.0 for word in words]
    if not values:
        return None
    values += [0.0] * (-len(values) % 3)
    points = np.array(values).reshape(-1, 3)
    if len(points) > 3:
        raise ValueError(f"expected three points at most, found {counted(len(values), 'number')}")
    if len(points) == 1:
        return points[0], np.eye(3)
    x = points[1] - points[0]
    if len(points) == 2:
        if x[2] != 0:
            raise ValueError("without a third point the first axis must stand in the plane of x and y")
        z = np.array([0.0, 0.0, 1.0])
    else:
        z = np.cross(x, points[2] - points[0])
    if np.linalg.norm(x) == 0 or np.linalg.norm(z) <= 1e-12 * np.linalg.norm(x) * max(np.linalg.norm(points[-1] - points[0]), 1e-300):
        raise InputError(f"{where}: *SYSTEM: the points stand in one line")
    x, z = x / np.linalg.norm(x), z / np.linalg.norm(z)
    return points[0], np.column_stack([x, np.cross(z, x), z])
