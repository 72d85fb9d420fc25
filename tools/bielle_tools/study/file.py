"""The file of a study: model, values, gathered numbers and figures.

    model: rotor.yaml                       # names of files are relative to this one
    set: {height: 1.2}                      # the same in all runs
    grid:                                   # all combinations; the last varies fastest
      stiffness: [1e5, "2e5*pi"]            # values, as they are to be written behind --set
      speed: {from: 0, to: 300, count: 31}  # or step: 10; or spacing: log; or "0:300:31"
    table: runs.csv                         # or a list of {name: value}; each of its rows with all of the grid
    keep: [joints, eigen]
    gather:
      first: eigen/frequency[1]
      peak: max joints/main/coordinate[1]
    draw: [peak over speed by stiffness]
"""

import os

import yaml

from ..messages import InputError, did_you_mean
from .values import combined, grid, read_table, spaced, stepped, values_of

KEYS = ["model", "set", "grid", "table", "keep", "gather", "draw"]


class StudyFile:
    """names, rows: texts, no rows where it gives none; model: path or None; keep, draw: lists or None; gather: [(name, words)]"""

    def __init__(self, path):
        self.path = path
        self.folder = os.path.dirname(path)
        self.tables = []  # files of tables that it names
        top = self._map(_compose(path), "the file of a study")
        for key, (line, _) in top.items():
            if key not in KEYS:
                raise InputError(f"{path}:{line}: '{key}' is not a key of a study{did_you_mean(key, KEYS)}")
        self.model = self._beside(self._text(top["model"], "model")) if "model" in top else None
        self.names, self.rows = self._values(top)
        self.keep = self._texts(top["keep"], "keep") if "keep" in top else None
        self.draw = self._texts(top["draw"], "draw") if "draw" in top else None
        self.gather = [(name, self._text(entry, f"gather.{name}"))
                       for name, entry in (self._map(top["gather"], "gather") if "gather" in top else {}).items()]

    def _values(self, top):
        """The table, the grid and the set values, in this order."""
        names, rows = self._table(top["table"]) if "table" in top else ([], [[]])
        axes = {name: self._axis(name, entry) for name, entry in (self._map(top["grid"], "grid") if "grid" in top else {}).items()}
        same = {name: [self._text(entry, f"set.{name}")] for name, entry in (self._map(top["set"], "set") if "set" in top else {}).items()}
        for more in (same, axes):
            if more:
                line = top["grid" if more is axes else "set"][0]
                try:
                    names, rows = combined((names, rows), grid(more))
                except InputError as error:
                    raise InputError(f"{self.path}:{line}: {error}") from None
        return names, rows if names else []

    def _axis(self, name, entry):
        line, node = entry
        where = f"{self.path}:{line}: grid.{name}"
        if isinstance(node, yaml.SequenceNode):
            return self._texts(entry, f"grid.{name}")
        if isinstance(node, yaml.ScalarNode):
            return values_of(self._text(entry, f"grid.{name}"), where)
        keys = {key: self._text(value, f"grid.{name}.{key}") for key, value in self._map(entry, f"grid.{name}").items()}
        for key in keys:
            if key not in ("from", "to", "count", "step", "spacing"):
                raise InputError(f"{where}: '{key}' is not a key of a range{did_you_mean(key, ['from', 'to', 'count', 'step', 'spacing'])}")
        if "from" not in keys or "to" not in keys or ("count" in keys) == ("step" in keys):
            raise InputError(f"{where}: a range has 'from', 'to', and either 'count' or 'step'")
        spacing = keys.get("spacing", "linear")
        if spacing not in ("linear", "log") or ("step" in keys and spacing == "log"):
            raise InputError(f"{where}: 'spacing' is linear, or log with a 'count'; found '{spacing}'")
        if "step" in keys:
            return stepped(keys["from"], keys["to"], keys["step"], where)
        return spaced(keys["from"], keys["to"], keys["count"], spacing == "log", where)

    def _table(self, entry):
        line, node = entry
        if isinstance(node, yaml.ScalarNode):
            self.tables.append(self._beside(self._text(entry, "table")))
            return read_table(self.tables[-1])
        if not isinstance(node, yaml.SequenceNode) or not node.value:
            raise InputError(f"{self.path}:{line}: table: expected the name of a CSV file or a list of {{name: value}}")
        names, rows = None, []
        for item in node.value:
            values = {name: self._text(value, f"table.{name}") for name, value in self._map(_entry(item), "table").items()}
            names = names or list(values)
            if not names or set(values) != set(names):
                raise InputError(f"{self.path}:{_entry(item)[0]}: table: a run gives values of {', '.join(values) or 'nothing'}; the first "
                                 f"one of {', '.join(names) or 'nothing'}")
            rows.append([values[name] for name in names])
        return names, rows

    def _beside(self, name):
        return name if os.path.isabs(name) else os.path.join(self.folder, name)

    def _map(self, entry, what):
        line, node = entry
        if not isinstance(node, yaml.MappingNode):
            raise InputError(f"{self.path}:{line}: {what}: expected keys with values, `key: value`")
        found = {}
        for key, value in node.value:
            if not isinstance(key, yaml.ScalarNode) or not key.value:
                raise InputError(f"{self.path}:{_entry(key)[0]}: {what}: a key is a word")
            if key.value in found:
                raise InputError(f"{self.path}:{_entry(key)[0]}: {what}: '{key.value}' is there twice")
            found[key.value] = _entry(key)[0], value
        return found

    def _text(self, entry, what):
        line, node = entry
        if not isinstance(node, yaml.ScalarNode) or not node.value.strip():
            raise InputError(f"{self.path}:{line}: {what}: expected a number or a text")
        return node.value.strip()

    def _texts(self, entry, what):
        line, node = entry
        if isinstance(node, yaml.ScalarNode):
            return [self._text(entry, what)]
        if not isinstance(node, yaml.SequenceNode):
            raise InputError(f"{self.path}:{line}: {what}: expected a list")
        texts = [self._text(_entry(each), what) for each in node.value]
        if not texts and what != "draw":
            raise InputError(f"{self.path}:{line}: {what}: the list is empty")
        return texts


def _entry(node):
    return node.start_mark.line + 1, node


def _compose(path):
    """@raises InputError"""
    try:
        with open(path, encoding="utf-8-sig") as file:
            node = yaml.compose(file, Loader=yaml.BaseLoader)
    except OSError as error:
        raise InputError(f"cannot read '{path}': {error.strerror}") from None
    except UnicodeDecodeError:
        raise InputError(f"'{path}' is no file of a study: it is not text") from None
    except (yaml.YAMLError, RecursionError) as error:
        mark = getattr(error, "problem_mark", None)
        raise InputError(f"{path}{f':{mark.line + 1}' if mark else ''}: {getattr(error, 'problem', None) or 'this is no YAML'}") from None
    if node is None:
        raise InputError(f"'{path}' is empty; a study has the keys {', '.join(KEYS)}")
    return _entry(node)


def is_study_file(path):
    """Tells whether a YAML file has the key `model`, and is thus no model itself."""
    node = _compose(path)[1]
    return isinstance(node, yaml.MappingNode) and any(isinstance(key, yaml.ScalarNode) and key.value == "model" for key, _ in node.value)
