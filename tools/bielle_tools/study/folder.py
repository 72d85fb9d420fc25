"""The runs of a study are kept in a folder <name>.runs-XXXXXXXX next to its file, which is used by one study at a time.

The folder is new (mkdtemp), or was left by an earlier study of the same file, as its plan says. A study holds a lock in
it, so that a second study of the same file reports an error. Studies remove only their own files from the folder.
"""

import contextlib
import fcntl
import glob
import os
import re
import socket
import tempfile

from ..messages import InputError, note
from .plan import PLAN, read_plan

LOCK = "lock"
OF_RUNS = re.compile(r"[0-9a-f]{24}\.h5(\.\d+\.\d+)?(\.part)?")


@contextlib.contextmanager
def work_folder(output):
    """The folder of a study's runs, held until the end. @raises InputError if another study of this file is in
    progress"""
    with _locked_together(os.path.dirname(output)):
        folder, lock = _left_by_an_earlier_study(output)
        if folder is None:
            folder, lock = _new(output)
    try:
        yield folder
    finally:
        os.close(lock)


def discard(folder):
    """Removes a folder of runs with the files of studies in it; other files stay and are reported."""
    forget_runs(folder)
    for name in (PLAN, LOCK):
        with contextlib.suppress(FileNotFoundError):
            os.remove(os.path.join(folder, name))
    try:
        os.rmdir(folder)
    except OSError:
        note(f"'{folder}' stays: it holds files that are no part of the study")


def forget_runs(folder):
    """Removes the runs in a folder."""
    for name in os.listdir(folder):
        if OF_RUNS.fullmatch(name):
            os.remove(os.path.join(folder, name))


def check_folder_of_jobs(folder):
    """@raises InputError if a folder for jobs contains other files"""
    if not os.path.isdir(folder) or not os.listdir(folder):
        return
    try:
        read_plan(folder)
    except InputError:
        raise InputError(f"'{folder}' holds other things: say a new folder for the jobs") from None


def _new(output):
    name = os.path.splitext(os.path.basename(output))[0]
    try:
        folder = tempfile.mkdtemp(prefix=f"{name}.runs-", dir=os.path.dirname(output))
    except OSError as error:
        raise InputError(f"cannot write '{output}': '{os.path.dirname(output)}': {error.strerror}") from None
    os.chmod(folder, 0o777 & ~_umask())
    return folder, _hold(folder, output)


def _left_by_an_earlier_study(output):
    """@returns folder and lock, or None, None. @raises InputError if its study is still in progress"""
    for folder in sorted(glob.glob(glob.escape(os.path.splitext(output)[0]) + ".runs-*")):
        with contextlib.suppress(FileNotFoundError):  # its study ends just now
            if os.path.isdir(folder) and _is_of(folder, output):
                lock = _hold(folder, output)
                if os.fstat(lock).st_nlink > 0:
                    return folder, lock
                os.close(lock)
    return None, None


def _is_of(folder, output):
    """The plan identifies the study; a folder that contains only a lock belongs to a study that has just begun or
    ended."""
    if os.listdir(folder) == [LOCK]:
        return True
    try:
        return read_plan(folder).output == output
    except InputError:
        return False


def _hold(folder, output):
    path = os.path.join(folder, LOCK)
    lock = os.open(path, os.O_RDWR | os.O_CREAT, 0o666)
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        holder = os.read(lock, 200).decode("utf-8", "replace")
        os.close(lock)
        raise InputError(f"another study is at work on '{output}' ({holder or 'it has just begun'}; its runs are in '{folder}'): wait for "
                         "its end, or say another file with -o") from None
    except OSError:
        pass  # a file system without locks
    os.ftruncate(lock, 0)
    os.write(lock, f"process {os.getpid()} on {socket.gethostname()}".encode())
    return lock


@contextlib.contextmanager
def _locked_together(folder):
    """Lets one study at a time look for its folder of runs."""
    try:
        place = os.open(folder, os.O_RDONLY)
    except OSError:
        yield
        return
    try:
        with contextlib.suppress(OSError):  # a file system without locks
            fcntl.flock(place, fcntl.LOCK_EX)
        yield
    finally:
        os.close(place)


def _umask():
    mask = os.umask(0)
    os.umask(mask)
    return mask
