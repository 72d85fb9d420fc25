"""Tests the pages about the tools: their commands are run, and must print what the pages show."""

import glob
import os
import re
import sys
import tempfile
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.normpath(os.path.join(HERE, "..", "..", ".."))
PROGRAMS = os.environ["BIELLE_PROGRAMS"]
TOOLS = os.path.join(ROOT, "tools")
sys.path[:0] = [TOOLS, os.path.join(HERE, "..")]

from bielle_tools.manual import pages  # noqa: E402
from python_tool import prepare_figures  # noqa: E402
from quick_tools import quick_tools  # noqa: E402
from shares import share  # noqa: E402

COMMANDS = ["bielle-plot", "bielle-animate", "bielle-paraview", "bielle-rainflow", "bielle-table", "bielle-view", "bielle-loads",
            "bielle-exchange", "convert_mesh.py", "tools/bielle-study", "tools/verify"]


def guide():
    return sorted(glob.glob(os.path.join(TOOLS, "guide", "*.md")))


def run_lines(path):
    """Returns the commands of a page that are run."""
    return "\n".join(block.text for block in pages.blocks(path) if block.language == "sh" and not block.not_run)


class Guide(unittest.TestCase):
    def test_commands_print_what_the_pages_show(self):
        prepare_figures()
        with quick_tools() as tools:
            environment = {**pages.environment_of(ROOT, PROGRAMS, tools), "BIELLE_BIN": PROGRAMS, "OPENBLAS_NUM_THREADS": "1"}
            for path in share(guide()):
                with self.subTest(os.path.relpath(path, ROOT)), tempfile.TemporaryDirectory() as folder:
                    # Commands in the repository are called from its root.
                    os.symlink(tools, os.path.join(folder, "tools"))
                    pages.run_page(path, folder, environment)

    def test_every_page_runs_commands_and_shows_output(self):
        self.assertGreaterEqual(len(guide()), 10)
        for path in guide():
            if os.path.basename(path) == "manual.md":  # test_manual_site builds the site
                continue
            with self.subTest(os.path.relpath(path, ROOT)):
                self.assertNotEqual(run_lines(path), "")
                self.assertIn("text", [block.language for block in pages.blocks(path)])

    def test_every_command_is_run(self):
        commands = "\n".join(map(run_lines, guide()))
        for command in COMMANDS:
            with self.subTest(command):
                self.assertRegex(commands, re.compile(rf"^{re.escape(command)} ", re.MULTILINE))

    def test_no_command_stands_outside_of_blocks_that_are_run(self):
        others = [path for pattern in ("reduce/manual/*.md", "mechanism/manual/reference/*/*.md", "mechanism/manual/getting_started/*.md")
                  for path in glob.glob(os.path.join(ROOT, pattern))]
        self.assertGreater(len(others), 100)
        for path in guide() + others:
            for block in pages.blocks(path):
                with self.subTest(f"{os.path.relpath(path, ROOT)}:{block.line}"):
                    if block.language not in {"sh", "text"}:
                        self.assertNotRegex(block.text, re.compile(r"^(\$ |bielle-\w+ |tools/\w+ |convert_mesh)", re.MULTILINE))


if __name__ == "__main__":
    unittest.main()
