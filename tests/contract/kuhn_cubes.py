"""Cubes in a row along x, each of six tetrahedra with ten nodes around a diagonal, for decks."""

import itertools

import numpy as np


def kuhn_cubes(count):
    """@returns {place: node number} in units of an edge, and the ten nodes of each element, in the order of C3D10"""
    numbers, elements = {}, []
    for x in range(count):
        for path in itertools.permutations(np.eye(3, dtype=int)):
            corners = np.cumsum([np.array([x, 0, 0]), *path], axis=0)
            if np.linalg.det(corners[1:] - corners[0]) < 0:
                corners = corners[[0, 2, 1, 3]]
            middles = [(corners[a] + corners[b]) / 2 for a, b in ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))]
            elements.append([numbers.setdefault(tuple(map(float, place)), len(numbers) + 1) for place in (*corners, *middles)])
    return numbers, elements
