"""The exponential of a rigid motion, and one beam element of constant strain: energy, forces, trace of its stiffness.

The element has unit length, the strains log(A^-1 B) - d_0 and the stiffness diag(1 .. 6). Its forces are the
derivatives of its energy by increments of the nodes: inertial ones for positions, and those in the nodes' axes for
rotations. The trace is the sum of second derivatives by the same increments. Logarithms are closed forms with 60
digits.
"""
import mpmath
from mpmath import matrix, mpf

import table

D = [mpf(s) for s in ("1.1", "0.1", "-0.05", "0.2", "-0.3", "0.4")]
STRAIGHT = [1, 0, 0, 0, 0, 0]


def skew(v):
    return matrix([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


def rotation(v):
    """Returns exp(skew(v)) by its series."""
    return mpmath.expm(skew(v))


def exponential(d):
    S = matrix(4, 4)
    S[:3, :3] = skew(d[3:])
    for k in range(3):
        S[k, 3] = d[k]
    H = mpmath.expm(S)
    return H[:3, :3], H[:3, 3]


def logarithm(R, x):
    """Returns the logarithm of a motion whose angle is between 0 and pi."""
    sine = mpmath.sqrt(sum(((R[j, i] - R[i, j]) / 2)**2 for i, j in ((0, 1), (0, 2), (1, 2))))
    angle = mpmath.atan2(sine, (R[0, 0] + R[1, 1] + R[2, 2] - 1) / 2)
    psi = [angle / sine * (R[k[0], k[1]] - R[k[1], k[0]]) / 2 for k in ((2, 1), (0, 2), (1, 0))]
    P = skew(psi)
    half = angle / 2
    inverse = mpmath.eye(3) - P / 2 + (1 - half * mpmath.cot(half)) / angle**2 * P * P
    u = inverse * x
    return [*u, *psi]


def energy(moves):
    """Returns the energy if the nodes are moved by twelve increments."""
    R_B, x_B = exponential(D)
    R_A = rotation(moves[3:6])
    x_A = matrix(moves[:3])
    R_B, x_B = R_B * rotation(moves[9:]), x_B + matrix(moves[6:9])
    eps = [a - b for a, b in zip(logarithm(R_A.T * R_B, R_A.T * (x_B - x_A)), STRAIGHT)]
    return sum((k + 1) * e * e for k, e in enumerate(eps)) / 2


def fill(rows):
    mpmath.mp.dps = 60
    R, x = exponential(D)
    rows.add_vector("exponential", x, 1e-13, "position")
    rows.add("element.energy", energy([mpf(0)] * 12), 1e-14, "of the deformed element")
    h = mpf(10)**-15
    trace, force = 0, []
    for k in range(12):
        before, at, after = (energy([s if j == k else mpf(0) for j in range(12)]) for s in (-h, mpf(0), h))
        force.append((after - before) / (2 * h))
        trace += (after - 2 * at + before) / h**2
    # Returns the second node's force in its own axes.
    force[6:9] = list(R.T * matrix(force[6:9]))
    for k, name in enumerate(("first.force", "first.moment", "second.force", "second.moment")):
        rows.add_vector(f"element.{name}", force[3 * k:3 * k + 3], 1e-13, "on the element at rest")
    rows.add("element.trace", trace, 1e-12, "of the stiffness")


if __name__ == "__main__":
    table.run(fill, __file__)
