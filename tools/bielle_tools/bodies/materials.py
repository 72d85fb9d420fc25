"""Materials of a superelement's mesh for another program, from the text of its body file."""

from dataclasses import dataclass

import numpy as np
import yaml

from ..mesh import cell_integrals
from ..mesh.cells import SOLIDS
from ..messages import InputError


@dataclass
class BodyMaterials:
    names: list
    young: list
    poisson: list
    densities: list
    number: dict   # {cell type: (n) number of the material, from 0}
    density: dict  # {cell type: (n)} [kg/m^3]


def densities(file, body, path):
    """@raises InputError if the body has none, if they are not isotropic, or do not give the mass of the superelement"""
    text = file["input"][()] if "input" in file else file.parent.parent["input"][()]
    data = yaml.safe_load(text.decode() if isinstance(text, bytes) else text)
    if not isinstance(data, dict) or "materials" not in data:
        raise InputError(f"'{path}' was reduced from matrices, which do not give the mass of each cell: loads and forces in sections are those of "
                         "bodies with materials")
    if not isinstance(data["materials"], dict):
        raise InputError(f"'{path}': its body file takes its materials from the mesh file: loads are exported for materials that stand in the "
                         "body file")
    names = list(data["materials"])
    young, poisson, density = ([_number(data["materials"][name], key, path, name) for name in names]
                               for key in ("young", "poisson", "density"))
    volumes = cell_integrals.volumes(body.points, body.cells)
    number = _regions(data, names, file, body)
    of_cells = {kind: np.array(density)[number[kind]] for kind in volumes}
    mass, wanted = sum(float(of_cells[kind] @ volumes[kind]) for kind in volumes), float(file["mass_properties/mass"][()])
    if data.get("masses") and abs(mass - wanted) > 1e-6 * wanted:
        raise InputError(f"'{path}': the superelement carries {wanted - mass:.6g} kg of added `masses`, whose inertia is no force on the nodes of its "
                         "mesh and is not exported")
    if abs(mass - wanted) > 1e-3 * wanted:
        raise InputError(f"'{path}': with the densities of its body file the mesh has {mass:.6g} kg, the superelement {wanted:.6g} kg: "
                         "were materials given by parameters, or is this a piece of a body with several materials?")
    return BodyMaterials(names, young, poisson, density, number, of_cells)


def _number(material, key, path, name):
    try:
        return float(material[key])
    except (KeyError, TypeError, ValueError):
        raise InputError(f"'{path}': `{key}` of material '{name}' is not a plain number in its body file: loads are exported for "
                         "isotropic materials that are given by numbers") from None


def _regions(data, names, file, body):
    """{type: (n)}: by the nodes of each region's group; a cell belongs to the last region that has all its nodes."""
    regions = data["regions"]
    found = {kind: np.zeros(len(cells), int) for kind, cells in body.cells.items() if kind in SOLIDS}
    if len(set(regions.values())) == 1:
        only = names.index(next(iter(regions.values())))
        return {kind: numbers + only for kind, numbers in found.items()}
    groups = file["mesh/groups"]
    for region, material in regions.items():
        inside = np.zeros(len(body.points), bool)
        inside[np.asarray(groups[region], int)] = True
        for kind, numbers in found.items():
            numbers[inside[body.cells[kind]].all(axis=1)] = names.index(material)
    return found
