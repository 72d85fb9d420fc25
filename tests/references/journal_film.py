"""Journal bearings of finite length: load, attitude and the eight coefficients of small motions, by Reynolds' equation in two dimensions.

With lengths in radii, the film thickness h = 1 - a cos s - d sin s in clearances and the pressure p in 6 mu |B| R^2/c^3, the equation is
(h^3 p_s)_s + (h^3 p_z)_z = -cos s: central differences on a grid of s and z, whose results for two sizes are extrapolated to size zero
(errors of second order). B and s are those of mechanism/joints/flexible/journal_film.hpp. Three conditions at the edges of the film:

- half: p = 0 at s = -pi/2 and pi/2 (Guembel's condition for a steady journal, whose pressure is odd about the line of centres);
- supplied: p begins at s = -pi/2, the widest gap of a steady journal, to which the oil is supplied, and p and its slope vanish at the end of
  the film (Reynolds' condition of Swift and Stieber), which is found by the complementarity of p and the residual;
- reynolds: p and its slope vanish at the end and at the beginning of the film, which are found likewise.

H. J. Butenschoen's values (Das hydrodynamische, zylindrische Gleitlager endlicher Breite unter instationaerer Belastung, Karlsruhe 1976,
those of DIN 31652) have Reynolds' condition; they are as quoted by the tests of octave-user/mboct-mbdyn-pkg (mbdyn_post_ehd_load_output_01.tst); their films are supplied at the widest gap.
A. A. Raimondi and J. Boyd's (ASLE Trans. 1, 1958, 159-209) are the numbers S = mu n (R/c)^2/P of their table of full bearings, with the
same condition. The script fails if its solution does not have them, to 0.3 % and 0.1 degrees (Butenschoen's loads are lower the narrower
the peak of the pressure is, and one of his angles, for L/D = 1/4 and 0.2, is not in line with its neighbours), and to 1.5 %.
"""
import numpy as np
import scipy.sparse as sparse
from scipy.sparse.linalg import spsolve

import table

PUBLISHED = (0.1, 0.2, 0.4, 0.6, 0.8, 0.9)
LOADS = {1: (0.1196, 0.2518, 0.6108, 1.3146, 3.5663, 8.4352), 0.5: (0.0368, 0.0783, 0.2026, 0.4982, 1.7339, 5.0881), 0.25: (0.0098, 0.0210, 0.0560, 0.1476, 0.6043, 2.1595)}
ANGLES = {1: (79.410, 73.858, 62.571, 50.536, 36.235, 26.482), 0.5: (81.767, 75.142, 61.778, 48.049, 32.938, 23.566), 0.25: (82.481, 75.287, 61.208, 46.825, 31.249, 21.790)}
RAIMONDI_BOYD = {1: (1.33, 0.631, 0.264, 0.121, 0.0446, 0.0188), 0.5: (4.31, 2.03, 0.779, 0.319, 0.0923, 0.0313), 0.25: (16.2, 7.57, 2.83, 1.07, 0.261, 0.0736)}


# Cells with pressure of the last solution on a grid, from which the next search begins. The solution is unique, and does
# not depend on them.
WET = {}


def pressure_force(a, d, slenderness, condition, parts):
    """Returns the integrals of p cos s and p sin s over the film, on a grid with a number of parts over half of the
    circumference."""
    closed = condition == "reynolds"
    n, m = (parts if condition == "half" else 2 * parts), parts // 4
    ds, dz = np.pi / parts, slenderness / m
    s = -np.pi / 2 + ds * (np.arange(n) if closed else np.arange(1, n))
    n = len(s)
    cube = lambda at: (1 - a * np.cos(at) - d * np.sin(at))**3
    after, before, here = cube(s + ds / 2) / ds**2, cube(s - ds / 2) / ds**2, cube(s) / dz**2
    along = sparse.diags([after + before, -after[:-1], -before[1:]], [0, 1, -1]).tolil()
    if closed:
        along[0, n - 1], along[n - 1, 0] = -before[0], -after[-1]
    # The grid covers half of the length, with symmetry at z = 0. The first row is halved, which makes the matrix
    # symmetric.
    half = np.ones(m)
    half[0] = 0.5
    across = sparse.diags([2 * half, -np.ones(m - 1), -np.ones(m - 1)], [0, 1, -1])
    matrix = (sparse.kron(along, sparse.diags(half)) + sparse.kron(sparse.diags(here), across)).tocsc()
    source = np.kron(np.cos(s), half)
    wet = np.ones(len(source), bool) if condition == "half" else WET.get((condition, parts), source > 0)
    for _ in range(200):
        p = np.zeros(len(source))
        p[wet] = spsolve(matrix[wet][:, wet], source[wet])
        if condition == "half":
            break
        positive = p + 1e-3 * (source - matrix @ p) > 0
        if (positive == wet).all():
            WET[condition, parts] = wet
            break
        wet = positive
    else:
        raise RuntimeError("no edge of the film")
    rows = 2 * dz * ds * p.reshape(n, m) @ half
    return np.array([rows @ np.cos(s), rows @ np.sin(s)])


def force(e, v, slenderness, condition="half", parts=96):
    """Returns the force on the bush in mu L R^3/c^2 times 1/s, from the displacement e and velocity v [1/s] in
    clearances of a journal that rotates with 1/s."""
    B = 2 * np.asarray(v) + np.array([e[1], -e[0]])
    size = np.hypot(*B)
    u = B / size
    w = np.array([-u[1], u[0]])
    coarse, fine = (pressure_force(u @ e, w @ e, slenderness, condition, count) for count in (parts, 2 * parts))
    W = (4 * fine - coarse) / 3
    return 6 * size * (W[0] * u + W[1] * w) / (2 * slenderness)


def steady(eps, slenderness, condition, parts=96):
    """Returns Sommerfeld's number P psi^2/(mu omega), and the angle between load and eccentricity [degrees]."""
    N = force((eps, 0), (0, 0), slenderness, condition, parts)
    return np.hypot(*N) / 2, np.degrees(np.arctan2(-N[1], N[0]))


def slopes(eps, slenderness, kind, condition="half", parts=96, step=1e-3):
    """Returns the columns by x and y of the stiffness or damping about the steady journal, not divided by the load."""
    columns = []
    for k in range(2):
        moved = step * np.eye(2)[k]
        ends = [force(np.array([eps, 0]) + (sign * moved if kind == "stiffness" else 0), sign * moved if kind == "damping" else (0, 0), slenderness, condition, parts) for sign in (2, 1, -1, -2)]
        columns.append((8 * (ends[1] - ends[2]) - (ends[0] - ends[3])) / (12 * step))
    return columns


def check_published():
    for slenderness in LOADS:
        for eps, load, angle, number in zip(PUBLISHED, LOADS[slenderness], ANGLES[slenderness], RAIMONDI_BOYD[slenderness]):
            found, at = steady(eps, slenderness, "supplied", 64)
            if abs(found - load) > 3e-3 * load + 5e-5 or abs(at - angle) > 0.1:
                raise RuntimeError(f"L/D {slenderness}, eccentricity {eps}: {found:.5g}, {at:.3f} degrees; published {load}, {angle}")
            if abs(1 / (2 * np.pi * found) - number) > 0.015 * number:
                raise RuntimeError(f"L/D {slenderness}, eccentricity {eps}: {1 / (2 * np.pi * found):.5g}; Raimondi and Boyd {number}")


def add_coefficients(rows, name, columns, load, within):
    for kind, slope in columns.items():
        for k, column in enumerate("xy"):
            for row, value in zip("xy", slope[k] / (2 * load)):
                rows.add(f"{name}.{kind}_{row}{column}", value, within * (1 + abs(value)), f"c/W times the {kind} (damping times omega); x along the eccentricity")


def fill(rows):
    check_published()
    for slenderness in (1, 0.5, 0.25):
        for eps in (0.1, 0.4, 0.6, 0.8, 0.9):
            name = f"half.{slenderness}.{eps}"
            load, angle = steady(eps, slenderness, "half")
            rows.add(f"{name}.load", load, 1e-5 * load, f"P psi^2/(mu omega) of the half film at L/D {slenderness} and eccentricity {eps}")
            rows.add(f"{name}.angle", angle, 1e-3, "between load and eccentricity (degrees)")
            if eps in (0.4, 0.8):
                add_coefficients(rows, name, {kind: slopes(eps, slenderness, kind) for kind in ("stiffness", "damping")}, load, 1e-4)
    # The edge of the film moves from cell to cell: steps of the differences are longer.
    for slenderness in (2, 1, 0.5, 0.25):
        for eps in (0.1, 0.4, 0.6, 0.8, 0.9):
            name = f"reynolds.{slenderness}.{eps}"
            load, angle = steady(eps, slenderness, "reynolds", 64)
            rows.add(f"{name}.load", load, 3e-4 * load, f"P psi^2/(mu omega) with Reynolds' condition at both edges at L/D {slenderness} and eccentricity {eps}")
            rows.add(f"{name}.angle", angle, 1e-2, "between load and eccentricity (degrees)")
            if eps in (0.4, 0.8) and slenderness in (1, 0.5):
                columns = {kind: slopes(eps, slenderness, kind, "reynolds", 64, 1e-2) for kind in ("stiffness", "damping")}
                add_coefficients(rows, name, columns, load, 1e-3)
    for slenderness, loads in LOADS.items():
        for eps, load, angle in zip(PUBLISHED, loads, ANGLES[slenderness]):
            rows.add(f"published.{slenderness}.{eps}.load", load, 3e-3 * load + 5e-5, f"of Butenschoen at L/D {slenderness} and eccentricity {eps}")
            rows.add(f"published.{slenderness}.{eps}.angle", angle, 0.1, "of Butenschoen (degrees)")


if __name__ == "__main__":
    table.run(fill, __file__)
