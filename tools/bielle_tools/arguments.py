"""Options that the commands on results files share."""

import argparse
import math

from .messages import InputError, check_names, did_you_mean
from .programs import find_program, version_text
from .results.results_file import Results


class _Version(argparse.Action):
    """Prints the version of the program that belongs to the tools, which has the commit, and exits."""

    def __call__(self, parser, namespace, values, option_string=None):
        program = find_program("bielle-mechanism")
        print(f"{parser.prog} with {program}\n{version_text(program)}", end="")
        parser.exit()


class Parser(argparse.ArgumentParser):
    """Wrong options give one sentence and status 1, as in all programs of Bielle."""

    raw = argparse.RawDescriptionHelpFormatter

    def __init__(self, *arguments, **options):
        super().__init__(*arguments, **options)
        self.add_argument("--version", action=_Version, nargs=0, help="prints version, commit and libraries, and exits")

    def parse_args(self, args=None, namespace=None):
        options, unknown = self.parse_known_args(args, namespace)
        for word in unknown:
            name = word.partition("=")[0]
            if name.startswith("-"):
                known = sorted(option for option in self._option_string_actions if option.startswith("--"))
                raise InputError(f"'{name}' is not an option{did_you_mean(name, known)}")
            raise InputError(f"'{word}' is one argument too many (--help shows what is expected)")
        return options

    def error(self, message):
        raise InputError(f"{message} (--help shows the options)")


def count(word):
    """Returns a number of jobs. @raises ArgumentTypeError"""
    if not word.isdecimal() or not 1 <= int(word) <= 1000:
        raise argparse.ArgumentTypeError(f"'{word}': expected a whole number between 1 and 1000")
    return int(word)


def results_parser(name, description, several=False):
    """Returns a parser of options for a file of results, `results`, or for several, `files`."""
    parser = Parser(prog=name, description=description, formatter_class=Parser.raw)
    if several:
        parser.add_argument("files", metavar="RESULTS.h5", nargs="+", help="results of bielle-mechanism, or a study")
    else:
        parser.add_argument("results", metavar="RESULTS.h5", help="results of bielle-mechanism")
    parser.add_argument("--analysis", type=int, metavar="N", help="show analysis N only (default: the last state of each group)")
    parser.add_argument("--superelement", action="append", default=[], metavar="ELEMENT=FILE.h5",
                        help="where the superelement file of an element is (default: as the results say)")
    return parser


def finite(text):
    """Returns the number of an option. @raises argparse.ArgumentTypeError"""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise argparse.ArgumentTypeError(f"a number is expected, found '{text}'")
    return value


def add_row_options(parser):
    """Adds options that select rows of results; `selected_rows` reads them."""
    parser.add_argument("--span", metavar="A:B", help="only the times from A to B [s] (load factors in statics); one of "
                        "them may be missing")
    parser.add_argument("--every", type=int, metavar="N", help="only every N-th of these times")


def selected_rows(options):
    """Returns the function that gives the rows of results that the options select. @raises InputError for a wrong
    option"""
    begin = end = None
    if options.span is not None:
        try:
            first, last = options.span.split(":")
            begin, end = (float(word) if word.strip() else None for word in (first, last))
        except ValueError:
            raise InputError(f"--span '{options.span}': two times A:B are expected, 0.1:0.2") from None
    if options.every is not None and options.every < 1:
        raise InputError(f"--every {options.every}: a whole number from 1 on is expected")
    return lambda results: results.frames(options.every, span=(begin, end))


def add_motion_options(parser):
    """Adds the options of commands that show a motion."""
    parser.add_argument("--scale", type=finite, default=1.0, help="magnify elastic displacements of superelements and, in pictures, of beams (default 1)")
    parser.add_argument("--from", type=finite, dest="begin", metavar="T", help="first time to show [s]")
    parser.add_argument("--to", type=finite, dest="end", metavar="T", help="last time to show [s]")


def add_mode_options(parser):
    """Adds the options of commands that show a mode as a motion."""
    parser.add_argument("--mode", type=int, metavar="N", help="show mode N of an analysis 'eigen' over one period, instead of a motion")
    parser.add_argument("--amplitude", type=float, metavar="SHARE", help="of a mode: its largest displacement relative to the model's size "
                        "(default 0.1)")
    parser.add_argument("--decay", action="store_true", help="of a mode: with its decay or growth within the period")


def opened_mode(options, results, pictures):
    """Returns the requested mode as a motion, or None. @raises InputError"""
    if options.mode is None:
        if options.amplitude is not None or options.decay:
            raise InputError("--amplitude and --decay go with --mode N")
        return None
    if options.begin is not None or options.end is not None or options.scale != 1:
        raise InputError("--from, --to and --scale are for motions; a mode has --amplitude")
    share = 0.1 if options.amplitude is None else options.amplitude
    if not 0 < share < 1e6:
        raise InputError("--amplitude is a positive number")
    from .results.modes import Modes, ModeMotion, ModeScenery
    modes = Modes(results)
    modes.check(options.mode)
    paths = superelement_paths(options, results, anywhere=True)
    return ModeMotion(ModeScenery(modes, paths), options.mode, pictures, share, options.decay)


def superelement_paths(options, results, anywhere=False):
    """Returns {element: path} of the option --superelement. @raises InputError for elements that the results do not
    contain; with `anywhere` they may be in another analysis than the one that is shown"""
    pairs = {}
    for text in options.superelement:
        element, separator, path = text.partition("=")
        if not separator or not element or not path:
            raise InputError(f"--superelement '{text}': ELEMENT=FILE.h5 is expected")
        pairs[element] = path
    if pairs:
        known = _superelements(results)
        for number in results.analyses_with_rows() if anywhere else ():
            with Results(results.path, number) as other:
                known += _superelements(other)
        check_names("superelement", pairs, list(dict.fromkeys(known)))
    return pairs


def _superelements(results):
    """Returns the names that --superelement accepts, for pieces separately and together."""
    known = results.elements_with("frame")
    return known + [results.entry_of(name) for name in known]


def names(text, what, known):
    """`a,b` -> [a, b]; None stays None. The name of a part, `blade_2`, stands for all names in it: `blade_2.root`,
    `blade_2.tip`.
    @raises InputError for names that are not `known`, and if there is none"""
    if text is None:
        return None
    wanted = [name.strip() for name in text.split(",") if name.strip()]
    if not wanted:
        raise InputError(f"expected the name of a {what}, found none (there are: {', '.join(known) or 'none'})")
    of_parts = {name: [one for one in known if one.startswith(name + ".")] for name in wanted if name not in known}
    check_names(what, [name for name in wanted if not of_parts.get(name)], known)
    return [one for name in wanted for one in of_parts.get(name) or [name]]
