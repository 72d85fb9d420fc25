"""Tests that the options of commands, files and headings that the pages name exist."""

import glob
import os
import re
import subprocess
import sys
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
REPOSITORY = os.path.abspath(os.path.join(HERE, "..", "..", ".."))
PROGRAMS = os.environ["BIELLE_PROGRAMS"]
sys.path.insert(0, os.path.dirname(HERE))

from python_tool import TOOLS, run_python_tool  # noqa: E402
from quick_tools import INTERPRETER  # noqa: E402

COMMANDS = ["keys", "bielle-plot", "bielle-animate", "bielle-paraview", "bielle-rainflow", "bielle-table", "bielle-view", "bielle-loads", "bielle-exchange", "bielle-study", "install", "demo",
         "test", "tidy", "verify", "package", "convert_mesh.py", "manual", "gallery"]
OTHERS = {"--preset", "--build", "--install", "--prefix",  # options of CMake
          "--hostfile"}  # options of mpirun


def readmes():
    for folder, folders, files in os.walk(REPOSITORY):
        folders[:] = [name for name in folders if name not in ("build", ".git") and not name.startswith(".")]
        for name in files:
            if name.endswith(".md") and name != "CHANGELOG.md":  # names former things
                yield os.path.join(folder, name)


def anchor(heading):
    """Returns the anchor that GitHub makes from a heading."""
    return re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-")


class Readmes(unittest.TestCase):
    def setUp(self):
        self.texts = {}
        for path in readmes():
            with open(path, encoding="utf-8") as file:
                self.texts[path] = file.read()

    def help(self, command):
        path = os.path.join(PROGRAMS if command in ("bielle-reduce", "bielle-mechanism") else TOOLS, command)
        with open(path, "rb") as file:
            in_python = file.readline() == INTERPRETER
        done = run_python_tool(path, ["--help"]) if in_python else subprocess.run([path, "--help"], capture_output=True, text=True, timeout=60,
                                                                                  stdin=subprocess.DEVNULL)
        self.assertEqual((done.returncode, done.stderr), (0, ""), command)
        return done.stdout

    def test_options_are_those_of_the_commands(self):
        known = set(OTHERS)
        for command in ("bielle-reduce", "bielle-mechanism", *COMMANDS):
            known.update(re.findall(r"--[a-z][a-z-]*", self.help(command)))
        for path, text in self.texts.items():
            if os.sep + "tests" + os.sep in path:
                continue
            for code in re.findall(r"```(?:sh)?\n(.*?)```|`([^`\n]+)`", text, re.DOTALL):
                for option in re.findall(r"(?<![\w-])--[a-z][a-z-]*", "".join(code)):
                    self.assertIn(option, known, path)

    def test_links_lead_somewhere(self):
        for path, text in self.texts.items():
            for target in re.findall(r"\]\(([^)\s]+)\)", text):
                made_by_the_page = f" -o {target}" in text
                if re.match(r"\w+://", target) or made_by_the_page:
                    continue
                name, _, heading = target.partition("#")
                file = os.path.normpath(os.path.join(os.path.dirname(path), name)) if name else path
                self.assertTrue(os.path.exists(file), f"{path}: {target}")
                if heading:
                    with open(file, encoding="utf-8") as opened:
                        headings = re.findall(r"^#+ (.*)$", opened.read(), re.MULTILINE)
                    self.assertIn(heading, [anchor(found) for found in headings], path)

    def test_paths_exist(self):
        folders = "|".join(name for name in os.listdir(REPOSITORY) if os.path.isdir(os.path.join(REPOSITORY, name))
                           and name not in ("build", ".git"))
        for path, text in self.texts.items():
            for name in re.findall(rf"[`\s](?:\./)?((?:{folders})/[\w./-]+[A-Za-z0-9])(?![\w*<{{])", text):
                nearby = os.path.join(os.path.dirname(path), name)
                if name.endswith(".h5"):  # files that commands write
                    continue
                found = [place for start in (os.path.join(REPOSITORY, name), nearby) for place in (start, *glob.glob(start + ".*"))]
                self.assertTrue(any(map(os.path.exists, found)), f"{path}: {name}")


if __name__ == "__main__":
    unittest.main()
