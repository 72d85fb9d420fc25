"""Tests that the deliberate errors of tests/mutation can be made: the text of each occurs once in its source."""

import os
import subprocess
import unittest

MUTATE = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", "..", "mutation", "mutate"))


class Mutations(unittest.TestCase):
    def test_each_text_stands_once(self):
        done = subprocess.run(["/usr/bin/python3", "-B", MUTATE, "--list"], capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"\d+ mutations\n$")


if __name__ == "__main__":
    unittest.main()
