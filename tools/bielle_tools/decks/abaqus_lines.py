"""Keywords of Abaqus and CalculiX input files with their options and data lines.

*INCLUDE is replaced by the lines of the file, as both programs do: a file may hold data lines alone. (Abaqus Analysis
Guide, "Input syntax rules"; Abaqus Keywords Guide, "*INCLUDE".)
"""

import os
import re
from dataclasses import dataclass, field

from ..messages import InputError
from ..text_lines import lines_of


@dataclass
class Keyword:
    """name: upper case; options: {upper-case name: value}; rows: data lines without comments; places: file and line of each."""

    name: str
    options: dict
    path: str
    line: int
    rows: list = field(default_factory=list)
    places: list = field(default_factory=list)

    @property
    def where(self):
        return f"{self.path}:{self.line}"

    def table(self, convert):
        """convert(words) of each data line. @raises InputError with the line for which it raises a ValueError"""
        found = []
        for row, (path, line) in zip(self.rows, self.places):
            try:
                found.append(convert([word.strip() for word in row.split(",")]))
            except ValueError as error:
                raise InputError(f"{path}:{line}: *{self.name}: {error}") from None
        return found


def read_keywords(path):
    """@returns list of Keyword. @raises InputError with file and line."""
    keywords, continued = [], False
    for place, number, line in _lines(path, ()):
        if continued:  # a keyword line that ends with a comma
            keywords[-1] = _keyword(place, keywords[-1].line, continued + line)
            continued = continued + line if line.endswith(",") else False
        elif line.startswith("*"):
            keywords.append(_keyword(place, number, line))
            continued = line if line.endswith(",") else False
        elif keywords:
            keywords[-1].rows.append(line)
            keywords[-1].places.append((place, number))
    for keyword in keywords:
        if "INPUT" in keyword.options and keyword.name in ("NODE", "ELEMENT", "NSET", "ELSET"):
            _add_rows_of_file(keyword)
    return keywords


def number(word):
    """A number with Fortran's exponents. @raises ValueError"""
    try:
        return float(word)
    except ValueError:
        pass
    try:
        return float(re.sub("[dD]", "e", word))
    except ValueError:
        raise ValueError(f"expected a number, found '{word}'") from None


def numbers(words, count):
    """As many numbers; those that are left out are 0. @raises ValueError if there are more or one is none"""
    filled = words[:-1] if words and not words[-1] else words
    if len(filled) > count:
        raise ValueError(f"expected {count} numbers at most, found {len(filled)}")
    return [number(word) if word else 0.0 for word in filled] + [0.0] * (count - len(filled))


def integer(word):
    """@raises ValueError"""
    try:
        return int(word)
    except ValueError:
        raise ValueError(f"expected an integer, found '{word}'") from None


def _lines(path, within, told=""):
    """Lines without comments and empty ones, with file and line number of each, those of included files in their place."""
    if os.path.abspath(path) in within:
        raise InputError(f"{told}'{path}' is included by itself")
    for line_number, text in enumerate(lines_of(path, told), 1):
        line = text.strip()
        if not line or line.startswith("**"):
            continue
        if line[0] == "*" and re.match(r"\*\s*INCLUDE\s*(,|$)", line, re.IGNORECASE):
            name = _keyword(path, line_number, line).options.get("INPUT")
            if not name:
                raise InputError(f"{path}:{line_number}: *INCLUDE: no file (INPUT=...)")
            yield from _lines(os.path.join(os.path.dirname(path), name), (*within, os.path.abspath(path)), f"{path}:{line_number}: ")
        else:
            yield path, line_number, line


def _keyword(path, line_number, line):
    words = [word.strip() for word in line[1:].split(",")]
    options = {}
    for word in words[1:]:
        key, _, value = word.partition("=")
        options[re.sub(r"\s+", " ", key.strip()).upper()] = value.strip().strip('"')
    return Keyword(re.sub(r"\s+", " ", words[0]).upper(), options, path, line_number)


def _add_rows_of_file(keyword):
    name = os.path.join(os.path.dirname(keyword.path), keyword.options["INPUT"])
    for line_number, text in enumerate(lines_of(name, f"{keyword.where}: "), 1):
        line = text.strip()
        if line and not line.startswith("*"):
            keyword.rows.append(line)
            keyword.places.append((name, line_number))
