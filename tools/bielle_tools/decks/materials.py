"""Linear elastic materials and the groups that they belong to, from Nastran, Abaqus and CalculiX files.

Values keep the file's units. Nothing is guessed: a material that a body file cannot express is refused with its name.
"""

import os
from dataclasses import dataclass, field

import numpy as np

from ..messages import InputError, counted
from .abaqus_file import read_sections
from .abaqus_lines import number as abaqus_number
from .foreign_mesh import MANY_PROGRAMS, NASTRAN, is_nastran
from .nastran_cards import mass_per_weight, read_cards, young_and_poisson

# Rows of Nastran's order xx yy zz xy yz zx, and of Abaqus' xx yy zz xy xz yz, in the order xx yy zz yz xz xy.
FROM_NASTRAN, FROM_ABAQUS = (0, 1, 2, 4, 5, 3), (0, 1, 2, 5, 4, 3)
ORTHOTROPIC = ("E1", "E2", "E3", "nu12", "nu13", "nu23", "G12", "G13", "G23")


@dataclass
class DeckMaterials:
    """materials: {name: {key of the body file: number or 6 rows}}; regions: {volume group: material}."""

    materials: dict = field(default_factory=dict)
    regions: dict = field(default_factory=dict)
    notes: list = field(default_factory=list)


def read_materials(path):
    """@raises InputError with one sentence."""
    if not os.path.isfile(path):
        raise InputError(f"'{path}' does not exist")
    extension = os.path.splitext(path)[1].lower()
    if extension in NASTRAN or (extension in MANY_PROGRAMS and is_nastran(path)):
        found = _of_nastran(path)
    elif extension == ".inp" or extension in MANY_PROGRAMS:
        found = _of_abaqus(path)
    else:
        raise InputError(f"'{path}': materials can be taken from Nastran, Abaqus and CalculiX files, not from {extension or 'this one'}")
    if not found.regions:
        raise InputError(f"'{path}' gives no solid cells a material ({'PSOLID' if extension in NASTRAN else '*SOLID SECTION'}): "
                         "write `materials` and `regions` in the body file")
    return found


# ---- Nastran ------------------------------------------------------------------------------------------------------------

def _of_nastran(path):
    cards = read_cards(path)
    by_number = {card.integer(1): card for card in cards if card.name in ("MAT1", "MAT9", "MAT11")}
    solids = {card.integer(2, card.integer(1)) for card in cards if card.name in ("CTETRA", "CHEXA", "CPENTA", "CPYRAM", "CPYRA")}
    factor = mass_per_weight(cards)
    found = DeckMaterials()
    for card in cards:
        if card.name != "PSOLID" or card.integer(1) not in solids:
            continue
        number = card.integer(2)
        if number not in by_number:
            raise InputError(f"'{path}': line {card.line}: PSOLID {card.integer(1)} names the material {number}, and there is no MAT1, "
                             "MAT9 or MAT11 with it")
        material = by_number[number]
        if material.name != "MAT1" and card.integer(3, 0) != 0:
            raise InputError(f"'{path}': line {card.line}: PSOLID {card.integer(1)} turns its material by the coordinate system "
                             f"{card.fields[3]}; write `materials` with `axes` in the body file")
        name = f"mat_{number}"
        if name not in found.materials:
            found.materials[name] = _CARDS[material.name](material)
            found.materials[name]["density"] *= factor
        found.regions[f"property_{card.integer(1)}"] = name
    return found


def _required(card, k, what):
    value = card.number(k, None)
    if value is None:
        raise InputError(f"'{card.path}': line {card.line}: {card.name} {card.integer(1)} has no {what}")
    return value


def _mat1(card):
    young, poisson = young_and_poisson(card)
    if young is None or poisson is None:
        raise InputError(f"'{card.path}': line {card.line}: MAT1 {card.integer(1)} needs two of E, G and NU")
    return {"young": young, "poisson": poisson, "density": _required(card, 5, "density")}


def _mat9(card):
    rows = np.zeros((6, 6))
    places = [(i, j) for i in range(6) for j in range(i, 6)]
    for k, (i, j) in enumerate(places, 2):
        rows[i, j] = rows[j, i] = card.number(k, 0.0)
    return {"stiffness": _turned(rows, FROM_NASTRAN), "density": _required(card, 23, "density")}


def _mat11(card):
    constants = {key: _required(card, k, key) for k, key in enumerate(ORTHOTROPIC, 2)}
    return {**constants, "density": _required(card, 11, "density")}


_CARDS = {"MAT1": _mat1, "MAT9": _mat9, "MAT11": _mat11}


# ---- Abaqus and CalculiX ------------------------------------------------------------------------------------------------

def _of_abaqus(path):
    deck = read_sections(path)
    known = {name.upper(): (name, properties) for name, properties in deck.materials.items()}
    found = DeckMaterials()
    for section in deck.sections:
        if section.material.upper() not in known:
            raise InputError(f"'{path}': *SOLID SECTION, ELSET={section.set}: there is no *MATERIAL, NAME={section.material}")
        name, properties = known[section.material.upper()]
        if name not in found.materials:
            found.materials[name] = _abaqus_material(path, name, properties, found.notes)
        if section.oriented and "young" not in found.materials[name]:
            raise InputError(f"'{path}': *SOLID SECTION, ELSET={section.set} has an orientation; write `materials` with `axes` in the body "
                             "file")
        if section.turned and "young" not in found.materials[name]:
            raise InputError(f"'{path}': *SOLID SECTION, ELSET={section.set}: its instance is turned, and the directions of its material with it; "
                             "write `materials` with `axes` in the body file")
        found.regions[section.set] = name
    return found


def _abaqus_material(path, name, properties, notes):
    where = f"'{path}': *MATERIAL, NAME={name}"
    for keyword in ("ELASTIC", "DENSITY"):
        if keyword not in properties:
            raise InputError(f"{where} has no *{keyword}")
    others = [f"*{keyword}" for keyword in properties if keyword not in ("ELASTIC", "DENSITY")]
    if others:
        notes.append(f"material '{name}': left out: {', '.join(others)}, as materials are linear and elastic")
    options, rows = properties["ELASTIC"]
    kind = options.get("TYPE", "ISOTROPIC").upper()
    if kind not in _ELASTIC:
        raise InputError(f"{where}: *ELASTIC, TYPE={kind} is not read; it reads {', '.join(_ELASTIC)}")
    count, made = _ELASTIC[kind]
    values, density = _numbers(where, "ELASTIC", rows), _numbers(where, "DENSITY", properties["DENSITY"][1])
    if len(values) < count:
        raise InputError(f"{where}: *ELASTIC, TYPE={kind} needs {counted(count, 'constant')}, found {len(values)}")
    if not density:
        raise InputError(f"{where}: *DENSITY has no number")
    if len(values) > count + 1 or len(density) > 2:
        notes.append(f"material '{name}': its values at the first temperature are taken")
    return {**made(values[:count]), "density": density[0]}


def _numbers(where, keyword, rows):
    numbers = []
    for row in rows:
        for word in filter(None, (word.strip() for word in row.split(","))):
            try:
                numbers.append(abaqus_number(word))
            except ValueError:
                raise InputError(f"{where}: *{keyword} has '{word}' where a number belongs") from None
    return numbers


def _orthotropic(d):
    rows = np.zeros((6, 6))
    for (i, j), value in zip(((0, 0), (0, 1), (1, 1), (0, 2), (1, 2), (2, 2), (3, 3), (4, 4), (5, 5)), d):
        rows[i, j] = rows[j, i] = value
    return {"stiffness": _turned(rows, FROM_ABAQUS)}


def _anisotropic(d):
    rows = np.zeros((6, 6))
    for (i, j), value in zip(((i, j) for j in range(6) for i in range(j + 1)), d):
        rows[i, j] = rows[j, i] = value
    return {"stiffness": _turned(rows, FROM_ABAQUS)}


def _turned(rows, order):
    return rows[np.ix_(order, order)].tolist()


# Constants, and the function that makes keys of a body file from them. (Abaqus Keywords Guide, "*ELASTIC".)
_ELASTIC = {
    "ISOTROPIC": (2, lambda d: {"young": d[0], "poisson": d[1]}),
    "ISO": (2, lambda d: {"young": d[0], "poisson": d[1]}),
    "ENGINEERING CONSTANTS": (9, lambda d: dict(zip(ORTHOTROPIC, d))),
    "ORTHOTROPIC": (9, _orthotropic), "ORTHO": (9, _orthotropic),
    "ANISOTROPIC": (21, _anisotropic), "ANISO": (21, _anisotropic),
}
