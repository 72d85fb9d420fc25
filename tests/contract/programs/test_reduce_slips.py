"""Tests of mistakes of users of bielle-reduce: units, sizes, the output file, a full disk, a killed run."""

import os
import resource
import signal
import subprocess
import time
import unittest

import h5py

from bar_body import BarTest
from command import PROGRAMS
from test_reduce import BAR, BODY
from shares import share_of_tests as load_tests  # noqa: E402,F401


class Slips(BarTest):
    geometry = BAR

    def body(self, old="", new=""):
        self.assertIn(old, BODY)
        self.write("body.yaml", BODY.replace(old, new))

    def test_a_forgotten_unit_is_found_before_anything_is_meshed(self):
        self.write("bar.geo", BAR.replace("0.2, 0.02, 0.02", "200, 20, 20"))
        self.body()  # The number of elements of 20 mm in 200 m x 20 m x 20 m is 8e4 m^3 / (0.02 m)^3 times 8
        self.expect_refusal(1, "body.yaml", says=["body.yaml:4: mesh: elements of 20 mm would be about 8e+10",
                                                  "the body is 200 m long", "is the geometry's length_unit m"])
        self.body("length_unit: m", "length_unit: mm")
        self.assertEqual(self.run_program("body.yaml", "--quiet").returncode, 0)

    def test_sizes_that_are_far_too_small(self):
        self.body("size: 0.02", "size: 1e-5")
        self.expect_refusal(1, "body.yaml", says=["body.yaml:4: mesh", "elements of 0.01 mm", "20 million"])
        self.body("size: 0.02", "sizes: {left: 1e-6}, size: 0.02")
        self.expect_refusal(1, "body.yaml", says=["body.yaml:4: mesh", "elements of 0.001 mm"])

    def test_a_shape_that_selects_nothing_is_refused_with_the_surfaces_meshed_only(self):
        self.body("surface: right", "surface: {plane: {point: [0.3, 0, 0], normal: [1, 0, 0]}}")
        self.expect_refusal(1, "body.yaml", says=["body.yaml:10: interfaces.right.surface: no surface of the body lies on"])

    def test_values_that_no_material_has_are_warned(self):
        self.body("young: 210e9, poisson: 0.3, density: 7850", "young: 210e3, poisson: 0.3, density: 7.85")
        done = self.run_program("body.yaml", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("warning: body.yaml:6: materials.steel.young: is 210000 meant? Solids have 1e6", done.stderr)
        self.assertIn("warning: body.yaml:6: materials.steel.density: is 7.85 meant? Solids have 25", done.stderr)
        for damping in ("2", "[0.02, 2]"):
            self.body("count: 4}", f"count: 4}}\ndamping: {{ratio: {damping}}}")
            self.assertIn("warning: body.yaml:12: damping.ratio: is 2 meant? 1 is critical damping",
                          self.run_program("body.yaml", "--quiet").stderr)
        self.body("count: 4}", "count: 4}\ndamping: {ratio: [0.02, 0.05]}")
        self.assertNotIn("meant?", self.run_program("body.yaml", "--quiet").stderr)

    def test_an_interface_node_with_its_position_in_millimetres(self):
        self.body("surface: right, tie: rigid", "surface: right, tie: rigid, position: [200, 0, 0]")
        self.expect_refusal(1, "body.yaml", says=["body.yaml:10: interfaces.right: its position is 200 m from its surface"])

    def test_what_only_the_mesh_tells_is_said_with_its_line(self):
        self.body("count: 4", "count: 60000")
        self.expect_refusal(1, "body.yaml", says=["body.yaml:11: modes.count: 60000 fixed-boundary modes are asked for"])
        self.body("count: 4", "below: 1e9")
        self.expect_refusal(1, "body.yaml", says=["body.yaml:11: modes.below: about ", "more than 1000 modes"])
        self.body("count: 4}", "count: 0}\ndamping: {ratio: [0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1]}")
        self.expect_refusal(1, "body.yaml", says=["body.yaml:12: damping.ratio: 7 values"])

    def test_a_body_without_interfaces(self):
        text = BODY[:BODY.index("  left:")] + BODY[BODY.index("modes:"):]
        self.write("body.yaml", text)
        self.expect_refusal(1, "body.yaml", says=["body.yaml:8: interfaces: expected at least one"])

    def test_list_takes_a_body_file_even_an_unfinished_one_and_warns_of_its_unit(self):
        self.write("bar.geo", BAR.replace("0.2, 0.02, 0.02", "200, 20, 20"))
        self.write("body.yaml", "geometry: bar.geo\nlength_unit: mm\n")
        done = self.run_program("--list", "body.yaml")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("read in mm as length_unit says", done.stdout)
        self.assertIn("from (0, 0, 0) m to (0.2, 0.02, 0.02) m", done.stdout)
        done = self.run_program("--list", "bar.geo")
        self.assertIn("the body is 200 m long: is length_unit right?", done.stdout)
        done = self.run_program("--list", "bar.geo", "--length-unit", "mm")
        self.assertIn("volume 1: 8e-05 m^3", done.stdout)
        self.assertNotIn("is length_unit right?", done.stdout)
        self.expect_refusal(1, "--list", "body.yaml", "--length-unit", "mm", says=["a body file has its own length_unit"])

    def test_output_that_is_no_file(self):
        self.body()
        os.mkfifo(self.path("pipe"))
        for target in ("pipe", "."):
            self.expect_refusal(1, "body.yaml", "-o", target, says=["is a folder or a device"])

    @unittest.skipIf(os.geteuid() == 0, "root may write everywhere")
    def test_a_folder_in_which_nothing_can_be_written(self):
        self.body()
        os.mkdir(self.path("closed"), 0o500)
        self.expect_refusal(1, "body.yaml", "-o", "closed/body.h5", says=["no file can be written there"])


class Interruptions(BarTest):
    geometry = BAR

    def setUp(self):
        super().setUp()
        self.reduce(BODY)
        self.path = os.path.join(self.folder, "body.h5")
        with open(self.path, "rb") as file:
            self.good = file.read()

    def start(self, **options):
        return subprocess.Popen([os.path.join(PROGRAMS, self.program), "body.yaml"], cwd=self.folder, text=True,
                                stdin=subprocess.DEVNULL, **options)

    def check_good(self):
        with open(self.path, "rb") as file:
            self.assertEqual(file.read(), self.good)
        self.assertEqual([name for name in os.listdir(self.folder) if ".partial" in name], [])

    def test_a_full_disk_leaves_the_earlier_file(self):
        for limit in (50_000, 100_000, len(self.good) - 1000):
            with self.subTest(limit=limit):
                run = self.start(stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                 preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit)))
                _, said = run.communicate(timeout=120)
                self.assertEqual(run.returncode, 2, said)
                self.assertIn("is the disk full?", said.splitlines()[-1])
                self.check_good()

    def test_output_that_cannot_be_shown(self):
        with open("/dev/full", "w", encoding="utf-8") as full:
            run = self.start(stdout=full, stderr=subprocess.PIPE)
            self.assertIn("standard output cannot be written", run.communicate(timeout=120)[1].splitlines()[-1])
            self.assertEqual(run.returncode, 2)
            run = self.start(stdout=subprocess.PIPE, stderr=full)
            run.communicate(timeout=120)
            self.assertEqual(run.returncode, 0)

    def test_killed_while_it_writes(self):
        run = self.start(stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        while run.poll() is None and not os.path.exists(self.path + ".partial"):
            time.sleep(1e-4)
        run.send_signal(signal.SIGKILL)
        run.wait(timeout=120)
        with h5py.File(self.path) as file:  # the earlier file, or the new one if the kill came too late
            self.assertEqual(file.attrs["complete"], 1)
        self.assertEqual(self.run_program("--inspect", "body.h5").returncode, 0)
        self.assertEqual(self.run_program("body.yaml", "--quiet").returncode, 0)  # remaining files have no effect


if __name__ == "__main__":
    unittest.main()
