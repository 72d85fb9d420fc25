"""Tests of the verdict of bielle-reduce on good and bad bodies, of files that run commands, and of waiting threads."""

import os
import re
import subprocess
import unittest

import h5py

from command import PROGRAMS, CommandTest
from test_reduce import BAR, BODY
from shares import share_of_tests as load_tests  # noqa: E402,F401

# The bar is two elements thick, its ends may deform, and it has enough modes.
GOOD = (BODY.replace("size: 0.02", "size: 0.01").replace("tie: rigid", "tie: average").replace("count: 4", "count: 24"))


class Verdict(CommandTest):
    program = "bielle-reduce"

    def setUp(self):
        super().setUp()
        self.write("bar.geo", BAR)

    def said(self, text, *changes):
        """Returns the lines of the verdict on a body file."""
        for old, new in changes:
            self.assertIn(old, text)
            text = text.replace(old, new)
        self.write("body.yaml", text)
        done = self.run_program("body.yaml")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.standard_error = done.stderr
        return done.stdout[done.stdout.index("verdict: "):done.stdout.index("written: ")]

    def frequencies(self):
        with h5py.File(self.path("body.h5")) as file:
            return file["adequacy/free_frequencies"][()]

    def test_a_good_body_is_told_up_to_where(self):
        said = self.said(GOOD)
        self.assertRegex(said, r"^verdict: good up to \d+ Hz")
        self.assertRegex(said, r"the shapes of the good ones agree with a MAC of at least (0\.9\d+|1\.0000)")
        for text in ("modes: free-free frequencies up to", "the first mode left out is at", "mesh: the mesh makes the first free-free frequency about",
                     "stress under loads on the interfaces is off by about", "inertia: under accelerations"):
            self.assertIn(text, said)
        for text in ("not good", "change first", "walls:", "elements:", "ties:"):
            self.assertNotIn(text, said)
        inspected = self.run_program("--inspect", "body.h5").stdout
        self.assertEqual(inspected[inspected.index("verdict: "):], said)

    def test_too_few_modes_below_a_frequency(self):
        held_once = GOOD.replace("  right: {surface: right, tie: average}\n", "")
        said = self.said(held_once, ("count: 24", "below: 2000"))
        with h5py.File(self.path("body.h5")) as file:
            self.assertEqual(len(file["modes/frequencies"]), 2)
        found = re.search(r"the first free-free frequency, (\d+) Hz, is ([\d.]+) % too high", said)
        self.assertTrue(said.startswith("verdict: not good yet: too few modes"), said)
        few, part = self.frequencies()[0], float(found.group(2))
        self.assertGreater(part, 5)
        advice = re.search(r"change first: modes: \{below: (\d+)\}", said).group(1)
        # The advice removes the problem, and the verdict on the changed body is correct.
        better = self.said(held_once, ("count: 24", f"below: {advice}"))
        self.assertAlmostEqual(100 * (few / self.frequencies()[0] - 1), part, delta=0.2 * part)
        self.assertIn("verdict: good up to", better)

    def test_elements_of_order_1(self):
        said = self.said(GOOD, ("order: 2", "order: 1"))
        self.assertTrue(said.startswith("verdict: not good yet: a mesh that is too stiff"), said)
        self.assertIn("elements: of order 1 (tet4, wedge6 or pyramid5), which are too stiff", said)
        self.assertIn("change first: mesh: {order: 2}", said)
        part = float(re.search(r"the mesh makes the first free-free frequency about ([\d.]+) % too high", said).group(1))
        stiff = self.frequencies()[0]
        self.said(GOOD)
        truth = 100 * (stiff / self.frequencies()[0] - 1)  # 37 %
        self.assertGreater(part, truth / 2)
        self.assertLess(part, truth)

    def test_walls_one_element_thick(self):
        self.write("bar.geo", BAR.replace("0.2, 0.02, 0.02", "0.2, 0.1, 0.005"))
        said = self.said(GOOD)
        self.assertRegex(said, r"^verdict: .*good up to \d+ Hz.*, if one element through its walls is enough|^verdict: not good yet")
        self.assertRegex(said, r"walls: below [6-9]\d % of its surface the body is one element thick")

    def test_rigid_ties_are_told_what_they_do(self):
        said = self.said(GOOD, ("tie: average", "tie: rigid"))
        self.assertRegex(said, r"ties: rigid ones \(left, right\) hold frequencies up to \d+ Hz at least [\d.]+( to [\d.]+)? % higher")

    def test_a_size_in_millimetres(self):
        self.said(GOOD, ("size: 0.01", "size: 12"))
        self.assertIn("warning: body.yaml:4: mesh: a size of 12 m is more than the body, which is 200 mm long: sizes are in "
                      "metres, whatever the unit of the geometry; was 12e-3 meant?", self.standard_error)
        self.said(GOOD)
        self.assertNotIn("meant?", self.standard_error)

    def test_a_file_from_before_has_no_verdict(self):
        self.said(GOOD)
        with h5py.File(self.path("body.h5"), "r+") as file:
            del file["adequacy"]
            del file.attrs["checksum"]
        done = self.run_program("--inspect", "body.h5")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn("verdict: ", done.stdout)


class Scripts(CommandTest):
    program = "bielle-reduce"

    def test_commands_of_a_geometry_are_refused_unless_allowed(self):
        self.write("body.yaml", BODY)
        for call in ("SystemCall", "NonBlockingSystemCall"):
            self.write("bar.geo", f'{call} "touch trace";\n' + BAR)
            for arguments in (["body.yaml"], ["--list", "bar.geo"], ["--list", "body.yaml"]):
                self.expect_refusal(1, *arguments, says=["bar.geo' starts another program (SystemCall), which a geometry may "
                                                         "not; --allow-system-calls lets it"])
        self.write("other.geo", 'SystemCall "touch trace";\n')
        self.write("bar.geo", 'Include "other.geo";\n' + BAR)
        self.expect_refusal(1, "body.yaml", says=["body.yaml:2: geometry", "starts another program"])
        trace = os.path.join(self.folder, "trace")
        self.assertFalse(os.path.exists(trace))
        self.assertEqual(self.run_program("body.yaml", "--allow-system-calls", "--quiet").returncode, 0)
        self.assertTrue(os.path.exists(trace))
        self.expect_refusal(1, "--inspect", "body.h5", "--allow-system-calls", says=["--inspect reads no geometry"])

    def test_a_geometry_that_ends_the_reader(self):
        self.write("body.yaml", BODY)
        self.write("bar.geo", BAR + "Exit;\n")
        for arguments in (["body.yaml"], ["--list", "bar.geo"]):
            self.expect_refusal(1, *arguments, says=["bar.geo' ends gmsh before it is read to its end: remove 'Exit;'"])


class Threads(CommandTest):
    program = "bielle-reduce"

    def environment_of(self, **more):
        """Returns the settings that OpenMP displays when it is loaded; the program has to print its version."""
        environment = {name: value for name, value in os.environ.items() 
                       if name not in ("OMP_WAIT_POLICY", "GOMP_SPINCOUNT", "GLIBC_TUNABLES")}
        done = subprocess.run([os.path.join(PROGRAMS, self.program), "--version"], text=True, capture_output=True,
                              env={**environment, "OMP_DISPLAY_ENV": "verbose", **more}, check=True)
        self.assertTrue(done.stdout.startswith("bielle-reduce "), done.stdout)
        return done.stderr

    def test_threads_wait_asleep_unless_the_user_says_otherwise(self):
        self.assertIn("GOMP_SPINCOUNT = '0'", self.environment_of())
        self.assertIn("OMP_WAIT_POLICY = 'ACTIVE'", self.environment_of(OMP_WAIT_POLICY="active"))
        self.assertIn("GOMP_SPINCOUNT = '1000'", self.environment_of(GOMP_SPINCOUNT="1000"))

    def test_memory_that_is_freed_is_kept_unless_the_user_says_otherwise(self):
        def displays(**more):  # OpenMP displays its settings each time that the program is executed
            return self.environment_of(OMP_WAIT_POLICY="passive", **more).count("OPENMP DISPLAY ENVIRONMENT BEGIN")

        self.assertEqual(displays(), 2)
        self.assertEqual(displays(GLIBC_TUNABLES="glibc.malloc.check=0"), 1)

    def test_the_environment_stays_and_so_does_the_output(self):
        self.write("bar.geo", BAR)
        self.write("body.yaml", BODY)
        done = self.run_program("body.yaml", "--threads", "2")
        self.assertEqual(done.returncode, 0, done.stderr)
        for text in ("bar: 16 coordinates", "verdict: ", "written: body.h5"):
            self.assertIn(text, done.stdout)
        with open(os.path.join(self.folder, "said"), "w", encoding="utf-8") as file:
            subprocess.run([os.path.join(PROGRAMS, self.program), "body.yaml"], cwd=self.folder, stdout=file,
                           stderr=subprocess.DEVNULL, check=True)
        with open(os.path.join(self.folder, "said"), encoding="utf-8") as file:
            self.assertIn("written: body.h5", file.read())


if __name__ == "__main__":
    unittest.main()
