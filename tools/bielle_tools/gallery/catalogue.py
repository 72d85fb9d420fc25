"""The machines of a folder of Python files, each of which defines MACHINE."""

import importlib.util
import os

from ..messages import InputError, did_you_mean
from .machine import Machine

FOLDER = os.path.join(os.path.dirname(os.path.abspath(__file__)), "machines")


def names_in(folder):
    """Names of the machines of a folder, sorted. @raises InputError for a folder without any"""
    if not os.path.isdir(folder):
        raise InputError(f"'{folder}' is not a folder")
    names = sorted(name[:-3] for name in os.listdir(folder) if name.endswith(".py") and not name.startswith("_"))
    if not names:
        raise InputError(f"'{folder}' has no machines, files whose names end in .py")
    return names


def chosen(folder, wanted):
    """The machines that are asked for, all without names: {name: Machine}. @raises InputError"""
    known = names_in(folder)
    for name in wanted:
        if name not in known:
            raise InputError(f"there is no machine '{name}'{did_you_mean(name, known)}")
    return {name: _read(folder, name) for name in known if name in wanted or not wanted}


def _read(folder, name):
    path = os.path.join(folder, name + ".py")
    description = importlib.util.spec_from_file_location(f"bielle_tools.gallery.machines.{name}", path)
    module = importlib.util.module_from_spec(description)
    try:
        description.loader.exec_module(module)
    except Exception as error:  # pylint: disable=broad-except
        raise InputError(f"'{path}' cannot be read: {type(error).__name__}: {error}") from None
    machine = getattr(module, "MACHINE", None)
    if not isinstance(machine, Machine):
        raise InputError(f"'{path}' defines no MACHINE")
    shown = {machine.page, *(picture.run for picture in machine.pictures)}
    if not machine.pictures or not shown <= set(machine.runs):
        raise InputError(f"'{path}': its pictures and its page belong to its runs ({', '.join(machine.runs)})")
    return machine
