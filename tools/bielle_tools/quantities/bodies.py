"""Quantities of superelements that are not recorded, but follow from what is: their motion and their files.

    arm.von_mises                         von Mises stress at the stress nodes of the mesh
    arm.radiated_power                    equivalent radiated power of its surface, see radiated_power.py
    arm.radiated_power_elastic            the same of the elastic deformation alone, without the motion of the frame
    arm.deflection(POINT, A, B)           displacement x y z of a point relative to the chord from A to B, body axes
    arm.gauge(PLACE, DIRECTION)           strain of the surface at a place, see gauges.py
    arm.rosette(PLACE, DIRECTION, KIND)   strains a b c of three gauges, principal strains and their direction
    arm.section(PLACE, NORMAL)            force and moment in the section by a plane, see section_forces.py

POINT, A and B are interfaces or named points of the superelement, numbers of mesh nodes, or places `0.1 0 0.02` [m];
PLACE is a named point, a number or a place, DIRECTION and NORMAL `1 0 0` in body axes.
"""

import numpy as np

from ..bodies.superelement_body import find_superelement, interfaces_of, superelement_of
from ..messages import InputError
from .body_places import place_of, point_of, three_numbers

MADE = {"von_mises": ("Pa", "von Mises stress, recovered from the superelement"),
        "radiated_power": ("W", "equivalent radiated power of the surface in air"),
        "radiated_power_elastic": ("W", "equivalent radiated power of the surface in air by the deformation alone"),
        "deflection": ("m", "displacement relative to a chord, body axes, say deflection(POINT, A, B): x, y, z"),
        "gauge": ("-", "strain of the surface along a direction, say gauge(PLACE, DIRECTION)"),
        "rosette": ("-, -, -, -, -, rad", "strains of the surface in three directions, principal ones and the angle of "
                    "the largest from the first direction, say rosette(PLACE, DIRECTION, KIND): a, b, c, largest, least, angle"),
        "section": ("N, N m", "force and moment about a place on the part behind the plane through it, body axes, "
                    "say section(PLACE, NORMAL): x, y, z, rx, ry, rz")}
COLUMNS = {"deflection": 3, "rosette": 6, "section": 6}


def has_body(results, element):
    """Tells whether an element of the results names a superelement file."""
    return bool(results.text(f"elements/{element}", "file"))


class Bodies:
    """The superelements of open results, each read once. given: {element: path} of --superelement"""

    def __init__(self, results, given=None):
        self.results, self.given, self._bodies, self._powers, self._strains = results, given or {}, {}, {}, {}
        self._loaded, self._sections = {}, {}

    def body(self, element):
        if element not in self._bodies:
            self._bodies[element] = superelement_of(self.results, element, self.given)
        return self._bodies[element]

    def path(self, element):
        return find_superelement(self.results, element, self.given)

    def needs(self, element, field):
        """The datasets of which a quantity is made."""
        own = [f"elements/{element}/{name}" for name in ("frame", "coordinates")]
        if field != "section":
            return own
        interfaces = interfaces_of(self.path(element), self.results.text(f"elements/{element}", "group"))
        nodes = [self.results.text(f"elements/{element}", f"interface {name}") for name, _, _ in interfaces]
        return [*own, f"elements/{element}/interface_force",
                *(f"nodes/{node}/{name}" for node in nodes for name in ("rotation", "velocity"))]

    def columns(self, element, field):
        """Number of columns of a quantity that is made."""
        if field == "von_mises":
            if self.body(element).stress is None:
                raise InputError(f"'{self.path(element)}' keeps no stress: set 'recovery: {{stress: surface}}' in its "
                                 "body file and reduce it again")
            return len(self.body(element).stressed)
        return COLUMNS.get(field, 1)

    def read(self, element, field, rows, arguments=()):
        """Values (rows, columns) of a quantity. arguments: the words of `deflection(..)`. @raises InputError"""
        if arguments and field not in ("deflection", "gauge", "rosette", "section"):
            raise InputError(f"{element}.{field} takes no words in brackets")
        if field == "von_mises":
            body, q = self.body(element), self._coordinates(element, rows)
            parts = [body.von_mises(q[block])[:, body.stressed] for block in body.blocks(np.arange(len(q)))]
            return np.concatenate(parts) if parts else np.zeros((0, len(body.stressed)))
        if field == "deflection":
            return self._deflection(element, self._coordinates(element, rows), arguments)
        if field in ("gauge", "rosette"):
            return self._gauges(element, field, self._coordinates(element, rows), arguments)
        if field == "section":
            section = self._section(element, arguments)
            return np.array([section.at(row) for row in range(len(self.results.time))[rows]]).reshape(-1, 6)
        return self._power(element, field == "radiated_power_elastic")[rows, None]

    def _coordinates(self, element, rows):
        return self.results.rows(f"elements/{element}/coordinates", rows)

    def _power(self, element, elastic):
        if (element, elastic) not in self._powers:
            from ..bodies.radiated_power import IMPEDANCE, body_form, body_velocities  # SciPy takes a while
            form = IMPEDANCE * body_form(self.body(element), self.path(element))
            if len(self.results.time) < 2:
                raise InputError(f"'{self.results.path}' has one time only: velocities need several")
            everything = slice(0, len(self.results.time))
            frame = self.results.rows(f"elements/{element}/frame")
            w = body_velocities(self.results.time, frame, self._coordinates(element, everything))
            first = 6 if elastic else 0
            self._powers[element, elastic] = np.einsum("ti,ti->t", w[:, first:] @ form[first:, first:], w[:, first:])
        return self._powers[element, elastic]

    def _deflection(self, element, q, arguments):
        if len(arguments) != 3 or not all(arguments):
            raise InputError(f"{element}.deflection: expected a point and the two ends of the chord, '{element}."
                             "deflection(POINT, A, B)', each an interface, a named point, the number of a mesh node, "
                             "or its place 'x y z'")
        (P, u), (A, u_a), (B, u_b) = (point_of(self, element, word) for word in arguments)
        chord = B - A
        length = np.linalg.norm(chord)
        if length == 0:
            raise InputError(f"{element}.deflection: '{arguments[1]}' and '{arguments[2]}' are at the same place: "
                             "there is no chord")
        share = (P - A) @ chord / length ** 2
        a, b = A + q @ u_a.T, B + q @ u_b.T
        offset = P - A - share * chord  # turns with the chord, by the shortest way
        directions = (b - a) / np.linalg.norm(b - a, axis=1)[:, None]
        return P + q @ u.T - a - share * (b - a) - _turned(chord / length, directions, offset)

    def _gauges(self, element, field, q, arguments):
        if len(arguments) != (2 if field == "gauge" else 3) or not all(arguments):
            raise InputError(f"{element}.{field}: expected a place and a direction" + (
                f", '{element}.gauge(PLACE, DIRECTION)'" if field == "gauge" else
                f" and the kind, '{element}.rosette(PLACE, DIRECTION, rectangular)' or 'delta'")
                + "; the place is a named point, the number of a mesh node, or 'x y z' [m], the direction 'x y z' in body "
                "axes")
        from ..bodies import gauges  # SciPy takes a while
        angles = gauges.angles_of_rosette(arguments[2]) if field == "rosette" else np.zeros(1)
        plane = q @ self._plane_strain(element, *arguments[:2]).T
        strains = gauges.gauge_strains(plane, angles)
        return strains if field == "gauge" else np.hstack([strains, gauges.principal_strains(plane)])

    def _plane_strain(self, element, place, direction):
        """(3,n) strain of the surface per coordinate, found once."""
        if (element, place, direction) not in self._strains:
            from ..bodies.gauges import plane_strain_of
            along = three_numbers(direction)
            if along is None:
                raise InputError(f"{element}: the direction of a gauge is three numbers, '1 0 0' in body axes, not "
                                 f"'{direction}'")
            at = place_of(self, element, place)
            self._strains[element, place, direction] = plane_strain_of(self.body(element), at, along)
        return self._strains[element, place, direction]

    def _section(self, element, arguments):
        if len(arguments) != 2 or not all(arguments):
            raise InputError(f"{element}.section: expected a place and the normal of the plane, '{element}.section(PLACE, "
                             "NORMAL)'; the place is a named point, the number of a mesh node, or 'x y z' [m], the normal 'x y z' in body axes")
        if (element, *arguments) not in self._sections:
            from ..bodies.section_forces import LoadedBody, Section, note_unrecorded_loads
            normal = three_numbers(arguments[1])
            if normal is None:
                raise InputError(f"{element}: the normal of a section is three numbers, '1 0 0' in body axes, not "
                                 f"'{arguments[1]}'")
            if element not in self._loaded:
                self._loaded[element] = LoadedBody(self.results, element, self.given)
                note_unrecorded_loads(self.results, element)
            place = place_of(self, element, arguments[0])
            self._sections[element, *arguments] = Section(self._loaded[element], place, normal)
        return self._sections[element, *arguments]


def _turned(start, ends, vector):
    """(nt,3) the vector, turned as the unit vector `start` turns to each of `ends` by the shortest way (not through
    half a turn)."""
    axis, cosine = np.cross(start, ends), (ends @ start)[:, None]
    return cosine * vector + np.cross(axis, vector) + axis * (axis @ vector)[:, None] / (1 + cosine)
