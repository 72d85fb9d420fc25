"""Matrix Market files (.mtx) of the stiffness and the mass, with a table of the nodes.

`options.mass` names the file of the mass (default: that with `stiffness` replaced by `mass` in its name, K by M at its end, or _K by _M),
`options.nodes` the nodes (node, x, y, z; a deck is possible), `options.unknowns` the order of the rows (node, component); without it, all
nodes have 3 or 6 unknowns in their order. (NIST, "Matrix Market Exchange Formats".)
"""

import io
import os
import re

import scipy.io

from ..messages import InputError, counted
from ..text_lines import lines_of
from .axes import in_body_axes
from .job_files import first_line, stem, used_nodes
from .matrix_set import COMPONENTS, MatrixSet, sparse
from .node_table import read_nodes, read_unknowns, unknowns_in_order

FAULTS = (ValueError, TypeError, IndexError, OverflowError, KeyError, AttributeError, MemoryError, StopIteration)
NAMES = ((r"stiffness(?=[^/]*$)", "mass"), (r"K(?=\.\w+$)", "M"), (r"k(?=\.\w+$)", "m"))


def recognises(path):
    """Whether the file begins as Matrix Market files do."""
    return first_line(path).startswith("%%MatrixMarket")


def read(path, options):
    """@raises InputError"""
    if not options.nodes:
        raise InputError(f"'{path}': the positions of the nodes are missing: --nodes FILE names a table (node,x,y,z)")
    stiffness, mass = _matrix(path), _matrix(options.mass or _mass_file(path))
    size = stiffness.shape[0]
    if mass.shape != stiffness.shape:
        raise InputError(f"'{path}': the stiffness has {counted(size, 'row')}, the mass {mass.shape[0]}")
    nodes = read_nodes(options.nodes)
    if options.unknowns:
        place, components = read_unknowns(options.unknowns, nodes.numbers)
    else:
        place, components = unknowns_in_order(nodes.path, len(nodes.numbers), size)
    if len(place) != size:
        raise InputError(f"'{options.unknowns}': has {counted(len(place), 'unknown')} for matrices of {counted(size, 'row')}")
    return MatrixSet(name=options.name or stem(path), source=f"Matrix Market, {os.path.basename(path)}", stiffness=stiffness, mass=mass,
                     **used_nodes(nodes, place), unknown_components=components)


def _mass_file(path):
    for pattern, replacement in NAMES:
        other = re.sub(pattern, replacement, path)
        if other != path and os.path.exists(other):
            return other
    raise InputError(f"'{path}': the file of the mass matrix is missing: --mass FILE names it")


def _matrix(path):
    """A square matrix (scipy.sparse). @raises InputError"""
    texts = lines_of(path)
    if not texts[0].startswith("%%MatrixMarket"):
        raise InputError(f"{path}:1: expected %%MatrixMarket, found '{texts[0][:30]}'")
    body = [text for text in texts[1:] if text.strip() and not text.startswith("%")]
    content = "\n".join([texts[0].strip(), *(re.sub("[dD]", "e", text) for text in body), ""]).encode("utf-8", "replace")
    try:
        rows, columns, entries, form, kind, _ = scipy.io.mminfo(io.BytesIO(content))
    except FAULTS as error:
        raise InputError(f"'{path}': the head of the file is damaged: {error}") from None
    if rows != columns or rows < 1 or kind not in ("real", "integer"):
        raise InputError(f"'{path}': expected a square matrix of real numbers, found {rows} x {columns}, {kind}")
    count = sum(len(text.split()) for text in body[1:]) // (3 if form == "coordinate" else 1)
    if count != entries and form == "coordinate" or count < (rows * (rows - 1)) // 2 and form == "array":
        raise InputError(f"'{path}': the head tells {counted(entries, 'entry', 'entries')}, the file has {count}")
    try:
        return sparse(scipy.io.mmread(io.BytesIO(content)))
    except FAULTS as error:
        raise InputError(f"'{path}': the entries are damaged: {error}") from None


def write(matrices, path, options):
    """Writes FILE_stiffness.mtx, FILE_mass.mtx, FILE_nodes.csv and FILE_unknowns.csv for FILE.mtx. @returns their paths"""
    matrices = in_body_axes(matrices)
    base, ending = os.path.splitext(path)
    paths = []
    for name, matrix in matrices.matrices().items():
        paths.append(f"{base}_{name.replace(' ', '_')}{ending}")
        scipy.io.mmwrite(paths[-1], matrix.tocoo(), comment=f" {matrices.name}, of {matrices.source}", precision=17, symmetry="general")
    paths += [base + "_nodes.csv", base + "_unknowns.csv"]
    with open(paths[-2], "w", encoding="utf-8") as file:
        file.write("node,x,y,z\n")
        file.writelines(f"{number},{x:.17g},{y:.17g},{z:.17g}\n" for number, (x, y, z) in zip(matrices.numbers, matrices.positions))
    with open(paths[-1], "w", encoding="utf-8") as file:
        file.write("node,component\n")
        for node, component in zip(matrices.unknown_nodes, matrices.unknown_components):
            file.write(f"0,{component + 1}\n" if node < 0 else f"{matrices.numbers[node]},{COMPONENTS[component]}\n")
    return paths
