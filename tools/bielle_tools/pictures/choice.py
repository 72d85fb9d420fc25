"""The choice of the parts of a scene that are hidden."""

import fnmatch

from ..messages import InputError, did_you_mean


def hidden_parts(patterns, parts):
    """A function that tells whether a part is hidden. A pattern (with * and ?) matches the entry (`joints/main`), its name
    (`main`), its type (`hinge`) or its group (`joint`). @raises InputError for a pattern that matches none of the parts"""
    words = {word for part in parts for word in _words(part)}
    for pattern in patterns:
        if not fnmatch.filter(words, pattern):
            raise InputError(f"--hide '{pattern}': nothing of this name is drawn{did_you_mean(pattern, sorted(words))}")

    def hidden(part):
        return any(fnmatch.fnmatchcase(word, pattern) for word in _words(part) for pattern in patterns)

    return hidden


def _words(part):
    return part.entry, part.entry.partition("/")[2] or part.entry, part.type, part.group
