"""State spaces written by the analysis `state_space`: reading, and reduction to their slow part.

    system = read("arm.h5")
    small = reduced(system, below=200)                      # modes up to 200 Hz, the others as statics
    scipy.signal.StateSpace(*standard(small))
"""

from dataclasses import dataclass

import h5py
import numpy as np
from scipy import linalg

from ..messages import InputError


@dataclass
class StateSpace:
    """E x' = A x + B u, y = C x + D u with regular E."""

    E: np.ndarray
    A: np.ndarray
    B: np.ndarray
    C: np.ndarray
    D: np.ndarray
    inputs: list
    outputs: list


def read(path):
    """The last state space of a results file."""
    with h5py.File(path, "r") as file:
        if "state_space/A" not in file:
            raise InputError(f"'{path}' holds no state space: its run needs an analysis `state_space` of something that can move")
        group = file["state_space"]
        matrices = [group[name][()] for name in "EABCD"]
        return StateSpace(*matrices, *(list(group[name].asstr()) for name in ("inputs", "outputs")))


def standard(system):
    """A, B, C, D with E = 1."""
    return np.linalg.solve(system.E, system.A), np.linalg.solve(system.E, system.B), system.C, system.D


def response(system, frequency):
    """Complex amplitudes of the outputs per unit of the inputs at a frequency [Hz]."""
    return system.C @ np.linalg.solve(2j * np.pi * frequency * system.E - system.A, system.B) + system.D


def reduced(system, below):
    """Modal truncation: the modes with |s|/2 pi up to `below` [Hz], real; faster ones follow without delay, so that the
    response at 0 Hz stays exact. The split is one of invariant subspaces (ordered QZ), which works with double
    eigenvalues of rigid motions."""
    limit = 2 * np.pi * below
    if not below > 0:
        raise InputError(f"expected a frequency above 0 Hz, got {below}")
    AA, EE, alpha, beta, Q, Z = linalg.ordqz(system.A, system.E, sort=lambda a, b: np.abs(a) <= limit * np.abs(b), output="real")
    n = int(np.sum(np.abs(alpha) <= limit * np.abs(beta)))
    A1, A12, A2 = AA[:n, :n], AA[:n, n:], AA[n:, n:]
    E1, E12, E2 = EE[:n, :n], EE[:n, n:], EE[n:, n:]
    # [1, -L; 0, 1] and [1, R; 0, 1] remove the coupling: R - S R G = X with slow S and inverse fast G, by doubling.
    S, G = np.linalg.solve(E1, A1), np.linalg.solve(A2, E2)
    R = np.linalg.solve(E1, A12 @ G - E12)
    while n and len(A2) and np.linalg.norm(S) * np.linalg.norm(G) > 0:
        step = S @ R @ G
        if np.linalg.norm(step) <= 1e-16 * np.linalg.norm(R):
            break
        R, S, G = R + step, S @ S, G @ G
    L = np.linalg.solve(E2.T, (E1 @ R + E12).T).T
    B1, B2 = Q.T[:n] @ system.B, Q.T[n:] @ system.B
    C1, C2 = system.C @ Z[:, :n], system.C @ (Z[:, :n] @ R + Z[:, n:])
    return StateSpace(E1, A1, B1 - L @ B2, C1, system.D - C2 @ np.linalg.solve(A2, B2), system.inputs, system.outputs)
