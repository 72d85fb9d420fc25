"""Tests of `from` of an interface: ties of Nastran, Abaqus and CalculiX decks equal those that a body file spells
out."""

import json
import os
import shutil
import subprocess
import sys
import unittest

import h5py
import numpy as np

from command import CommandTest
from quick_tools import WithQuickTools

REPOSITORY = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", "..", ".."))
sys.path.insert(0, os.path.join(REPOSITORY, "tests", "contract", "tools"))
import cell_decks  # noqa: E402
from shares import share_of_tests as load_tests  # noqa: E402,F401

STEEL = "{young: 210e9, poisson: 0.3, density: 7850}"
RIGHT = "right: {surface: {plane: {point: [0.6, 0, 0], normal: [1, 0, 0]}}}"
LEFT = "{plane: {point: [0, 0, 0], normal: [1, 0, 0]}}"
AT = "[-0.02, 0.11, 0.04]"
NODE = "GRID,9001,,-0.02,0.11,0.04\n"
TURN = np.array([[0.6, -0.8, 0], [0.8, 0.6, 0], [0, 0, 1]])  # columns: axes


def body(left, ending="bdf", more="", right=RIGHT):
    return (f"body: bar\ngeometry: bar.{ending}\n{more}materials: {{steel: {STEEL}}}\nregions: {{{'BODY' if ending == 'inp' else 'property_1'}: "
            f"steel}}\ninterfaces:\n  left: {left}\n  {right}\nmodes: {{count: 0}}\n")


def rbe2(nodes, components=123456, number=12):
    return cell_decks.card("free", "RBE2", number, 9001, components, *(k + 1 for k in nodes))


def rbe3(groups, refc=123456, number=6002, more=()):
    """groups: triples of weight, components, nodes."""
    words = [word for weight, taken, nodes in groups for word in (repr(float(weight)), str(taken), *(k + 1 for k in nodes))]
    return cell_decks.card("free", "RBE3", number, "", 9001, refc, *words, *more)


class DeckTies(WithQuickTools, CommandTest):
    program = "bielle-reduce"

    def write(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)

    def setUp(self):
        super().setUp()
        self.box = cell_decks.Box(("hexahedron",) * 3, 1)
        self.left = self.box.left()

    def nastran(self, extra, box=None):
        self.write("bar.bdf", (box or self.box).nastran("MAT1,1,2.1+11,,.3,7850.\n" + extra, form="large"))

    def abaqus(self, extra, box=None):
        self.write("bar.inp", (box or self.box).abaqus("*NODE\n9001, -0.02, 0.11, 0.04\n" + extra))

    def reduced(self, text):
        """Returns stiffness, mass and the position of the first interface."""
        self.write("body.yaml", text)
        done = self.run_program("body.yaml", "-o", "body.h5")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.said = done.stderr
        with h5py.File(self.path("body.h5")) as file:
            return np.array(file["reduced/stiffness"]), np.array(file["reduced/mass"])

    def expect_equal(self, one, other, tolerance):
        for a, b in zip(one, other):
            self.assertEqual(a.shape, b.shape)
            size = np.maximum(abs(np.diag(b)), 1e-6 * abs(b).max())  # a body that can spin has a direction without stiffness
            scale = np.sqrt(np.outer(size, size))
            self.assertLess(abs((a - b) / scale).max(), tolerance)

    def refuse(self, *says, text=None):
        self.write("bad.yaml", text or body("{from: RBE3 6002}"))
        self.expect_refusal(1, "bad.yaml", "-o", "bad.h5", says=says)

    # ---- the same superelements -----------------------------------------------------------------------------------------
    def test_an_rbe2_is_a_rigid_tie_of_its_surface(self):
        for order in (1, 2):
            box = cell_decks.Box(("hexahedron", "wedge", "wedge"), order)
            text = box.nastran()  # creates the mid-side nodes
            self.assertTrue(text)
            self.nastran(NODE + rbe2(box.left(), "123"), box)
            told = self.reduced(body(f"{{surface: {LEFT}, position: {AT}}}"))
            self.expect_equal(self.reduced(body("{from: RBE2 12}")), told, 1e-12)
            fewer = self.reduced(body("{from: rbe2  12, directions: [x, y, rz]}"))
            self.expect_equal(fewer, self.reduced(body(f"{{surface: {LEFT}, position: {AT}, directions: [x, y, rz]}}")), 1e-12)

    def test_an_rbe2_of_a_range(self):
        thru = f"RBE2,12,9001,123456,1,THRU,{len(self.box.points)}\n"
        right = "right: {surface: {plane: {point: [0.6, 0, 0], normal: [1, 0, 0]}}, tie: average}"
        self.nastran(NODE + thru)
        self.refuse("shares 9 points", text=body("{from: RBE2 12}", right=right))
        deck = [self.left[0], self.left[4], self.left[-1]]  # 1 THRU 1 has no further node
        self.nastran(NODE + rbe2(deck))
        told = self.reduced(body("{from: RBE2 12}"))
        a, b, c = (k + 1 for k in deck)
        self.nastran(NODE + f"RBE2,12,9001,123456,{a},THRU,{a},{b},THRU\n+,{b},{c}\n")
        self.expect_equal(self.reduced(body("{from: RBE2 12}")), told, 1e-12)

    def tributary(self):
        """The weights are the areas around the nodes of the side x = 0: each rectangle adds a quarter to each
        corner."""
        y, z = (np.unique([self.box.points[k][i] for k in self.left]) for i in (1, 2))
        widths = [dict(zip(v, (np.diff(v, prepend=v[0]) + np.diff(v, append=v[-1])) / 2)) for v in (y, z)]
        return {k: widths[0][self.box.points[k][1]] * widths[1][self.box.points[k][2]] for k in self.left}

    def test_an_rbe3_with_areas_as_weights_is_an_average_tie(self):
        areas = self.tributary()
        self.assertAlmostEqual(sum(areas.values()), 0.02, delta=1e-15)
        centre = sum(areas[k] * self.box.points[k] for k in areas) / sum(areas.values())
        node = cell_decks.card("free", "GRID", 9001, "", *(f"{x:.15g}" for x in centre))
        self.nastran(node + rbe3([(area, 123, [k]) for k, area in areas.items()], refc=123))
        # Only translations of the centroid are equal. Rotations differ, since weights at nodes are not the integral
        # over faces.
        told = self.reduced(body(f"{{surface: {LEFT}, tie: average, directions: [x, y, z]}}"))
        self.expect_equal(self.reduced(body("{from: RBE3 6002}")), told, 1e-10)

    def test_unequal_weights_in_several_groups_are_those_of_the_mean(self):
        weights = {k: 0.5 if i < 3 else 2.0 if i < 5 else 1.25 for i, k in enumerate(self.left)}
        groups = [(w, taken, [k for k in self.left if weights[k] == w]) for w, taken in ((0.5, 123), (2.0, 123456), (1.25, 321))]
        self.nastran(NODE + rbe3(groups))
        self.reduced(body("{from: RBE3 6002}"))
        with h5py.File(self.path("body.h5")) as file:
            points, shapes = np.array(file["mesh/points"]), np.array(file["recovery/displacement"])
        if points.shape[0] == 3:
            points = points.T
        shapes = shapes.reshape(len(points), 3, -1)[:, :, :12]
        rows = [int(np.argmin(np.linalg.norm(points - self.box.points[k], axis=1))) for k in self.left]
        w = np.array([weights[k] for k in self.left])
        centre = w @ points[rows] / w.sum()
        r = points[rows] - centre
        u = shapes[rows]  # displacements under unit motions of the interfaces
        mean = np.einsum("a,aik->ik", w, u) / w.sum()
        J = np.einsum("a,ai,ai->", w, r, r) * np.eye(3) - np.einsum("a,ai,aj->ij", w, r, r)
        turn = np.linalg.solve(J, np.einsum("a,aik->ik", w, np.cross(r[:, :, None], u, axis=1)))
        arm = np.array([-0.02, 0.11, 0.04]) - centre
        found = np.vstack([mean + np.cross(turn, arm[:, None], axis=0), turn])
        self.assertLess(abs(found - np.eye(6, 12)).max(), 1e-10)

    def test_turned_systems_and_inches(self):
        box = cell_decks.Box(("hexahedron",) * 3, 1)
        box.points = [point / 0.0254 for point in box.points]
        # System 5 is at (1, 2, 3) in with its z axis along x and its x axis along y; system 6 rotates displacements
        # about z.
        at = np.array([-0.02, 0.11, 0.04]) / 0.0254 - [1, 2, 3]
        cards = ("CORD2R,5,,1.,2.,3.,2.,2.,3.\n+,1.,3.,3.\nCORD2R,6,,0.,0.,0.,0.,0.,1.\n+,.6,.8,0.\n"
                 + cell_decks.card("free", "GRID", 9001, 5, f"{at[1]:.15g}", f"{at[2]:.15g}", f"{at[0]:.15g}", 6))
        axes = "axes: {x: [0.6, 0.8, 0], y: [-0.8, 0.6, 0]}"
        told = f"{{surface: {LEFT}, position: {AT}, {axes}}}"
        self.nastran(cards + rbe2(box.left()), box)
        self.expect_equal(self.reduced(body("{from: RBE2 12}", more="length_unit: in\n")),
                          self.reduced(body(told, more="length_unit: in\n")), 1e-9)  # nine digits of coordinates in the deck

    def test_cylindrical_displacements_have_the_local_axes(self):
        # The system is cylindrical about z through the origin; its radial direction at (-0.02, 0.11) is along this
        # vector.
        radial = np.array([-0.02, 0.11, 0]) / np.hypot(0.02, 0.11)
        self.nastran("CORD2C,7,,0.,0.,0.,0.,0.,1.\n+,1.,0.,0.\nGRID,9001,,-0.02,0.11,0.04,7\n" + rbe2(self.left))
        axes = f"axes: {{x: [{radial[0]:.16g}, {radial[1]:.16g}, 0], y: [{-radial[1]:.16g}, {radial[0]:.16g}, 0]}}"
        self.expect_equal(self.reduced(body("{from: RBE2 12}")), self.reduced(body(f"{{surface: {LEFT}, position: {AT}, {axes}}}")), 1e-12)
        # The system is spherical about the origin, and its first direction points away from it.
        away = np.array([-0.02, 0.11, 0.04]) / np.linalg.norm([-0.02, 0.11, 0.04])
        down = np.cross(np.cross(away, [0, 0, 1]) / np.linalg.norm(np.cross(away, [0, 0, 1])), away) * -1
        self.nastran("CORD2S,7,,0.,0.,0.,0.,0.,1.\n+,1.,0.,0.\nGRID,9001,,-0.02,0.11,0.04,7\n" + rbe2(self.left))
        words = [", ".join(f"{x:.16g}" for x in v) for v in (away, down)]
        axes = f"axes: {{x: [{words[0]}], y: [{words[1]}]}}"
        self.expect_equal(self.reduced(body("{from: RBE2 12}")), self.reduced(body(f"{{surface: {LEFT}, position: {AT}, {axes}}}")), 1e-12)

    # ---- Abaqus and CalculiX --------------------------------------------------------------------------------------------
    def test_both_decks_of_a_bar_are_the_same(self):
        nset = "*NSET, NSET=LEFT\n" + "".join(f"{k + 1}\n" for k in self.left)
        self.nastran(NODE + rbe2(self.left))
        rigid = self.reduced(body("{from: RBE2 12}"))
        weights = {k: 1.0 + i for i, k in enumerate(self.left)}
        nodes = "*SURFACE, NAME=S, TYPE=NODE\nLEFT\n"
        coupling = "*COUPLING, CONSTRAINT NAME=End, REF NODE=9001, SURFACE=S\n"
        for name, text in (("coupling end", nodes + coupling + "*KINEMATIC\n1, 3\n"), ("coupling end", nodes + coupling + "*KINEMATIC\n1\n2, 6\n"),
                           ("coupling END", self.box.surface("S") + coupling + "*KINEMATIC\n"),
                           ("kinematic coupling 9001", "*KINEMATIC COUPLING, REF NODE=9001\nLEFT, 1, 3\n"),
                           ("rigid body 9001", "*RIGID BODY, REF NODE=9001, PIN NSET=LEFT\n"),
                           ("rigid body REF", "*NSET, NSET=REF\n9001\n*RIGID BODY, REF NODE=REF, TIE NSET=LEFT\n"),
                           ("mpc beam 9001", "*MPC\nBEAM, LEFT, 9001\n"),
                           ("mpc beam 9001", "*MPC\n" + "".join(f"BEAM, {k + 1}, 9001\n" for k in self.left))):
            self.abaqus(nset + text)
            self.expect_equal(self.reduced(body(f"{{from: {name}}}", "inp")), rigid, 1e-12)
        self.nastran(NODE + rbe3([(w, 123, [k]) for k, w in weights.items()]))
        average = self.reduced(body("{from: RBE3 6002}"))
        areas = "*SURFACE, NAME=S, TYPE=NODE\n" + "".join(f"{k + 1}, {w}\n" for k, w in weights.items())
        dcoup = "*ELEMENT, TYPE=DCOUP3D, ELSET=D\n5000, 9001\n*DISTRIBUTING COUPLING, ELSET=D\n" + "".join(f"{k + 1}, {w}\n" for k, w in weights.items())
        for name, text in (("coupling End", areas + coupling + "*DISTRIBUTING, WEIGHTING METHOD=UNIFORM\n"), ("distributing coupling D", dcoup)):
            self.abaqus(text)
            self.expect_equal(self.reduced(body(f"{{from: {name}}}", "inp")), average, 1e-12)

    def test_a_distributing_coupling_of_faces_is_an_average_tie(self):
        self.abaqus(self.box.surface("S") + "*ORIENTATION, NAME=O\n.6, .8, 0., -.8, .6, 0.\n3, 0.\n"
                    "*COUPLING, CONSTRAINT NAME=E, REF NODE=9001, SURFACE=S, ORIENTATION=O\n*DISTRIBUTING\n1, 4\n")
        told = f"{{surface: S, tie: average, position: {AT}, axes: {{x: [0.6, 0.8, 0], y: [-0.8, 0.6, 0]}}, directions: [x, y, z, rx]}}"
        self.expect_equal(self.reduced(body("{from: coupling E}", "inp")), self.reduced(body(told, "inp")), 1e-12)
        # A rotation of 90 degrees about its third axis turns the first one to (-.8, .6). The orientation overrides a
        # *TRANSFORM of the node.
        self.abaqus(self.box.surface("S") + "*ORIENTATION, NAME=O\n.6, .8, 0., -.8, .6, 0.\n3, 90.\n"
                    "*NSET, NSET=R\n9001\n*TRANSFORM, NSET=R\n0., 1., 0., 0., 0., 1.\n"
                    "*COUPLING, CONSTRAINT NAME=E, REF NODE=R, SURFACE=S, ORIENTATION=O\n*KINEMATIC\n")
        told = f"{{surface: S, position: {AT}, axes: {{x: [-0.8, 0.6, 0], y: [-0.6, -0.8, 0]}}}}"
        self.expect_equal(self.reduced(body("{from: coupling E}", "inp")), self.reduced(body(told, "inp")), 1e-12)
        self.abaqus(self.box.surface("S") + "*NSET, NSET=R\n9001\n*TRANSFORM, NSET=R\n0., 1., 0., 0., 0., 1.\n"
                    "*COUPLING, CONSTRAINT NAME=E, REF NODE=R, SURFACE=S\n*KINEMATIC\n")
        told = f"{{surface: S, position: {AT}, axes: {{x: [0, 1, 0], y: [0, 0, 1]}}}}"
        self.expect_equal(self.reduced(body("{from: coupling E}", "inp")), self.reduced(body(told, "inp")), 1e-12)

    def test_reference_points_of_an_assembly(self):
        part = self.box.abaqus().replace("*HEADING\n box\n", "")
        self.write("bar.inp", f"*PART, NAME=P\n{part}{self.box.surface('S')}*END PART\n*ASSEMBLY, NAME=A\n*INSTANCE, NAME=P-1, PART=P\n"
                   "*END INSTANCE\n*NODE\n1, -0.02, 0.11, 0.04\n*NSET, NSET=_Ref, INTERNAL\n1,\n"
                   "*COUPLING, CONSTRAINT NAME=E, REF NODE=_Ref, SURFACE=P-1.S\n*KINEMATIC\n*END ASSEMBLY\n")
        told = self.reduced(body(f"{{surface: S, position: {AT}}}", "inp"))
        self.expect_equal(self.reduced(body("{from: coupling E}", "inp")), told, 1e-12)

    @unittest.skipUnless(shutil.which("ccx"), "CalculiX is not installed (Debian package calculix-ccx)")
    def test_calculix_moves_a_rigid_body_alike(self):
        box = cell_decks.Box(("hexahedron",) * 3, 2)
        box.nastran()  # creates the mid-side nodes
        sides = "".join(f"*NSET, NSET={name}\n" + "".join(f"{k}\n" for k, x in enumerate(box.points, 1) if abs(x[0] - at) < 1e-9)
                        for name, at in (("LEFT", 0), ("RIGHT", 0.6)))
        force = np.array([3e3, 2e3, -1e3])
        self.abaqus(sides + "*NSET, NSET=REF\n9001\n*NODE\n9002, 0., 0., 0.\n*RIGID BODY, NSET=LEFT, REF NODE=9001, ROT NODE=9002\n"
                    "*MATERIAL, NAME=S\n*ELASTIC\n210e9, 0.3\n*DENSITY\n7850.\n*SOLID SECTION, ELSET=BODY, MATERIAL=S\n"
                    "*STEP\n*STATIC\n*BOUNDARY\nRIGHT, 1, 3\n*CLOAD\n" + "".join(f"9001, {i}, {f}\n" for i, f in enumerate(force, 1))
                    + "*NODE PRINT, NSET=REF\nU\n*END STEP\n", box)
        subprocess.run(["ccx", "-i", "bar"], cwd=self.folder, check=True, capture_output=True, timeout=300)
        with open(self.path("bar.dat"), encoding="utf-8") as file:
            moved = next(np.array(line.split()[1:], float) for line in file if line.split()[:1] == ["9001"])
        stiffness, _ = self.reduced(body("{from: rigid body 9001}", "inp"))
        u = np.linalg.solve(stiffness[:6, :6], np.concatenate([force, np.zeros(3)]))[:3]
        self.assertLess(np.linalg.norm(u - moved) / np.linalg.norm(u), 1e-6)  # seven digits in the file of CalculiX

    # ---- other cases ----------------------------------------------------------------------------------------------------
    def test_a_reference_node_that_is_a_node_of_the_solid(self):
        first, rest = self.left[0], self.left[1:]
        self.nastran(cell_decks.card("free", "RBE2", 12, first + 1, 123456, *(k + 1 for k in rest)))
        told = self.reduced(body(f"{{surface: {LEFT}, position: [0, 0, 0]}}"))
        self.expect_equal(self.reduced(body("{from: RBE2 12}")), told, 1e-12)
        self.assertIn("its reference node 1 belongs to the solid", self.said)
        self.nastran(rbe3([(1, 123, rest)]).replace("9001", str(first + 1)))
        self.refuse("left.from", "its reference node 1 is a node of the solid")

    def test_interfaces_that_were_one_node_are_told(self):
        right = [k for k, x in enumerate(self.box.points) if x[0] > 0.59]
        ties = rbe2(self.left) + rbe2(right, number=13)
        self.nastran(NODE + ties)
        self.reduced(body("{from: RBE2 12}", right="right: {from: RBE2 13}"))
        self.assertIn("warning: the interfaces 'left' (RBE2 12) and 'right' (RBE2 13) have the same node 9001 in 'bar.bdf', but become two nodes, which "
                      "nothing connects: connect them by a rigid joint in the mechanism", self.said)
        self.nastran(NODE + ties.replace("13,9001", "13,9002") + "GRID,9002,,-0.02,0.11,0.04\n")
        self.reduced(body("{from: RBE2 12}", right="right: {from: RBE2 13}"))
        self.assertNotIn("become two nodes", self.said)

    def test_in_pieces(self):
        self.nastran(NODE + rbe2(self.left) + rbe3([(1, 123, range(len(self.box.points)))]))
        pieces = "pieces: {planes: {axis: x, at: 0.2}, compare: false}\n"
        with_pieces = body("{from: RBE2 12}") + pieces
        self.write("body.yaml", with_pieces)
        done = self.run_program("body.yaml", "-o", "cut.h5")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.write("body.yaml", body(f"{{surface: {LEFT}, position: {AT}}}") + pieces)
        done = self.run_program("body.yaml", "-o", "told.h5")
        self.assertEqual(done.returncode, 0, done.stderr)
        with h5py.File(self.path("cut.h5")) as one, h5py.File(self.path("told.h5")) as other:
            for piece in ("1", "2"):
                self.expect_equal(*([np.array(file[f"pieces/{piece}/reduced/{each}"]) for each in ("stiffness", "mass")] for file in (one, other)), 1e-12)
        self.refuse("its nodes lie in several pieces", text=body("{from: RBE3 6002}", right="") + pieces)

    def test_the_list_shows_ties(self):
        self.nastran(NODE + rbe2(self.left) + rbe3([(1, 123, self.left)], refc=1235) + rbe2(self.left, 12, 13))
        done = self.run_program("--list", "bar.bdf", "--length-unit", "mm")
        self.assertEqual(done.returncode, 0, done.stderr)
        for text in ("RBE2 12: 9 nodes, rigid, at (-2e-05, 0.00011, 4e-05) m, axes x (1, 0, 0) y (0, 1, 0), directions x y z rx ry rz",
                     "RBE3 6002: 9 nodes, average, at", "directions x y z ry", "RBE2 13: no interface: it takes the components 12 of its nodes"):
            self.assertIn(text, done.stdout)

    def test_refusals(self):
        good = rbe3([(1, 123, self.left)])
        self.nastran(NODE + good + rbe2(self.left))
        self.refuse("bad.yaml:6: interfaces.left.from", "has no tie 'RBE3 6003'; did you mean 'RBE3 6002'?", text=body("{from: RBE3 6003}"))
        for wrong in ("RBE3 0", "RBE3 -6002", "6002", "[RBE3 6002]", "''"):
            self.refuse("interfaces.left.from", text=body(f"{{from: {wrong}}}"))
        for key in ("position: [0, 0, 0]", "axes: {x: [1, 0, 0], y: [0, 1, 0]}", "rotation_vector: [0, 0, 1]", "surface: rbe2_12", "tie: average"):
            self.refuse(f"left.{key.split(':')[0]}", "remove this key", text=body(f"{{from: RBE3 6002, {key}}}"))
        self.refuse("the key 'surface' is missing; or 'from'", text=body("{tie: rigid}"))
        self.refuse("interfaces.right.from: 'RBE2 12' is the interface 'left' already", text=body("{from: RBE2 12}", right="right: {from: rbe2 12}"))
        self.refuse("shares 9 points", text=body("{from: RBE2 12}", right="right: {from: RBE3 6002}"))
        self.nastran(NODE + rbe3([(1, 123, self.left)], refc=123))
        self.refuse("'RBE3 6002' does not tie 'rx', but x, y, z", text=body("{from: RBE3 6002, directions: [x, rx]}"))
        cards = ((good + good, "there are 2 of this name"), (rbe3([(1, 12, self.left)]), "components 12 of 9 nodes"),
                 (rbe3([(1, 123, self.left)], more=("UM", 1, 123)), "(UM)"), (rbe3([(-1, 123, self.left)]), "the weight -1 of the node 1"),
                 (rbe3([(0, 123, self.left)]), "it ties no nodes"), (rbe3([(1, 123, [0, 9000])]), "it ties the node 9001"),
                 (rbe3([(1, 123, self.left[:3])]), "stand in one line along"), (rbe3([(1, 123, self.left[:2])]), "are 2 nodes"),
                 (good.replace("1.0", "1"), "a weight with a decimal point in field 6"), (rbe3([(1, 127, self.left)]), "components out of 1 to 6"),
                 ("RBE3,6002,,9001,123,1.,123,1,THRU\n", "a grid point before and after THRU in field 9"),
                 ("RBE3,6002,,9001,123,1.,123,1\n", "are 1 node of the solid"), ("RBE3,6002,,9001,123,nan,123,1,2,4\n", "weight nan"),
                 ("RBE3,6002\n", "an integer in field 4, found nothing"), (good.replace("6002", "0"), None))
        for text, says in cards:
            self.nastran(NODE + text)
            self.refuse(*([says] if says else ["RBE3 6002", "did you mean 'RBE3 0'"]))
        self.nastran(NODE + rbe3([(1, 123, [777776])]))
        self.refuse("RBE3 6002 names the node 777777, which does not exist")
        self.nastran(NODE + "RBE2,12,9001,123456,1,THRU,700000000\n")  # no list of that length is created
        self.refuse("RBE2 12 names the node 37, which does not exist")
        self.nastran("GRID,9001,,0.,0.,0.,77\n" + good)
        self.refuse("coordinate system 77")
        self.nastran("")
        self.refuse("'bar.bdf' has no ties")

    def test_refusals_of_abaqus(self):
        nset = "*NSET, NSET=LEFT\n" + "".join(f"{k + 1}\n" for k in self.left) + "*SURFACE, NAME=S, TYPE=NODE\nLEFT\n"
        coupling = "*COUPLING, CONSTRAINT NAME=E, REF NODE=9001, SURFACE=S"
        for text, name, says in ((coupling + "\n*KINEMATIC\n1, 2\n", "coupling E", "components 12 of its surface"),
                                 (coupling + "\n", "coupling E", "neither *KINEMATIC nor *DISTRIBUTING"),
                                 (coupling + "\n*KINEMATIC\n0, 3\n", "coupling E", "no components"),
                                 (coupling + ", INFLUENCE RADIUS=1.\n*KINEMATIC\n", "coupling E", "INFLUENCE RADIUS"),
                                 (coupling + "\n*DISTRIBUTING, WEIGHTING METHOD=LINEAR\n", "coupling E", "WEIGHTING METHOD is LINEAR"),
                                 (coupling + "\n*DISTRIBUTING, COUPLING=STRUCTURAL\n", "coupling E", "COUPLING is STRUCTURAL"),
                                 (coupling + ", ORIENTATION=O\n*KINEMATIC\n", "coupling E", "no *ORIENTATION, NAME=O"),
                                 (coupling.replace("9001", "") + "\n*KINEMATIC\n", "coupling E", "no reference node"),
                                 (coupling.replace("9001", "LEFT") + "\n*KINEMATIC\n", "coupling E", "a set of 9 nodes"),
                                 (coupling.replace("SURFACE=S", "SURFACE=T") + "\n*KINEMATIC\n", "coupling E", "no *SURFACE, NAME=T"),
                                 ("*MPC\nTIE, LEFT, 9001\n", "mpc tie 9001", "does not tie nodes as a rigid body"),
                                 ("*KINEMATIC COUPLING, REF NODE=9001\nLEFT, 1, 2\n", "kinematic coupling 9001", "components 12 of the node 1"),
                                 ("*RIGID BODY, REF NODE=9001, NSET=NONE\n", "rigid body 9001", "set 'NONE'"),
                                 ("*RIGID BODY, REF NODE=9001\n", "rigid body 9001", "ties no nodes"),
                                 ("*DISTRIBUTING COUPLING\n1, 1.\n", "distributing coupling ?", "no ELSET is named by *DISTRIBUTING COUPLING"),
                                 ("*RIGID BODY, REF NODE=9001, NSET=LEFT\n*TRANSFORM\n1., 0., 0., 0., 1., 0.\n", "rigid body 9001", "no NSET is named"),
                                 ("*MPC\nBEAM, LEFT\n", "mpc beam ?", "BEAM has two nodes")):
            self.abaqus(nset + text)
            self.refuse("left.from", says, text=body(f"{{from: {name}}}", "inp"))

    # ---- masses ---------------------------------------------------------------------------------------------------------
    def ties(self, name):
        """The JSON of convert_mesh.py."""
        done = subprocess.run(["/usr/bin/python3", os.path.join(REPOSITORY, "tools", "convert_mesh.py"), "--ties", name, "ties.json"],
                              cwd=self.folder, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.path("ties.json"), encoding="utf-8") as file:
            return json.load(file)

    def test_point_masses_of_nastran(self):
        systems = "CORD2R,6,,0.,0.,0.,0.,0.,1.\n+,.6,.8,0.\n"
        cards = ("CONM2,1,9001,,2.5,.1,.2,.3\n+,4.,1.,5.,-.5,.25,6.\n" "CONM2,2,9001,6,1.,.1,0.,0.\n+,4.,,5.,,,6.\n"
                 "CONM2,3,9001,-1,1.,.1,.2,.3\nCONM2,4,1,,7.\nCONM2,5,9002,,7.\n")
        self.nastran(NODE + "GRID,9002,,5.,0.,0.\n" + systems + rbe2(self.left) + cards)
        masses = self.ties("bar.bdf")["masses"]
        self.assertEqual([mass.get("mass") for mass in masses], [2.5, 1, 1, 7, None])
        self.assertIn("no solid cell", masses[4]["refused"])
        np.testing.assert_allclose(masses[0]["position"], [0.08, 0.31, 0.34], atol=1e-15)
        # Products of inertia such as I21 are int x1 x2 dm, which the tensor contains with a minus sign.
        np.testing.assert_allclose(masses[0]["inertia"], [[4, -1, .5], [-1, 5, -.25], [.5, -.25, 6]], atol=1e-15)
        np.testing.assert_allclose(masses[1]["position"], [-0.02 + 0.06, 0.11 + 0.08, 0.04], atol=1e-15)
        np.testing.assert_allclose(masses[1]["inertia"], TURN @ np.diag([4, 5, 6]) @ TURN.T, atol=1e-14)
        np.testing.assert_allclose(masses[2]["position"], [.1, .2, .3], atol=1e-15)
        self.assertEqual([mass.get("tie") for mass in masses], ["RBE2 12"] * 3 + [None] * 2)
        self.assertEqual([mass.get("node") for mass in masses], [None] * 3 + [1, None])

    def test_point_masses_of_abaqus(self):
        self.abaqus("*NSET, NSET=LEFT\n" + "".join(f"{k + 1}\n" for k in self.left) + "*RIGID BODY, REF NODE=9001, PIN NSET=LEFT\n"
                    "*ELEMENT, TYPE=MASS, ELSET=M\n900, 9001\n*MASS, ELSET=M\n2.5\n*ELEMENT, TYPE=ROTARYI, ELSET=R\n901, 9001\n"
                    "*ORIENTATION, NAME=O\n.6, .8, 0., -.8, .6, 0.\n*ROTARY INERTIA, ELSET=R, ORIENTATION=O\n4., 5., 6., -1., .5, -.25\n")
        mass, inertia = self.ties("bar.inp")["masses"]
        self.assertEqual((mass["name"], mass["mass"], mass["tie"]), ("mass 900", 2.5, "rigid body 9001"))
        np.testing.assert_allclose(mass["position"], [-0.02, 0.11, 0.04])
        np.testing.assert_allclose(inertia["inertia"], TURN @ [[4, -1, .5], [-1, 5, -.25], [.5, -.25, 6]] @ TURN.T, atol=1e-14)
        self.assertEqual(inertia["mass"], 0)

    def test_other_files_have_none(self):
        self.write("bar.vtu", "<VTKFile/>")
        self.assertEqual(self.ties("bar.vtu"), {"ties": [], "masses": []})


if __name__ == "__main__":
    unittest.main()
