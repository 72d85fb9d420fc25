"""Tests of tools/gallery: machines pass their checks; a changed reference, a missing event, a wrong model and a crash
are reported by name."""

import glob
import math
import os
import re
import sys
import unittest

import h5py

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.dirname(HERE))

from in_folder import REPOSITORY, InFolder  # noqa: E402
from python_tool import run_python_tool  # noqa: E402

sys.path.insert(0, os.path.join(REPOSITORY, "tools"))

from bielle_tools.gallery import catalogue  # noqa: E402
from bielle_tools.gallery.machine import Check, Machine, Picture  # noqa: E402
from bielle_tools.gallery.making import Made  # noqa: E402
from bielle_tools.gallery.page import page  # noqa: E402

PROGRAMS = os.environ["BIELLE_PROGRAMS"]
MANUAL = os.path.join(REPOSITORY, "mechanism", "manual", "gallery.md")
EXAMPLES = os.path.join(REPOSITORY, "mechanism", "manual", "examples.md")


def gallery(*arguments):
    return run_python_tool(os.path.join(REPOSITORY, "tools", "gallery"), arguments, environment={**os.environ, "BIELLE_BIN": PROGRAMS})


class Making(InFolder):
    def machine(self, name, *replaced, of="weak_instability"):
        """Writes a machine file of the gallery in which some words are replaced."""
        with open(os.path.join(catalogue.FOLDER, of + ".py"), encoding="utf-8") as file:
            text = file.read()
        for old, new in replaced:
            self.assertIn(old, text)
            text = text.replace(old, new)
        self.write(os.path.join("machines", name + ".py"), text)

    def test_a_good_machine_passes_and_faults_are_told(self):
        os.mkdir(self.path("machines"))
        self.machine("good")
        self.machine("moved", ("/ 2, 2 * math.pi,", "/ 2, 2 * math.pi + 0.15,"))
        self.machine("refused", ("alpha=0.1", "alpa=0.1"))
        self.machine("without_figure", ('figure="pivot.reaction.norm.png"', 'figure="pivots.png"'))
        self.machine("crashing", ("growing, _ = errors", "growing, _ = 1 / 0, errors"))
        self.machine("empty", ("    growing, _", "    return []\n    growing, _"))
        done = gallery("-o", self.path("out"), "--machines", self.path("machines"))
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("gallery: failed: crashing, empty, moved, refused, without_figure", done.stderr)
        self.assertRegex(done.stdout, r"(?m)^good +exponent of the growth per revolution \[-\] +6\.2\d+ +6\.28319 ")
        self.assertRegex(done.stdout, r"(?m)^moved .*FAILED$")
        for words in ("did you mean 'alpha'", "ZeroDivisionError", "pivots.png", "it has no check"):
            self.assertIn(words, done.stdout)
        for made in ("index.html", "good/machine.html", "good/picture_1.png", "models/weak_instability.yaml"):
            self.assertGreater(os.path.getsize(self.path("out/" + made)), 500, made)
        with open(self.path("out/index.html"), encoding="utf-8") as file:
            text = file.read()
        self.assertIn("Failed: crashing, empty, moved, refused, without_figure.", text)
        with h5py.File(self.path("out/good/hht.h5")) as file:
            self.assertIn(f"Computed by {file.attrs['created_by']}.", text)
        # All links are within the folder, and their files exist.
        for link in re.findall(r"(?:href|src)='([^']+)'", text):
            self.assertTrue(link.startswith("#") or os.path.isfile(self.path("out/" + link)), link)

    def test_wrong_words_are_named(self):
        os.mkdir(self.path("machines"))
        self.write("machines/nothing.py", "MACHINE = 1\n")
        os.mkdir(self.path("none"))
        for arguments, sentence in ((["engin"], "there is no machine 'engin'; did you mean 'engine'?"),
                                    ([""], "there is no machine ''"),
                                    (["-j", "0"], "'0': expected a whole number between 1 and 1000"),
                                    (["--fast"], "'--fast' is not an option"),
                                    (["--machines", self.path("absent")], "is not a folder"),
                                    (["--machines", self.path("none")], "has no machines"),
                                    (["--machines", self.path("machines")], "nothing.py' defines no MACHINE")):
            done = gallery("-o", self.path("out"), *arguments)
            self.assertEqual(done.returncode, 1, (arguments, done.stderr))
            self.assertIn(sentence, done.stderr)
            self.assertFalse(os.path.exists(self.path("out")))


class Description(unittest.TestCase):
    def check(self, **keys):
        return Check(**{"quantity": "q", "unit": "m", "value": 1.0, "reference": 1.0, "within": 0.01, "reason": "r", "formula": "f", **keys})

    def test_a_number_near_the_reference_passes(self):
        for value, passed in ((1.0, True), (1.009, True), (1.011, False), (0.989, False), (-1.0, False), (math.nan, False), (math.inf, False)):
            self.assertEqual(self.check(value=value).passed, passed, value)
        self.assertAlmostEqual(self.check(value=-1.1, reference=-1.0).difference, -0.1)

    def test_a_meaningless_check_is_refused(self):
        for keys in ({"reference": 0}, {"reference": math.nan}, {"within": 0}, {"within": 0.5}, {"reason": ""}, {"formula": ""}):
            with self.assertRaises(ValueError, msg=keys):
                self.check(**keys)

    def test_the_page_shows_machines_that_failed_before_they_had_a_picture(self):
        machine = Machine("A <machine>", "t", {"r": ["latch.yaml"]}, [Picture("r")], "r", lambda paths: [])
        text = page([Made("one", machine, [self.check(value=2)], pictures=["one/picture_1.png"], page="one/machine.html"),
                     Made("two", machine, failure="it <failed>")], "bielle-mechanism 0.1.0 (commit <c>)")
        self.assertIn("Computed by bielle-mechanism 0.1.0 (commit &lt;c&gt;).", text)
        self.assertIn("A &lt;machine&gt;", text)
        self.assertIn("it &lt;failed&gt;", text)
        self.assertIn("Failed: one, two.", text)

    def test_machines_are_those_of_the_manual(self):
        with open(MANUAL, encoding="utf-8") as file:
            named = re.findall(r"(?m)^\| \[`(\w+)`\]\(\.\./examples/(\w+\.yaml)\)", file.read())
        machines = catalogue.chosen(catalogue.FOLDER, [])
        self.assertEqual([name for name, _ in named], list(machines))
        for name, model in named:
            self.assertIn(model, [words[0] for words in machines[name].runs.values()])
            for body in machines[name].bodies:
                self.assertTrue(glob.glob(os.path.join(REPOSITORY, "meshes", body + ".yaml")), body)

    def test_all_examples_are_listed_with_their_checks(self):
        with open(EXAMPLES, encoding="utf-8") as file:
            lines = re.findall(r"(?m)^\| \[`(\w+)`\]\(\.\./examples/(\w+)\.yaml\) \| .+ \| \[.+\]\(\.\./\.\./(\S+\.py)\) \| (yes)? *\|$", file.read())
        models = glob.glob(os.path.join(REPOSITORY, "mechanism", "examples", "*.yaml"))
        self.assertEqual(sorted(model for _, model, _, _ in lines), sorted(os.path.basename(path)[:-5] for path in models))
        drawn = {words[0] for machine in catalogue.chosen(catalogue.FOLDER, []).values() for words in machine.runs.values()}
        for name, model, check, gallery_has_it in lines:
            with self.subTest(name):
                self.assertEqual(name, model)
                self.assertTrue(os.path.isfile(os.path.join(REPOSITORY, check)), check)
                self.assertEqual(bool(gallery_has_it), f"{model}.yaml" in drawn)


if __name__ == "__main__":
    unittest.main()
