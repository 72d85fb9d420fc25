"""`masses` out of a deck: CONM2 of Nastran, *MASS and *ROTARY INERTIA of Abaqus, on ties and on nodes of the solid."""

import os
import sys
import unittest

import h5py
import numpy as np

from command import CommandTest

REPOSITORY = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", "..", ".."))
sys.path.insert(0, os.path.join(REPOSITORY, "tests", "contract", "tools"))
import cell_decks  # noqa: E402

NODE = np.array([-0.02, 0.11, 0.04])  # reference node of the tie
OFFSET = np.array([0.1, 0.2, 0.3])
TENSOR = np.array([[4, -1, .5], [-1, 5, -.25], [.5, -.25, 6]])
CONM2 = "CONM2,1,9001,,2.5,.1,.2,.3\n+,4.,1.,5.,-.5,.25,6.\n"  # the tensor about the centre; products of inertia are int x1 x2 dm
BODY = """\
body: bar
geometry: bar.{ending}
materials: {{steel: {{young: 210e9, poisson: 0.3, density: 7850}}}}
regions: {{all: steel}}
interfaces:
  left: {{from: {tie}}}
  right: {{surface: {{plane: {{point: [{length}, 0, 0], normal: [1, 0, 0]}}}}}}
modes: {{count: 2}}
{more}
"""


def skew(a):
    return np.array([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]])


def rigid(mass, arm, inertia):
    """The matrix of a rigid body at a node; its centre is at the arm from it."""
    return np.block([[mass * np.eye(3), -mass * skew(arm)], [mass * skew(arm), inertia - mass * skew(arm) @ skew(arm)]])


class DeckMasses(CommandTest):
    program = "bielle-reduce"

    def setUp(self):
        super().setUp()
        self.box = cell_decks.Box(("hexahedron",) * 3, 1)
        self.members = [k + 1 for k in self.box.left()]

    def write(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)

    def nastran(self, extra):
        node = ",".join(f"{x:.15g}" for x in NODE)
        self.write("bar.bdf", self.box.nastran(f"MAT1,1,2.1+11,,.3,7850.\nGRID,9001,,{node}\n" + extra, form="large"))

    def rbe2(self):
        return cell_decks.card("free", "RBE2", 12, 9001, 123456, *self.members)

    def rbe3(self):
        return cell_decks.card("free", "RBE3", 12, "", 9001, 123456, "1.", 123, *self.members)

    def reduced(self, tie, more="", ending="bdf", length=0.6):
        self.write("body.yaml", BODY.format(tie=tie, more=more, ending=ending, length=length))
        done = self.run_program("body.yaml", "-o", "body.h5")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.said = done.stderr
        with h5py.File(self.path("body.h5")) as file:
            return np.array(file["reduced/mass"]), float(np.array(file["mass_properties/mass"]))

    def expect_body_on_the_node(self, loaded, bare, matrix):
        expected = bare[0].copy()
        expected[:6, :6] += matrix
        scale = np.sqrt(np.outer(np.diag(expected), np.diag(expected)))
        # Modes are the same, as the interfaces are held in them; their signs may not be.
        self.assertLess((abs(abs(loaded[0]) - abs(expected)) / scale).max(), 1e-9)
        self.assertLess((abs(loaded[0] - expected) / scale)[:12, :12].max(), 1e-10)
        self.assertAlmostEqual(loaded[1] - bare[1], matrix[0, 0], delta=1e-9 * loaded[1])

    # ---- values -----------------------------------------------------------------------------------------------------------
    def test_a_mass_on_the_reference_node_of_an_interface_is_a_rigid_body_there(self):
        for tie, name in ((self.rbe2(), "RBE2 12"), (self.rbe3(), "RBE3 12")):
            with self.subTest(name):
                self.nastran(tie + CONM2)
                bare = self.reduced(name)
                for more in ("masses: from_file", "masses: {motor: {from: conm2  1}}"):
                    self.expect_body_on_the_node(self.reduced(name, more), bare, rigid(2.5, OFFSET, TENSOR))

    def test_masses_of_abaqus(self):
        nodes = "".join(f"{k}\n" for k in self.members)
        self.write("bar.inp", self.box.abaqus(
            "*NODE\n9001, -0.02, 0.11, 0.04\n*NSET, NSET=LEFT\n" + nodes + "*RIGID BODY, REF NODE=9001, PIN NSET=LEFT\n"
            "*ELEMENT, TYPE=MASS, ELSET=M\n900, 9001\n*MASS, ELSET=M\n2.5\n"
            "*ELEMENT, TYPE=ROTARYI, ELSET=R\n901, 9001\n*ROTARY INERTIA, ELSET=R\n4., 5., 6., -1., .5, -.25\n"))
        bare = self.reduced("rigid body 9001", ending="inp")
        loaded = self.reduced("rigid body 9001", "masses: from_file", "inp")
        self.expect_body_on_the_node(loaded, bare, rigid(2.5, np.zeros(3), TENSOR))

    def test_masses_of_an_assembly_and_of_its_instance_may_have_one_number(self):
        members = "".join(f"{k}\n" for k in self.members)
        self.write("bar.inp", "*PART, NAME=P\n" + self.box.abaqus(
            f"*NSET, NSET=LEFT\n{members}*SURFACE, NAME=S, TYPE=NODE\nLEFT\n*ELEMENT, TYPE=MASS, ELSET=PM\n901, {self.members[0]}\n"
            "*MASS, ELSET=PM\n1.\n") + "*END PART\n*ASSEMBLY, NAME=A\n*INSTANCE, NAME=P-1, PART=P\n*END INSTANCE\n*NODE\n"
            "1, -0.02, 0.11, 0.04\n*ELEMENT, TYPE=MASS, ELSET=RM\n901, 1\n*MASS, ELSET=RM\n7.\n"
            "*NSET, NSET=RP\n1\n*COUPLING, CONSTRAINT NAME=END, REF NODE=RP, SURFACE=P-1.S\n*KINEMATIC\n*END ASSEMBLY\n")
        bare = self.reduced("coupling END", ending="inp")
        own = self.reduced("coupling END", "masses: {pump: {from: mass 901 of the assembly}}", "inp")
        self.expect_body_on_the_node(own, bare, rigid(7, np.zeros(3), np.zeros((3, 3))))
        self.assertAlmostEqual(self.reduced("coupling END", "masses: from_file", "inp")[1] - bare[1], 8, delta=1e-9)

    def test_units_of_the_deck(self):
        tiny = "CONM2,1,9001,,2.5-9,.1,.2,.3\n+,4.-9,1.-9,5.-9,-.5-9,.25-9,6.-9\n"  # the body has 1e-7 kg
        self.nastran(self.rbe2() + tiny)
        bare = self.reduced("RBE2 12", "length_unit: mm", length=0.6e-3)
        loaded = self.reduced("RBE2 12", "length_unit: mm\nmass_unit: t\nmasses: from_file", length=0.6e-3)
        self.expect_body_on_the_node(loaded, bare, rigid(2.5e-6, OFFSET * 1e-3, TENSOR * 1e-12))

    def test_masses_on_nodes_of_the_solid_and_on_ties_without_an_interface(self):
        grid = "GRID,9002,,.65,.1,.05\n"
        inner = [k + 1 for k in range(len(self.box.points)) if 0.1 < self.box.points[k][0] < 0.5]
        other = cell_decks.card("free", "RBE3", 13, "", 9002, 123456, "1.", 123, *inner[:6])
        self.nastran(self.rbe2() + grid + other + f"CONM2,4,{inner[-1]},,7.\nCONM2,5,9002,,3.\nCONM2,6,9002,,0.\n")
        bare, loaded = self.reduced("RBE2 12"), self.reduced("RBE2 12", "masses: from_file")
        self.assertAlmostEqual(loaded[1] - bare[1], 10, delta=1e-9)
        self.assertIn("CONM2 4: 7 kg", self.said)
        self.assertIn("CONM2 5: 3 kg with the centre (0.65, 0.1, 0.05) m", self.said)

    def test_weights_become_masses_by_wtmass(self):
        self.nastran("PARAM,WTMASS,.5\n" + self.rbe2() + CONM2)
        bare, loaded = self.reduced("RBE2 12"), self.reduced("RBE2 12", "masses: from_file")
        self.expect_body_on_the_node(loaded, bare, rigid(1.25, OFFSET, TENSOR / 2))

    def test_list_shows_them(self):
        self.nastran(self.rbe2() + CONM2)
        done = self.run_program("--list", "bar.bdf")
        self.assertIn("  CONM2 1: 2.5 at (0.08, 0.31, 0.34) m, carried by RBE2 12", done.stdout)

    # ---- refusals ---------------------------------------------------------------------------------------------------------
    def refuse(self, more, *says, tie="RBE2 12"):
        self.write("bad.yaml", BODY.format(tie=tie, more=more, ending="bdf", length=0.6))
        self.expect_refusal(1, "bad.yaml", "-o", "bad.h5", says=says)

    def test_wrong_requests_are_refused_with_the_place(self):
        self.nastran(self.rbe2() + CONM2)
        self.refuse("masses: {motor: {from: CONM2 7}}", "bad.yaml:9: masses.motor.from", "no point mass 'CONM2 7'", "'CONM2 1'")
        self.refuse("masses: {motor: {from: CONM2 1, mass: 3}}", "masses.motor.mass: the deck has it")
        self.refuse("masses: deck", "masses", "from_file")
        self.refuse("masses: {motor: {surface: BODY, mass: 1}}\nmass_unit: t", "mass_unit: it belongs to 'materials: from_file' and to masses of the file")
        self.nastran(self.rbe2())
        self.refuse("masses: from_file", "'bar.bdf' has no point masses")

    def test_masses_of_no_body_are_refused(self):
        for card, says in (("CONM2,1,9001,,-2.\n", "which is negative"), ("CONM2,1,9001,,1.\n+,1.,,1.,,,5.\n", "no body has this inertia"),
                           ("GRID,9009,,5.,5.,5.\nCONM2,1,9009,,1.\n", "belongs to no solid cell and to no tie")):
            with self.subTest(card):
                self.nastran(self.rbe2() + card)
                self.refuse("masses: from_file", "CONM2 1", says)
        self.nastran(self.rbe2() + cell_decks.card("free", "RBE3", 13, "", 9001, 123456, "1.", 123, *self.members) + CONM2)
        self.refuse("masses: from_file", "CONM2 1 stands at a node of several ties (RBE2 12, RBE3 13)")
        self.nastran(self.rbe2() + "CONM2,1,9001,,0.\n")
        self.refuse("masses: {motor: {from: CONM2 1}}", "has neither mass nor inertia")


if __name__ == "__main__":
    unittest.main()
