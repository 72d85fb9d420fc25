"""Fuzz of mesh files: numbers and lines are exchanged, removed or doubled, and bytes damaged."""

import os
import unittest

import meshio
import numpy as np

from fuzzing import FuzzTest, damaged_bytes
from box_mesh import box
from test_reduce_meshes import write_unv

BODY = """\
body: box
geometry: FILE
materials:
  steel: {young: 210e9, poisson: 0.3, density: 7850}
regions: {all: steel}
interfaces:
  left: {surface: {plane: {point: [0, 0, 0], normal: [1, 0, 0]}}, tie: rigid}
modes: {count: 2}
"""
FORMATS = {"box2.msh": {"file_format": "gmsh22", "binary": False}, "box4.msh": {"file_format": "gmsh", "binary": False},
           "binary.msh": {"file_format": "gmsh", "binary": True}, "box.inp": {"file_format": "abaqus"}}


def mutated(rng, data):
    """Makes one to three changes of numbers or lines."""
    lines = data.split(b"\n")
    note = []
    for _ in range(rng.choice([1, 1, 2, 3])):
        number = rng.randrange(len(lines))
        words = lines[number].split(b" ")
        place = rng.randrange(len(words))
        kind = rng.choice(["odd", "odd", "odd", "leave out", "line out", "line twice", "line elsewhere"])
        note.append(f"{kind} line {number + 1}")
        if kind == "odd":
            words[place] = rng.choice([b"-1", b"0", b"999999", b"nan", b"1e300", b"x", b"", b"2147483647", b"4294967296",
                                       b"3", b"-", b"$End"])
            lines[number] = b" ".join(words)
        elif kind == "leave out":
            del words[place]
            lines[number] = b" ".join(words)
        else:
            line = lines[number] if kind == "line twice" else lines.pop(number)
            if kind != "line out":
                lines.insert(rng.randrange(len(lines) + 1), line)
    return b"\n".join(lines), "; ".join(note)


class Meshes(FuzzTest):
    def setUp(self):
        super().setUp()
        points, cells = box()
        left = set(np.flatnonzero(points[:, 0] == 0).tolist())
        faces = [[0, 2, 1, 6, 5, 4], [0, 1, 3, 4, 8, 7], [1, 2, 3, 5, 9, 8], [0, 3, 2, 7, 9, 6]]
        sides = np.array([row[face] for row in cells for face in faces if set(row[face].tolist()) <= left])
        write_unv(self.path("box.unv"), points, cells, sides, 2467)
        points, cells = box(order=1)
        for name, options in FORMATS.items():
            meshio.write(self.path(name), meshio.Mesh(points, [("tetra", cells)]), **options)

    def reduce(self, note, name, regions="all"):
        self.write("body.yaml", BODY.replace("FILE", name).replace("all: steel", f"{regions}: steel"))
        return self.judge(note, [name], "bielle-reduce", "body.yaml", "--quiet")

    def test_the_sound_meshes_are_reduced(self):
        for name in FORMATS:
            self.assertEqual(self.reduce(f"sound {name}", name), 0)
        self.assertEqual(self.reduce("sound box.unv", "box.unv", "body"), 0)

    def test_meshes(self):
        names = ["box.unv", *FORMATS]
        for case, rng in self.cases(50):
            name = names[case % len(names)]
            if name == "box.inp" and case % 2:  # each case starts a converter, which takes a second
                name = "box2.msh"
            data, note = (mutated if rng.random() < 0.7 else damaged_bytes)(rng, self.read(name))
            bad = "bad" + os.path.splitext(name)[1]
            self.write(bad, data)
            self.reduce(f"{case} {name} {note}", bad, "body" if name.endswith(".unv") else "all")


if __name__ == "__main__":
    unittest.main()
