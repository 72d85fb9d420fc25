"""Numbers in the lines of text files: a fixed count on each line, Fortran's exponents, comment lines."""

import re

import numpy as np

from ..decks.abaqus_lines import number
from ..messages import InputError, counted

LARGEST = 2**53  # whole numbers up to here are exact as floating-point numbers


def number_rows(path, texts, count, first=1, delimiter=None, comment="**"):
    """Numbers of lines, those without any and comments left out.

    @param texts: the lines; first: number of the first one; delimiter: None for blanks
    @returns (n,count). @raises InputError with the line that does not hold `count` numbers
    """
    kept = [text for text in texts if text.strip() and not text.lstrip().startswith(comment)]
    if not kept:
        return np.empty((0, count))
    try:
        found = np.loadtxt(kept, delimiter=delimiter, comments=None, ndmin=2)
        if found.shape[1] == count:
            return found
    except ValueError:  # Fortran's exponents, commas at the ends of lines, or a fault
        pass
    return np.array([_numbers(path, line, text, count, delimiter) for line, text in enumerate(texts, first)
                     if text.strip() and not text.lstrip().startswith(comment)])


def _numbers(path, line, text, count, delimiter):
    words = [word.strip() for word in text.split(delimiter)]
    if delimiter and words and not words[-1]:
        words.pop()
    try:
        found = [number(word) for word in words]
    except ValueError as error:
        raise InputError(f"{path}:{line}: {error}") from None
    if len(found) != count:
        raise InputError(f"{path}:{line}: expected {counted(count, 'number')}, found {len(found)}")
    return found


def number_list(path, texts, first=1, comment="**"):
    """All numbers of lines, however many stand on each, with blanks or commas between them. @raises InputError with the line"""
    found = []
    for line, text in enumerate(texts, first):
        if text.lstrip().startswith(comment):
            continue
        try:
            found += [number(word) for word in re.split(r"[,\s]+", text) if word]
        except ValueError as error:
            raise InputError(f"{path}:{line}: {error}") from None
    return np.array(found)


def whole(path, values, what):
    """Numbers as integers. @param what: noun for the message. @raises InputError if one is no whole number"""
    values = np.asarray(values, float)
    with np.errstate(invalid="ignore"):
        wrong = ~(np.abs(values) < LARGEST) | (values != np.floor(values))
    if wrong.any():
        raise InputError(f"'{path}': {what} is {values[wrong][0]:g}, but must be a whole number")
    return values.astype(np.int64)
