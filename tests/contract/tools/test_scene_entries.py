"""Tests of entries of a scene: released ones are not drawn, couplings have symbols, and bodies have arms to the nodes
that they carry."""

import contextlib
import os
import subprocess
import sys
import unittest

import h5py
import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.dirname(HERE))

from in_folder import REPOSITORY, InFolder  # noqa: E402

sys.path[:0] = [os.path.join(REPOSITORY, "tools"), HERE]

from bielle_tools.results import Results  # noqa: E402
from bielle_tools.results.activity import Activity  # noqa: E402
from bielle_tools.results.modes import ModeMotion, Modes, ModeScenery  # noqa: E402
from bielle_tools.scene import make_scene  # noqa: E402
from bielle_tools.scene.marks import marks_of  # noqa: E402
from bielle_tools.scene.transforms import placed  # noqa: E402
from drawn_results import resting, turning, write_results  # noqa: E402

PROGRAM = os.path.join(os.environ["BIELLE_PROGRAMS"], "bielle-mechanism")
MODEL = """mechanism: shafts
nodes: {a: {position: [0, 0, 0]}, b: {position: [0.3, 0, 0]}, c: {position: [0.6, 0, 0]}, s: {position: [0.6, 0.3, 0]}}
elements:
  a: {type: rigid_body, node: a, mass: 1, inertia: [0.1, 0.1, 0.1]}
  b: {type: rigid_body, node: b, mass: 1, inertia: [0.1, 0.1, 0.1]}
  c: {type: rigid_body, node: c, mass: 1, inertia: [0.1, 0.1, 0.1]}
  s: {type: rigid_body, node: s, mass: 1, inertia: [0.1, 0.1, 0.1]}
  spring: {type: spring_damper, nodes: [a, c], stiffness: 1, active: false}
joints:
  ja: {type: hinge, nodes: [ground, a], axis: [0, 0, 1], start_rate: 1}
  jb: {type: hinge, nodes: [ground, b], axis: [0, 0, 1]}
  jc: {type: hinge, nodes: [ground, c], axis: [0, 0, 1]}
  slide: {type: prismatic, nodes: [ground, s], axis: [1, 0, 0]}
  pair: {type: gear, joints: [ja, jb.angle], ratio: -2}
  axle: {type: differential, joints: [jb, {joint: ja, coordinate: angle}, jc]}
  rack: {type: rack_and_pinion, joints: [jc, slide], radius: 0.05}
  rope: {type: distance, nodes: [a, c], active: true}
  never: {type: distance, nodes: [a, b], active: false}
events:
  loose: {when: t, crosses: 0.105, do: [{release: rope}, {activate: spring}]}
  calm: {when: t, crosses: 0.155, do: [{release: spring}, {release: pair}]}
analysis:
  - {type: dynamic, duration: 0.2, step: 0.01}
  - {type: dynamic, duration: 0.05, step: 0.01}
"""


class Entries(InFolder):
    def scene(self, path, analysis=None):
        results = Results(path, analysis)
        self.addCleanup(results.file.close)
        return make_scene(results)

    def written(self, nodes, items, **options):
        """Returns the path of a new results file."""
        return write_results(self.path(f"run_{len(os.listdir(self.folder))}.h5"), nodes, items, **options)

    def shown(self, scene, entry):
        """Returns for each row whether the parts of the entry have finite poses, which must be equal for all parts."""
        poses = [np.isfinite(scene.poses(part, scene.rows)).all(axis=(1, 2)) for part in scene.parts if part.entry == entry]
        self.assertTrue(poses, f"'{entry}' is not drawn")
        for each in poses[1:]:
            np.testing.assert_array_equal(each, poses[0])
        return poses[0]


class Released(Entries):
    def run_model(self, *options):
        self.write("model.yaml", MODEL)
        done = subprocess.run([PROGRAM, "model.yaml", *options, "--quiet"], cwd=self.folder, capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr)
        return self.path("model.h5")

    def test_an_entry_is_drawn_while_it_acts(self):
        path = self.run_model()
        first, last = self.scene(path, 1), self.scene(path, 2)
        time = first.results.time
        self.assertGreater(np.count_nonzero(time < 0.1), 5)
        for entry, expected in (("joints/rope", time < 0.105), ("elements/spring", (time >= 0.105) & (time < 0.155)), ("joints/never", time < 0),
                                ("joints/pair", time < 0.155), ("joints/axle", time >= 0), ("elements/a", time >= 0)):
            with self.subTest(entry):
                np.testing.assert_array_equal(self.shown(first, entry), expected)
        for entry, expected in (("joints/rope", False), ("elements/spring", False), ("joints/never", False), ("joints/pair", False), ("joints/axle", True)):
            with self.subTest(entry + " in the next analysis"):
                self.assertTrue((self.shown(last, entry) == expected).all())
        self.assertEqual([first.notes, last.notes], [[], []])

    def test_an_analysis_knows_what_is_released_at_its_start(self):
        """Earlier events are missing, as in the file of a session that continues another one."""
        path = self.run_model()
        with h5py.File(path, "r+") as file:
            self.assertEqual(file["analysis_1"].attrs["released"].splitlines(), ["elements/spring", "joints/never"])
            self.assertEqual(sorted(file["analysis_2"].attrs["released"].splitlines()),
                             ["elements/spring", "joints/never", "joints/pair", "joints/rope"])
            del file["analysis_1/events"]
        last = self.scene(path, 2)
        for entry, expected in (("joints/rope", False), ("elements/spring", False), ("joints/never", False), ("joints/pair", False), ("joints/axle", True)):
            with self.subTest(entry):
                self.assertTrue((self.shown(last, entry) == expected).all())

    def test_both_layouts_agree(self):
        self.write("model.yaml", MODEL)
        path = self.run_model()
        plain = Activity(self.scene(path, 1).results).acts("joints/rope")
        self.write("model.yaml", MODEL + "output: {layout: stacked}\n")
        done = subprocess.run([PROGRAM, "model.yaml", "--quiet", "-o", "stacked.h5"], cwd=self.folder, capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr)
        np.testing.assert_array_equal(Activity(self.scene(self.path("stacked.h5"), 1).results).acts("joints/rope"), plain)

    def test_a_released_part_does_not_change_the_bounds(self):
        """The rope spans 10 m and is released before the rows."""
        items = [{"entry": "elements/box", "type": "rigid_body", "shape": "box", "node": "n", "size": [1, 1, 1]},
                 {"entry": "joints/rope", "type": "distance", "shape": "bar", "ends": [{"node": "n"}, {"node": "ground", "position": [10, 0, 0]}]}]
        for text, reach in (("", 10), ("joints: {rope: {active: false}}", 0.5), ("joints: {rope: {active: true}}", 10), ("joints: {other: {active: false}}", 10),
                            ("{ damaged", 10), ("joints: [1, 2]", 10)):
            def extra(file, text=text):
                file["input"] = text
            scene = self.scene(self.written({"n": resting(3)}, items, extra=extra))
            self.assertAlmostEqual(scene.high[0], reach, delta=0.1, msg=text)

    def test_damaged_events_leave_everything_drawn(self):
        items = [{"entry": "joints/rope", "type": "distance", "shape": "bar", "ends": [{"node": "n"}, {"node": "ground", "position": [1, 0, 0]}]}]
        for crossing, time in (([7], [0.0]), ([-1], [0.0]), ([0], []), ("text", "text")):
            def extra(file, crossing=crossing, time=time):
                file["crossings"] = "event 'e': releases 'rope'\n"
                file["analysis_1/events/time"], file["analysis_1/events/crossing"] = time, crossing
            scene = self.scene(self.written({"n": resting(3)}, items, extra=extra))
            self.assertTrue(self.shown(scene, "joints/rope").all(), crossing)


class Racks(Entries):
    def test_a_rack_lies_on_the_pitch_circle_of_its_pinion_and_slides(self):
        """The pinion of 50 mm rotates about z at (0.6, 0, 0), and the rack slides along x on the side of y."""
        self.write("model.yaml", MODEL)
        done = subprocess.run([PROGRAM, "model.yaml", "--quiet"], cwd=self.folder, capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr)
        scene = self.scene(self.path("model.h5"), 1)
        *_, bar = [part for part in scene.parts if part.entry == "joints/rack"]
        self.assertEqual(len([part for part in scene.parts if part.entry == "joints/rack"]), 3)  # the wheel, its mark, and the bar
        points = placed(scene.poses(bar, scene.rows)[:, bar.mesh.bones], bar.mesh.points)
        low, high = points.min(axis=1), points.max(axis=1)
        np.testing.assert_allclose([low[0], high[0]], [[0.5, 0.05 * 0.9375, -0.0075], [0.7, 0.05 * 1.3, 0.0075]], atol=1e-12)
        x = scene.results.rows("nodes/s/position")[:, 0]
        self.assertGreater(np.ptp(x), 0.005)
        np.testing.assert_allclose(low[:, 0] - low[0, 0], x - x[0], atol=1e-12)

    def test_a_rack_along_its_pinion_is_left_out(self):
        def extra(file):
            file["input"] = "joints: {rack: {type: rack_and_pinion, joints: [j, s], radius: 1}}"
        items = [{"entry": "joints/rack", "type": "rack_and_pinion", "shape": "gear", "node": "n", "radius": 1}]
        items += [{"entry": f"joints/{name}", "type": kind, "shape": "joint", "frames": [{"node": "ground"}, {"node": "n"}]} for name, kind in (("j", "hinge"), ("s", "prismatic"))]
        scene = self.scene(self.written({"n": resting(3)}, items, extra=extra))
        self.assertEqual(scene.notes, [("joints/rack", "the rack would slide along the axis of its pinion")])


class Marks(Entries):
    """The frames of a hinge meet only while it is active, so that no gap is drawn after its release."""
    DROPPED = """mechanism: dropped
gravity: [0, 0, -9.81]
nodes: {a: {position: [0, 0, 0]}, b: {position: [1, 0, 0]}}
elements:
  a: {type: rigid_body, node: a, mass: 1, inertia: [0.1, 0.1, 0.1]}
  b: {type: rigid_body, node: b, mass: 1, inertia: [0.1, 0.1, 0.1]}
  spring: {type: spring_damper, nodes: [ground, b], at: [[1, 0, 1], [0, 0, 0]], stiffness: 100, length: 0.9}
joints:
  pivot: {type: hinge, nodes: [ground, a], axis: [0, 1, 0], start_rate: 1}
  rail: {type: prismatic, nodes: [ground, b], axis: [0, 0, 1]}
events:
  loose: {when: t, crosses: 0.105, do: [{release: pivot}]}
analysis:
  - {type: dynamic, duration: 0.2, step: 0.01}
  - {type: dynamic, duration: 0.05, step: 0.01}
  - {type: eigen, count: 1}
"""

    def run_model(self, text):
        self.write("dropped.yaml", text)
        done = subprocess.run([PROGRAM, "dropped.yaml", "--quiet"], cwd=self.folder, capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr)
        return self.path("dropped.h5")

    def test_a_released_hinge_has_no_gap(self):
        path = self.run_model(self.DROPPED)
        for analysis in (1, 2):
            scene = self.scene(path, analysis)
            apart = np.linalg.norm(scene.results.rows("nodes/a/position")[-1])
            self.assertGreater(apart, 0.03)
            self.assertEqual(marks_of(scene, scene.rows), {}, analysis)

    def test_a_mode_about_a_state_without_the_hinge_has_neither_its_symbol_nor_a_gap(self):
        for text, drawn in ((self.DROPPED, False), (self.DROPPED.replace("crosses: 0.105", "crosses: 9"), True)):
            path = self.run_model(text)
            with Results(path) as results:
                with contextlib.closing(ModeScenery(Modes(results))) as scenery:
                    scene = make_scene(ModeMotion(scenery, 1))
                    self.assertTrue((self.shown(scene, "joints/pivot") == drawn).all(), text)
                    self.assertTrue(self.shown(scene, "joints/rail").all())
                    self.assertNotIn("joints/pivot", marks_of(scene, scene.rows[-1:]))

    def test_a_gap_counts_while_the_joint_acts(self):
        """Writes a hinge whose frames have the distances 0.1, 0.2, 0.4, 0.3 m at 0, 0.01, 0.02, 0.03 s."""
        frames = [{"node": "ground"}, {"node": "n"}]
        items = [{"entry": "joints/pin", "type": "hinge", "shape": "joint", "frames": frames},
                 {"entry": "elements/box", "type": "rigid_body", "shape": "box", "node": "n", "size": [1, 1, 1]}]
        tilted = turning(4, [1, 0, 0])
        for crossings, start, gap, row in (([], "", 0.4, 3), ([(0.015, "releases")], "", 0.2, 1), ([(0.025, "activates")], "{pin: {active: false}}", 0.3, 3),
                                           ([(0.015, "releases"), (0.025, "activates")], "", 0.3, 3), ([], "{pin: {active: false}}", None, None),
                                           ([(0.0, "releases")], "", None, None)):
            def extra(file, crossings=crossings, start=start):
                file["input"] = f"joints: {start}" if start else ""
                file["crossings"] = "".join(f"event 'e': {action} 'pin'\n" for _, action in crossings)
                file["analysis_1/events/time"], file["analysis_1/events/crossing"] = [time for time, _ in crossings], np.arange(len(crossings))
            path = self.written({"n": (np.outer([0.1, 0.2, 0.4, 0.3], [0, 1, 0]), tilted)}, items, extra=extra)
            scene = self.scene(path)
            marks = marks_of(scene, scene.rows)
            with self.subTest(crossings=crossings, start=start):
                self.assertEqual(set(marks), {"joints/pin"} if gap else set())
                if gap:
                    self.assertAlmostEqual(marks["joints/pin"]["gap"], gap, delta=1e-12)
                    self.assertAlmostEqual(marks["joints/pin"]["tilt"], 0.1 * row, delta=1e-9)


class Couplings(Entries):
    def items(self):
        return [{"entry": f"joints/{name}", "type": kind, "shape": "joint", "frames": [{"node": "ground", "position": [x, 0, 0]}, {"node": name}]}
                for name, kind, x in (("a", "hinge", 0), ("b", "hinge", 2), ("c", "prismatic", 4))]

    def coupled(self, text, items=None):
        nodes = {name: (np.tile([float(x), 0, 0], (5, 1)), turning(5, [0, 0, 1])) for name, x in (("a", 0), ("b", 2), ("c", 4))}

        def extra(file):
            file["input"] = text
        return self.scene(self.written(nodes, items or self.items(), extra=extra))

    def test_each_coordinate_has_a_symbol_that_moves_with_the_second_node(self):
        scene = self.coupled("joints: {pair: {type: gear, joints: [a, b.angle]}, rack: {type: rack_and_pinion, joints: [{joint: b}, c]}}")
        for entry, places in (("joints/pair", (0, 2)), ("joints/rack", (2, 4))):
            parts = [part for part in scene.parts if part.entry == entry]
            self.assertEqual(len(parts), 3)  # two symbols, and the line between them
            for part, x in zip(parts, places):
                poses = scene.poses(part, scene.rows)
                np.testing.assert_allclose(poses[:, 0, :3], [[x, 0, 0]] * 5, atol=1e-12)
                points = placed(poses[:, part.mesh.bones], part.mesh.points)
                # It rotates by 0.4 rad.
                self.assertGreater(np.linalg.norm(points[4] - points[0], axis=1).max(), 0.3 * scene.symbol)
        levels = [part.mesh.points[:, 2].mean() for part in scene.parts if part.entry in ("joints/pair", "joints/rack") and abs(scene.poses(part, [0])[0, 0, 0] - 2) < 1e-9
                  and part.mesh.bone_count == 1 and part.mesh.points[:, 2].max() < 5 * scene.symbol]
        self.assertGreater(np.ptp(levels), 0.3 * scene.symbol, "two symbols on one joint do not coincide")

    def test_all_couplings_of_a_run_are_drawn_once(self):
        drawn = self.items() + [{"entry": "joints/pair", "type": "gear", "shape": "gear", "node": "a", "radius": 0.5}]
        scene = self.coupled("joints: {pair: {type: gear, joints: [a, b]}, cam: {type: cam, joints: [a, c], lift: lift.csv}}", drawn)
        self.assertEqual(len([part for part in scene.parts if part.entry == "joints/pair"]), 2, "the wheel and its mark alone")
        self.assertEqual(len([part for part in scene.parts if part.entry == "joints/cam"]), 3)

    def test_unknown_joints_are_left_out(self):
        for text, parts in (("[a, zz]", 1), ("[zz, yy]", 0), ("[a*2, b]", 1), ("{a: 1}", 0), ("[[a], b]", 1), ("a", 0)):
            scene = self.coupled(f"joints: {{pair: {{type: gear, joints: {text}}}}}")
            self.assertEqual((len([part for part in scene.parts if part.entry == "joints/pair"]), scene.notes), (parts, []), text)


class Arms(Entries):
    def test_a_body_reaches_what_is_attached_apart_from_its_shape(self):
        items = [{"entry": "elements/bob", "type": "rigid_body", "shape": "sphere", "node": "n", "radius": 0.1},
                 {"entry": "joints/pivot", "type": "hinge", "shape": "joint", "frames": [{"node": "ground"}, {"node": "n", "position": [-1, 0, 0]}]}]
        for shape, far in (({"position": [0, 0, 0]}, True), ({"position": [-0.95, 0, 0]}, False)):
            items[0].update(shape)
            scene = self.scene(self.written({"n": resting(2, (1, 0, 0))}, items))
            parts = [part for part in scene.parts if part.entry == "elements/bob"]
            self.assertEqual(len(parts), 2 if far else 1, shape)
            if far:
                low, high = parts[1].mesh.points.min(axis=0), parts[1].mesh.points.max(axis=0)
                self.assertAlmostEqual(low[0], -1, delta=1e-9)
                self.assertTrue(-0.1 < high[0] < 0)
                self.assertLess(max(high[1:] - low[1:]), scene.symbol)

    def test_a_node_without_a_body_joins_what_is_attached(self):
        def joint(name, x):
            return {"entry": f"joints/{name}", "type": "hinge", "shape": "joint", "frames": [{"node": "ground", "position": [x, 0, 0]}, {"node": "n", "position": [x, 0, 0]}]}
        node = {"entry": "nodes/n", "type": "node", "shape": "node", "node": "n"}
        for joints, arms in (([joint("one", -1), joint("two", 1)], 1), ([joint("one", -1)], 0), ([joint("one", 0), joint("two", 0)], 0)):
            scene = self.scene(self.written({"n": resting(2)}, [node, *joints]))
            self.assertEqual(len([part for part in scene.parts if part.entry == "nodes/n"]), 1 + arms)

    def test_frames_of_an_elastic_joint_do_not_shrink_symbols(self):
        """The frames of the bearing have a distance of 1e-4 of the machine, so that the distance of the joints gives
        the size of symbols."""
        items = [{"entry": f"joints/{name}", "type": "bearing", "shape": "joint", "frames": [{"node": "ground", "position": [x, 0, 1e-4]}, {"node": "n", "position": [x, 0, 0]}]}
                 for name, x in (("left", 0), ("right", 1))]
        scene = self.scene(self.written({"n": resting(2)}, items))
        self.assertAlmostEqual(scene.symbol, 0.02, delta=1e-4)


if __name__ == "__main__":
    unittest.main()
