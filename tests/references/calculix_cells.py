"""Stiffness and mass of single solid cells by CalculiX: quadratic forms u^T K v and u^T M v of four fields.

`affine` cells are images of the reference cell under a linear map; `distorted` ones have straight edges that are not
parallel. The material has E = 200000, Poisson's ratio 0.3 and the density 4. Reference tetrahedra have corners at 0 and
at the three unit points, wedges have this triangle from -1 to 1 in height, and hexahedra range from -1 to 1 in each
direction.
"""
import os
import shutil
import subprocess
import tempfile

import numpy as np

import table

# Corners, and the ends of the edges with mid-side nodes, in the order of the input files.
TETRAHEDRON = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
WEDGE = [(0, 0, -1), (1, 0, -1), (0, 1, -1), (0, 0, 1), (1, 0, 1), (0, 1, 1)]
HEXAHEDRON = [(-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1), (-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)]
EDGES = {4: [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)],
         6: [(0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)],
         8: [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]}
TYPES = {"C3D4": TETRAHEDRON, "C3D10": TETRAHEDRON, "C3D6": WEDGE, "C3D15": WEDGE, "C3D8": HEXAHEDRON, "C3D8I": HEXAHEDRON,
         "C3D20": HEXAHEDRON, "C3D20R": HEXAHEDRON}
A = np.array([[1.1, 0.2, -0.1], [0.1, 0.9, 0.3], [0.05, -0.2, 1.2]])


def nodes(kind):
    """Returns places in the reference cell."""
    corners = np.array(TYPES[kind], dtype=float)
    if int(kind.rstrip("IR")[3:]) == len(corners):
        return corners
    return np.concatenate([corners, [(corners[a] + corners[b]) / 2 for a, b in EDGES[len(corners)]]])


def distorted(x):
    """Adds products of coordinates, which keep the edges of wedges and hexahedra straight."""
    r, s, t = x.T
    return x @ A.T + 0.1 * np.array([r * t, 0.5 * s * t, -r * t]).T


def field(k, x):
    """Returns displacements at places (n,3), row by row."""
    return np.array([np.sin(1 + k + 2 * i + (1 + 0.3 * k) * x[:, 0] + (0.5 + 0.1 * k) * x[:, 1] - 0.7 * x[:, 2])
                     for i in range(3)]).T.ravel()


def matrices(kind, x):
    """Returns K and M (3n,3n), with unknowns node by node."""
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "cell.inp"), "w", encoding="utf-8") as file:
            file.write("*NODE, NSET=ALL\n")
            file.writelines(f"{k}, {p[0]:.10g}, {p[1]:.10g}, {p[2]:.10g}\n" for k, p in enumerate(x, 1))
            numbers = [str(k) for k in range(len(x) + 1)]
            numbers[0] = "1"
            rows = [numbers[:1] + numbers[1:]] if len(x) < 16 else [numbers[:16], numbers[16:]]
            file.write(f"*ELEMENT, TYPE={kind}, ELSET=E\n" + ",\n".join(", ".join(row) for row in rows) + "\n")
            file.write("*MATERIAL, NAME=M\n*ELASTIC\n2e5, 0.3\n*DENSITY\n4\n*SOLID SECTION, ELSET=E, MATERIAL=M\n"
                       "*STEP\n*FREQUENCY, SOLVER=MATRIXSTORAGE\n1\n*END STEP\n")
        subprocess.run(["ccx", "cell"], cwd=folder, check=True, capture_output=True)
        order = np.loadtxt(os.path.join(folder, "cell.dof"), dtype=str)
        place = [3 * (int(node) - 1) + int(direction) - 1 for node, direction in (word.split(".") for word in order)]
        K, M = (symmetric(np.loadtxt(os.path.join(folder, "cell." + ending)), place) for ending in ("sti", "mas"))
    # C3D8I has internal modes at additional nodes, whose amplitudes are condensed.
    count = 3 * len(x)
    outer, inner = K[:count, :count], K[count:, count:]
    coupling = K[:count, count:]
    return outer - coupling @ np.linalg.solve(inner, coupling.T), M[:count, :count]


def symmetric(rows, place):
    full = np.zeros((max(place) + 1,) * 2)
    for i, j, value in rows:
        a, b = place[int(i) - 1], place[int(j) - 1]
        full[a, b] = full[b, a] = value
    return full


def fill(rows):
    if shutil.which("ccx") is None:
        print("CalculiX is not installed (Debian: calculix-ccx)")
        raise SystemExit(77)
    for kind in TYPES:
        for shape in ("affine",) if len(TYPES[kind]) == 4 else ("affine", "distorted"):
            local = nodes(kind)
            x = local @ A.T if shape == "affine" else distorted(local)
            K, M = matrices(kind, x)
            fields = [field(k, x) for k in range(4)]
            for name, matrix, unit in ("K", K, "N/m"), ("M", M, "kg"):
                scale = max(abs(u @ matrix @ u) for u in fields)
                for i, u in enumerate(fields):
                    for j, v in enumerate(fields[:i + 1]):
                        rows.add(f"{kind}.{shape}.{name}.{i}{j}", u @ matrix @ v, 1e-11 * scale,
                                 f"form of fields {i} and {j} [{unit}]")


if __name__ == "__main__":
    table.run(fill, __file__)
