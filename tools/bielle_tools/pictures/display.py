"""A display that exists in memory only: Debian's VTK draws through an X server, also off-screen.

The packages of VTK have neither EGL nor OSMesa windows. Xvfb is an X server without a screen, and Mesa draws on it with
the processor. The display of the user is never used: pictures are the same on all machines, and need no permission.
"""

import contextlib
import importlib.util
import os
import select
import shutil
import subprocess

from ..messages import InputError, installation

LONGEST_START = 30  # [s]


def missing():
    """Names the package that is missing for drawing, in a sentence; empty if there is none."""
    if importlib.util.find_spec("vtkmodules") is None:
        return f"drawing needs VTK (Debian package python3-vtk9): run {installation('python3-vtk9')}"
    return "" if shutil.which("Xvfb") else f"drawing needs the program Xvfb (Debian package xvfb): run {installation('xvfb')}"


@contextlib.contextmanager
def virtual_display():
    """Runs an X server and sets DISPLAY to it. The server ends with this process, whatever ends it.
    @raises InputError if there is none"""
    if missing():
        raise InputError(missing())
    reading, writing = os.pipe()
    command = ["Xvfb", "-displayfd", str(writing), "-screen", "0", "64x64x24", "-nolisten", "tcp", "-noreset"]
    if shutil.which("setpriv"):
        command = ["setpriv", "--pdeathsig", "TERM", *command]
    server = subprocess.Popen(command, pass_fds=[writing], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL, start_new_session=True)
    before = os.environ.get("DISPLAY")
    try:
        os.close(writing)
        os.environ["DISPLAY"] = f":{_number(reading)}"
        yield
    finally:
        os.close(reading)
        server.terminate()
        server.wait()
        if before is None:
            os.environ.pop("DISPLAY", None)
        else:
            os.environ["DISPLAY"] = before


def _number(reading):
    """The number of its display, which the server writes when it is ready."""
    text = b""
    while not text.endswith(b"\n"):
        ready, _, _ = select.select([reading], [], [], LONGEST_START)
        more = os.read(reading, 64) if ready else b""
        if not more:
            raise InputError("drawing failed: the program Xvfb did not start")
        text += more
    return int(text)
