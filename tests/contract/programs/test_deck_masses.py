"""Tests of `masses` from a deck: CONM2 of Nastran, *MASS and *ROTARY INERTIA of Abaqus, on ties and on nodes of the
solid."""

import os
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
    """Returns the mass matrix of a rigid body about a node. @param arm  position of the centre relative to the node"""
    return np.block([[mass * np.eye(3), -mass * skew(arm)], [mass * skew(arm), inertia - mass * skew(arm) @ skew(arm)]])


class DeckMasses(WithQuickTools, CommandTest):
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
        # The modes are the same, since they hold the interfaces; their signs may differ.
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
        tiny = "CONM2,1,9001,,2.5-9,.1,.2,.3\n+,4.-9,1.-9,5.-9,-.5-9,.25-9,6.-9\n"  # the mass of the body is 1e-7 kg
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
                           ("GRID,9009,,5.,5.,5.\nCONM2,1,9009,,1.\n", "no solid cell and is the reference node of no tie")):
            with self.subTest(card):
                self.nastran(self.rbe2() + card)
                self.refuse("masses: from_file", "CONM2 1", says)
        self.nastran(self.rbe2() + CONM2 + CONM2)
        self.refuse("masses: from_file", "CONM2 1: there are 2 of this name")
        self.nastran(self.rbe2() + "CONM2,1,9001,,0.\n")
        self.refuse("masses: {motor: {from: CONM2 1}}", "has neither mass nor inertia")

    def test_a_mass_of_the_deck_is_taken_once(self):
        self.nastran(self.rbe2() + CONM2)
        self.refuse("masses: {motor: {from: CONM2 1}, pump: {from: conm2 1}}", "bad.yaml:9: masses.pump.from: 'CONM2 1' is the mass 'motor' already")

    def test_other_forms_of_masses_name_those_that_are_expected(self):
        self.nastran(self.rbe2() + CONM2)
        for more in ("masses:", "masses: []", "masses: [motor]"):
            self.refuse(more, "bad.yaml:9: masses: expected masses by their names", "or from_file")

    def test_a_mass_that_cannot_be_used_leaves_the_other_parts_of_the_deck(self):
        inner = [k + 1 for k in range(len(self.box.points)) if 0.1 < self.box.points[k][0] < 0.5][:6]
        grids = "GRID,9002,,.3,.1,.05\nGRID,9003,,.3,.2,.05\n"
        several = cell_decks.card("free", "RBE3", 13, "", 9001, 123456, "1.", 123, *self.members)
        part = cell_decks.card("free", "RBE2", 14, 9002, 12, *inner)
        outer = cell_decks.card("free", "RBE2", 15, 9002, 123, 9003, *inner)
        good = f"CONM2,4,{inner[0]},,7.\n"
        for cards, says in ((several + CONM2, "it stands at a node of several ties (RBE2 12, RBE3 13)"),
                            (part + "CONM2,1,9002,,3.\n", "RBE2 14, at whose node it stands, cannot carry it: it takes the components 12"),
                            (outer + "CONM2,1,9003,,3.\n", "it stands at a node that RBE2 15 ties to others and no solid cell has"),
                            ("CONM2,1,9009,,3.\n", "it names the node 9009, which does not exist")):
            with self.subTest(says):
                self.nastran(self.rbe2() + grids + cards + good)
                bare = self.reduced("RBE2 12")
                self.assertAlmostEqual(self.reduced("RBE2 12", "masses: {pump: {from: CONM2 4}}")[1] - bare[1], 7, delta=1e-9)
                self.assertIn(f"CONM2 1: cannot be used: {says}" if "9009" not in says else says, self.run_program("--list", "bar.bdf").stdout)
                self.refuse("masses: {pump: {from: CONM2 1}}", "bad.yaml:9: masses.pump.from: CONM2 1: ", says)
                self.refuse("masses: from_file", "bad.yaml:9: masses: CONM2 1: ", says)

    def test_a_mass_at_a_node_of_the_solid_whose_tie_is_none_stays_there(self):
        inner = [k + 1 for k in range(len(self.box.points)) if 0.1 < self.box.points[k][0] < 0.5][:6]
        part = cell_decks.card("free", "RBE2", 14, inner[0], 12, *inner[1:])
        self.nastran(self.rbe2() + part + f"CONM2,1,{inner[0]},,3.\n")
        bare = self.reduced("RBE2 12")
        self.assertAlmostEqual(self.reduced("RBE2 12", "masses: from_file")[1] - bare[1], 3, delta=1e-9)

    def test_a_tie_of_few_nodes_carries_no_mass_and_is_named(self):
        for nodes, says in ((self.members[:1], "are 1 node of the solid"), (self.members[:2], "are 2 nodes of the solid"),
                            (self.members[:3], "stand in one line along")):
            with self.subTest(says):
                other = cell_decks.card("free", "RBE2", 13, 9002, 123456, *nodes)
                self.nastran(self.rbe2() + "GRID,9002,,-.1,0.,0.\n" + other + "CONM2,5,9002,,3.\n")
                self.refuse("masses: from_file", "bad.yaml:9: masses.CONM2 5: ", "nodes of RBE2 13", says)

    def test_faulty_masses_of_abaqus_are_refused_one_by_one(self):
        nodes = "".join(f"{k}\n" for k in self.members)
        deck = ("*NODE\n9001, -0.02, 0.11, 0.04\n*NSET, NSET=LEFT\n" + nodes + "*RIGID BODY, REF NODE=9001, PIN NSET=LEFT\n"
                "*ELEMENT, TYPE=MASS, ELSET=M\n900, 9001\n*MASS, ELSET=M\n2.5\n*ELEMENT, TYPE=MASS, ELSET=N\n901, 9001\n")
        for wrong, name, says in (("*MASS, ELSET=N\n\n", "mass 901", "it has no numbers"), ("*MASS, ELSET=N\n1., 2.\n", "mass 901", "expected one"),
                                  ("*MASS, ELSET=N, TYPE=ANISOTROPIC\n1.\n", "mass 901", "ISOTROPIC is read"),
                                  ("*MASS, ELSET=Q\n1.\n", "mass Q", "Q"), ("*MASS\n1.\n", "mass ?", "no ELSET is named")):
            with self.subTest(wrong):
                self.write("bar.inp", self.box.abaqus(deck + wrong))
                bare = self.reduced("rigid body 9001", ending="inp")
                more = self.reduced("rigid body 9001", "masses: {motor: {from: mass 900}}", "inp")
                self.assertAlmostEqual(more[1] - bare[1], 2.5, delta=1e-9)
                self.write("bad.yaml", BODY.format(tie="rigid body 9001", more="masses: from_file", ending="inp", length=0.6))
                self.expect_refusal(1, "bad.yaml", "-o", "bad.h5", says=[f"masses: {name}: ", says])

    def test_a_tie_without_a_rigid_form_is_the_reason_of_its_mass(self):
        nodes = "".join(f"{k}\n" for k in self.members)
        self.write("bar.inp", self.box.abaqus(
            "*NODE\n9001, -0.02, 0.11, 0.04\n9002, 0.3, 0.11, 0.04\n*NSET, NSET=LEFT\n" + nodes + "*RIGID BODY, REF NODE=9001, PIN NSET=LEFT\n"
            "*MPC\nTIE, LEFT, 9002\n*ELEMENT, TYPE=MASS, ELSET=M\n900, 9002\n*MASS, ELSET=M\n2.5\n"))
        self.write("bad.yaml", BODY.format(tie="rigid body 9001", more="masses: from_file", ending="inp", length=0.6))
        self.expect_refusal(1, "bad.yaml", "-o", "bad.h5", says=["mass 900: mpc tie 9002, at whose node it stands, cannot carry it: *MPC of type TIE"])


if __name__ == "__main__":
    unittest.main()
