"""bielle-study with the program itself: its runs equal single runs to the bit, and a failed one does not affect the others."""

import os
import subprocess
import tempfile
import unittest

import h5py
import numpy as np

REPOSITORY = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", "..", ".."))
PROGRAMS = os.environ["BIELLE_PROGRAMS"]
MODEL = """
parameters: {mass: 1, length: 0.4}
gravity: [0, 0, -9.81]
nodes: {bob: {position: [length, 0, 0]}}
elements: {bob: {type: rigid_body, node: bob, mass: "mass", inertia: [0.01, 0.01, 0.01]}}
joints: {pivot: {type: hinge, nodes: [ground, bob], position: [0, 0, 0], axis: [0, 1, 0], damping: 0.05}}
analysis: [{type: dynamic, duration: 0.3, step: 0.005}]
"""


class StudyRuns(unittest.TestCase):
    def test_twenty_values_are_twenty_single_runs_and_a_failing_one_is_survived(self):
        masses = [f"{mass:.17g}" for mass in np.linspace(0.5, 3, 20)]
        masses[7] = "-1"  # a body cannot have a negative mass
        with tempfile.TemporaryDirectory() as folder:
            def at(name):
                return os.path.join(folder, name)

            with open(at("model.yaml"), "w", encoding="utf-8") as file:
                file.write(MODEL)
            with open(at("masses.csv"), "w", encoding="utf-8") as file:
                file.write("\n".join(["mass", *masses]) + "\n")
            done = subprocess.run([os.path.join(REPOSITORY, "tools", "bielle-study"), at("model.yaml"), at("masses.csv"), "-o", at("study.h5"),
                                   "--jobs", "2"], capture_output=True, text=True, timeout=300,
                                  env={**os.environ, "BIELLE_BIN": PROGRAMS})
            self.assertEqual(done.returncode, 2, done.stderr)  # message of a run that failed
            self.assertIn("FAILED", done.stdout)
            ends = set()
            with h5py.File(at("study.h5")) as study:
                self.assertEqual(study["status"][:].tolist(), [1 if k == 7 else 0 for k in range(20)])
                for number, mass in enumerate(masses, 1):
                    if number == 8:
                        self.assertNotIn("8", study["runs"])
                        continue
                    subprocess.run([os.path.join(PROGRAMS, "bielle-mechanism"), at("model.yaml"), "-o", at("single.h5"), "--set",
                                    f"mass={mass}"], check=True, capture_output=True, timeout=60)
                    with h5py.File(at("single.h5")) as single:
                        for name in ("time", "joints/pivot/coordinate", "joints/pivot/rate"):
                            self.assertEqual(study[f"runs/{number}/{name}"][()].tobytes(), single[name][()].tobytes(), (number, name))
                        ends.add(single["joints/pivot/coordinate"][-1, 0])
            self.assertEqual(len(ends), 19)


if __name__ == "__main__":
    unittest.main()
