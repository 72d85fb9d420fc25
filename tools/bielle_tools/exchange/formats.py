"""The formats of matrices, each a module, chosen by the ending of a file and by its first bytes.

A module that reads has `read(path, options)`, which returns a MatrixSet; one that writes has `write(matrices, path, options)`,
which may write several files and returns their paths. `options` are those of the command (`Options`).
"""

import importlib
import os
from dataclasses import dataclass, field

from ..messages import InputError, did_you_mean
from .recovery import Request

# By name: module, endings. The first format that has the ending and recognises the file reads it (`recognises(path)`, where the
# module has it).
FORMATS = {
    "matrices": ("matrix_file", [".h5"]),
    "superelement": ("superelement_set", [".h5"]),
    "dmig": ("dmig", [".pch", ".dmig", ".bdf", ".nas"]),
    "op4": ("op4", [".op4"]),        # binary when it is written
    "op4-text": ("op4", [".op4"]),
    "calculix": ("calculix_matrices", [".sti"]),
    "abaqus": ("abaqus_matrices", [".mtx"]),
    "matrix_input": ("abaqus_matrix_input", [".mtx"]),
    "matrix_market": ("matrix_market", [".mtx"]),
    "npz": ("npz_matrices", [".npz"]),
    "exudyn": ("exudyn_modes", [".npz", ".hdf5"]),
    "mbdyn": ("mbdyn_modes", [".fem"]),
    "simscape": ("simscape_matrices", [".mat"]),
    "fedem": ("fedem_matrices", [".fmx"]),
}

# Members of `Options`, besides the name of the body, that the reader of a format uses; a format that is not listed uses
# none.
TAKES = {
    "dmig": ("nodes", "mass", "names", "quantities"),
    "op4": ("nodes", "mass", "names", "quantities"),
    "op4-text": ("nodes", "mass", "names", "quantities"),
    "calculix": ("nodes", "mass"),
    "abaqus": ("nodes", "mass", "unknowns"),
    "matrix_input": ("nodes", "mass", "unknowns"),
    "matrix_market": ("nodes", "mass", "unknowns"),
    "exudyn": ("interfaces",),
    "mbdyn": ("interfaces",),
    "fedem": ("nodes", "mass", "unknowns"),
}


# Parts of a MatrixSet for which a format has no place, besides those that its writer reports itself.
BESIDES = ("geometric_stiffness", "inertia_components", "mass_properties", "shapes", "stress", "quantities", "names", "cells")
LOSES = {
    "dmig": ("names", "cells"), "op4": ("names", "cells"), "op4-text": ("names", "cells"),
    "calculix": BESIDES, "abaqus": BESIDES, "matrix_input": BESIDES, "matrix_market": BESIDES, "simscape": BESIDES,
    "fedem": ("damping", *BESIDES),
    "npz": ("geometric_stiffness", "cells"), "mbdyn": ("geometric_stiffness", "stress", "quantities", "names", "cells"),
    "exudyn": ("geometric_stiffness", "quantities", "names", "cells"),
}
TOLD = {
    "damping": "the damping", "geometric_stiffness": "the geometric stiffness",
    "inertia_components": "the inertia components, without which the inertia of large rotations is an estimate",
    "mass_properties": "the mass properties, which follow from the mass matrix", "shapes": "the displacements inside the body",
    "stress": "the stress inside the body", "quantities": "the recovered quantities",
    "names": "the names of the interfaces", "cells": "the cells between the points",
}


def losses(name, matrices):
    """Notes on the parts of a MatrixSet that a format does not hold."""
    def is_there(part):
        if part == "names":
            return any(given != f"node_{matrices.numbers[row]}" for given, row in matrices.interfaces.items())
        if part == "stress":
            return matrices.shapes is not None and matrices.shapes.stress is not None
        if part == "quantities":
            return bool(matrices.quantities)
        if part == "cells":
            return bool(matrices.cells or matrices.shapes is not None and matrices.shapes.cells)
        member = getattr(matrices, part)
        return member is not None and getattr(member, "nnz", 1) > 0

    return [f"left out: {TOLD[part]}" for part in LOSES.get(name, ()) if is_there(part)]


@dataclass
class Options:
    """The options of the command that a format may use."""

    format: str = ""                       # name of the format that is read or written
    nodes: str = ""                        # another file with the nodes (a deck, a table)
    mass: str = ""                         # another file with the mass matrix
    names: dict[str, str] = field(default_factory=dict)  # names of matrices in the file: {"stiffness": "KAAX", "mass": "MAAX"}
    name: str = ""                         # name of the body
    quantities: dict[str, Request] = field(default_factory=dict)  # recovered quantities by name
    unknowns: str = ""                     # a table of the order of the unknowns (node, component)
    interfaces: list[int] = field(default_factory=list)  # numbers of the nodes whose unknowns replace amplitudes of modes


def module_of(name):
    """@raises InputError with the nearest name"""
    if name not in FORMATS:
        raise InputError(f"there is no format '{name}'{did_you_mean(name, FORMATS)}")
    return importlib.import_module("." + FORMATS[name][0], __package__)


def format_of(path, chosen="", writing=False):
    """Name of the format of a file. @raises InputError when none has its ending"""
    direction = "write" if writing else "read"
    if chosen:
        if not hasattr(module_of(chosen), direction):
            raise InputError(f"the format '{chosen}' cannot be {'written' if writing else 'read'}")
        return chosen
    ending = os.path.splitext(path)[1].lower()
    for name, (_, endings) in FORMATS.items():
        if ending not in endings:
            continue
        module = module_of(name)
        if hasattr(module, direction) and (writing or not hasattr(module, "recognises") or module.recognises(path)):
            return name
    known = ", ".join(sorted({ending for _, endings in FORMATS.values() for ending in endings}))
    raise InputError(f"'{path}': no format of matrices is known by this ending; known ones: {known}")


def check_options(name, given):
    """@param given: names of members of `Options` @raises InputError for those that a format does not use"""
    takes = TAKES.get(name, ())
    for option in given:
        if option not in takes:
            told = " and ".join(f"--{one}" for one in takes) or "none"
            raise InputError(f"--{option}: the format '{name}' does not use it (it takes {told})")
