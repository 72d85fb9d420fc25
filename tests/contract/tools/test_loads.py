"""Tests of tools/bielle-loads: the loads of a superelement balance, and CalculiX computes the deformation of Bielle
from them."""

import os
import shutil
import subprocess
import tempfile
import unittest

import h5py
import numpy as np

from box_mesh import REPOSITORY
from python_tool import run_python_tool  # box_mesh sets the path

from bielle_tools.bodies.loads import LoadedBody
from bielle_tools.mesh import cell_integrals
from bielle_tools.results import Results

PROGRAMS = os.environ["BIELLE_PROGRAMS"]
TOOL = os.path.join(REPOSITORY, "tools", "bielle-loads")
LENGTH, WIDTH, DENSITY = 1.0, 0.1, 7800.0

BODY = """
body: bar
geometry: bar.geo
mesh: {size: 0.05, order: 2}
materials:
  steel: {young: 210e9, poisson: 0.3, density: 7800}
regions: {bar: steel}
interfaces:
  root: {surface: root, tie: ROOT}
  tip: {surface: tip, tie: average}
modes: {count: MODES}
damping: {ratio: 0.005}
recovery: {displacement: all, stress: all}
"""

# The bar is accelerated to 40 rad/s about z while a force bends it upwards; it has a weight at its end.
MODEL = """
gravity: [0, 0, -9.81]
nodes: {root: {position: [0, 0, 0]}, tip: {position: [1, 0, 0]}}
elements:
  bar: {type: superelement, file: bar.h5, nodes: {root: root, tip: tip}}
  weight: {type: rigid_body, node: tip, mass: 20, inertia: [0.1, 0.1, 0.1]}
joints: {pin: {type: hinge, nodes: [ground, root], axis: [0, 0, 1]}}
drives: {motor: {joint: pin, rate: "40*step(t, 0, 0.05)"}}
loads: {push: {node: tip, force: [0, 0, "2000*step(t, 0, 0.04)"]}}
analysis: [{type: dynamic, duration: 0.06, step: 1e-4}]
"""


def read_frd(path):
    """Returns [(name, {node: values})] of displacements and stresses, step by step."""
    found, values = [], None
    with open(path, encoding="ascii") as file:
        for line in file:
            if line.startswith(" -4"):
                name = line[5:13].strip()
                values = {} if name in ("DISP", "STRESS") else None
                if values is not None:
                    found.append((name, values))
            elif line.startswith(" -1") and values is not None:
                values[int(line[3:13])] = [float(line[k:k + 12]) for k in range(13, len(line.rstrip()), 12)]
            elif line.startswith(" -3"):
                values = None
    return found


class Loads(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        shutil.copy(os.path.join(REPOSITORY, "meshes", "bar.geo"), cls.at("bar.geo"))
        cls.prepare("bar", "rigid", 20)

    @classmethod
    def at(cls, name):
        return os.path.join(cls.folder.name, name)

    @classmethod
    def prepare(cls, name, root, modes):
        with open(cls.at(f"{name}.yaml"), "w", encoding="utf-8") as file:
            file.write(BODY.replace("ROOT", root).replace("MODES", str(modes)))
        with open(cls.at(f"{name}_model.yaml"), "w", encoding="utf-8") as file:
            file.write(MODEL.replace("bar.h5", f"{name}.h5"))
        for command in ([os.path.join(PROGRAMS, "bielle-reduce"), f"{name}.yaml", "-o", f"{name}.h5"],
                        [os.path.join(PROGRAMS, "bielle-mechanism"), f"{name}_model.yaml", "-o", f"{name}_run.h5"]):
            subprocess.run(command, cwd=cls.folder.name, check=True, capture_output=True, timeout=200)

    def export(self, name, *options):
        return run_python_tool(TOOL, [f"{name}_run.h5", "bar", *options], self.folder.name)

    def loaded(self, name):
        return LoadedBody(Results(self.at(f"{name}_run.h5")), "bar", {"bar": self.at(f"{name}.h5")})

    def test_the_mass_matrix_of_the_mesh_is_that_of_the_superelement(self):
        loaded = self.loaded("bar")
        M = np.einsum("pka,pkb->ab", loaded.T, np.stack([loaded.mesh_mass @ loaded.T[:, :, k] for k in range(loaded.T.shape[2])], axis=2))
        # Ties add rotary inertia, except rigid ties of surfaces, which have no thickness.
        np.testing.assert_allclose(M, loaded.M, atol=1e-9 * np.abs(loaded.M).max())
        self.assertAlmostEqual(loaded.mesh_mass.sum(), DENSITY * LENGTH * WIDTH**2, places=8)

    def test_forces_and_inertia_balance_to_rounding_and_need_no_mending(self):
        loaded = self.loaded("bar")
        for row in (0, 200, 500):
            load = loaded.at(row)
            force, moment = load.unbalance
            size = np.abs(load.interface).max()
            self.assertLess(np.linalg.norm(force), 1e-12 * size)
            self.assertLess(np.linalg.norm(moment), 1e-12 * size)
            self.assertLess(load.corrected, 1e-12)
            # These are the written forces, including the distributed ones of the average tie.
            spread = load.inertia.copy()
            for surface, at in zip(loaded.surfaces, load.interface):
                if not surface.rigid:
                    spread[surface.nodes] += surface.spread @ at
            np.testing.assert_allclose(spread.sum(axis=0), -load.interface[0, :3], atol=1e-11 * size)
            about = loaded.positions[0]
            np.testing.assert_allclose(np.cross(loaded.points - about, spread).sum(axis=0), -load.interface[0, 3:], atol=1e-11 * size)

    def test_the_motion_is_that_of_a_turning_bar(self):
        # At 0.055 s the bar rotates at 40 rad/s. The mass centre at a radius of half a metre has an acceleration of 800
        # m/s^2 inwards; bending hardly moves it.
        load = self.loaded("bar").at(550)
        self.assertAlmostEqual(load.angular_velocity[2], 40, delta=0.2)
        self.assertAlmostEqual(load.acceleration[0], -800, delta=8)
        inwards = load.interface[0, 0] + load.interface[1, 0]
        self.assertAlmostEqual(inwards, DENSITY * LENGTH * WIDTH**2 * load.acceleration[0], delta=1e-9 * abs(inwards))

    def test_the_spread_of_an_average_tie_is_equivalent_to_its_force(self):
        surface = self.loaded("bar").surfaces[1]
        points = self.loaded("bar").points[surface.nodes] - surface.position
        np.testing.assert_allclose(surface.spread.sum(axis=0), np.eye(3, 6), atol=1e-12)
        moments = np.cross(points[:, :, None], surface.spread, axis=1).sum(axis=0)
        np.testing.assert_allclose(moments, np.eye(3, 6, 3), atol=1e-12)

    def test_rules_of_integration_are_exact(self):
        points, cells = np.array([[0, 0, 0], [1, 0, 0], [0, 2, 0], [0, 0, 3.0]]), {"tetra": np.array([[0, 1, 2, 3]])}
        mass = cell_integrals.scalar_mass(points, cells, {"tetra": np.array([20.0])}).toarray()
        np.testing.assert_allclose(mass, (np.ones((4, 4)) + np.eye(4)), rtol=1e-13)  # rho V/20 (1 + delta), V = 1

    @unittest.skipUnless(shutil.which("ccx"), "CalculiX is not installed (Debian package calculix-ccx)")
    def test_calculix_finds_the_same_displacements_and_stresses(self):
        self.prepare("loose", "average", 40)
        for name in ("bar", "loose"):
            done = self.export(name, "--time", "0.02,0.05", "-o", "case.inp")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("all together: force", done.stdout)
            subprocess.run(["ccx", "-i", "case"], cwd=self.folder.name, check=True, capture_output=True, timeout=300,
                           env={**os.environ, "OMP_NUM_THREADS": "1"})
            found, loaded = read_frd(self.at("case.frd")), self.loaded(name)
            self.assertEqual([kind for kind, _ in found], ["DISP", "STRESS"] * 2)
            rigid = loaded._rigid().reshape(-1, 6)  # pylint: disable=protected-access
            without_rigid = lambda u: u - rigid @ np.linalg.lstsq(rigid, u, rcond=None)[0]  # noqa: E731
            inside = np.abs(loaded.points[loaded.body.stressed, 0] - 0.5) < 0.35
            for row, (_, u), (_, stress) in zip((200, 500), found[::2], found[1::2]):
                q = loaded.at(row).q
                ours = without_rigid((loaded.T @ q).ravel())
                theirs = without_rigid(np.array([u[k + 1] for k in range(len(loaded.points))]).ravel())
                # The tolerance covers the part that the modes lack, 4 % of the small axial response to the speed.
                self.assertLess(np.abs(theirs - ours).max(), 5e-3 * np.abs(ours).max(), (name, row))
                # Both programs average the stresses of elements at a node in different ways, which causes differences
                # of a few per cent at stress concentrations.
                s = (loaded.body.stress @ q).reshape(-1, 6)[:, [0, 1, 2, 5, 3, 4]]
                t = np.array([stress[k + 1] for k in loaded.body.stressed])
                self.assertLess(np.linalg.norm((t - s)[inside]), 0.02 * np.linalg.norm(s[inside]), (name, row))

    def test_mistakes_are_told(self):
        for options, said in ((("--time", "0.7"), "the results go from"), (("--time", "soon"), "times in seconds"),
                              (("--time", "0.01", "--surface", "tipp=tip"), "did you mean 'tip'")):
            done = self.export("bar", *options)
            self.assertEqual(done.returncode, 1)
            self.assertIn(said, done.stderr)
        with h5py.File(self.at("bar_run.h5")) as file:
            self.assertIn("interface_force", file["elements/bar"])


if __name__ == "__main__":
    unittest.main()
