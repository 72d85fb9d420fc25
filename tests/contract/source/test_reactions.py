"""Tests that reported and compared values come from reactions of smallest norm; only equations use multipliers
themselves."""

import os
import re
import unittest

ROOT = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", "..", ".."))
FOLDERS = ("laws", "contacts", "measures", "elements", "joints", "hydraulics", "analyses", "session", "io", "python")
# Functions that write parts of the equations of motion, or compare the unknowns in them.
EQUATIONS = {"add_residual", "add_tangent", "add_kept", "add_kept_tangent", "evaluate_motion", "collect_unknowns"}
FUNCTION = re.compile(r"(\w+)\([^()]*\bLocalState& ")
MULTIPLIERS = re.compile(r"[.>]multiplier\(\)")


def readers(text):
    """Names of the functions of a state that read multipliers themselves."""
    found, function = set(), None
    for line in text.splitlines():
        code = line.split("//")[0]
        for token in re.finditer(f"{FUNCTION.pattern}|{MULTIPLIERS.pattern}", code):
            if token.group(1):
                function = token.group(1)
            else:
                found.add(function)
    return found


def sources():
    for folder in FOLDERS:
        for path, _, names in os.walk(os.path.join(ROOT, "mechanism", folder)):
            for name in sorted(names):
                if name.endswith((".cpp", ".hpp")):
                    yield os.path.join(path, name)


class Reactions(unittest.TestCase):
    def test_outputs_and_conditions_read_reactions(self):
        faults, equations = [], 0
        for path in sources():
            with open(path, encoding="utf-8") as file:
                functions = readers(file.read())
            equations += len(functions & EQUATIONS)
            faults += [f"{os.path.relpath(path, ROOT)}: {name}" for name in functions - EQUATIONS]
        self.assertGreater(equations, 10)
        self.assertEqual(faults, [], "read LocalState::reaction() there")

    def test_the_rule_itself(self):
        self.assertEqual(readers("void A::write_output(const LocalState& s, double* values) const {\n  values[0] = s.multiplier()[0];\n}"),
                         {"write_output"})
        self.assertEqual(readers("double force(const LocalState& s) const final { return -s.multiplier()[0]; }"), {"force"})
        self.assertEqual(readers("void A::add_residual(const LocalState& s, Vector r) const {\n  r += s.multiplier();\n}\n"
                                 "void A::calc_event_functions(const LocalState& s, Vector v) const {\n  v[0] = s.reaction()[0];\n}"),
                         {"add_residual"})
        self.assertEqual(readers("void A::add_residual(const LocalState& s) const {\n  // of s.multiplier()\n}"), set())


if __name__ == "__main__":
    unittest.main()
