"""The groups of MBDyn's file of a modal joint (.fem): their numbers, one group after another.

A group begins with the line `** RECORD GROUP n`; other lines that begin with `**` are comments. (MBDyn Input Manual,
"FEM File Format".)
"""

import re

import numpy as np

from ..decks.abaqus_lines import number
from ..messages import InputError, counted
from ..text_lines import lines_of

GROUP = re.compile(r"\*\*\s*RECORD\s+GROUP\s+(\d+)", re.IGNORECASE)
NEEDED = (1, 2, 5, 6, 7, 8, 9, 10)
KNOWN = range(1, 20)


class ModalFile:
    """Words of each group with their lines."""

    def __init__(self, path):
        """@raises InputError for a group that is unknown, missing or there twice, and for a wrong head"""
        self.path, self.groups = path, {}
        group = None
        for line, text in enumerate(lines_of(path), 1):
            head = GROUP.match(text)
            if head:
                group = int(head[1])
                if group in self.groups or group not in KNOWN:
                    raise InputError(f"{path}:{line}: there is {'a second' if group in self.groups else 'no'} RECORD "
                                     f"GROUP {group}")
                self.groups[group] = []
            elif group and not text.startswith("**"):
                self.groups[group] += [(line, word) for word in text.split()]
        for needed in NEEDED:
            if needed not in self.groups:
                raise InputError(f"'{path}': RECORD GROUP {needed} is missing" + (": this is no file of a modal joint" if needed == 1 else ""))
        self.nodes, self.modes, self.rejected = self._head()

    def _head(self):
        """Counts of nodes, of modes and of rejected modes."""
        words = self.groups[1]
        try:
            nodes, normal, attached, constraint, rejected = (int(word) for _, word in words[1:6])
        except ValueError:
            raise InputError(f"'{self.path}': RECORD GROUP 1: expected a revision and five counts, found "
                             f"'{' '.join(word for _, word in words[:6])}'") from None
        modes = normal + attached + constraint - rejected
        if min(nodes, modes) < 1 or rejected < 0:
            raise InputError(f"'{self.path}': RECORD GROUP 1: {counted(nodes, 'node')} and {counted(modes, 'mode')}")
        return nodes, modes, rejected

    def words(self, group, count):
        """@raises InputError unless the group has so many"""
        found = self.groups[group]
        if len(found) != count:
            raise InputError(f"'{self.path}': RECORD GROUP {group} has {counted(len(found), 'number')}, but {count} "
                             "are expected for "
                             f"{counted(self.nodes, 'node')} and {counted(self.modes, 'mode')}")
        return found

    def array(self, group, *shape):
        """Numbers of a group. @raises InputError with the line"""
        values = []
        for line, word in self.words(group, int(np.prod([int(each) for each in shape], dtype=object))):
            try:
                values.append(number(word))
            except ValueError as error:
                raise InputError(f"{self.path}:{line}: {error}") from None
        values = np.array(values)
        if not np.isfinite(values).all():
            raise InputError(f"'{self.path}': RECORD GROUP {group} holds numbers that are not finite")
        return values.reshape(shape)

    def has(self, *groups):
        """Whether all these groups are there."""
        return all(group in self.groups for group in groups)


def write_groups(path, name, numbers, groups):
    """Writes a file. @param name: of the body; numbers: of the nodes; groups: {group: (title, array)}, shapes of group 8: (m,p,6)"""
    modes = len(groups[8][1])
    with open(path, "w", encoding="utf-8") as file:
        file.write(f"** {name}\n**\n** RECORD GROUP 1, HEADER\n**   REVISION, NODES, NORMAL, ATTACHMENT, CONSTRAINT, "
                   "REJECTED MODES.\n"
                   f"   REV0 {len(numbers)} {modes} 0 0 0\n**\n** RECORD GROUP 2, FINITE ELEMENT NODE LIST\n")
        for begin in range(0, len(numbers), 6):
            file.write(" ".join(map(str, numbers[begin:begin + 6])) + "\n")
        for group, (title, array) in sorted(groups.items()):
            file.write(f"**\n** RECORD GROUP {group}, {title}\n")
            if group != 8:
                _write_rows(file, array)
                continue
            for mode, shape in enumerate(array, 1):
                file.write(f"**    NORMAL MODE SHAPE # {mode}\n")
                _write_rows(file, shape)


def _write_rows(file, array):
    for row in array:
        file.write(" ".join(f"{value:.16e}" for value in np.ravel(row)) + "\n")
