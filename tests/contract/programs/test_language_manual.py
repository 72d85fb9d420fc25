"""Runs every file on the pages about the language; expanded models must give the same results as the original files."""

import os
import re
import subprocess
import unittest

import h5py
import numpy as np

from command import PROGRAMS
from equal_runs import datasets, expect_equal_values
from in_folder import REPOSITORY, InFolder

PAGES = [os.path.join(REPOSITORY, "mechanism", "language", name) for name in ("README.md", "parts.md")]
PROGRAM = os.path.join(PROGRAMS, "bielle-mechanism")


def files_of_page():
    blocks = []
    for page in PAGES:
        with open(page, encoding="utf-8") as file:
            blocks += re.findall(r"```yaml\n(.*?)```", file.read(), re.DOTALL)
    return {re.match(r"# (\S+\.yaml)\n", block).group(1): block for block in blocks}


class LanguageManual(InFolder):
    def setUp(self):
        super().setUp()
        self.files = files_of_page()
        for name, text in self.files.items():
            self.write(name, text)

    def run_program(self, *arguments):
        done = subprocess.run([PROGRAM, *arguments], cwd=self.folder, capture_output=True, text=True, timeout=120)
        self.assertEqual((done.returncode, done.stderr), (0, ""), arguments)
        return done.stdout

    def test_every_model_runs_as_its_expanded_form_does(self):
        models = [name for name, text in self.files.items() if re.search(r"^analysis:", text, re.MULTILINE)]
        self.assertGreater(len(models), 5)
        for name in models:
            with self.subTest(name):
                expanded = self.run_program(name, "--expand")
                for word in ("include:", "repeat:", "parts:", "definitions:", "if:"):
                    self.assertNotIn(word, expanded)
                self.write("expanded.yaml", expanded)
                self.run_program(name, "-o", "written.h5", "--quiet")
                self.run_program("expanded.yaml", "-o", "expanded.h5", "--quiet")
                self.compare("written.h5", "expanded.h5")

    def compare(self, first, second):
        with h5py.File(self.path(first)) as one, h5py.File(self.path(second)) as other:
            found, expected = ({name: item[()] for name, item in datasets(file).items() if item.dtype.kind == "f"}
                               for file in (one, other))
            self.assertTrue(any("nodes" in name for name in expected))
            expect_equal_values(found, expected)

    def test_cases_have_results_of_their_own(self):
        self.run_program("drop.yaml", "--all-cases", "--quiet")
        self.run_program("drop.yaml", "--case", "fall", "-o", "alone.h5", "--quiet")
        self.compare("drop_fall.h5", "alone.h5")
        self.assertTrue(os.path.exists(os.path.join(self.folder, "drop_rest.h5")))

    def test_mirrored_wings_move_alike(self):
        self.run_program("wings.yaml", "-o", "wings.h5", "--quiet")
        with h5py.File(os.path.join(self.folder, "wings.h5")) as results:
            found = []
            results.visititems(lambda name, item: found.append(name) if name.endswith("difference") else None)
            values = results[found[0]]
            values = values[()] if isinstance(values, h5py.Dataset) else values["value"][()]
            self.assertLess(np.abs(values).max(), 1e-12)


if __name__ == "__main__":
    unittest.main()
