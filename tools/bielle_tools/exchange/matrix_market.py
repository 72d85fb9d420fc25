"""Matrix Market files (.mtx) of the stiffness and the mass, with a table of the nodes.

`options.mass` names the file of the mass, `options.nodes` the nodes (node, x, y, z; a deck is possible),
`options.unknowns` the order of the rows (node, component); without it, all nodes have 3 or 6 unknowns in their order.
For ARM_stiffness.mtx the files ARM_mass.mtx, ARM_damping.mtx, ARM_nodes.csv and ARM_unknowns.csv need not be named.
(NIST, "Matrix Market Exchange Formats".)
"""

import io
import os

import scipy.io

from ..messages import InputError, counted
from ..text_lines import lines_of
from .axes import in_body_axes
from .job_files import first_line, node_table_text, stem, used_nodes
from .matrix_set import COMPONENTS, MatrixSet, sparse
from .node_table import read_nodes, read_unknowns, unknowns_in_order

FAULTS = (ValueError, TypeError, IndexError, OverflowError, KeyError, AttributeError, MemoryError, StopIteration,
          NotImplementedError, EOFError)
FORTRAN = str.maketrans("dD", "ee")  # exponents


def recognises(path):
    """Whether the file begins as Matrix Market files do."""
    return first_line(path).startswith("%%MatrixMarket")


def read(path, options):
    """@raises InputError"""
    table = options.nodes or _beside(path, "nodes", ".csv")
    if not table:
        raise InputError(f"'{path}': the positions of the nodes are missing: --nodes FILE names a table (node,x,y,z)")
    mass, damping = options.mass or _beside(path, "mass"), _beside(path, "damping")
    if not mass:
        raise InputError(f"'{path}': the file of the mass matrix is missing: --mass FILE names it")
    nodes, order = read_nodes(table), options.unknowns or _beside(path, "unknowns", ".csv")
    place, components = read_unknowns(order, nodes.numbers) if order else (None, None)
    most = max(6 * len(nodes.numbers), len(place) if order else 0)
    files = {"stiffness": path, "mass": mass} | ({"damping": damping} if damping else {})
    matrices = {name: _matrix(each, most) for name, each in files.items()}
    size = matrices["stiffness"].shape[0]
    for name, matrix in matrices.items():
        if matrix.shape[0] != size:
            raise InputError(f"'{path}': the stiffness has {counted(size, 'row')}, the {name} {matrix.shape[0]}")
    if not order:
        place, components = unknowns_in_order(nodes.path, len(nodes.numbers), size)
    elif len(place) != size:
        raise InputError(f"'{order}': has {counted(len(place), 'unknown')} for matrices of {counted(size, 'row')}")
    return MatrixSet(name=options.name or stem(path).removesuffix("_stiffness"), source=f"Matrix Market, {os.path.basename(path)}",
                     **matrices, **used_nodes(nodes, place), unknown_components=components)


def _beside(path, name, ending=None):
    """The file ARM_name.mtx next to ARM_stiffness.mtx, empty if there is none."""
    base, own = os.path.splitext(path)
    other = base.removesuffix("_stiffness") + f"_{name}" + (ending or own)
    return other if base.endswith("_stiffness") and os.path.exists(other) else ""


def _matrix(path, most):
    """A square matrix (scipy.sparse). @param most: rows; a damaged head could ask for any memory. @raises InputError"""
    texts = lines_of(path)
    if not texts[0].startswith("%%MatrixMarket"):
        raise InputError(f"{path}:1: expected %%MatrixMarket, found '{texts[0][:30]}'")
    body = [text for text in texts[1:] if text.strip() and not text.startswith("%")]
    if not body:  # mminfo would not terminate without a body
        raise InputError(f"'{path}': ends before the counts of rows and columns")
    content = (texts[0].strip() + "\n" + "\n".join(body).translate(FORTRAN) + "\n").encode("utf-8", "replace")
    try:
        rows, columns, entries, form, kind, _ = scipy.io.mminfo(io.BytesIO(content))
    except FAULTS as error:
        raise InputError(f"'{path}': the head of the file is damaged: {' '.join(str(error).split())[:80]}") from None
    if rows != columns or rows < 1 or kind not in ("real", "integer"):
        raise InputError(f"'{path}': expected a square matrix of real numbers, found {rows} x {columns}, {kind}")
    if rows > most:
        raise InputError(f"'{path}': has {counted(rows, 'row')}, but the nodes have {counted(most, 'unknown')} at most")
    count = sum(len(text.split()) for text in body[1:]) // (3 if form == "coordinate" else 1)
    if count != entries and form == "coordinate" or count < (rows * (rows - 1)) // 2 and form == "array":
        raise InputError(f"'{path}': the head tells {counted(entries, 'entry', 'entries')}, the file has {count}")
    try:
        return sparse(scipy.io.mmread(io.BytesIO(content)))
    except FAULTS as error:
        raise InputError(f"'{path}': the entries are damaged: {' '.join(str(error).split())[:80]}") from None


def write(matrices, path, options):
    """Writes FILE_stiffness.mtx, FILE_mass.mtx, FILE_nodes.csv and FILE_unknowns.csv for FILE.mtx. @returns their paths"""
    matrices = in_body_axes(matrices)
    base, ending = os.path.splitext(path)
    paths = []
    for name, matrix in matrices.matrices().items():
        paths.append(f"{base}_{name.replace(' ', '_')}{ending}")
        scipy.io.mmwrite(paths[-1], matrix.tocoo(), comment=f" {matrices.name}, of {matrices.source}", precision=17,
                         symmetry="general")
    paths += [base + "_nodes.csv", base + "_unknowns.csv"]
    with open(paths[-2], "w", encoding="utf-8") as file:
        file.write(node_table_text(matrices))
    with open(paths[-1], "w", encoding="utf-8") as file:
        file.write("node,component\n")
        for node, component in zip(matrices.unknown_nodes, matrices.unknown_components):
            file.write(f"0,{component + 1}\n" if node < 0 else f"{matrices.numbers[node]},{COMPONENTS[component]}\n")
    return paths
