"""Places on superelements as quantities name them: interfaces and named points, numbers of mesh nodes, `0.1 0 0.02`."""

import h5py
import numpy as np

from ..bodies.superelement_body import decoded, interfaces_of
from ..messages import InputError, did_you_mean, note, place as shown
from ..results.results_file import LARGEST, reading


def place_of(bodies, element, word):
    """Place (3) of a gauge or section, body axes."""
    body, point = bodies.body(element), _points(bodies, element).get(word)
    if point is not None:
        return point[0]
    if word.isdecimal():
        if int(word) >= len(body.points):
            raise InputError(f"'{element}' has no node {word}: those of its mesh are 0 to {len(body.points) - 1}")
        return body.points[int(word)]
    place = three_numbers(word)
    if place is None:
        near = did_you_mean(word, list(_points(bodies, element)))
        raise InputError(f"'{element}' has no point '{word}'{near}; a gauge or section is at a named point, at the number "
                         "of a mesh node, or at a place 'x y z' [m]")
    return place


def point_of(bodies, element, word):
    """Place of a point and its displacement (3,n) per coordinate, body axes."""
    body = bodies.body(element)
    named = _named_points(bodies, element)
    if word in named:
        position, u = named[word]
        if u is None:
            raise InputError(f"the interface '{word}' of '{element}' does not keep its translations: it has no "
                             "displacement of its own")
        return position, u
    row = _mesh_row(body, word)
    if row is None:
        raise InputError(f"'{element}' has no interface or point '{word}'{did_you_mean(word, list(named))}")
    return body.points[body.displaced[row]], body.displacement[3 * row:3 * row + 3]


def _named_points(bodies, element):
    """{name: (place, displacement (3,n) per coordinate)} of interfaces and points; None for a displacement that the
    file does not have."""
    path, group = bodies.path(element), bodies.results.text(f"elements/{element}", "group")
    count, found = bodies.body(element).displacement.shape[1], _points(bodies, element)
    with reading(path, "interface"), h5py.File(path, "r") as opened:
        file = opened[group] if group else opened
        has_interfaces = "interface" in file
        positions = np.asarray(file["interface/positions"], float) if has_interfaces else ()
    begin = 0
    for (name, kept, R), X in zip(interfaces_of(path, group) if has_interfaces else (), positions):
        u = np.zeros((3, count)) if kept[:3].all() and begin + 3 <= count else None
        if u is not None:
            u[:, begin:begin + 3] = R
        found[name] = X.reshape(3), u
        begin += int(kept.sum())
    return found


def _points(bodies, element):
    """The same of the named points alone."""
    path, group = bodies.path(element), bodies.results.text(f"elements/{element}", "group")
    count, found = bodies.body(element).displacement.shape[1], {}
    with reading(path, "points"), h5py.File(path, "r") as opened:
        file = opened[group] if group else opened
        for name, point in file["points"].items() if "points" in file else ():
            place, shapes = (np.asarray(point[field], float) for field in ("position", "shapes"))
            found[decoded(name)] = place.reshape(3), shapes[:3].reshape(3, count)
    return found


def three_numbers(text):
    """Three numbers of a text, less than 1e100, or None."""
    try:
        numbers = np.array([float(each) for each in text.split()])
    except ValueError:
        return None
    return numbers if len(numbers) == 3 and np.all(np.abs(numbers) < LARGEST) else None


def _mesh_row(body, word):
    """Row of the recovery of a node by number or place; None if the word is neither, or there is no such node."""
    numbers = three_numbers(word)
    if numbers is not None and len(body.displaced):
        distances = np.linalg.norm(body.points[body.displaced] - numbers, axis=1)
        row = int(distances.argmin())
        if distances[row] > 1e-6 * np.ptp(body.points, axis=0).max():
            note(f"the node nearest to {shown(numbers)} is {distances[row]:.3g} m away, at "
                 f"{shown(body.points[body.displaced[row]])}")
        return row
    found = np.flatnonzero(body.displaced == int(word)) if word.isdecimal() else []
    return int(found[0]) if len(found) else None
