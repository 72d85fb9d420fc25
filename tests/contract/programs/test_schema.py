"""Tests of the JSON schemas of both programs: valid files pass, and files that the programs refuse because of a key
fail."""

import glob
import json
import os
import re
import subprocess
import sys
import unittest

import jsonschema
import yaml

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.normpath(os.path.join(HERE, "..", "..", ".."))
PROGRAMS = os.environ["BIELLE_PROGRAMS"]
sys.path.insert(0, os.path.join(HERE, "..", "fuzz"))

import test_fuzz_yaml  # noqa: E402


def load(text):
    """The programs read YAML 1.2, in which `on` and `yes` are words."""
    class Loader(yaml.SafeLoader):
        pass

    Loader.yaml_implicit_resolvers = {
        letter: [(tag, pattern) for tag, pattern in resolvers if tag not in
                 ("tag:yaml.org,2002:bool", "tag:yaml.org,2002:timestamp", "tag:yaml.org,2002:int")]
        for letter, resolvers in yaml.SafeLoader.yaml_implicit_resolvers.items()}
    Loader.add_implicit_resolver("tag:yaml.org,2002:bool", re.compile("^(true|True|TRUE|false|False|FALSE)$"), list("tTfF"))
    Loader.add_implicit_resolver("tag:yaml.org,2002:int", re.compile("^[-+]?[0-9]+$"), list("-+0123456789"))
    return yaml.load(text, Loader)


class Schemas(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.schemas = {}
        for program in ("bielle-mechanism", "bielle-reduce"):
            done = subprocess.run([os.path.join(PROGRAMS, program), "--schema"], capture_output=True, text=True, check=True)
            schema = json.loads(done.stdout)
            jsonschema.Draft7Validator.check_schema(schema)
            cls.schemas[program] = jsonschema.Draft7Validator(schema)

    def errors(self, program, text):
        return [f"{'.'.join(str(part) for part in error.absolute_path)}: {error.message[:200]}"
                for error in self.schemas[program].iter_errors(load(text))]

    def test_all_examples_are_valid(self):
        for program, pattern in (("bielle-mechanism", "mechanism/examples/*.yaml"), ("bielle-reduce", "meshes/*.yaml")):
            paths = glob.glob(os.path.join(ROOT, pattern))
            self.assertGreater(len(paths), 5)
            for path in paths:
                with self.subTest(os.path.basename(path)), open(path, encoding="utf-8") as file:
                    self.assertEqual(self.errors(program, file.read()), [])

    def test_models_of_the_fuzz_are_valid(self):
        self.assertEqual(self.errors("bielle-mechanism", test_fuzz_yaml.MECHANISM), [])
        self.assertEqual(self.errors("bielle-reduce", test_fuzz_yaml.BODY), [])

    def test_files_of_the_pages_about_the_language_are_valid(self):
        for name in ("README.md", "parts.md"):
            with open(os.path.join(ROOT, "mechanism", "language", name), encoding="utf-8") as file:
                blocks = re.findall(r"```yaml\n(.*?)```", file.read(), re.DOTALL)
            self.assertGreater(len(blocks), 2, name)
            for block in blocks:
                self.assertEqual(self.errors("bielle-mechanism", block), [], block)

    def test_every_misspelt_key_is_invalid_where_it_stands(self):
        for program, text in (("bielle-mechanism", test_fuzz_yaml.MECHANISM), ("bielle-reduce", test_fuzz_yaml.BODY)):
            model = load(text)
            chosen_by_users = {("parameters",), ("nodes",), ("elements",), ("joints",), ("drives",), ("loads",), ("materials",),
                               ("regions",), ("interfaces",), ("joints", "play", "contact")}
            tried = 0
            for path, holder, key in self.keys_below(model, ()):
                if path in chosen_by_users or key == "type":
                    continue
                value = holder.pop(key)
                holder[key + "x"] = value
                with self.subTest(program=program, path=path, key=key):
                    self.assertNotEqual(list(self.schemas[program].iter_errors(model)), [])
                    tried += 1
                del holder[key + "x"]
                holder[key] = value
            self.assertGreater(tried, 20)

    def keys_below(self, value, path):
        if isinstance(value, dict):
            for key in list(value):
                yield path, value, key
                yield from self.keys_below(value[key], path + (key,))
        elif isinstance(value, list):
            for item in value:
                yield from self.keys_below(item, path)


if __name__ == "__main__":
    unittest.main()
