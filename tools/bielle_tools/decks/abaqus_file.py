"""Reads meshes of Abaqus and CalculiX input files (.inp).

meshio reads .inp too, but drops *SURFACE, stops at the triangles CPS6 that gmsh writes, and assigns element sets to the
wrong blocks when several *ELEMENT blocks have none or share one. This reader knows
    *NODE, *ELEMENT (INPUT), *SYSTEM, *NSET, *ELSET (GENERATE, sets of sets), *SURFACE (TYPE=ELEMENT, NODE), *INCLUDE,
    *NGEN, *NFILL, *NCOPY, *ELGEN, *ELCOPY (abaqus_generators), *TIE (abaqus_tied_surfaces),
    *PART and *INSTANCE, moved and turned (abaqus_assembly), couplings, rigid bodies and point masses (abaqus_ties).
It refuses other keywords that generate or move nodes and elements, and reports those that have no counterpart in a
superelement (abaqus_extras). Labels are compared without regard to case, as Abaqus does. mesh/cells.py has the faces S1, S2,
.. of each type.
"""

import re

import numpy as np

from ..mesh.cells import CELLS, permutation
from ..messages import InputError, counted
from . import abaqus_generators
from .abaqus_assembly import Assembly
from .abaqus_contents import LABELS, STRIDE, Contents
from .abaqus_lines import integer, numbers, read_keywords
from .abaqus_systems import kind_of_coordinates, of_cylinder, system
from .abaqus_tied_surfaces import read_tie
from .abaqus_ties import read_abaqus_ties, tie_notes

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
GENERATING = ("NMAP", "SYMMETRIC MODEL GENERATION", "MODEL CHANGE", "TRANSFORM COORDINATES", "IMPORT")
SINGLE_NODES = ("MASS", "ROTARYI", "DCOUP3D")  # types of elements that stand at one node
MOST = 2 * 10**7  # numbers that one line of a set generates
OWN = None        # in place of the amount by which numbers are raised: numbers of an assembly's own nodes, or of its only instance


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
        key = reader.key("ELSET", section.set)
        if key is None:
            raise InputError(f"'{path}': *SOLID SECTION: there is no element set '{section.set}'")
        section.set = reader.sets["ELSET"][key][0]
    return reader.extras


def read_deck(path):
    """The contents of a file, of all instances together. @raises InputError with file and line."""
    reader = _Reader()
    assembly = Assembly(reader, _Reader)
    for keyword in read_keywords(path):
        assembly.keyword(keyword)
    assembly.finish()
    if reader.unknown:
        raise InputError(f"elements of types that Bielle does not read: {reader.unknown.text()}; it reduces solid cells (C3D4, C3D10, C3D8, C3D20, "
                         "C3D27, C3D6, C3D15, C3D5, C3D13) and reads shells (S3, S4, S8R, CPS6, ...) as surfaces: remesh the body with these, or "
                         "remove the elements")
    return reader


class _Reader(Contents):
    """Adds keywords to the contents."""

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
            self.constraints.keyword(keyword)

    def _given_nodes(self, keyword):
        """Labels and points."""
        cylindrical = kind_of_coordinates(keyword)
        labels, points = [], []
        for label, x in keyword.table(_node):
            labels.append(label)
            points.append(of_cylinder(x) if cylindrical else x)
        if self.system and points:
            points = self.system[0] + np.array(points) @ self.system[1].T
        return labels, points

    def _nodes(self, keyword):
        labels, points = self._given_nodes(keyword)
        self.add_nodes(keyword.places, labels, points)
        if "NSET" in keyword.options:
            self.extend("NSET", keyword.options["NSET"], labels)

    def add_reference_points(self, keyword):
        """Keeps the nodes that an assembly has besides its instances."""
        labels, points = self._given_nodes(keyword)
        labels = [label - STRIDE for label in labels]
        self.reference_points.update(zip(labels, points))
        self.notes.append(f"{counted(len(labels), 'reference point')} of the assembly {'is' if len(labels) == 1 else 'are'} left out of the mesh")
        if "NSET" in keyword.options:
            self.extend("NSET", keyword.options["NSET"], labels)

    def _elements(self, keyword):
        label = keyword.options.get("TYPE", "").upper()
        for pattern, kind, count in FAMILIES:
            found = re.fullmatch(pattern, label)
            if found:
                break
        else:
            if not label:
                raise ValueError("no type (TYPE=...)")
            self.unknown.add(label, _count_elements(keyword.rows), keyword.where)
            return
        if kind is None:
            self.skipped.add(label, len(keyword.rows), keyword.where)
            self._keep_single_nodes(label, keyword)
            return
        table = _element_table(keyword, label, count)
        if CELLS[kind].dimension == 3 and found.group(2):
            self.formulations[label] = self.formulations.get(label, 0) + len(table)
        if len(table):
            self.add_elements((keyword.path, keyword.line), kind, table[:, 0], table[:, 1:][:, permutation(kind, "abaqus", "vtk")])
        if "ELSET" in keyword.options:
            self.extend("ELSET", keyword.options["ELSET"], table[:, 0].tolist())

    def _keep_single_nodes(self, kind, keyword):
        """Remembers point masses and distributing couplings."""
        if not kind.startswith(SINGLE_NODES):
            return
        shift = OWN if self.assembly else 0
        lowered = STRIDE if self.assembly and self.assembly.open else 0
        labels = []
        for words in keyword.table(lambda words: [word for word in words if word]):
            if len(words) != 2:
                raise ValueError(f"an element of type {kind} has one node: expected two numbers, found '{', '.join(words)}'")
            labels.append(integer(words[0]) - lowered)
            self.single_nodes[labels[-1]] = (kind, self._entry(words[1], shift))
        if "ELSET" in keyword.options:
            self.extend("ELSET", keyword.options["ELSET"], labels)

    def _set(self, keyword):
        name = keyword.options.get(keyword.name)
        if not name:
            raise ValueError(f"no name ({keyword.name}=...)")
        shift = self.assembly.shift(keyword) if self.assembly else 0
        entries = []
        for words in keyword.table(lambda words: [word for word in words if word]):
            if "GENERATE" in keyword.options:
                found = _generated(words)
                entries.extend([self.assembly.own(label, keyword.name) for label in found] if shift is OWN else
                               range(found.start + shift, found.stop + shift, found.step))
            else:
                entries.extend(self._entry(word, shift, keyword.name) for word in words)
        if keyword.name == "NSET" and "ELSET" in keyword.options:
            entries.append(("nodes of", keyword.options["ELSET"]))
        if "UNSORTED" in keyword.options:
            self.unsorted.add(name.upper())
        if "INSTANCE" in keyword.options:
            entries = [entry if isinstance(entry, int) else f"{keyword.options['INSTANCE']}.{entry}" for entry in entries]
        self.extend(keyword.name, name, entries)

    def _surface(self, keyword):
        name = keyword.options.get("NAME")
        if not name:
            raise ValueError("no name (NAME=...)")
        kind = keyword.options.get("TYPE", "ELEMENT").upper()
        if kind not in ("ELEMENT", "NODE"):
            self.notes.append(f"surface '{name}' of type {kind} is left out")
            return
        shift = self.assembly.shift(keyword) if self.assembly else 0
        members = "NSET" if kind == "NODE" else "ELSET"
        entries = [(self._entry(words[0], shift, members) if words[0] else None, words[1].upper() if len(words) > 1 else "")
                   for words in keyword.table(lambda words: words)]
        if "COMBINE" in keyword.options:
            raise ValueError("surfaces that are combined are not read; name the faces")
        self.surfaces[name.upper()] = (name, kind, entries, keyword.where)

    def entry(self, word):
        """The number or the name of a set that a word of the file or of its assembly means."""
        return self._entry(word, OWN)

    def _entry(self, word, shift, kind="NSET"):
        """A number, or the name of a set; `Part-1-1.12` is number 12 of an instance."""
        word = word.strip('"')
        if word.lstrip("+-").isdigit():
            return self.assembly.own(int(word), kind) if shift is OWN else int(word) + shift
        return self.assembly.entry(word) if self.assembly else word


def _node(words):
    """Label and coordinates of a data line; direction cosines after them are not needed."""
    return integer(words[0]), numbers(words[1:4], 3)


def _count_elements(rows):
    """The number of elements in data lines of unknown length: lines that end with a comma go on, unless all do."""
    ended = sum(not row.endswith(",") for row in rows)
    return ended or len(rows)


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


def _generated(words):
    """The range of numbers of a line of *NSET or *ELSET, GENERATE."""
    if not 2 <= len(words) <= 3:
        raise ValueError(f"GENERATE needs the first number, the last one and the step, found {counted(len(words), 'word')}")
    first, last, step = (integer(word) for word in (words + ["1"])[:3])
    if step < 1 or last < first:
        raise ValueError(f"GENERATE makes no numbers from {first} to {last} in steps of {step}")
    if (last - first) // step >= MOST:
        raise ValueError(f"GENERATE makes more than {MOST} numbers from {first} to {last} in steps of {step}")
    return range(first, last + 1, step)
