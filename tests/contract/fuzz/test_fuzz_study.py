"""Fuzz of files of studies and tables with exchanged words and numbers: bielle-study ends with a sentence, and no input
file is lost."""

import re
import subprocess
import unittest

from fuzzing import FuzzTest, NEVER, damaged_bytes
from study_stand_in import STAND_IN, STUDY, stand_in_results

import os

FILE = """\
model: model.yaml
set: {mass: 2}
grid:
  speed: {from: 0, to: 3, count: 4}
  load: [1, "2*3"]
table: more.csv
keep: [joints]
gather:
  rate: max joints/main/rate
  power: last measures/power from 0 to 1
  first: eigen/frequency[1]
draw: [rate over speed by load]
"""
TABLE = "other\n1\n2\n"
WORDS = ["-1", "0", "1e300", "nan", "[]", "{}", "null", "model.yaml", "more.csv", "sweep.yaml", "/dev/zero", "..", "speed", "0:3:4", "log:0:1:2",
         "1:2:1e9", "'", '"', "\\", "\n", "{{", "max", "count", "*x", "&x", "<<", "\x00", "\u00e9", "/tmp", "all", "a/b", "%a"]


class StudyFiles(FuzzTest):
    def changed(self, rng, text):
        if rng.random() < 0.2:
            return damaged_bytes(rng, text.encode())[0]
        words = list(re.finditer(r"[\w./*-]+|[^\s\w]", text))
        for _ in range(rng.choice([1, 1, 2])):
            word = rng.choice(words)
            other = rng.choice([*WORDS, rng.choice(words)[0], ""])
            text = text[:word.start()] + other + text[word.end():]
            words = list(re.finditer(r"[\w./*-]+|[^\s\w]", text))
        return text.encode("utf-8", "surrogatepass")

    def test_study_files_and_tables(self):
        self.write("bielle-mechanism", STAND_IN)
        os.chmod(self.path("bielle-mechanism"), 0o700)
        with open(self.path("stand_in"), "wb") as file:
            file.write(stand_in_results())
        for case, rng in self.cases(25):
            inputs = {"model.yaml": "parameters: {speed: 1, mass: 2, load: 0, other: 0}\n", "sweep.yaml": FILE, "more.csv": TABLE}
            name = rng.choice(["sweep.yaml", "sweep.yaml", "more.csv"])
            inputs[name] = self.changed(rng, inputs[name])
            for each, text in inputs.items():
                self.write(each, text)
            inputs = {each: self.read(each) for each in inputs}
            output = rng.choice(["sweep.h5", "sweep.h5", "model.h5", "more.csv", "model.yaml", "new\nline.h5", "a%b.h5"])
            done = subprocess.run(["/usr/bin/python3", "-B", STUDY, "sweep.yaml", "-o", output, "--draw", "none", "--jobs", "2",
                                   *rng.choice([[], [], ["--schedule", rng.choice(["jobs", "jo\nbs", "."])]])],
                                  cwd=self.folder, capture_output=True, text=True, errors="replace", timeout=300, stdin=subprocess.DEVNULL,
                                  env={**os.environ, "BIELLE_BIN": self.folder}, check=False)
            with self.subTest(case=case):
                self.assertIn(done.returncode, (0, 1, 2), done.stderr)
                for word in NEVER:
                    self.assertNotIn(word, done.stderr)
                if done.returncode == 1:
                    self.assertIn("bielle-study: ", done.stderr)
                for each, text in inputs.items():
                    self.assertEqual(self.read(each), text, f"{each} has changed")


if __name__ == "__main__":
    unittest.main()
