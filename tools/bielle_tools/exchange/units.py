"""Units of length, mass and time in which the numbers of a MatrixSet are, and their conversion.

An energy has the factor m L^2/T^2. An unknown has the factor L if it is a translation, and 1 if it is a rotation or a scalar
coordinate. All other factors follow: an entry of a stiffness has that of an energy divided by those of its two unknowns, a
mass T^2 times it, a damping T times it.
"""

import dataclasses
from dataclasses import dataclass

import numpy as np
import scipy.sparse

from ..messages import InputError, did_you_mean
from .matrix_set import MassProperties
from .recovery import converted_quantity

# The words of length and mass are those of `length_unit` and `mass_unit` in a body file.
METRES = {"m": 1.0, "mm": 1e-3, "cm": 1e-2, "um": 1e-6, "km": 1e3, "in": 0.0254, "ft": 0.3048}
KILOGRAMS = {"kg": 1.0, "g": 1e-3, "t": 1e3, "lb": 0.45359237, "slug": 14.593902937206365, "slinch": 175.12683524647638}
SECONDS = {"s": 1.0, "ms": 1e-3}
# Other names of systems of units, which contain a unit of force or none of mass.
ALIASES = {"si": "m-kg-s", "mks": "m-kg-s", "m-n-s": "m-kg-s", "n-m-s": "m-kg-s", "cgs": "cm-g-s", "mpa": "mm-t-s", "mm-n-s": "mm-t-s",
           "n-mm-s": "mm-t-s", "mm-ton-s": "mm-t-s", "mm-tonne-s": "mm-t-s", "mm-mg-s": "mm-t-s", "mm-kn-ms": "mm-kg-ms",
           "kn-mm-ms": "mm-kg-ms", "in-lbf-s": "in-slinch-s", "lbf-in-s": "in-slinch-s", "ips": "in-slinch-s", "ft-lbf-s": "ft-slug-s",
           "lbf-ft-s": "ft-slug-s", "fps": "ft-slug-s"}


@dataclass(frozen=True)
class Units:
    """A system of units by its words."""

    length: str = "m"
    mass: str = "kg"
    time: str = "s"

    def __str__(self):
        return f"{self.length}-{self.mass}-{self.time}"

    @property
    def factors(self):
        """Metres, kilograms and seconds per unit."""
        return METRES[self.length], KILOGRAMS[self.mass], SECONDS[self.time]


SI = Units()


def read_units(text, option):
    """Units of a text such as mm-t-s. @param option: its name, for messages @raises InputError"""
    words = text.split("-")
    if text.lower() in ALIASES:
        raise InputError(f"{option} {text}: units of length, mass and time are expected; this system is {option} {ALIASES[text.lower()]}")
    if len(words) != 3:
        raise InputError(f"{option} {text}: units of length, mass and time are expected, such as mm-t-s (forces in N) or m-kg-s")
    for word, known, kind in zip(words, (METRES, KILOGRAMS, SECONDS), ("length", "mass", "time")):
        if word not in known:
            raise InputError(f"{option} {text}: '{word}' is no unit of {kind}{did_you_mean(word, known)}; a unit of force is not given, it "
                             "follows from the others: N and mm belong to mm-t-s, lbf and in to in-slinch-s")
    return Units(*words)


def declared_units(matrices, given):
    """The units of the numbers of a MatrixSet: those that its file declares, or else the given ones (None: SI).
    @raises InputError when both are there and differ"""
    declared = (matrices.length_unit, matrices.mass_unit)
    for word, known, kind in zip(declared, (METRES, KILOGRAMS), ("length", "mass")):
        if word is not None and word not in known:
            raise InputError(f"the file declares '{word}', which is no unit of {kind}{did_you_mean(word, known)}")
    if given is None:
        return Units(matrices.length_unit or "m", matrices.mass_unit or "kg")
    for word, chosen, kind in zip(declared, (given.length, given.mass), ("length", "mass")):
        if word is not None and word != chosen:
            raise InputError(f"--units {given}: the file declares the unit of {kind} {word}")
    return given


def converted(matrices, units, to=SI):
    """A copy of a MatrixSet whose numbers are in other units. @param units: those that they are in now"""
    length, mass, time = (here / there for here, there in zip(units.factors, to.factors))
    unknowns = np.where((matrices.unknown_nodes >= 0) & (matrices.unknown_components < 3), length, 1.0)
    energy, moment = mass * length**2 / time**2, mass * length**2
    inverse = scipy.sparse.diags(1 / unknowns)

    def scaled(matrix, factor):
        return None if matrix is None else scipy.sparse.csr_matrix(factor * (inverse @ matrix @ inverse))

    components = matrices.inertia_components
    properties = matrices.mass_properties
    return dataclasses.replace(
        matrices, positions=length * matrices.positions, stiffness=scaled(matrices.stiffness, energy),
        mass=scaled(matrices.mass, moment), damping=scaled(matrices.damping, energy * time),
        geometric_stiffness=scaled(matrices.geometric_stiffness, energy),
        inertia_components=None if components is None else moment * components / np.outer(unknowns, unknowns),
        mass_properties=None if properties is None else
        MassProperties(mass * properties.mass, length * properties.centre, moment * properties.inertia),
        shapes=None if matrices.shapes is None else _converted_shapes(matrices.shapes, unknowns, length, mass, time),
        quantities={name: converted_quantity(quantity, unknowns, (length, mass, time)) for name, quantity in matrices.quantities.items()},
        length_unit=to.length, mass_unit=to.mass)


def _converted_shapes(shapes, unknowns, length, mass, time):
    def scaled(values, factor):
        return None if values is None else factor * values

    return dataclasses.replace(
        shapes, points=length * shapes.points, displacement=length * shapes.displacement / unknowns,
        rotation=None if shapes.rotation is None else shapes.rotation / unknowns,
        stress=None if shapes.stress is None else mass / (length * time**2) * shapes.stress / unknowns,
        masses=scaled(shapes.masses, mass), inertias=scaled(shapes.inertias, mass * length**2))
