"""Compares motions of bodies from matrices of CalculiX, shells and tetrahedra, with Bielle's own reduction of the same
mesh."""

import os
import shutil
import subprocess
import sys
import unittest

import h5py
import numpy as np
import scipy.linalg

from test_reduce_matrices import Matrices
from kuhn_cubes import kuhn_cubes

REPOSITORY = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", "..", ".."))
sys.path.insert(0, os.path.join(REPOSITORY, "tools"))
from bielle_tools.exchange import calculix_matrices, formats  # noqa: E402

LENGTH, WIDTH, THICKNESS = 1.0, 0.1, 0.02  # the strip of shells
SIDE, YOUNG, DENSITY = 0.05, 7e9, 2700.0     # the rod of tetrahedra, soft enough for its bending to matter
SWING = """\
mechanism: swing
gravity: [0, 0, -9.81]
nodes: {{pin: {{position: [0, 0, 0]}}, tip: {{position: [{length}, 0, 0]}}}}
elements: {{rod: {{type: superelement, file: {name}.h5, nodes: {{left: pin, right: tip}}}}}}
joints: {{hinge: {{type: hinge, nodes: [ground, pin], axis: [0, 1, 0]}}}}
analysis: [{{type: dynamic, duration: 0.4, step: {step}}}]
"""
FLY = """\
mechanism: flight
nodes:
  pin: {{position: [0, 0, 0], velocity: [0.5, -2, 1], angular_velocity: [0, 2, 4]}}
  tip: {{position: [{length}, 0, 0], velocity: [0.5, 2, -1], angular_velocity: [0, 2, 4]}}
elements: {{rod: {{type: superelement, file: {name}.h5, nodes: {{left: pin, right: tip}}}}}}
analysis: [{{type: dynamic, duration: 0.4, step: {step}}}]
"""
SPIN = """\
mechanism: spin
nodes:
  pin: {{position: [0, 0, 0], velocity: [0.3, -3, 0.2], angular_velocity: [0, 0, 6]}}
  tip: {{position: [{length}, 0, 0], velocity: [0.3, 3, 0.2], angular_velocity: [0, 0, 6]}}
elements: {{rod: {{type: superelement, file: {name}.h5, nodes: {{left: pin, right: tip}}}}}}
analysis: [{{type: dynamic, duration: 1, step: {step}}}]
"""



class Moved(Matrices):
    """Bodies with the interfaces left and right."""

    def reduce(self, name):
        """Reduces NAME.yaml and returns the output on standard error."""
        done = self.run_program(f"{name}.yaml")
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stderr

    def run_ccx(self, name, deck):
        self.write(f"{name}.inp", deck)
        subprocess.run(["ccx", name], cwd=self.folder, check=True, capture_output=True, timeout=300)

    def motion(self, model, name, step=0.001):
        """Returns the times, and the positions of both ends of a body in a mechanism."""
        with self.run_mechanism(model.format(name=name, length=LENGTH, step=step)) as file:
            run = file["analysis_1"]
            return run["time"][:], run["nodes/pin/position"][:], run["nodes/tip/position"][:]

    def check_frequencies(self, body, job, count):
        """Asserts that the free frequencies of the reduced body are above those that CalculiX prints, by less than 1
        %."""
        with open(self.path(f"{job}.dat"), encoding="utf-8") as file:
            rows = [line.split() for line in file if len(line.split()) == 5 and line.split()[0].isdigit()]
        printed = np.array([float(row[3]) for row in rows[6:6 + count]])
        with h5py.File(self.path(f"{body}.h5")) as file:
            values = scipy.linalg.eigh(file["reduced/stiffness"][()], file["reduced/mass"][()], eigvals_only=True)[6:6 + count]
        excess = np.sqrt(values) / (2 * np.pi) / printed - 1
        self.assertGreater(excess.min(), -1e-5)
        self.assertLess(excess.max(), 1e-2)


@unittest.skipUnless(shutil.which("ccx"), "CalculiX is not installed (Debian: calculix-ccx)")
class Shells(Moved):
    """Compares a strip of CalculiX' shells S8, which it expands to solids, with Bielle's own reduction of the same
    strip."""

    def shell_strip(self, cells=10):
        """Writes the deck of a strip along x, and runs it to get matrices and expanded nodes."""
        width, places, elements = WIDTH, {}, []

        def node(i, j):
            return places.setdefault((i, j), len(places) + 1)

        for e in range(cells):
            corners = ((2 * e, 0), (2 * e + 2, 0), (2 * e + 2, 2), (2 * e, 2))
            middles = ((2 * e + 1, 0), (2 * e + 2, 1), (2 * e + 1, 2), (2 * e, 1))
            elements.append([node(*place) for place in (*corners, *middles)])
        lines = [f"{number}, {LENGTH * i / (2 * cells):.12g}, {width * (j - 1) / 2:.12g}, 0." for (i, j), number in places.items()]
        cards = [f"{k}, " + ", ".join(map(str, nodes)) for k, nodes in enumerate(elements, 1)]
        deck = ("*NODE\n" + "\n".join(lines) + "\n*ELEMENT, TYPE=S8, ELSET=E\n" + "\n".join(cards) +
                f"\n*SHELL SECTION, ELSET=E, MATERIAL=M\n{THICKNESS}\n*MATERIAL, NAME=M\n*ELASTIC\n70e9, 0.3\n*DENSITY\n2700.\n"
                "*STEP\n*FREQUENCY\n8\n*NODE FILE, OUTPUT=3D\nU\n*END STEP\n*STEP\n*FREQUENCY, SOLVER=MATRIXSTORAGE\n1\n*END STEP\n")
        self.run_ccx("strip", deck)
        matrices = calculix_matrices.read(self.path("strip.sti"), formats.Options())
        x = matrices.positions[:, 0]
        return [[int(n) for n in matrices.numbers[np.abs(x - end) < 1e-6]] for end in (0, LENGTH)]

    def solid_strip(self):
        self.write("strip.geo", f"""\
Point(1) = {{0, {-WIDTH / 2}, {-THICKNESS / 2}}};
a[] = Extrude {{{LENGTH}, 0, 0}} {{ Point{{1}}; Layers{{10}}; Recombine; }};
b[] = Extrude {{0, {WIDTH}, 0}} {{ Line{{a[1]}}; Layers{{1}}; Recombine; }};
c[] = Extrude {{0, 0, {THICKNESS}}} {{ Surface{{b[1]}}; Layers{{1}}; Recombine; }};
Physical Volume("all") = {{c[1]}};
""")
        self.write("solid.yaml", f"""\
body: strip
geometry: strip.geo
mesh: {{order: 2, cells: hexahedra, size: 0.1}}
materials: {{m: {{young: 70e9, poisson: 0.3, density: 2700}}}}
regions: {{all: m}}
interfaces:
  left: {{surface: {{plane: {{point: [0, 0, 0], normal: [1, 0, 0]}}}}}}
  right: {{surface: {{plane: {{point: [{LENGTH}, 0, 0], normal: [1, 0, 0]}}}}}}
modes: {{count: 8}}
""")
        self.reduce("solid")

    def check_flight(self):
        """Both free strips, which spin about two axes, have the same motion, and their centre moves straight on."""
        time, pin, tip = self.motion(FLY, "shells")
        np.testing.assert_allclose(tip, self.motion(FLY, "solid")[2], atol=2e-5)
        # The spin about z causes bending vibrations of the middle between the ends, far smaller than the width of the
        # strip.
        np.testing.assert_allclose((pin + tip)[:, 0] / 2, LENGTH / 2 + 0.5 * time, atol=2e-3)
        self.assertGreater(np.abs(tip[:, 1]).max(), 0.4)

    def test_a_rod_of_shells_is_like_its_solid_twin(self):
        left, right = self.shell_strip()
        self.write("shells.yaml", f"body: strip\nmatrices: strip.sti\ninterfaces:\n  left: {{nodes: {left}, position: [0, 0, 0]}}\n"
                   f"  right: {{nodes: {right}, position: [{LENGTH}, 0, 0]}}\nmodes: {{count: 8}}\n")
        self.assertIn("the inertia of large rotations is that of the nodes", self.reduce("shells"))
        self.solid_strip()
        with h5py.File(self.path("shells.h5")) as shells, h5py.File(self.path("solid.h5")) as solid:
            # CalculiX expands S8 to cells of 20 nodes, which are those of the other body.
            np.testing.assert_allclose(shells["modes/frequencies"], solid["modes/frequencies"], rtol=1e-6)
            np.testing.assert_allclose(shells["mass_properties/mass"], solid["mass_properties/mass"], rtol=1e-6)
            np.testing.assert_allclose(shells["mass_properties/inertia"], solid["mass_properties/inertia"], atol=1e-5)
            self.assertEqual(list(shells["mesh/cells"]), ["17"])  # the strip is drawn with its cells
            self.assertEqual(shells["mesh/cells/17"].shape, (10, 20))
        self.check_frequencies("shells", "strip", 2)
        self.check_flight()
        tip = self.motion(SWING, "shells")[2]
        np.testing.assert_allclose(tip, self.motion(SWING, "solid")[2], atol=1e-5)
        self.assertLess(tip[-1, 2], -0.5)


@unittest.skipUnless(shutil.which("ccx"), "CalculiX is not installed (Debian: calculix-ccx)")
class Tetrahedra(Moved):
    """Compares matrices of CalculiX for a square rod of C3D10 with Bielle's own reduction of the same deck."""

    def rod(self, cells=10):
        """Writes and runs the deck of cubes of six tetrahedra, in a row along x. Returns the nodes of both ends."""
        numbers, elements = kuhn_cubes(cells)
        nodes = "".join(f"{number}, {LENGTH * x / cells:.12g}, {SIDE * (y - 0.5):.12g}, {SIDE * (z - 0.5):.12g}\n"
                        for (x, y, z), number in numbers.items())
        cards = "".join(f"{k}, {', '.join(map(str, element))}\n" for k, element in enumerate(elements, 1))
        self.run_ccx("rod", f"*NODE\n{nodes}*ELEMENT, TYPE=C3D10, ELSET=E\n{cards}*SOLID SECTION, ELSET=E, MATERIAL=M\n*MATERIAL, NAME=M\n"
                     f"*ELASTIC\n{YOUNG}, 0.3\n*DENSITY\n{DENSITY}\n*STEP\n*FREQUENCY\n12\n*END STEP\n"
                     "*STEP\n*FREQUENCY, SOLVER=MATRIXSTORAGE\n1\n*END STEP\n")
        return [[number for place, number in numbers.items() if place[0] == end] for end in (0, cells)]

    def reduce_deck(self, name, young):
        """Bielle's own reduction of the deck."""
        ends = "".join(f"  {end}: {{surface: {{plane: {{point: [{x}, 0, 0], normal: [1, 0, 0]}}}}, position: [{x}, 0, 0]}}\n"
                       for end, x in (("left", 0), ("right", LENGTH)))
        self.write(f"{name}.yaml", f"body: {name}\ngeometry: rod.inp\nmaterials: {{m: {{young: {young}, poisson: 0.3, density: {DENSITY}}}}}\n"
                   f"regions: {{E: m}}\ninterfaces:\n{ends}modes: {{count: 8}}\n")
        self.reduce(name)

    def without_geometric_stiffness(self, name, copy):
        shutil.copy(self.path(f"{name}.h5"), self.path(f"{copy}.h5"))
        with h5py.File(self.path(f"{copy}.h5"), "a") as file:
            del file["reduced/geometric_stiffness"], file.attrs["checksum"]

    def test_a_rod_of_tetrahedra_moves_like_its_own_reduction(self):
        left, right = self.rod()
        self.write("matrices.yaml", f"body: rod\nmatrices: rod.sti\ninterfaces:\n  left: {{nodes: {left}, position: [0, 0, 0]}}\n"
                   f"  right: {{nodes: {right}, position: [{LENGTH}, 0, 0]}}\nmodes: {{count: 8}}\n")
        self.assertIn("the inertia of large rotations is that of the nodes", self.reduce("matrices"))
        self.reduce_deck("own", YOUNG)
        self.reduce_deck("rigid", 1e4 * YOUNG)
        with h5py.File(self.path("matrices.h5")) as matrices, h5py.File(self.path("own.h5")) as own:
            # CalculiX integrates the mass of C3D10 at four points, which is exact for rigid motions only.
            np.testing.assert_allclose(matrices["modes/frequencies"], own["modes/frequencies"], rtol=2e-3)
            for name in ("mass", "centre", "inertia"):
                # Weights and entries of CalculiX have about ten digits.
                np.testing.assert_allclose(matrices[f"mass_properties/{name}"], own[f"mass_properties/{name}"], rtol=0, atol=1e-8)
            self.assertEqual({kind: cells.shape for kind, cells in matrices["mesh/cells"].items()}, {"11": (60, 10)})
        self.check_frequencies("matrices", "rod", 4)
        self.check_flight()
        self.check_spin()
        self.check_swing()

    def check_flight(self):
        time, pin, tip = self.motion(FLY, "matrices")
        deformation = np.abs(self.motion(FLY, "rigid")[2] - tip).max()
        self.assertGreater(deformation, 1e-6)
        self.assertLess(np.abs(self.motion(FLY, "own")[2] - tip).max(), 1e-3 * deformation)
        # The middle between the ends is the centre of the rod, which moves straight on.
        np.testing.assert_allclose((pin + tip) / 2, [LENGTH / 2, 0, 0] + np.outer(time, [0.5, 0, 0]), rtol=0, atol=1e-9)

    def check_spin(self):
        # The rod vibrates about its elongation in steady rotation.
        expected = DENSITY * 6**2 * LENGTH**3 / (12 * YOUNG)
        lags = []
        for step in (0.001, 0.0005):
            time, pin, tip = self.motion(SPIN, "matrices", step)
            np.testing.assert_allclose((pin + tip) / 2, [LENGTH / 2, 0, 0] + np.outer(time, [0.3, 0, 0.2]), rtol=0, atol=1e-9)
            angle = np.unwrap(np.arctan2((tip - pin)[:, 1], (tip - pin)[:, 0]))
            lags.append(6 * time[-1] - angle[-1])
        stretch = np.mean(np.linalg.norm(tip - pin, axis=1)) - LENGTH
        self.assertAlmostEqual(stretch / expected, 1, delta=0.01)
        # The angular momentum is that of the unstretched rod, so that it turns more slowly by twice the stretch. The
        # error of the steps is of second order.
        self.assertAlmostEqual((4 * lags[1] - lags[0]) / 3 / (6 * time[-1] * 2 * expected), 1, delta=0.02)

    def check_swing(self):
        tip = self.motion(SWING, "matrices")[2]
        self.assertLess(tip[-1, 2], -0.5)
        bending = np.abs(self.motion(SWING, "rigid")[2] - tip).max()
        self.assertGreater(bending, 1e-4)
        # Tension stiffens Bielle's own body. Without this effect the difference is due to the integration of the mass.
        self.without_geometric_stiffness("own", "plain")
        self.assertLess(np.abs(self.motion(SWING, "own")[2] - tip).max(), 4e-2 * bending)
        self.assertLess(np.abs(self.motion(SWING, "plain")[2] - tip).max(), 2e-3 * bending)


if __name__ == "__main__":
    unittest.main()
