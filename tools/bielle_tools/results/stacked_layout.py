"""The stacked layout of results: names of entries, and the places of their numbers.

    /nodes/node/name      (n)         names
    /nodes/node/position  (nt,n,3)    the quantity of all of them
    /nodes/node/attributes/carrier (n)  texts, empty where an entry has no such attribute
A section contains one such group per kind; entries of a kind record the same quantities.
"""

import numpy as np

MOST_KEPT = 200e6  # bytes of datasets that are kept, since their entries are read one after another
SECTIONS = ("nodes", "elements", "joints", "loads", "measures", "supports", "contacts", "hydraulics")


class StackedLayout:
    """Finds the dataset that the layout by names calls `joints/main/coordinate`. root: group of an analysis, or of the
    file."""

    def __init__(self, root):
        self.root = root
        self._places = {}  # section -> {name: (group of the kind, number)}
        self._lists = {}  # path of an attribute -> its texts
        self._row = {}  # path of a dataset -> (row, numbers of all entries)
        self._facts = {}  # (kind, field, subject) -> what entries of a kind have in common
        self._opened = {}  # (identity of a group, field) -> dataset, or None
        self._whole = {}  # path of a dataset -> (rows, numbers of all entries in them)
        self._room = MOST_KEPT

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
        return bool(found) and (not found[2] or self._dataset(found[0], found[2]) is not None)

    def dataset(self, found):
        """The dataset with all entries of the kind. @raises KeyError"""
        data = self._dataset(found[0], found[2])
        if data is None:
            raise KeyError(found[2])
        return data

    def _dataset(self, group, field):
        """The dataset of a field, opened once; None if the group has no such field."""
        key = (id(group), field)
        if key not in self._opened:
            self._opened[key] = group[field] if field in group else None
        return self._opened[key]

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
        data = self.dataset(found)
        if isinstance(rows, slice) and rows.step is None:
            return self._of_all(data, rows)[:, number].copy()
        if isinstance(rows, slice) or np.ndim(rows):
            return np.asarray(data[rows, number])
        kept = self._row.get(data.name)
        if kept is None or kept[0] != rows:
            self._row[data.name] = kept = (rows, data[rows])
        return kept[1][number]

    def _of_all(self, data, rows):
        """Rows of all entries, kept if there is room."""
        kept = self._whole.get(data.id)
        if kept is not None and kept[0] == rows:
            return kept[1]
        if data.size * data.dtype.itemsize > self._room:
            return _Columns(data, rows)
        self._room -= data.size * data.dtype.itemsize
        self._whole[data.id] = (rows, np.asarray(data[rows]))
        return self._whole[data.id][1]

    def shape(self, found):
        """Shape of the dataset for the entry alone."""
        shape = self.dataset(found).shape
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


class _Columns:
    """Rows of a dataset that is too large to be kept: `[:, number]` reads those of one entry."""

    def __init__(self, data, rows):
        self.data, self.rows = data, rows

    def __getitem__(self, index):
        return np.asarray(self.data[self.rows, index[1]])
