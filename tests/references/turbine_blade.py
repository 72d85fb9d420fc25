"""Frequencies of the blade of the NREL 5 MW turbine, clamped in its hub, at rest and in rotation.

J. Jonkman, S. Butterfield, W. Musial, G. Scott, Definition of a 5-MW reference wind turbine for offshore system
development, NREL/TP-500-38060 (2009); section constants in tests/verification/data. The blade is straight and lies in
the plane of rotation. With x along the rotor's axis, z along the blade, displacement u, rotation p, spin O and tension
T(z) of the centrifugal force, a linear rod about its stretched state has the energy
    2 U = integral g.S g + k.C k + T (2 (u_x' p_y - u_y' p_x) - (1 + e) (p_x^2 + p_y^2)),
    g = u' - (1 + e) p x e_z,   k = p',
with its stretch e = T/EA of up to 4e-4, which lowers the frequencies of bending, and the inertia of its sections in
rotating axes. Polynomials of degree 4 between the stations, at which the constants, linear in between, have their
kinks. Shear is rigid, as in FAST: the report has no shear stiffness. The stretch moves the masses by 1e-4 of their
radius, and the sections twist by 1e-5 rad, which is left out.
"""
import os

import numpy as np
import scipy.sparse
import scipy.sparse.linalg

import table

LENGTH, HUB, RATED = 61.5, 1.5, 12.1 * np.pi / 30  # [m, m, rad/s]
DATA = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "verification", "data", "nrel_5mw_blade.csv")
X, Y, Z = np.eye(3)


def cross(a):
    """Returns the matrix of the product a x."""
    return np.array([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]])


def section(values):
    """Returns the stiffness for forces and for moments, and the rotary inertia per length, in the blade's axes."""
    twist, flap_inertia, edge_inertia, flap, edge, torsion, axial = values
    c, s = np.cos(np.radians(twist)), np.sin(np.radians(twist))
    along, across = np.array([s, c, 0]), np.array([c, -s, 0])  # chordwise, and normal to it
    P, Q, R = np.outer(along, along), np.outer(across, across), np.outer(Z, Z)
    return (axial * R + 100 * axial * (P + Q), flap * P + edge * Q + torsion * R,
            flap_inertia * P + edge_inertia * Q + (flap_inertia + edge_inertia) * R)


def tension(z, mass):
    """Returns the centrifugal force per squared speed at the stations, and a function for places within a segment."""
    def beyond(k, at):
        nodes, weights = np.polynomial.legendre.leggauss(3)
        half = (z[k + 1] - at) / 2
        places = at + half * (1 + nodes)
        return half * np.sum(weights * np.interp(places, z, mass) * (HUB + places))
    total = np.zeros(len(z))
    for k in reversed(range(len(z) - 1)):
        total[k] = total[k + 1] + beyond(k, z[k])
    return lambda k, at: total[k + 1] + beyond(k, at)


def shape_functions(degree):
    """Returns Gauss points and weights on [-1, 1], with the values and slopes of Lagrange's polynomials there."""
    nodes = np.concatenate([[-1], np.polynomial.legendre.Legendre.basis(degree).deriv().roots(), [1]])
    points, weights = np.polynomial.legendre.leggauss(degree + 3)
    coefficients = np.linalg.inv(np.vander(nodes, increasing=True))
    powers = np.vander(points, degree + 1, increasing=True)
    slopes = np.zeros_like(powers)
    slopes[:, 1:] = powers[:, :-1] * np.arange(1, degree + 1)
    return points, weights, powers @ coefficients, slopes @ coefficients


def matrices(speed, degree):
    """Returns mass, gyroscopic and stiffness matrix of the clamped blade."""
    data = np.loadtxt(DATA, delimiter=",", skiprows=1)
    z, mass, others = LENGTH * data[:, 0], data[:, 2], data[:, [1, 3, 4, 5, 6, 7, 8]]
    force = tension(z, mass)
    points, weights, N, D = shape_functions(degree)
    size = 6 * (degree * (len(z) - 1) + 1)
    M, G, K = (scipy.sparse.lil_matrix((size, size)) for _ in range(3))
    spin = cross(speed * X)
    for k in range(len(z) - 1):
        half = (z[k + 1] - z[k]) / 2
        local = [np.zeros((6 * (degree + 1),) * 2) for _ in range(3)]
        for q, point in enumerate(points):
            share = (1 + point) / 2
            m = (1 - share) * mass[k] + share * mass[k + 1]
            S, C, J = section((1 - share) * others[k] + share * others[k + 1])
            T = speed**2 * force(k, z[k] + share * (z[k + 1] - z[k]))
            values, slopes = np.kron(N[q], np.eye(6)), np.kron(D[q] / half, np.eye(6))
            stretched = 1 + T / S[2, 2]
            strain = slopes[:3] + stretched * cross(Z) @ values[3:]
            lines = slopes[0:1].T @ values[4:5] - slopes[1:2].T @ values[3:4]
            momentum = J @ (speed * X)
            turned = spin @ (J @ spin - cross(momentum))
            stiffness = (strain.T @ S @ strain + slopes[3:].T @ C @ slopes[3:] +
                         T * (lines + lines.T - stretched * values[3:5].T @ values[3:5]) +
                         m * values[:3].T @ spin @ spin @ values[:3] +
                         values[3:].T @ ((turned + turned.T) / 2) @ values[3:])
            gyroscopic = 2 * m * values[:3].T @ spin @ values[:3] + values[3:].T @ (
                J @ spin - cross(momentum) + spin @ J) @ values[3:]
            inertia = m * values[:3].T @ values[:3] + values[3:].T @ J @ values[3:]
            for total, part in zip(local, (inertia, gyroscopic, stiffness)):
                total += half * weights[q] * part
        where = np.arange(6 * degree * k, 6 * degree * k + 6 * (degree + 1))
        for total, part in zip((M, G, K), local):
            total[np.ix_(where, where)] += part
    return [each.tocsc()[6:, 6:] for each in (M, G, K)]


def frequencies(speed, degree, count):
    """Returns the lowest frequencies [Hz]."""
    M, G, K = matrices(speed, degree)
    # With x exp(i w t) and y = w x, K x = w (M y - i G x): 1/w is an eigenvalue of (x, y) -> (K^-1 (M y - i G x), x).
    n = M.shape[0]
    factor = scipy.sparse.linalg.splu(K)

    def applied(v):
        right = M @ v[n:] - 1j * (G @ v[:n])
        return np.concatenate([factor.solve(right.real) + 1j * factor.solve(right.imag), v[:n]])
    operator = scipy.sparse.linalg.LinearOperator((2 * n, 2 * n), applied, dtype=complex)
    values = 1 / scipy.sparse.linalg.eigs(operator, k=2 * count + 2, return_eigenvectors=False, tol=1e-12,
                                          v0=np.ones(2 * n, dtype=complex))
    return np.sort(values.real[values.real > 0])[:count] / (2 * np.pi)


def fill(rows):
    for name, speed in (("rest", 0.0), ("rated", RATED)):
        found, coarse = frequencies(speed, 4, 6), frequencies(speed, 3, 6)
        for k in range(6):
            within = (5e-5 if speed else 2e-6) * found[k] + abs(found[k] - coarse[k])
            rows.add(f"{name}.{k + 1}", found[k], float(f"{within:.0e}"), f"frequency {k + 1} [Hz]")


if __name__ == "__main__":
    table.run(fill, __file__)
