"""CONM2 of a Nastran file as point masses. (MSC Nastran Quick Reference Guide, "CONM2".)"""

import numpy as np

from ..messages import InputError
from .nastran_cards import mass_per_weight
from .tie_model import PointMass

IN_BASIC = -1  # CID by which X1 to X3 are coordinates in the basic system, no offsets


def read_masses(cards, grids):
    """All CONM2; one that cannot be read is delivered with the reason. @returns list of PointMass @raises InputError for a wrong
    PARAM,WTMASS"""
    factor = mass_per_weight(cards)
    return [_mass(card, grids, factor) for card in cards if card.name == "CONM2"]


def _mass(card, grids, factor):
    try:
        return _read(card, grids, factor)
    except InputError as reason:
        return PointMass(f"CONM2 {card.fields[1] if len(card.fields) > 1 else ''}".strip(), refused=str(reason))


def _read(card, grids, factor):
    number, system = card.integer(2), card.integer(3, 0)
    if number not in grids.rows:
        raise InputError(f"'{card.path}': line {card.line}: it names the node {number}, which does not exist")
    node = grids.rows[number]
    x = np.array([card.number(k, 0.0) for k in (5, 6, 7)])
    axes = np.eye(3) if system == IN_BASIC else grids.systems.axes_at(system, grids.points[node], card)
    position = x if system == IN_BASIC else grids.points[node] + axes @ x
    i11, i21, i22, i31, i32, i33 = (card.number(k, 0.0) for k in range(9, 15))
    inertia = np.array([[i11, -i21, -i31], [-i21, i22, -i32], [-i31, -i32, i33]])  # I21 = int x1 x2 dm
    return PointMass(f"CONM2 {card.integer(1)}", factor * card.number(4, 0.0), position, factor * axes @ inertia @ axes.T, node)
