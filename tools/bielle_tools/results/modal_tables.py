"""Tables of the analyses of small motions: modes of `eigen`, modes over the speed of `campbell`, responses of `frequency_response`.

A table is a pair (heads, lines). A cell is a text, a whole number or a float, and empty where the analysis found no number
(a mode that was lost, a whirl without a sense). One line belongs to one mode, one mode at one speed, or one input and output at one frequency.
"""

import numpy as np

from ..messages import InputError
from .results_file import WITHOUT_ROWS, reading

EIGEN = ["mode", "name", "kind", "frequency [Hz]", "damped frequency [Hz]", "damping ratio"]
CAMPBELL = ["parameter", "value", "speed [rad/s]", "mode", "name", "frequency [Hz]", "damped frequency [Hz]", "damping ratio", "whirl"]
RESPONSE = ["frequency [Hz]", "output", "input", "amplitude", "phase [rad]", "real part", "imaginary part"]
NUMBERS_OF_MODES = ("frequency", "damped_frequency", "damping_ratio")


def mode_tables(results):
    """{`eigen` or `campbell`: table} of the modes that results hold. @raises InputError if there are none"""
    makers = {"eigen": _eigen, "campbell": _campbell}
    found = {kind: make(results) for kind, make in makers.items() if results.has(f"{kind}/frequency")}
    if not found:
        raise InputError(f"'{results.path}' holds no modes: an analysis 'eigen' or 'campbell' finds them")
    return found


def response_table(results):
    """Table of a frequency response; the phase is between -pi and pi. @raises InputError if there is none"""
    if not results.has("frequency_response/response"):
        raise InputError(f"'{results.path}' holds no frequency response: an analysis 'frequency_response' computes it")
    frequency = _numbers(results, "frequency_response/frequency")
    outputs, inputs = (_texts(results, f"frequency_response/{name}") for name in ("outputs", "inputs"))
    parts = _numbers(results, "frequency_response/response")
    if frequency.ndim != 1 or parts.shape != (len(frequency), len(outputs), len(inputs), 2):
        raise _damaged(results, "frequency_response")
    response = parts[..., 0] + 1j * parts[..., 1]
    return RESPONSE, [[_cell(frequency[k]), output, given, *map(_cell, (abs(H), np.angle(H), H.real, H.imag))]
                      for k in range(len(frequency)) for i, output in enumerate(outputs) for j, given in enumerate(inputs)
                      for H in (response[k, i, j],)]


def listed_datasets(results):
    """(place, whole shape, units, description) of each dataset of the analyses without rows."""
    for kind in WITHOUT_ROWS:
        for name in results.datasets(kind) if results.has(kind) else []:
            place = f"{kind}/{name}"
            with reading(results.path, place):
                shape = results.root[place].shape
            yield place, shape, results.units(place), results.text(place, "description")


def _eigen(results):
    numbers = [_numbers(results, f"eigen/{name}") for name in NUMBERS_OF_MODES]
    count = numbers[0].size
    if any(values.shape != (count,) for values in numbers):
        raise _damaged(results, "eigen")
    names, kinds = (_texts(results, f"eigen/{name}", count) for name in ("name", "kind"))
    return EIGEN, [[k + 1, names[k], kinds[k], *(_cell(values[k]) for values in numbers)] for k in range(count)]


def _campbell(results):
    speed, value = (_numbers(results, f"campbell/{name}") for name in ("speed", "value"))
    numbers = [_numbers(results, f"campbell/{name}") for name in (*NUMBERS_OF_MODES, "whirl")]
    shape = numbers[0].shape
    if len(shape) != 2 or speed.shape != shape[:1] or value.shape != shape[:1] or any(values.shape != shape for values in numbers):
        raise _damaged(results, "campbell")
    names, parameter = _texts(results, "campbell/name", shape[1]), _texts(results, "campbell/parameter", 1)
    return CAMPBELL, [[*parameter, _cell(value[v]), _cell(speed[v]), k + 1, names[k], *(_cell(values[v, k]) for values in numbers)]
                      for v in range(shape[0]) for k in range(shape[1])]


def _numbers(results, place):
    found = results.array(place)
    if found.dtype.kind not in "fiu":
        raise _damaged(results, place, "it holds no numbers")
    return found


def _cell(number):
    return float(number) + 0.0 if np.isfinite(number) else ""  # no -0.0


def _texts(results, place, count=None):
    """The texts of a dataset; `count` empty ones if an older program did not write it."""
    if count is not None and not results.has(place):
        return [""] * count
    with reading(results.path, place):
        found = results.root[place].asstr()[:]
    if found.ndim != 1 or count is not None and len(found) != count:
        raise _damaged(results, place)
    return found.tolist()


def _damaged(results, place, reason="the sizes of its datasets do not fit together"):
    return InputError(f"'{results.path}': '{place}' is damaged: {reason}")
