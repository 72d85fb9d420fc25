"""Tests the manual: its pages are run and print what they show, its fragments are valid, and the targets of its links
exist."""

import glob
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest

import jsonschema

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.normpath(os.path.join(HERE, "..", "..", ".."))
PROGRAMS = os.environ["BIELLE_PROGRAMS"]
MANUAL = os.path.join(ROOT, "mechanism", "manual")
sys.path[:0] = [os.path.join(ROOT, "tools"), os.path.join(HERE, "..", "programs"), os.path.join(HERE, "..")]

from bielle_tools.manual import pages, site  # noqa: E402
from bielle_tools.messages import InputError  # noqa: E402
from python_tool import prepare_figures  # noqa: E402
from quick_tools import quick_tools  # noqa: E402
from shares import share  # noqa: E402
from test_schema import load  # noqa: E402

MOST_WORDS = 1500  # in one page


LONG = {  # theory and derivations, measurements, tables that tools/keys writes, rules of the project
    "CHANGELOG.md", "CONTRIBUTING.md", "mechanism/keys.md", "reduce/keys.md", "mechanism/solvers/README.md", "reduce/reduction/README.md",
    "tests/performance/README.md", "tests/verification/released.md"}


def pages_of_repository():
    """Returns all pages except those of theory, and those that are long for a reason."""
    found = []
    for folder, folders, files in os.walk(ROOT):
        folders[:] = sorted(name for name in folders if name not in ("build", "theory") and not name.startswith("."))
        found += [os.path.relpath(os.path.join(folder, name), ROOT) for name in files if name.endswith(".md")]
    return sorted(set(found) - LONG)


class Manual(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def tool(self, *arguments):
        return subprocess.run([os.path.join(ROOT, "tools", "manual"), *arguments], capture_output=True, text=True, timeout=500,
                              env={**os.environ, "BIELLE_BIN": PROGRAMS})

    def page(self, text, name="page.md"):
        path = os.path.join(self.folder, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return path

    def test_getting_started_prints_what_it_shows(self):
        started = sorted(glob.glob(os.path.join(MANUAL, "getting_started", "*.md")))
        self.assertGreaterEqual(len(started), 5)
        prepare_figures()
        with quick_tools() as tools:
            environment = {**pages.environment_of(ROOT, PROGRAMS, tools), "OPENBLAS_NUM_THREADS": "1"}
            for path in started:  # later examples use files of earlier ones
                pages.run_page(path, self.folder, environment)

    def test_pages_are_run_in_one_folder(self):
        first, second = (self.page(f"```sh\n{line}\n```\n", name) for line, name in (("echo 1 >made", "first.md"), ("test -s made", "second.md")))
        done = self.tool("--run", first, "--run", second)
        self.assertEqual(done.returncode, 0, done.stderr)
        done = self.tool("--run", second)
        self.assertEqual((done.returncode, "second.md:2: 'test -s made' ended with status 1" in done.stderr), (1, True), done.stderr)

    def test_answers_print_what_they_show(self):
        found = [path for path in sorted(glob.glob(os.path.join(MANUAL, "how_do_i", "*.md")))
                 if any(pages.FILE_NAME.match(block.text) for block in pages.blocks(path))]
        self.assertGreaterEqual(len(found), 2)
        with quick_tools() as tools:
            environment = {**pages.environment_of(ROOT, PROGRAMS, tools), "OPENBLAS_NUM_THREADS": "1"}
            for path in share(found):
                with self.subTest(path), tempfile.TemporaryDirectory() as folder:
                    pages.run_page(path, folder, environment)

    def test_fragments_are_valid(self):
        done = subprocess.run([os.path.join(PROGRAMS, "bielle-mechanism"), "--schema"], capture_output=True, text=True, check=True)
        schema, count = jsonschema.Draft7Validator(json.loads(done.stdout)), 0
        for path in glob.glob(os.path.join(MANUAL, "how_do_i", "*.md")):
            for block in pages.blocks(path):
                if block.language != "yaml":
                    continue
                count += 1
                errors = [error.message[:200] for error in schema.iter_errors(load(block.text))]
                self.assertEqual(errors, [], f"{path}:{block.line}")
        self.assertGreater(count, 15)

    def test_pages_are_short(self):
        found = pages_of_repository()
        self.assertGreater(len(found), 170)
        for path in found:
            with self.subTest(path), open(os.path.join(ROOT, path), encoding="utf-8") as file:
                self.assertLess(len(file.read().split()), MOST_WORDS)

    def test_wrong_output_is_found(self):
        for shown, message in (("a 1.02\n", "does not print 'a 1.02'"), ("b 1\n", "does not print 'b 1'"),
                               ("c 3\na 1\n", "does not print"), ("a 1\nb\n...\n", "does not print 'b'")):
            with self.subTest(shown), self.assertRaisesRegex(InputError, r"page.md:6: .*" + re.escape(message)):
                place = self.page(f"text\n```sh\nprintf 'a 1\\nc 3\\n'\n```\n```text\n{shown}```\n")
                if "b\n" in shown:
                    place = self.page(f"```sh\nprintf 'a 1\\nc 3\\n'\n```\n```text\n{shown}```\n")
                pages.run_page(place, self.folder, os.environ)
        pages.run_page(self.page("```sh\nprintf 'a 1\\nb\\nc 3\\n'\n```\n```text\na 1.001\n...\nc   3\n```\n"), self.folder, os.environ)

    def test_wrong_closed_forms_are_found(self):
        shown = "```sh\nprintf 'a 1.02\\n'\n```\n```text\na 1.02\n```\n<!-- closed form{}: sqrt(1) -->\n"
        for within, message in (("", "page.md:5: the closed form sqrt.1. is 1, the command prints 'a 1.02'"), (" within 0.01", "the closed form")):
            with self.subTest(within), self.assertRaisesRegex(InputError, message):
                pages.run_page(self.page(shown.format(within)), self.folder, os.environ)
        for wrong in ("sqrt(-1)", "sqroot(1)", "1 +", "1/0", "'a'"):
            with self.subTest(wrong), self.assertRaisesRegex(InputError, "has no value"):
                pages.run_page(self.page(shown.format("").replace("sqrt(1)", wrong)), self.folder, os.environ)
        with self.assertRaisesRegex(InputError, "page.md:8: '<!-- closed form ..' belongs to no block"):
            pages.blocks(self.page(shown.format("").replace("<!--", "\n<!--")))
        pages.run_page(self.page(shown.format(" within 0.03")), self.folder, os.environ)
        self.assertEqual([block.closed_form for block in pages.blocks(os.path.join(self.folder, "page.md"))], [None, "sqrt(1)"])

    def test_commands_that_are_not_run(self):
        page = self.page("<!-- not run: it fails -->\n```sh\nfalse\n```\n```sh\ntouch made\n```\n")
        pages.run_page(page, self.folder, os.environ)
        self.assertTrue(os.path.exists(os.path.join(self.folder, "made")))
        self.assertEqual([block.not_run for block in pages.blocks(page)], ["it fails", None])
        with self.assertRaisesRegex(InputError, "no command before it"):
            pages.run_page(self.page("<!-- not run: it fails -->\n```sh\nfalse\n```\n```text\na\n```\n"), self.folder, os.environ)

    def test_failing_commands_are_found(self):
        with self.assertRaisesRegex(InputError, r"page.md:3: 'false' ended with status 1"):
            pages.run_page(self.page("```sh\ntrue\nfalse\n```\n"), self.folder, os.environ)
        with self.assertRaisesRegex(InputError, "no command before it"):
            pages.run_page(self.page("```text\na\n```\n"), self.folder, os.environ)

    def test_sources_of_the_site(self):
        site.write_sources(ROOT, self.folder)
        copied = glob.glob(os.path.join(self.folder, "**", "*.md"), recursive=True)
        self.assertGreater(len(copied), 25)
        for path in copied:
            with open(path, encoding="utf-8") as file:
                text = re.sub(r"```.*?```|`[^`\n]*`", "", file.read(), flags=re.DOTALL)
            for target in site.LINK.findall(text):
                target = target.partition("#")[0]
                if target and ":" not in target and not target.endswith(".png"):
                    found = os.path.normpath(os.path.join(os.path.dirname(path), target))
                    original = os.path.normpath(os.path.join(os.path.dirname(os.path.join(ROOT, os.path.relpath(path, self.folder))), target))
                    self.assertTrue(os.path.exists(found) or os.path.isdir(original), f"{path}: {target}")

    def test_wrong_options(self):
        done = self.tool("--run", os.path.join(self.folder, "none.md"))
        self.assertEqual((done.returncode, "none.md" in done.stderr), (1, True), done.stderr)


if __name__ == "__main__":
    unittest.main()
