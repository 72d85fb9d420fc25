"""Tests of the tools that draw modes, with shapes in closed form and with those of the programs, including bodies."""

import os
import subprocess
import tempfile
import unittest
from xml.etree import ElementTree

import h5py
import meshio
import numpy as np
from PIL import Image

from box_mesh import REPOSITORY, InFolder
from python_tool import import_tools, prepare_figures, run_python_tool  # box_mesh sets the path
from synthetic_modes import OMEGA, SIGMA, write_whirl

from bielle_tools.bodies.superelement_body import superelement_of  # noqa: E402
from bielle_tools.results import Results  # noqa: E402
from bielle_tools.results.modes import ModeMotion, Modes, ModeScenery, turned  # noqa: E402  (box_mesh sets the path)
from bielle_tools.results.rotations import rotation_matrices  # noqa: E402
from shares import share_of_tests as load_tests  # noqa: E402,F401

PROGRAMS = os.environ["BIELLE_PROGRAMS"]
# The body's x axis is along y of the mechanism. Both ends are rigid, so that their surfaces move with their nodes.
BODY = """\
body: bar
geometry: %s/meshes/bar.geo
mesh: {size: 0.05, order: 2}
materials: {steel: {young: 210e9, poisson: 0.3, density: 7800}}
regions: {bar: steel}
interfaces: {root: {surface: root, tie: rigid}, tip: {surface: tip, tie: rigid}}
modes: {count: 6}
""" % REPOSITORY
MODEL = """\
mechanism: a bar and a mast
nodes:
  foot: {position: [0.1, 0.2, 0.3], fixed: true}
  end: {position: [0.1, 1.2, 0.3]}
  head: {position: [0.1, 0.2, 1.3]}
elements:
  bar: {type: superelement, file: bar.h5, position: [0.1, 0.2, 0.3], axes: {x: [0, 1, 0], y: [-1, 0, 0]}, nodes: {root: foot, tip: end}}
  mast: {type: beam, nodes: [foot, head], elements: 4, section: {rectangle: [0.03, 0.02], young: 2.1e11, poisson: 0.3, density: 7850}}
  ball: {type: rigid_body, node: end, solid: {sphere: 0.05, density: 7850}}
analysis:
  - {type: assembly}
  - {type: eigen, count: 7}
"""


class Tools(InFolder):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        import_tools()
        prepare_figures()

    def run_tool(self, tool, *arguments):
        return run_python_tool(os.path.join(REPOSITORY, "tools", tool), arguments, self.folder, {**os.environ, "DISPLAY": ""})

    def succeed(self, tool, *arguments):
        done = self.run_tool(tool, *arguments)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return done.stdout

    def refuse(self, part, tool, *arguments):
        done = self.run_tool(tool, *arguments)
        self.assertEqual((done.returncode, len(done.stderr.splitlines())), (1, 1), done.stderr)
        self.assertIn(part, done.stderr)


class AnalysesWithoutRows(Tools):
    def test_modes_over_a_speed_alone_are_drawn(self):
        self.write("rotor.yaml", """\
nodes: {hub: {position: [0, 0, 0]}, disc: {position: [0, 0, 0], angular_velocity: [0, 0, speed]}}
parameters: {speed: 0}
elements: {disc: {type: rigid_body, node: disc, mass: 5, inertia: [0.02, 0.02, 0.035]}}
joints:
  mount: {type: bushing, nodes: [ground, hub], stiffness: [2e5, 1e5, 3e5, 800, 800, 500]}
  axle: {type: hinge, nodes: [hub, disc], position: [0, 0, 0], axis: [0, 0, 1]}
analysis: [{type: campbell, parameter: speed, speeds: {to: 100, count: 5}, modes: 3}]
""")
        subprocess.run([os.path.join(PROGRAMS, "bielle-mechanism"), "rotor.yaml"], cwd=self.folder, check=True, capture_output=True)
        self.assertIn("campbell.png", self.succeed("bielle-plot", "rotor.h5"))
        self.assertGreater(os.path.getsize(self.path("rotor-plots/campbell.png")), 20000)


class Whirl(Tools):
    def setUp(self):
        super().setUp()
        write_whirl(self.path("whirl.h5"))

    def motion(self, number, **options):
        results = Results(self.path("whirl.h5"))
        self.addCleanup(results.file.close)
        return ModeMotion(ModeScenery(Modes(results)), number, **options)

    def test_a_complex_mode_goes_round(self):
        motion = self.motion(1, pictures=12, share=0.1)
        np.testing.assert_allclose(motion.time, 2 * np.pi / OMEGA * np.arange(12) / 12, rtol=1e-14)
        phase, a = OMEGA * motion.time, 0.1 * 2  # the model is 2 m long
        path = motion.rows("nodes/hub/position")
        np.testing.assert_allclose(path, np.column_stack([0 * phase + 2, a * np.cos(phase), a * np.sin(phase)]), atol=1e-15)
        np.testing.assert_allclose(motion.rows("nodes/hub/velocity")[:, :3],
                                   a * OMEGA * np.column_stack([0 * phase, -np.sin(phase), np.cos(phase)]), atol=1e-13)
        half = 0.5 * a * 0.3 * np.cos(phase)
        np.testing.assert_allclose(motion.rows("nodes/hub/rotation"),
                                   np.column_stack([np.cos(half), np.sin(half), 0 * half, 0 * half]), atol=1e-15)

    def test_decay_is_shown_when_it_is_asked_for(self):
        still, decaying = self.motion(1, pictures=12), self.motion(1, pictures=12, decay=True)
        radius = [np.linalg.norm(each.rows("nodes/hub/position")[:, 1:], axis=1) for each in (still, decaying)]
        np.testing.assert_allclose(radius[1] / radius[0], np.exp(SIGMA * still.time), rtol=1e-13)

    def test_a_mode_that_does_not_oscillate_is_shown_all_the_same(self):
        motion = self.motion(2, pictures=8, share=0.05)
        np.testing.assert_allclose(motion.rows("nodes/hub/position")[:, 2], 0.1 * np.cos(2 * np.pi * np.arange(8) / 8), atol=1e-16)
        self.assertIn("mode 2, 0 Hz, rigid", motion.title)

    def test_rotations_are_drawn_about_inertial_axes(self):
        rng = np.random.default_rng(1)
        vectors, q = rng.standard_normal((5, 3)), rng.standard_normal((5, 4))
        q /= np.linalg.norm(q, axis=1)[:, None]
        for v, q0, q1 in zip(vectors, q, turned(vectors, q)):
            angle, axis = np.linalg.norm(v), v / np.linalg.norm(v)
            cross = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
            rodrigues = np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
            np.testing.assert_allclose(rotation_matrices(q1), rodrigues @ rotation_matrices(q0), atol=1e-14)
        np.testing.assert_array_equal(turned(np.zeros((1, 3)), q[:1]), q[:1])

    def test_what_cannot_be_shown_is_told(self):
        self.refuse("holds no motion to show; it has 2 modes: --mode 1 shows the first", "bielle-animate", "whirl.h5")
        self.refuse("holds no motion to show; it has 2 modes", "bielle-paraview", "whirl.h5")
        self.refuse("there is no mode 3: ", "bielle-animate", "whirl.h5", "--mode", "3")
        self.refuse("there is no mode 0: ", "bielle-paraview", "whirl.h5", "--mode", "0")
        self.refuse("--amplitude is a positive number", "bielle-animate", "whirl.h5", "--mode", "1", "--amplitude", "-1")
        self.refuse("go with --mode N", "bielle-animate", "whirl.h5", "--decay")
        self.refuse("are for motions", "bielle-animate", "whirl.h5", "--mode", "1", "--from", "1")
        self.refuse("there is no superelement 'rod' in the results", "bielle-animate", "whirl.h5", "--mode", "1", "--superelement", "rod=a.h5")
        with h5py.File(self.path("whirl.h5"), "r+") as file:
            del file["analysis_1/eigen/displacement"]
        self.refuse("the analysis has 'shapes: false'", "bielle-animate", "whirl.h5", "--mode", "1")
        self.assertEqual(self.succeed("bielle-plot", "whirl.h5", "-o", "p").split(), ["p/eigenfrequencies.png", "p/eigenvalues.png"])
        with h5py.File(self.path("whirl.h5"), "r+") as file:
            del file["analysis_1/eigen/eigenvalue"]
            file["analysis_1/eigen/eigenvalue"] = np.zeros((3, 2))
        self.refuse("'eigen' cannot be read: it is damaged", "bielle-plot", "whirl.h5", "-o", "p")


class EndOfAMotion(InFolder):
    def test_the_last_row_of_the_analysis_before_is_the_state_without_its_number_being_given(self):
        self.write("swing.yaml", """\
gravity: [0, 0, -9.81]
nodes: {bob: {position: [1, 0, 0]}}
elements: {bob: {type: rigid_body, node: bob, mass: 1, inertia: [1, 1, 1]}}
joints: {main: {type: hinge, nodes: [ground, bob], position: [0, 0, 0], axis: [0, 1, 0], stiffness: 20}}
analysis: [{type: static, steps: 4}, {type: eigen, count: 1}]
""")
        subprocess.run([os.path.join(PROGRAMS, "bielle-mechanism"), "swing.yaml", "--quiet"], cwd=self.folder, check=True, timeout=60)
        for number in (None, 2):
            with Results(self.path("swing.h5"), number) as results:
                scenery = ModeScenery(Modes(results))
                self.assertEqual((scenery.base is not None, scenery.row), (True, 3), number)
                scenery.base.file.close()


class OfThePrograms(Tools):
    @classmethod
    def setUpClass(cls):
        cls.made = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.made.cleanup)
        for name, text in (("bar.yaml", BODY), ("model.yaml", MODEL), ("modes.yaml", MODEL.replace("  - {type: assembly}\n", ""))):
            with open(os.path.join(cls.made.name, name), "w", encoding="utf-8") as file:
                file.write(text)
            program = "bielle-reduce" if name == "bar.yaml" else "bielle-mechanism"
            subprocess.run([os.path.join(PROGRAMS, program), name, "--quiet"], cwd=cls.made.name, check=True, timeout=120)

    def setUp(self):
        super().setUp()
        self.folder = self.made.name

    def test_bodies_and_beams_move_with_their_nodes(self):
        with Results(self.path("model.h5")) as results:
            modes = Modes(results)
            scenery = ModeScenery(modes)
            self.addCleanup(scenery.close)
            self.assertEqual(scenery.beams, {"mast": ["foot", "mast.1", "mast.2", "mast.3", "head"]})
            self.assertEqual(scenery.nodes, ["foot", "end", "head"])
            body = superelement_of(scenery.base, "bar", {})
            end = modes.nodes.index("end")
            ends = {"root": np.flatnonzero(np.abs(body.points[:, 0]) < 1e-9), "tip": np.flatnonzero(np.abs(body.points[:, 0] - 1) < 1e-9)}
            R = rotation_matrices(scenery.bodies["bar"][0][3:])
            np.testing.assert_allclose(R @ [1, 0, 0], [0, 1, 0], atol=1e-12)
            bending = 0
            for number in range(1, len(modes) + 1):
                motion = ModeMotion(scenery, number, pictures=5)
                largest = 0
                for row, factor in enumerate(motion.factor):
                    positions, _ = body.at(motion.rows("elements/bar/frame", row), motion.rows("elements/bar/coordinates", row))
                    drawn = [0.1, 0.2, 0.3] + body.points @ R.T
                    np.testing.assert_allclose(positions[ends["root"]], drawn[ends["root"]], atol=1e-9)
                    u, turn = (np.real(factor * each[number - 1, end]) for each in (modes.displacement, modes.rotation))
                    arm = drawn[ends["tip"]] - modes.position[end]
                    np.testing.assert_allclose(positions[ends["tip"]] - drawn[ends["tip"]], u + np.cross(turn, arm), atol=1e-9)
                    largest = max(largest, np.abs(positions - drawn).max())
                    mast = motion.rows("elements/mast/position", row)
                    np.testing.assert_allclose(mast[-1], motion.rows("nodes/head/position", row), atol=0)
                bending += largest > 0.05
                size = np.linalg.norm(np.ptp(modes.position, axis=0))
                everywhere = [motion.rows(f"nodes/{name}/position") - motion.modes.position[scenery.index[name]] for name in scenery.nodes]
                self.assertLessEqual(max(largest, np.abs(everywhere).max()), 0.1 * size * (1 + 1e-9))
            self.assertGreaterEqual(bending, 2)

    def test_the_pieces_of_a_body_hold_together(self):
        with open(os.path.join(REPOSITORY, "meshes", "bar_in_pieces.yaml"), encoding="utf-8") as file:
            self.write("pieces.yaml", file.read().replace("bar.geo", os.path.join(REPOSITORY, "meshes", "bar.geo")))
        self.write("blade.yaml", "mechanism: a blade\nnodes: {hub: {fixed: true}}\nelements:\n  blade: {type: superelement, file: pieces.h5, "
                                 "nodes: {root: hub}}\nanalysis:\n  - {type: assembly}\n  - {type: eigen, count: 6}\n")
        for program, file in (("bielle-reduce", "pieces.yaml"), ("bielle-mechanism", "blade.yaml")):
            subprocess.run([os.path.join(PROGRAMS, program), file, "--quiet"], cwd=self.folder, check=True, timeout=120)
        with Results(self.path("blade.h5")) as results:
            scenery = ModeScenery(Modes(results))
            self.addCleanup(scenery.close)
            bodies = {name: superelement_of(scenery.base, name, {}) for name in scenery.bodies}
            self.assertEqual(list(bodies), ["blade.1", "blade.2", "blade.3", "blade.4"])
            for number in range(1, 7):
                motion = ModeMotion(scenery, number, pictures=4)
                drawn = [(body.points, body.at(motion.rows(f"elements/{name}/frame", 0), motion.rows(f"elements/{name}/coordinates", 0))[0])
                         for name, body in bodies.items()]
                for (meshed, moved), (neighbours, with_it) in zip(drawn, drawn[1:]):
                    here, there = np.nonzero(np.linalg.norm(meshed[:, None] - neighbours[None], axis=2) < 1e-9)
                    self.assertGreater(len(here), 20)
                    np.testing.assert_allclose(moved[here], with_it[there], rtol=0, atol=1e-12)
                self.assertGreater(np.abs(drawn[-1][1] - drawn[-1][0]).max(), 0.01)

    def test_animations_and_paraview(self):
        self.assertEqual(self.succeed("bielle-animate", "model.h5", "--mode", "3", "--size", "320x240").strip(), "model_mode_3.gif")
        with Image.open(self.path("model_mode_3.gif")) as picture:
            self.assertEqual(picture.n_frames, 24)
        self.succeed("bielle-animate", "model.h5", "--mode", "3", "-o", "sheet.png", "--amplitude", "0.2", "--size", "320x240")
        said = self.succeed("bielle-paraview", "model.h5", "--mode", "3", "--frames", "8", "--volume")
        self.assertIn("array 'node': 0 foot, 1 end, 2 head", said)
        parts = {}
        for entry in ElementTree.parse(self.path("model_mode_3.pvd")).getroot().iter("DataSet"):
            parts.setdefault(entry.get("name"), []).append((float(entry.get("timestep")), meshio.read(self.path(entry.get("file")))))
        self.assertEqual({name: len(each) for name, each in parts.items()}, {"bar": 8, "rigid": 8, "beams": 8, "nodes": 8})
        with h5py.File(self.path("model.h5")) as file:
            omega = abs(file["eigen/eigenvalue"][2, 1])
        np.testing.assert_allclose([time for time, _ in parts["bar"]], 2 * np.pi / omega * np.arange(8) / 8, rtol=1e-8)
        # Half a period later every displacement has the opposite sign.
        for (_, mesh), (_, other) in zip(parts["bar"][:4], parts["bar"][4:]):
            np.testing.assert_allclose(mesh.point_data["displacement"], -other.point_data["displacement"], atol=1e-9)

    def test_plots(self):
        written = self.succeed("bielle-plot", "model.h5", "-o", "plots", "--analysis", "2").split()
        self.assertEqual(written, ["plots/eigenfrequencies.png", "plots/eigenvalues.png", "plots/mode_shapes.png"])
        where = ["--superelement", "bar=" + os.path.join(self.folder, "bar.h5"), "--analysis", "2"]
        self.assertEqual(self.succeed("bielle-plot", "model.h5", "-o", "plots", *where).split(), written)
        self.refuse("there is no superelement 'bra' in the results; did you mean 'bar'?", "bielle-plot", "model.h5", "--superelement", "bra=bar.h5")

    def test_without_rows_bodies_are_left_out_and_that_is_told(self):
        done = self.run_tool("bielle-animate", "modes.h5", "--mode", "1", "-o", "m.png")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stderr.splitlines(), ["note: bodies are left out: no analysis of the file has rows of this state; list "
                                                    "{type: assembly} before 'eigen'"])
        with Results(self.path("modes.h5")) as results:
            self.assertEqual(list(ModeScenery(Modes(results)).beams), ["mast"])

    def test_rows_of_another_state_are_not_taken(self):
        with open(self.path("model.yaml"), encoding="utf-8") as file:
            text = file.read()
        self.write("other.yaml", text.replace("  - {type: eigen", "  - {type: static, steps: 1}\n  - {type: eigen").replace(
            "analysis:", "gravity: [0, 0, -9810]\nanalysis:"))
        subprocess.run([os.path.join(PROGRAMS, "bielle-mechanism"), "other.yaml", "--quiet"], cwd=self.folder, check=True, timeout=120)
        with Results(self.path("other.h5")) as results:
            scenery = ModeScenery(Modes(results))
            self.addCleanup(scenery.close)
            self.assertEqual(scenery.base.text("/", "type") or scenery.base.root.attrs["type"], "static")
            with h5py.File(self.path("other.h5")) as file:
                np.testing.assert_allclose(file["analysis_2/nodes/end/position"][-1], file["eigen/position"][2], atol=1e-12)
                self.assertGreater(np.abs(file["analysis_1/nodes/end/position"][-1] - file["eigen/position"][2]).max(), 1e-3)


if __name__ == "__main__":
    unittest.main()
