"""Tests of superelements without a surface, such as those of matrices without cells: lines connect their interfaces,
and the reason is reported."""

import os
import subprocess
import sys
import unittest

import h5py
import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.dirname(HERE))

from in_folder import REPOSITORY, InFolder  # noqa: E402
from python_tool import TOOLS, import_tools, prepare_figures, run_python_tool  # noqa: E402

sys.path[:0] = [os.path.join(REPOSITORY, "tools"), HERE]

from bielle_tools.bodies.superelement_body import NoSurface, SuperelementBody  # noqa: E402
from bielle_tools.results import Results  # noqa: E402
from bielle_tools.results.rotations import rotation_matrices  # noqa: E402
from bielle_tools.scene import make_scene  # noqa: E402
from bielle_tools.scene.flexible import surface_points  # noqa: E402
from bielle_tools.scene.interface_lines import interface_lines, shortest_tree  # noqa: E402
from bielle_tools.view.page import build_page  # noqa: E402
from page_driver import WHY_NOT, Pages  # noqa: E402

PROGRAMS = os.environ["BIELLE_PROGRAMS"]
NODES = np.array([[0.25 * k, 0.0, 0.0] for k in range(5)])  # nodes of the rod [m]
MODEL = """mechanism: swing
gravity: [0, 0, -9.81]
nodes: {{a: {{position: [0, 0, 0]}}}}
elements: {{rod: {{type: superelement, file: rod.h5, nodes: {{hub: a}}}}}}
joints: {{pin: {{type: hinge, nodes: [ground, a], axis: [0, 1, 0], start_rate: 3}}}}
analysis:
  - {{type: dynamic, duration: 0.2, step: 0.01}}
  - {{type: eigen, count: 2}}
"""
REASON = "has no surface, since its matrices have no cells"


def rod():
    """Returns K and M of nodes with springs between neighbours; rigid motions cause no force."""
    K, M = np.zeros((30, 30)), np.diag(np.tile([0.4] * 3 + [1e-3] * 3, 5))
    for k in range(4):
        carried = np.eye(6)  # motion of the second node as a rigid continuation of the first
        carried[:3, 3:] = -np.cross(NODES[k + 1] - NODES[k], np.eye(3)).T
        strain = np.hstack([-carried, np.eye(6)])
        K[6 * k:6 * k + 12, 6 * k:6 * k + 12] += strain.T @ np.diag([1e6, 1e5, 1e5, 1e2, 1e2, 1e2]) @ strain
    return K, M


class Interfaces(InFolder):
    runs = {}  # files of rods by their interfaces, each of which is computed once and copied for the test

    def program(self, name, *arguments):
        done = subprocess.run([os.path.join(PROGRAMS, name), *arguments], cwd=self.folder, capture_output=True, text=True, timeout=240)
        self.assertEqual(done.returncode, 0, done.stderr)

    def run_rod(self, interfaces="{hub: {node: 1}, middle: {node: 3}, end: {node: 5, axes: {x: [0, 0, 1], y: [0, 1, 0]}}}"):
        """@returns the path of results of a swinging rod of matrices"""
        if interfaces not in self.runs:
            self.compute_rod(interfaces)
            self.runs[interfaces] = {name: self.read(name) for name in ("rod.h5", "swing.h5")}
        for name, data in self.runs[interfaces].items():
            with open(self.path(name), "wb") as file:
                file.write(data)
        return self.path("swing.h5")

    def read(self, name):
        with open(self.path(name), "rb") as file:
            return file.read()

    def compute_rod(self, interfaces):
        K, M = rod()
        np.savez(self.path("rod.npz"), K=K, M=M, positions=NODES, unknown_nodes=np.repeat(np.arange(1, 6), 6), unknown_components=np.tile(np.arange(6), 5))
        self.write("rod.yaml", f"body: rod\nmatrices: rod.npz\ninterfaces: {interfaces}\nmodes: {{count: 2}}\n")
        self.program("bielle-reduce", "rod.yaml", "-o", "rod.h5")
        self.write("swing.yaml", MODEL.format())
        self.program("bielle-mechanism", "swing.yaml", "--quiet")

    def scene(self, path, analysis=1):
        results = Results(path, analysis)
        self.addCleanup(results.file.close)
        return make_scene(results)

    def tool(self, name, *arguments, status=0):
        done = run_python_tool(os.path.join(TOOLS, name), list(arguments), folder=self.folder)
        self.assertEqual(done.returncode, status, done.stderr)
        return done.stderr


class Lines(Interfaces):
    def test_balls_are_on_the_nodes_of_the_interfaces(self):
        scene = self.scene(self.run_rod())
        part, = scene.flexible
        points = surface_points(part, scene.rows)
        balls = len(interface_lines(np.zeros((1, 3)), np.zeros((1, 3, 0)), 1.0)[0])
        moved = 0.0
        for k, node in enumerate(("a", "rod.middle", "rod.end")):
            expected = scene.results.rows(f"nodes/{node}/position")
            drawn = points[:, k * balls:(k + 1) * balls]
            np.testing.assert_allclose((drawn.min(axis=1) + drawn.max(axis=1)) / 2, expected, rtol=0, atol=1e-3 * scene.symbol)
            rigid = part.frame(scene.rows)[:, :3] + rotation_matrices(part.frame(scene.rows)[:, 3:]) @ NODES[2 * k]
            moved = max(moved, np.abs(rigid - expected).max())
        self.assertGreater(moved, 1e-3, "the rod bends: its frame alone does not carry the balls")
        self.assertEqual(scene.notes, [])

    def test_rods_end_on_the_balls_while_the_body_deforms(self):
        """The interfaces are on a line at 0, 1, 3 m; the coordinate moves the last one by 1 m along y."""
        positions, displacements = np.array([[0.0, 0, 0], [3, 0, 0], [1, 0, 0]]), np.zeros((3, 3, 1))
        displacements[1, 1, 0] = 1
        points, triangles, shapes = interface_lines(positions, displacements, 0.1)
        balls = len(interface_lines(np.zeros((1, 3)), np.zeros((1, 3, 0)), 0.1)[0])
        rods = points[3 * balls:]
        self.assertEqual((rods[:, 0].min(), rods[:, 0].max()), (0, 3))
        np.testing.assert_allclose(shapes[0, 3 * balls:, 1], np.clip((rods[:, 0] - 1) / 2, 0, 1), atol=1e-12)
        np.testing.assert_array_equal(shapes[0, balls:2 * balls, 1], 1)
        self.assertEqual(np.abs(shapes[0][:, [0, 2]]).max(), 0)
        self.assertLess(triangles.max(), len(points))

    def test_one_interface_is_joined_with_the_centre_of_mass(self):
        scene = self.scene(self.run_rod("{hub: {node: 1}}"))
        part, = scene.flexible
        self.assertAlmostEqual(part.body.points[:, 0].max(), 0.5, delta=scene.symbol)
        self.assertGreater(part.body.points[:, 0].max(), 0.5)

    def test_the_tree_is_shortest_and_joins_all(self):
        from scipy.sparse.csgraph import connected_components, minimum_spanning_tree
        from scipy.spatial.distance import cdist
        rng = np.random.default_rng(3)
        for count in (1, 2, 3, 10, 40):
            points = rng.normal(size=(count, 3))
            pairs = shortest_tree(points)
            self.assertEqual(len(pairs), count - 1)
            length = sum(np.linalg.norm(points[a] - points[b]) for a, b in pairs)
            self.assertAlmostEqual(length, minimum_spanning_tree(cdist(points, points)).sum(), delta=1e-9)
        graph = np.zeros((4, 4))
        for a, b in shortest_tree(np.array([[0.0, 0, 0], [1, 0, 0], [0, 0, 0], [1, 0, 0]])):  # some coincide
            graph[a, b] = 1
        self.assertEqual(connected_components(graph, directed=False)[0], 1)


@unittest.skipIf(WHY_NOT, WHY_NOT)
class InTheBrowser(Interfaces, Pages):
    def test_lines_are_drawn_and_picked(self):
        text, _ = build_page([self.run_rod()])
        self.open(self.write("page.html", text))
        notes = self.run_script("return Array.from(document.getElementById('notes').children, e => e.textContent)")
        self.assertEqual(len(notes), 1)
        self.assertRegex(notes[0], f"^drawn as lines between its interfaces: elements/rod: .*{REASON}")
        full = self.drawn()
        self.run_script("""bielle.entries.toggle('elements/rod', 'isolated'); bielle.render();
            const c = document.getElementById("scene"), r = c.getBoundingClientRect(), [x, y] = bielle.camera.pixels(bielle.shown.anchor('elements/rod'));
            const o = {clientX: r.left + x, clientY: r.top + y, pointerId: 1, button: 0, bubbles: true};
            c.setPointerCapture = () => {}; c.dispatchEvent(new PointerEvent("pointerdown", o)); c.dispatchEvent(new PointerEvent("pointerup", o));""")
        self.assertEqual(self.run_script("return document.querySelector('#details h2').textContent"), "elements/rod")
        self.assertNotIn("mesh node", self.run_script("return document.getElementById('details').textContent"))
        self.assertGreater(self.drawn(), 0.3 * full)
        self.run_script("bielle.entries.toggle('elements/rod', 'isolated'); bielle.entries.toggle('elements/rod', 'hidden')")
        self.assertLess(self.drawn(), 0.7 * full)
        self.no_errors()


class Reasons(Interfaces):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        import_tools("figures", "pictures")
        prepare_figures()

    def test_the_page_tells_that_there_is_no_surface(self):
        path = self.run_rod()
        text, report = build_page([path])
        said = [line for line in report.lines() if "rod" in line and "drawn" in line]
        self.assertEqual(len(said), 1)
        self.assertIn("drawn as lines between its interfaces: elements/rod: ", said[0])
        self.assertIn(f"rod.h5' {REASON}", said[0])
        self.assertEqual(report.notes, [])

    def test_tools_draw_and_tell_once(self):
        path = self.run_rod()
        for arguments in (("bielle-animate", path, "--analysis", "1", "--frames", "2", "-o", "a.png"), ("bielle-plot", path)):
            said = self.tool(*arguments)
            self.assertEqual(said.count(f"'elements/rod' is drawn as lines between its interfaces: '{self.path('rod.h5')}' {REASON}"), 1, arguments[0])
            self.assertNotIn("damaged", said)
        self.tool("bielle-paraview", path, "--analysis", "1")
        self.assertIn("reduced from matrices", self.tool("bielle-loads", path, "rod", "--analysis", "1", "--time", "0.1", status=1))

    def changed(self, change):
        """Returns the notes, and the bodies drawn by lines, of a scene whose superelement file was changed."""
        path = self.run_rod()
        with h5py.File(self.path("rod.h5"), "r+") as file:
            change(file)
        with Results(path, 1) as results:
            scene = make_scene(results)
        return [reason for _, reason in scene.notes], [reason for _, reason in scene.by_lines]

    def test_a_file_without_recovery_has_lines(self):
        def change(file):
            del file["recovery"]
        notes, lines = self.changed(change)
        self.assertEqual((notes, len(lines)), ([], 1))
        self.assertIn("keeps no mesh or no displacements", lines[0])

    def test_a_file_without_interfaces_is_not_drawn(self):
        def change(file):
            del file["interface"]
        notes, lines = self.changed(change)
        self.assertEqual((len(notes), lines), (1, []))
        self.assertIn(REASON, notes[0])

    def test_another_superelement_is_not_drawn(self):
        def change(file):
            del file["reduced/stiffness"], file["recovery"]
            file["reduced/stiffness"] = np.eye(19)
        notes, lines = self.changed(change)
        self.assertEqual((len(notes), lines), (1, []))
        self.assertIn("Was it reduced again after the run?", notes[0])

    def test_a_damaged_mesh_is_still_told(self):
        for change in (lambda file: file.create_group("mesh/cells"), lambda file: file["mesh/points"].write_direct(np.full((5, 3), np.nan))):
            notes, lines = self.changed(change)
            self.assertEqual(lines, [])
            self.assertIn("'mesh' cannot be read: it is damaged", notes[0])

    def test_the_body_has_nodes_without_a_surface(self):
        self.run_rod()
        body = SuperelementBody(self.path("rod.h5"))
        np.testing.assert_allclose(body.points, NODES)
        with self.assertRaisesRegex(NoSurface, REASON):
            body.surface()


if __name__ == "__main__":
    unittest.main()
