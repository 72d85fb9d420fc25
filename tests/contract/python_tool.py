"""Runs a Python tool of the repository as a command, in a copy of the test's process.

A start of the interpreter with numpy, h5py and matplotlib takes a second. The copy has what the test has imported, and
runs the script of the tool from its first line, with its own arguments, folder, environment, output and exit status.
"""

import os
import runpy
import signal
import subprocess
import sys
import tempfile
import time
import traceback


def run_python_tool(script, arguments, folder=None, environment=None, timeout=240):
    """@returns a subprocess.CompletedProcess with the status, output and errors (text); @throws TimeoutExpired"""
    with tempfile.TemporaryFile("w+", encoding="utf-8") as output, tempfile.TemporaryFile("w+", encoding="utf-8") as errors:
        sys.stdout.flush()
        sys.stderr.flush()
        child = os.fork()
        if child == 0:
            os._exit(_run(script, arguments, folder, environment, output.fileno(), errors.fileno()))
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


def _run(script, arguments, folder, environment, output, errors):
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
