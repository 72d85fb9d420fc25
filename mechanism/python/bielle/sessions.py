"""Sessions of a model."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, MutableMapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core, rotations
from .motions import Motion
from .results import Dataset, NothingKept, Results, made_of
from .yaml_text import yaml_text

if TYPE_CHECKING:
    from .models import Model

_SILENT = _core.Callbacks(None, None)


class Session:
    """A session of a model: assemble it, bring it into equilibrium, move it, read it, save it. Made by `Model.session`.

    Each computation starts from the state in which the previous one ended. Nothing is printed and no file written.

        session.statics(steps=5)
        motion = session.dynamics(duration=2, step=1e-3)
        motion.advance_to(0.5)
        session["nodes/pin/position"], session.measure("main.angle"), session.energy["kinetic"]

    While it computes, other Python threads run; they may compute with other sessions, also of the same model. A session
    serves one thread at a time and raises an Error in others.
    """

    def __init__(self, model: Model, threads: int = 1):
        from .models import Model as KnownModel
        if not isinstance(model, KnownModel):
            raise _core.InputError("a Session is of a Model: model.session(), with a model of bielle.load or bielle.read")
        self._model = model
        self._core = _core.Session(model._core, threads)
        self._on_step: list[Callable[[Session], Any]] = []
        self._on_event: list[Callable[[Session, float, str], Any]] = []

    @property
    def model(self) -> Model:
        """The model of the session."""
        return self._model

    # -- computing

    def assemble(self, *, record: bool = True, **keys: Any) -> Results:
        """Makes positions and velocities consistent: the analysis `assembly`, with its keys (keep=...)."""
        return self.run({"type": "assembly", **keys}, record=record)

    def statics(self, *, steps: int | str | None = None, branch: float | None = None, arc_length: dict | None = None,
                newton: dict | None = None, record: bool = True) -> Results:
        """Equilibrium under the whole load, or along a path: the analysis `static`, with its keys.

        steps: equal increments of the load, or "auto". branch: leaves an equilibrium that becomes unstable.
        arc_length: {"until": {...}, "points": n}, past limit points.
        newton: {"tolerance": ..., "iterations": ..., "line_search": ...}.
        Raises ComputationError if there is none nearby; the session then stays in the last equilibrium.
        """
        return self.run(_given(type="static", steps=steps, branch=branch, arc_length=arc_length, newton=newton), record=record)

    def kinematics(self, duration: float | str, step: float | str, *, record: bool = True) -> Results:
        """Positions, velocities and accelerations of a mechanism whose every motion is driven: the analysis `kinematic`."""
        return self.run({"type": "kinematic", "duration": duration, "step": step}, record=record)

    def inverse_dynamics(self, duration: float | str, step: float | str, *, record: bool = True) -> Results:
        """Does the same and computes the forces of drives and joints that cause the motion: the analysis
        `inverse_dynamics`."""
        return self.run({"type": "inverse_dynamics", "duration": duration, "step": step}, record=record)

    def modes(self, *, count: int | None = None, near: float | None = None, below: float | None = None,
              rotation: Any = None, shapes: bool | None = None, record: bool = True) -> Results:
        """Frequencies, damping and complex shapes of small motions about the state of the session, which does not
        change: the analysis `eigen`, with its keys.

            modes = session.modes(count=6)
            modes["eigen/frequency"], modes["eigen/kind"]
            tip = modes["eigen/nodes"].index("tip")
            modes["eigen/displacement"][0, tip] @ [1, 1j]      # complex amplitudes x y z in the first mode
        """
        return self.run(_given(type="eigen", count=count, near=near, below=below, rotation=rotation, shapes=shapes), record=record)

    def campbell(self, speeds: Any, *, parameter: str | None = None, rotation: Any = None, modes: int | None = None,
                 orders: Sequence[float] | None = None, node: str | None = None, record: bool = True) -> Results:
        """Modes over the speed of a rotor, each followed by its shape, with critical speeds: the analysis `campbell`,
        with its keys. The state of the session does not change.

            found = session.campbell({"from": 0, "to": 300}, parameter="speed")
            found["campbell/speed"], found["campbell/damped_frequency"]       # (speeds), (speeds, modes)
            found.numbers.get("critical_speed", [])                            # [rad/s]

        speeds: {"from": .., "to": .., "count": ..} or a list, of the parameter's values or of the rotation's rates [rad/s].
        """
        return self.run(_given(type="campbell", speeds=speeds, parameter=parameter, rotation=rotation, modes=modes, orders=orders,
                               node=node), record=record)

    def dynamics(self, duration: float | str, step: float | str | None = None, *, tolerance: float | None = None,
                 largest_step: float | None = None, scheme: str | None = None, rho: float | None = None,
                 alpha: float | None = None, constraints: str | None = None, start: str | dict | None = None,
                 newton: dict | None = None, saved: np.ndarray | None = None) -> Motion:
        """A motion from the state of the session, which does not move yet: the analysis `dynamic`, with its keys and
        defaults.

        duration, step: [s]; with a tolerance steps are adaptive and `step` is the first.
        scheme: "generalized_alpha" (rho), "hht" (alpha) or "newmark". constraints: "corrected", "position",
        "stabilized".
        start: "as_given", "equilibrium", or {"equilibrium": True, "hold": ["shaft"]}, which holds coordinates of joints
        while the rest moves to equilibrium. newton: {"tolerance": ..., "tangent": "automatic", "reused" or "renewed",
        ...}.
        saved: a result of `save` in a motion of this model, which the motion continues to the last bit.
        """
        keys = _given(type="dynamic", duration=duration, step=step, tolerance=tolerance, largest_step=largest_step,
                      scheme=scheme, rho=rho, alpha=alpha, constraints=constraints, start=start, newton=newton)
        return Motion(self, self._core.dynamics(yaml_text(keys, "Session.dynamics"), saved, self._callbacks))

    def run(self, analysis: dict | int, *, record: bool = True) -> Results:
        """Runs one analysis from the state of the session.

        analysis: its keys as in a model file, {"type": "static", "steps": 5}, of any type; or the number of one that
        the model lists, from 0.
        record: keeps rows in memory (Results); otherwise only the summary and its numbers.
        """
        if isinstance(analysis, int):
            if not -len(self._model.analyses) <= analysis < len(self._model.analyses):
                raise _core.InputError(f"the model lists {len(self._model.analyses)} analyses; there is no number {analysis}")
            number = analysis % len(self._model.analyses)
            type_ = self._model.analyses[number]
            return self._recorded(record, type_, lambda: self._core.run_listed(number, self._callbacks))
        text = yaml_text(analysis, "Session.run")
        type_ = str(analysis.get("type", ""))
        name = f"analysis {type_}" if type_ else "Session.run"
        return self._recorded(record, type_, lambda: self._core.run_keys(text, name, self._callbacks))

    def _recorded(self, record: bool, type_: str, compute: Callable[[], tuple]) -> Results:
        if not record:
            return Results(NothingKept(type_), 0, compute())
        recorder = self._core.record("", None, None, True)
        try:
            found = compute()
        finally:
            self._core.end_record(recorder)
        return Results(recorder, len(recorder) - 1, found)

    # -- reading

    def __getitem__(self, dataset: str) -> np.ndarray | float:
        """A dataset of the results file as it is now: an array, or a number. Raises InputError with the nearest name.

        "nodes/pin/rotation_vector", "nodes/pin/bryant" and "nodes/pin/euler" are principal values here, without turns.
        """
        quantity, source = made_of(dataset) if isinstance(dataset, str) else ("", dataset)
        value = self._core.read(source)
        return rotations.convert(value, "quaternion", quantity) if quantity else value

    def measure(self, name: str) -> float:
        """The value of a name in formulas: "arm.angle", "arm.angle.rate", "arm.reaction.x", "pin.position.x", or a
        measure, an input or a state of the model. Raises InputError with the nearest name."""
        return self._core.measure(name)

    @property
    def datasets(self) -> dict[str, Dataset]:
        """The readable datasets besides "time": shapes and units by name."""
        return {name: Dataset(*about) for name, about in self._core.datasets().items()}

    @property
    def time(self) -> float:
        """Time [s]."""
        return self._core.time()

    @property
    def moving(self) -> bool:
        """Tells whether a motion is in progress."""
        return self._core.moving()

    def node(self, name: str) -> _core.Node:
        """Position, axes, velocities and accelerations of a node. Raises InputError with the nearest name."""
        return self._core.node(name)

    @property
    def state(self) -> _core.State:
        """A copy of all state variables. Setting it (session.state = changed) ends a motion."""
        return self._core.state()

    @state.setter
    def state(self, state: _core.State) -> None:
        self._core.set_state(state)

    @property
    def energy(self) -> dict[str, float]:
        """[J]: "kinetic", "elastic", "gravity" now; "dissipated" and "input" since the start of the motion."""
        return self._core.energy()

    @property
    def balance(self) -> float:
        """Error of the energy balance [J]."""
        return self._core.balance()

    @property
    def redundant(self) -> list[str]:
        """Redundant constraints that were removed, by joint."""
        return self._core.redundant()

    @property
    def mobility(self) -> dict[str, Any]:
        """The mobility of the model at its start: "degrees" of freedom, "independent" constraints, "nearly_redundant"
        ones by joint."""
        return self._core.mobility()

    @property
    def notes(self) -> list[str]:
        """Messages for the user, each once."""
        return self._core.notes()

    def forget_notes(self) -> None:
        """Clears the messages."""
        self._core.forget_notes()

    # -- inputs and callbacks

    @property
    def inputs(self) -> Inputs:
        """The model's inputs by name: session.inputs["torque"] = 2."""
        return Inputs(self)

    def set_input(self, name: str, value: float, *, smooth: bool = False) -> None:
        """Sets an input of the model to a value that holds from now on. Raises InputError with the nearest name.

        In a motion forces jump, and the motion is restarted with its next step. smooth: the values are samples of a
        smooth function of time, one per step: nothing jumps, and the step needs no restart.
        """
        self._core.set_input(name, value, smooth)

    def stop(self) -> None:
        """Ends the current computation (`finish`, `advance_to`, an analysis) after the current step; for callbacks."""
        self._core.stop()

    def on_step(self, callback: Callable[[Session], Any]) -> Callable[[Session], Any]:
        """Calls callback(session) after each step of a motion and each point of statics. It may read the session, set
        its inputs and stop it; an exception that it raises ends the computation. It can be used as a decorator."""
        self._on_step.append(callback)
        return callback

    def on_event(self, callback: Callable[[Session, float, str], Any]) -> Callable[[Session, float, str], Any]:
        """Calls callback(session, time, name) for each crossing of a motion, after the step that ends on it."""
        self._on_event.append(callback)
        return callback

    def remove_callback(self, callback: Callable) -> None:
        """Removes a callback."""
        for callbacks in (self._on_step, self._on_event):
            while callback in callbacks:
                callbacks.remove(callback)

    @property
    def _callbacks(self) -> _core.Callbacks:
        if not self._on_step and not self._on_event:
            return _SILENT
        return _core.Callbacks(self._step if self._on_step else None, self._event if self._on_event else None)

    def _step(self) -> None:
        for callback in tuple(self._on_step):
            callback(self)

    def _event(self, time: float, name: str) -> None:
        for callback in tuple(self._on_event):
            callback(self, time, name)

    # -- saving

    def save(self) -> np.ndarray:
        """All numbers that the session needs to continue."""
        return self._core.save()

    def restore(self, saved: np.ndarray) -> None:
        """Restores a saved state, of this session or another one of the same model, to the last bit.

        A state that was saved in a motion needs a motion in progress, or `dynamics(..., saved=saved)`.
        """
        self._core.restore(saved)

    # -- recording

    def record(self, output: str | os.PathLike | None = None, *, every: int | None = None,
               times: Sequence[float] | None = None, memory: bool = True) -> Recording:
        """Records the computations in a `with` block, each analysis and motion separately.

            with session.record() as recording:
                session.dynamics(duration=2, step=1e-3).finish()
            recording[-1]["joints/main/coordinate"]

        output: a results file to write as well, which is complete at the end of the block. every, times: recorded rows
        of motions; as the model's `output` says, unless given. memory: rows are kept in memory, not only written to a
        file.
        """
        return Recording(self, output, every, times, memory)

    def __repr__(self) -> str:
        return f"<bielle.Session of {self._model!r} at t = {self.time:.6g} s>"


class Inputs(MutableMapping):
    """The inputs of a session by name: inputs["torque"] = 2 sets (Session.set_input), inputs["torque"] reads."""

    def __init__(self, session: Session):
        self._session = session

    def __setitem__(self, name: str, value: float) -> None:
        self._session._core.set_input(name, value, False)

    def __getitem__(self, name: str) -> float:
        if name not in self._session.model.inputs:
            raise _core.InputError(f"there is no input '{name}'{_core.did_you_mean(name, list(self))}")
        return self._session._core.measure(name)

    def __delitem__(self, name: str) -> None:
        raise TypeError("inputs belong to the model and stay")

    def __iter__(self) -> Iterator[str]:
        return iter(self._session.model.inputs)

    def __len__(self) -> int:
        return len(self._session.model.inputs)

    def __contains__(self, name: object) -> bool:
        return name in self._session.model.inputs

    def __repr__(self) -> str:
        return f"<bielle.Inputs {dict(self)}>"


class Recording(Sequence):
    """The records of a block of `Session.record`: Results of one analysis or motion after the other."""

    def __init__(self, session: Session, output: str | os.PathLike | None, every: int | None,
                 times: Sequence[float] | None, memory: bool):
        self._session = session
        self._arguments = ("" if output is None else os.fspath(output), every,
                           None if times is None else [float(time) for time in times], memory)
        self._recorder: _core.Recorder | None = None

    def __enter__(self) -> Recording:
        if self._recorder:
            raise _core.Error("a recording is made once: ask the session for another one")
        self._recorder = self._session._core.record(*self._arguments)
        return self

    def __exit__(self, *_: object) -> None:
        self._session._core.end_record(self._recorder)

    def __len__(self) -> int:
        return len(self._recorder) if self._recorder else 0

    def __getitem__(self, number):
        if isinstance(number, slice):
            return [self[k] for k in range(*number.indices(len(self)))]
        if not -len(self) <= number < len(self):
            raise IndexError(f"{len(self)} analyses are recorded")
        return Results(self._recorder, number % len(self))


def _given(**keys: Any) -> dict[str, Any]:
    return {key: value for key, value in keys.items() if value is not None}
