"""Facts about a run: keys of entries in the input file, events."""

from ..results.model_text import entries_of

LONGEST = 160  # characters of a value


def keys_of(results):
    """{entry: [[key, value as written]]} of the model, in which parts and repetitions are written out."""
    return {place: [[str(key), _written(value)] for key, value in entry.items()] for place, entry in entries_of(results).items()}


def _written(value):
    text = "{" + ", ".join(f"{key}: {_written(each)}" for key, each in value.items()) + "}" if isinstance(value, dict) else \
        "[" + ", ".join(map(_written, value)) + "]" if isinstance(value, list) else str(value)
    return text if len(text) <= LONGEST else text[:LONGEST] + ".."


def events_of(results):
    """[[time, name]] of the crossings of a dynamic analysis."""
    try:
        if "events" not in results.root:
            return []
        names = results.text_of("crossings").splitlines()
        group = results.root["events"]
        return [[float(time), names[int(which)] if 0 <= int(which) < len(names) else "event"]
                for time, which in zip(group["time"][:2000], group["crossing"][:2000])]
    except (KeyError, OSError, TypeError, ValueError, AttributeError, RuntimeError):
        return []
