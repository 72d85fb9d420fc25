"""Tests that the files that `tools/keys` writes from the tables of keys are up to date."""

import os
import runpy
import subprocess
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.normpath(os.path.join(HERE, "..", "..", ".."))
KEYS = os.path.join(ROOT, "tools", "keys")


def table(keys):
    return {"description": "A thing.", "properties": keys, "additionalProperties": False}


SCHEMA = {"definitions": {
    "spring": table({
        "stiffness": {"anyOf": [{"type": "number"}, {"type": "array", "items": {"$ref": "#/definitions/curve_2"}}],
                      "description": "A | B.\n\nnumber [N/m] greater than 0; or list: keys of a curve; required"},
        "at": {"description": "Two points.\n\nlist of 2: list of 3: number [m]; default: [[0, 0, 0], [0, 0, 0]]"},
        "range": {"description": "Ends.\n\n[number [m] of at least 0, number [m] of at least 0]; or `~`"}}),
    "curve_2": table({"table": {"description": "A file.\n\nfile (table); required"}}),
    "element": {"if": {}}}}


class Keys(unittest.TestCase):
    def test_files_are_up_to_date(self):
        done = subprocess.run([KEYS, "--check", "--programs", os.environ["BIELLE_PROGRAMS"]],
                              capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


class TablesOfTheManual(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.tool = runpy.run_path(KEYS)

    def filled(self, text):
        return self.tool["with_tables"]("page.md", text, SCHEMA, "keys.md")

    def test_a_table_replaces_the_text_between_the_markers(self):
        text = "before\n<!-- keys: spring: at, stiffness -->\nold\n<!-- end of keys -->\nafter\n"
        new = ("before\n<!-- keys: spring: at, stiffness -->\n\n| key | value | default | |\n|---|---|---|---|\n"
               "| `at` | 2 x 3 numbers [m] | [[0, 0, 0], [0, 0, 0]] | Two points. |\n"
               "| `stiffness` | number [N/m] > 0; or list: keys of [a curve](keys.md#curve_2) | required | A \\| B. |\n"
               "\n<!-- end of keys -->\nafter\n")
        self.assertEqual(self.filled(text), new)
        self.assertEqual(self.filled(new), new)

    def test_all_keys_without_a_list(self):
        rows = self.filled("<!-- keys: spring -->\n<!-- end of keys -->").split("\n")[4:-2]
        self.assertEqual([row.split("`")[1] for row in rows], ["stiffness", "at", "range"])
        self.assertIn("| 2 numbers [m] >= 0; or `~` |", rows[2])

    def test_faults_are_named(self):
        end = "\n<!-- end of keys -->"
        for text, sentence in {
                "\n<!-- keys: sprin -->" + end: "page.md:2: there are no keys of 'sprin'; did you mean 'spring'?",
                "<!-- keys: element -->" + end: "page.md:1: there are no keys of 'element'",
                "<!-- keys: spring: stifness -->" + end: "page.md:1: 'spring' has no key 'stifness'; did you mean "
                                                            "'stiffness'?",
                "<!-- keys spring -->" + end: "page.md:1: expected '<!-- keys: THING -->' or "
                                              "'<!-- keys: THING: KEY, KEY -->'",
                "<!-- keys: spring -->\ntext": "page.md: the last table has no '<!-- end of keys -->'",
                "<!-- keys: spring -->\n<!-- keys: spring -->" + end:
                    "page.md:2: the table before has no '<!-- end of keys -->'",
                "text" + end: "page.md:2: no '<!-- keys: ..' begins a table here"}.items():
            with self.subTest(text), self.assertRaises(SystemExit) as stopped:
                self.filled(text)
            self.assertEqual(stopped.exception.code, sentence)


if __name__ == "__main__":
    unittest.main()
