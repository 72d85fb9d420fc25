"""Comments and documents are plain sentences: they do not begin with what, where, of or who (CONTRIBUTING.md)."""

import os
import tempfile
import unittest

import sentences

ROOT = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", "..", ".."))


class Sentences(unittest.TestCase):
    def test_openers(self):
        found = sentences.faults(ROOT)
        areas = {"mechanism (C++)", "mechanism", "reduce", "tests", "tools", "meshes", "."}
        self.assertGreaterEqual(set(found), areas)
        for area, faults in sorted(found.items()):
            with self.subTest(area):
                self.assertEqual(faults, [])

    def test_a_planted_sentence_is_found(self):
        planted = {
            "a.hpp": "int a;  ///< of the body\n/// Adds a node. What is new is its number.\n"
                     "/// @returns what is left\n",
            "b.py": '"""Reads a file.\n\nWhere it ends, nothing is read.\n"""\n\n\ndef f():\n    return 1  # who\n',
            "c.cmake": "# Of the compiler.\nset(A 1)\n",
            "d.md": "# What it does\n\nA text. Of these two the first.\n\n"
                    "| key | what it is |\n|---|---|\n\n```yaml\na: 1  # of b\n```\n",
            "e": "#!/usr/bin/env bash\n# Where the results are.\n",
        }
        with tempfile.TemporaryDirectory() as folder:
            for name, text in planted.items():
                with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                    file.write(text)
            found = sentences.faults(folder)
        self.assertEqual(sorted(fault.split(": ")[:2] for fault in found["."]), [
            ["a.hpp:1", "of"], ["a.hpp:2", "What"], ["a.hpp:3", "what"], ["b.py:3", "Where"], ["b.py:8", "who"],
            ["c.cmake:1", "Of"], ["d.md:3", "Of"], ["d.md:5", "what"], ["d.md:9", "of"], ["e:2", "Where"]])

    def test_other_texts_are_none(self):
        self.assertEqual(sentences.openers("The places where it ends. Whose they are, and what of it."), [])
        self.assertEqual(sentences.openers("@param what  the name of the thing"), [])
        literals = 'const char* a = "// what";  // the text\nauto b = R"(// Of)";\nchar c = \'"\';'
        self.assertEqual(sentences.cpp_texts(literals), [[1, "the text"]])
        self.assertEqual(sentences.python_texts('TEXT = """What it is."""\n'), [])
        self.assertEqual(sentences.hash_texts("a: 'x#what'\n"), [])
        cells = [text for _, text in sentences.markdown_texts('| "Of a node." | b |\n') if text.strip()]
        self.assertEqual(cells, [" b "])


if __name__ == "__main__":
    unittest.main()
