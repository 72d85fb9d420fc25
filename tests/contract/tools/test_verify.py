"""Tests of tools/verify: correct problems pass; wrong references, wrong orders, crashes and NaN fail with their
name."""

import json
import math
import os
import re
import sys
import unittest
from unittest import mock

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.dirname(HERE))

from in_folder import REPOSITORY, InFolder  # noqa: E402
from python_tool import run_python_tool  # noqa: E402

sys.path.insert(0, os.path.join(REPOSITORY, "tests", "verification"))

from harness import Problem, Quantity, Study  # noqa: E402
from harness.catalogue import entries  # noqa: E402
from harness.published import COLLECTIONS  # noqa: E402
from harness.judgement import compute_problem, observed_order  # noqa: E402

PROGRAMS = os.environ["BIELLE_PROGRAMS"]
PACKAGE = os.path.join(os.path.dirname(PROGRAMS), "python")
PROBLEMS = os.path.join(REPOSITORY, "tests", "verification", "problems")

PLAIN = """
import os, signal
from harness import Problem, Quantity, Study

def compute(level):
    {body}

PROBLEM = Problem(title="{title}", subject="Samples", source="none", model="none", {more}studies=[
    Study("study", compute, [1, 2], [
        Quantity("x", "the value", "m", 2.0, source="none", tolerance=1e-3, reason="none")], parameter="run", by="")])
"""


def verify(*arguments):
    return run_python_tool(os.path.join(REPOSITORY, "tools", "verify"), arguments,
                           environment={**os.environ, "BIELLE_BIN": PROGRAMS})


class Usage(InFolder):
    def test_the_problems_are_listed_with_their_titles(self):
        done = verify("--list")
        self.assertEqual(done.returncode, 0, done.stderr)
        files = sorted(name[:-3] for name in os.listdir(PROBLEMS) if name.endswith(".py"))
        self.assertEqual([line.split()[0] for line in done.stdout.splitlines()], files)
        self.assertGreaterEqual(len(files), 20)
        self.assertRegex(done.stdout, r"(?m)^simple_pendulum +A01 Simple pendulum$")
        quick = verify("--list", "--quick").stdout.splitlines()
        self.assertTrue(0 < len(quick) < len(files))

    def test_wrong_words_are_named(self):
        for arguments, sentence in ((["simple_pendulun"],
                                     "there is no problem 'simple_pendulun'; did you mean 'simple_pendulum'?"),
                                    (["-j", "0"], "'0': expected a whole number between 1 and 1000"),
                                    (["-j", "2.5"], "'2.5': expected a whole number"),
                                    (["--fast"], "'--fast' is not an option"),
                                    (["--problems", self.path("none")], "No such file"),
                                    (["--problems", self.folder], "has no problem to compute"),
                                    (["--quick", "four_bar_loops"], "takes longer"),
                                    (["--release", "--quick"], "--release needs all problems"),
                                    (["--release", "bend_45"], "--release needs all problems"),
                                    (["--release", "--problems", self.folder], "--release needs all problems")):
            done = verify(*arguments, "-o", self.path("page"))
            self.assertEqual(done.returncode, 1, (arguments, done.stderr))
            self.assertIn(sentence, done.stderr)
            self.assertFalse(os.path.exists(self.path("page")))


class Released(unittest.TestCase):
    """Tests of the copy of the report in the sources, and of the collections."""

    def setUp(self):
        with open(os.path.join(REPOSITORY, "tests", "verification", "released.md"), encoding="utf-8") as file:
            self.text = file.read()
        self.entries = entries(PROBLEMS)

    def test_the_copy_lists_the_problems_that_there_are(self):
        listed = re.findall(r"(?m)^\| `(\w+)` \| ([^|]+) \| (\w+) \| ([^|]+) \|", self.text)
        renew = "tools/verify --release renews tests/verification/released.md"
        self.assertEqual(sorted((name, title) for name, title, _, _ in listed),
                         [(entry.name, entry["title"]) for entry in self.entries], renew)
        for name, _, verdict, share in listed:
            self.assertEqual((verdict, 0 <= float(share) <= 1), ("passed", True), name)
        for fact in ("program: bielle-mechanism ", "commit: ", "date: ", "processor: "):
            self.assertIn(f"\n- {fact}", self.text)

    def test_collections_name_problems_that_there_are_and_reasons_for_what_is_left_out(self):
        names = {entry.name for entry in self.entries}
        for collection, parts in COLLECTIONS.items():
            for part in parts:
                with self.subTest(f"{collection}: {part.name}"):
                    self.assertLessEqual(set(part.problems), names)
                    self.assertTrue(part.problems or part.remark)
                    self.assertIn(f"| {part.name} |", self.text)

    def test_numbers_of_the_iftomm_library_stand_in_titles_of_its_problems_alone(self):
        library = next(parts for collection, parts in COLLECTIONS.items() if collection.startswith("IFToMM"))
        numbered = {name for part in library for name in part.problems if re.match(r"A\d\d ", part.name)}
        self.assertEqual({entry.name for entry in self.entries if re.match(r"A\d\d ", entry["title"])}, numbered)
        for entry in self.entries:
            if entry.name in numbered:
                self.assertIn("IFToMM library", entry["source"])


@unittest.skipUnless(os.path.isdir(os.path.join(PACKAGE, "bielle")), "the Python package is not built")
class Report(InFolder):
    def test_good_and_bad_problems_on_one_page(self):
        with open(os.path.join(PROBLEMS, "four_bar.py"), encoding="utf-8") as file:
            four_bar = file.read()
        known = '**row("four_bar", "released.crank")'
        self.assertIn(known, four_bar)
        self.write("good.py", four_bar)
        self.write("wrong_reference.py",
                   four_bar.replace(known, "reference=-4.5615, known_to=1e-9"))  # it ends with 85, and differs by 2e-5
        for name, body in (("exact", "return {'x': 2.0}"), ("undefined",
                                                            "return {'x': float('nan') if level == 1 else 2.0}"),
                           ("crashing", "os.kill(os.getpid(), signal.SIGSEGV)"),
                           ("refused", "import bielle; bielle.read('nodes: {a: {positon: [0, 0, 0]}}')"),
                           ("incomplete", "return {'y': 2.0}")):
            self.write(f"{name}.py", PLAIN.format(body=body, title=f"Sample <{name}>", more=""))
        self.write("no_problem.py", "print('nothing')\n")
        self.write("no_python.py", "PROBLEM = (\n")
        self.write("binary.py", "\udcff\udcfe", errors="surrogateescape")
        os.mkdir(self.path("folder.py"))
        done = verify("--problems", os.path.relpath(self.folder), "-o", self.path("page"))
        self.assertEqual(done.returncode, 1, done.stderr)
        failed = {"binary", "wrong_reference", "undefined", "crashing", "refused", "incomplete", "no_problem",
                  "no_python"}
        self.assertIn(f"failed: {', '.join(sorted(failed))}", done.stderr)
        with open(self.path("page/results.json"), encoding="utf-8") as file:
            results = json.load(file, parse_constant=lambda word: self.fail(f"{word} is no JSON"))
        problems = {problem["name"]: problem for problem in results["problems"]}
        self.assertEqual({name for name, problem in problems.items() if not problem["passed"]}, failed)
        self.assertFalse(results["passed"])
        self.assertIn("bielle-mechanism 0.", results["machine"]["program"])
        for name, sentences in (("wrong_reference", ["the observed order is ", "expected 2 +- 0.1"]),
                                ("undefined", ["the result is not a number"]),
                                ("crashing", ["crashed: SIGSEGV"]), ("refused", ["did you mean 'position'?"]),
                                ("incomplete", ["computes no x"]),
                                ("no_problem", ["defines no PROBLEM"]), ("no_python", ["was never closed"]),
                                ("binary", ["SyntaxError"])):
            said = "\n".join(problems[name]["failures"])
            for sentence in sentences:
                self.assertIn(sentence, said, name)
                self.assertIn(sentence, done.stdout, name)
        crank, tip = problems["good"]["studies"][0]["quantities"]
        for quantity in (crank, tip):
            self.assertAlmostEqual(quantity["order"], 2, delta=0.1)
        self.assertEqual(len(problems["good"]["studies"][0]["levels"]), 4)
        self.check_page(problems)

    def check_page(self, problems):
        """The page is self-contained, and contains the same as the file for programs."""
        with open(self.path("page/index.html"), encoding="utf-8") as file:
            page = file.read()
        self.assertIn(f"8 of {len(problems)} problems failed", page)
        self.assertEqual(page.count("<svg"), 2)  # two problems have a computed refinement
        self.assertNotRegex(page, r"(src|href)=[\"'](?!#)")
        self.assertEqual(set(re.findall(r"<h3 id='(\w+)'", page)), set(problems))
        self.assertIn("Sample &lt;exact&gt;", page)
        self.assertIn("crashed: SIGSEGV", page)
        self.assertEqual(page.count("<table"), page.count("</table>"))
        self.assertNotIn("Collections</h2>", page)  # none of these problems belongs to a collection

    def test_submissions_and_collections_stand_on_the_page(self):
        done = verify("simple_pendulum", "-o", self.path("page"))
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.path("page/index.html"), encoding="utf-8") as file:
            page = file.read()
        submitted = page[page.index("In the form of the IFToMM library</h2>"):page.index("Collections</h2>")]
        self.assertEqual(submitted.count("<tr"), 1 + 4)  # head and steps
        self.assertIn("<a href='#simple_pendulum'>", page[page.index("Collections</h2>"):])
        self.assertIn("LE11", page)


class Judgement(unittest.TestCase):
    def quantity(self, **keys):
        return Quantity(**{"name": "x", "meaning": "x", "unit": "m", "reference": 1.0, "source": "s",
                           "tolerance": 1e-2, "reason": "r", **keys})

    def failures(self, compute, levels=(0.1, 0.05, 0.025), by="step", **keys):
        study = Study("study", lambda level: {"x": compute(level)}, list(levels), [self.quantity(**keys)], by=by)
        return compute_problem(Problem("title", "subject", "source", "model", [study]))["failures"]

    def test_the_order_is_the_slope_of_the_errors(self):
        self.assertAlmostEqual(observed_order([0.1, 0.05, 0.02], [3 * h**2.5 for h in (0.1, 0.05, 0.02)])[0], 2.5)
        order, used = observed_order([0.1, 0.05, 0.02], [1e-2, 1e-12, math.nan], 1e-9)
        self.assertTrue(math.isnan(order) and used == 1)

    def test_orders_are_held_on_both_sides_unless_larger_ones_are_accepted(self):
        self.assertEqual(self.failures(lambda h: 1 + h**2, order=2), [])
        for power, words in ((1.5, "order is 1.50"), (3, "order is 3.00")):
            self.assertIn(words, self.failures(lambda h, p=power: 1 + h**p, order=2)[0])
        self.assertEqual(self.failures(lambda h: 1 + h**3, order=2, order_at_least=True), [])
        self.assertIn("cannot be observed", self.failures(lambda h: 1.0, order=2)[0])
        self.assertEqual(self.failures(lambda n: 1 + n**-2.0, (10, 20, 40), "elements", order=2), [])

    def test_the_last_level_of_a_refinement_and_each_other_run_keep_the_tolerance(self):
        self.assertEqual(self.failures(lambda h: 1 + h**2), [])
        self.assertEqual(len(self.failures(lambda h: 1 + h)), 1)
        self.assertEqual(len(self.failures(lambda h: 1 + h**2, (0.2, 0.3), "")), 2)

    def test_the_coarsest_accurate_level_is_found(self):
        for tolerance, expected in ((1, 0), (3e-3, 1), (7e-4, 2), (1e-4, None)):
            study = Study("study", lambda h: {"x": 1 + h**2}, [0.1, 0.05, 0.025], [self.quantity(tolerance=tolerance)])
            found = compute_problem(Problem("title", "subject", "source", "model", [study]))["studies"][0]["kept_from"]
            self.assertEqual(found, expected, tolerance)

    def test_no_number_fails_at_any_level_whatever_its_kind(self):
        for wrong in (math.nan, math.inf, [1.0, 1.0], None):
            for at in (0.1, 0.025):
                self.assertIn("not a number", self.failures(lambda h, a=at, w=wrong: w if h == a else 1.0)[0],
                              (wrong, at))

    def test_a_meaningless_description_is_refused(self):
        for keys in ({"tolerance": 0}, {"tolerance": math.nan}, {"reason": ""}, {"source": ""},
                     {"reference": math.nan}, {"known_to": 0.02},
                     {"reference": 0.0, "relative": True}):
            with self.assertRaises(ValueError, msg=keys):
                self.quantity(**keys)
        for levels, by, order in (((0.1, 0.2), "step", None), ((), "step", None), ((1, 2), "", 2),
                                  ((2, 1), "elements", None), ((1,), "mesh", None)):
            with self.assertRaises(ValueError, msg=(levels, by)):
                Study("study", mock.Mock(), list(levels), [self.quantity(order=order)], by=by)
        with self.assertRaises(ValueError):
            Study("study", mock.Mock(), [1], [self.quantity()], accuracy="y")


if __name__ == "__main__":
    unittest.main()
