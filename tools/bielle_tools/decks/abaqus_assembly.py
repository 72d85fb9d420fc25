"""Parts and instances of Abaqus input files, joined into one body.

Numbers of nodes and elements are local to an instance. The k-th one gets them raised by k times `STRIDE`, and its sets and
surfaces are called `instance.set`, as in Abaqus; if one instance alone has a mesh, its groups keep their plain names.
(Abaqus Analysis Guide, "Assembly definition"; Abaqus Keywords Guide, "*PART", "*INSTANCE".)
"""

from dataclasses import dataclass

import numpy as np

from ..messages import InputError, did_you_mean
from .abaqus_constraints import Scope
from .abaqus_contents import STRIDE
from .abaqus_systems import motion
from .abaqus_tied_surfaces import Tie

ENDS = {"END PART": "PART", "END INSTANCE": "INSTANCE", "END ASSEMBLY": "ASSEMBLY"}


@dataclass
class _Instance:
    name: str
    part: str
    where: str
    turn: np.ndarray
    shift: np.ndarray
    contents: object  # reader

    def is_turned(self):
        return not np.array_equal(self.turn, np.eye(3))


class Assembly:
    """Passes keywords to the reader of the file, or of the part or instance to which they belong."""

    def __init__(self, reader, make):
        """@param make: returns a new reader"""
        self.reader, self.make = reader, make
        reader.assembly = self
        self.name, self.parts, self.instances = "", {}, []
        self.open = []  # keywords that have not ended
        self.contents = None  # reader of the part or instance that is open

    # ---- reading ------------------------------------------------------------------------------------------------
    def keyword(self, keyword):
        name = keyword.name
        if name in ENDS.values():
            getattr(self, f"_begin_{name.lower()}")(keyword)
            self.open.append(keyword)
        elif name in ENDS:
            if not self.open or self.open[-1].name != ENDS[name]:
                raise InputError(f"{keyword.where}: *{name} without *{ENDS[name]}")
            self.open.pop()
            self.contents = None
        elif self.contents is not None:
            self.contents.keyword(keyword)
        elif self.open and name == "NODE":
            self.reader.add_reference_points(keyword)
        else:
            self.reader.keyword(keyword)

    def _begin_part(self, keyword):
        name = keyword.options.get("NAME", "")
        if self.open or name.upper() in self.parts:
            raise InputError(f"{keyword.where}: " + (f"*PART inside of *{self.open[-1].name}" if self.open else f"there is a second part '{name}'"))
        self.contents = self.make()
        self.parts[name.upper()] = (name, self.contents)

    def _begin_assembly(self, keyword):
        if self.open:
            raise InputError(f"{keyword.where}: *ASSEMBLY inside of *{self.open[-1].name}")
        self.name = keyword.options.get("NAME", "")

    def _begin_instance(self, keyword):
        name, part = keyword.options.get("NAME", ""), keyword.options.get("PART", "")
        if self.contents is not None:
            raise InputError(f"{keyword.where}: *INSTANCE inside of *{self.open[-1].name}")
        if "LIBRARY" in keyword.options or "INSTANCE" in keyword.options:
            raise InputError(f"{keyword.where}: the instance '{name or keyword.options.get('INSTANCE')}' comes from the results of another analysis, "
                             "which Bielle does not read")
        if not name or self._number(name) is not None:
            raise InputError(f"{keyword.where}: *INSTANCE: " + (f"there is a second instance '{name}'" if name else "no name (NAME=...)"))
        if part.upper() not in self.parts:
            raise InputError(f"{keyword.where}: *INSTANCE: there is no part '{part}'{did_you_mean(part, [each for each, _ in self.parts.values()])}")
        self.contents = self.parts[part.upper()][1].copy()
        self.instances.append(_Instance(name, part, keyword.where, *motion(keyword), self.contents))

    def _number(self, name):
        return next((k for k, each in enumerate(self.instances) if each.name.upper() == name.upper()), None)

    # ---- names --------------------------------------------------------------------------------------------------
    def shift(self, keyword):
        """Returns the amount by which numbers in a set or surface are raised, or None if they are those of `own`."""
        name = keyword.options.get("INSTANCE")
        if name is None:
            return None
        number = self._number(self._local(name))
        if number is None:
            raise InputError(f"{keyword.where}: *{keyword.name}: there is no instance '{name}'"
                             f"{did_you_mean(name, [each.name for each in self.instances])}")
        return number * STRIDE

    def own(self, label, kind):
        """Returns the number of a node (kind NSET) or element (ELSET) that is named outside of parts and instances."""
        lowered = label - STRIDE
        known = self.reader.reference_points if kind == "NSET" else self.reader.single_nodes
        return lowered if len(self.instances) > 1 or lowered in known else label

    def entry(self, word):
        """An entry of a set: the raised number of `instance.12`, or a name."""
        before, _, last = self._local(word).rpartition(".")
        if not last.isdigit():
            return word
        number = self._number(before)
        if number is None and self.instances:
            raise ValueError(f"there is no instance '{before}'{did_you_mean(before, [each.name for each in self.instances])}")
        return int(last) + STRIDE * (number or 0)

    def other_names(self, name):
        """Returns further names, in upper case, by which a set may be stored."""
        local = self._local(name).upper()
        if len(self.instances) == 1:
            return [local, f"{self.instances[0].name.upper()}.{local}"]
        return [local] if self.instances else [local.rpartition(".")[2]]

    def _local(self, name):
        """Returns the name without the prefix of the assembly."""
        before, dot, after = name.partition(".")
        return after if dot and before.upper() == self.name.upper() and self._number(before) is None else name

    def told(self, number):
        """Returns the number of a node or element for messages."""
        k, local = divmod(int(number), STRIDE)
        if k < 0:
            return f"{local} of the assembly"
        return f"{local} of instance '{self.instances[k].name}'" if k < len(self.instances) > 1 else str(number)

    # ---- joining ------------------------------------------------------------------------------------------------
    def finish(self):
        """Adds all instances to the reader of the file."""
        if self.open:
            raise InputError(f"{self.open[-1].where}: *{self.open[-1].name} has no *END {self.open[-1].name}")
        if self.parts and not self.instances:
            if len(self.parts) > 1:
                raise InputError(f"the file holds several parts ({', '.join(name for name, _ in self.parts.values())}) and no *INSTANCE of them: export "
                                 "the assembly, or one part")
            name, contents = next(iter(self.parts.values()))
            self.instances.append(_Instance(name, name, "", np.eye(3), np.zeros(3), contents))
        if self.instances and self.reader.points:
            raise InputError("the file holds nodes outside of its parts and instances; they belong to no body")
        used = {each.part.upper() for each in self.instances}
        for key, (name, _) in self.parts.items():
            if key not in used:
                self.reader.notes.append(f"the part '{name}' stands in no instance and is left out")
        self._check_places()
        meshed = [each for each in self.instances if each.contents.points]
        if len(meshed) > 1:
            self.reader.notes.append(f"the body consists of {len(meshed)} instances ({', '.join(each.name for each in meshed)}), whose groups are called "
                                     "`instance.set`")
        for number, each in enumerate(self.instances):
            self._join(number * STRIDE, each, len(meshed) > 1)

    def _check_places(self):
        for k, one in enumerate(self.instances):
            for other in self.instances[:k]:
                if (one.part.upper() == other.part.upper() and one.contents.points and np.array_equal(one.turn, other.turn)
                        and np.array_equal(one.shift, other.shift)):
                    raise InputError(f"{one.where}: the instances '{other.name}' and '{one.name}' of the part '{one.part}' stand in the same place")

    def _join(self, raised, instance, several):
        target, source = self.reader, instance.contents
        base = len(target.points)
        if source.points:
            target.points += (np.array(source.points) @ instance.turn.T + instance.shift).tolist()
        target.numbers.update((label + raised, base + row) for label, row in source.numbers.items())
        for label, (block, row) in source.cell_place.items():
            target.cell_place[label + raised] = (len(target.blocks) + block, row)
        target.blocks += [(kind, labels + raised, nodes + raised) for kind, labels, nodes in source.blocks]
        prefix = instance.name + "."

        def entry(each):
            return each + raised if isinstance(each, int) else (each[0], prefix + each[1]) if isinstance(each, tuple) else each and prefix + each

        def shown(name, taken):
            return prefix + name if several and not name.startswith("_") or name.upper() in taken else name

        for kind, sets in source.sets.items():
            for key, (name, entries) in sets.items():
                target.sets[kind][prefix.upper() + key] = (shown(name, target.sets[kind]), [entry(each) for each in entries])
        for key, (name, kind, entries, where) in source.surfaces.items():
            target.surfaces[prefix.upper() + key] = (shown(name, target.surfaces), kind, [(entry(each), side) for each, side in entries], where)
        target.ties += [Tie(each.name, each.where, [[prefix + name for name in names] for names in each.pairs]) for each in source.ties]
        target.skipped.join(source.skipped)
        target.unknown.join(source.unknown)
        for name, count in source.formulations.items():
            target.formulations[name] = target.formulations.get(name, 0) + count
        target.single_nodes.update((label + raised, (kind, node + raised)) for label, (kind, node) in source.single_nodes.items())
        target.constraints.join(source.constraints, lambda _: Scope(prefix, raised, instance.turn, prefix if several else ""))
        target.notes += [note for note in source.notes if note not in target.notes]
        target.extras.join(source.extras, lambda name: shown(name, target.sets["ELSET"]), instance.is_turned())
