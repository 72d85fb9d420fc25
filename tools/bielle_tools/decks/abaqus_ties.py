"""Couplings, rigid bodies and MPCs of Abaqus and CalculiX files as ties, and their point masses.

(Abaqus Keywords Guide, "*COUPLING" and the other keywords; Abaqus Theory Guide, "Distributing coupling elements": the
mean of nodes with weights is that of an average tie.)
"""

import numpy as np

from ..messages import InputError, counted
from .abaqus_constraints import TIES
from .abaqus_lines import number
from .tie_model import PointMass, Tie, TieRefusal, check_translations, check_weight, direction_words

ALL = {1, 2, 3, 4, 5, 6}


def read_abaqus_ties(deck):
    """The ties of a deck (abaqus_contents) whose mesh has been made; one that can be no interface is delivered with the reason.
    @returns list of Tie"""
    reader = _Reader(deck)
    ties = []
    for keyword in deck.constraints.ties:
        ties += reader.mpcs(keyword) if keyword.name == "MPC" else [reader.tie(keyword)]
    return ties


def read_abaqus_masses(deck):
    """The point masses of a deck; one that cannot be read is delivered with the reason. @returns list of PointMass"""
    reader = _Reader(deck)
    return [mass for keyword in deck.constraints.masses for mass in reader.masses(keyword)]


def tie_notes(ties):
    """A sentence for each tie."""
    notes = []
    for tie in ties:
        if tie.refused:
            notes.append(f"left out: {tie.name}: {tie.refused}")
        else:
            tied = f"surface '{tie.surface}'" if tie.surface else counted(len(tie.weights), "node")
            notes.append(f"{tie.name} ({tied}): the interface {{from: {tie.name}}} stands for it")
    return notes


class _Reader:
    def __init__(self, deck):
        self.deck = deck
        self.label_of = {row: label for label, row in deck.numbers.items()}

    def tie(self, keyword):
        """The tie of a keyword of TIES."""
        options = keyword.options
        named = options.get("CONSTRAINT NAME") if keyword.name == "COUPLING" else options.get("ELSET") if keyword.name == TIES[2] else None
        tie = Tie(f"{keyword.name.lower()} {keyword.shown(named or options.get('REF NODE', '?'))}")
        try:
            {"COUPLING": self._coupling, "KINEMATIC COUPLING": self._kinematic_coupling, "DISTRIBUTING COUPLING": self._distributing_coupling,
             "RIGID BODY": self._rigid_body}[keyword.name](keyword, tie)
        except (InputError, TieRefusal) as reason:
            tie.refused = str(reason)
        return tie

    # ---- keywords -----------------------------------------------------------------------------------------------------
    def _coupling(self, keyword, tie):
        self._refer(keyword, tie, keyword.options.get("REF NODE", ""))
        if keyword.detail is None:
            raise TieRefusal("it has neither *KINEMATIC nor *DISTRIBUTING")
        if "INFLUENCE RADIUS" in keyword.options:
            raise TieRefusal("its INFLUENCE RADIUS chooses among the nodes of its surface, which is not read")
        detail = keyword.detail
        if detail.name == "KINEMATIC":
            check_translations(self._components(detail.words()), "its surface")
        else:
            tie.kind = "average"
            for key, known in (("WEIGHTING METHOD", "UNIFORM"), ("COUPLING", "CONTINUUM")):
                if detail.options.get(key, known).upper() != known:
                    raise TieRefusal(f"its {key} is {detail.options[key].upper()}; {known} is read")
            tie.directions = direction_words(self._components(detail.words()))
        if keyword.options.get("ORIENTATION"):
            tie.axes = self.deck.constraints.oriented_axes(keyword, keyword.options["ORIENTATION"])
        wanted = keyword.options.get("SURFACE", "")
        found = self.deck.key("SURFACE", self._name(keyword, wanted))
        if found is None:
            raise TieRefusal(f"there is no *SURFACE, NAME={wanted}")
        name, kind, entries, _ = self.deck.surfaces[found]
        if kind == "ELEMENT":
            tie.surface = name
            return
        for entry, area in entries:
            self._add(tie, self._rows([entry]), self._number(area, "an area of its surface") if area else 1.0)

    def _kinematic_coupling(self, keyword, tie):
        self._refer(keyword, tie, keyword.options.get("REF NODE", ""))
        taken = {}
        for words in keyword.words():
            for row in self._rows([self._entry(keyword, words[0])]):
                taken.setdefault(row, set()).update(self._components([words[1:]]))
        for row, components in taken.items():
            check_translations(components, f"the node {self.deck.assembly.told(self.label_of[row])}")
        self._add(tie, taken, 1.0)

    def _distributing_coupling(self, keyword, tie):
        tie.kind = "average"
        labels = self._elements(keyword, "DCOUP3D")
        if len(labels) != 1:
            raise TieRefusal(f"its set has {counted(len(labels), 'element')} DCOUP3D; one is expected")
        self._stand(tie, self.deck.single_nodes[labels[0]][1])
        for words in keyword.words():
            self._add(tie, self._rows([self._entry(keyword, words[0])]), self._number(words[1], "a weight") if len(words) > 1 and words[1] else 1.0)

    def _rigid_body(self, keyword, tie):
        self._refer(keyword, tie, keyword.options.get("REF NODE", ""))
        if keyword.options.get("POSITION", "INPUT").upper() != "INPUT":
            raise TieRefusal(f"its POSITION is {keyword.options['POSITION'].upper()}: give the reference node its place")
        if "ANALYTICAL SURFACE" in keyword.options:
            raise TieRefusal("it is an analytical surface")
        for key in ("NSET", "PIN NSET", "TIE NSET"):
            if key in keyword.options:
                self._add(tie, self._rows([self._name(keyword, keyword.options[key])]), 1.0)
        if "ELSET" in keyword.options:
            blocks = enumerate(self.deck.cells_of(self._name(keyword, keyword.options["ELSET"])))
            self._add(tie, {row for block, rows in blocks for row in self.deck.cells[block][1][rows].ravel().tolist()}, 1.0)

    def mpcs(self, keyword):
        """*MPC BEAM of several nodes on the same one is a rigid tie; others tie no nodes rigidly."""
        ties = {}
        for words in keyword.words():
            kind = words[0].upper()
            name = f"mpc {kind.lower()} {keyword.shown(words[2] if len(words) > 2 else '?')}"
            tie = ties.setdefault(name, Tie(name))
            try:
                if tie.position is None and len(words) > 2:
                    self._refer(keyword, tie, words[2])
                if kind != "BEAM":
                    raise TieRefusal(f"*MPC of type {kind} does not tie nodes as a rigid body; BEAM does")
                if len(words) != 3:
                    raise TieRefusal("BEAM has two nodes, or a set and a node")
                self._add(tie, self._rows([self._entry(keyword, words[1])]), 1.0)
            except (InputError, TieRefusal) as reason:
                tie.refused = str(reason)
        return list(ties.values())

    def masses(self, keyword):
        """The masses of *MASS or *ROTARY INERTIA, one for each element of its set; a fault of the keyword is reported
        for each."""
        kind = keyword.name.lower()
        try:
            labels = self._elements(keyword, "MASS" if keyword.name == "MASS" else "ROTARYI")
            if not labels:
                raise TieRefusal(f"its set has no element of type {'MASS' if keyword.name == 'MASS' else 'ROTARYI'}")
        except (TieRefusal, InputError) as reason:
            shown = keyword.shown(keyword.options.get("ELSET") or "?")
            return [PointMass(f"{kind} {shown}", refused=f"{keyword.where}: *{keyword.name}: {reason}")]
        return [self._mass(keyword, label, f"{kind} {self.deck.assembly.told(label)}") for label in labels]

    def _mass(self, keyword, label, name):
        try:
            mass, inertia = self._inertia(keyword)
            row, place = self._place(self.deck.single_nodes[label][1])
            return PointMass(name, mass, place, inertia, row)
        except (TieRefusal, InputError) as reason:
            return PointMass(name, refused=f"{keyword.where}: *{keyword.name}: {reason}")

    def _inertia(self, keyword):
        """Mass and tensor of inertia of a *MASS or *ROTARY INERTIA."""
        values = [self._number(word, "a mass or an inertia") for words in keyword.words() for word in words]
        if keyword.options.get("TYPE", "ISOTROPIC").upper() != "ISOTROPIC":
            raise TieRefusal(f"its TYPE is {keyword.options['TYPE'].upper()}; ISOTROPIC is read")
        if not values:
            raise TieRefusal("it has no numbers")
        least, most, expected = (1, 1, "one") if keyword.name == "MASS" else (3, 6, "three to six")
        if not least <= len(values) <= most:
            raise TieRefusal(f"it has {counted(len(values), 'number')}; expected {expected}")
        if keyword.name == "MASS":
            return values[0], np.zeros((3, 3))
        i11, i22, i33, i12, i13, i23 = (values + [0.0] * 6)[:6]
        inertia = np.array([[i11, i12, i13], [i12, i22, i23], [i13, i23, i33]])  # I12 = - int x1 x2 dm
        if "ORIENTATION" in keyword.options:
            axes = self.deck.constraints.oriented_axes(keyword, keyword.options["ORIENTATION"])
        else:
            axes = keyword.turned(np.eye(3))
        return 0.0, axes @ inertia @ axes.T

    # ---- nodes --------------------------------------------------------------------------------------------------------
    def _refer(self, keyword, tie, word):
        """Sets the reference node: a label, or a set of one node."""
        if not word:
            raise TieRefusal("it names no reference node (REF NODE)")
        label = self._entry(keyword, word)
        if isinstance(label, int):
            self._stand(tie, label)
            return
        labels = self.deck.labels_of("NSET", label)
        if len(labels) != 1:
            raise TieRefusal(f"its reference node '{word}' is a set of {counted(len(labels), 'node')}; one is expected")
        self._stand(tie, labels[0])

    def _stand(self, tie, label):
        tie.reference, tie.position = self._place(label)
        for transform in self.deck.constraints.transforms:
            if label in self._set(transform, "NSET"):
                tie.axes = self.deck.constraints.transformed_axes(transform)

    def _place(self, label):
        """Row and place of a node; in place of the row the words `reference point` and the label of one of an assembly."""
        if label in self.deck.reference_points:
            return ("reference point", label), np.array(self.deck.reference_points[label])
        if label not in self.deck.numbers:
            raise TieRefusal(f"it names the node {self.deck.assembly.told(label)}, which does not exist")
        row = self.deck.numbers[label]
        return row, np.array(self.deck.points[row])

    def _rows(self, entries):
        """Rows of nodes that are given by labels or names of sets."""
        rows = []
        for entry in entries:
            for label in [entry] if isinstance(entry, int) else self.deck.labels_of("NSET", str(entry)):
                if label not in self.deck.numbers:
                    raise TieRefusal(f"it names the node {self.deck.assembly.told(label)}, which is no node of the mesh")
                rows.append(self.deck.numbers[label])
        return rows

    def _add(self, tie, rows, weight):
        for row in rows:
            check_weight(weight, self.deck.assembly.told(self.label_of[row]))
            if weight > 0:
                tie.weights[row] = 1.0 if tie.kind == "rigid" else tie.weights.get(row, 0.0) + weight

    def _elements(self, keyword, kind):
        """Labels of the elements of one node in the set of a keyword."""
        return [label for label in self._set(keyword, "ELSET") if self.deck.single_nodes.get(label, ("",))[0].startswith(kind)]

    def _set(self, keyword, key):
        """The labels of the set that an option names."""
        if not keyword.options.get(key):
            raise TieRefusal(f"no {key} is named by *{keyword.name}")
        return self.deck.labels_of(key, self._name(keyword, keyword.options[key]))

    def _entry(self, keyword, word):
        """The label or the name of a set that a word of a keyword means."""
        if keyword.scope is None:
            return self.deck.entry(word)
        word = word.strip('"')
        return int(word) + keyword.scope.raised if word.isdigit() else keyword.scope.prefix + word

    def _name(self, keyword, name):
        """The name in the body of a set or surface."""
        return keyword.scope.prefix + name if keyword.scope else name

    # ---- numbers ------------------------------------------------------------------------------------------------------
    @staticmethod
    def _components(lines):
        """Components of lines `first, last`; all if there are none."""
        taken = set()
        for words in lines:
            words = [word for word in words if word]
            if not all(word.isdigit() and 1 <= int(word) <= 6 for word in words[:2]):
                raise TieRefusal(f"'{', '.join(words)}' are no components: numbers from 1 to 6 are expected")
            taken |= set(range(int(words[0]), int(words[-1 if len(words) < 2 else 1]) + 1)) if words else ALL
        return taken or ALL

    @staticmethod
    def _number(word, what):
        try:
            return number(word)
        except ValueError:
            raise TieRefusal(f"{what} is '{word}', which is no number") from None
