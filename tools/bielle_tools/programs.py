"""The places of Bielle's programs."""

import os

from .messages import InputError


def find_program(name):
    """Path of a program such as bielle-mechanism, in BIELLE_BIN, in this repository's build, next to an installed tool, or on the
    PATH. @raises InputError"""
    tools = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    folders = [os.environ.get("BIELLE_BIN", ""), os.path.join(tools, "..", "build", "release", "bin"),
               os.path.join(tools, "..", "..", "..", "bin"), *os.environ.get("PATH", "").split(os.pathsep)]
    for folder in filter(None, folders):
        path = os.path.join(folder, name)
        if os.access(path, os.X_OK):
            return path
    absent = "is not built: run 'cmake --preset release && cmake --build build/release'"
    if not os.path.exists(os.path.join(tools, "install")):  # installed tools
        absent = "is not installed: install the Debian package bielle"
    raise InputError(f"{name} {absent}, or say where it is with BIELLE_BIN=FOLDER")
