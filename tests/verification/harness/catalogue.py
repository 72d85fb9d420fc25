"""The problem files of a folder, read without running them."""

import ast
import difflib
import os

FOLDER = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "problems")


class Entry:
    """A problem file and the words of its PROBLEM that are needed before it is run."""

    def __init__(self, path):
        self.path = os.path.abspath(path)
        self.name = os.path.splitext(os.path.basename(path))[0]
        self.words = {"title": self.name, "subject": "", "source": "", "model": "", "quick": False, "long": False}
        self.words.update(_words(path))

    def __getitem__(self, word):
        return self.words[word]


def _words(path):
    """Literal arguments of the call Problem(..) in a file; none if the file is no Python, which its run reports."""
    with open(path, "rb") as file:
        try:
            tree = ast.parse(file.read())
        except (SyntaxError, ValueError):
            return {}
    calls = [node for node in ast.walk(tree) if isinstance(node, ast.Call) and getattr(node.func, "id",
                                                                                       "") == "Problem"]
    return {each.arg: each.value.value for call in calls for each in call.keywords if isinstance(each.value,
                                                                                                 ast.Constant)}


def entries(folder):
    """All problems of a folder by name. @raises OSError"""
    names = sorted(name for name in os.listdir(folder)
                   if name.endswith(".py") and not name.startswith("_") and os.path.isfile(os.path.join(folder, name)))
    return [Entry(os.path.join(folder, name)) for name in names]


def chosen(known, names, quick):
    """The entries that are asked for, all without names; with `quick` those that take little time. @raises
    ValueError"""
    by_name = {entry.name: entry for entry in known}
    for name in names:
        if name not in by_name:
            near = difflib.get_close_matches(name, by_name, 1)
            raise ValueError(f"there is no problem '{name}'" +
                             (f"; did you mean '{near[0]}'?" if near else "; --list shows them"))
        if quick and not by_name[name]["quick"]:
            raise ValueError(f"'{name}' takes longer: leave out --quick")
    found = [by_name[name] for name in dict.fromkeys(names)] if names else known
    return [entry for entry in found if entry["quick"] or not quick]
