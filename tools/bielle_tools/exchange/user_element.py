"""Linear user elements of Abaqus: the form in which Abaqus and CalculiX write the matrices of a substructure.

    *USER ELEMENT, NODES=2, LINEAR
    ** ELEMENT NODES
    **  7,  9
     1, 2, 3
     2, 1, 2, 3, 4, 5, 6
    *MATRIX, TYPE=STIFFNESS
    ...

The first line of data lists the components of the first node; a line `k, ..` those of the k-th node and the following
ones. A matrix is its lower triangle row by row, each row on lines of its own; with UNSYMM all columns. CalculiX lists a
node once for each of its unknowns. (Abaqus Keywords Guide, "*USER ELEMENT", "*MATRIX"; CalculiX, "Substructure
generation".)
"""

import re
from dataclasses import dataclass, field

import numpy as np

from ..decks.abaqus_lines import read_keywords
from ..messages import InputError, counted, did_you_mean
from ..text_lines import lines_of
from .entries import packed_matrix, packed_triangle
from .matrix_set import sparse
from .text_tables import number_list

TYPES = {"STIFFNESS": "stiffness", "MASS": "mass", "VISCOUS DAMPING": "damping"}
ON_A_LINE = 4  # numbers


@dataclass
class UserElement:
    """Labels of nodes and components from 0 of the unknowns, and the matrices by name."""

    labels: np.ndarray
    components: np.ndarray
    matrices: dict = field(default_factory=dict)
    notes: list = field(default_factory=list)


def read_user_element(path):
    """@raises InputError"""
    keywords = read_keywords(path)
    heads = [keyword for keyword in keywords if keyword.name == "USER ELEMENT"]
    if len(heads) != 1:
        raise InputError(f"'{path}': expected one *USER ELEMENT, found {len(heads)}")
    nodes = _nodes(path, keywords, heads[0])
    components = _components(heads[0], len(nodes))
    element = UserElement(np.repeat(nodes, [len(each) for each in components]), np.concatenate(components))
    for keyword in keywords:
        if keyword.name != "MATRIX":
            continue
        kind = re.sub(r"\s+", " ", keyword.options.get("TYPE", "")).upper()
        if kind == "STRUCTURAL DAMPING":
            element.notes.append("the structural damping is left out: it is not viscous")
            continue
        if kind not in TYPES:
            raise InputError(f"{keyword.where}: *MATRIX: there is no TYPE '{kind}'{did_you_mean(kind, list(TYPES))}")
        if TYPES[kind] in element.matrices:
            raise InputError(f"{keyword.where}: there is a second *MATRIX, TYPE={kind}")
        element.matrices[TYPES[kind]] = _matrix(path, keyword, len(element.labels), "UNSYMM" in heads[0].options)
    return element


def _nodes(path, keywords, head):
    """Labels of the element's nodes: those of the comment below the head, or of an *ELEMENT in the file."""
    count = _integer(head, head.options.get("NODES", ""), "NODES=")
    texts, found = lines_of(path), []
    for text in texts[head.line:]:
        words = [word for word in re.split(r"[,\s]+", text.lstrip("* ").strip()) if word]
        if not text.startswith("**"):
            break
        if words and all(re.fullmatch(r"[+-]?\d+", word) for word in words):
            found += [int(word) for word in words]
    for keyword in keywords:
        if keyword.name == "ELEMENT" and not found:
            found = [int(word) for word in number_list(path, keyword.rows, keyword.line)][1:]
    if len(found) != count:
        raise InputError(f"{head.where}: *USER ELEMENT has NODES={count}, but {counted(len(found), 'node')} are "
                         "listed below it"
                         if found else f"{head.where}: the nodes of the element are not listed (** ELEMENT NODES, or "
                                       "*ELEMENT)")
    return np.array(found, np.int64)


def _components(head, count):
    """Components from 0 of each of the element's nodes."""
    found = []
    for (path, line), row in zip(head.places, head.rows):
        words = [word.strip() for word in row.split(",") if word.strip()]
        numbers = [_integer(head, word, f"{path}:{line}: ") for word in words]
        position = 1 if not found else numbers.pop(0)
        if not len(found) < position <= count or not numbers or not all(1 <= each <= 6 for each in numbers):
            raise InputError(f"{path}:{line}: *USER ELEMENT: expected the position of a node and components from 1 to "
                             f"6, found '{row}'")
        found += [found[-1]] * (position - 1 - len(found)) if found else []
        found.append(np.array(numbers, np.int64) - 1)
    if not found:
        raise InputError(f"{head.where}: *USER ELEMENT has no line with components")
    return found + [found[-1]] * (count - len(found))


def _integer(head, word, what):
    try:
        return int(word)
    except ValueError:
        raise InputError(f"{head.where}: *USER ELEMENT: {what} expected an integer, found '{word}'") from None


def _matrix(path, keyword, size, full):
    first = keyword.places[0][1] if keyword.places else keyword.line
    values = number_list(path, keyword.rows, first)
    what = f"*MATRIX, TYPE={keyword.options['TYPE']}"
    if not full:
        return packed_matrix(path, values, size, what)
    if len(values) != size * size:
        raise InputError(f"'{path}': {what} has {counted(len(values), 'number')}, but {size} rows have {size * size}")
    return sparse(values.reshape(size, size).T)


def write_user_element(file, element, single=False):
    """Writes a UserElement, whose matrices are symmetric. @param single: one unknown for each listed node, as CalculiX does"""
    starts = range(len(element.labels)) if single else [0, *(np.flatnonzero(np.diff(element.labels)) + 1)]
    ends = [*list(starts)[1:], len(element.labels)]
    file.write(f"*USER ELEMENT, NODES={len(starts)}, LINEAR\n** ELEMENT NODES\n")
    nodes = [str(element.labels[start]) for start in starts]
    for begin in range(0, len(nodes), 10):
        file.write("** " + ", ".join(nodes[begin:begin + 10]) + "\n")
    before = None
    for position, (start, end) in enumerate(zip(starts, ends), 1):
        components = ", ".join(str(each + 1) for each in element.components[start:end])
        if components != before:
            file.write((f"{position}, " if position > 1 else "") + components + "\n")
        before = components
    for kind, name in TYPES.items():
        if element.matrices.get(name) is not None:
            file.write(f"*MATRIX, TYPE={kind}\n")
            for row in packed_triangle(element.matrices[name]):
                for begin in range(0, len(row), ON_A_LINE):
                    file.write(", ".join(f"{value:.16e}" for value in row[begin:begin + ON_A_LINE]) + ",\n")
