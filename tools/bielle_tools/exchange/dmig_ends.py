"""Signs that a deck of DMIG cards was cut off: nothing in its format tells where it ends."""

import os

import numpy as np

from ..messages import InputError, counted

LONGEST = 1000  # characters of a last line that are looked at


def check_end(cards):
    """@returns notes @raises InputError for a file that ends within a DMIG card"""
    if not cards:
        return []
    last, line = cards[-1], _last_line(cards)
    if line.endswith((b"\r", b"\n")) or _is_end(line):
        return []
    if last.name == "DMIG":
        raise InputError(f"'{last.path}': line {last.line}: the file ends in the middle of a line, in the card "
                         f"'{' '.join(['DMIG', *last.fields[1:4]]).strip()}': it is cut off; if it is whole, end its last line")
    return [f"'{last.path}' ends in the middle of a line: it may be cut off"]


def last_matrix(cards):
    """Name of the matrix with which a deck ends; None if another card or ENDDATA follows it."""
    return cards[-1].fields[1] if cards[-1].name == "DMIG" and not _is_end(_last_line(cards)) else None


def _last_line(cards):
    with open(cards[-1].path, "rb") as file:
        file.seek(max(0, file.seek(0, os.SEEK_END) - LONGEST))
        return file.read().splitlines(keepends=True)[-1]


def _is_end(line):
    return line.strip().upper() == b"ENDDATA"


def check_modal_mass(deck, stiffness, mass):
    """@raises InputError for an amplitude of a mode that has stiffness but no mass. @param stiffness, mass: DmigMatrix"""
    massive = {deck.named(*row) for row, column, _ in mass.entries if deck.named(*row) == deck.named(*column)}
    lacking = sorted(({deck.named(*row) for row, _, _ in stiffness.entries} & deck.modal) - massive)
    if lacking:
        number, component = lacking[0]
        raise InputError(f"'{mass.header.path}': DMIG {mass.name} has no mass of {counted(len(lacking), 'amplitude')} of modes that "
                         f"{'has' if len(lacking) == 1 else 'have'} a stiffness, the first {number} {component}: its end is cut off, or "
                         "columns are missing")


def check_columns(matrix, filled, modal, is_last):
    """Notes on columns of a rectangular matrix that have no card.

    @param filled: (n) tells whether stiffness or mass has entries for an unknown @param modal: (n) tells whether it is the amplitude
    of a mode @param is_last: tells whether the deck ends with this matrix
    @raises InputError if the last ones are missing at the end of the deck, but not those of all modes"""
    width = len(filled)
    present = np.isin(np.arange(1, width + 1), [number for number, _ in matrix.columns])
    missing = np.flatnonzero(~present & filled)
    if not len(missing):
        return _short_column(matrix) if is_last else []
    told = (f"DMIG {matrix.name} has no card for {'the column' if len(missing) == 1 else f'{len(missing)} columns, the first'} "
            f"{missing[0] + 1} of {width}")
    ends_early = is_last and missing[-1] > np.flatnonzero(present).max(initial=-1)
    if ends_early and (present & modal).any():
        raise InputError(f"'{matrix.header.path}': line {matrix.header.line}: {told}: the end of the file is cut off; if a column is zero, "
                         f"write its card without rows: DMIG,{matrix.name},{missing[-1] + 1},0")
    return [f"{told}: zero, unless the file lacks lines"]


def _short_column(matrix):
    """A note if the last column of a matrix has rows, but not the last ones of the others: a file that was cut off between two lines does."""
    last = max(matrix.columns, default=None)
    own = max((row for row, column, _ in matrix.entries if column == last), default=(0, 0))
    others = max((row for row, column, _ in matrix.entries if column != last), default=(0, 0))
    if own >= others or not own[0]:
        return []
    return [f"the last column of DMIG {matrix.name}, {last[0]}, ends at the row {own[0]} {own[1]}, others at {others[0]} {others[1]}: the rest is "
            "zero, unless the file lacks lines"]
