"""Tests of `materials: from_file`: the materials of Nastran and Abaqus files, in their units, equal those of a body
file in SI units."""

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

INTERFACES = """\
interfaces: {left: {surface: {plane: {point: [0, 0, 0], normal: [1, 0, 0]}}, tie: average}}
modes: {count: 4}
"""
FROM_FILE = "body: bar\ngeometry: bar.ENDING\nlength_unit: mm\nmaterials: from_file\nmass_unit: t\n" + INTERFACES
STEEL = "{young: 210e9, poisson: 0.3, density: 7850}"
WOOD = "{E1: 12e9, E2: 1e9, E3: 0.5e9, nu12: 0.4, nu13: 0.3, nu23: 0.35, G12: 0.8e9, G13: 0.7e9, G23: 0.1e9, density: 600}"
WOOD_IN_MM = "12000., 1000., 500., 0.4, 0.3, 0.35, 800., 700.,\n100.\n"


def elasticity():
    """Returns the stiffness of the wood in the order xx yy zz yz xz xy [Pa]."""
    compliance = np.diag([1 / 12e9, 1 / 1e9, 1 / 0.5e9, 1 / 0.1e9, 1 / 0.7e9, 1 / 0.8e9])
    for i, j, nu, young in ((0, 1, 0.4, 12e9), (0, 2, 0.3, 12e9), (1, 2, 0.35, 1e9)):
        compliance[i, j] = compliance[j, i] = -nu / young
    return np.linalg.inv(compliance)


class DeckMaterials(WithQuickTools, CommandTest):
    program = "bielle-reduce"

    def write(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)

    def box(self):
        box = cell_decks.Box(("hexahedron",) * 3, 2)
        box.points = [1000 * point for point in box.points]
        return box

    def abaqus(self, material, section=""):
        """A deck in mm, t, s."""
        return self.box().abaqus() + f"*MATERIAL, NAME=Stuff\n{material}*SOLID SECTION, ELSET=body, MATERIAL=STUFF{section}\n"

    def nastran(self, material):
        return self.box().nastran(material, form="large")

    def reduced(self, text, name="body"):
        self.write(name + ".yaml", text)
        done = self.run_program(name + ".yaml", "-o", name + ".h5")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.said = done.stderr
        with h5py.File(self.path(name + ".h5")) as file:
            return float(file["mass_properties/mass"][()]), np.array(file["adequacy/free_frequencies"])

    def expect_same(self, deck, ending, material):
        self.write("bar." + ending, deck)
        mass, frequencies = self.reduced(FROM_FILE.replace("ENDING", ending))
        plain = f"body: bar\ngeometry: bar.{ending}\nlength_unit: mm\nmaterials: {{stuff: {material}}}\nregions: {{all: stuff}}\n"
        wanted, others = self.reduced(plain.replace("all", "BODY" if ending == "inp" else "property_1") + INTERFACES, "plain")
        self.assertAlmostEqual(mass / wanted, 1, delta=1e-12)
        self.assertLess(abs(frequencies / others - 1).max(), 1e-9)

    def test_isotropic(self):
        self.expect_same(self.abaqus("*ELASTIC\n210000., 0.3\n*DENSITY\n7.85E-9\n*PLASTIC\n300., 0.\n"), "inp", STEEL)
        self.expect_same(self.nastran("MAT1,1,210000.,,.3,7.85-9\n"), "bdf", STEEL)
        self.expect_same(self.nastran(f"MAT1,1,,{210000 / 2.6:.12g},.3,7.85-9\n"), "bdf", STEEL)

    def test_orthotropic_in_every_form(self):
        self.expect_same(self.abaqus("*ELASTIC, TYPE=ENGINEERING CONSTANTS\n" + WOOD_IN_MM + "*DENSITY\n6e-10\n"), "inp", WOOD)
        C = elasticity() / 1e6
        words = [f"{C[i, j]:.12g}" for i, j in ((0, 0), (0, 1), (1, 1), (0, 2), (1, 2), (2, 2), (5, 5), (4, 4), (3, 3))]
        rows = ", ".join(words[:8]) + ",\n" + words[8] + "\n"
        self.expect_same(self.abaqus(f"*ELASTIC, TYPE=ORTHOTROPIC\n{rows}*DENSITY\n6e-10\n"), "inp", WOOD)
        order = (0, 1, 2, 5, 4, 3)  # xx yy zz xy xz yz
        words = [f"{C[order[i], order[j]]:.12g}" for j in range(6) for i in range(j + 1)]
        rows = "".join(", ".join(words[k:k + 8]) + "\n" for k in range(0, 21, 8))
        self.expect_same(self.abaqus(f"*ELASTIC, TYPE=ANISOTROPIC\n{rows}*DENSITY\n6e-10\n"), "inp", WOOD)
        order = (0, 1, 2, 5, 3, 4)  # xx yy zz xy yz zx
        words = ["1"] + [f"{C[order[i], order[j]]:.13g}" for i in range(6) for j in range(i, 6)] + ["6.-10"]
        rows = "MAT9," + "\n,".join(",".join(words[k:k + 8]) for k in range(0, 23, 8)) + "\n"
        self.expect_same(self.nastran(rows), "bdf", WOOD)

    def refuse(self, deck, *says, text=FROM_FILE, ending="inp"):
        self.write("bar." + ending, deck)
        self.write("bad.yaml", text.replace("ENDING", ending))
        self.expect_refusal(1, "bad.yaml", "-o", "bad.h5", says=says)

    def test_refusals(self):
        steel = "*ELASTIC\n210000., 0.3\n*DENSITY\n7.85E-9\n"
        self.refuse(self.abaqus("*ELASTIC\n210000., 0.3\n"), "bad.yaml:4: materials", "NAME=Stuff has no *DENSITY")
        self.refuse(self.abaqus("*DENSITY\n1.\n"), "NAME=Stuff has no *ELASTIC")
        self.refuse(self.abaqus("*ELASTIC\n2e5\n*DENSITY\n1.\n"), "needs 2 constants, found 1")
        self.refuse(self.abaqus("*ELASTIC\n2e5, x\n*DENSITY\n1.\n"), "has 'x' where a number belongs")
        self.refuse(self.abaqus("*ELASTIC, TYPE=LAMINA\n1.,1.\n*DENSITY\n1.\n"), "TYPE=LAMINA is not read")
        self.refuse(self.abaqus("*ELASTIC\n2e5, 0.7\n*DENSITY\n1.\n"), "materials.Stuff.poisson")
        self.refuse(self.abaqus(steel).replace("MATERIAL=STUFF", "MATERIAL=NONE"), "there is no *MATERIAL, NAME=NONE")
        self.refuse(self.abaqus(steel).replace("ELSET=body,", "ELSET=nobody,"), "there is no element set 'nobody'")
        self.refuse(self.box().abaqus(), "gives no solid cells a material")
        wood = "*ELASTIC, TYPE=ENGINEERING CONSTANTS\n" + WOOD_IN_MM + "*DENSITY\n6e-10\n"
        self.refuse(self.abaqus(wood, ", ORIENTATION=O"), "ELSET=BODY has an orientation", "`axes`")
        self.refuse(self.nastran(""), "PSOLID 1 names the material 1", ending="bdf")
        self.refuse(self.nastran("MAT1,1,210000.\n"), "needs two of E, G and NU", ending="bdf")
        self.refuse(self.nastran("MAT1,1,210000.,,.3\n"), "MAT1 1 has no density", ending="bdf")
        for wrong in ("from_files", "[from_file]"):
            self.refuse(self.abaqus(steel), "bad.yaml:4: materials", text=FROM_FILE.replace("from_file", wrong))
        plain = f"body: bar\ngeometry: bar.inp\nmaterials: {{stuff: {STEEL}}}\n" + INTERFACES
        self.refuse(self.abaqus(steel), "the key 'regions' is missing", text=plain)
        units = plain.replace("body: bar", "body: bar\nregions: {all: stuff}\nmass_unit: t")
        self.refuse(self.abaqus(steel), "bad.yaml:3: mass_unit", "materials: from_file", text=units)
        self.refuse(self.abaqus(steel), "mass_unit", "'slinch'", text=FROM_FILE.replace("mass_unit: t", "mass_unit: slinc"))

    def test_implausible_units_are_told(self):
        self.write("bar.inp", self.abaqus("*ELASTIC\n210000., 0.3\n*DENSITY\n7.85E-9\n"))
        self.reduced(FROM_FILE.replace("ENDING", "inp").replace("mass_unit: t\n", ""))
        self.assertIn("materials", self.said)

    def test_regions_may_choose_among_the_materials_of_the_file(self):
        self.write("bar.inp", self.abaqus("*ELASTIC\n210000., 0.3\n*DENSITY\n7.85E-9\n"))
        mass, _ = self.reduced(FROM_FILE.replace("ENDING", "inp") + "regions: {BODY: Stuff}\n")
        self.assertAlmostEqual(mass / (7850 * cell_decks.VOLUME), 1, delta=1e-12)


if __name__ == "__main__":
    unittest.main()
