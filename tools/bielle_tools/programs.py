"""The places of Bielle's programs."""

import os
import subprocess

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


def version_text(program):
    """The text of a program's `--version`: name and version, commit, build, libraries. @raises InputError"""
    try:
        done = subprocess.run([program, "--version"], capture_output=True, text=True, errors="replace", check=False)
    except OSError as error:
        raise InputError(f"'{program}' cannot be run: {error.strerror}") from None
    if done.returncode:
        raise InputError(f"'{program} --version' ended with status {done.returncode}")
    return done.stdout


def identity(program):
    """Name, version and commit of a program, as files that it writes have them in `created_by`. @raises InputError"""
    lines = version_text(program).splitlines()
    commit = next((line.split()[1] for line in lines if line.startswith("commit ")), "unknown")
    return f"{lines[0] if lines else os.path.basename(program)} (commit {commit})"
