"""Tests of full disks, of disks that become full, and of insufficient address space: a message must appear, and no run
may hang."""

import os
import resource
import subprocess
import unittest

import h5py

from bar_body import BarTest
from command import PROGRAMS
from shares import share
from test_mechanism import PENDULUM
from test_reduce import BAR, BODY

MEGABYTE = 1 << 20


class Limits(BarTest):
    geometry = BAR

    def setUp(self):
        super().setUp()
        self.write("body.yaml", BODY.replace("size: 0.02, order: 2", "size: 0.04, order: 1"))
        self.write("model.yaml", PENDULUM)

    def run_limited(self, program, limits, *arguments, threads=2):
        """@returns the exit status and the last message; a run that hangs is a failure."""
        def limit():
            for kind, most in limits.items():
                resource.setrlimit(kind, (most, most))

        done = subprocess.run([os.path.join(PROGRAMS, program), *arguments, "--quiet", "--threads", str(threads)],
                              cwd=self.folder, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=120,
                              preexec_fn=limit, env={**os.environ, "OPENBLAS_NUM_THREADS": str(threads)})
        return done.returncode, (done.stderr.splitlines() or [""])[-1]

    def test_a_disk_that_is_full_from_the_start(self):
        for program, source in (("bielle-mechanism", "model.yaml"), ("bielle-reduce", "body.yaml")):
            for most in (0, 1, 1000, 4096):
                with self.subTest(program=program, most=most):
                    status, said = self.run_limited(program, {resource.RLIMIT_FSIZE: most}, source, "-o", "out.h5")
                    self.assertEqual(status, 2, said)
                    self.assertIn(f"{program}: error: ", said)
                    self.assertRegex(said, "is the disk full|disk not full")
                    self.assertEqual([name for name in os.listdir(self.folder) if "out.h5" in name], [])

    def test_a_disk_that_becomes_full_while_rows_are_written(self):
        self.write("model.yaml", PENDULUM.replace("duration: 0.1", "duration: 20"))
        status, said = self.run_limited("bielle-mechanism", {resource.RLIMIT_FSIZE: 300_000}, "model.yaml", "-o", "out.h5")
        self.assertEqual(status, 2, said)
        self.assertIn("is the disk full?", said)
        # At a limit of the file size, unlike on a full disk, HDF5 cannot extend the file to its recorded end, and often
        # cannot open it afterwards. Such a file is removed.
        if os.path.exists(os.path.join(self.folder, "out.h5")):
            with h5py.File(os.path.join(self.folder, "out.h5")) as file:
                self.assertEqual(file.attrs["complete"], 0)

    def test_every_limit_of_the_address_space_ends_in_a_sentence_or_in_success(self):
        for program, source in (("bielle-mechanism", "model.yaml"), ("bielle-reduce", "body.yaml")):
            succeeded = 0
            for megabytes in (*share(range(200, 960, 50)), 1500, 4000):
                with self.subTest(program=program, megabytes=megabytes):
                    status, said = self.run_limited(program, {resource.RLIMIT_AS: megabytes * MEGABYTE}, source, "-o", "out.h5")
                    # The loader ends with status 127 if the libraries do not fit.
                    self.assertIn(status, (0, 2, 127), said)
                    if status:
                        self.assertRegex(said, "error", said)
                        self.assertNotIn("unforeseen", said)
                    self.assertFalse(succeeded and status, f"less was enough: {said}")
                    succeeded += status == 0
            self.assertGreater(succeeded, 2)


if __name__ == "__main__":
    unittest.main()
