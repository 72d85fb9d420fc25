"""Files that are written from the tables of keys are up to date: `tools/keys` writes them."""

import os
import subprocess
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.normpath(os.path.join(HERE, "..", "..", ".."))


class Keys(unittest.TestCase):
    def test_files_are_up_to_date(self):
        done = subprocess.run([os.path.join(ROOT, "tools", "keys"), "--check", "--programs", os.environ["BIELLE_PROGRAMS"]],
                              capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main()
