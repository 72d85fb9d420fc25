"""Mechanisms and parts that are put together by calls, in place of a file."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from ._core import InputError, did_you_mean
from .entries import Entries
from .yaml_text import yaml_text

_SECTIONS = ["parameters", "nodes", "points", "elements", "joints", "drives", "loads", "states", "measures", "inputs",
             "events", "hydraulics", "parts", "definitions"]


class Assembly(Entries):
    """A part of a mechanism, or the mechanism itself: sections with entries as in a file.

    Methods named like the types of elements, joints and analyses add an entry each; `add` adds an entry of any section.
    A key that is a word of Python has a `_` behind it (`from_`), a key that is None is left out.
    """

    def __init__(self) -> None:
        self._sections: dict[str, Any] = {}

    def add(self, section: str, name: str | None, entry: Any) -> None:
        """Adds an entry to a section of the file.

        section: "nodes", "joints", ..; "analysis", whose entries have no names (None).
        entry: the keys with their values, as in a file.
        """
        self._change()
        value = _without_none(entry)
        if section == "analysis":
            self._sections.setdefault(section, []).append(value)
            return
        if section not in _SECTIONS:
            raise InputError(f"'{section}' is not a section with entries" + did_you_mean(section, _SECTIONS))
        entries = self._sections.setdefault(section, {})
        if name in entries:
            raise InputError(f"there are two entries '{name}' in the section '{section}'")
        entries[name] = value

    def parameter(self, name: str, value: float | str) -> None:
        """Names a number for formulas; a formula may use the parameters before it."""
        self.add("parameters", name, value)

    def node(self, name: str, position: Sequence[Any] | None = None, **keys: Any) -> None:
        """Adds a point with axes, which move. position: [m], the origin unless given."""
        self.add("nodes", name, {"position": position, **keys})

    def drive(self, name: str, **keys: Any) -> None:
        """Adds a drive: a motion, a force or a control of a joint."""
        self.add("drives", name, keys)

    def load(self, name: str, **keys: Any) -> None:
        """Adds a force and a moment on a node."""
        self.add("loads", name, keys)

    def state(self, name: str, **keys: Any) -> None:
        """Adds a differential equation or a control block."""
        self.add("states", name, keys)

    def measure(self, name: str, formula: str | None = None, **keys: Any) -> None:
        """Names a quantity of the state: a formula, or the keys of the measure of a node."""
        self.add("measures", name, keys if keys else formula)

    def event(self, name: str, **keys: Any) -> None:
        """Adds an event: a quantity crosses a value."""
        self.add("events", name, keys)

    def part(self, name: str) -> Assembly:
        """Defines a part, which `place` puts into the mechanism, and returns it empty."""
        part = Assembly()
        self.add("definitions", name, part)
        return part

    def place(self, name: str, part: str | None = None, **keys: Any) -> None:
        """Places a part that is defined here, or in a `file`; its names are then `name.node` and so on.

        at: node in whose axes it is placed; position and an orientation: its place in these axes
        mirror: "x", "y" or "z", the normal of the plane in which it is mirrored first
        parameters: values of its parameters; merge: its nodes that are nodes of this model
        """
        self.add("parts", name, {"part": part, **keys})

    def to_dict(self) -> dict[str, Any]:
        """The sections with their entries, as `bielle.read` takes them."""
        return {section: ({name: _plain(entry) for name, entry in entries.items()} if isinstance(entries, dict)
                          else entries)
                for section, entries in self._sections.items()}

    def to_yaml(self) -> str:
        """The text of a file with the same entries."""
        return yaml_text(self.to_dict(), "model")

    def _change(self) -> None:
        """Called before each change."""


def _plain(entry: Any) -> Any:
    return entry.to_dict() if isinstance(entry, Assembly) else entry


def _keys(keys: Mapping[str, Any]) -> dict[str, Any]:
    return {name[:-1] if name.endswith("_") else name: value for name, value in keys.items()}


def _without_none(entry: Any) -> Any:
    if not isinstance(entry, Mapping):
        return entry
    return {key: value for key, value in _keys(entry).items() if value is not None}
