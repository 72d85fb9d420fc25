"""Tests of bielle-view: the page in a headless browser shows the results, for valid and for damaged files."""

import base64
import http.client
import json
import os
import re
import subprocess
import sys
import time
import unittest
import urllib.request
import zlib
from types import SimpleNamespace

import h5py
import numpy as np

import synthetic_results as synthetic
from box_mesh import REPOSITORY, InFolder
from drawn_results import STRESSES, every_shape, resting, stressed_beam, turning, write_check, write_results
from page_driver import WHY_NOT, Pages
sys.path.insert(0, os.path.join(REPOSITORY, "tests", "contract"))
from python_tool import import_tools, run_python_tool

from bielle_tools.bodies.stress_invariants import von_mises  # noqa: E402
from bielle_tools.bodies.superelement_body import SuperelementBody  # noqa: E402
from bielle_tools.results import Results  # noqa: E402
from bielle_tools.scene import make_scene  # noqa: E402
from bielle_tools.scene.stress_scale import stress_colours  # noqa: E402
from bielle_tools.scene.transforms import placed  # noqa: E402
from bielle_tools.view.body_data import BodyData  # noqa: E402

TOOL = os.path.join(REPOSITORY, "tools", "bielle-view")
PROGRAMS = os.environ.get("BIELLE_PROGRAMS", os.path.join(REPOSITORY, "build", "release", "bin"))
ARM = """mechanism: arm
gravity: [0, 0, -9.81]
nodes: {{root: {{position: [0, 0, 0]}}, tip: {{position: [1, 0, 0]}}}}
elements: {{arm: {{type: superelement, file: bar.h5, position: [0, 0, 0], nodes: {{root: root, tip: tip}}}}}}
joints: {{pin: {{type: hinge, nodes: [ground, root], axis: [0, 1, 0]}}}}
analysis: [{}]
"""


def setUpModule():
    import_tools()


def view(*arguments, **options):
    return run_python_tool(TOOL, [str(word) for word in arguments], **options)


class Command(InFolder):
    def test_files_without_rows_are_refused(self):
        path = write_results(self.path("empty.h5"), {"n": resting(0)}, [], times=np.zeros(0))
        done = view(path)
        self.assertEqual(done.returncode, 1)
        self.assertIn("holds no results yet", done.stderr + done.stdout)

    def test_wrong_options(self):
        path = write_results(self.path("run.h5"), {"n": resting(2)}, [])
        for words, said in ((["--frames", "0"], "from 1 on"), (["--port", "80"], "goes with --live"), (["-o", path], "would overwrite"), (["--analysis", "7"], "no analysis 7"),
                            (["--live", "-o", "x.html"], "writes no file")):
            done = view(path, *words)
            self.assertEqual((done.returncode, said in done.stderr), (1, True), done.stderr)

    def test_linear_analyses_alone_have_nothing_to_show(self):
        for group, says in (("campbell", ": bielle-plot draws its 'campbell'\n"), ("frequency_response", ": bielle-plot draws its 'frequency_response'\n"), ("state_space", "to show\n")):
            with h5py.File(self.path("linear.h5"), "w") as file:
                file.attrs.update({"format": "bielle results", "version": 1, "complete": 1})
                file[f"analysis_1/{group}/numbers"] = [1.0]
                file["analysis_1"].attrs["type"] = group
                file[group] = h5py.SoftLink(f"/analysis_1/{group}")
            done = view(self.path("linear.h5"))
            self.assertEqual((done.returncode, done.stderr.count("\n")), (1, 1), done.stderr)
            self.assertIn("holds no motion, state or shapes of modes to show", done.stderr)
            self.assertTrue(done.stderr.endswith(says), done.stderr)
            self.assertFalse(os.path.exists(self.path("linear.html")))

    def test_places_that_cannot_be_written(self):
        path = write_results(self.path("run.h5"), {"n": resting(2)}, [])
        for target, status, says in ((self.path("nowhere/x.html"), 1, "No such file or directory"), ("/dev/full", 2, "No space left on device"), (self.folder, 1, "Is a directory")):
            done = view(path, "-o", target)
            self.assertEqual((done.returncode, done.stderr.count("\n")), (status, 1), done.stderr)
            self.assertIn(says, done.stderr)

    @staticmethod
    def described(page):
        """Returns the data of a page."""
        packed = re.search(r'id="description">([^<]+)<', page).group(1)
        return json.loads(zlib.decompress(base64.b64decode(packed)))

    def test_the_page_names_the_program_of_each_run(self):
        programs = ["bielle-mechanism 0.1.0 (commit 0123456789ab)", "bielle-mechanism 0.2.0 (commit </script>)"]
        paths = [write_results(self.path(f"run{k}.h5"), {"n": resting(2)}, [], extra=lambda file, by=by: file.attrs.update(created_by=by))
                 for k, by in enumerate(programs)]
        self.assertEqual(view(*paths, "-o", self.path("page.html")).returncode, 0)
        with open(self.path("page.html"), encoding="utf-8") as file:
            found = self.described(file.read())["runs"]
        self.assertEqual([run["created_by"] for run in found], programs)

    def test_the_page_loads_nothing(self):
        path = write_results(self.path("run.h5"), {"n": resting(2)}, [])
        self.assertEqual(view(path).returncode, 0)
        with open(self.path("run.html"), encoding="utf-8") as file:
            text = file.read()
        self.assertIn("default-src 'none'", text)
        self.assertIn("connect-src 'none'", text)
        self.assertEqual(self.described(text)["runs"][0]["created_by"], "", "these results do not tell")
        for word in ("<script src", "<link", "@import", "<img", "<iframe"):
            self.assertNotIn(word, text.replace("<script>", ""), word)


class Peaks(unittest.TestCase):
    def test_largest_stresses_are_those_of_every_row(self):
        random = np.random.default_rng(3)
        stress, q = 1e9 * random.normal(size=(7, 5000, 6)), 1e-3 * random.normal(size=(70, 7))
        body = SimpleNamespace(shapes=random.normal(size=(7, 5000, 3)), stress=stress, stressed=np.ones(5000, bool))
        for size, rows in ((1.0, 70), (1e25, 33), (1e-25, 1), (0.0, 3), (1.0, 0)):
            with self.subTest(size=size, rows=rows):
                found = BodyData(body, 1.0).peaks(size * q[:rows], SimpleNamespace(add=lambda values, kind: np.asarray(values)))
                exact = von_mises(np.tensordot(size * q[:rows], stress, axes=1)).max(axis=0, initial=0)
                step = found["peak"]["step"]
                np.testing.assert_allclose(found["peak"]["low"] + step * (found["peak"]["data"].astype(float) + 32767), exact, rtol=1e-5, atol=step)
                self.assertAlmostEqual(found["largest"], exact.max(), delta=1e-6 * exact.max())


@unittest.skipIf(WHY_NOT, WHY_NOT)
class Viewed(Pages, InFolder):
    def page(self, *paths, options=()):
        """Builds and opens the page of results."""
        done = view(*paths, "-o", self.path("page.html"), *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.open(self.path("page.html"))
        return done.stdout

    def every(self, name="every.h5", **options):
        nodes, items, meshes = every_shape()
        return write_results(self.path(name), nodes, items, meshes=meshes, **options)

    def test_pictures_show_the_motion(self):
        self.page(self.every())
        first = self.picture()
        self.run_script("bielle.player.go(15)")
        second = self.picture()
        self.assertGreater(np.unique(first.reshape(-1, 3), axis=0).shape[0], 200)
        self.assertGreater((np.abs(first - second).sum(axis=2) > 30).sum(), 500)
        self.assertGreater(self.drawn(), 20000)
        self.no_errors()

    def test_corners_are_where_the_results_say(self):
        path = self.every()
        self.page(path)
        with Results(path) as results:
            scene = make_scene(results)
            for row in (0, 7, 30):
                expected = np.concatenate([placed(scene.poses(part, [row])[0, part.mesh.bones], part.mesh.points) for part in scene.parts])
                found = np.array(self.run_script("bielle.player.go(arguments[0]); const b = bielle.shown.batch, all = [];"
                                                 "for (let k = 0; k < b.owners.length; k++) all.push(bielle.real(b.corner(k))); return all", row))
                self.assertEqual(found.shape, expected.shape)
                self.assertLess(np.abs(found - expected).max(), 1e-4 * scene.size)
        self.no_errors()

    def test_the_cursor_and_a_click_on_the_plot(self):
        self.page(self.every())
        self.run_script("const q = bielle.quantities.list().find(q => q.title === 'nodes/end/position'); bielle.plot.toggle(q, 0)")
        self.settled()
        for share in (0.25, 0.8):
            self.run_script("""const c = document.getElementById("plot"), s = bielle.plot.chart.scales.x, x = s.getPixelForValue(s.min + arguments[0] * (s.max - s.min));
                const r = c.getBoundingClientRect(); for (const type of ["pointerdown", "pointerup"])
                c.dispatchEvent(new PointerEvent(type, {clientX: r.left + x, clientY: r.top + 40, bubbles: true}));""", share)
            self.assertAlmostEqual(self.run_script("return bielle.player.time()"), 0.3 * share, delta=0.002)
            self.assertAlmostEqual(self.run_script("return bielle.plot.position()"), 0.3 * share, delta=0.002)
        now = self.run_script("return bielle.quantities.now(bielle.quantities.list().find(q => q.title === 'nodes/end/position'), 0)")
        self.assertAlmostEqual(now, 1.6 + 0.2 * np.sin(0.2 * 24), delta=0.005)
        self.no_errors()

    def test_a_click_identifies_hides_and_isolates(self):
        box = {"entry": "elements/big", "type": "rigid_body", "shape": "box", "node": "n", "size": [1, 1, 1]}
        self.page(write_results(self.path("box.h5"), {"n": resting(3)}, [box]))
        self.run_script("""const c = document.getElementById("scene"), r = c.getBoundingClientRect(), o = {clientX: r.left + r.width / 2, clientY: r.top + r.height / 2, pointerId: 1, button: 0, bubbles: true};
            c.setPointerCapture = () => {}; c.dispatchEvent(new PointerEvent("pointerdown", o)); c.dispatchEvent(new PointerEvent("pointerup", o));""")
        self.assertEqual(self.run_script("return document.querySelector('#details h2').textContent"), "elements/big")
        point = np.array(self.run_script("return bielle.real(bielle.pointNow(bielle.entries.point))"))
        self.assertAlmostEqual(np.abs(point).max(), 0.5, delta=1e-4)
        full = self.drawn()
        self.run_script("bielle.entries.toggle('elements/big', 'hidden')")
        self.assertLess(self.drawn(), 0.05 * full)
        self.no_errors()

    def test_traces_arrows_and_following(self):
        x, q = resting(20)
        x = np.column_stack([np.cos(0.1 * np.arange(20)), np.sin(0.1 * np.arange(20)), np.zeros(20)])

        def velocity(file):
            file["analysis_1/nodes/n/velocity"][:] = np.tile([0, 2.0, 0, 0, 0, 0], (20, 1))
        self.page(write_results(self.path("trace.h5"), {"n": (x, q)}, [{"entry": "nodes/n", "type": "node", "shape": "node", "node": "n"}], extra=velocity))
        self.run_script("bielle.traces.toggle('nodes/n', null)")
        path = np.array(self.run_script("const p = bielle.traces.group.children[0].geometry.attributes.position.array, all = [];"
                                        "for (let k = 0; k < p.length; k += 3) all.push(bielle.real(Array.from(p.subarray(k, k + 3)))); return all"))
        np.testing.assert_allclose(path, x, atol=1e-4)
        without = self.drawn()
        self.assertAlmostEqual(self.run_script("return bielle.shown.arrows.largest('velocities')"), 2, 6)
        self.run_script("bielle.settings.arrows.add('velocities'); bielle.moved()")
        self.assertGreater(self.drawn(), without + 300)
        self.run_script("bielle.followEntry('nodes/n')")
        places = [self.run_script("bielle.player.go(arguments[0]); bielle.render(); return bielle.camera.pixels(bielle.shown.anchor('nodes/n')).slice(0, 2)", row) for row in (0, 15)]
        np.testing.assert_allclose(places[0], places[1], atol=0.01)
        self.no_errors()

    def test_another_size_of_the_window_is_filled_until_the_view_is_changed(self):
        self.page(self.every())
        def ratio(width, height):
            """Returns the height of the picture relative to that of a picture that is fitted to the size of this
            window."""
            self.browser.set_window_size(width, height)
            self.settled()
            return self.run_script("const c = bielle.camera, shown = c.height, touched = c.touched, target = c.target; c.fit(); const fitted = c.height;"
                                   "Object.assign(c, {height: shown, touched, target}); return shown / fitted")
        self.addCleanup(self.browser.set_window_size, 1000, 700)
        self.assertAlmostEqual(ratio(1000, 700), 1, delta=1e-6)
        self.assertAlmostEqual(ratio(600, 900), 1, delta=1e-6)
        self.run_script("bielle.camera.touched = true")
        self.assertGreater(abs(ratio(1400, 500) - 1), 0.05)
        self.no_errors()

    def test_the_help_names_the_program(self):
        program = "bielle-mechanism 0.1.0 (commit 0123456789ab)"
        self.page(self.every(extra=lambda file: file.attrs.update(created_by=program)))
        self.assertIn(f"every.h5: computed by {program}.", self.run_script("return document.getElementById('help').textContent"))
        self.no_errors()

    def test_keys(self):
        self.page(self.every())
        press = "document.dispatchEvent(new KeyboardEvent('keydown', {key: arguments[0], bubbles: true}))"
        for key, place in (("End", 30), ("ArrowLeft", 29), ("Home", 0), ("ArrowRight", 1)):
            self.run_script(press, key)
            self.assertEqual(self.run_script("return bielle.player.place"), place, key)
        self.run_script(press, " ")
        self.assertTrue(self.run_script("return bielle.player.playing"))
        before = self.run_script("return bielle.frames")
        time.sleep(1)
        self.run_script(press, " ")
        self.assertGreater(self.run_script("return bielle.frames"), before)
        self.run_script(press, "z")
        np.testing.assert_allclose(self.run_script("return bielle.camera.axes()"), np.eye(3), atol=1e-9)
        self.no_errors()

    def test_a_failed_run_and_rows_without_numbers(self):
        x, q = resting(9, (0.2, 0, 0))
        x = x.copy()
        x[5:] = np.nan
        box = {"entry": "elements/b", "type": "rigid_body", "shape": "box", "node": "n", "size": [1, 1, 1]}
        self.page(write_results(self.path("failed.h5"), {"n": (x, q), "m": resting(9)}, [box, {**box, "entry": "elements/c", "node": "m", "position": [2, 0, 0]}], complete=0))
        both = self.drawn()
        self.run_script("bielle.player.go(7)")
        self.assertLess(self.drawn(), 0.8 * both)
        self.no_errors()

    def test_one_row_and_no_items(self):
        self.page(write_results(self.path("one.h5"), {"n": resting(1)}, None))
        self.assertEqual(self.run_script("return bielle.shown.sequence.kind"), "state")
        self.page(write_results(self.path("none.h5"), {"n": resting(4)}, []))
        self.no_errors()

    def test_hostile_names_do_no_harm(self):
        evil = ["</script><script>window.harmed=1</script>", "\"'><img src=x onerror=window.harmed=1>", "größe ☃ \u2028 `${window.harmed=1}`", "{{ARRAYS}}", "__proto__"]
        items = [{"entry": f"elements/{name}", "type": name, "shape": "box", "node": "n", "size": [1, 1, 1], "position": [2 * k, 0, 0]} for k, name in enumerate(evil)]
        self.page(write_results(self.path("evil.h5"), {"n": resting(3)}, items, name=evil[0]))
        self.run_script("for (const one of bielle.entries.all) bielle.entries.choose(one.entry)")
        self.assertIsNone(self.run_script("return window.harmed ?? null"))
        self.assertEqual(self.run_script("return [...document.querySelectorAll('.entry .name')].map(e => e.textContent)"), evil)
        self.assertEqual(self.run_script("return document.title"), evil[0])
        self.no_errors()

    def test_tiny_and_huge_machines(self):
        sizes = []
        for unit in (1e-6, 1e5):
            x = unit * np.column_stack([np.cos(np.arange(9)), np.sin(np.arange(9)), np.zeros(9)])
            items = [{"entry": "elements/b", "type": "rigid_body", "shape": "box", "node": "n", "size": [unit, unit, unit]},
                     {"entry": "elements/s", "type": "spring_damper", "shape": "coil", "ends": [{"node": "ground", "position": [3 * unit, 0, 0]}, {"node": "n"}]}]
            self.page(write_results(self.path(f"unit{unit}.h5"), {"n": (x, turning(9, (0, 0, 1)))}, items))
            self.run_script("bielle.player.go(4)")
            sizes.append(self.drawn())
            self.assertGreater(sizes[-1], 5000)
            corner = np.array(self.run_script("return bielle.real(bielle.shown.batch.corner(0))"))
            self.assertLess(np.linalg.norm(corner - x[4]), 0.9 * unit)
        self.assertAlmostEqual(sizes[0] / sizes[1], 1, delta=0.01)
        self.no_errors()

    def test_two_runs_are_overlaid(self):
        first = self.every()
        nodes, items, meshes = every_shape()
        nodes["end"] = (nodes["end"][0] + [0, 0.3, 0], nodes["end"][1])
        self.page(first, write_results(self.path("second.h5"), nodes, items, meshes=meshes))
        self.assertEqual(self.run_script("return bielle.allShown.length"), 2)
        self.run_script("const q = bielle.quantities.list().find(q => q.title === 'nodes/end/position'); bielle.plot.toggle(q, 1)")
        self.assertEqual(self.run_script("return bielle.plot.chart.data.datasets.map(d => d.data[3].y)"), [0, np.float32(0.3)])
        self.run_script("bielle.player.go(12)")
        self.assertEqual(self.run_script("return bielle.allShown.map(s => s.place)"), [12, 12])
        self.no_errors()

    def test_more_corners_than_16_bits_count(self):
        items = [{"entry": f"joints/j{k}", "type": "hinge", "shape": "joint", "frames": [{"node": "ground", "position": [k % 50, k // 50, 0]}, {"node": "n", "position": [k % 50, k // 50, 0]}]}
                 for k in range(1500)]
        self.page(write_results(self.path("many.h5"), {"n": resting(20)}, items))
        self.assertEqual(self.run_script("return bielle.entries.all.length"), 1500)
        self.assertGreater(self.run_script("return bielle.shown.batch.owners.length"), 65536)
        self.assertGreater(self.drawn(), 5000)
        self.no_errors()

    def arm(self, analysis):
        """Writes results of a flexible arm."""
        for command in ([os.path.join(PROGRAMS, "bielle-reduce"), os.path.join(REPOSITORY, "meshes", "bar.yaml"), "-o", self.path("bar.h5")],
                        [os.path.join(PROGRAMS, "bielle-mechanism"), self.write("arm.yaml", ARM.format(analysis))]):
            done = subprocess.run(command, capture_output=True, text=True, cwd=self.folder, check=False)
            self.assertEqual(done.returncode, 0, done.stderr)
        return self.path("arm.h5")

    def test_a_flexible_body_and_its_stresses(self):
        path = self.arm("{type: dynamic, duration: 0.2, step: 0.005}")
        self.page(path)
        with Results(path) as results, h5py.File(self.path("bar.h5")) as file:
            body, stressed = SuperelementBody(self.path("bar.h5")), "stress" in file["recovery"]
            frame, q = results.rows("elements/arm/frame", 20), results.rows("elements/arm/coordinates", 20)
        self.run_script("bielle.settings.stress = 'von_mises'; bielle.player.go(20)")
        nodes = self.run_script("return Array.from(bielle.shown.flexible[0].body.nodes)")
        found = np.array(self.run_script("const f = bielle.shown.flexible[0]; return f.body.nodes.reduce((all, n, k) => { all.push(bielle.real(f.corner(k))); return all; }, [])"))
        np.testing.assert_allclose(found, body.at(frame, q)[0][nodes], atol=1e-4)
        if stressed:
            values = np.array(self.run_script("return Array.from(bielle.shown.flexible[0].values)"))
            exact = body.von_mises(q)[nodes]
            known = np.isfinite(exact)
            np.testing.assert_allclose(values[known], exact[known], atol=0.02 * np.nanmax(exact))
        units = self.run_script("const q = bielle.quantities.list().find(q => q.title === 'joints/pin/reaction'); return q.columns.map((_, k) => q.unitsOf(k))")
        self.assertEqual(units, 3 * ["N"] + 3 * ["N m"])
        self.run_script("bielle.settings.magnify = 0; bielle.player.go(20)")
        flat = np.array(self.run_script("return bielle.real(bielle.shown.flexible[0].corner(0))"))
        np.testing.assert_allclose(flat, body.at(frame, 0 * q)[0][nodes[0]], atol=1e-4)
        self.no_errors()

    def test_a_body_in_motion_is_drawn_by_fewer_triangles(self):
        points, _ = synthetic.write_superelement(self.path("box.h5"), (16, 8, 8))
        synthetic.write_results(self.path("run.h5"), "box.h5")
        self.page(self.path("run.h5"))
        levels = self.run_script("return bielle.body(0).levels.map(level => [level.cell, level.count, level.index.count])")
        self.assertGreater(len(levels), 2)
        drawn = "const f = bielle.shown.flexible[0], i = f.geometry.index; return [f.level, i.count, Math.max(...i.array)]"
        self.assertEqual(self.run_script(drawn)[:2], [0, levels[0][2]])
        places = "const f = bielle.shown.flexible[0]; return Array.from(f.body.nodes, (node, k) => bielle.real(f.corner(k)))"
        self.run_script("bielle.settings.stress = 'von_mises'; bielle.player.go(7.3)")
        exact, stress = self.run_script(places), self.run_script("return Array.from(bielle.shown.flexible[0].values)")
        # The drawn points are the same during a motion; other points are only computed on request.
        found = self.run_script(f"""bielle.player.go(3); bielle.shown.flexible[0].detail(arguments[0]); bielle.player.go(7.3); const f = bielle.shown.flexible[0], i = f.geometry.index;
            const coarse = [f.level, i.count, Math.max(...i.array), Array.from(f.values)]; return [...coarse, (() => {{ {places} }})(), Array.from(f.values)];""", levels[-1][0])
        self.assertEqual(found[:2], [len(levels) - 1, levels[-1][2]])
        self.assertLess(found[2], levels[-1][1])
        np.testing.assert_array_equal(found[3][:levels[-1][1]], stress[:levels[-1][1]])
        self.assertNotEqual(found[3][levels[-1][1]:], stress[levels[-1][1]:])
        np.testing.assert_array_equal(found[4], exact)
        np.testing.assert_array_equal(found[5], stress)
        # Cells have the size of two pixels during a motion, and the picture at rest has all triangles.
        self.run_script("bielle.camera.height *= 40; bielle.player.toggle()")
        self.settled()
        self.assertEqual(self.run_script(drawn)[0], len(levels) - 1)
        self.run_script("bielle.player.pause()")
        self.settled()
        self.assertEqual(self.run_script(drawn)[:2], [0, levels[0][2]])
        self.run_script("bielle.camera.height /= 1000; bielle.player.toggle()")
        self.settled()
        self.assertEqual(self.run_script(drawn)[0], 0)
        self.no_errors()

    def test_twenty_bodies_share_shapes_and_send_only_points_that_are_drawn(self):
        synthetic.write_superelement(self.path("box.h5"), (16, 8, 8))
        synthetic.write_results(self.path("run.h5"), "box.h5")
        with h5py.File(self.path("run.h5"), "r+") as file:
            for k in range(1, 20):
                file.copy("elements/rod", file["elements"], f"rod{k}")
        self.page(self.path("run.h5"))
        self.assertEqual(self.run_script("const all = bielle.shown.flexible; return [all.length, bielle.data.bodies.length, new Set(all.map(f => f.body)).size, new Set(all.map(f => f.geometry.index)).size]"),
                         [20, 1, 1, 1])
        levels = self.run_script("return bielle.body(0).levels.map(level => [level.cell, level.count, level.index.count / 3])")
        self.run_script("""const gl = bielle.renderer.getContext(), send = gl.bufferSubData.bind(gl); bielle.draw = () => {}; bielle.sent = 0;
            gl.bufferSubData = (target, start, data, ...more) => { bielle.sent += data.byteLength; send(target, start, data, ...more); };""")
        self.run_script("for (const part of bielle.shown.layout.parts) part.opacity = 1; bielle.repaint()")
        self.settled()
        for stress, numbers in (("none", 3), ("von_mises", 4)):
            for cell, count, triangles in levels:
                sent, drawn, passes = self.run_script("""bielle.settings.stress = arguments[0]; for (const f of bielle.shown.flexible) f.detail(arguments[1]);
                    bielle.player.go(3); bielle.sent = 0; bielle.render(); const b = bielle.shown.batch;
                    return [bielle.sent, bielle.renderer.info.render.triangles - b.triangles.length / 3, b.passes.map(objects => objects[0].visible)];""", stress, cell)
                self.assertEqual((sent, drawn, passes), (20 * count * numbers * 4, 20 * triangles, [True, False]))
        # The rigid parts need a second pass while some of them are transparent.
        transparent = "return [bielle.shown.batch.passes.map(objects => objects[0].visible), bielle.shown.batch.looks.data.filter((v, k) => k % 4 === 3 && v > 0 && v < 0.99).length > 0]"
        self.run_script("bielle.entries.toggle(bielle.shown.layout.parts[0].entry, 'faint')")
        self.assertEqual(self.run_script(transparent), [[True, True], True])
        self.run_script("bielle.entries.toggle(bielle.shown.layout.parts[0].entry, 'faint')")
        self.assertEqual(self.run_script(transparent), [[True, False], False])
        self.no_errors()

    def test_a_slow_machine_has_less_resolution_then_fewer_triangles(self):
        self.page(self.every())
        steps = self.run_script("const q = bielle.quality, all = []; bielle.draw = () => {}; for (const step of ['coarser', 'finer']) for (let k = 0; k < 30; k++) { q[step](); all.push([q.moving, q.cell]); } return all;")
        for a, b in zip(steps[:30], steps[1:30]):
            self.assertTrue(a[0] >= b[0] and a[1] <= b[1] and (b[1] == 2 or a[0] == 0.5), (a, b))
        self.assertEqual((steps[29], steps[-1]), ([0.5, 4], [1, 2]))
        self.assertTrue(all(cell == 2 or ratio == 0.5 for ratio, cell in steps))
        self.no_errors()

    def beam(self):
        """Opens the page of a beam with stresses, seen along z without perspective and symbols."""
        item, records = stressed_beam()
        self.page(write_results(self.path("beam.h5"), {"n": resting(3)}, [item], extra=records))
        self.run_script("bielle.settings.grid = false; bielle.camera.view('z'); bielle.camera.ortho = true; bielle.camera.fit()")

    def elements_colours(self):
        """Returns the drawn colours of the middles of the two elements (2,3)."""
        self.settled()
        return np.array(self.run_script("""bielle.render(); const c = document.getElementById("scene"), o = document.createElement("canvas"), r = c.width / c.clientWidth; o.width = c.width; o.height = c.height;
            const p = o.getContext("2d"); p.drawImage(c, 0, 0); return [0.5, 1.5].map(x => bielle.camera.pixels([(x - bielle.data.centre[0]) / bielle.data.size, 0, 0.1 / bielle.data.size]))
            .map(([x, y]) => Array.from(p.getImageData(Math.round(r * x), Math.round(r * y), 1, 1).data.slice(0, 3)))"""))

    def test_elements_of_beams_are_coloured_by_stress(self):
        self.beam()
        self.assertEqual(self.run_script("return Array.from(document.querySelectorAll('#options option'), o => o.value)"), ["none", "von_mises", "peak"])
        plain = self.elements_colours()
        np.testing.assert_array_equal(plain[0], plain[1])
        self.run_script("bielle.settings.stress = 'von_mises'; bielle.player.go(1)")
        self.assertEqual(self.run_script("return bielle.stressRange()"), [0, np.max(STRESSES[2, :1])])
        values = "return [0, 1].map(cell => bielle.shown.stresses.at(cell))"
        np.testing.assert_allclose(self.run_script(values), STRESSES[1], atol=1e8 / 65534)
        np.testing.assert_allclose(self.run_script("bielle.player.go(0.5);" + values), STRESSES[:2].mean(axis=0), atol=1e8 / 65534)
        shades = []
        for row in range(3):
            self.run_script("bielle.player.go(arguments[0])", row)
            shades.append(self.elements_colours())
        # The light is the same everywhere, so that colours are those of the scale times one factor, except for an equal
        # shine.
        blue = np.array([stress_colours(share / 1e8) for share in (0.0, 10e6, 20e6, 40e6, 100e6)], float)[:, 2]
        found = np.array([shades[0][0], shades[0][1], shades[1][0], shades[1][1], shades[2][0]])[:, 2]
        factor, shine = np.polyfit(blue, found, 1)
        np.testing.assert_allclose(found, factor * blue + shine, atol=4)
        self.assertGreater(factor, 0.3)
        self.assertLess(np.ptp(shades[2][1]), 30, "an element without a stress is grey")
        self.run_script("bielle.settings.stress = 'peak'; bielle.player.go(0)")
        np.testing.assert_allclose(self.run_script(values), [1e8, 4e7], atol=1e8 / 65534)
        self.no_errors()

    def test_bodies_and_beams_share_one_scale(self):
        synthetic.write_superelement(self.path("box.h5"))
        synthetic.write_results(self.path("run.h5"), "box.h5")
        self.page(self.path("run.h5"))
        largest = synthetic.YOUNG * synthetic.STRAIN  # stress in the body, while the beam has 40 MPa
        self.run_script("bielle.settings.stress = 'von_mises'; bielle.player.go(20)")
        np.testing.assert_allclose(self.run_script("return bielle.stressRange()"), [0, largest], rtol=1e-3)
        self.assertEqual(self.run_script("return [bielle.shown.batch.range.y, bielle.shown.flexible[0].range.y]"), 2 * [self.run_script("return bielle.stressRange()[1]")])
        np.testing.assert_allclose(self.run_script("return [0, 1, 2, 3].map(cell => bielle.shown.stresses.at(cell))"), [1e7, 2e7, 3e7, 4e7], rtol=1e-3)
        self.run_script("bielle.settings.stress = 'xx'; bielle.player.go(20)")
        self.assertEqual(self.run_script("return bielle.shown.stresses.at(0)"), None)
        self.no_errors()

    def test_modes_and_their_decay(self):
        path = self.arm("{type: assembly}, {type: eigen, count: 4}")
        self.page(path)
        kinds = self.run_script("return bielle.data.runs[0].sequences.map(s => s.kind)")
        self.assertEqual(kinds, ["state"] + 4 * ["mode"])
        self.run_script("bielle.show(3)")
        corners = "const f = bielle.shown.flexible[0]; return Array.from(f.body.nodes, (_, k) => f.corner(k))"
        rest = np.array(self.run_script("bielle.settings.amplitude = 1e-9; bielle.player.go(0);" + corners))
        phases = [np.array(self.run_script("bielle.settings.amplitude = arguments[1]; bielle.player.go(arguments[0]);" + corners, place, size)) - rest
                  for place, size in ((0, 1), (18, 1), (36, 1), (0, 2))]
        np.testing.assert_allclose(phases[0], -phases[1], atol=1e-4)
        np.testing.assert_allclose(phases[0], phases[2], atol=1e-9)
        np.testing.assert_allclose(2 * phases[0], phases[3], atol=1e-4)
        self.assertAlmostEqual(np.linalg.norm(phases[0], axis=1).max(), 0.1, delta=0.03)  # 0.1 of the size
        decay = self.run_script("bielle.settings.decay = true; bielle.settings.amplitude = 1; bielle.player.go(18); return [bielle.amplitude(), bielle.shown.sequence.decay]")
        self.assertAlmostEqual(decay[0], np.exp(decay[1] / 2), 9)
        self.no_errors()


@unittest.skipIf(WHY_NOT, WHY_NOT)
class Checked(Pages, InFolder):
    """Tests of models that were only checked."""
    BAR = """gravity: [0, 0, -9.81]
nodes: {a: {position: [1, 0, 0]}}
elements: {a: {type: rigid_body, node: a, mass: 1, inertia: [0.1, 0.1, 0.1]}}
joints:
  pin: {type: hinge, nodes: [ground, a], position: [0, 0, 0], axis: [0, 1, 0]}
"""

    def shown(self, path):
        done = view(path, "-o", self.path("page.html"))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.open(self.path("page.html"))
        marks = self.run_script("return Object.fromEntries(Array.from(document.querySelectorAll('.entry'), e => [e.title, e.querySelector('.mark').textContent]).filter(pair => pair[1]))")
        return self.run_script("const box = document.getElementById('verdict'); return [box.className, Array.from(box.children, e => e.textContent)]"), marks

    def colours(self):
        """Returns {entry: excess of red over green} as shares of 1."""
        return self.run_script("const d = bielle.shown.batch.looks.data; return Object.fromEntries(bielle.shown.layout.parts.map((part, k) => [part.entry, d[4 * k] - d[4 * k + 1]]))")

    def checked(self, text, status=0):
        """Writes results of the program's check of a model."""
        done = subprocess.run([os.path.join(PROGRAMS, "bielle-mechanism"), self.write("model.yaml", text), "--check", "-o", self.path("check.h5")],
                              capture_output=True, text=True, cwd=self.folder, check=False)
        self.assertEqual(done.returncode, status, done.stderr)
        return self.path("check.h5")

    def test_what_was_found_is_said_and_marked(self):
        (kind, said), marks = self.shown(write_check(self.path("check.h5"), redundant=["joints/second", "nodes/far"]))
        self.assertEqual((kind, said), ("", ["The model is assembled.", "Constraints are redundant, and set aside: joints/second, nodes/far."]))
        self.assertEqual(marks, {"joints/second": "redundant"})
        colours = self.colours()
        self.assertGreater(colours["joints/second"], 0.3)
        self.assertLess(colours["joints/first"], 0.05)
        self.assertEqual(self.run_script("return document.getElementById('moment').textContent"), "")
        (kind, said), marks = self.shown(write_check(self.path("check.h5"), failure="the loop <b>does not</b> close.", apart=0.02))
        self.assertEqual((kind, said), ("failed", ["The model cannot be assembled, and is shown as it is drawn: the loop <b>does not</b> close."]))
        self.assertEqual(marks, {"joints/second": "gap"})
        self.run_script("bielle.entries.choose('joints/second')")
        self.assertIn("its frames are up to 0.02 m apart", self.run_script("return document.getElementById('details').textContent"))
        self.no_errors()

    def test_a_loop_with_redundant_constraints(self):
        (kind, said), marks = self.shown(self.checked(self.BAR + "  second: {type: hinge, nodes: [ground, a], position: [0, 1, 0], axis: [0, 1, 0]}\n"))
        self.assertEqual((kind, said[1:], marks), ("", ["Constraints are redundant, and set aside: joints/second."], {"joints/second": "redundant"}))
        self.no_errors()

    def test_loops_that_cannot_be_closed(self):
        for second, mark, sentence in (("at: [[50, 0, 0], [0, 0, 0]], axis: [0, 1, 0]", "gap", "its frames are up to 49 m apart"),
                                       ("position: [0, 1, 0], axis: [[0, 1, 0], [0, 1, 1]]", "tilt", "its axes are up to 45\u00b0 apart")):
            with self.subTest(mark):
                (kind, said), marks = self.shown(self.checked(self.BAR + f"  second: {{type: hinge, nodes: [ground, a], {second}}}\n", status=2))
                self.assertEqual(kind, "failed")
                self.assertEqual(set(marks), {"joints/second"})
                self.assertIn(mark, marks["joints/second"])
                with h5py.File(self.path("check.h5")) as file:
                    self.assertIn(file["analysis_1"].attrs["failure"].strip(" ."), said[0])
                self.run_script("bielle.entries.choose('joints/second')")
                self.assertIn(sentence, self.run_script("return document.getElementById('details').textContent"))
        self.no_errors()

    def test_pictures_and_tables(self):
        animate, path = os.path.join(REPOSITORY, "tools", "bielle-animate"), write_check(self.path("check.h5"), failure="it does not close", apart=0.02)
        done = run_python_tool(animate, [path, "-o", self.path("check.png")])
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        for tool, options, says in (("bielle-animate", [], "holds no motion to show: it has one position, which -o FILE.png draws"),
                                    ("bielle-plot", [], "it has one time only, which bielle-view shows")):
            done = run_python_tool(os.path.join(REPOSITORY, "tools", tool), [path, *options])
            self.assertEqual((done.returncode, done.stderr.count("\n")), (1, 1), done.stderr)
            self.assertIn(says, done.stderr)
        done = run_python_tool(os.path.join(REPOSITORY, "tools", "bielle-table"), [path])
        self.assertEqual((done.returncode, "nodes/n/position" in done.stdout), (0, True), done.stderr)


@unittest.skipIf(WHY_NOT, WHY_NOT)
class Live(Pages, InFolder):
    def test_a_growing_run_is_shown_again(self):
        path, item = self.path("run.h5"), {"entry": "nodes/n", "type": "node", "shape": "node", "node": "n"}
        write_results(path, {"n": resting(5)}, [item])
        server = subprocess.Popen([sys.executable, TOOL, path, "--live"], stdout=subprocess.PIPE, text=True)
        self.addCleanup(server.stdout.close)
        self.addCleanup(server.wait)
        self.addCleanup(server.terminate)
        address = server.stdout.readline().split()[0]
        self.assertTrue(address.startswith("http://127.0.0.1:"), address)
        self.open(address)
        self.assertEqual(self.run_script("return bielle.shown.sequence.rows"), 5)
        self.run_script("bielle.camera.turn = 0.123; bielle.player.go(4)")
        write_results(path, {"n": resting(8)}, [item])
        end = time.monotonic() + 60
        while self.run_script("return window.bielle && window.bielle.ready ? bielle.shown.sequence.rows : 0") != 8:
            self.assertLess(time.monotonic(), end)
            time.sleep(0.2)
        self.assertEqual(self.run_script("return [bielle.camera.turn, bielle.player.place]"), [0.123, 7])
        self.no_errors()
        connection = http.client.HTTPConnection(address[7:].strip("/"))
        connection.request("GET", "/state", headers={"Host": "elsewhere.example"})
        self.assertEqual(connection.getresponse().status, 403)
        connection.close()

    def test_a_replaced_file_keeps_the_page_and_is_named_once(self):
        path = self.path("run.h5")
        write_results(path, {"n": resting(5)}, [{"entry": "nodes/n", "type": "node", "shape": "node", "node": "n"}])
        server = subprocess.Popen([sys.executable, TOOL, path, "--live"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(server.stdout.close)
        self.addCleanup(server.stderr.close)
        self.addCleanup(server.wait)
        self.addCleanup(server.terminate)
        address = server.stdout.readline().split()[0].rstrip("/")

        def asked(place):
            with urllib.request.urlopen(address + place, timeout=60) as answer:
                return answer.read()
        page, token = asked("/"), asked("/state")
        for text in ("no results", "no results either"):
            self.write("other", text)
            os.replace(self.path("other"), path)
            self.assertEqual((asked("/state"), asked("/")), (token, page))
        os.remove(path)
        self.assertEqual((asked("/state"), asked("/")), (token, page))
        server.terminate()
        said = server.stderr.read().splitlines()
        self.assertEqual(said, [f"note: '{path}' does not hold results of bielle-mechanism: it is no HDF5 file but text", f"note: '{path}' does not exist"])


if __name__ == "__main__":
    unittest.main()
