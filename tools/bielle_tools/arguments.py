"""Options that the commands on results files share."""

import argparse

from .messages import InputError


class Parser(argparse.ArgumentParser):
    """Wrong options are one sentence and status 1, as everywhere in Bielle."""

    raw = argparse.RawDescriptionHelpFormatter

    def error(self, message):
        raise InputError(f"{message} (--help shows the options)")


def results_parser(name, description):
    parser = Parser(prog=name, description=description, formatter_class=Parser.raw)
    parser.add_argument("results", metavar="RESULTS.h5", help="results of bielle-mechanism")
    parser.add_argument("--analysis", type=int, metavar="N", help="show analysis N only (default: the last state of each group)")
    parser.add_argument("--superelement", action="append", default=[], metavar="ELEMENT=FILE.h5",
                        help="where the superelement file of an element is (default: as the results say)")
    return parser


def add_motion_options(parser):
    """Options of the commands that show a motion."""
    parser.add_argument("--scale", type=float, default=1.0, help="magnify elastic displacements of superelements (default 1)")
    parser.add_argument("--from", type=float, dest="begin", metavar="T", help="first time to show [s]")
    parser.add_argument("--to", type=float, dest="end", metavar="T", help="last time to show [s]")


def superelement_paths(options):
    """{element: path} of the option --superelement. @raises InputError"""
    pairs = {}
    for text in options.superelement:
        element, separator, path = text.partition("=")
        if not separator or not element or not path:
            raise InputError(f"--superelement '{text}': ELEMENT=FILE.h5 is expected")
        pairs[element] = path
    return pairs


def names(text):
    """`a,b` -> [a, b]; None stays None."""
    return None if text is None else [name.strip() for name in text.split(",") if name.strip()]
