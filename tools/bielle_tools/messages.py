"""Errors that users see as one clear sentence, and their exit statuses."""

import contextlib
import difflib
import errno
import importlib.util
import os
import signal
import sys
import traceback
import warnings

FULL = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)
# Signals of a crash. The last one means that reading did not terminate.
CRASHES = (signal.SIGSEGV, signal.SIGBUS, signal.SIGABRT, signal.SIGFPE, signal.SIGILL, signal.SIGPROF)
PACKAGES = {"vtkmodules": "vtk9"}  # Debian's packages with other names than their modules
longest_reading = 0  # [s] of processor time in one call; 0: without limit. A process that crashes alone has one


class InputError(Exception):
    """A wrong input: the message names the file, what was found and what to do."""


def run(name, main, crashing=False):
    """Runs a command's main(arguments) and exits: 0 on success, 1 with one sentence on a wrong input, 2 if a disk is
    full or on an unexpected error (BIELLE_TRACEBACK=1 shows the traceback).

    name: name of the command, which precedes the sentence; main: takes the arguments and returns nothing; crashing: set
    if it uses a library that crashes on damaged files: it then runs in a child process.
    """
    _open_closed_streams()
    if crashing:
        _survive(name)
    warnings.simplefilter("ignore")  # warnings of numpy and matplotlib about numbers that the command has checked
                                     # itself
    try:
        main(sys.argv[1:])
        with contextlib.suppress(AttributeError):  # a stream that is closed
            sys.stdout.flush()
    except InputError as error:
        _end(1, f"{name}: {error}")
    except BrokenPipeError:
        _end(0)
    except KeyboardInterrupt:
        _end(130)
    except OSError as error:
        full = error.errno in FULL or os.strerror(errno.ENOSPC) in str(error)  # the latter: of the HDF5 library
        _end(2 if full else 1, f"{name}: {_what_failed(error)}")
    except MemoryError:
        _end(2, f"{name}: out of memory")
    except Exception as error:  # pylint: disable=broad-except
        if os.environ.get("BIELLE_TRACEBACK"):
            traceback.print_exc()
        _end(2, f"{name}: unforeseen: {type(error).__name__}: {error} (please report it with the file; BIELLE_TRACEBACK=1 shows "
                "where)")


@contextlib.contextmanager
def limited_reading():
    """Ends a child process (`run`) whose reading does not end."""
    before = signal.setitimer(signal.ITIMER_PROF, longest_reading)[0] if longest_reading else 0
    try:
        yield
    finally:
        if longest_reading:
            signal.setitimer(signal.ITIMER_PROF, before)


def _end(status, sentence=""):
    """Ends the process, without a message about streams that are no longer read."""
    with contextlib.suppress(OSError, AttributeError):
        if sentence:
            print(sentence, file=sys.stderr)
        sys.stdout.flush()
    null = os.open(os.devnull, os.O_WRONLY)
    os.dup2(null, 1)
    sys.exit(status)


def _what_failed(error):
    """Describes an error of the operating system."""
    full = os.strerror(errno.ENOSPC)
    reason = full if full in str(error) else error.strerror or str(error)
    return f"'{error.filename}': {reason}" if error.filename else f"cannot write: {reason}" if error.errno in FULL else reason


def _open_closed_streams():
    """Opens closed streams, so that a file that is opened next does not get the number of one."""
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDWR)


def _survive(name):
    """Continues in a child process; the parent waits for it, and reports a crash."""
    global longest_reading
    child = os.fork()
    if not child:
        longest_reading = 60
        return
    for number in (signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, lambda received, _: os.kill(child, received))
    while True:
        with contextlib.suppress(KeyboardInterrupt):  # the child gets it as well
            _, status = os.waitpid(child, 0)
            break
    if os.WIFSIGNALED(status) and os.WTERMSIG(status) in CRASHES:
        print(f"{name}: a file is damaged: the HDF5 library crashes on it", file=sys.stderr)
        os._exit(1)
    os._exit(128 + os.WTERMSIG(status) if os.WIFSIGNALED(status) else os.WEXITSTATUS(status))


def require(*modules):
    """Ends the command with advice if this Python lacks one of the modules: another python3 may come first in PATH."""
    missing = [module for module in modules if importlib.util.find_spec(module) is None]
    if not missing:
        return
    command = os.path.relpath(sys.argv[0])
    advice = f"run {command} itself, not through python3, or" if sys.executable != "/usr/bin/python3" else "run"
    packages = [f"python3-{PACKAGES.get(module, module.lower())}" for module in missing]
    print(f"{os.path.basename(command)}: {sys.executable} has no {' and no '.join(missing)}. Debian's /usr/bin/python3 has, with the "
          f"packages {' '.join(packages)}: {advice} {installation(*packages)}", file=sys.stderr)
    sys.exit(2)


def installation(*packages):
    """The command that installs Debian's packages: that of the repository, or apt for tools that are installed."""
    tools = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    return "tools/install" if os.path.isfile(os.path.join(tools, "install")) else f"apt install {' '.join(packages)}"


def note(text):
    """Prints a note for the user on standard error."""
    print(f"note: {text}", file=sys.stderr)


def place(point):
    """Coordinates of a point, as messages show them."""
    return "(" + ", ".join(f"{x:g}" for x in point) + ")"


def counted(count, noun, plural=None):
    """A number with its noun: "1 step", "3 steps"; plural: the plural if it is not the noun with an s."""
    return f"{count} {noun if count == 1 else plural or noun + 's'}"


def check_names(what, wanted, known):
    """@raises InputError with the nearest known name when a wanted one is missing."""
    for name in wanted:
        if name not in known:
            raise InputError(f"there is no {what} '{name}' in the results{did_you_mean(name, known)}")


def did_you_mean(name, known):
    """`; did you mean 'bore'?`, or all known names if none is near."""
    near = difflib.get_close_matches(name, known, 1)
    return f"; did you mean '{near[0]}'?" if near else f" (there are: {', '.join(known) or 'none'})"
