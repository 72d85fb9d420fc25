"""Runs a Python tool of the repository as a command, in a copy of the test's process.

A start of the interpreter with numpy, h5py and matplotlib takes a second. The copy has the modules that the test has
imported, and runs the script of the tool from its first line, with its own arguments, folder, environment, output and
exit status.
"""

import ast
import contextlib
import gc
import importlib
import io
import os
import pkgutil
import runpy
import signal
import subprocess
import sys
import tempfile
import time
import traceback
import unittest.mock

from in_folder import REPOSITORY

TOOLS = os.path.join(REPOSITORY, "tools")
LOADED_LATE = ("matplotlib.backends.backend_svg", "matplotlib.tri", "meshio", "scipy.interpolate", "scipy.optimize", "scipy.signal",
               "scipy.sparse.linalg", "scipy.spatial", "vtkmodules.all")


def import_tools(*packages):
    """Imports packages of bielle_tools, so that the copies of this process have them. Without names it imports all of
    them in 1.3 s, with the libraries that they load late."""
    if TOOLS not in sys.path:
        sys.path.insert(0, TOOLS)
    for package in [f"bielle_tools.{name}" for name in packages] or ["bielle_tools"]:
        for module in pkgutil.walk_packages(importlib.import_module(package).__path__, package + "."):
            importlib.import_module(module.name)
    for name in () if packages else LOADED_LATE:
        with contextlib.suppress(ImportError):  # a tool reports its missing libraries
            importlib.import_module(name)
    gc.freeze()  # garbage collection in the copies skips these objects, and does not copy their pages


FOR_TESTS = {"figure.constrained_layout.use": False, "figure.dpi": 60, "savefig.dpi": 60, "axes.formatter.use_mathtext": False}
users_style = {}  # the settings of users, which `prepare_figures` changes


def prepare_figures():
    """Lets the copies of this process draw figures in half the time: with low resolution, without an optimised layout
    and formulas in axis labels, and with fonts found beforehand."""
    style = importlib.import_module("bielle_tools.figures.plot_style")
    for name, value in FOR_TESTS.items():
        users_style.setdefault(name, style.plt.rcParams[name])
        style.plt.rcParams[name] = value
    fig, axes = style.figure(1, "title")
    axes[0, 0].plot([0, 1], [0, 1], label="curve")
    axes[0, 0].set_title("panel")
    axes[0, 0].set_xlabel("time [s]")
    style.legend(axes[0, 0])
    style.save(fig, io.BytesIO())
    gc.freeze()


_imported_for = set()


def import_for(script):
    """Imports the modules that a script imports at its head once, so that the copies of this process have them."""
    if script in _imported_for:
        return
    _imported_for.add(script)
    if TOOLS not in sys.path:
        sys.path.insert(0, TOOLS)
    with open(script, encoding="utf-8") as file:
        heads = [node for node in ast.parse(file.read()).body if isinstance(node, (ast.Import, ast.ImportFrom))]
    for node in heads:
        names = [name.name for name in node.names]
        for name in names if isinstance(node, ast.Import) else [node.module, *(f"{node.module}.{each}" for each in names)]:
            # A name may be a function. The script itself reports a missing module.
            with contextlib.suppress(ImportError):
                importlib.import_module(name)
    gc.freeze()


def run_python_tool(script, arguments, folder=None, environment=None, timeout=240):
    """@returns a subprocess.CompletedProcess with the status, output and errors (text); @throws TimeoutExpired"""
    import_for(script)
    with tempfile.TemporaryFile("w+", encoding="utf-8") as output, tempfile.TemporaryFile("w+", encoding="utf-8") as errors:
        sys.stdout.flush()
        sys.stderr.flush()
        child = os.fork()
        if child == 0:
            os._exit(run_script(script, arguments, folder, environment, output.fileno(), errors.fileno()))
        status = _wait(child, [script, *arguments], timeout)
        output.seek(0)
        errors.seek(0)
        return subprocess.CompletedProcess([script, *arguments], status, output.read(), errors.read())


def _wait(child, command, timeout):
    end = time.monotonic() + timeout
    while time.monotonic() < end:
        done, status = os.waitpid(child, os.WNOHANG)
        if done:
            return os.waitstatus_to_exitcode(status)
        time.sleep(0.005)
    os.kill(child, signal.SIGKILL)
    os.waitpid(child, 0)
    raise subprocess.TimeoutExpired(command, timeout)


def _without_another_copy():
    """A tool that survives a crash of the HDF5 library works in a copy of its process. This process is a copy already,
    and another copy would take two fifths of the time of a call. Tests of the crash itself start an interpreter."""
    messages = sys.modules.get("bielle_tools.messages")
    return unittest.mock.patch.object(messages, "_survive") if messages else contextlib.nullcontext()


def run_script(script, arguments, folder, environment, output, errors):
    """Runs a script as the main module of this process. `output` and `errors` are numbers of its streams. @returns its
    exit status"""
    status = 1
    try:
        os.dup2(output, 1)
        os.dup2(errors, 2)
        sys.stdout, sys.stderr = (open(stream, "w", encoding="utf-8", closefd=False) for stream in (1, 2))
        if folder:
            os.chdir(folder)
        if environment is not None:
            os.environ.clear()
            os.environ.update(environment)
        sys.argv = [script, *arguments]
        sys.path.insert(0, os.path.dirname(script))
        with _without_another_copy():
            runpy.run_path(script, run_name="__main__")
        status = 0
    except SystemExit as end:
        status = end.code if isinstance(end.code, int) else 0 if end.code is None else 1
        if status == 1 and not isinstance(end.code, int):
            print(end.code, file=sys.stderr)
    except BaseException:
        traceback.print_exc()
    finally:
        for stream in (sys.stdout, sys.stderr):
            try:
                stream.flush()
            except OSError:
                pass
    return status
