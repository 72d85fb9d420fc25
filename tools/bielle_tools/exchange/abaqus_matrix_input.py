"""Assembled matrices of Abaqus' *MATRIX GENERATE as text, which *MATRIX INPUT and CalculiX' *MATRIX ASSEMBLE read.

JOB_STIF2.mtx holds the stiffness, JOB_MASS2.mtx the mass, JOB_DMPV2.mtx the viscous damping. A line is `node,
component, node, component, value`; one triangle is enough. With FORMAT=COORDINATE it is `row column value`: the
unknowns are those of the nodes in ascending order, or of a table (`options.unknowns`). Nodes with negative numbers are
Abaqus' own: Lagrange multipliers are refused.
"""

import os
import re

import numpy as np

from ..messages import InputError, counted
from ..text_lines import lines_of
from .axes import in_body_axes
from .entries import check_symmetric, matrix_of
from .job_files import beside, deck_of_nodes, stem, used_nodes
from .matrix_set import MatrixSet
from .node_table import places_of, read_nodes, read_unknowns, unknowns_in_order
from .text_tables import number_rows, whole

HELD = 1e36  # on the diagonal of an unknown that a boundary condition holds
KINDS = {"stiffness": "STIF", "mass": "MASS", "damping": "DMPV"}


def recognises(path):
    """Returns False: `abaqus_matrices` recognises all forms of Abaqus, and this name only chooses the form to be
    written."""
    return False


def read(path, options):
    """@raises InputError"""
    paths = _files(path, options)
    nodes = read_nodes(options.nodes or beside(re.sub(r"_STIF\d*(\.\w+)$", r"\1", path), (".inp", "_nodes.inp", ".csv")))
    entries = {name: _entries(each) for name, each in paths.items()}
    if "damping" in entries and not len(entries["damping"]):
        del entries["damping"]
    empty = next((name for name, found in entries.items() if not len(found)), None)
    if empty:
        raise InputError(f"'{paths[empty]}': holds no entries")
    widths = {found.shape[1] for found in entries.values()}
    if len(widths) > 1:
        raise InputError(f"'{path}': one file has rows and columns, the other nodes and components: generate both in "
                         "one form")
    labelled = widths == {5}
    read_all = _labelled if labelled else _numbered
    place, components, found = read_all(paths, entries, nodes, options)
    return MatrixSet(name=options.name or re.sub(r"_STIF\d*$", "", stem(path)), source=f"Abaqus matrices, {os.path.basename(path)}",
                     **used_nodes(nodes, place), unknown_components=components, **found)


def _files(path, options):
    """The files of the matrices, by name. @raises InputError if that of the mass is missing"""
    found = {"stiffness": path}
    for name in ("mass", "damping"):
        other = re.sub(r"_STIF(\d*\.\w+)$", rf"_{KINDS[name]}\1", path)
        if name == "mass" and options.mass:
            found[name] = options.mass
        elif other != path and os.path.exists(other):
            found[name] = other
        elif name == "mass":
            where = f" ('{other}')" if other != path else ""
            raise InputError(f"'{path}': the file of the mass matrix is missing{where}: --mass FILE names it")
    return found


def _entries(path):
    """Lines of 5 or 3 numbers."""
    texts = lines_of(path)
    first = next((text for text in texts if text.strip() and not text.lstrip().startswith("*")), "")
    delimiter = "," if "," in first else None
    count = 5 if len([word for word in first.split(delimiter) if word.strip()]) == 5 else 3
    return number_rows(path, texts, count, delimiter=delimiter, comment="*")


def _labelled(paths, entries, nodes, _):
    """Place and component of each unknown, and the matrices, from lines with nodes and components."""
    keys, found = {}, {}
    for name, table in entries.items():
        pairs = whole(paths[name], table[:, :4], "a node or component")
        wrong = (pairs[:, 1::2] < 1) | (pairs[:, 1::2] > 6)
        if wrong.any():
            row, side = np.argwhere(wrong)[0]
            raise InputError(f"'{paths[name]}': node {pairs[row, 2 * side]} has the component "
                             f"{pairs[row, 2 * side + 1]}; those of mechanics are 1 "
                             "to 6")
        keys[name] = 8 * pairs[:, 0::2] + pairs[:, 1::2]
    unknowns = np.unique(np.concatenate([each.ravel() for each in keys.values()]))
    if not len(unknowns):
        raise InputError(f"'{paths['stiffness']}': holds no entries")
    named = np.column_stack([unknowns // 8, unknowns % 8])
    for name, table in entries.items():
        rows, columns = np.searchsorted(unknowns, keys[name]).T
        found[name] = matrix_of(paths[name], rows, columns, table[:, 4], len(unknowns), named)
    unknowns = named
    place, components = places_of(paths["stiffness"], unknowns[:, 0], unknowns[:, 1] - 1, nodes)
    _check_free(paths["stiffness"], found["stiffness"], unknowns)
    return place, components, found


def _check_free(path, stiffness, unknowns):
    """@raises InputError for held unknowns and Lagrange multipliers"""
    diagonal = stiffness.diagonal()
    held = unknowns[np.abs(diagonal) >= HELD]
    if len(held):
        raise InputError(f"'{path}': {counted(len(held), 'unknown')} held by boundary conditions (node {held[0][0]}, "
                         f"component {held[0][1]}): "
                         "a superelement is a free body; generate the matrices without them")
    multipliers = unknowns[(unknowns[:, 0] < 0) & (diagonal == 0)]
    if len(multipliers):
        raise InputError(f"'{path}': node {multipliers[0][0]} is a Lagrange multiplier of Abaqus' (of a coupling, a "
                         "tie or a hybrid element): "
                         "matrices with multipliers are not read; generate a substructure")


def _numbered(paths, entries, nodes, options):
    """Place and component of each unknown, and the matrices, from lines with rows and columns counted from 1."""
    indices = {name: whole(paths[name], found[:, :2], "a row or column") - 1 for name, found in entries.items()}
    least = min(int(each.min(initial=0)) for each in indices.values())
    size = max(int(each.max(initial=-1)) for each in indices.values()) + 1
    if size == 0:
        raise InputError(f"'{paths['stiffness']}': holds no entries")
    if least < 0:
        raise InputError(f"'{paths['stiffness']}': rows and columns are counted from 1")
    if options.unknowns:
        place, components = read_unknowns(options.unknowns, nodes.numbers)
        if len(place) < size:
            raise InputError(f"'{options.unknowns}': has {counted(len(place), 'unknown')} for matrices of "
                             f"{counted(size, 'row')}")
    else:
        order = np.argsort(nodes.numbers)
        row, components = unknowns_in_order(nodes.path, len(order), size)
        place = order[row]
    found = {name: matrix_of(paths[name], *indices[name].T, entries[name][:, 2], len(place)) for name in entries}
    labels = np.where(place < 0, 0, nodes.numbers[place])
    _check_free(paths["stiffness"], found["stiffness"], np.column_stack([labels, components + 1]))
    return place, components, found


def write(matrices, path, options):
    """Writes FILE_STIF1.mtx, FILE_MASS1.mtx and FILE_nodes.inp for FILE.mtx. @returns their paths"""
    matrices = in_body_axes(matrices)
    check_symmetric(matrices)
    labels, deck = deck_of_nodes(matrices)
    components = np.where(matrices.unknown_nodes < 0, 1, matrices.unknown_components + 1)
    base, ending = os.path.splitext(path)
    paths = []
    for name, kind in KINDS.items():
        if getattr(matrices, name) is None or name == "damping" and not getattr(matrices, name).nnz:
            continue
        paths.append(f"{base}_{kind}1{ending}")
        entries = getattr(matrices, name).tocoo()
        with open(paths[-1], "w", encoding="utf-8") as file:
            kept = entries.row >= entries.col
            rows, columns = entries.row[kept], entries.col[kept]
            words = labels[rows], components[rows], labels[columns], components[columns], entries.data[kept]
            file.writelines("%d, %d, %d, %d, %.16e\n" % line for line in zip(*(each.tolist() for each in words)))
    paths.append(base + "_nodes.inp")
    with open(paths[-1], "w", encoding="utf-8") as file:
        file.write(deck)
    return paths
