"""Writes a MatrixSet as DMIG cards with their points, as EXTSEOUT(DMIGPCH) of Nastran does."""

import scipy.sparse

from ..messages import counted
from .matrix_set import sparse
from .nastran_deck import SYMMETRIC, Numbering, form_of, left_out_of_deck, named_quantities, number_of, point_cards, shape_rows, wide_number
from .nastran_quantities import STRESS_AT_POINTS

NAMES = {"stiffness": "KAAX", "mass": "MAAX", "damping": "BAAX", "geometric_stiffness": "KDAAX"}
SHAPES, RECTANGULAR = "MUG1", 9
MOST_POINTS = 5000  # the shapes at more of them are left out


def write(matrices, path, _options=None):
    """@returns list of the path"""
    shapes = matrices.shapes
    if shapes is not None and len(shapes.points) > MOST_POINTS:
        matrices.notes.append(f"left out: the shapes at {len(shapes.points)} points, more than the {MOST_POINTS} that DMIG cards are written for")
        shapes = None
    numbering = Numbering(matrices, shapes)
    pairs, order = numbering.sorted_pairs(matrices)
    cards = _Cards()
    for member, name in NAMES.items():
        if getattr(matrices, member) is not None:
            cards.square(name, sparse(getattr(matrices, member))[order][:, order], pairs)
    if shapes is not None:
        rows, values = shape_rows(matrices, numbering, shapes)
        cards.rectangular(SHAPES, rows, values[:, order])
        if shapes.stress is not None:
            pairs_of_stress = [(int(number), component) for number in numbering.shapes[shapes.stress_points] for component in range(1, 7)]
            cards.rectangular(STRESS_AT_POINTS, pairs_of_stress, shapes.stress[:, order])
    for name, (told, quantity) in named_quantities(matrices).items():
        cards.lines += told
        cards.rectangular(name, [(k + 1, 0) for k in range(len(quantity.rows))], quantity.matrix[:, order])
    with open(path, "w", encoding="ascii", errors="replace") as file:
        told = matrices.name.replace("\n", " ")
        file.write(f"$ {told}: {counted(matrices.size, 'unknown')}\n" + "\n".join(point_cards(matrices, numbering, shapes) + cards.lines) + "\n")
    matrices.notes += numbering.notes + left_out_of_deck(matrices)
    matrices.notes.append(f"fields of 16 characters hold the numbers of the matrices to {cards.error:.1g} of each")
    return [path]


class _Cards:
    """Collects cards. error: the largest difference of a written number from the number, relative to it."""

    def __init__(self):
        self.lines, self.error = [], 0.0

    def square(self, name, matrix, pairs):
        form = form_of(matrix)
        self._header(name, form, "")
        self._columns(name, scipy.sparse.tril(matrix) if form == SYMMETRIC else matrix, pairs, pairs)

    def rectangular(self, name, pairs, values):
        self._header(name, RECTANGULAR, str(values.shape[1]))
        self._columns(name, values, pairs, [(k + 1, 0) for k in range(values.shape[1])], empty=True)

    def _header(self, name, form, count):
        self.lines.append(f"DMIG    {name:8s}{0:8d}{form:8d}{2:8d}{0:8d}{'':8s}{'':8s}{count:>8s}".rstrip())

    def _columns(self, name, matrix, rows, columns, empty=False):
        """@param empty: writes a card for columns without entries as well, so that a missing one tells that the file was cut off"""
        by_column = scipy.sparse.csc_matrix(matrix)
        by_column.sort_indices()
        for (point, component), begin, end in zip(columns, by_column.indptr, by_column.indptr[1:]):
            if begin < end or empty:
                self.lines.append(f"DMIG*   {name:16s}{point:15d}{component:16d}")
            for row, value in zip(by_column.indices[begin:end], by_column.data[begin:end]):
                text = wide_number(float(value))
                self.error = max(self.error, abs(number_of(text) / value - 1))
                self.lines.append(f"*       {rows[row][0]:15d}{rows[row][1]:16d} {text:>16s}")
