"""Tests the explanations of messages: each message is in the sources, each key exists, and each entry has cause and
cure."""

import glob
import json
import os
import re
import sys
import unittest

REPOSITORY = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", "..", ".."))
sys.path.insert(0, os.path.join(REPOSITORY, "tools"))

from bielle_tools.manual import source_messages  # noqa: E402

PAGES = os.path.join(REPOSITORY, "mechanism", "manual", "messages", "[a-z]*.md")
# Other words in code of the pages: functions of formulas, options and words of other programs, placeholders.
OTHER_WORDS = {
    "if", "sign", "max", "min", "step", "spline", "cos", "pi", "nu_xy", "nu_yx", "equivalence", "created_by", "true", "t", "x"}


def words_of_schemas():
    """Returns keys and words of the input files, and types of their entries."""
    words = set()

    def collect(value):
        if isinstance(value, dict):
            words.update(value.get("properties", {}))
            words.update(each for each in value.get("enum", []) if isinstance(each, str))
            if isinstance(value.get("const"), str):
                words.add(value["const"])
            for each in value.values():
                collect(each)
        elif isinstance(value, list):
            for each in value:
                collect(each)

    for name in "mechanism/mechanism.schema.json", "reduce/body.schema.json":
        with open(os.path.join(REPOSITORY, name), encoding="utf-8") as file:
            collect(json.load(file))
    return words


class Explanations(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.entries = []
        for path in sorted(glob.glob(PAGES)):
            with open(path, encoding="utf-8") as file:
                page = file.read()
            cls.entries += [(os.path.basename(path), name, *entry) for name, entry in source_messages.explained(page).items()]
        cls.literals = source_messages.literals(REPOSITORY)

    def test_there_are_many(self):
        self.assertGreaterEqual(len(self.entries), 100)
        self.assertGreater(sum(literal.message for literal in self.literals), 1000)

    def test_names_are_unique_anchors(self):
        names = [name for _, name, _, _ in self.entries]
        self.assertEqual(sorted(set(names)), sorted(names))
        for name in names:
            self.assertRegex(name, r"^[a-z]+(-[a-z]+)+$")

    def test_each_message_is_in_the_sources(self):
        texts = [literal.text for literal in self.literals]
        for page, name, messages, _ in self.entries:
            self.assertTrue(messages, f"{page}: {name} has no message")
            for message in messages:
                with self.subTest(f"{page}: {name}", message=message):
                    self.assertGreater(len("".join(source_messages.fixed_texts(message))), 10)
                    self.assertTrue(any(source_messages.contains(text, message) for text in texts))

    def test_each_entry_has_cause_and_cure(self):
        for page, name, _, text in self.entries:
            with self.subTest(f"{page}: {name}"):
                paragraphs = text.split("\n\n")
                self.assertEqual([paragraph.split(" ")[0] for paragraph in paragraphs], ["**Cause.**", "**Cure.**"])

    def test_keys_of_the_cures_exist(self):
        words = words_of_schemas() | OTHER_WORDS
        for page, name, _, text in self.entries:
            for code in re.findall(r"`([^`]+)`", text):
                if re.match(r"-|bielle|BIELLE|[.<]|apt |h5dump |ulimit |\w+\.py|[\w.]+/", code):  # commands and files
                    continue
                plain = re.sub(r'"[^"]*"', "", code)
                for word in re.findall(r"\b([a-z_]{2,})\b(?=\s*[:(]|$)", plain):
                    with self.subTest(f"{page}: {name}", code=code):
                        self.assertIn(word, words)

    def test_literals_are_read_as_the_compiler_reads_them(self):
        source = ('// "no" literal\nvoid f() {\n  const char c = \'"\';\n  throw InputError(fmt::format("a {:.3g} of \\"x\\" "\n'
                  '      // comment\n      "and {{b}}{}", 1, name("second")));\n  log("plain");\n  g(R"(raw {} text)");\n}\n')
        found = [(literal.line, literal.text, literal.message) for literal in source_messages.literals_of(source)]
        self.assertEqual(found, [(4, 'a .. of "x" and {b}..', True), (6, "second", True), (7, "plain", False), (8, "raw .. text", False)])

    def test_a_message_that_has_gone_is_found(self):
        self.assertFalse(source_messages.contains("the equations are singular", "the equations were singular"))
        self.assertFalse(source_messages.contains("b before a", "a .. b"))
        self.assertTrue(source_messages.contains("t = 3 s: a before b", "a .. b"))


if __name__ == "__main__":
    unittest.main()
