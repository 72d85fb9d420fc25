"""Times in which entries of a model act: events release and activate them, and an analysis may begin with some of them released."""

import re

import h5py
import numpy as np

from .model_text import entries_of

RELEASABLE = ("joints", "elements", "drives", "loads")
ACTION = re.compile(r"(releases|activates) '([^']+)'")


class Activity:
    """The activity of the entries of an open results file over its rows."""

    def __init__(self, results):
        """results: an analysis of a file, or the last state of each group"""
        self._time = results.time
        self._starts = {place.partition("/")[2]: False for place, entry in entries_of(results).items()
                        if place.partition("/")[0] in RELEASABLE and entry.get("active") == "false"}
        self._changes = {}
        for number, group in _analyses_until(results):
            if number is None and "released" in group.attrs:  # files of earlier versions do not have it
                paths = str(group.attrs["released"]).splitlines()
                self._starts = {path.partition("/")[2]: False for path in paths if path.partition("/")[0] in RELEASABLE}
            for time, acts, name in _actions(results, group):
                if number is None:
                    self._changes.setdefault(name, []).append((time, acts))
                else:
                    self._starts[name] = acts

    def acts(self, entry):
        """(rows) whether the entry `joints/rope` acts; None if it always does. A row at the time of an event has the
        state after it."""
        section, _, name = entry.partition("/")
        if section not in RELEASABLE or (name not in self._changes and self._starts.get(name, True)):
            return None
        found = np.full(len(self._time), self._starts.get(name, True))
        for time, acts in self._changes.get(name, []):
            found[self._time >= time] = acts
        return found


def _analyses_until(results):
    """(number, group) of the analyses before that of the rows, then (None, group) of this one."""
    groups = {int(name[9:]): results.file[name] for name in results.file if name.startswith("analysis_") and name[9:].isdigit()}
    for number, group in sorted(groups.items()):
        if not isinstance(group, h5py.Group):
            continue
        own = group == results.root or "time" in group and "time" in results.root and group["time"] == results.root["time"]
        yield (None if own else number), group
        if own:
            return


def _actions(results, group):
    """(time, whether it acts then, name of the entry) of the events of an analysis."""
    try:
        names = results.text_of("crossings").splitlines()
        events = group["events"] if "events" in group else {"time": [], "crossing": []}
        crossings = list(zip(events["time"][:], events["crossing"][:]))
    except (KeyError, OSError, TypeError, ValueError, AttributeError, RuntimeError):
        return
    for time, which in crossings:
        words = names[int(which)] if 0 <= int(which) < len(names) else ""
        for action, name in ACTION.findall(words.partition("': ")[2]):
            yield float(time), action == "activates", name
