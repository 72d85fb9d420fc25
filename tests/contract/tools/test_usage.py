"""Tests of commands without results files: help, folder of the output, wrong words."""

import os
import subprocess
import sys
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.dirname(HERE))

from in_folder import REPOSITORY, InFolder  # noqa: E402
from python_tool import run_python_tool  # noqa: E402

TOOLS = os.path.join(REPOSITORY, "tools")
COMMANDS = {"demo": [], "gallery": ["--list", "--jobs"], "manual": ["--no-pictures", "--jobs"], "package": ["--wheel"], "verify": ["--list", "--quick"]}
WRITTEN_IN_BASH = ("demo", "package")


class Usage(InFolder):
    def command(self, name, *arguments):
        return subprocess.run([os.path.join(TOOLS, name), *arguments], cwd=self.folder, capture_output=True, text=True, timeout=60,
                              stdin=subprocess.DEVNULL, env={**os.environ, "BIELLE_BIN": os.environ["BIELLE_PROGRAMS"]})

    def tool(self, name, *arguments):
        if name in WRITTEN_IN_BASH:
            return self.command(name, *arguments)
        return run_python_tool(os.path.join(TOOLS, name), arguments, self.folder, {**os.environ, "BIELLE_BIN": os.environ["BIELLE_PROGRAMS"]}, 60)

    def test_help_names_the_output_and_all_options(self):
        for name, options in COMMANDS.items():
            for word in ("--help", "-h"):
                with self.subTest(f"{name} {word}"):
                    done = (self.command if word == "--help" else self.tool)(name, word)
                    self.assertEqual((done.returncode, done.stderr), (0, ""))
                    for option in ["-o", "FOLDER", *options]:
                        self.assertIn(option, done.stdout)
                    self.assertNotIn("set -euo", done.stdout)

    def test_wrong_words_end_the_command_before_it_works(self):
        for name, options in COMMANDS.items():
            wrong = [(["--outptu", "x"], "'--outptu' is not an option; did you mean '--output'?"), (["--fast"], "'--fast' is not an option"),
                     (["-o"], "--help shows the options"), (["--output"], "--help shows the options")]
            wrong += [([option[:-1] + "xy"], "is not an option; did you mean '" + option) for option in options]
            wrong += [(["-o", "out", "surplus"], "surplus'")]
            for arguments, sentence in wrong:
                with self.subTest(f"{name} {arguments}"):
                    done = self.tool(name, *arguments)
                    self.assertEqual((done.returncode, done.stderr.count("\n"), done.stdout), (1, 1, ""), done.stderr)
                    self.assertTrue(done.stderr.startswith(f"{name}: "), done.stderr)
                    self.assertIn(sentence, done.stderr)
                    self.assertEqual(os.listdir(self.folder), [])


if __name__ == "__main__":
    unittest.main()
