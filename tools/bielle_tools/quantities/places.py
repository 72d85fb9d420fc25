"""The quantities over time of a results file, and the names by which users call them.

A quantity has the name of its dataset, `joints/main/reaction`. The short names of formulas serve as well: a dot in
place of `/`, and no section, if one entry alone has such a quantity (`main.reaction`; a joint, an element or a measure
precedes others); and the coordinates of joints with their rates, `main.angle`, `main.angle.rate`. Quotes around a name
are optional: `'rod.wrist'.position`.
"""

import contextlib
import re

import h5py

from ..messages import InputError, did_you_mean
from ..results.columns import names_in
from ..results.results_file import WITHOUT_ROWS, reading
from ..results.stacked_layout import SECTIONS
from .bodies import MADE, has_body

NO_QUANTITIES = (*WITHOUT_ROWS, "events", "peaks", "validity", "checkpoints", "input", "parameters", "equations",
                 "crossings", "study_said")
OF_BEAM = re.compile(r"(.+?)(?:[./]element_([1-9]\d*))?[./](stress|von_mises|force|moment)((?:[.\[].*)?)")  # as in formulas
FIRST = ("joints", "elements", "measures")  # sections that precede others in short names


class Places:
    """The quantities of open results. recorded: paths of datasets; made: paths of what can be computed from them."""

    def __init__(self, results):
        self.results = results
        with reading(results.path, "/"):
            sections = [name for name in results.root if _is_section(results, name)]
            self.recorded = [place for section in sections for place in _below(results, section)]
            bodies = [name for name in results.elements_with("frame", "coordinates") if has_body(results, name)]
            known = set(self.recorded)
            self.made = [place for name in bodies for place in (f"elements/{name}/{field}" for field in MADE)
                         if place not in known]
        self._named = self._shortest = None

    def short_names(self, place):
        """@returns the shortest names of a quantity for users: one for each coordinate of a joint or its rate, otherwise
        one; none if only its path is unique"""
        if self._shortest is None:
            self._shortest = {}
            for name, found in self._names().items():
                with contextlib.suppress(InputError):  # several quantities may have the name
                    one = self._one(name, found)
                    self._shortest[one] = min(self._shortest.get(one, name), name, key=len)
        width = next(iter(self.results.shape(place)[1:]), 1) if place in self.recorded else 0
        columns = [self._shortest[place, column] for column in range(width) if (place, column) in self._shortest]
        names = columns if columns and len(columns) == width else [self._shortest.get((place, None), place)]
        return [name for name in names if name != place and "," not in name]

    def find(self, text):
        """@returns the place of a quantity, the number of its column or None, and the rest of the text, `.x` or `[3]`.
        @raises InputError"""
        raw = text.strip().strip("/")
        paths = set(self.recorded + self.made)
        for end in _ends(raw):
            if raw[:end] in paths:  # a path is unique, a name with dots need not be
                return raw[:end], None, raw[end:]
        for quoted in (False, True):  # a name may have an apostrophe of its own
            for end in _ends(raw, quoted):
                name = raw[:end].replace("/", ".")
                name = name.replace("'", "").strip() if quoted else name
                found = self._names().get(name)
                if found:
                    return (*self._one(name, found), raw[end:])
        as_recorded = self._of_beam(raw)
        if as_recorded:
            return self.find(as_recorded)
        written = raw.replace("'", "").strip().strip("/")
        analysis = re.split("[./]", written)[0]
        if analysis in WITHOUT_ROWS and self.results.has(analysis):
            shown = {"frequency_response": "bielle-table --response", "state_space": "h5py"}.get(analysis, "bielle-table --modes")
            raise InputError(f"'{self.results.path}' has no quantity '{text}' over time: {shown} shows the results of '{analysis}'")
        raise InputError(f"'{self.results.path}' has no quantity '{text}'{self._nearest(written)}")

    def _of_beam(self, text):
        """@returns `boom.resultants[2].rx` for `boom.element_2.moment.x` of formulas; None if it is no quantity of a beam.
        A beam of one element needs no number."""
        found = OF_BEAM.fullmatch(text)
        if not found:
            return None
        beam, element, field, rest = found.groups()
        recorded = field if field in ("stress", "von_mises") else "resultants"
        named = self._names().get(f"{beam}.{recorded}".replace("/", ".").replace("'", ""), [])
        place = next((place for place, _ in named if place.startswith("elements/")), "")
        shape = self.results.shape(place) if place in self.recorded else ()
        if len(shape) < 2 or element is None and shape[1] != 1:
            return None
        if recorded == "resultants":
            rest = re.sub(r"^\.(?=[xyz])", ".r" if field == "moment" else ".", rest) or f".{field}"
        return f"{place}[{element or 1}]{rest}"

    def _one(self, name, found):
        """Picks one of several quantities that share a short name. @raises InputError if none precedes the others"""
        exact = [one for one in found if one[1] is None and one[0].replace("/", ".") == name]
        best = exact or [one for one in found if one[0].split("/")[0] in FIRST] or found
        if len(best) > 1:
            raise InputError(f"'{name}' may be {' or '.join(place for place, _ in best)}: say which")
        return best[0]

    def _names(self):
        """{dotted name: [(place, column or None)]}"""
        if self._named is None:
            self._named = {}
            for place in self.recorded + self.made:
                self._add(place.replace("/", "."), place)
                section, _, rest = place.partition("/")
                if rest:
                    self._add(rest.replace("/", "."), place)
                if section == "joints" and place.endswith("/coordinate"):
                    self._add_coordinates(rest.rpartition("/")[0], place)
        return self._named

    def _add(self, name, place, column=None):
        self._named.setdefault(name, []).append((place, column))

    def _add_coordinates(self, joint, place):
        width = self.results.shape(place)[-1]
        for column, name in enumerate(names_in(self.results.text(place, "description"), width)):
            if name and not name.isdigit():
                self._add(f"{joint}.{name}".replace("/", "."), place, column)
                rate = place.rpartition("/")[0] + "/rate"
                if self.results.has(rate):
                    self._add(f"{joint}.{name}.rate".replace("/", "."), rate, column)

    def _nearest(self, written):
        """Names the nearest quantity, as a path if a path was written; for a wrong field of a known entry, one of its
        fields."""
        names = self.recorded + self.made if "/" in written else list(self._names())
        plain, entry = written, written
        if re.search(r"[+*^]|\s[-/]\s", written):
            return ": a formula is an entry of 'measures' in the model, whose name is a quantity"
        node, _, component = written.rpartition(".")
        if component in ("x", "y", "z") and f"{node}.position" in self._names():
            return f"; did you mean '{written[:-2]}.position.{component}'?"
        while "." in entry or "/" in entry:
            entry = entry[:max(entry.rfind("."), entry.rfind("/"))]
            fields = [name for name in names if name.startswith((entry + ".", entry + "/"))]
            if fields:
                names = fields
                break
        advice = did_you_mean(plain, names)
        return advice if advice.startswith(";") or len(names) <= 12 else ": 'bielle-table --list' shows all of them"


def _ends(text, quoted=False):
    """Lengths of the beginnings of a text that may be a name, the longest first. quoted: none ends within quotes"""
    ends = [k for k, letter in enumerate(text) if letter in ".[("] + [len(text)]
    return sorted((k for k in ends if not quoted or text.count("'", 0, k) % 2 == 0), reverse=True)


def _is_section(results, name):
    """Tells whether an object at the root holds quantities over the rows of these results: a group may lead to another
    analysis."""
    if name in NO_QUANTITIES or name.startswith("analysis_"):
        return False
    links = [results.root.get(each, getlink=True) for each in ("time", name) if each in results.root]
    if len(links) == 2 and all(isinstance(link, h5py.SoftLink) for link in links):
        return links[0].path.rpartition("/")[0] == links[1].path.rpartition("/")[0]
    return "time" in results.root


def _below(results, section):
    """Paths of the datasets over time in a section of either layout, at any depth: names may contain `/`."""
    group = results.root[section]
    if isinstance(group, h5py.Dataset):
        return [section] if _is_over_time(group.dtype, group.shape, results) else []
    if section in SECTIONS and results.stacked:
        paths = [f"{section}/{name}" for name in results.names(section)]
        if section != "measures":
            paths = [f"{path}/{field}" for path in paths for field in results.datasets(path)]
        return [path for path in paths if next(iter(results.shape(path)), 0) >= len(results.time)]
    found = []

    def visit(name, item):
        if isinstance(item, h5py.Dataset) and _is_over_time(item.dtype, item.shape, results):
            found.append(f"{section}/{name}")

    group.visititems(visit)
    turning = [path.rpartition("/")[0] for path in found if section == "nodes" and path.endswith("/rotation")]
    known = set(found)
    made = [f"{node}/{field}" for node in turning for field in results.datasets(node)]
    return found + [path for path in made if path not in known]


def _is_over_time(dtype, shape, results):
    return dtype.kind in "fiu" and len(shape) > 0 and shape[0] >= len(results.time)
