"""Tests of pictures of bielle-animate: places and colours of pixels follow from the motion in closed form."""

import contextlib
import json
import os
import shutil
import signal
import subprocess
import time
import unittest
import unittest.mock

import h5py
import numpy as np
from PIL import Image, ImageSequence

import drawn_results
import synthetic_modes
import synthetic_results as synthetic
from box_mesh import REPOSITORY, InFolder
from python_tool import import_tools, run_python_tool

from bielle_tools.messages import InputError  # noqa: E402  (box_mesh sets the path)
from bielle_tools.pictures import frames  # noqa: E402
from bielle_tools.pictures.camera import MARGIN  # noqa: E402
from bielle_tools.pictures.display import virtual_display  # noqa: E402
from bielle_tools.pictures.shot import Look, Shot  # noqa: E402
from bielle_tools.results import Results  # noqa: E402
from bielle_tools.results.modes import ModeMotion, Modes, ModeScenery  # noqa: E402
from bielle_tools.scene.stress_scale import ANCHORS, stress_colours  # noqa: E402
from shares import share_of_tests as load_tests  # noqa: E402,F401

TOOL = os.path.join(REPOSITORY, "tools", "bielle-animate")
RED, BLUE = "#ff0000", "#0000ff"
SIDE, TRAVEL = 0.2, 1.0  # side of the red box, and its travel along x [m]


class Pictures(InFolder):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        import_tools("pictures", "results", "bodies")
        with unittest.mock.patch.dict(os.environ):
            server = contextlib.ExitStack()
            # All tests use one server, whose start takes longer than most drawings.
            server.enter_context(virtual_display())
            cls.display = os.environ["DISPLAY"]
        cls.addClassCleanup(server.close)

    def boxes(self, size=1.0, origin=(0, 0, 0), rows=5, name="boxes"):
        """Writes a red box that moves along x, and a blue one at rest below its start. @returns path of the results"""
        x = np.outer(np.linspace(0, TRAVEL, rows), [1, 0, 0]) * size + origin
        nodes = {"slider": (x, drawn_results.resting(rows)[1]), "stone": drawn_results.resting(rows, origin)}
        items = [{"entry": "elements/red", "type": "rigid_body", "shape": "box", "node": "slider", "size": [SIDE * size] * 3, "colour": RED},
                 {"entry": "elements/blue", "type": "rigid_body", "shape": "box", "node": "stone", "size": [SIDE * size] * 3, "colour": BLUE,
                  "position": [0, -0.4 * size, 0]}]
        return drawn_results.write_results(self.path("boxes.h5"), nodes, items, name=name)

    def shot(self, path, pictures=5, **look):
        with Results(path) as results:
            return Shot(results, Look(**look), pictures)

    def drawings(self, shot, processes=1):
        """Returns the drawings (rows,height,width,3) without the strips of texts."""
        top, height = shot.paper.line, shot.camera.size[1]
        return np.array([np.asarray(each)[top:top + height] for each in self.pictures(shot, processes)]).astype(int)

    def pictures(self, shot, processes=1):
        """Base class whose tests draw on one display."""
        with (unittest.mock.patch.object(frames, "virtual_display", contextlib.nullcontext),
              unittest.mock.patch.dict(os.environ, DISPLAY=self.display)):
            yield from frames.drawn(shot, processes=processes)

    def animate(self, *arguments, **options):
        return run_python_tool(TOOL, [*arguments], folder=self.folder, **options)

    def succeed(self, *arguments, **options):
        done = self.animate(*arguments, **options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def refuse(self, says, *arguments, **options):
        done = self.animate(*arguments, **options)
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertIn(says, done.stderr.splitlines()[-1])


def reddish(image):
    return (image[..., 0] > 100) & (image[..., 1] < 90) & (image[..., 2] < 90)


def bluish(image):
    return (image[..., 2] > 100) & (image[..., 0] < 90) & (image[..., 1] < 90)


def inked(image):
    return (image < 245).any(axis=-1)


def bounds(mask):
    """Returns the first column, the column after the last, the first row, and the row after the last."""
    rows, columns = np.flatnonzero(mask.any(axis=1)), np.flatnonzero(mask.any(axis=0))
    return np.array([columns[0], columns[-1] + 1, rows[0], rows[-1] + 1])


class Places(Pictures):
    def test_a_box_is_where_its_motion_says(self):
        """Seen along z, the motion has the width SIDE + TRAVEL, which fills the picture together with the margins on
        both sides."""
        shot = self.shot(self.boxes(), view="z", size=(600, 400))
        width = 600
        scale = (1 - 2 * MARGIN) * width / (SIDE + TRAVEL)
        for k, image in enumerate(self.drawings(shot)):
            left = MARGIN * width + TRAVEL * k / 4 * scale
            middle = shot.camera.size[1] / 2  # both boxes together are 0.6 m high, with the red one above
            expected = [left, left + SIDE * scale, middle - 0.3 * scale, middle - 0.1 * scale]
            np.testing.assert_allclose(bounds(reddish(image)), expected, atol=1.5)
            self.assertTrue((image[0, 0] == 255).all())
        self.assertEqual(shot.camera.size, (600, 400 - shot.paper.line))

    def test_the_perspective_is_that_of_the_camera(self):
        shot = self.shot(self.boxes(), view="iso", size=(600, 500))
        self.assertFalse(shot.camera.flat)
        corners = SIDE * (np.array(np.meshgrid([0, 1], [0, 1], [0, 1])).reshape(3, -1).T - 0.5)
        everything = np.zeros(shot.camera.size[::-1], bool)
        for k, image in enumerate(self.drawings(shot)):
            pixels = shot.camera.pixels(corners + [TRAVEL * k / 4, 0, 0])
            expected = [*np.sort(pixels[:, 0])[[0, -1]], *np.sort(pixels[:, 1])[[0, -1]]]
            np.testing.assert_allclose(bounds(reddish(image)), expected, atol=1.5)
            everything |= inked(image)
        left, right, top, bottom = bounds(everything)
        self.assertAlmostEqual(max((right - left) / shot.camera.size[0], (bottom - top) / shot.camera.size[1]), 1 - 2 * MARGIN, delta=0.02)

    def test_size_and_place_of_the_machine_do_not_matter(self):
        expected = self.drawings(self.shot(self.boxes(), view="iso", size=(300, 300)), 1)
        for size, origin in ((1e-6, (0, 0, 0)), (1e5, (0, 0, 0)), (1.0, (3e6, -2e6, 1e6))):
            found = self.drawings(self.shot(self.boxes(size, origin), view="iso", size=(300, 300)), 1)
            different = (np.abs(found - expected).max(axis=-1) > 60).mean()
            self.assertLess(different, 2e-4, (size, origin))  # pixels of the edges alone

    def test_the_picture_is_filled_and_moves(self):
        nodes, items, meshes = drawn_results.every_shape()
        path = drawn_results.write_results(self.path("every.h5"), nodes, items, meshes=meshes)
        for view in (None, "x", "-y", "z"):
            images = self.drawings(self.shot(path, view=view, size=(400, 300)))
            left, right, top, bottom = bounds(inked(images).any(axis=0))
            self.assertGreater(max((right - left) / images.shape[2], (bottom - top) / images.shape[1]), 0.6, view)
            self.assertGreater((images[0] != images[2]).any(axis=-1).sum(), 20)

    def test_planar_motions_are_seen_along_their_normal(self):
        path = drawn_results.write_results(
            self.path("planar.h5"), {"a": (np.array([[0, 0, 0], [1, 0, 0.5], [1.5, 0, 1.0]]), drawn_results.turning(3, (0, 1, 0)))},
            [{"entry": "elements/red", "type": "rigid_body", "shape": "box", "node": "a", "size": [0.2, 0.2, 0.2], "colour": RED}])
        shot = self.shot(path)
        self.assertTrue(shot.camera.flat)
        np.testing.assert_allclose(shot.camera.axes, [[1, 0, 0], [0, 0, 1], [0, -1, 0]])
        self.assertFalse(self.shot(path, view="iso").camera.flat)

    def test_a_followed_node_stays_where_it_is(self):
        path = self.boxes()
        for view in ("z", "iso"):
            alone = self.drawings(self.shot(path, view=view, follow="slider", size=(400, 400), hide=["blue"]))
            for image in alone:
                np.testing.assert_array_equal(image, alone[0])
            both = self.drawings(self.shot(path, view=view, follow="slider", size=(400, 400)))
            moving = [bounds(bluish(image))[0] for image in both]
            self.assertGreater(moving[0] - moving[-1], 50)
        with self.assertRaisesRegex(InputError, "no node 'slidr'.*did you mean 'slider'"):
            self.shot(path, follow="slidr")

    def test_hidden_parts_are_absent(self):
        path = self.boxes()
        for patterns, red, blue in ((["red"], False, True), (["elements/b*"], True, False), ([], True, True)):
            image = self.drawings(self.shot(path, hide=patterns, size=(300, 300)))[0]
            self.assertEqual((bool(reddish(image).any()), bool(bluish(image).any())), (red, blue), patterns)
        for patterns, says in ((["rde"], "did you mean 'red'"), (["rigid_body"], "leaves nothing to draw")):
            with self.assertRaisesRegex(InputError, says):
                self.shot(path, hide=patterns)

    def test_rows_that_are_no_numbers_leave_their_parts_out(self):
        path = self.boxes()
        with h5py.File(path, "r+") as file:
            file["nodes/slider/position"][2] = np.nan
        images = self.drawings(self.shot(path, view="z", size=(300, 300)))
        self.assertEqual([bool(reddish(image).any()) for image in images], [True, True, False, True, True])
        self.assertTrue(all(bluish(image).any() for image in images))

    def test_labels(self):
        plain, labelled = (self.drawings(self.shot(self.boxes(), view="z", size=(600, 400), labels=labels))[0] for labels in (False, True))
        changed = bounds((plain != labelled).any(axis=-1))
        red = bounds(reddish(plain))
        self.assertTrue(red[0] < changed[0] < red[1] and red[2] < changed[2] < red[3], "the name begins on the box")


class Stresses(Pictures):
    def setUp(self):
        super().setUp()
        synthetic.write_superelement(self.path("box.h5"))
        synthetic.write_results(self.path("run.h5"), "box.h5")

    def test_the_largest_stress_is_the_dark_end(self):
        """The largest strain is STRAIN at a quarter of the time; half of the faces keep the stress."""
        shot = self.shot(self.path("run.h5"), 41, size=(400, 300))
        largest = synthetic.YOUNG * synthetic.STRAIN
        self.assertAlmostEqual(shot.highest / largest, 1, delta=1e-6)
        colours = shot.at(10)[0].colours
        self.assertTrue((colours[:, :3] == ANCHORS[-1]).all(axis=1).any())
        quiet = shot.at(0)[0].colours
        self.assertFalse((quiet[:, :3] == ANCHORS[-1]).all(axis=1).any())
        self.assertTrue((quiet[:, :3] == ANCHORS[0]).all(axis=1).any())

    def test_the_bar_goes_from_nothing_to_the_largest(self):
        shot = self.shot(self.path("run.h5"), 9, size=(600, 400))
        picture = np.asarray(next(self.pictures(shot))).astype(int)
        self.assertEqual(picture.shape, (400, 600, 3))
        left, right = shot.paper.bar_ends(600)
        middle = 400 - shot.paper.line // 2
        np.testing.assert_array_equal(picture[middle, left], ANCHORS[0])
        np.testing.assert_array_equal(picture[middle, right - 1], ANCHORS[-1])
        third = left + (right - left) // 3
        np.testing.assert_array_equal(picture[middle, third], stress_colours(np.array([(third - left) / (right - left - 1)]))[0])
        self.assertGreater(inked(picture[middle - 4:middle + 4, right + 2:]).sum(), 10, "the largest stress is written next to its colour")

    def test_colours_are_known_values(self):
        np.testing.assert_array_equal(stress_colours(np.array([0, 0.5, 1, 7, -1])), ANCHORS[[0, 4, 8, 8, 0]])
        grey = stress_colours(np.array([np.nan]))[0]
        self.assertLess(np.ptp(grey.astype(int)), 30)

    def test_the_scale_falls_in_lightness_throughout(self):
        """The lightness is CIE 1976 L* of sRGB colours (IEC 61966-2-1). It orders stresses without colours as well, in
        similar steps."""
        share = stress_colours(np.linspace(0, 1, 9)) / 255
        linear = np.where(share > 0.04045, ((share + 0.055) / 1.055) ** 2.4, share / 12.92)
        luminance = linear @ [0.2126, 0.7152, 0.0722]
        steps = -np.diff(116 * np.cbrt(luminance) - 16)
        self.assertGreater(steps.min(), 4)
        self.assertLess(steps.max(), 16)

    def test_elements_of_beams_have_the_largest_stress_of_their_points(self):
        shot = self.shot(self.path("run.h5"), 3, size=(400, 300))
        surfaces = shot.surfaces[0]
        place, cells, values = surfaces.stressed[0]
        np.testing.assert_allclose(values, np.tile([1e7, 2e7, 3e7, 4e7], (3, 1)))
        colours = shot.at(1)[0].colours[place, :3]
        for element in range(4):  # the scale is that of the body, which has the larger stress
            np.testing.assert_array_equal(np.unique(colours[cells == element], axis=0), [stress_colours(np.array(1e7 * (element + 1) / shot.highest))])
        alone = self.shot(self.path("run.h5"), 3, size=(400, 300), hide=["rod"])
        self.assertEqual(alone.highest, 4e7)

    def test_a_beam_without_bodies_has_a_scale(self):
        item, records = drawn_results.stressed_beam()
        shot = self.shot(drawn_results.write_results(self.path("beam.h5"), {"n": drawn_results.resting(3)}, [item], extra=records), 3, size=(400, 300))
        self.assertEqual(shot.highest, 1e8)
        place, cells, _ = shot.surfaces[0].stressed[0]
        np.testing.assert_array_equal(np.unique(shot.at(2)[0].colours[place, :3][cells == 0], axis=0), [ANCHORS[-1]])
        np.testing.assert_array_equal(np.unique(shot.at(2)[0].colours[place, :3][cells == 1], axis=0), [stress_colours(np.array(np.nan))])

    def test_deformation_is_magnified(self):
        plain, large = (self.shot(self.path("run.h5"), 41, size=(400, 300), scale=scale).at(10)[0].points for scale in (1, 101))
        moved = np.linalg.norm(large - plain, axis=1).max()
        self.assertAlmostEqual(moved, 100 * synthetic.STRAIN * 0.3, delta=1e-6)  # 0.3 m long

    def test_a_body_that_does_not_fit_ends_the_command(self):
        with h5py.File(self.path("box.h5"), "r+") as file:
            u = file["recovery/displacement"][()]
            del file["recovery/displacement"], file["recovery/stress"], file["recovery/stress_nodes"]
            file["recovery/displacement"] = np.concatenate([u, u], axis=1)
        self.refuse("is not the superelement of 'rod': it has 4 coordinates", "run.h5")
        os.remove(self.path("box.h5"))
        self.refuse("--superelement rod=PATH", "run.h5")


class CheckedModels(Pictures):
    def test_marks_and_sentences(self):
        shots = [self.shot(drawn_results.write_check(self.path("check.h5"), **options), size=(500, 400))
                 for options in ({}, {"redundant": ["joints/second"]}, {"failure": 20 * "it does not close ", "apart": 0.02})]
        red = [(shot.at(0)[0].colours[:, 0].astype(int) - shot.at(0)[0].colours[:, 1] > 60).sum() for shot in shots]
        self.assertEqual(red[0], 0)
        self.assertGreater(red[1], 100)
        self.assertEqual(red[1], red[2])
        self.assertEqual([len(shot.said) for shot in shots[:2]], [1, 2])
        self.assertGreater(len(shots[2].said), 3)
        for shot in shots:
            picture = np.asarray(next(self.pictures(shot))).astype(int)
            self.assertEqual(picture.shape, (400, 500, 3))
            self.assertTrue(inked(picture[-shot.paper.line:]).any())
            self.assertFalse(inked(picture[:, -3:]).any(), "lines end before the edge")


class ModePictures(Pictures):
    def test_the_mode_is_over_its_state(self):
        synthetic_modes.write_whirl(self.path("whirl.h5"))
        with Results(self.path("whirl.h5")) as results:
            scenery = ModeScenery(Modes(results))
            motion = ModeMotion(scenery, 1, pictures=4, share=0.3)
            shot = Shot(motion, Look(view="x", size=(400, 400)), 4)
            images = self.drawings(shot)
            at_rest, moved = np.array([2.0, 0, 0]), motion.rows("nodes/hub/position")
            scenery.close()
        for image, place in zip(images, moved):
            (x0, y0), (x, y) = (shot.camera.pixels(point)[0].astype(int) for point in (at_rest, place))
            state, mode = image[y0, x0], image[y, x]
            self.assertTrue(inked(state) and inked(mode))
            self.assertGreater(np.hypot(x - x0, y - y0), 20)
            self.assertLess(mode.sum(), state.sum() - 100, "the state is pale")
            self.assertLess(np.ptp(state), 20, "the state is grey")


class Files(Pictures):
    def test_films_and_sheets(self):
        self.boxes()
        self.succeed("boxes.h5", "-o", "run.gif", "--frames", "5", "--size", "300x200", "--seconds", "2")
        with Image.open(self.path("run.gif")) as film:
            self.assertEqual((film.n_frames, film.size), (5, (300, 200)))
            pictures = [np.asarray(each.convert("RGB")).astype(int) for each in ImageSequence.Iterator(film)]
            self.assertEqual(film.info["duration"], 400)
        self.assertTrue(all(reddish(each).any() for each in pictures))
        for ending in ("png", "pdf", "svg"):
            self.succeed("boxes.h5", "-o", "run." + ending, "--frames", "4", "--size", "300x200")
            self.assertGreater(os.path.getsize(self.path("run." + ending)), 1000)
        with Image.open(self.path("run.png")) as sheet:
            self.assertEqual(sheet.size[0], 600)  # two by two
        with open(self.path("run.pdf"), "rb") as file:
            self.assertEqual(file.read(5), b"%PDF-")
        with open(self.path("run.svg"), encoding="utf-8") as file:
            self.assertTrue(file.read().startswith("<svg "))

    @unittest.skipUnless(shutil.which("ffmpeg") and shutil.which("ffprobe"), "ffmpeg is not installed")
    def test_mp4(self):
        self.boxes(rows=12)
        self.succeed("boxes.h5", "-o", "run.mp4", "--size", "301x201", "--seconds", "3")
        said = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-show_entries", "stream=codec_name,width,height,nb_read_frames,duration",
                               "-of", "json", self.path("run.mp4")], capture_output=True, text=True, check=True, timeout=60)
        stream, = json.loads(said.stdout)["streams"]
        self.assertEqual((stream["codec_name"], stream["width"], stream["height"], stream["nb_read_frames"]), ("h264", 302, 202, "12"))
        self.assertAlmostEqual(float(stream["duration"]), 3, delta=0.01)

    def test_several_processes_draw_the_same(self):
        shot = self.shot(self.boxes(rows=16), 16, size=(300, 300))
        np.testing.assert_array_equal(self.drawings(shot, 4), self.drawings(shot, 1))

    def test_texts_of_any_kind(self):
        for name in ("</title><script>", "Kurbel\nmit Strich - \u00e4\u03bc\u4e2d\U0001f600", "x" * 3000, ""):
            path = self.boxes(name=name)
            picture = next(self.pictures(self.shot(path, size=(300, 200))))
            self.assertEqual(picture.size, (300, 200))

    def test_wrong_options(self):
        self.boxes()
        for size in ("0", "-1", "1e6", "0x0", "800x", "800x-1", "63x100", "100x4097", "1000000x1000000", "axb", ""):
            self.refuse(f"--size '{size}': width x height in pixels is expected, each from 64 to 4096", "boxes.h5", f"--size={size}")
        self.refuse("--hide 'rde': nothing of this name is drawn; did you mean 'red'?", "boxes.h5", "--hide", "rde")
        self.refuse("there is no node 'sliedr' in the results; did you mean 'slider'?", "boxes.h5", "--follow", "sliedr")
        self.refuse("--frames is a number from 1 on", "boxes.h5", "--frames", "0")
        self.refuse("--seconds is a positive number", "boxes.h5", "--seconds", "nan")
        self.refuse("a number is expected, found 'nan'", "boxes.h5", "--scale", "nan")
        self.refuse(".gif, .mp4, .png, .pdf or .svg", "boxes.h5", "-o", "run.avi")
        self.refuse("did you mean '--follow'?", "boxes.h5", "--folow", "slider")
        self.assertEqual(sorted(os.listdir(self.folder)), ["boxes.h5"])


class Surroundings(Pictures):
    """Tests of missing programs, and of processes that could remain."""

    def environment(self, programs):
        """Returns an environment in which only these programs are found."""
        os.mkdir(self.path("bin"))
        for program in programs:
            os.symlink(shutil.which(program), self.path(f"bin/{program}"))
        return {**os.environ, "PATH": self.path("bin"), "DISPLAY": ""}

    def test_missing_programs(self):
        self.boxes()
        environment = self.environment(["setpriv"])
        self.refuse("drawing needs the program Xvfb (Debian package xvfb): run tools/install", "boxes.h5", environment=environment)
        self.refuse("need the program ffmpeg (Debian package ffmpeg)", "boxes.h5", "-o", "run.mp4", environment=environment)
        self.assertEqual(sorted(os.listdir(self.folder)), ["bin", "boxes.h5"])

    def test_without_setpriv(self):
        self.boxes()
        self.succeed("boxes.h5", "-o", "run.png", environment=self.environment(["Xvfb"]))

    def marked(self, mark):
        """Returns numbers and names of the processes whose environment contains the mark."""
        found = {}
        for number in filter(str.isdigit, os.listdir("/proc")):
            try:
                with open(f"/proc/{number}/environ", "rb") as file:
                    if mark.encode() in file.read():
                        with open(f"/proc/{number}/comm", encoding="utf-8") as name:
                            found[int(number)] = name.read().strip()
            except OSError:
                continue
        return found

    def wait_for(self, condition):
        end = time.monotonic() + 60
        while time.monotonic() < end:
            if condition():
                return True
            time.sleep(0.02)
        return False

    def test_no_process_remains(self):
        """No process remains after the end, or after a kill of those that wait for others."""
        self.boxes(rows=2000)
        mark = "BIELLE_TEST_MARK=" + self.folder
        command = [TOOL, "boxes.h5", "-o", "run.gif", "--frames", "8", "--size", "100x100"]
        environment = {**os.environ, "BIELLE_TEST_MARK": self.folder}
        subprocess.run(command, cwd=self.folder, env=environment, check=True, timeout=120, stdout=subprocess.DEVNULL)
        self.assertEqual(self.marked(mark), {})
        command[5] = "2000"
        with subprocess.Popen(command, cwd=self.folder, env=environment, stdout=subprocess.DEVNULL) as running:
            processors = len(os.sched_getaffinity(0))
            own = 2 + (processors if processors > 1 else 0)  # the waiting process, the working one, and those that draw
            self.assertTrue(self.wait_for(lambda: list(self.marked(mark).values()).count("bielle-animate") >= own), self.marked(mark))
            self.assertIn("Xvfb", self.marked(mark).values())
            for number in sorted(self.marked(mark))[:2]:
                os.kill(number, signal.SIGKILL)
            running.wait()
        self.assertTrue(self.wait_for(lambda: not self.marked(mark)), self.marked(mark))


if __name__ == "__main__":
    unittest.main()
