"""Modes of an analysis `eigen`, and one of them as a motion that can be drawn like any other.

A mode moves as Re(a Phi exp(s t)). It is shown over one period of its oscillation, by default without its decay: a Phi
exp(i w t), with a such that the largest displacement is a share of the model's size. Modes that do not oscillate
(rigid, decaying, growing) are shown as if they did. Displacements are added to positions, rotation vectors turn the
axes; a superelement moves with its coordinates, which belong to nodes and to the unknowns of its inner modes: its field
is U q in its frame, which does not move.

The results name nodes and beams. The shapes of superelements and rigid bodies are in analyses with rows only: an
`assembly` before `eigen` is sufficient.
"""

import copy
import re

import h5py
import numpy as np
import yaml

from ..bodies.superelement_body import find_superelement, interfaces_of, superelement_of
from ..messages import InputError, note
from .quaternions import product
from .results_file import Results, reading
from .rotations import rotation_matrices

SHARE = 0.1  # largest drawn displacement as a share of the model's size
MOST_TURN = 5.0  # [rad] per share: the largest rotation as drawn is half a radian at a share of 0.1


class Modes:
    """All modes. s (k) [1/s]; frequency, damping_ratio, kind (k); nodes (m); position (m,3), orientation (m,4); complex displacement and
    rotation (k,m,3), None where shapes were not written."""

    def __init__(self, results):
        self.results = results
        if not results.has("eigen/frequency"):
            raise InputError(f"'{results.path}' holds no modes: an analysis 'eigen' finds them")
        with reading(results.path, "eigen"):
            group = results.root["eigen"]
            self.frequency, self.damping_ratio = (_numbers(group, name, 1) for name in ("frequency", "damping_ratio"))
            self.s = _complex(group, "eigenvalue", 1)
            self.kind = group["kind"].asstr()[:].tolist() if "kind" in group else [""] * len(self.s)
            self.displacement = None
            if len({len(self.frequency), len(self.damping_ratio), len(self.s), len(self.kind)}) != 1:
                raise ValueError
            if "displacement" in group:
                self._read_shapes(group)

    def _read_shapes(self, group):
        self.nodes = group["nodes"].asstr()[:].tolist()
        self.position, self.orientation = _numbers(group, "position", 2), _numbers(group, "orientation", 2)
        self.displacement, self.rotation = _complex(group, "displacement", 3), _complex(group, "rotation", 3)
        if not all(self.nodes) or len(set(self.nodes)) < len(self.nodes):
            raise ValueError
        self.unknowns, self.shapes = group["unknowns"].asstr()[:].tolist(), _complex(group, "shapes", 2)
        k, m = len(self.s), len(self.nodes)
        if (self.position.shape, self.orientation.shape, self.displacement.shape, self.rotation.shape, self.shapes.shape) != (
                (m, 3), (m, 4), (k, m, 3), (k, m, 3), (k, len(self.unknowns))):
            raise ValueError

    def __len__(self):
        return len(self.s)

    def named(self, number):
        """`mode 2, 12.3 Hz, damping ratio 0.01`. number: from 1"""
        k = number - 1
        kind = f", {self.kind[k]}" if self.kind[k] not in ("oscillating", "") else ""
        damping = f", damping ratio {self.damping_ratio[k]:.3g}" if abs(self.damping_ratio[k]) > 1e-9 and self.s[k].imag else ""
        return f"mode {number}, {self.frequency[k]:.5g} Hz{damping}{kind}"

    def check(self, number):
        """@raises InputError if there is no such mode, or there are no shapes"""
        if not 1 <= number <= len(self):
            raise InputError(f"there is no mode {number}: '{self.results.path}' has {len(self)}, counted from 1")
        if self.displacement is None:
            raise InputError(f"'{self.results.path}' holds no shapes of modes: the analysis has 'shapes: false'")


def _numbers(group, name, dimensions):
    values = np.asarray(group[name], float)
    if values.ndim != dimensions or not np.all(np.abs(values) < 1e100):
        raise ValueError
    return values


def _complex(group, name, dimensions):
    values = _numbers(group, name, dimensions + 1)
    if values.shape[-1] != 2:
        raise ValueError
    return values[..., 0] + 1j * values[..., 1]


class ModeScenery:
    """The parts that are drawn for all modes of an analysis: nodes, beams and, if some analysis of the file has rows of
    this state, bodies."""

    def __init__(self, modes, superelements=None):
        self.modes, self.superelements = modes, superelements or {}
        self.index = {name: k for k, name in enumerate(modes.nodes)}
        self.beams = self._beams()
        inner = {node for nodes in self.beams.values() for node in nodes[1:-1]}
        self.nodes = [name for name in modes.nodes if name != "ground" and name not in inner]
        self.base, self.row = self._state()
        self.bodies = {}
        if self.base is None:
            kinds = "superelement" if modes.results.text_of("drawing") else "superelement|rigid_body"  # a drawing has the shapes of rigid ones
            if re.search(rf"\btype\s*:\s*[\"']?({kinds})\b", modes.results.text_of("input")):
                note("bodies are left out: no analysis of the file has rows of this state; list {type: assembly} before 'eigen'")
            return
        for name in self.base.elements_with("frame", "coordinates"):
            self.bodies[name] = self._body(name)

    def _beams(self):
        """{beam: its nodes from start to end}; the end nodes are in the model alone."""
        inner = {}
        for name in self.modes.nodes:
            found = re.fullmatch(r"(.+)\.(\d+)", name)
            if found:
                inner.setdefault(found[1], []).append((int(found[2]), name))
        ends = {}
        try:
            for name, entry in (yaml.load(self.modes.results.text_of("input"), Loader=yaml.BaseLoader).get("elements") or {}).items():
                if entry.get("type") == "beam" and all(node in self.index for node in entry.get("nodes", [])):
                    ends[name] = entry["nodes"]
        except (yaml.YAMLError, AttributeError, TypeError):  # beams are left out of models that the program reads
                                                             # differently
            pass
        return {name: [first, *(node for _, node in sorted(inner.get(name, []))), last] for name, (first, last) in ends.items()}

    def _state(self):
        """The analysis and the row with the state about which the modes are: the end of an earlier analysis, or the
        start of a later one."""
        own = self.modes.results
        link = own.root.get("eigen", getlink=True)  # HDF5 gives a group the name by which it was opened, not its place
        place = link.path if isinstance(link, h5py.SoftLink) else own.root["eigen"].name
        found = re.search(r"analysis_(\d+)/eigen$", place)
        number = int(found[1]) if found else 0
        best = (np.inf, None, 0)
        for other in own.analyses_with_rows():
            base = Results(own.path, other)
            row = len(base.time) - 1 if other < number else 0
            gaps = [np.abs(base.rows(f"nodes/{node}/position", row) - self.modes.position[self.index[node]]).max()
                    for node in base.names("nodes") if node in self.index and base.has(f"nodes/{node}/position")]
            gap = max(gaps, default=np.inf)
            if not base.names("elements") or not np.isfinite(gap) or gap >= best[0]:
                base.file.close()
                continue
            if best[1] is not None:
                best[1].file.close()
            best = (gap, base, row)
        if best[1] is not None and best[0] > 1e-6 * max(self.extent(), 1e-12):
            best[1].file.close()
            return None, 0
        return best[1], best[2]

    def extent(self):
        """Size of the model [m]."""
        return float(np.linalg.norm(np.ptp(self.modes.position, axis=0)))

    def _body(self, name):
        """Frame, coordinates (n) at the state, and complex coordinates of the shapes (k,n)."""
        place = f"elements/{name}"
        frame, q0 = (self.base.rows(f"{place}/{what}", self.row) for what in ("frame", "coordinates"))
        path, group = find_superelement(self.base, name, self.superelements), self.base.text(place, "group")
        R = rotation_matrices(frame[3:])
        columns = []
        for interface, kept, axes in interfaces_of(path, group):
            node = self.base.text(place, f"interface {interface}")
            if node not in self.index:
                raise InputError(f"'{self.base.path}' does not say which node of the modes the interface '{interface}' of '{name}' is")
            turn = axes.T @ R.T
            u = np.concatenate([self.modes.displacement[:, self.index[node]] @ turn.T,
                                self.modes.rotation[:, self.index[node]] @ turn.T], axis=1)
            columns.append(u[:, kept])
        count = sum(column.shape[1] for column in columns)
        unknown = {text: k for k, text in enumerate(self.modes.unknowns)}
        for number in range(1, len(q0) - count + 1):
            text = f"mode {number} of element '{name}'"
            columns.append(self.modes.shapes[:, [unknown[text]]] if text in unknown else np.zeros((len(self.modes), 1)))
        shapes = np.concatenate(columns, axis=1) if columns else np.zeros((len(self.modes), 0))
        if shapes.shape[1] != len(q0):
            raise InputError(f"'{path}' is not the superelement of '{name}': was it reduced again after the run?")
        return frame, q0, shapes

    def close(self):
        if self.base is not None:
            self.base.file.close()


class ModeMotion:
    """One mode over a period: the interface of `Results` that drawing a motion needs, with a row per phase. number:
    from 1."""

    static = False
    stress_label = "von Mises as drawn [MPa]"

    def __init__(self, scenery, number, pictures=24, share=SHARE, decay=False):
        modes = scenery.modes
        modes.check(number)
        self.scenery, self.modes, self.number, self.k = scenery, modes, number, number - 1
        self.path = modes.results.path
        s = modes.s[self.k]
        self.period = 2 * np.pi / abs(s.imag) if s.imag else 1.0
        self.time = self.period * np.arange(pictures) / pictures
        self.factor = self._factor(share) * np.exp(2j * np.pi * np.arange(pictures) / pictures * (np.sign(s.imag) or 1))
        if decay and s.imag:
            self.factor = self.factor * np.exp(s.real * self.time)

    def _factor(self, share):
        """Factor of the shape such that its largest displacement is the share of the model's size, and no rotation is
        too large."""
        size, u = self.scenery.extent(), [_largest(self.modes.displacement[self.k])]
        for name, (_, _, shapes) in self.scenery.bodies.items():
            body = superelement_of(self.scenery.base, name, self.scenery.superelements)
            field = body.local_displacement(shapes[self.k].real) + 1j * body.local_displacement(shapes[self.k].imag)
            u.append(_largest(field))
            size = max(size, float(np.linalg.norm(np.ptp(body.points, axis=0))))
        limits = [share * (size or 1.0) / largest for largest in [max(u)] if largest > 1e-12]
        turn = _largest(self.modes.rotation[self.k])
        limits += [MOST_TURN * share / turn] if turn > 1e-12 else []
        return min(limits, default=1.0)

    def at_rest(self):
        """The state about which the mode swings, as a motion of one row."""
        still = self.only(0)
        still.factor = np.zeros(1)
        return still

    def only(self, row):
        """One row of it, as a motion."""
        one = copy.copy(self)
        one.time, one.factor = self.time[row:row + 1], self.factor[row:row + 1]
        return one

    def farthest(self):
        """The row in which the nodes are farthest from the state."""
        u, turn = self.modes.displacement[self.k], self.modes.rotation[self.k]
        field = u if np.abs(u).max(initial=0) > 1e-9 * np.abs(turn).max(initial=0) else turn
        return int(np.argmax([(np.real(factor * field) ** 2).sum() for factor in self.factor]))

    # -- interface of Results
    @property
    def title(self):
        return f"{self.modes.results.title}: {self.modes.named(self.number)}"

    def moment(self, row):
        return f"{360 * row / len(self.time):.0f} degrees"

    def names(self, section):
        return {"nodes": self.scenery.nodes, "elements": [*self.scenery.beams, *self._others()]}.get(section, [])

    def _others(self):
        base = self.scenery.base
        return [] if base is None else [name for name in base.names("elements") if name not in self.scenery.beams]

    def _split(self, place):
        section, _, rest = place.strip("/").partition("/")
        name, _, quantity = rest.rpartition("/")
        return (section, name, quantity) if name else (section, rest, "")

    def has(self, place):
        section, name, quantity = self._split(place)
        if section == "nodes":
            if not quantity or quantity not in ("position", "rotation", "velocity"):
                name = f"{name}/{quantity}" if quantity else name
                return name in self.scenery.nodes
            return name in self.scenery.nodes
        if section != "elements":
            return False
        return quantity in (("position", "rotation") if name in self.scenery.beams else
                            ("frame", "coordinates") if name in self.scenery.bodies else ())

    def shape(self, place):
        return self.rows(place).shape

    def elements_with(self, *datasets):
        return [name for name in self.names("elements") if all(self.has(f"elements/{name}/{each}") for each in datasets)]

    def text(self, place, attribute):
        base = self.scenery.base
        return base.text(place, attribute) if base is not None and place.strip("/").startswith(("elements", "nodes")) else ""

    def entry_of(self, element):
        return element.rpartition(".")[0] if self.text(f"elements/{element}", "group") else element

    def frames(self, every=None, count=None, span=(None, None)):  # pylint: disable=unused-argument
        """All phases."""
        return np.arange(len(self.time))[::every or 1]

    def rows(self, place, index=None):
        section, name, quantity = self._split(place)
        factor = self.factor if index is None else self.factor[index]
        nodes = [name] if section == "nodes" else self.scenery.beams.get(name)
        if nodes is not None:
            found = self._of_nodes([self.scenery.index[node] for node in nodes], quantity, np.atleast_1d(factor))
            found = found[:, 0] if section == "nodes" else found
        else:
            frame, q0, shapes = self.scenery.bodies[name]
            factors = np.atleast_1d(factor)
            found = np.tile(frame, (len(factors), 1)) if quantity == "frame" else q0 + np.real(factors[:, None] * shapes[self.k])
        return found if np.ndim(factor) else found[0]

    def _of_nodes(self, numbers, quantity, factors):
        """(rows, nodes, ...)"""
        modes, k = self.modes, self.k
        if quantity == "position":
            return modes.position[numbers] + np.real(factors[:, None, None] * modes.displacement[k, numbers])
        if quantity == "rotation":
            return turned(np.real(factors[:, None, None] * modes.rotation[k, numbers]), modes.orientation[numbers])
        if quantity == "velocity":
            s = modes.s[k]
            rate = 1j * s.imag or 2j * np.pi
            u = np.concatenate([modes.displacement[k, numbers], np.zeros((len(numbers), 3))], axis=1)
            return np.real(rate * factors[:, None, None] * u)
        raise KeyError(quantity)


def turned(vectors, quaternions):
    """Quaternions w x y z after turning by rotation vectors in inertial axes: q(v) q."""
    half = np.linalg.norm(vectors, axis=-1, keepdims=True) / 2
    return product(np.concatenate([np.cos(half), vectors * np.sinc(half / np.pi) / 2], axis=-1), quaternions)


def _largest(field):
    """Largest length of Re(v exp(i phase)) for complex vectors v (...,3): sqrt((|v|^2 + |v.v|) / 2)."""
    squares = (np.abs(field) ** 2).sum(axis=-1) + np.abs((field * field).sum(axis=-1))
    return float(np.sqrt(0.5 * squares.max(initial=0)))
