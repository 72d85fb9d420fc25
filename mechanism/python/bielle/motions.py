"""Motions in progress."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from . import _core

if TYPE_CHECKING:
    from .sessions import Session


class Motion:
    """A motion, made by `Session.dynamics` and moved on step by step.

        for motion in session.dynamics(duration=2, step=1e-3):
            ...                                             # after each step
        motion.advance_to(0.5); motion.finish()

    Its session shows its state: session["joints/main/coordinate"]. It ends when the session starts something else: it
    can still be read then, but not continued (Error). Ctrl-C takes effect after the current step; the motion stays
    there and may be continued.
    """

    def __init__(self, session: Session, core: _core.Motion):
        if not isinstance(core, _core.Motion):
            raise _core.InputError("a Motion is made by Session.dynamics")
        self._core = core
        self._session = session

    def step(self) -> bool:
        """Takes a step. With fixed steps, there may be smaller ones between two times of the grid. Returns False if no
        step is left.

        Raises ComputationError if it fails; the motion then stays in the state before the step.
        """
        return self._core.step(self._session._callbacks)

    def advance_to(self, time: float) -> bool:
        """Steps until the time [s] is reached: exactly if it is on the grid of steps, otherwise beyond it by less than
        a step. Returns False if a callback stopped it, or the motion ended before."""
        return self._core.advance_to(time, self._session._callbacks)

    def finish(self) -> bool:
        """Steps to the end. Returns False if a callback stopped it."""
        return self._core.finish(self._session._callbacks)

    def __iter__(self) -> Iterator[Motion]:
        """Yields the motion after each of the remaining steps."""
        step, callbacks = self._core.step, self._session._callbacks
        while step(callbacks):
            yield self
            callbacks = self._session._callbacks

    @property
    def session(self) -> Session:
        """The session to which it belongs."""
        return self._session

    @property
    def time(self) -> float:
        """Time [s]."""
        return self._core.time()

    @property
    def begin(self) -> float:
        """Start time [s]."""
        return self._core.begin()

    @property
    def end(self) -> float:
        """End time [s]."""
        return self._core.end()

    @property
    def done(self) -> bool:
        """Whether no step is left: the end is reached, or an event has stopped the motion."""
        return self._core.done()

    @property
    def stopped_by_event(self) -> bool:
        """Whether an event of the model has stopped it."""
        return self._core.stopped_by_event()

    @property
    def last_event(self) -> str:
        """Name of the last crossing; empty if there was none."""
        return self._core.last_event()

    @property
    def balance(self) -> float:
        """Error of the energy balance [J]."""
        return self._core.balance()

    @property
    def log(self) -> dict[str, int | float | str]:
        """Cost of the steps: "steps", "iterations", "factorisations", refused steps with the reasons."""
        return self._core.log()

    @property
    def start(self) -> str:
        """Changes made by the consistent start, as lines; empty if there are none."""
        return self._core.start()

    @property
    def state(self) -> _core.State:
        """A copy of its state."""
        return self._core.state()

    def interpolated(self, time: float) -> _core.State:
        """The state at a time within the last step [s]."""
        return self._core.interpolated(time)

    def __repr__(self) -> str:
        return f"<bielle.Motion at t = {self.time:.6g} s of {self.end:.6g} s>"
