"""Values of parameters in studies: lists, ranges, tables, and all combinations of several parameters.

Values are texts throughout, so that a user's text ("2*pi", "0.10") reaches the program unchanged. A range is computed
in decimal numbers: 0:0.3:4 gives 0, 0.1, 0.2, 0.3, not 0.30000000000000004.
"""

import csv
import decimal
import itertools
import re

from ..messages import InputError, counted

MOST_RUNS = 1_000_000
FORM = "FROM:TO:COUNT, log:FROM:TO:COUNT or values between commas"


def values_of(text, where):
    """`0:300:31` (evenly spaced), `log:1:1000:4` (evenly spaced logarithms), `1, 2, a*b` -> texts. where: for messages. @raises InputError"""
    text = text.strip()
    logarithmic = text.startswith("log:")
    words = (text[4:] if logarithmic else text).split(":")
    if len(words) == 1 and not logarithmic:
        values = [word.strip() for word in _split(text)]
        if not all(values):
            raise InputError(f"{where}: a value is missing in '{text}'; expected {FORM}")
        return values
    if len(words) != 3:
        raise InputError(f"{where}: '{text}' is no range; expected {FORM}")
    return spaced(*words, logarithmic, where)


def spaced(begin, end, count, logarithmic, where):
    """Texts of `count` values from `begin` to `end`, both included. @raises InputError"""
    begin, end = _number(begin, where), _number(end, where)
    count = _count(count, where)
    if not logarithmic:
        return [_text(begin + (end - begin) * k / (count - 1)) for k in range(count)]
    if begin <= 0 or end <= 0:
        raise InputError(f"{where}: a logarithmic range is between positive numbers; found {begin} and {end}")
    return [_text(begin if k == 0 else end if k == count - 1 else
                  (begin.ln() + (end.ln() - begin.ln()) * k / (count - 1)).exp()) for k in range(count)]


def stepped(begin, end, step, where):
    """Texts of begin, begin + step, ... up to `end`. @raises InputError"""
    begin, end, step = (_number(word, where) for word in (begin, end, step))
    if step == 0 or (end - begin) / step < 0:
        raise InputError(f"{where}: steps of {step} do not lead from {begin} to {end}")
    if (end - begin) / step >= MOST_RUNS:
        raise InputError(f"{where}: these are more than {MOST_RUNS} values")
    return [_text(begin + k * step) for k in range(int((end - begin) / step) + 1)]


def _split(text):
    """Splits at commas outside of brackets: `max(1, 2), 3` are two values."""
    parts, depth = [""], 0
    for letter in text:
        depth += (letter == "(") - (letter == ")")
        if letter == "," and depth <= 0:
            parts.append("")
        else:
            parts[-1] += letter
    return parts


def _number(word, where):
    try:
        number = decimal.Decimal(word.strip())
    except decimal.InvalidOperation:
        number = decimal.Decimal("nan")
    if not number.is_finite():
        raise InputError(f"{where}: a range is between numbers; found '{word.strip()}'")
    return number


def _count(word, where):
    if not re.fullmatch(r"\s*\d{1,9}\s*", word) or not 2 <= int(word) <= MOST_RUNS:
        raise InputError(f"{where}: the number of values of a range is a whole number from 2 on; found '{word.strip()}'")
    return int(word)


def _text(number):
    """The shortest text of the nearest double."""
    value = float(number)
    return str(int(value)) if value == int(value) and abs(value) < 1e15 else repr(value)


def grid(axes):
    """All combinations of {name: values}: the last name varies fastest. @returns names, rows. @raises InputError for too many"""
    count = 1
    for values in axes.values():
        count *= len(values)
    if count > MOST_RUNS:
        raise InputError(f"the grid has {count} runs; {MOST_RUNS} are possible")
    return list(axes), [list(row) for row in itertools.product(*axes.values())]


def combined(first, second):
    """Each row of a table with each row of another. @raises InputError for a parameter that is in both"""
    (names, rows), (more, others) = first, second
    for name in more:
        if name in names:
            raise InputError(f"the parameter '{name}' has its values in the table already")
    if len(rows) * len(others) > MOST_RUNS:
        raise InputError(f"table and grid make {len(rows) * len(others)} runs; {MOST_RUNS} are possible")
    return names + more, [row + other for row in rows for other in others]


def read_table(path):
    """@returns names and rows of texts of a CSV file with a header line. @raises InputError with file and line"""
    try:
        with open(path, newline="", encoding="utf-8-sig") as file:
            rows = [(number, [cell.strip() for cell in row]) for number, row in enumerate(csv.reader(file), start=1)]
    except OSError as error:
        raise InputError(f"cannot read '{path}': {error.strerror}") from None
    except (UnicodeDecodeError, csv.Error):
        raise InputError(f"'{path}' is no table: text is expected, its columns separated by commas") from None
    rows = [(number, row) for number, row in rows if any(row) and not row[0].startswith("#")]
    if not rows:
        raise InputError(f"'{path}' is empty; its first line names parameters of the model, each further line is a run")
    number, names = rows[0]
    if len(names) == 1 and len(re.split(r"[;\s]+", names[0])) > 1:
        raise InputError(f"{path}:{number}: columns are separated by commas; found '{names[0]}'")
    for name in names:
        if not name or names.count(name) > 1:
            raise InputError(f"{path}:{number}: the column name '{name}' is " + ("missing" if not name else "there twice"))
    for number, row in rows[1:]:
        if len(row) != len(names) or not all(row):
            raise InputError(f"{path}:{number}: "
                             f"{counted(len([c for c in row if c]), 'value')} for {counted(len(names), 'parameter')}")
    if len(rows) == 1:
        raise InputError(f"'{path}' has a header but no runs")
    return names, [row for _, row in rows[1:]]
