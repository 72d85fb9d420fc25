"""The motions of a results file that the page shows: analyses with rows, and modes over a period."""

import numpy as np

from ..messages import InputError, note
from ..results.modes import Modes, ModeMotion, ModeScenery
from ..results.results_file import Results, open_hdf5, reading

PHASES = 36
MOST_MODES = 20
PLOTTED = ("campbell", "frequency_response")  # groups that only figures show


class Sequence:
    """title; kind: time, load, state (one row) or mode; motion: what a scene is made of; rows; times of the rows; facts for the page."""

    def __init__(self, title, kind, motion, rows, times, **facts):
        self.title, self.kind, self.motion, self.rows, self.times, self.facts = title, kind, motion, rows, times, facts


def sequences(path, frames, superelements, analysis=None):
    """(sequences, results to close) of a file. frames: largest number of rows of one. @raises InputError"""
    with open_hdf5(path, "bielle results", "results of bielle-mechanism") as file, reading(path, "/"):
        groups = {name: (_type(file[name]), len(file[name].get("time", ())), "eigen" in file[name])
                  for name in file if name.startswith("analysis_") and name[9:].isdigit()}
    numbers = sorted(int(name[9:]) for name in groups) if analysis is None else [analysis]
    found, opened = [], []
    for number in numbers:
        kind, rows, modal = groups.get(f"analysis_{number}", ("", 0, False))
        if rows or modal or analysis is not None:
            results = Results(path, number)
            opened.append(results)
            if len(results.time):
                found.append(_motion(results, f"{number}. {kind or 'analysis'}", frames))
            if modal:
                found += _modes(results, superelements, f"{number}. ")
    if not found and not any(rows or modal for _, rows, modal in groups.values()):
        results = Results(path)
        opened.append(results)
        if len(results.time):
            found.append(_motion(results, "motion", frames))
    if not found:
        plotted = [name for name in PLOTTED if any(results.has(name) for results in opened)]
        raise InputError(f"'{path}' holds no motion, state or shapes of modes to show" + (f": bielle-plot draws its '{plotted[0]}'" if plotted else ""))
    return found, opened


def _type(group):
    value = group.attrs.get("type", "")
    return value.decode() if isinstance(value, bytes) else str(value)


def _motion(results, title, frames):
    rows = np.asarray(results.frames(count=frames)) if len(results.time) > 1 else np.arange(len(results.time))
    kind = "state" if len(rows) == 1 else "load" if results.static else "time"
    return Sequence(title, kind, results, rows, results.time[rows])


def _modes(results, superelements, prefix):
    modes = Modes(results)
    if modes.displacement is None:
        note(f"{results.path}: modes are left out: the analysis has 'shapes: false'")
        return []
    try:
        scenery = ModeScenery(modes, superelements)
    except InputError as error:
        note(f"modes are left out: {error}")
        return []
    if len(modes) > MOST_MODES:
        note(f"{results.path}: the first {MOST_MODES} of {len(modes)} modes are shown")
    found = []
    for number in range(1, min(len(modes), MOST_MODES) + 1):
        motion = ModeMotion(scenery, number, PHASES)
        motion.factor, motion.time = np.append(motion.factor, 0), np.append(motion.time, motion.period)  # the last row is the state itself
        s = modes.s[number - 1]
        found.append(Sequence(prefix + modes.named(number), "mode", motion, np.arange(PHASES + 1), np.append(np.arange(PHASES) / PHASES, 1.0),
                              decay=float(s.real * motion.period) if s.imag else 0.0, frequency=float(modes.frequency[number - 1])))
    return found
