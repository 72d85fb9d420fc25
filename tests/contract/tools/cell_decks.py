"""Boxes meshed with each type of solid cell, and mixtures, as decks of Nastran and Abaqus. The node orders are copied
from the manuals of the programs, independently of the tools."""

import itertools

import numpy as np

import box_mesh  # noqa: F401  (paths)

# Corners, from 1, at the ends of the edges that have the mid-side nodes.
ABAQUS = {"tetra": "12 23 31 14 24 34", "hexahedron": "12 23 34 41 56 67 78 85 15 26 37 48", "wedge": "12 23 31 45 56 64 14 25 36",
          "pyramid": "12 23 34 41 15 25 35 45"}
NASTRAN = {"tetra": "12 23 31 14 24 34", "hexahedron": "12 23 34 41 15 26 37 48 56 67 78 85", "wedge": "12 23 31 14 25 36 45 56 64",
           "pyramid": "12 23 34 41 15 25 35 45"}
SIDES = {"tetra": "123 142 243 341", "hexahedron": "1234 5876 1562 2673 3784 4851", "wedge": "123 465 1254 2365 3146",
         "pyramid": "1234 152 253 354 451"}
TYPES = {"tetra": ("C3D4", "C3D10"), "hexahedron": ("C3D8", "C3D20"), "wedge": ("C3D6", "C3D15"), "pyramid": ("C3D5", "C3D13")}
CARDS = {"tetra": "CTETRA", "hexahedron": "CHEXA", "wedge": "CPENTA", "pyramid": "CPYRAM"}
OF_CUBE = {  # cells of a cube by its corners in the order of a hexahedron; 8 is its centre
    "hexahedron": [("hexahedron", "01234567")], "wedge": [("wedge", "012456"), ("wedge", "023467")],
    "pyramid": [("pyramid", each) for each in ("01238", "47658", "04518", "15628", "26738", "37408")],
    "tetra": [("tetra", each) for each in ("0126", "0236", "0376", "0746", "0456", "0516")],
    # Divides the pyramid over x = right into two tetrahedra.
    "end": [("pyramid", each) for each in ("01238", "47658", "04518", "26738", "37408")] + [("tetra", "1528"), ("tetra", "5628")],
}
SIZE = (0.6, 0.2, 0.1)
VOLUME, SIDE = 0.6 * 0.2 * 0.1, 0.2 * 0.1


class Box:
    """`points` is (p,3); `cells` is a list of (shape, corners, {edge: middle node}) with numbers from 0."""

    def __init__(self, kinds=("hexahedron",) * 3, order=1, across=2):
        """`kinds` has the kind of each slice along x; `across` is the number of cubes along y and z."""
        x, y, z = (np.linspace(0, s, n + 1) for s, n in zip(SIZE, (len(kinds), across, across)))
        y = y + 0.13 * y * (SIZE[1] - y) / SIZE[1]
        self.points = [np.array([a, b, c]) for c in z for b in y for a in x]
        self.order, self.at, self.shapes = order, {}, []
        for k, j, i in itertools.product(range(across), range(across), range(len(kinds))):
            cube = [i + a + (len(kinds) + 1) * (j + b + (across + 1) * (k + c))
                    for c in (0, 1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
            cells = OF_CUBE[kinds[i]]
            if any("8" in corners for _, corners in cells):
                cube.append(self.add(cube))
            self.shapes += [(shape, [cube[int(c)] for c in corners]) for shape, corners in cells]

    def add(self, corners):
        """Returns the node in the middle of nodes."""
        key = frozenset(corners)
        if len(key) == 1:  # the edge is collapsed
            return corners[0]
        if key not in self.at:
            self.at[key] = len(self.points)
            self.points.append(np.mean([self.points[k] for k in key], axis=0))
        return self.at[key]

    def middles(self, shape, corners, edges):
        return [self.add([corners[int(k) - 1] for k in edge]) for edge in edges[shape].split()] if self.order == 2 else []

    def rows(self, edges):
        """Returns [(shape, nodes)] with the mid-side nodes in an order."""
        return [(shape, corners + self.middles(shape, corners, edges)) for shape, corners in self.shapes]

    def left(self):
        """Returns the numbers of the nodes of the side x = 0."""
        return [k for k, x in enumerate(self.points) if x[0] == 0]

    def nodes_of_abaqus(self):
        return "*NODE\n" + "".join(f"{k}, {x[0]:.15g}, {x[1]:.15g}, {x[2]:.15g}\n" for k, x in enumerate(self.points, 1))

    def abaqus(self, extra="", types=None):
        """types: {shape: label}"""
        rows, text = self.rows(ABAQUS), ""
        for shape in dict.fromkeys(shape for shape, _ in rows):
            text += f"*ELEMENT, TYPE={(types or {}).get(shape, TYPES[shape][self.order - 1])}, ELSET=BODY\n"
            for number, (other, nodes) in enumerate(rows, 1):
                if other == shape:
                    words = [str(number)] + [str(n + 1) for n in nodes]
                    text += ",\n".join(", ".join(words[k:k + 16]) for k in range(0, len(words), 16)) + "\n"
        return "*HEADING\n box\n" + self.nodes_of_abaqus() + text + extra

    def surface(self, name="PRESS"):
        """Returns a *SURFACE of the faces of cells on the side x = 0."""
        left, lines = set(self.left()), []
        for number, (shape, corners) in enumerate(self.shapes, 1):
            lines += [f"{number}, S{k}" for k, side in enumerate(SIDES[shape].split(), 1) if {corners[int(c) - 1] for c in side} <= left]
        return f"*SURFACE, TYPE=ELEMENT, NAME={name}\n" + "\n".join(lines) + "\n"

    def nastran(self, extra="", form="small"):
        rows = self.rows(NASTRAN)
        text = "".join(card(form, "GRID", k, "", *(f"{v:.9g}" if form != "small" else f"{v:.6f}"[:8] for v in x))
                       for k, x in enumerate(self.points, 1))
        text += "".join(card(form, CARDS[shape], number, 1, *(n + 1 for n in nodes)) for number, (shape, nodes) in enumerate(rows, 1))
        return "BEGIN BULK\nPSOLID,1,1\n" + text + extra + "ENDDATA\n"


def card(form, name, *fields):
    """Returns one card in small, large or free fields, with continuations."""
    words = [str(field) if form == "free" or "." in str(field) or field == "" or not isinstance(field, float) else f"{field:.1f}" for field in fields]
    count = 4 if form == "large" else 8
    lines = [words[k:k + count] for k in range(0, len(words), count)]
    if form == "free":
        return "\n".join(",".join([name if k == 0 else "+"] + line) for k, line in enumerate(lines)) + "\n"
    width = 16 if form == "large" else 8
    heads = [name + "*" if form == "large" else name] + ["*" if form == "large" else "+"] * (len(lines) - 1)
    return "\n".join(f"{head:8}" + "".join(f"{word:>{width}}" for word in line) for head, line in zip(heads, lines)) + "\n"
