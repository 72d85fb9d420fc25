"""Errors that users see as one clear sentence, and how a command turns them into exit statuses."""

import difflib
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


def note(text):
    """Says on standard error what a user should know though nothing is wrong."""
    print(f"note: {text}", file=sys.stderr)


def check_names(what, wanted, known):
    """@raises InputError with the nearest known name when a wanted one is missing."""
    for name in wanted:
        if name not in known:
            near = difflib.get_close_matches(name, known, 1)
            hint = f"; did you mean '{near[0]}'?" if near else f" (there are: {', '.join(known) or 'none'})"
            raise InputError(f"there is no {what} '{name}' in the results{hint}")
