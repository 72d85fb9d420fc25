"""Tests of bielle-study: grids, gathered numbers, figures, and jobs for schedulers, compared with the stand-in and with
single runs."""

import csv
import os
import re
import subprocess
import unittest

import h5py
import numpy as np

from box_mesh import REPOSITORY, InFolder
from python_tool import run_python_tool
from study_stand_in import STUDY, WithStandIn

from bielle_tools.messages import InputError  # noqa: E402
from bielle_tools.study import gather as study_gather, values as study_values  # noqa: E402  (box_mesh sets the path)
from shares import share_of_tests as load_tests  # noqa: E402,F401

PROGRAMS = os.environ["BIELLE_PROGRAMS"]
PENDULUM = """\
mechanism: a pendulum on a spring
gravity: [0, 0, -9.81]
parameters: {length: 1, mass: 2, stiffness: 20}
nodes: {bob: {position: ["length", 0, 0]}}
elements: {bob: {type: point_mass, node: bob, mass: mass}}
joints:
  pivot: {type: hinge, nodes: [ground, bob], position: [0, 0, 0], axis: [0, 1, 0], stiffness: stiffness}
measures: {depth: {formula: "-bob.position.z", units: m}}
analysis:
  - {type: dynamic, duration: 0.3, step: 5e-3}
"""
# A stand-in for sbatch. It runs the tasks of an array one after the other, even if some fail, and prints the number of
# the job as --parsable does.
SBATCH = """#!/bin/sh
for script; do :; done
tasks=$(sed -n 's/^#SBATCH --array=1-//p' "$script")
if [ -z "$tasks" ]; then sh "$script" >gather.log 2>&1; else
  for k in $(seq "$tasks"); do SLURM_ARRAY_TASK_ID=$k sh "$script" >"$k.log" 2>&1; done
fi
echo "$@" >>submitted
echo "17;cluster"
"""


def table_of(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.reader(file))


class Values(unittest.TestCase):
    def test_ranges_are_decimal_and_texts_stay(self):
        self.assertEqual(study_values.values_of("0:0.3:4", ""), ["0", "0.1", "0.2", "0.3"])
        self.assertEqual(study_values.values_of("1:0:3", ""), ["1", "0.5", "0"])
        self.assertEqual(study_values.values_of("log:1:1000:4", ""), ["1", "10", "100", "1000"])
        self.assertEqual(study_values.values_of("0.10, 2*pi,max(1, 2)", ""), ["0.10", "2*pi", "max(1, 2)"])
        self.assertEqual(study_values.stepped("0", "1", "0.3", ""), ["0", "0.3", "0.6", "0.9"])
        self.assertEqual(study_values.stepped("1", "0", "-0.5", ""), ["1", "0.5", "0"])
        np.testing.assert_array_equal([float(text) for text in study_values.values_of("0:1:31", "")], [k / 30 for k in range(31)])

    def test_a_grid_has_all_combinations_the_last_fastest(self):
        self.assertEqual(study_values.grid({"a": ["1", "2"], "b": ["x", "y", "z"]}),
                         (["a", "b"], [["1", "x"], ["1", "y"], ["1", "z"], ["2", "x"], ["2", "y"], ["2", "z"]]))

    def test_wrong_values_are_told(self):
        for text, part in (("1:2", "is no range"), ("a:2:3", "between numbers; found 'a'"), ("1:2:1", "from 2 on"), ("1:inf:3", "'inf'"),
                           ("log:0:1:3", "between positive numbers"), ("1,,2", "a value is missing"), ("1:2:2.5", "a whole number")):
            with self.assertRaisesRegex(InputError, part):
                study_values.values_of(text, "here")
        with self.assertRaisesRegex(InputError, "do not lead from 1 to 0"):
            study_values.stepped("1", "0", "0.1", "")


class Taken(unittest.TestCase):
    def test_closed_forms(self):
        # The curve is a polygon with unequal intervals, a ramp from 0 to 3 within 3 s and back to 0 within 1 s.
        time, values = np.array([0, 0.5, 3, 4]), np.array([0, 0.5, 3, 0])
        for what, number in (("last", 0), ("first", 0), ("min", 0), ("max", 3), ("absmax", 3), ("peak_to_peak", 3), ("time_of_max", 3),
                             # The integral of t^2 up to 3 is 9, and that of (3 s)^2 over 1 is 3.
                             ("mean", 1.5), ("rms", np.sqrt((9 + 3) / 4))):
            self.assertAlmostEqual(study_gather.take(what, time, values), number, 14, what)
        self.assertEqual(study_gather.take("time_of_absmax", time, -values), 3)
        self.assertEqual(study_gather.take("rms", time[:1], np.array([-2.0])), 2)
        inside, cut = study_gather.window(time, values, 1, 3.5)
        self.assertEqual((inside.tolist(), cut.tolist()), ([1, 3, 3.5], [1, 3, 1.5]))
        with self.assertRaises(study_gather.Missing):
            study_gather.window(time, values, 1, 5)

    def test_wrong_words_are_told(self):
        for words, part in (("maxx joints/a/b", "did you mean 'max'"), ("joints/a/b", "what shall be taken"), ("max", "names no dataset"),
                            ("max joints/a/b until 3", "'until' is not understood"), ("eigen/frequency[1] at 3", "is not over time"),
                            ("max joints/a/b at 3", "goes with nothing else"), ("max joints/a/b from 3 to 1", "no span of time"),
                            ("max joints/a/b at x", "'at' is not understood"), ("eigen/frequency[3:1]", "no range of columns")):
            with self.assertRaisesRegex(InputError, part):
                study_gather.read_gather([("f", words)])


class Grids(WithStandIn):
    def test_a_grid_is_run_gathered_and_drawn(self):
        done = self.call("model.yaml", "--grid", "speed=1:3:3", "--grid", "mass=1, 2,-4, 10*0.5", "--gather", "f=eigen/frequency[1:2]",
                         "--gather", "top=max joints/main/rate", "--gather", 'second=text "limit point at load factor"[2]',
                         "--gather", "late=measures/power at 0.25", "--draw", "top over speed by mass where speed = 1")
        self.assertEqual(done.returncode, 1)
        self.assertIn("names a parameter twice", done.stderr)
        done = self.call("model.yaml", "--grid", "speed=1:3:3", "--grid", "mass=1, 2,-4, 10/2.5", "--gather", "f=eigen/frequency[1:2]",
                         "--gather", "top=max joints/main/rate", "--gather", 'second=text "limit point at load factor"[2]',
                         "--gather", "late=measures/power at 0.25", "--gather", "z=last nodes/hub/position[z]")
        # The stand-in reads masses as numbers, and a formula is not a number. Three runs fail for this reason, and
        # three due to the negative mass.
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("run 3: speed = 1, mass = -4: FAILED: model.yaml:3", done.stdout)
        table = table_of(self.path("model-study-table.csv"))
        self.assertEqual(table[0], ["run", "speed", "mass", "status", "f_1", "f_2", "top", "second", "late", "z"])
        self.assertEqual(table[6], ["6", "2", "2", "0", "2.0", "6.0", "4.0", "40.0", "0.25", "4.0"])
        self.assertEqual(table[7], ["7", "2", "-4", "1", "", "", "", "", "", ""])
        self.assertEqual([row[1:3] for row in table[1:5]], [["1", "1"], ["1", "2"], ["1", "-4"], ["1", "10/2.5"]])
        with h5py.File(self.path("model-study.h5")) as file:
            np.testing.assert_array_equal(file["gathered/f_2"], [3, 3, np.nan, np.nan, 6, 6, np.nan, np.nan, 9, 9, np.nan, np.nan])
            self.assertEqual(dict(file["gathered/f_2"].attrs), {"of": "eigen/frequency[2]", "units": "Hz"})
            self.assertEqual(file["parameters/mass"].asstr()[3], "10/2.5")
        self.assertIn("f_over_mass_by_speed.png", os.listdir(self.path("model-study-plots")))

    def test_figures_are_those_that_are_asked_for(self):
        common = ["model.yaml", "--grid", "speed=1:3:3", "--grid", "mass=1,2,3", "--gather", "top=max joints/main/rate", "-o", "s.h5"]
        done = self.call(*common)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(sorted(os.listdir(self.path("s-plots"))), ["top_over_speed_and_mass.png", "top_over_speed_by_mass.png"])
        done = self.call(*common, "--draw", "top over mass where speed = 2")
        self.assertEqual(done.stdout.splitlines()[-1], "s-plots/top_over_mass_speed=2.png")
        self.assertEqual(len(self.runs()), 9)
        for words, part in (("top over sped", "'sped' is no parameter of the study; did you mean 'speed'?"), ("tip over speed", "'tip' is gathered"),
                            ("top over speed", "leaves open which mass"), ("top over speed where mass = 4", "no run has mass = 4"),
                            ("top against speed", "is not understood")):
            done = self.call(*common, "--draw", words)
            self.assertEqual(done.returncode, 1, words)
            self.assertIn(part, done.stderr)
        self.assertEqual(self.call(*common, "--draw", "none").stdout.splitlines()[-1], self.path("s-table.csv"))

    def test_a_wrong_name_ends_the_study_at_its_first_run(self):
        done = self.call("model.yaml", "--grid", "speed=1:99:99", "--set", "mass=1", "--gather", "top=max joints/mian/rate", "--jobs", "1")
        self.assertEqual(done.returncode, 1)
        self.assertIn("gather: top: there is no dataset 'joints/mian/rate' in the results; did you mean 'joints/main/rate'?", done.stderr)
        self.assertLess(len(self.runs()), 99)  # the next runs are computed while the first one is read
        done = self.call("model.yaml", "--grid", "speed=1:3:3", "--set", "mass=1", "--gather", "top=max joints/main/rate")
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_what_one_run_lacks_is_told_and_the_others_have_it(self):
        done = self.call("model.yaml", "--grid", "speed=1,2", "--set", "mass=1", "--gather", "f=eigen/frequency[3]", "--gather",
                         "late=measures/power at 7")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("run 2: mass = 1, speed = 2: f is missing: 'eigen/frequency' has 2 numbers", done.stderr)
        self.assertIn("late is missing: there is no time 7: the results have 0 to 1", done.stderr)

    def test_the_file_of_a_study(self):
        self.write("more.csv", "mass\n1\n2\n")
        self.write("sweep.yaml", "model: model.yaml\ntable: more.csv\ngrid:\n  speed: {from: 0, to: 1, step: 0.5}\n"
                                 "keep: [energy]\ngather: {top: max joints/main/rate}\ndraw: [top over speed by mass]\n")
        done = self.call("sweep.yaml")
        self.assertEqual(done.returncode, 0, done.stderr)
        table = table_of(self.path("sweep-table.csv"))
        self.assertEqual([row[1:3] + row[-1:] for row in table],
                         [["mass", "speed", "top"], ["1", "0", "0.0"], ["1", "0.5", "1.0"], ["1", "1", "2.0"], ["2", "0", "0.0"],
                          ["2", "0.5", "1.0"], ["2", "1", "2.0"]])
        self.assertEqual(os.listdir(self.path("sweep-plots")), ["top_over_speed_by_mass.png"])

    def test_parameters_as_text_stay_text(self):
        self.write("sweep.yaml", "model: model.yaml\nset: {mass: 1.0}\ngrid: {speed: [0.10, 1e0, '2*3', yes or no]}\n")
        done = self.call("sweep.yaml")
        self.assertEqual(self.runs(), ["1.0 0.10", "1.0 1e0", "1.0 2*3", "1.0 yes or no"])
        self.assertEqual(done.returncode, 2)

    def test_wrong_files_of_studies_are_told_with_their_line(self):
        for text, part in (("model: model.yaml\ngird: {a: 1}\n", "sweep.yaml:2: 'gird' is not a key of a study; did you mean 'grid'?"),
                           ("model: model.yaml\n", "nothing varies"),
                           ("model: model.yaml\ngrid:\n  speed: {from: 0, to: 1}\n", "sweep.yaml:3: grid.speed: a range has 'from', 'to', and"),
                           ("model: model.yaml\ngrid:\n  speed: {from: 0, to: 1, cuont: 3}\n", "did you mean 'count'?"),
                           ("model: model.yaml\ngrid: {speed: 1:x:3}\n", "sweep.yaml:2: grid.speed: a range is between numbers; found 'x'"),
                           ("model: model.yaml\ngrid: [1, 2]\n", "sweep.yaml:2: grid: expected keys with values"),
                           ("model: model.yaml\ngrid: {a: [1], a: [2]}\n", "'a' is there twice"),
                           ("model: model.yaml\nset: {a: 1}\ngrid: {a: [2]}\n", "sweep.yaml:3: the parameter 'a' has its values"),
                           ("model: model.yaml\ntable: [{a: 1}, {b: 1}]\n", "a run gives values of b; the first one of a"),
                           ("model: model.yaml\ngrid: {a: [1}\n", "sweep.yaml:2: "),
                           ("model: model.yaml\ngrid: {speed: [1, 2]}\nkeep: [jionts]\n", "did you mean 'joints'?"),
                           ("", "is empty")):
            self.write("sweep.yaml", text)
            done = self.call("model.yaml", "sweep.yaml") if not text else self.call("sweep.yaml")
            self.assertEqual((done.returncode, len(done.stderr.splitlines())), (1, 1), text + done.stderr)
            self.assertIn(part, done.stderr)


class Scheduled(WithStandIn):
    def schedule(self, *options):
        done = self.call("model.yaml", "--grid", "speed=1,2,3", "--grid", "mass=1,-1", "--gather", "top=max joints/main/rate", "-o", "s.h5",
                         "--schedule", "the jobs", *options)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return done.stdout

    def environment(self):
        return {**os.environ, "BIELLE_BIN": self.folder, "PATH": self.folder + ":" + os.environ["PATH"]}

    def expect_all(self):
        with h5py.File(self.path("s.h5")) as file:
            self.assertEqual(file["status"][:].tolist(), [0, 1] * 3)
            self.assertTrue(file.attrs["complete"])
            np.testing.assert_array_equal(file["gathered/top"][::2], [2, 4, 6])
            self.assertIn("expected a positive number", file["message"].asstr()[1])

    def test_slurm_runs_the_array_and_gathers(self):
        self.write("sbatch", SBATCH)
        os.chmod(self.path("sbatch"), 0o755)
        self.schedule("--share", "4", "--sbatch=--time=1:00:00")
        self.assertEqual(self.runs(), [])
        subprocess.run(["sh", "the jobs/submit.sh", "--partition=short"], cwd=self.folder, env=self.environment(), check=True, timeout=120,
                       capture_output=True)
        self.expect_all()
        self.assertEqual(len(self.runs()), 6)
        with open(self.path("the jobs/submitted"), encoding="utf-8") as file:
            self.assertEqual(file.read(), "--parsable --partition=short array.sbatch\n--dependency=afterany:17 gather.sbatch\n")
        with open(self.path("the jobs/array.sbatch"), encoding="utf-8") as file:
            lines = file.read().splitlines()
        self.assertIn("#SBATCH --array=1-2", lines)
        self.assertIn("#SBATCH --time=1:00:00", lines)
        with open(self.path("the jobs/gather.log"), encoding="utf-8") as file:
            self.assertIn("run 2: speed = 1, mass = -1: FAILED: model.yaml:3: mass: expected a positive number", file.read())

    def test_a_list_of_jobs_runs_and_goes_on(self):
        said = self.schedule()
        command = next(line for line in said.splitlines() if line.startswith("xargs:")).partition(":")[2]
        with open(self.path("the jobs/jobs.txt"), encoding="utf-8") as file:
            first = file.readline()
        subprocess.run(["sh", "-c", first], cwd=self.folder, env=self.environment(), check=True, timeout=60, capture_output=True)
        done = self.call("--collect", "the jobs")
        self.assertEqual(done.returncode, 2)
        self.assertIn("1 of 6 runs done, 5 not run yet", done.stdout)
        with h5py.File(self.path("s.h5")) as file:
            self.assertFalse(file.attrs["complete"])
        done = subprocess.run(["sh", "-c", command], cwd=self.folder, env=self.environment(), timeout=120, capture_output=True, text=True)
        self.expect_all()
        self.assertEqual(len(self.runs()), 6)  # the first run existed
        self.assertIn("3 runs to make in 3 jobs, 3 there from before", self.schedule())  # failed runs

    def test_wrong_folders_and_tasks_are_told(self):
        self.schedule()
        for arguments, part in ((("--run", "the jobs", "11"), "has no task 11"), (("--run", ".", "1"), "is no folder of a study"),
                                (("--collect", "nowhere"), "is no folder of a study"), (("--run", "the jobs", "x"), "found 'x'"),
                                (("model.yaml", "--grid", "a=1,2", "--schedule", "."), "holds other things"),
                                (("model.yaml", "--grid", "a=1,2", "--share", "2"), "go with --schedule"),
                                (("model.yaml", "--grid", "a=1,2", "--schedule", "new", "--sbatch=time"), "an option of sbatch is expected")):
            done = self.call(*arguments)
            self.assertEqual((done.returncode, len(done.stderr.splitlines())), (1, 1), done.stderr)
            self.assertIn(part, done.stderr)


class AgainstSingleRuns(InFolder):
    def study(self, *arguments):
        return run_python_tool(STUDY, arguments, self.folder, {**os.environ, "BIELLE_BIN": PROGRAMS}, timeout=300)

    def test_layouts_make_no_difference_and_one_analysis_can_be_named(self):
        again = PENDULUM + "  - {type: dynamic, duration: 0.2, step: 5e-3}\n"
        words = ["--gather", "deep=max measures/depth", "--gather", "z=min nodes/bob/position[z]", "--gather", "angle=last joints/pivot/coordinate",
                 "--gather", "first=last joints/pivot/coordinate in analysis 1", "--gather", "second=last joints/pivot/coordinate in analysis 2",
                 "--gather", "down=last nodes/bob/position[z] in analysis 1"]
        for layout in ("named", "stacked"):
            self.write(f"{layout}.yaml", again + f"output: {{layout: {layout}}}\n")
            done = self.study(f"{layout}.yaml", "--grid", "length=1:2:2", "--keep", "energy", "--draw", "none", *words)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
        named, stacked = (table_of(self.path(f"{layout}-study-table.csv")) for layout in ("named", "stacked"))
        self.assertEqual(named, stacked)
        name, values = named[0], [float(value) for value in named[1]]
        number = dict(zip(name, values))
        self.assertEqual(number["angle"], number["second"])
        self.assertNotEqual(number["first"], number["second"])
        self.assertAlmostEqual(number["down"], -np.sin(number["first"]), places=9)
        self.assertEqual(number["deep"], -number["z"])

    def test_the_study_of_the_guide(self):
        with open(os.path.join(REPOSITORY, "tools", "guide", "studies.md"), encoding="utf-8") as file:
            model, text = re.findall(r"```yaml\n(.*?)```", file.read(), re.DOTALL)[:2]
        self.assertIn("model: swing.yaml", text)
        self.write("swing.yaml", model)
        self.write("sweep.yaml", text)
        done = self.study("sweep.yaml")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        table = table_of(self.path("sweep-table.csv"))
        self.assertEqual(table[0], ["run", "mass", "start", "length", "status", "top", "force"])
        self.assertEqual((len(table), table[1][1:4], table[-1][1:4]), (7, ["3", "0.2", "0.8"], ["3", "1", "0.8*sqrt(2)"]))
        self.assertEqual(os.listdir(self.path("sweep-plots")), ["top_over_start_by_length.png"])

    def test_a_study_over_20_values_equals_20_single_runs(self):
        self.write("pendulum.yaml", PENDULUM)
        done = self.study("pendulum.yaml", "--grid", "mass=-0.05:1.85:20", "--gather", "deep=max measures/depth", "--gather",
                          "end=measures/depth at 0.3", "--keep", "all", "--jobs", "2")
        self.assertEqual(done.returncode, 2, done.stderr)  # a run with a mass below 0 fails, the others succeed
        self.assertRegex(done.stdout, r"run 1: mass = -0\.05: FAILED: .*pendulum\.yaml:5: .*mass")
        self.assertIn("19 of 20 runs done", done.stdout)
        with h5py.File(self.path("pendulum-study.h5")) as study:
            for number, mass in enumerate(study["parameters/mass"].asstr()[:], start=1):
                single = subprocess.run([os.path.join(PROGRAMS, "bielle-mechanism"), "pendulum.yaml", "-o", "single.h5", "--quiet", "--set",
                                         f"mass={mass}"], cwd=self.folder, capture_output=True, text=True, timeout=60)
                self.assertEqual(study["status"][number - 1], single.returncode)
                if single.returncode:
                    continue
                with h5py.File(self.path("single.h5")) as run:
                    expected = {}
                    run["analysis_1"].visititems(lambda name, found, to=expected: to.update({name: found}))
                    for name, found in expected.items():
                        if isinstance(found, h5py.Dataset):
                            np.testing.assert_array_equal(study[f"runs/{number}/analysis_1/{name}"][()], found[()], name)
                    depth = run["measures/depth"][:]
                    self.assertEqual((study["gathered/deep"][number - 1], study["gathered/end"][number - 1]), (depth.max(), depth[-1]))
            self.assertEqual(len(set(study["gathered/end"][1:])), 19)  # each run has its own mass
            self.assertNotIn("1", study["runs"])


if __name__ == "__main__":
    unittest.main()
