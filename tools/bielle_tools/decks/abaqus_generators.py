"""Keywords of Abaqus and CalculiX that generate nodes and elements from those before them.

*NGEN, *NFILL, *NCOPY, *ELGEN and *ELCOPY follow the Abaqus Keywords Guide and the Analysis Guide, "Node definition" and
"Element definition". Forms that these do not define completely are refused by name. A generated node whose number exists
must stand in the same place.
"""

import numpy as np

from ..mesh.cells import CELLS
from ..messages import InputError
from .abaqus_lines import integer, number, numbers
from .abaqus_systems import kind_of_coordinates, motion, of_cylinder, reflection, rotation

EQUAL_RADII = 1e-6  # relative difference of the two radii of an arc, which are given to as many digits as nodes
MOST = 10**8        # nodes or elements of one keyword


def generate(reader, keyword):
    """@param reader: the nodes, elements and sets before the keyword, to which it adds. @raises InputError with the line."""
    _GENERATORS[keyword.name](reader, keyword)


def _fail(keyword, text, row=None):
    where = keyword.where if row is None else "{}:{}".format(*keyword.places[row])
    raise InputError(f"{where}: *{keyword.name}: {text}")


def _check_options(keyword, known, required=()):
    for name in keyword.options:
        if name and name not in known:
            _fail(keyword, f"the option {name} is not read (it reads {', '.join(known)}): write the mesh out in full")
    for name in required:
        if name not in keyword.options:
            _fail(keyword, f"{name}=... is missing")


def _count(keyword, row, name, word, least=1):
    """A number of intervals, elements or rows; 1 if it is left out."""
    value = integer(word) if word else 1
    if not least <= value <= MOST:
        _fail(keyword, f"expected {name} of {least} or more, found {value}", row)
    return value


def _ngen(reader, keyword):
    _check_options(keyword, ("NSET", "LINE", "SYSTEM"))
    line = keyword.options.get("LINE", "").upper()
    if line not in ("", "P", "C"):
        _fail(keyword, f"expected LINE=P, a parabola, or LINE=C, a circular arc, found LINE={line}")
    cylindrical, members = kind_of_coordinates(keyword, "RC"), []
    for row, words in enumerate(keyword.table(lambda words: [*words, *[""] * (10 - len(words))])):
        first, last = (integer(word) for word in words[:2])
        step = integer(words[2]) if words[2] else 1
        if step == 0 or (last - first) % step or (last - first) // step < 1:
            _fail(keyword, f"no nodes lie between {first} and {last} in steps of {step}", row)
        count = (last - first) // step
        if count > MOST:
            _fail(keyword, f"{count} nodes are too many", row)
        ends = [reader.place(keyword.places[row], each) for each in (first, last)]
        s = np.arange(1, count)[:, None] / count
        if not line:
            points = ends[0] + s * (ends[1] - ends[0])
        else:
            middle = _extra_point(reader, keyword, row, words[3:7], cylindrical)
            points = _parabola(ends, middle, s) if line == "P" else _arc(keyword, row, ends, middle, words[7:10], s)
        reader.add_nodes(keyword.places[row], [first + k * step for k in range(1, count)], points)
        members += [first + k * step for k in range(count + 1)]
    if "NSET" in keyword.options:
        reader.extend("NSET", keyword.options["NSET"], members)


def _extra_point(reader, keyword, row, words, cylindrical):
    if words[0] and not any(words[1:]):
        return reader.place(keyword.places[row], integer(words[0]))
    if not any(words[1:]):
        _fail(keyword, f"LINE={keyword.options['LINE']} needs the node or the coordinates of an extra point", row)
    if reader.system:
        _fail(keyword, "the coordinates of the extra point stand in the coordinates of *SYSTEM; give the number of a node", row)
    x = [number(word) if word else 0.0 for word in words[1:]]
    return np.array(of_cylinder(x) if cylindrical else x)


def _parabola(ends, middle, s):
    """Points of the parabola through both ends and the middle, at equal steps of its parameter."""
    return (1 - s) * (1 - 2 * s) * ends[0] + 4 * s * (1 - s) * middle + s * (2 * s - 1) * ends[1]


def _arc(keyword, row, ends, centre, words, s):
    """Points of an arc at equal angles: the shorter one, or the one that turns right-handed about a given normal."""
    a, b = ends[0] - centre, ends[1] - centre
    radii = np.linalg.norm(a), np.linalg.norm(b)
    if min(radii) == 0 or abs(radii[0] - radii[1]) > EQUAL_RADII * max(radii):
        _fail(keyword, f"the ends of the arc stand at the distances {radii[0]:.9g} and {radii[1]:.9g} from its centre", row)
    normal = np.cross(a, b)
    if any(words):
        given = np.array([number(word) if word else 0.0 for word in words])
        given = given / (np.linalg.norm(given) or 1.0)
        if not given.any() or max(abs(given @ a), abs(given @ b)) > EQUAL_RADII * max(radii):
            _fail(keyword, "the normal of the arc is not normal to its radii", row)
        angle = np.arctan2(normal @ given, a @ b) % (2 * np.pi)
        angle, normal = angle if angle > EQUAL_RADII else 2 * np.pi, given  # ends in one place: a full circle
    elif np.linalg.norm(normal) <= EQUAL_RADII * radii[0] * radii[1]:
        _fail(keyword, "an arc of 180 degrees or more needs a normal (entries 8 to 10)", row)
    else:
        angle = np.arctan2(np.linalg.norm(normal), a @ b)
    return centre + np.array([rotation(normal, angle * each) @ a for each in s[:, 0]]).reshape(-1, 3)


def _nfill(reader, keyword):
    _check_options(keyword, ("NSET", "BIAS", "TWO STEP"))
    bias, members = number(keyword.options.get("BIAS", "1")), []
    if not bias > 0:
        _fail(keyword, f"expected a BIAS, the ratio of successive distances, of more than 0, found {keyword.options['BIAS']}")
    for row, words in enumerate(keyword.table(lambda words: [*words, *[""] * (4 - len(words))])):
        bounds = [[integer(word)] if word.lstrip("+").isdigit() else reader.members("NSET", word, keyword.places[row]) for word in words[:2]]
        count = _count(keyword, row, "a number of intervals", words[2])
        step = integer(words[3]) if words[3] else 1
        if len(bounds[0]) != len(bounds[1]):
            reader.notes.append("{}:{}: *NFILL: the bounds have {} and {} nodes: the last ones of the longer are not joined, as in Abaqus"
                                .format(*keyword.places[row], len(bounds[0]), len(bounds[1])))
        s = _fractions(keyword, row, count, bias)[:, None]
        for first, last in zip(*bounds):
            a, b = (reader.place(keyword.places[row], each) for each in (first, last))
            labels = [first + k * step for k in range(1, count)]
            reader.add_nodes(keyword.places[row], labels, a + s * (b - a))
            members += [first, *labels, last]
    if "NSET" in keyword.options:
        reader.extend("NSET", keyword.options["NSET"], members)


def _fractions(keyword, row, count, bias):
    """Places of the new nodes between 0 and 1. The bias is the ratio of a distance to the next one from the first bound on."""
    if "TWO STEP" in keyword.options:
        if count % 2:
            _fail(keyword, f"TWO STEP needs an even number of intervals, found {count}", row)
        ends = np.concatenate([[0], np.cumsum(bias ** -np.arange(count // 2))])
        ends = np.stack([ends[:-1], (ends[:-1] + ends[1:]) / 2], axis=1).ravel()[1:] / ends[-1]
        return ends
    ends = np.cumsum(bias ** -np.arange(count))
    return ends[:-1] / ends[-1]


def _ncopy(reader, keyword):
    _check_options(keyword, ("CHANGE NUMBER", "OLD SET", "NEW SET", "SHIFT", "REFLECT", "POLE"), ("CHANGE NUMBER", "OLD SET"))
    kinds = [name for name in ("SHIFT", "REFLECT", "POLE") if name in keyword.options]
    if len(kinds) != 1:
        _fail(keyword, "expected one of SHIFT, REFLECT and POLE")
    if reader.system:
        _fail(keyword, "it stands in the coordinates of *SYSTEM; end these by an empty *SYSTEM")
    old = reader.members("NSET", keyword.options["OLD SET"], (keyword.path, keyword.line))
    if kinds[0] == "POLE":
        turn, shift = 2 * np.eye(3), -_pole(reader, keyword)
    else:
        turn, shift = motion(keyword) if kinds[0] == "SHIFT" else reflection(keyword)
    points = np.array([reader.place((keyword.path, keyword.line), label) for label in old]).reshape(-1, 3) @ turn.T + shift
    labels = [label + integer(keyword.options["CHANGE NUMBER"]) for label in old]
    reader.add_nodes((keyword.path, keyword.line), labels, points)
    if "NEW SET" in keyword.options:
        reader.extend("NSET", keyword.options["NEW SET"], labels)


def _pole(reader, keyword):
    if len(keyword.rows) != 1:
        _fail(keyword, "POLE needs one line: the number of a node, or a comma and three coordinates")
    words = keyword.table(lambda words: [*words, *[""] * (4 - len(words))])[0]
    if any(words[1:]):
        return np.array(numbers(words[1:4], 3))
    return reader.place(keyword.places[0], integer(words[0]))


def _elgen(reader, keyword):
    _check_options(keyword, ("ELSET", "ALL NODES"))
    members = []
    for row, words in enumerate(keyword.table(lambda words: [*words, *[""] * (10 - len(words))])):
        master = integer(words[0])
        counts = [_count(keyword, row, f"a number of {name}", word) for name, word in
                  zip(("elements", "rows", "layers"), (words[1], words[4], words[7]))]
        if np.prod([float(count) for count in counts]) > MOST:
            _fail(keyword, "too many elements", row)
        steps = [[integer(word) if word else 1 for word in each]
                 for each in ((words[2], words[5], words[8]), (words[3], words[6], words[9]))]
        of_nodes, of_elements = (sum(np.arange(count).reshape([-1 if k == axis else 1 for k in range(3)]) * step
                                     for axis, (count, step) in enumerate(zip(counts, each))).ravel() for each in steps)
        kind, nodes = reader.element(keyword.places[row], master)
        reader.add_elements(keyword.places[row], kind, master + of_elements[1:], nodes + of_nodes[1:, None])
        members += (master + of_elements).tolist()
    if "ELSET" in keyword.options:
        reader.extend("ELSET", keyword.options["ELSET"], members)


def _elcopy(reader, keyword):
    _check_options(keyword, ("ELEMENT SHIFT", "OLD SET", "SHIFT NODES", "NEW SET"), ("ELEMENT SHIFT", "OLD SET", "SHIFT NODES"))
    shifts = [integer(keyword.options[name]) for name in ("ELEMENT SHIFT", "SHIFT NODES")]
    old = reader.members("ELSET", keyword.options["OLD SET"], (keyword.path, keyword.line))
    by_kind = {}
    for label in old:
        kind, nodes = reader.element((keyword.path, keyword.line), label)
        by_kind.setdefault(kind, []).append((label, nodes))
    for kind, found in by_kind.items():
        reader.add_elements((keyword.path, keyword.line), kind, np.array([label for label, _ in found]) + shifts[0],
                            np.array([nodes for _, nodes in found]).reshape(-1, CELLS[kind].nodes) + shifts[1])
    if "NEW SET" in keyword.options:
        reader.extend("ELSET", keyword.options["NEW SET"], [label + shifts[0] for label in old])


_GENERATORS = {"NGEN": _ngen, "NFILL": _nfill, "NCOPY": _ncopy, "ELGEN": _elgen, "ELCOPY": _elcopy}
NAMES = tuple(_GENERATORS)
