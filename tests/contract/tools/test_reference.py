"""Tests the reference: each page has a complete example that runs and prints what the page shows, and each type has a
page."""

import glob
import json
import os
import re
import runpy
import subprocess
import sys
import tempfile
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.normpath(os.path.join(HERE, "..", "..", ".."))
PROGRAMS = os.environ["BIELLE_PROGRAMS"]
TOOLS = os.path.join(ROOT, "tools")
REFERENCE = os.path.join(ROOT, "mechanism", "manual", "reference")
BODIES = os.path.join(ROOT, "reduce", "manual")
sys.path[:0] = [TOOLS, os.path.join(HERE, "..")]

from bielle_tools.manual import pages  # noqa: E402
from quick_tools import quick_tools  # noqa: E402
from shares import share  # noqa: E402

WITHOUT_EXAMPLE = {"messages.md"}  # a page about messages of any run
# Pages and tables of keys of states, by the key that selects their type.
STATES = {"rate": ("states", "state_with_a__rate_"), "filter": ("filter", "filter"), "transfer_function": ("transfer_function", "transfer_function_2"),
          "state_space": ("state_space", "state_space_block"), "sampled": ("sampled", "sampled_state"), "delayed": ("delayed", "delay")}
SECTIONS = {"element": "elements", "joint": "joints", "analysis": "analyses"}  # folders of the reference by subject


def pages_with_examples():
    """Returns the pages about types of models and bodies; a README is the index of its folder."""
    found = glob.glob(os.path.join(REFERENCE, "*", "*.md")) + glob.glob(os.path.join(BODIES, "*.md"))
    return sorted(path for path in found if os.path.basename(path) not in {"README.md", *WITHOUT_EXAMPLE})


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def model_of(path):
    """Returns the text of the files that a page writes, which its commands run."""
    return "\n".join(block.text for block in pages.blocks(path) if pages.FILE_NAME.match(block.text))


def schema_of_mechanisms():
    done = subprocess.run([os.path.join(PROGRAMS, "bielle-mechanism"), "--schema"], capture_output=True, text=True, check=True)
    return json.loads(done.stdout)


def lines_of(schema):
    """Returns the keys that select the type of a line in a circuit, with the references to their keys."""
    return {key: value for key, value in schema["definitions"]["line"]["properties"].items() if "$ref" in value and key != "ports"}


class Reference(unittest.TestCase):
    def test_examples_run_and_print_what_the_pages_show(self):
        with quick_tools() as tools:
            environment = {**pages.environment_of(ROOT, PROGRAMS, tools), "OPENBLAS_NUM_THREADS": "1"}
            for path in share(pages_with_examples()):
                with self.subTest(os.path.relpath(path, ROOT)), tempfile.TemporaryDirectory() as folder:
                    pages.run_page(path, folder, environment)

    def test_every_page_has_a_model_commands_and_output(self):
        found = pages_with_examples()
        self.assertGreater(len(found), 100)
        for path in found:
            with self.subTest(os.path.relpath(path, ROOT)):
                languages = [block.language for block in pages.blocks(path)]
                self.assertIn("sh", languages)
                self.assertIn("text", languages)
                self.assertNotEqual(model_of(path), "")

    def test_every_type_has_a_page(self):
        variants = runpy.run_path(os.path.join(TOOLS, "keys"))["variants"]
        schema = schema_of_mechanisms()
        names = {id(table): name for name, table in schema["definitions"].items()}
        count = 0
        for thing, folder in SECTIONS.items():
            for type_name, table in variants(schema, thing):
                with self.subTest(f"{thing} {type_name}"):
                    path = os.path.join(REFERENCE, folder, f"{type_name}.md")
                    self.assert_page_of_keys(path, names[id(table)].removesuffix("_in_any_form"))
                    self.assertRegex(model_of(path), rf"\btype: {type_name}\b")
                    count += 1
        self.assertGreater(count, 45)

    def test_every_part_of_hydraulics_has_a_page(self):
        schema = schema_of_mechanisms()
        parts = {part: reference["$ref"] for part, reference in lines_of(schema).items()}
        self.assertGreater(len(parts), 8)
        things = {part: target.rsplit("/", 1)[1] for part, target in parts.items()}
        things.update(fluid="fluid", volume="volume", supply="supply", accumulator="accumulator_2", machine="machine")
        for part, thing in things.items():
            with self.subTest(part):
                path = os.path.join(REFERENCE, "hydraulics", f"{part}.md")
                self.assert_page_of_keys(path, thing)
                self.assertRegex(model_of(path), rf"\b{part}s?:|\bsupplies:")

    def test_every_type_of_state_has_a_page(self):
        keys = list(schema_of_mechanisms()["definitions"]["state"]["properties"])
        self.assertEqual(keys[:keys.index("start")], list(STATES), "the keys before `start` tell the type")
        for key, (page, thing) in STATES.items():
            with self.subTest(key):
                path = os.path.join(REFERENCE, "control", f"{page}.md")
                self.assert_page_of_keys(path, thing)
                self.assertRegex(model_of(path), rf"\b{key}:")
                self.assertTrue(any(block.closed_form for block in pages.blocks(path)))

    def assert_page_of_keys(self, path, thing):
        self.assertTrue(os.path.exists(path), path)
        self.assertRegex(read(path), re.compile(rf"^<!-- keys: {thing}( -->|:)", re.MULTILINE))

    def test_pages_of_types_have_closed_forms(self):
        found = [path for folder in ("nodes", "elements", "joints", "hydraulics") for path in glob.glob(os.path.join(REFERENCE, folder, "[a-z]*.md"))]
        self.assertGreater(len(found), 65)
        for path in found:
            with self.subTest(os.path.relpath(path, ROOT)):
                self.assertTrue(any(block.closed_form for block in pages.blocks(path)))

    def test_indices_name_their_pages(self):
        for index in glob.glob(os.path.join(REFERENCE, "*", "README.md")):
            text, folder = read(index), os.path.dirname(index)
            for name in sorted(set(os.listdir(folder)) - {"README.md"}):
                with self.subTest(os.path.relpath(os.path.join(folder, name), ROOT)):
                    self.assertIn(f"]({name}", text)


if __name__ == "__main__":
    unittest.main()
