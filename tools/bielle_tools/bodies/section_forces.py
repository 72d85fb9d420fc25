"""Force and moment in a section of a superelement, by the equilibrium of the part in front of a plane.

The stress that a superelement keeps is that of nodes, mostly of the surface, and does not integrate to a resultant; the
loads of the body do. By d'Alembert's principle the part in front is in equilibrium under the forces on its interfaces,
its inertia less its weight (loads.py), and the force -F that the part behind exerts on it through the section:
    F = sum of the forces on the interfaces in front - integral of rho a dV in front,
which the part in front exerts on the part behind: F . normal is positive in tension. Moments are about the place, and
about the place on the undeformed body, as all terms are: a force P that moves by u relative to the section has the
additional moment u x P, which is left out. All is in body axes. The inertia is that of a field balancing the elastic
forces, without damping: F is the resultant of the elastic stress.
"""

import numpy as np
import yaml

from ..mesh.half_space import moments_in_front
from ..messages import InputError, note, place as shown
from .loads import LoadedBody

SMALLEST_PART = 1e-9  # mass of a part relative to that of the body


def note_unrecorded_loads(results, element):
    """Notes that the model may have loads on the body that the results do not record: load patterns, and forces on
    inner points."""
    try:
        model = yaml.safe_load(results.text_of("input"))
        entry = results.entry_of(element)
        loads = list(model["elements"].get(entry, {}).get("loads", {}))
        points = [name for name, point in model.get("points", {}).items() if point.get("element") == entry]
    except (yaml.YAMLError, AttributeError, KeyError, TypeError):
        return  # the results have another origin; parts and repetitions have other names
    found = [f"the load pattern '{name}'" for name in loads] + [f"the point '{name}'" for name in points]
    if found:
        note(f"{element}: forces of {', '.join(found)} are not recorded: as far as there are any, its sections are wrong")


class Section:
    """A plane through a body. place (3): where its moment is taken; normal (3): both in body axes"""

    def __init__(self, loaded: LoadedBody, place, normal):
        """@raises InputError if the plane does not cut the body, or cuts an interface"""
        length = np.linalg.norm(normal)
        if not length > 0:
            raise InputError("the normal of a section has no length")
        self.loaded, self.place, self.normal = loaded, np.asarray(place, float), np.asarray(normal, float) / length
        cells = {kind: loaded.body.cells[kind] for kind in loaded.materials.density}
        self.W, self.V = moments_in_front(loaded.points, cells, loaded.materials.density, self.place, self.normal)
        total = float(loaded.mesh_mass.sum())
        if not SMALLEST_PART < self.W.sum() / total < 1 - SMALLEST_PART:
            raise InputError(f"{self} does not cut the body")
        self.front = self._interfaces_in_front()

    def __str__(self):
        return f"the plane through {shown(self.place)} with the normal {shown(self.normal)}"

    def _interfaces_in_front(self):
        """(nb) whether each interface is in front of the plane."""
        try:
            tied = [self.loaded.points[surface.nodes] for surface in self.loaded.surfaces]
        except InputError:  # the file does not name the surface
            note("sides of interfaces are told by their positions, since the file does not name their surfaces")
            tied = [position[None] for position in self.loaded.positions]
        heights = [(points - self.place) @ self.normal for points in tied]
        for (name, _, _), height in zip(self.loaded.interfaces, heights):
            if height.min() < 0 < height.max():
                raise InputError(f"{self} cuts the surface of the interface '{name}': how much of its force acts in front is not recorded")
        return np.array([height.sum() > 0 for height in heights], bool)

    def at(self, row):
        """(6) force [N] and moment about the place [N m] of the part in front on the part behind."""
        load = self.loaded.at(row)
        forces, arms = load.interface[self.front], self.loaded.positions[self.front] - self.place
        force = forces[:, :3].sum(axis=0) - self.W @ load.field
        moment = (forces[:, 3:] + np.cross(arms, forces[:, :3])).sum(axis=0) \
            - np.cross(self.V - self.W[:, None] * self.place, load.field).sum(axis=0)
        return np.concatenate([force, moment])
