"""Cards of a Nastran bulk data section: small, large and free field, continuations, INCLUDE.

Fields are upper case; 0 is the name without the star of a large field. (MSC Nastran Quick Reference Guide, "Format of
Bulk Data Entries".)
"""

import os
import re

from ..messages import InputError
from ..text_lines import lines_of

DEEPEST = 20  # files that include each other
INTEGER = re.compile(r"[+-]?\d+").fullmatch
SHORT_EXPONENT = re.compile(r"(?<=[\d.])([+-]\d+)$")  # 7.85-9 is 7.85e-9
INCLUDE = re.compile(r"\s*INCLUDE\b", re.IGNORECASE).match


def mass_per_weight(cards):
    """PARAM,WTMASS: the factor of all densities and masses of a file that gives weights. @raises InputError unless positive"""
    for card in cards:
        if card.name == "PARAM" and card.fields[1].upper() == "WTMASS":
            factor = card.number(2, 1.0)
            if not factor > 0:
                raise InputError(f"'{card.path}': line {card.line}: PARAM,WTMASS is {factor:g}; expected a positive number")
            return factor
    return 1.0


def young_and_poisson(card):
    """The constants of a MAT1, of which one follows from the other two; None for what cannot be known."""
    young, shear, poisson = (card.number(k, None) for k in (2, 3, 4))
    if young is None and None not in (shear, poisson):
        young = 2 * shear * (1 + poisson)
    if poisson is None and None not in (young, shear):
        poisson = young / (2 * shear) - 1
    return young, poisson


class Card:
    def __init__(self, path, line, fields):
        self.path, self.line, self.fields, self.name = path, line, fields, fields[0]

    def filled(self, first):
        return [k for k in range(first, len(self.fields)) if self.fields[k]]

    def is_integer(self, k):
        return k < len(self.fields) and INTEGER(self.fields[k]) is not None

    def integer(self, k, default=None):
        text = self.fields[k] if k < len(self.fields) else ""
        if default is not None and not text:
            return default
        if INTEGER(text):
            return int(text)
        self.fail(k, "an integer")

    def number(self, k, default):
        if k >= len(self.fields) or not self.fields[k]:
            return default
        text = self.fields[k]
        try:
            return float(text)
        except ValueError:
            pass
        try:
            return float(SHORT_EXPONENT.sub(r"e\1", text.replace("D", "E")))
        except ValueError:
            self.fail(k, "a number")

    def fail(self, k, expected):
        found = f"'{self.fields[k]}'" if k < len(self.fields) and self.fields[k] else "nothing"
        raise InputError(f"'{self.path}': line {self.line}: {self.name}: expected {expected} in field {k + 1}, found {found}")


class _Piece:
    """Lines of a card that stand before it, from the one with a mark on. end: field 10 of its last line"""

    def __init__(self, place, fields):
        self.place, self.fields, self.end = place, fields, ""


def read_cards(path, before=None):
    """@param before: a list that receives the lines before BEGIN BULK, in upper case. @returns list of Card, those of included files in
    their place. @raises InputError with file and line."""
    cards, last, end = [], None, ""
    waiting, early = {}, {}  # by mark: cards that wait for their next line, in order; and lines that came before their
                             # card
    for path_here, number, line in _bulk_lines(path, before):
        place = f"'{path_here}': line {number}"
        more, name, next_end = _split(line, place)
        mark = name.lstrip("+*")
        if name and not name.startswith(("+", "*")):
            last = Card(path_here, number, [name] + more)
            cards.append(last)
        elif waiting.get(mark):
            last = waiting[mark].pop(0)
            last.fields += more
        elif mark:
            if mark in early:
                raise InputError(f"{place}: the mark '+{mark}' begins another line, {early[mark].place}, and no line before them ends with it")
            last = early[mark] = _Piece(place, more)
        elif last:
            last.fields += more
        elif any(more):
            raise InputError(f"{place}: a continuation without a card before it")
        end = next_end
        while end in early and early[end] is not last:
            piece = early.pop(end)
            last.fields += piece.fields
            end = piece.end
        if isinstance(last, _Piece):
            last.end = end
        if end:
            waiting.setdefault(end, []).append(last)
    for mark, piece in early.items():
        raise InputError(f"{piece.place}: no line of the deck ends with the mark '+{mark}' of this continuation")
    return cards


def _bulk_lines(path, before):
    lines = list(_lines(path, os.path.dirname(path), 0))
    begin = next((k for k, (_, _, text) in enumerate(lines) if re.match(r"BEGIN\s+BULK", text)), -1)
    if before is not None:
        before += [text for _, _, text in lines[:max(begin, 0)]]
    for place, number, text in lines[begin + 1:]:
        if text.startswith("ENDDATA"):
            return
        yield place, number, text


def _lines(path, main, depth):
    """Lines in upper case, without comments and empty lines, with file and line number of each. @param main: the folder of the deck"""
    if depth > DEEPEST:
        raise InputError(f"'{path}' is included by itself")
    lines = lines_of(path)
    k = 0
    while k < len(lines):
        number, line = k + 1, lines[k].split("$")[0].rstrip()
        k += 1
        if INCLUDE(line):
            while line.count("'") == 1 and k < len(lines):  # a name in quotes may go on
                line += lines[k].strip()
                k += 1
            name = line.split(None, 1)[1].strip().strip("'\"") if len(line.split(None, 1)) > 1 else ""
            yield from _lines(_included(name, path, main, number), main, depth + 1)
        elif line:
            yield path, number, line.upper()


def _included(name, path, main, number):
    """The file that an INCLUDE names: next to the file with the INCLUDE, otherwise next to the deck."""
    folders = list(dict.fromkeys(os.path.abspath(folder) for folder in (os.path.dirname(path), main)))
    for folder in folders:
        for written in (name, name.replace("\\", "/")):
            if name and os.path.isfile(os.path.join(folder, written)):
                return os.path.join(os.path.dirname(path) if folder == folders[0] else main, written)
    raise InputError(f"'{path}': line {number}: INCLUDE '{name}': there is no such file in " + " or ".join(f"'{folder}'" for folder in folders))


def _split(line, place):
    """Returns the fields of a line after the first one, always as many as its format has; the first field; and field 10
    without its mark of continuation.

    @raises InputError for more fields than a line has"""
    if "," in line:
        parts = [part.strip() for part in line.split(",")]
        name = parts[0]
        wide = name.endswith("*") or name.startswith("*")
        count = 4 if wide else 8
        fields = (parts[1:] + [""] * count)[:count]
        end = parts[count + 1] if len(parts) > count + 1 else ""
        if any(parts[count + 2:]):
            raise InputError(f"{place}: {len(parts)} fields; a line has {count + 2} at the most: put the rest on a line that begins with ','")
    else:
        line = line.expandtabs(8)
        name = line[:8].strip()
        wide = "*" in name
        width, count = (16, 4) if wide else (8, 8)
        fields = [line[8 + k * width:8 + (k + 1) * width].strip() for k in range(count)]
        end = line[72:80].strip()
    return fields, (name.rstrip("*_") if name != "*" else name), end.lstrip("+*").strip()  # meshio writes CTETRA_
