"""Matrices of CalculiX: those of *FREQUENCY, SOLVER=MATRIXSTORAGE (JOB.sti, JOB.mas, JOB.dof), and substructures (.mtx).

A line of JOB.sti or JOB.mas is `row column value` of one triangle, one of JOB.dof is `node.component` of a row. Nodes
of solids come from JOB.inp; the internal modes of C3D8I, nodes above those of the deck, are condensed. Shells and beams
are expanded into solids: their nodes are those of JOB.frd, which another *FREQUENCY step before, with *NODE FILE,
OUTPUT=3D, writes. Unknowns that are held or depend on others are not in JOB.dof. (CalculiX, "*FREQUENCY".)
"""

import os

import numpy as np
import scipy.sparse

from ..messages import InputError, counted
from ..text_lines import lines_of
from .abaqus_matrices import read_substructure, write_substructure
from .deck_cells import blocks_of_results
from .entries import matrix_of
from .job_files import stem, used_nodes
from .matrix_set import MatrixSet, sparse
from .node_table import Nodes, places_of, read_nodes
from .text_tables import number_rows, whole


def read(path, options):
    """@raises InputError"""
    base, ending = os.path.splitext(path)
    if ending.lower() == ".mtx":
        return read_substructure(path, options, "CalculiX")
    labels, components = _unknowns(_other(path, ".dof"))
    size = len(labels)
    stiffness, mass = (_matrix(each, size) for each in (path, options.mass or _other(path, ".mas")))
    starts = np.flatnonzero((np.diff(labels, prepend=-1) != 0) | (np.diff(components, prepend=9) <= 0))
    notes = []
    if len(set(labels[starts])) == len(starts):
        nodes = read_nodes(options.nodes or _other(path, ".inp"))
        inner = labels > nodes.numbers.max()
        if inner.any() and len(labels) > len(nodes.numbers):
            stiffness, mass = _condensed(path, stiffness, mass, inner, labels)
            labels, components, starts = labels[~inner], components[~inner], starts[~inner[starts]]
            size = len(labels)
            notes.append("the internal modes of C3D8I are condensed, without their mass")
        place, components = places_of(base + ".dof", labels, components, nodes)
    else:
        nodes = _expanded(options.nodes if options.nodes.lower().endswith(".frd") else _other(path, ".frd"), base + ".dof", starts, size)
        place = np.repeat(np.arange(len(starts)), np.diff([*starts, size]))
        notes.append("shells and beams are expanded: nodes have the numbers and the 6 digits of the .frd file")
    short = np.count_nonzero(np.diff([*starts, size]) < 3)
    if short:
        notes.append(f"{counted(short, 'node')} with less than three unknowns: they are held, or depend on others")
    return MatrixSet(name=options.name or stem(path), source="CalculiX matrices, "
                                                             f"{os.path.basename(path)}", stiffness=stiffness, mass=mass,
                     **used_nodes(nodes, place), unknown_components=components, notes=notes)


def _condensed(path, stiffness, mass, inner, labels):
    """Stiffness and mass without the unknowns of the nodes that CalculiX gives each C3D8I: three each, which no other cell has.

    @raises InputError if the unknowns are none of these
    """
    outer, inside = np.flatnonzero(~inner), np.flatnonzero(inner)
    blocks = scipy.sparse.bsr_matrix(stiffness[inside][:, inside], blocksize=(9, 9)) if len(inside) % 9 == 0 else None
    if blocks is None or len(blocks.indices) != len(inside) // 9 or (blocks.indices != np.arange(len(blocks.indices))).any():
        raise InputError(f"'{path}': node {labels[inner][0]} has no position, and is none of the internal ones of "
                         "C3D8I: the deck is that of "
                         "another job")
    try:
        inverse = scipy.sparse.bsr_matrix((np.linalg.inv(blocks.data), blocks.indices, blocks.indptr), shape=blocks.shape)
    except np.linalg.LinAlgError:
        raise InputError(f"'{path}': the stiffness of internal modes is singular") from None
    coupling = stiffness[outer][:, inside]
    return sparse(stiffness[outer][:, outer] - coupling @ inverse @ coupling.T), mass[outer][:, outer]


def write(matrices, path, options):
    """Writes a substructure in the form of CalculiX, FILE.mtx, and FILE_nodes.inp. @returns their paths"""
    return write_substructure(matrices, path, single=True)


def _other(path, ending):
    """The file of the same job with another ending. @raises InputError if it is missing"""
    other = os.path.splitext(path)[0] + ending
    if not os.path.exists(other):
        raise InputError(f"'{path}': the file '{other}' of the same job is missing" + (
            ": a step *FREQUENCY with *NODE FILE, OUTPUT=3D before that with MATRIXSTORAGE writes "
            "it" if ending == ".frd" else ""))
    return other


def _unknowns(path):
    """Label of the node and component from 0 of each row."""
    labels, components = [], []
    for line, text in enumerate(lines_of(path), 1):
        if not text.strip():
            continue
        words = text.strip().split(".")
        if len(words) != 2 or not all(word.isdecimal() for word in words):
            raise InputError(f"{path}:{line}: expected node.component, found '{text.strip()}'")
        if words[1] not in "123456":
            raise InputError(f"{path}:{line}: node {words[0]} has the component {words[1]}; those of mechanics are 1 "
                             "to 6")
        labels.append(int(words[0]))
        components.append(int(words[1]) - 1)
    if not labels:
        raise InputError(f"'{path}': holds no unknowns")
    if max(labels) >= 2**31:
        raise InputError(f"'{path}': a node has the number {max(labels)}")
    return np.array(labels, np.int64), np.array(components, np.int64)


def _matrix(path, size):
    """@raises InputError if an entry is outside, or one of the diagonal missing, as in a truncated file"""
    entries = number_rows(path, lines_of(path), 3)
    places = whole(path, entries[:, :2], "a row or column") - 1
    if len(places) and not 0 <= places.min() <= places.max() < size:
        raise InputError(f"'{path}': has the rows and columns {places.min() + 1} to {places.max() + 1}, but the .dof "
                         "file has "
                         f"{counted(size, 'unknown')}")
    missing = np.setdiff1d(np.arange(size), places[places[:, 0] == places[:, 1], 0])
    if len(missing):
        raise InputError(f"'{path}': row {missing[0] + 1} has no entry on the diagonal: the file is truncated")
    return matrix_of(path, places[:, 0], places[:, 1], entries[:, 2], size)


def _expanded(path, dofs, starts, size):
    """The nodes of the solids into which CalculiX expands shells and beams, in the order of the unknowns."""
    numbers, positions, inside = [], [], False
    for line, text in enumerate(lines_of(path), 1):
        if text[:6] == "    2C":
            inside = True
        elif inside and text[:3] == " -3":
            break
        elif inside:
            try:
                numbers.append(int(text[3:13]))
                positions.append([float(text[13 + 12 * k:25 + 12 * k]) for k in range(3)])
            except ValueError:
                raise InputError(f"{path}:{line}: expected a node and its three coordinates, found "
                                 f"'{text.strip()}'") from None
    if len(numbers) != len(starts):
        raise InputError(f"'{dofs}': has unknowns of {counted(len(starts), 'node')}, but '{path}' has {len(numbers)}: "
                         "*NODE FILE needs "
                         "OUTPUT=3D, and no node may be held in all directions")
    order = np.argsort(numbers, kind="stable")
    return Nodes(path, np.array(numbers, np.int64)[order], np.array(positions)[order], blocks=blocks_of_results(path))
