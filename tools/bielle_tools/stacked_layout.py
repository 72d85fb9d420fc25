"""The stacked layout of results: names of entries, and the places of their numbers.

    /nodes/node/name      (n)         names
    /nodes/node/position  (nt,n,3)    the quantity of all of them
    /nodes/node/attributes/carrier (n)  texts, empty where an entry has no such attribute
A section contains one such group per kind; entries of a kind record the same quantities.
"""

import numpy as np

SECTIONS = ("nodes", "elements", "joints", "measures")


class StackedLayout:
    """Finds the dataset that the layout by names calls `joints/main/coordinate`. root: group of an analysis, or of the
    file."""

    def __init__(self, root):
        self.root = root
        self._places = {}  # section -> {name: (group of the kind, number)}
        self._lists = {}  # path of an attribute -> its texts
        self._row = {}  # path of a dataset -> (row, numbers of all entries)
        self._facts = {}  # (kind, field, subject) -> what entries of a kind have in common

    def names(self, section):
        """Names in the order of their kinds; None if the section is not stacked."""
        return list(self._section(section)) if section in SECTIONS else None

    def split(self, place):
        """`joints/main/coordinate` -> (group, number, "coordinate"); the last is empty for an entry. None: not stacked."""
        section, _, rest = place.strip("/").partition("/")
        if section not in SECTIONS or not rest:
            return None
        entries = self._section(section)
        if section == "measures":
            return (*entries[rest], "value") if rest in entries else ()
        if rest in entries:
            return (*entries[rest], "")
        name, _, field = rest.rpartition("/")  # names may contain `/`
        return (*entries[name], field) if name in entries else ()

    def has(self, found):
        return bool(found) and (not found[2] or self._fact(found, "has", lambda group, field: field in group))

    def datasets(self, found):
        """Names of the datasets of an entry."""
        return self._fact(found, "datasets", lambda group, _: [name for name in group if name not in ("name", "attributes")])

    def _fact(self, found, subject, read):
        """Returns read(group, field), which is read once for all entries of a kind: files have many entries of few kinds."""
        group, _, field = found
        key = id(group), field, subject  # the groups live as long as this object
        if key not in self._facts:
            self._facts[key] = read(group, field)
        return self._facts[key]

    def text(self, found, attribute):
        """An attribute of an entry or of its dataset; empty if there is none."""
        group, number, field = found
        if field:
            return self._fact(found, f"text {attribute}",
                              lambda kind, name: kind[name].attrs.get(attribute, "") if name in kind else "")
        if attribute == "type":
            return group.attrs.get(attribute, "")
        path = f"{group.name}/attributes/{attribute}"
        if path not in self._lists:
            self._lists[path] = group["attributes"][attribute].asstr()[:] \
                if "attributes" in group and attribute in group["attributes"] else None
        texts = self._lists[path]
        return "" if texts is None else texts[number]

    def read(self, found, rows):
        """Rows of one entry. Rows of many entries at one time are read together."""
        group, number, field = found
        data = group[field]
        if isinstance(rows, slice) or np.ndim(rows):
            return np.asarray(data[rows, number])
        kept = self._row.get(data.name)
        if kept is None or kept[0] != rows:
            self._row[data.name] = kept = (rows, data[rows])
        return kept[1][number]

    def shape(self, found):
        """Shape of the dataset for the entry alone."""
        shape = self._fact(found, "shape", lambda group, field: group[field].shape)
        return shape[:1] + shape[2:] if len(shape) > 1 else ()  # a number that is no row over time

    def value(self, found):
        """A number of an entry that is not over time."""
        return float(found[0][found[2]][found[1]])

    def _section(self, section):
        if section not in self._places:
            places = {}
            for group in self.root[section].values() if section in self.root else ():
                places.update((name, (group, k)) for k, name in enumerate(group["name"].asstr()[:]))
            self._places[section] = places
        return self._places[section]
