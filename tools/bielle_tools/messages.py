"""Errors that users see as one clear sentence, and how a command turns them into exit statuses."""

import difflib
import importlib.util
import os
import sys


class InputError(Exception):
    """A wrong input: the message names the file, what was found and what to do."""


def run(name, main):
    """Runs a command's main(arguments) and exits: 0 on success, 1 with one sentence on a wrong input.

    name: of the command, put before the sentence; main: takes the arguments and returns nothing.
    """
    try:
        main(sys.argv[1:])
    except InputError as error:
        print(f"{name}: {error}", file=sys.stderr)
        sys.exit(1)
    except BrokenPipeError:
        sys.exit(0)


def require(*modules):
    """Ends the command with advice when this Python has not all the modules: another python3 may stand first in PATH."""
    missing = [module for module in modules if importlib.util.find_spec(module) is None]
    if not missing:
        return
    command = os.path.relpath(sys.argv[0])
    advice = f"run {command} itself, not through python3, or" if sys.executable != "/usr/bin/python3" else "run"
    packages = " ".join(f"python3-{module.lower()}" for module in missing)
    print(f"{os.path.basename(command)}: {sys.executable} has no {' and no '.join(missing)}. Debian's /usr/bin/python3 has, with the "
          f"packages {packages}: {advice} tools/install", file=sys.stderr)
    sys.exit(2)


def note(text):
    """Says on standard error what a user should know though nothing is wrong."""
    print(f"note: {text}", file=sys.stderr)


def counted(count, noun, plural=None):
    """A number with its noun: "1 step", "3 steps"; plural: where it is not the noun with an s."""
    return f"{count} {noun if count == 1 else plural or noun + 's'}"


def check_names(what, wanted, known):
    """@raises InputError with the nearest known name when a wanted one is missing."""
    for name in wanted:
        if name not in known:
            raise InputError(f"there is no {what} '{name}' in the results{did_you_mean(name, known)}")


def did_you_mean(name, known):
    """`; did you mean 'bore'?`, or what there is when nothing is near."""
    near = difflib.get_close_matches(name, known, 1)
    return f"; did you mean '{near[0]}'?" if near else f" (there are: {', '.join(known) or 'none'})"
