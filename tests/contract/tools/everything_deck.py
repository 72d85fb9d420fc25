"""One body in all forms of decks, of Nastran and of Abaqus: a mixture of all cells of order 2, two materials,
cylindrical coordinates in a rotated system, included files, skins, and continuation lines of every form."""

import numpy as np

from cell_decks import ABAQUS, CARDS, NASTRAN, TYPES, Box

KINDS = ("wedge", "hexahedron", "wedge", "end")
ORIGIN, AXES = np.array([-0.5, 0.25, 0.125]), np.array([[0., 1, 0], [0, 0, 1], [1, 0, 0]])  # axes of the system in rows


class Everything:
    """write(folder) writes deck.bdf and deck.inp with their included files."""

    def __init__(self):
        self.box = Box(KINDS, order=2)
        self.nastran_rows, self.abaqus_rows = self.box.rows(NASTRAN), self.box.rows(ABAQUS)
        self.x = np.array(self.box.points)
        middle = [np.mean([self.box.points[n] for n in corners], axis=0)[0] for _, corners in self.box.shapes]
        self.region = [1 if x < 0.3 else 2 for x in middle]
        self.skin = self._skin()

    def _skin(self):
        """Returns corners and middles of the faces at x = 0, which are quadrilaterals of wedges."""
        faces = []
        for _, corners in self.box.shapes:
            left = [n for n in corners if self.x[n][0] == 0]
            if len(left) == 4:
                a = sorted(left, key=lambda n: np.arctan2(*(self.x[n] - self.x[left].mean(axis=0))[1:]))
                faces.append(a + [self.box.at[frozenset((p, q))] for p, q in zip(a, a[1:] + a[:1])])
        return faces

    def cylindrical(self, n):
        a, b, c = AXES @ (self.x[n] - ORIGIN)
        return np.hypot(a, b), np.degrees(np.arctan2(b, a)), c

    # ---- Nastran --------------------------------------------------------------------------------------------------
    def grid(self, n):
        x, form = self.x[n], n % 4
        if form == 0:  # small field; all these numbers have few digits
            return f"GRID    {n + 1:8d}        " + "".join(f"{value:<8.6g}" for value in x)
        if form == 1:
            return f"grid, {n + 1}, , {x[0]:.17g}, {x[1]:.17g}, {x[2]:.17g}  $ a comment"
        r, angle, z = self.cylindrical(n)
        if form == 2:  # large field with marks
            return f"GRID*   {n + 1:16d}{7:16d}{r:16.13f}{angle:16.11f}*G{n}\n*G{n:<6d}{z:16.13f}"
        return f"GRID,{n + 1},7,{r:.17g},{angle:.17g},{z:.17g}"

    def card(self, number, shape, nodes):
        words = [str(number), str(self.region[number - 1])] + [str(n + 1) for n in nodes]
        rows, name, form = [words[k:k + 8] for k in range(0, len(words), 8)], CARDS[shape], number % 5
        if form == 0:
            return "\n".join(",".join([head, *row]) for head, row in zip([name, "+", "+"], rows))
        if form == 1:  # no marks
            return "\n".join(f"{head:8}" + "".join(f"{word:>8}" for word in row) for head, row in zip([name, "", ""], rows))
        if form == 2:  # marks in fields 10 and 1
            lines = []
            for k, row in enumerate(rows):
                head = name if k == 0 else f"+E{number}{'ab'[k - 1]}"
                tail = f"+E{number}{'ab'[k]}" if k + 1 < len(rows) else ""
                lines.append(f"{head:8}" + f"{''.join(f'{word:8}' for word in row):64}{tail}")
            return "\n".join(lines)
        if form == 3:  # free, with marks
            return "\n".join(",".join(([name] if k == 0 else [f"+F{number}{k}"]) + row + ([f"+F{number}{k + 1}"] if k + 1 < len(rows) else []))
                             for k, row in enumerate(rows))
        rows = [words[k:k + 4] for k in range(0, len(words), 4)]
        return "\n".join(f"{head:8}" + "".join(f"{word:>16}" for word in row) for head, row in zip([name + "*"] + ["*"] * len(rows), rows))

    def nastran(self, write):
        z, x = AXES[2], AXES[0]
        points = [ORIGIN, ORIGIN + z, ORIGIN + x]
        system = "CORD2C,7,0," + ",".join(f"{v:.6g}" if v % 1 else f"{v:.1f}" for v in np.ravel(points)[:6]) + "\n,"
        system += ",".join(f"{v:.6g}" if v % 1 else f"{v:.1f}" for v in points[2]) + "\n"
        grids = [self.grid(n) for n in range(len(self.x))]
        cards = [self.card(number, shape, nodes) for number, (shape, nodes) in enumerate(self.nastran_rows, 1)]
        skin = [",".join(["CQUAD8", str(9001 + k), "9"] + [str(n + 1) for n in face[:6]]) + "\n," + ",".join(str(n + 1) for n in face[6:])
                for k, face in enumerate(self.skin)]
        half = len(grids) // 2
        write("grids.inc", "$ grids\n" + "\n".join(grids[half:]) + "\n")
        write("cells.inc", "\n".join(cards) + "\nINCLUDE 'skins.inc'\n")
        write("skins.inc", "\n".join(skin) + "\n")
        write("deck.bdf", "SOL 103\nCEND\nTITLE = everything\nBEGIN BULK\n" + system + "\n".join(grids[:half]) + "\nINCLUDE 'grids.inc'\n"
              "include cells.inc\nMAT1    1       2.1+11          .3      7850.\nMAT1*                  2          7.0D10                             .33\n*                  2700.\n"
              "PSOLID,1,1\nPSOLID         2       2\nPSHELL,9,1,.001\nENDDATA\nGRID, this is not read\n")

    # ---- Abaqus ---------------------------------------------------------------------------------------------------
    def abaqus(self, write):
        half = len(self.x) // 2
        plain = "".join(f"{n + 1}, {a:.17g}, {b:.17g}, {c:.17g}\n" for n, (a, b, c) in enumerate(self.x[:half]))
        round_ = "".join(f"{n + 1},\t{r:.17g}, {t:.17g},{z:.17g},\n" for n in range(half, len(self.x)) for r, t, z in [self.cylindrical(n)])
        ends = np.concatenate([ORIGIN, ORIGIN + AXES[0], ORIGIN + AXES[1]])
        system = "*SYSTEM\n" + ", ".join(f"{v:.17g}" for v in ends[:6]) + "\n" + ", ".join(f"{v:.17g}" for v in ends[6:]) + "\n"
        cells = ""
        for shape in CARDS:
            for region in (1, 2):
                found = [(number, nodes) for number, (other, nodes) in enumerate(self.abaqus_rows, 1)
                         if other == shape and self.region[number - 1] == region]
                if found:
                    cells += f"*Element, type={TYPES[shape][1]},\n elset=property_{region}\n" + "".join(self.row(*each) for each in found)
        skin = "*ELEMENT, TYPE=S8R, ELSET=PROPERTY_9\n" + "".join(self.row(9001 + k, face) for k, face in enumerate(self.skin))
        write("nodes.inc", round_)
        write("cells.inp", cells + "*INCLUDE, INPUT=skins.inp\n")
        write("skins.inp", "** skins\n" + skin)
        write("deck.inp", "*HEADING\n everything, *not a keyword\n*NODE\n" + plain + system + "*NODE, SYSTEM=C\n*INCLUDE, INPUT=nodes.inc\n*SYSTEM\n"
              "*include, input=cells.inp\n*MATERIAL, NAME=mat_1\n*DENSITY\n7850.,\n*ELASTIC\n2.1E11, .3\n*MATERIAL, NAME=mat_2\n*ELASTIC, TYPE=ISOTROPIC\n"
              "7.D10, 0.33\n*DENSITY\n2700.\n*SOLID SECTION, ELSET=property_1, MATERIAL=MAT_1\n*SOLID SECTION, ELSET=PROPERTY_2, MATERIAL=mat_2\n"
              "*SHELL SECTION, ELSET=property_9, MATERIAL=mat_1\n0.001\n")

    @staticmethod
    def row(number, nodes):
        """Returns one element in lines of 3 to 16 words."""
        words, width = [str(number)] + [str(n + 1) for n in nodes], (3, 7, 16)[number % 3]
        return ",\n ".join(", ".join(words[k:k + width]) for k in range(0, len(words), width)) + "\n"

    def write(self, write):
        self.nastran(write)
        self.abaqus(write)
