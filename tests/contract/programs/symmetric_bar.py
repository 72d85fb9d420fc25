"""A bar of square section whose mesh is as symmetric as the section, so that bending modes are pairs of equal
frequency."""

import itertools


def symmetric_bar(length_cells, half_cells, size=0.01):
    """Returns the text of a .msh file of first-order tetrahedra, 2 `half_cells` across, with surfaces `left` and
    `right` at the ends.

    Each brick is split into the six tetrahedra of Kuhn, along a diagonal that points away from the bar's axis. The mesh
    is symmetric about both middle planes and, since those tetrahedra do not distinguish axes, about the diagonal
    planes.
    """
    across, points, cells, faces = 2 * half_cells, {}, [], []

    def number(point):
        return points.setdefault(point, len(points) + 1)

    for i, j, k in itertools.product(range(length_cells), range(across), range(across)):
        y, z = (1 if j >= half_cells else -1), (1 if k >= half_cells else -1)
        start = (i, j if y > 0 else j + 1, k if z > 0 else k + 1)
        for order in itertools.permutations(range(3)):
            corner, corners = list(start), [start]
            for axis in order:
                corner[axis] += (1, y, z)[axis]
                corners.append(tuple(corner))
            even = order in ((0, 1, 2), (1, 2, 0), (2, 0, 1))
            if even != (y * z > 0):
                corners[0], corners[1] = corners[1], corners[0]
            cells.append([number(point) for point in corners])
            for group, place in ((1, 0), (2, length_cells)):
                face = [number(point) for point in corners if point[0] == place]
                if len(face) == 3:
                    faces.append((group, face))
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", "3", '2 1 "left"', '2 2 "right"', '3 3 "bar"',
             "$EndPhysicalNames", "$Nodes", str(len(points))]
    lines += [f"{n} {size * x} {size * (y - half_cells)} {size * (z - half_cells)}" for (x, y, z), n in points.items()]
    lines += ["$EndNodes", "$Elements", str(len(cells) + len(faces))]
    elements = [(4, 3, cell) for cell in cells] + [(2, group, face) for group, face in faces]
    lines += [f"{n} {kind} 2 {group} {group} " + " ".join(map(str, nodes))
              for n, (kind, group, nodes) in enumerate(elements, 1)]
    return "\n".join(lines + ["$EndElements", ""])
