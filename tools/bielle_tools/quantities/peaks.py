"""The largest values of a run with their times and places: reactions of joints and supports, contact forces, stresses,
drives, springs and actuators, tensions, pressures."""

import dataclasses
import math

import numpy as np

from ..messages import InputError, note, place as shown


@dataclasses.dataclass
class Peak:
    """value: the largest magnitude; time [s], in statics the load factor; place: words, empty if there is none"""

    kind: str
    quantity: str
    value: float
    unit: str
    time: float
    place: str


def peaks(run, select):
    """The peaks of a run, kind by kind, the largest of each unit first. select: as of Quantities.read"""
    finder = _Finder(run, select)
    for place in run.quantities.places.recorded:
        finder.look(place)
    for place in run.quantities.places.made:
        if place.endswith("/von_mises"):
            try:
                finder.field(place, finder.node_of_body)
            except InputError as error:
                note(f"no stress of '{place.split('/')[1]}': {error}")
    order = ["reaction", "support", "contact", "stress", "drive", "force", "pressure"]
    found = sorted(finder.found, key=lambda peak: (order.index(peak.kind), peak.unit, -peak.value, peak.quantity))
    return found + _during_steps(run.results)


class _Finder:
    def __init__(self, run, select):
        self.results, self.quantities, self.select, self.found = run.results, run.quantities, select, []

    def look(self, place):
        """Adds the peaks of a recorded quantity, if its kind is one of interest."""
        section, (folder, _, field) = place.split("/")[0], place.rpartition("/")
        if section in ("joints", "supports") and field == "reaction":
            for part in ("force", "moment"):
                self.scalar("reaction" if section == "joints" else "support", f"{place}.{part}")
        elif section == "contacts" and field == "force":
            self.contact(place)
        elif section == "joints" and field == "normal_force":
            self.scalar("contact", place)
        elif field == "von_mises":
            is_body = self.results.has(f"{folder}/frame")
            self.field(place, self.node_of_body if is_body else self.place_in_beam)
        elif field.startswith("stress_at_"):
            self.scalar("stress", f"{place}.von_mises", lambda row, column: self.results.text(folder, field))
        elif section == "joints" and field == "drive_force":
            self.scalar("drive", place)
        elif field == "tension" or section == "elements" and field == "force" and len(self.results.shape(place)) == 1:
            self.scalar("force", place)
        elif field.startswith("pressure") and section in ("elements", "hydraulics"):
            self.scalar("pressure", place)

    def row(self, number):
        """Row of the results of one of those selected."""
        return int(self.select(self.results)[number]) if self.select else number

    def scalar(self, kind, name, where=None):
        """Adds the largest magnitude of each column. where(row, column): words for its place"""
        quantity = self.quantities.read(name, self.select)
        for column, (label, unit, values) in enumerate(zip(quantity.labels, quantity.units, np.abs(quantity.values).T)):
            row = _largest(values)
            if row is not None and values[row] > 0:
                words = where(self.row(row), column) if where else ""
                self.found.append(Peak(kind, label, float(values[row]), unit, float(quantity.time[row]), words))

    def field(self, place, where):
        """Adds the largest value of a field, read in blocks. where(place, row, column): words for the place of a
        column"""
        quantity = self.quantities.read(f"{place}.max", self.select)
        row = _largest(quantity.values[:, 0])
        if row is None:
            note(f"no stress of '{place}': none of its values is a number")
        if row is None or not quantity.values[row, 0] > 0:
            return
        number = self.row(row)
        one = self.quantities.read(place, lambda results: np.array([number]))
        words = where(place, number, int(np.nanargmax(one.values[0])))
        self.found.append(Peak("stress", place, float(quantity.values[row, 0]), quantity.units[0],
                               float(quantity.time[row]), words))

    def contact(self, place):
        """Adds the largest force of a contact, at the place of the smallest gap then."""
        shapes = self.results.shape(place)[1] if len(self.results.shape(place)) == 3 else 0
        point = place.rpartition("/")[0] + "/point"

        def where(row, column):
            at = f"at {shown(self.results.rows(point, [row])[0])} m" if self.results.has(point) else ""
            return f"shape {column + 1} of {shapes}, smallest gap {at}".strip() if shapes else at

        self.scalar("contact", f"{place}.norm", where)

    def place_in_beam(self, place, row, column):
        """Words for an element and a stress point of a beam."""
        points = self.results.shape(place)[2] if len(self.results.shape(place)) == 3 else 1
        element, nodes = column // points, place.rpartition("/")[0] + "/position"
        at = ""
        if self.results.has(nodes) and element + 1 < self.results.shape(nodes)[1]:
            at = f" at {shown(self.results.rows(nodes, [row])[0][element:element + 2].mean(axis=0))} m"
        return f"element {element + 1}, stress point {column % points + 1}{at}"

    def node_of_body(self, place, row, column):
        """Words for a stress node of a superelement."""
        try:
            body = self.quantities.bodies.body(place.split("/", 1)[1].rpartition("/")[0])
            node = int(body.stressed[column])
            return f"node {node} of the mesh at {shown(body.points[node])} m in the body"
        except (InputError, IndexError):
            return f"stress node {column + 1}"


def _largest(values):
    """Row of the largest number; None if there is no number."""
    return int(np.nanargmax(values)) if np.isfinite(values).any() else None


def _during_steps(results):
    """The peaks that the program recorded itself, over all its steps (`output: {peaks: ..}`)."""
    found = []
    for element in results.names("peaks"):
        for region in results.names(f"peaks/{element}"):
            for quantity in results.names(f"peaks/{element}/{region}"):
                place = f"peaks/{element}/{region}/{quantity}"
                value, time = (float(results.array(f"{place}/{name}")) for name in ("value", "time"))
                if math.isfinite(value):
                    node, position = int(results.array(f"{place}/node")), shown(results.array(f"{place}/position"))
                    found.append(Peak("recorded", place, value, results.units(f"{place}/value"), time,
                                      f"node {node} of the mesh at {position} m in the body, of all steps"))
    return found
