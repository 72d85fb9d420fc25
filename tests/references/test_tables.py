"""Tests that each table belongs to a script and is read by a test, and that differences from a table are reported."""
import glob
import os
import re
import unittest

import table

FOLDER = os.path.dirname(os.path.abspath(__file__))


def stems(pattern):
    return {os.path.splitext(os.path.basename(path))[0] for path in glob.glob(os.path.join(FOLDER, pattern))}


def subjects():
    """Returns the scripts that write a table."""
    found = set()
    for stem in stems("*.py"):
        with open(os.path.join(FOLDER, stem + ".py"), encoding="utf-8") as file:
            if "table.run(fill, __file__)" in file.read() and stem != "test_tables":
                found.add(stem)
    return found


class Tables(unittest.TestCase):
    def test_each_script_has_its_table_and_each_table_its_script(self):
        self.assertEqual(subjects(), stems("*.csv"))
        self.assertGreater(len(subjects()), 10)

    def test_each_table_is_read_by_a_test(self):
        read = set()
        for path in glob.glob(os.path.join(FOLDER, "..", "**", "*.?pp"), recursive=True):
            with open(path, encoding="utf-8") as file:
                read |= set(re.findall(r'ReferenceTable(?:\s+\w+)?[({]"(\w+)"', file.read()))
        for path in glob.glob(os.path.join(FOLDER, "..", "verification", "problems", "*.py")):
            with open(path, encoding="utf-8") as file:
                read |= set(re.findall(r'\b(?:row|vector)\("(\w+)"', file.read()))
        self.assertEqual(read, stems("*.csv"))

    def test_values_are_written_with_two_digits_more_than_are_claimed(self):
        for value in (3.14159265358979, -2.71828182845905e-4, 1.41421356237310e7, 9.99999999999e-9, 0):
            for digits in range(3, 13):
                within = 10.0**-digits * (abs(value) or 1)
                self.assertLess(abs(float(table.text_of(value, within)) - value), 1e-2 * within, (value, within))

    def test_nothing_of_the_program_is_used(self):
        for stem in stems("*.py"):
            with open(os.path.join(FOLDER, stem + ".py"), encoding="utf-8") as file:
                for line in file:
                    if line.startswith(("import", "from")):
                        self.assertNotIn("bielle", line, stem)


class Comparison(unittest.TestCase):
    def pair(self, value, within=1e-6):
        old, new = table.Table(), table.Table()
        old.add("a", 1.25, 1e-6)
        new.add("a", value, within)
        return old, new

    def test_a_value_within_its_claim_is_the_same(self):
        self.assertEqual(table.differences(*self.pair(1.2500009)), [])

    def test_a_value_beyond_its_claim_is_told(self):
        self.assertEqual(len(table.differences(*self.pair(1.2500011))), 1)

    def test_another_claim_is_told(self):
        self.assertEqual(len(table.differences(*self.pair(1.25, 1e-3))), 1)

    def test_rows_that_go_and_rows_that_come_are_told(self):
        old, new = self.pair(1.25)
        new.add("b", 1, 1)
        self.assertEqual(len(table.differences(old, new)), 1)
        self.assertEqual(len(table.differences(new, old)), 1)

    def test_no_number_is_no_value(self):
        with self.assertRaises(ValueError):
            table.Table().add("a", float("nan"), 1)
        with self.assertRaises(ValueError):
            table.Table().add("a", 1, 0)


if __name__ == "__main__":
    unittest.main()
