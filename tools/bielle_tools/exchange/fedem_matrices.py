"""FEDEM's files of a reduced part: PART_S.fmx holds the stiffness, PART_M.fmx the mass (.fmx).

A file is a tag of 30 letters, a mark of the order of bytes, a checksum, the line `;1.0;` and all numbers of a square
matrix. It contains no nodes: they come from `options.nodes` or PART_nodes.csv, with 6 unknowns each in their order,
then amplitudes of modes; `options.unknowns` may name another order. (openfedem: src/vpmUtilities/binaryDB.c,
FFaLib/FFaOS/FFaTag.C, vpmReducer/reducer.f90.)
"""

import math
import os
import re
import struct

import numpy as np

from ..messages import InputError, counted
from .axes import in_body_axes
from .job_files import frames_first, node_table_text, stem, used_nodes
from .matrix_set import MatrixSet, sparse
from .node_table import read_nodes, read_unknowns

TAG, HEAD, VERSION = 30, 46, b";1.0;\n"
ENDIAN = 0x1234
KINDS = {"stiffness": ("S", "#FEDEM stiffness matrix"), "mass": ("M", "#FEDEM mass matrix")}
STIFFNESS = re.compile(r"_[SK](\.\w+)$")  # K: of FEDEM's library fmxWriter


def read(path, options):
    """@raises InputError"""
    base = STIFFNESS.sub("", path)
    files = {"stiffness": path, "mass": options.mass or STIFFNESS.sub(r"_M\1", path)}
    if files["mass"] == path:
        raise InputError(f"'{path}': the file of the mass matrix is missing: --mass FILE names it")
    table = options.nodes or (base + "_nodes.csv" if os.path.exists(base + "_nodes.csv") else "")
    if not table:
        raise InputError(f"'{path}': FEDEM's file has no nodes: --nodes FILE names a table of them (node,x,y,z) in "
                         "their order")
    matrices = {name: _matrix(each, KINDS[name][1]) for name, each in files.items()}
    size, nodes = matrices["stiffness"].shape[0], read_nodes(table)
    if matrices["mass"].shape[0] != size:
        raise InputError(f"'{path}': the stiffness has {counted(size, 'row')}, the mass {matrices['mass'].shape[0]}")
    count = len(nodes.numbers)
    if options.unknowns:
        place, components = read_unknowns(options.unknowns, nodes.numbers)
    else:
        modes = np.arange(max(size - 6 * count, 0))
        place = np.concatenate([np.repeat(np.arange(count), 6), np.full(len(modes), -1)])
        components = np.concatenate([np.tile(np.arange(6), count), modes])
    if len(place) != size:
        raise InputError(f"'{path}': {counted(size, 'row')} do not fit the {counted(len(place), 'unknown')} of "
                         f"'{options.unknowns or table}'")
    return MatrixSet(name=options.name or stem(base), source="FEDEM reduced part, "
                                                             f"{os.path.basename(path)}", **matrices,
                     **used_nodes(nodes, place), unknown_components=components)


def _matrix(path, tag):
    """@raises InputError for another tag, version or length"""
    try:
        with open(path, "rb") as file:
            content = file.read()
    except OSError as error:
        raise InputError(f"cannot read '{path}': {error.strerror}") from None
    found = content[:TAG].decode("ascii", "replace").rstrip()
    if found != tag:
        raise InputError(f"'{path}': expected FEDEM's tag '{tag}', found {ascii(found)}")
    order = next((each for each in "<>" if content[TAG:TAG + 2] == struct.pack(each + "H", ENDIAN)), None)
    if order is None or content[HEAD - len(VERSION):HEAD] != VERSION:
        raise InputError(f"'{path}': the head is damaged, or of another version than 1.0")
    count = (len(content) - HEAD) // 8
    size = math.isqrt(max(count, 0))
    if not count or size * size != count or (len(content) - HEAD) % 8:
        raise InputError(f"'{path}': holds {len(content) - HEAD} bytes of numbers, which are no square matrix")
    return sparse(np.frombuffer(content, order + "f8", offset=HEAD).reshape(size, size).T.astype(float))


def write(matrices, path, options):
    """Writes PART_S.fmx, PART_M.fmx and PART_nodes.csv for PART.fmx. @returns their paths. @raises InputError when a node lacks some of its
    six unknowns"""
    body = in_body_axes(matrices)
    order = frames_first(body, "FEDEM")
    base, paths = os.path.splitext(path)[0], []
    for name, (letter, tag) in KINDS.items():
        paths.append(f"{base}_{letter}.fmx")
        with open(paths[-1], "wb") as file:
            file.write(tag.encode().ljust(TAG) + struct.pack("=HII", ENDIAN, 0, 0) + VERSION)
            file.write(getattr(body, name).toarray()[np.ix_(order, order)].T.astype("=f8").tobytes())
    paths.append(base + "_nodes.csv")
    with open(paths[-1], "w", encoding="utf-8") as file:
        file.write(node_table_text(body))
    return paths
