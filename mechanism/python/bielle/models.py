"""Models, read from a file, a text or a dictionary."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from . import _core
from .assemblies import Assembly
from .yaml_text import yaml_text

if TYPE_CHECKING:
    from .runs import Run
    from .sessions import Session

Parameters = Mapping[str, "float | str"]


def load(path: str | os.PathLike, parameters: Parameters | None = None) -> Model:
    """Reads a model file.

    parameters: values of the file's `parameters`, numbers or formulas, in place of those in the file (as `--set` does).
    Raises InputError with file, line and key.
    """
    return Model._of(_core.Model.read_file(os.fspath(path), _overrides(parameters)))


def read(model: str | Mapping[str, Any], parameters: Parameters | None = None, *, name: str = "model",
         folder: str | os.PathLike | None = None) -> Model:
    """Reads a model from a YAML text or from a dictionary with the same names and keys as a file.

    In a dictionary numbers may be those of NumPy, lists tuples and arrays; formulas are texts. Numbers are passed to
    the last bit.
    parameters: as for `load`.
    name: stands for the file in messages.
    folder: the folder of relative file names in the model; the working folder, unless given.
    Raises InputError; for a dictionary with the path of the key, for a text with its line as well.
    """
    place = os.path.join(os.fspath(folder), name) if folder is not None else name
    if isinstance(model, os.PathLike) or isinstance(model, str) and model.endswith((".yaml", ".yml")):
        raise _core.InputError(f"{name}: '{os.fspath(model)}' is the name of a file, which bielle.load reads")
    if isinstance(model, str):
        return Model._of(_core.Model.read_text(model, place, True, _overrides(parameters)))
    given = dict(model) if isinstance(model, Mapping) else model
    return Model._of(_core.Model.read_text(yaml_text(given, place), place, False, _overrides(parameters)))


def _overrides(parameters: Parameters | None) -> dict[str, str]:
    def text(value: float | str) -> str:
        return value if isinstance(value, str) else repr(float(value))

    return {name: text(value) for name, value in (parameters or {}).items()}


class Model(Assembly):
    """The description of a mechanism. Any number of sessions may share it.

    One that `load` or `read` has made is never changed. `bielle.Model("title")` is empty: its methods add the entries,
    which are read when the model is first used. A change after that makes a new model for later sessions.
    """

    def __init__(self, title: str | None = None, gravity: Sequence[float] | None = None, *,
                 folder: str | os.PathLike | None = None):
        """title: of the mechanism. gravity: [m/s^2]. folder: of relative file names; the working folder, unless given."""
        super().__init__()
        if not (title is None or isinstance(title, str)):
            raise _core.InputError("expected a title; bielle.load reads a file, bielle.read a text or a dictionary")
        if title is not None:
            self._sections["mechanism"] = title
        if gravity is not None:
            self._sections["gravity"] = gravity
        self._folder = folder
        self._made: _core.Model | None = None
        self._is_read = False

    @classmethod
    def _of(cls, core: _core.Model) -> Model:
        model = cls()
        model._made, model._is_read = core, True
        return model

    @property
    def _core(self) -> _core.Model:
        if self._made is None:
            self._made = read(self.to_dict(), folder=self._folder)._made
        return self._made

    def _change(self) -> None:
        if self._is_read:
            raise _core.InputError("a model that was read is not changed; bielle.Model() makes one that can be")
        self._made = None

    def to_yaml(self) -> str:
        """The text of a file with the same entries; for a model that was read its `text`."""
        return self.text if self._is_read else super().to_yaml()

    def session(self, threads: int = 1) -> Session:
        """Makes a session of the model.

        threads: number of threads for costly components; results do not depend on it.
        """
        from .sessions import Session
        return Session(self, threads)

    def run(self, output: str | os.PathLike | None = None, **options: Any) -> Run:
        """Runs all analyses of the model: see `bielle.run`."""
        from .runs import run
        return run(self, output, **options)

    def describe(self) -> str:
        """The output of `bielle-mechanism --check`: counts, degrees of freedom, and the values of every entry."""
        return self._core.describe()

    @property
    def title(self) -> str:
        """The key `mechanism`."""
        return self._core.title

    @property
    def text(self) -> str:
        """The YAML text; for a dictionary the text that was made of it."""
        return self._core.text

    @property
    def path(self) -> str:
        """Path of the file; empty if there is none."""
        return self._core.path

    @property
    def parameters(self) -> dict[str, float]:
        """Values of the parameters, including the given ones."""
        return self._core.parameters

    @property
    def warnings(self) -> list[str]:
        """Messages about values that are possible but probably unintended."""
        return self._core.warnings

    @property
    def nodes(self) -> list[str]:
        """Names of all nodes in the order of a State: the ground, those of the model, those inside of elements."""
        return self._core.nodes

    @property
    def inputs(self) -> list[str]:
        """Names of the inputs."""
        return self._core.inputs

    @property
    def entries(self) -> dict[str, list[str]]:
        """Names in the sections `elements`, `joints`, `drives`, `loads`, `states`, `measures`, `hydraulics`."""
        return self._core.entries

    @property
    def analyses(self) -> list[str]:
        """Types of the analyses that the model lists."""
        return self._core.analyses

    def __repr__(self) -> str:
        return f"<bielle.Model {self.title or self.path or 'without a title'!r}>"
