"""Runs the built programs as a user does: exit status, standard output, standard error, in a folder of its own."""

import os
import subprocess
import sys
import tempfile
import unittest

PROGRAMS = os.environ["BIELLE_PROGRAMS"]  # folder of the built programs, set by ctest


class CommandTest(unittest.TestCase):
    program = ""  # name of the program under test

    def setUp(self):
        self._folder = tempfile.TemporaryDirectory()
        self.addCleanup(self._folder.cleanup)
        self.folder = self._folder.name

    def write(self, name, text):
        path = os.path.join(self.folder, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return path

    def run_program(self, *arguments, timeout=120):
        return subprocess.run([os.path.join(PROGRAMS, self.program), *arguments], cwd=self.folder, text=True,
                              capture_output=True, stdin=subprocess.DEVNULL, timeout=timeout)

    def expect_refusal(self, status, *arguments, says=()):
        """The program ends with the status and one line on standard error that holds every text of `says`."""
        done = self.run_program(*arguments)
        self.assertEqual(done.returncode, status, done.stderr)
        lines = [line for line in done.stderr.splitlines() if ": error: " in line]
        self.assertEqual(len(lines), 1, done.stderr)
        self.assertTrue(lines[0].startswith(self.program + ": error: "), lines[0])
        for text in says:
            self.assertIn(text, lines[0])
        return done
