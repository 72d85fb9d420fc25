"""Runs the built programs as a user does, each test in its own folder: exit status, standard output, standard error."""

import os
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from in_folder import InFolder  # noqa: E402

PROGRAMS = os.environ["BIELLE_PROGRAMS"]  # folder of the built programs, set by ctest


class CommandTest(InFolder):
    program = ""  # name of the program under test

    def run_program(self, *arguments, timeout=120):
        return subprocess.run([os.path.join(PROGRAMS, self.program), *arguments], cwd=self.folder, text=True,
                              capture_output=True, stdin=subprocess.DEVNULL, timeout=timeout)

    def expect_refusal(self, status, *arguments, says=()):
        """Asserts that the program ends with the status, and with one line on standard error that contains every text
        of `says`."""
        done = self.run_program(*arguments)
        self.assertEqual(done.returncode, status, done.stderr)
        lines = [line for line in done.stderr.splitlines() if ": error: " in line]
        self.assertEqual(len(lines), 1, done.stderr)
        self.assertTrue(lines[0].startswith(self.program + ": error: "), lines[0])
        for text in says:
            self.assertIn(text, lines[0])
        return done

    def summary(self, model):
        """Returns the output of the program for the text of a model, which must run."""
        self.write("model.yaml", model)
        done = self.run_program("model.yaml")
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout
