"""The contents of a Nastran file besides its mesh: materials, rigid elements, point masses.

Some of them have no counterpart in a superelement. Nothing is ignored without a message: materials are reported as
lines of a body file, RBE2 and RBE3 become ties that an interface can name (nastran_ties) and sets of their nodes, everything
else is reported with its numbers.
"""

from dataclasses import dataclass, field

import numpy as np

from ..messages import InputError, counted
from .left_out import LeftOut
from .nastran_cards import young_and_poisson
from .nastran_mesh import SHAPES
from .nastran_ties import read_nastran_ties

# Cards of stiffness, mass or conditions that solid cells do not represent.
LOST = ("CONM1", "CMASS1", "CMASS2", "CMASS3", "CMASS4", "CELAS1", "CELAS2", "CELAS3", "CELAS4", "CBUSH", "CBUSH1D", "CBAR", "CBEAM", "CROD",
        "CONROD", "CTUBE", "CSHEAR", "CVISC", "CDAMP1", "CDAMP2", "RBAR", "RBE1", "RROD", "RSPLINE", "RTRPLT", "MPC", "CGAP", "CWELD", "CFAST",
        "MAT2", "MAT3", "MAT8", "MAT9", "MAT9ORT", "MATORT", "GENEL", "DMIG")
# Cards of loads, supports, solutions and outputs, which a body does not have.
OF_ANALYSES = ("PARAM", "SPC", "SPC1", "SPCD", "SPCADD", "SUPORT", "LOAD", "FORCE", "MOMENT", "PLOAD", "PLOAD2", "PLOAD4", "GRAV", "RFORCE",
               "TEMP", "TEMPD", "EIGR", "EIGRL", "EIGC", "SET", "SET1", "SET3", "ASET", "ASET1", "DMI", "FREQ", "FREQ1", "TABLED1", "CORD1R", "CORD1C",
               "CORD1S", "CORD2R", "CORD2C", "CORD2S", "GRDSET", "PSHELL", "PELAS", "PBUSH", "PBAR", "PBARL", "PBEAM", "PBEAML", "PROD", "SPOINT",
               "MDLPRM", "DOMAINS", "BSURF", "BCPROP")
# Solid cells of other kinds: of order 3, of older programs, acoustic, cohesive.
OTHER_SOLIDS = ("CIHEX1", "CIHEX2", "CIHEX3", "CHEXA1", "CHEXA2", "CWEDGE", "CHACAB", "CHACBR", "CIFHEX", "CIFPENT", "CHEXCZ", "CPENTCZ", "CHEXAL")
READ = ("GRID", "MAT1", "PSOLID", "CONM2", "RBE2", "RBE3") + LOST
MOST_NAMED = 8
FEWEST_TIED = 3  # nodes that hold all rotations of a node


@dataclass
class Extras:
    """Sets of nodes by name, counted from 0, and sentences for the user."""

    point_sets: dict = field(default_factory=dict)
    notes: list = field(default_factory=list)


def read_extras(all_cards, grids, before=()):
    """@param grids: the grid points @param before: the lines before BEGIN BULK. @returns Extras. @raises InputError if a field of a card that is read should be a number
    and is not."""
    cards = {name: [] for name in READ}
    for card in all_cards:
        if card.name in cards:
            cards[card.name].append(card)
    _check_solids(all_cards)
    extras = Extras()
    _tell_control(extras, before)
    _tell_parts(extras, all_cards)
    _tell_supports(extras, all_cards)
    carriers = _tell_ties(extras, cards["RBE2"] + cards["RBE3"], grids)
    _tell_materials(extras, cards)
    _tell_masses(extras, cards["CONM2"], grids, carriers)
    for name in LOST:
        if cards[name]:
            extras.notes.append(f"left out: {counted(len(cards[name]), name)} ({_ids(cards[name])}), the first at {place_in(cards[name][0], all_cards)}, "
                                "which no solid cell stands for")
    return extras


def place_in(card, all_cards):
    """The place of a card in messages about a deck."""
    return f"line {card.line}" + (f" of '{card.path}'" if card.path != all_cards[0].path else "")


def _check_solids(all_cards):
    """@raises InputError for solid cells without which the body would have holes"""
    found = LeftOut()
    for card in all_cards:
        if card.name in OTHER_SOLIDS:
            found.add(card.name, 1, place_in(card, all_cards))
    if found:
        raise InputError(f"'{all_cards[0].path}': solid cells of types that Bielle does not read: {found.text()}; it reads CTETRA, CHEXA, CPENTA and "
                         "CPYRAM: remesh the body with these, or remove the cells")


def _tell_control(extras, before):
    """Reports the executive and the case control section."""
    solution = next((" ".join(line.replace("=", " ").split()) for line in before if line.lstrip().startswith("SOL ")), None)
    if before:
        extras.notes.append(f"left out: {counted(len(before), 'line')} before BEGIN BULK, which control an analysis" + (f" ({solution})" if solution else ""))


def _tell_supports(extras, all_cards):
    """Reports the sets of single-point constraints, which the mechanism or the interfaces replace."""
    cards = {}
    for card in all_cards:
        if card.name in ("SPC", "SPC1"):
            cards.setdefault(card.fields[1], []).append(card)
    if cards:
        sets = [f"{number or 'without a number'}: {counted(len(each), 'card')}, components {', '.join(sorted(set(_held(each))))}"
                for number, each in cards.items()]
        extras.notes.append("left out: supports, SPC " + "; ".join(sets[:MOST_NAMED]) + ("; ..." if len(sets) > MOST_NAMED else "")
                            + ": the body is free, and interfaces hold it")


def _held(cards):
    """The components that SPC and SPC1 hold."""
    for card in cards:
        for k in ([2] if card.name == "SPC1" else [3, 6]):
            if k < len(card.fields) and card.fields[k] and (card.name == "SPC1" or card.fields[k - 1]):
                yield card.fields[k]


def _tell_parts(extras, all_cards):
    skins = [card for card in all_cards if card.name == "PSHELL"]
    if skins:
        extras.notes.append(f"left out: the stiffness and mass of shells (PSHELL {_ids(skins)}): their cells are surfaces")
    known, unknown = set(READ + OF_ANALYSES) | set(SHAPES), LeftOut()
    for card in all_cards:
        if card.name not in known and not card.name.startswith("BEGIN"):
            unknown.add(card.name, 1, place_in(card, all_cards))
    if unknown:
        extras.notes.append(f"not read: {unknown.text()}")
    for card in all_cards:
        words = card.name + "".join(card.fields[1:])
        if card.name.startswith("BEGIN") and ("SUPER" in words or "MODULE" in words):
            extras.notes.append(f"line {card.line} begins a superelement or module of its own ({' '.join([card.name] + card.fields[1:]).strip()}): "
                                "its cells are read as part of the one body, not joined by anything but common grid points")


def _tell_ties(extras, cards, grids):
    """Makes sets of the nodes of the RBE2 and RBE3. @returns the name of the tie of each row of a reference node"""
    carriers = {}
    for tie in read_nastran_ties(cards, grids):
        if tie.refused:
            extras.notes.append(f"left out: {tie.name}: {tie.refused}")
            continue
        if len(tie.weights) < FEWEST_TIED:
            extras.notes.append(f"left out: {tie.name} ties {counted(len(tie.weights), 'node')}; an interface needs {FEWEST_TIED} that do not stand in one line")
            continue
        name = tie.name.lower().replace(" ", "_")
        extras.point_sets[name] = np.array(sorted(tie.weights), np.int64)
        carriers[tie.reference] = tie.name
        extras.notes.append(f"{tie.name} ({counted(len(tie.weights), 'node')}): the interface {{from: {tie.name}}} stands for it; the faces "
                            f"between its nodes are the surface '{name}'")
    return carriers


def _tell_materials(extras, cards):
    of_property = {}
    for card in cards["PSOLID"]:
        of_property.setdefault(card.integer(2), []).append(f"property_{card.integer(1)}")
    for card in cards["MAT1"]:
        number = card.integer(1)
        young, poisson = young_and_poisson(card)
        text = ", ".join(f"{key}: {value:g}" for key, value in
                         (("young", young), ("poisson", poisson), ("density", card.number(5, None))) if value is not None)
        users = ", ".join(of_property.get(number, [])) or "no property"
        extras.notes.append(f"MAT1 {number} of {users} is, in the file's units (the body file wants SI, or `materials: from_file`), mat_{number}: {{{text}}}")


def _tell_masses(extras, cards, grids, carriers):
    if not cards:
        return
    total = sum(card.number(4, 0.0) for card in cards)
    at = []
    for card in cards[:MOST_NAMED]:
        row = grids.rows.get(card.integer(2))
        place = f"the grid point {card.integer(2)}, which does not exist" if row is None else "({:g}, {:g}, {:g})".format(*grids.points[row])
        hangs = f", tied by {carriers[row]}" if row in carriers else ""
        at.append(f"{card.integer(1)}: {card.number(4, 0.0):g} at {place}{hangs}")
    more = f"; and {len(cards) - MOST_NAMED} more" if len(cards) > MOST_NAMED else ""
    extras.notes.append(f"{counted(len(cards), 'CONM2', 'CONM2')} with a mass of {total:g} in total, in the file's units: `masses: from_file` puts "
                        f"{'it' if len(cards) == 1 else 'them'} on the body ({'; '.join(at)}{more})")


def _ids(cards):
    return ", ".join(card.fields[1] for card in cards[:MOST_NAMED]) + (" ..." if len(cards) > MOST_NAMED else "")
