"""Writes IGES files of boxes along the axes.

Each box is a manifold solid (entity 186) between plane surfaces (Initial Graphics Exchange Specification 5.3, ANS US
PRO/IPO-100-1996).
"""

import itertools

UNITS = {"in": 1, "mm": 2, "m": 6}  # unit flags of the global section
FACES = [((axis, side), [(axis + 1) % 3, (axis + 2) % 3]) for axis in range(3) for side in (0, 1)]


class _File:
    """Entities as (type, form, whether others use it, parameters)."""

    def __init__(self):
        self.entities = []

    def add(self, kind, form, used, *parameters):
        """@returns the pointer to the entity"""
        self.entities.append((kind, form, used, parameters))
        return 2 * len(self.entities) - 1

    def text(self, unit):
        words = ["1H,", "1H;", "3Hbox", "7Hbox.igs", "6HBielle", "3H1.0", "32", "38", "7", "308", "15", "3Hbox", "1.0", str(UNITS[unit]),
                 f"{len(unit)}H{unit.upper()}", "1", "0.01", "15H20260101.000000", "1.0E-6", "1000.0", "4Hsome", "4Hbody", "11", "0", "15H20260101.000000"]
        directory, data = [], []
        for number, (kind, form, used, parameters) in enumerate(self.entities):
            pointer, lines = 2 * number + 1, _lines([str(kind), *(_word(each) for each in parameters)], 64)
            directory += ["".join(f"{field:>8}" for field in (kind, len(data) + 1, 0, 0, 0, 0, 0, 0, "00010000" if used else "00000000")),
                          "".join(f"{field:>8}" for field in (kind, 0, 0, len(lines), form, "", "", "", 0))]
            data += [f"{line:64} {pointer:7}" for line in lines]
        sections = {"S": ["Boxes"], "G": _lines(words, 72), "D": directory, "P": data}
        text = "".join(f"{line:72}{name}{number:7}\n" for name, lines in sections.items() for number, line in enumerate(lines, 1))
        counts = "".join(f"{name}{len(lines):7}" for name, lines in sections.items())
        return text + f"{counts:72}T{1:7}\n"


def _word(value):
    return repr(value) if isinstance(value, float) else str(value)


def _lines(words, width):
    """Returns lines of words with commas between them and a semicolon at the end."""
    lines = [""]
    for k, word in enumerate(words):
        word += ";" if k == len(words) - 1 else ","
        if len(lines[-1]) + len(word) > width:
            lines.append("")
        lines[-1] += word
    return lines


def _add_box(file, low, high):
    corners = list(itertools.product((0, 1), repeat=3))
    place = [[float((low, high)[bit][axis]) for axis, bit in enumerate(corner)] for corner in corners]
    vertices = file.add(502, 1, True, len(corners), *(x for point in place for x in point))
    edges = [(a, b) for a, b in itertools.combinations(range(8), 2) if sum(x != y for x, y in zip(corners[a], corners[b])) == 1]
    lines = [file.add(110, 0, True, *place[a], *place[b]) for a, b in edges]
    listed = file.add(504, 1, True, len(edges), *(word for line, (a, b) in zip(lines, edges)
                                                  for word in (line, vertices, a + 1, vertices, b + 1)))
    faces = []
    for (axis, side), (u, v) in FACES:
        # The ring is counterclockwise about the axis, and hence reversed about the outward normal at the low side.
        ring = [[0, 0], [1, 0], [1, 1], [0, 1]]
        ring = ring if side else ring[::-1]
        numbers = [next(k for k, corner in enumerate(corners) if (corner[axis], corner[u], corner[v]) == (side, *at)) for at in ring]
        words = []
        for a, b in zip(numbers, numbers[1:] + numbers[:1]):
            words += [0, listed, edges.index((min(a, b), max(a, b))) + 1, int(a < b), 0]
        loop = file.add(508, 1, True, 4, *words)
        normal = file.add(123, 0, True, *(float((1 if side else -1) * (k == axis)) for k in range(3)))
        plane = file.add(190, 0, True, file.add(116, 0, True, *place[numbers[0]], 0), normal)
        faces.append(file.add(510, 1, True, plane, 1, 1, loop))
    shell = file.add(514, 1, True, len(faces), *(word for face in faces for word in (face, 1)))
    file.add(186, 0, False, shell, 1, 0)


def iges_boxes(boxes, unit="mm"):
    """Returns the text of a file. @param boxes  pairs of opposite corners, the lower ones first"""
    file = _File()
    for low, high in boxes:
        _add_box(file, low, high)
    return file.text(unit)
