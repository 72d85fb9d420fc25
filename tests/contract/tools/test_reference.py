"""The reference: each page has a whole example that runs and prints what the page shows, and each type has a page."""

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
sys.path.insert(0, TOOLS)

from bielle_tools.manual import pages  # noqa: E402

WITHOUT_EXAMPLE = {"messages.md"}  # a page about what any run may print
SECTIONS = {"elements": "element", "joints": "joint", "analysis": "analysis"}


def pages_with_examples():
    """The pages about types, of models and of bodies; a README is the index of its folder."""
    found = glob.glob(os.path.join(REFERENCE, "*", "*.md")) + glob.glob(os.path.join(BODIES, "*.md"))
    return sorted(path for path in found if os.path.basename(path) not in {"README.md", *WITHOUT_EXAMPLE})


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def model_of(path):
    """The text of the files that a page writes, which its commands run."""
    return "\n".join(block.text for block in pages.blocks(path) if pages.FILE_NAME.match(block.text))


def uses(text, type_name):
    return re.search(rf"\btype: {type_name}\b", text) is not None


class Reference(unittest.TestCase):
    def test_examples_run_and_print_what_the_pages_show(self):
        environment = pages.environment_of(ROOT, PROGRAMS, TOOLS)
        for path in pages_with_examples():
            with self.subTest(os.path.relpath(path, ROOT)), tempfile.TemporaryDirectory() as folder:
                pages.run_page(path, folder, {**environment, "OPENBLAS_NUM_THREADS": "1"})

    def test_every_page_has_a_model_commands_and_output(self):
        found = pages_with_examples()
        self.assertGreater(len(found), 45)
        for path in found:
            with self.subTest(os.path.relpath(path, ROOT)):
                languages = [block.language for block in pages.blocks(path)]
                self.assertIn("sh", languages)
                self.assertIn("text", languages)
                self.assertNotEqual(model_of(path), "")

    def test_every_type_has_a_page(self):
        done = subprocess.run([os.path.join(PROGRAMS, "bielle-mechanism"), "--schema"], capture_output=True, text=True, check=True)
        schema = json.loads(done.stdout)
        variants = runpy.run_path(os.path.join(TOOLS, "keys"))["variants"]
        own = {path: read(path) for path in pages_with_examples() if path.startswith(REFERENCE)}
        of_sections = "\n".join(map(read, glob.glob(os.path.join(REFERENCE, "*.md"))))
        examples = "\n".join(map(read, glob.glob(os.path.join(ROOT, "mechanism", "examples", "*.yaml"))))
        names = {id(table): name for name, table in schema["definitions"].items()}
        with_page = set()
        for thing in SECTIONS.values():
            for type_name, table in variants(schema, thing):
                name = names[id(table)].removesuffix("_in_any_form")
                marker = re.compile(rf"^<!-- keys: {name}\b", re.MULTILINE)
                if any(marker.search(text) and uses(model_of(path), type_name) for path, text in own.items()):
                    with_page.add(type_name)
                    continue
                with self.subTest(type_name):
                    self.assertIn(f"`{type_name}`", of_sections)
                    self.assertTrue(uses(examples, type_name), "neither a page of its own nor an example uses it")
        analyses = {type_name for type_name, _ in variants(schema, "analysis")}
        self.assertLessEqual(analyses | {"bushing", "bearing", "ball_bearing", "roller_bearing", "journal_bearing",
                                         "clearance_hinge", "clearance_spherical", "contact"}, with_page)


if __name__ == "__main__":
    unittest.main()
