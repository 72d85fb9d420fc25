"""Tests that a superelement is the same body after bielle-exchange has written it for Nastran and bielle-reduce has
read it."""

import os
import subprocess
import unittest

import h5py
import numpy as np
import scipy.linalg

from box_mesh import REPOSITORY, InFolder
from python_tool import run_python_tool  # box_mesh sets the path

PROGRAM = os.path.join(os.environ["BIELLE_PROGRAMS"], "bielle-reduce")
TOOL = os.path.join(REPOSITORY, "tools", "bielle-exchange")
LENGTH, WIDTH, DENSITY = 1.0, 0.1, 7800.0
GEOMETRY = f"""SetFactory("OpenCASCADE");
Box(1) = {{0, 0, 0, {LENGTH}, {WIDTH}, {WIDTH}}};
Physical Volume("bar") = {{1}};
Physical Surface("root") = {{1}};
Physical Surface("tip") = {{2}};
"""
BODY = f"""
body: bar
geometry: bar.geo
mesh: {{size: 0.1, order: 2}}
materials:
  steel: {{young: 210e9, poisson: 0.3, density: {DENSITY}}}
regions: {{bar: steel}}
interfaces:
  root: {{surface: root, tie: rigid}}
  tip: {{surface: tip, tie: average}}
modes: {{count: 6}}
"""


def takes_matrices():
    """Tells whether the program has the option that bielle-exchange calls."""
    return "--from" in subprocess.run([PROGRAM, "--help"], capture_output=True, text=True, check=False, timeout=60).stdout


def eigenvalues(path):
    """Returns the free eigenvalues of a superelement file [rad^2/s^2], their bound of errors from 5e-11 of each entry
    of the matrices (11 digits), and the mass."""
    with h5py.File(path) as file:
        stiffness, mass = file["reduced/stiffness"][()], file["reduced/mass"][()]
        values, shapes = (part[..., 6:] for part in scipy.linalg.eigh(stiffness, mass))
        shapes = abs(shapes)
        change = 5e-11 * np.einsum("ik,ijk,jk->k", shapes, abs(stiffness)[:, :, None] + abs(mass)[:, :, None] * values, shapes)
        return values, change, float(file["mass_properties/mass"][()])


class Superelement(InFolder):
    def run_tool(self, *arguments):
        done = run_python_tool(TOOL, list(arguments), self.folder, {**os.environ, "BIELLE_BIN": os.environ["BIELLE_PROGRAMS"]})
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def test_there_and_back(self):
        self.write("bar.geo", GEOMETRY)
        self.write("bar.yaml", BODY)
        subprocess.run([PROGRAM, "bar.yaml", "-o", "bar.h5"], cwd=self.folder, capture_output=True, check=True, timeout=300)
        values, change, mass = eigenvalues(self.path("bar.h5"))
        self.assertAlmostEqual(mass / (DENSITY * LENGTH * WIDTH**2), 1, delta=1e-9)
        self.run_tool("bar.h5", "bar.pch", "--to-units", "mm-t-s")
        if not takes_matrices():
            self.skipTest("this bielle-reduce takes no matrices")
        self.run_tool("bar.pch", "back.h5", "--units", "mm-t-s")
        found, _, other = eigenvalues(self.path("back.h5"))
        self.assertTrue((abs(found - values) <= change).all(), (found - values) / values)
        self.assertAlmostEqual(other / mass, 1, delta=1e-9)


if __name__ == "__main__":
    unittest.main()
