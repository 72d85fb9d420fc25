"""RBE2 and RBE3 of a Nastran file as ties. (MSC Nastran Quick Reference Guide, "RBE2", "RBE3".)"""

from ..messages import InputError
from .tie_model import Tie, TieRefusal, check_translations, check_weight, direction_words


class _MissingNode(InputError):
    """An error of the deck, which concerns its mesh, too."""


def read_nastran_ties(cards, grids):
    """All RBE2 and RBE3; one that can be no interface is delivered with the reason. @returns list of Tie @raises InputError for
    a grid point that does not exist"""
    return [_tie(card, grids) for card in cards if card.name in _READERS]


def _tie(card, grids):
    tie = Tie(f"{card.name} {card.fields[1] if len(card.fields) > 1 else ''}".strip())
    try:
        if card.integer(1) <= 0:
            card.fail(1, "a positive number")
        tie.name = f"{card.name} {card.integer(1)}"
        _READERS[card.name](card, grids, tie)
    except _MissingNode:
        raise
    except (InputError, TieRefusal) as reason:
        tie.refused = str(reason)
    return tie


def _groups(card, rows):
    """Triples of weight, components and grid points. @raises InputError for fields that are neither"""
    if card.name == "RBE2":
        return [(1.0, _components(card, 3), _numbers(card, rows, [k for k in card.filled(4) if _is_entry(card, k)]))]
    found, k, end = [], 5, _end(card)
    while k < end:
        if not card.fields[k]:
            k += 1
            continue
        if card.is_integer(k) or card.fields[k] == "THRU":
            card.fail(k, "a weight with a decimal point")
        weight, taken, k = card.number(k, 0.0), _components(card, k + 1), k + 2
        first = k
        while k < end and (not card.fields[k] or card.is_integer(k) or card.fields[k] == "THRU"):
            k += 1
        found.append((weight, taken, _numbers(card, rows, [i for i in range(first, k) if card.fields[i]])))
    return found


def _end(card):
    return next((k for k in range(5, len(card.fields)) if card.fields[k] in ("UM", "ALPHA")), len(card.fields))


def _is_entry(card, k):
    """Tells a grid point or THRU from the thermal expansion ALPHA of an RBE2, a real number."""
    if card.is_integer(k) or card.fields[k] == "THRU":
        return True
    card.number(k, None)
    return False


def _components(card, k):
    """A set of components 1 to 6. @raises InputError"""
    text = card.fields[k] if k < len(card.fields) else ""
    if not text or not set(text) <= set("123456"):
        card.fail(k, "components out of 1 to 6")
    return {int(digit) for digit in text}


def _numbers(card, rows, fields):
    """Grid points in the given fields, with ranges `a THRU b`, all of which exist."""
    found, i = [], 0
    while i < len(fields):
        if card.fields[fields[i]] == "THRU":
            if not found or i + 1 == len(fields):
                card.fail(fields[i], "a grid point before and after THRU")
            first, last = found[-1], card.integer(fields[i + 1])
            if last < first:
                card.fail(fields[i + 1], f"a grid point from {first} on")
            _check_exist(card, range(first + 1, last + 1), rows)  # before a list is made of a range that may be large
            found += range(first + 1, last + 1)
            i += 2
        else:
            found.append(card.integer(fields[i]))
            _check_exist(card, found[-1:], rows)
            i += 1
    return found


def _check_exist(card, numbers, rows):
    """@raises _MissingNode for the first grid point that does not exist"""
    missing = next((number for number in numbers if number not in rows), None)
    if missing is not None:
        raise _MissingNode(f"'{card.path}': line {card.line}: {card.name} {card.integer(1)} names the node {missing}, which does not exist")


def _reference(card, k, grids, tie):
    number = card.integer(k)
    _check_exist(card, [number], grids.rows)
    tie.reference = grids.rows[number]
    tie.position, tie.axes = grids.points[tie.reference], grids.axes(number)


def _rbe2(card, grids, tie):
    _reference(card, 2, grids, tie)
    tie.kind = "rigid"
    ((_, taken, numbers),) = _groups(card, grids.rows)
    tie.weights = {grids.rows[number]: 1.0 for number in numbers}
    check_translations(taken, "its nodes")


def _rbe3(card, grids, tie):
    _reference(card, 3, grids, tie)
    tie.kind = "average"
    tie.directions = direction_words(_components(card, 4))
    if "UM" in card.fields[5:]:
        raise TieRefusal("it makes nodes of its mean dependent (UM), which an interface does not")
    for weight, taken, numbers in _groups(card, grids.rows):
        check_translations(taken, f"the node {numbers[0]}" if len(numbers) == 1 else f"{len(numbers)} nodes")
        for number in numbers:
            check_weight(weight, number)
            if weight > 0:
                tie.weights[grids.rows[number]] = tie.weights.get(grids.rows[number], 0.0) + weight


_READERS = {"RBE2": _rbe2, "RBE3": _rbe3}
