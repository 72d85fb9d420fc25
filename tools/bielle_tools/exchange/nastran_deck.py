"""A deck of Nastran with the points and the unknowns of a MatrixSet, as EXTSEOUT writes it: GRID, CORD2R, SPOINT,
ASET1, QSET1, and BSET1 if some of the nodes are interfaces."""

import numpy as np
import scipy.sparse

from .nastran_unknowns import SCALAR
from .quantity_comments import comments_of

LARGEST = 99_999_999  # a field of 8 characters
WIDE = 16
SYMMETRIC, SQUARE = 6, 1
ROUNDING = 1e-13      # an asymmetry below this share of the largest entry is rounding


def wide_number(value):
    """The shortest text of a number if it has 16 characters at most, or else the nearest one of 16: with an exponent without
    E, or with none."""
    exact = _without_e(repr(float(value)))
    if len(exact) <= WIDE:
        return exact
    room = WIDE - (value < 0)
    exponent = int(np.floor(np.log10(abs(value))))
    decimals = room - 2 - len(f"{exponent:+d}")
    texts = [_without_e(f"{value:.{decimals}E}"), _without_e(f"{value:.{decimals - 1}E}")]  # one more digit may round up
    if -4 <= exponent < room - 1:
        fixed = f"{value:#.{room - 1 - max(exponent + 1, 0)}f}"
        texts.insert(0, fixed.replace("0.", ".", 1) if exponent < 0 else fixed)
    return min((text for text in texts if len(text) <= WIDE), key=lambda text: abs(number_of(text) - value))


def number_of(text):
    """The number that a text of `wide_number` stands for."""
    place = max(text.rfind("+"), text.rfind("-"))
    return float(text if place <= 0 else f"{text[:place]}e{text[place:]}")


def _without_e(text):
    """1.5E-07 as 1.5-7."""
    mantissa, _, exponent = text.upper().partition("E")
    return (mantissa if "." in mantissa else mantissa + ".") + (f"{int(exponent):+d}" if exponent else "")


class Numbering:
    """Numbers of the points of a deck. nodes: of the nodes; scalars: of the scalar coordinates; shapes: of the points of the
    shapes, which have the number of a node only if they are it; notes: what was renumbered."""

    def __init__(self, matrices, shapes):
        """@param shapes: the shapes that are written, or None"""
        own = (matrices.numbers, np.zeros(0) if shapes is None else shapes.numbers)
        self.notes = []
        self._number(matrices, shapes, *(np.asarray(numbers, np.int64) for numbers in own))
        if not self._usable():
            self.notes = ["the points are numbered from 1, since their numbers are not of Nastran"]
            self._number(matrices, shapes, *(np.arange(1, len(numbers) + 1) for numbers in own))

    def sorted_pairs(self, matrices):
        """Point and component of each unknown in Nastran's order, and the places of the unknowns in this order."""
        components = matrices.unknown_components[matrices.unknown_nodes < 0]
        scalars = iter(self.scalars[np.argsort(np.argsort(components))])
        pairs = [(int(next(scalars)), SCALAR) if node < 0 else (int(self.nodes[node]), int(component) + 1)
                 for node, component in zip(matrices.unknown_nodes, matrices.unknown_components)]
        order = np.array(sorted(range(len(pairs)), key=pairs.__getitem__))
        return [pairs[place] for place in order], order

    def _number(self, matrices, shapes, nodes, points):
        self.nodes, self.shapes = nodes, points
        places = dict(zip(nodes, matrices.positions))
        if any(number in places and (places[number] != point).any() for number, point in zip(points, shapes.points if len(points) else ())):
            offset = 10 ** len(str(max(nodes)))
            self.shapes = points + offset
            self.notes.append(f"the numbers of the points of the shapes are raised by {offset}: nodes have the same ones")
        first = max([0, *self.nodes, *self.shapes]) + 1
        self.scalars = np.arange(first, first + matrices.scalars)

    def _usable(self):
        numbers = [*self.nodes, *self.scalars, *self.shapes]
        unique = all(len(np.unique(part)) == len(part) for part in (self.nodes, self.shapes))
        return unique and min(numbers) > 0 and max(numbers) <= LARGEST


def point_cards(matrices, numbering, shapes):
    """Lines of the points and of the sets of unknowns."""
    lines = [f"$ {name} is GRID {numbering.nodes[row]}".encode("ascii", "replace").decode() for name, row in matrices.interfaces.items()]
    systems = {}
    for k, number in enumerate(numbering.nodes):
        if matrices.axes is not None and (matrices.axes[k] != np.eye(3)).any():
            systems[number] = len(systems) + 1
            axes = matrices.axes[k]
            lines += wide("CORD2R", systems[number], 0, 0.0, 0.0, 0.0, *axes[:, 2], *axes[:, 0])
    for number, position in zip(numbering.nodes, matrices.positions):
        lines += wide("GRID", number, 0, *position, systems.get(number, 0))
    nodes = set(numbering.nodes)
    for number, position in zip(numbering.shapes, shapes.points if shapes is not None else ()):
        if number not in nodes:
            lines += wide("GRID", number, 0, *position, 0)
    lines += narrow("SPOINT", numbering.scalars)
    held = {numbering.nodes[row] for row in matrices.interfaces.values()}
    return lines + set_cards(numbering.sorted_pairs(matrices)[0], held if len(held) < len(nodes) else set())


def set_cards(pairs, held):
    """BSET1 of the components of the nodes in `held`, ASET1 of those of the others, QSET1 of the scalar coordinates.
    @param pairs: in Nastran's order"""
    components = {}
    for number, component in pairs:
        if component != SCALAR:
            components[number] = components.get(number, "") + str(component)
    lines = []
    for name, members in (("BSET1", held), ("ASET1", set(components) - held)):
        for text in sorted({components[number] for number in members if number in components}):
            lines += narrow(name, sorted(number for number in members if components.get(number) == text), text)
    return lines + narrow("QSET1", [number for number, component in pairs if component == SCALAR], "0")


def shape_rows(matrices, numbering, shapes):
    """Pairs of the rows, and the shapes in axes of the points."""
    parts = [shapes.displacement] + ([] if shapes.rotation is None else [shapes.rotation])
    values = np.stack([part.reshape(len(shapes.points), 3, -1) for part in parts], axis=1)  # point, kind, component, unknown
    if matrices.axes is not None:
        rows = {number: row for row, number in enumerate(numbering.nodes)}
        for k, number in enumerate(numbering.shapes):
            if number in rows:
                values[k] = matrices.axes[rows[number]].T @ values[k]
    pairs = [(int(number), component) for number in numbering.shapes for component in range(1, 3 * len(parts) + 1)]
    return pairs, values.reshape(len(pairs), -1)


def table_cards(name, groups):
    """DTI of the rows of a matrix. @param groups: type, number, count of rows and first row from 1 of each"""
    fields = ["TYPE", "ID", "COMP", "ROW"] + [str(number) for group in groups for number in group] + ["ENDREC"]
    return [f"DTI     {name:8s}{2:<8d}"] + [f"{'':8s}" + "".join(f"{field:8s}" for field in fields[k:k + 8]).rstrip() for k in range(0, len(fields), 8)]


def wide(name, *fields):
    """A card of fields of 16 characters: numbers of points, and reals."""
    texts = [wide_number(value) if isinstance(value, float) else f"{value} " for value in fields]
    lines = []
    for k in range(0, len(texts), 4):
        lines.append(f"{name + '*' if k == 0 else '*':8s}" + "".join(f"{text:>{WIDE}s}" for text in texts[k:k + 4]))
    return lines if len(lines) % 2 == 0 else lines + ["*"]


def narrow(name, numbers, first=None):
    """Cards of fields of 8 characters, as many as the numbers need."""
    count = 8 if first is None else 7
    return [f"{name:8s}" + ("" if first is None else f"{first:>8s}") + "".join(f"{number:8d}" for number in numbers[k:k + count])
            for k in range(0, len(numbers), count)]


def form_of(matrix):
    """Form of a matrix: symmetric up to rounding, or square."""
    matrix = scipy.sparse.csr_matrix(matrix)
    largest = abs(matrix).max() if matrix.nnz else 0.0
    return SYMMETRIC if not matrix.nnz or abs(matrix - matrix.T).max() <= ROUNDING * largest else SQUARE


def named_quantities(matrices):
    """Recovered quantities by the names of their matrices: comments with the names of their rows, and the quantity. Notes on them
    are added."""
    named = {}
    for k, (name, quantity) in enumerate(matrices.quantities.items(), 1):
        matrix = f"OTM{k}"
        named[matrix] = (comments_of(matrix, name, quantity), quantity)
        matrices.notes.append(f"the quantity '{name}' is the matrix {matrix}, whose rows comments name")
    return named


def left_out_of_deck(matrices):
    """Notes on members of a MatrixSet for which Nastran has no matrix."""
    parts = {"the inertia components": matrices.inertia_components, "the mass properties, which follow from the mass matrix": matrices.mass_properties}
    return [f"left out: {told}" for told, member in parts.items() if member is not None]
