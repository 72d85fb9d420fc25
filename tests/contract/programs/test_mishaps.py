"""Tests of problems around the programs: damaged, modified and misplaced files, closed streams, and limits that are too
small."""

import os
import resource
import shutil
import signal
import subprocess
import time
import unittest

import h5py

from command import PROGRAMS, CommandTest
from test_mechanism import PENDULUM
from test_reduce import BAR, BODY
from shares import share_of_tests as load_tests  # noqa: E402,F401

MODEL = PENDULUM + "output: {checkpoint: 10}\n"


def rewrite(path, dataset, change):
    """Replaces the numbers of a dataset."""
    with h5py.File(path, "r+") as file:
        values, attributes = change(file[dataset][()]), dict(file[dataset].attrs)
        del file[dataset]
        file[dataset] = values
        file[dataset].attrs.update(attributes)


class Files(CommandTest):
    program = "bielle-mechanism"

    def test_damaged_checkpoints(self):
        self.write("model.yaml", MODEL)
        self.assertEqual(self.run_program("model.yaml", "-o", "good.h5", "--quiet").returncode, 0)
        last = "checkpoints/analysis_1/"
        for dataset, change, says in ((last + "state", lambda v: v[:1], "has not one row for each of"),
                                      (last + "state", lambda v: v.ravel(), "has not one row for each of"),
                                      (last + "rows", lambda v: 3.0, "is no list of numbers"),
                                      (last + "rows", lambda v: v * float("nan"), "counts nan rows"),
                                      (last + "rows", lambda v: v * 1e6, "of which there are"),
                                      (last + "state", lambda v: v * 1.001, "does not hold the numbers")):
            shutil.copy(self.path("good.h5"), self.path("bad.h5"))
            rewrite(self.path("bad.h5"), dataset, change)
            self.expect_refusal(1, "model.yaml", "--restart", "bad.h5", "-o", "on.h5", says=["bad.h5: ", says])
        with h5py.File(self.path("bad.h5"), "r+") as file:
            del file[last + "state"]
            file.create_dataset(last + "state", shape=(2**20, 2**20), chunks=(1024, 1024), dtype="f8")
        self.expect_refusal(1, "model.yaml", "--restart", "bad.h5", "-o", "on.h5", says=["larger than the file"])

    def test_damaged_rows_of_results_are_noticed_before_a_run_goes_on_from_them(self):
        self.write("model.yaml", MODEL)
        self.assertEqual(self.run_program("model.yaml", "-o", "good.h5", "--quiet").returncode, 0)
        with h5py.File(self.path("good.h5")) as file:
            counted = int(file["checkpoints/analysis_1/rows"][-1])
        for dataset, row, says in (("time", 3, 1), ("nodes/bob/position", counted - 1, 1), ("solver/step", 1, 1)):
            shutil.copy(self.path("good.h5"), self.path("bad.h5"))
            with h5py.File(self.path("bad.h5"), "r+") as file:
                place = file[f"analysis_1/{dataset}"]
                flat = place[row].copy().reshape(-1)
                flat.view("u1")[0] ^= 1  # one bit in the last place
                place[row] = flat.reshape(place[row].shape)
            self.expect_refusal(says, "model.yaml", "--restart", "bad.h5", "-o", "on.h5",
                                says=["analysis_1: its first ", "are not those that were written"])
        self.write("model.yaml", MODEL.replace("duration: 0.1", "duration: 0.15"))
        for source, target in (("good.h5", "on.h5"), ("on.h5", "on.h5"), ("on.h5", "further.h5")):  # sums go on
            done = self.run_program("model.yaml", "--restart", source, "-o", target, "--quiet")
            self.assertEqual(done.returncode, 0, done.stderr)
        with h5py.File(self.path("further.h5"), "r+") as file:
            del file["checkpoints/analysis_1/rows_checksum"]  # a file of an earlier version
        self.assertEqual(self.run_program("model.yaml", "--restart", "further.h5", "-o", "old.h5", "--quiet").returncode, 0)

    def test_a_continued_run_replaces_no_other_results_by_default(self):
        self.write("model.yaml", MODEL)
        self.assertEqual(self.run_program("model.yaml", "--quiet").returncode, 0)
        self.assertEqual(self.run_program("model.yaml", "-o", "other.h5", "--quiet").returncode, 0)
        self.expect_refusal(1, "model.yaml", "--restart", "other.h5", says=["model.h5: exists", "say with -o"])
        self.assertEqual(self.run_program("model.yaml", "--restart", "model.h5", "--quiet").returncode, 0)

    def test_the_head_of_a_file_that_a_killed_run_left_is_replaced(self):
        self.write("model.yaml", PENDULUM)
        self.assertEqual(self.run_program("model.yaml", "--quiet").returncode, 0)
        with open(self.path("model.h5"), "r+b") as file:
            file.truncate(96)
        self.assertEqual(self.run_program("model.yaml", "--quiet").returncode, 0)

    def test_aliases_that_repeat_without_end(self):
        lines = ["x0: &x0 {a: 1, b: 2}"] + [f"x{k}: &x{k} {{a: *x{k - 1}, b: *x{k - 1}}}" for k in range(1, 40)]
        self.write("bomb.yaml", "\n".join(lines))
        self.expect_refusal(1, "bomb.yaml", says=["aliases (`*name`) repeat more than 100000 values"])

    def test_devices_and_pipes(self):
        os.mkfifo(self.path("pipe"))
        self.expect_refusal(1, "pipe", says=["pipe: is a device or a pipe"])
        self.expect_refusal(1, "/dev/zero", says=["/dev/zero: is a device or a pipe"])
        self.write("model.yaml", PENDULUM)
        self.expect_refusal(1, "model.yaml", "-o", "pipe", says=["pipe: is a folder or a device"])
        self.expect_refusal(1, "model.yaml", "-o", "no/such/folder.h5", says=["there is no folder 'no/such'"])
        self.expect_refusal(1, "model.yaml", "-o", "x" * 300 + ".h5", says=["the file name is too long"])
        self.expect_refusal(1, "x" * 300, says=["cannot be read: File name too long"])
        for table in ("/dev/zero", "pipe"):
            self.write("model.yaml", PENDULUM + f"loads: {{l: {{node: bob, force: [0, 0, \"table('{table}', t)\"]}}}}\n")
            self.expect_refusal(1, "model.yaml", says=["is a device or a pipe"])

    def test_every_reader_of_files_refuses_what_is_none(self):
        os.mkfifo(self.path("pipe"))
        os.mkdir(self.path("folder"))
        ball = ("nodes: {b: {position: [0, 0, 0.1]}}\nelements: {b: {type: rigid_body, node: b, solid: {sphere: 0.1, density: 1000}}}\n"
                "joints: {c: {type: contact, between: [[{node: ground, surface: FILE}], [{node: b, sphere: 0.1}]], stiffness: 1e6}}\n")
        body = "nodes: {a: {fixed: true}}\nelements: {s: {type: superelement, file: FILE, nodes: {x: a}}}\n"
        follower = ("nodes: {a: {}}\nelements: {a: {type: rigid_body, node: a, mass: 1, inertia: [1, 1, 1]}}\n"
                    "joints: {g: {type: hinge, nodes: [ground, a], axis: [0, 0, 1], TABLE}}\n")
        for model in (ball, body, follower.replace("TABLE", "spring: {table: FILE}")):
            for name, says in (("/dev/zero", "is a device or a pipe"), ("pipe", "is a device or a pipe"), ("folder", "is a folder"),
                               ("none", "there is no such file")):
                with self.subTest(model=model, name=name):
                    self.write("model.yaml", model.replace("FILE", name))
                    done = self.run_program("model.yaml", "--check", timeout=20)
                    self.assertEqual(done.returncode, 1, done.stderr)
                    self.assertNotIn("unforeseen", done.stderr)
                    self.assertTrue(says in done.stderr or "is not a key" in done.stderr, done.stderr)

    def test_sizes_of_sections_that_cannot_be(self):
        for shape in ("i: {width: 0.05, height: SIZE, web: 0.005, flange: 0.005}", "i: {width: SIZE, height: 0.05, web: 0.005, flange: 0.005}",
                      "t: {width: SIZE, height: 0.05, web: 0.005, flange: 0.005}", "l: {width: 0.05, height: SIZE, thickness: 0.005}",
                      "box: {width: 0.05, height: SIZE, thickness: 0.005}", "rectangle: [0.1, SIZE]", "circle: SIZE", "tube: [SIZE, 0.1]"):
            for size in ("1e300", "1e155", "1e9"):
                self.write("model.yaml", "nodes: {a: {fixed: true}, b: {position: [1, 0, 0]}}\nelements:\n  m: {type: beam, nodes: [a, b], section: {"
                           + shape.replace("SIZE", size) + ", young: 2e11, poisson: 0.3, density: 7800}}\n")
                self.expect_refusal(1, "model.yaml", "--check", says=["model.yaml:3: elements.m.section.", "expected lengths in metres"])

    def test_words_that_stand_elsewhere_or_nowhere(self):
        part = "nodes: {a: {}}\nelements: {a: {type: point_mass, node: a, mass: 1}, b: {type: TYPE, node: a}}\n"
        for word, says in (("cable", "it is one of the joints: write it there"), ("hinge", "it is one of the joints"),
                           ("drive", "`drives` is a section of its own"), ("load", "`loads` is a section of its own"),
                           ("cabel", "'cabel' is not a type of the elements")):
            self.write("model.yaml", part.replace("TYPE", word))
            self.expect_refusal(1, "model.yaml", says=[f"'{word}' is not a type of the elements", says])
        self.write("model.yaml", "nodes: {a: {}}\njoints: {b: {type: beam, nodes: [ground, a]}}\n")
        self.expect_refusal(1, "model.yaml", says=["'beam' is not a type of the joints; it is one of the elements: write it there"])
        self.write("model.yaml", "nodes: {a: {}}\njoints: {b: {type: revolute, nodes: [ground, a], axis: [0, 0, 1]}}\n")
        self.expect_refusal(1, "model.yaml", says=["'revolute' is not a type of the joints; here it is called 'hinge'"])
        self.write("model.yaml", part.replace("TYPE", "rope"))
        self.expect_refusal(1, "model.yaml", says=["here it is called 'cable', one of the joints"])
        self.write("model.yaml", PENDULUM + 'loads: {l: {node: bob, force: [0, 0, "frobnicate + t"]}}\n')
        self.expect_refusal(1, "model.yaml", says=["unknown name 'frobnicate'", "'t'", "pi", "sqrt, ", "spline"])

    def test_words_of_other_programs_are_refused_with_the_words_here(self):
        bodies = "nodes: {a: {}, b: {position: [1, 0, 0]}}\nelements: {a: {type: point_mass, node: a, mass: 1}, b: {type: point_mass, node: b, mass: 1}}\n"
        hinge = "joints: {h: {type: hinge, nodes: [a, b], axis: [0, 0, 1]}}\n"
        contact = "joints: {c: {type: contact, shapes: [{node: a, sphere: 0.1}, {node: b, SHAPE}], stiffness: 1e5}}\n"
        for text, says in (
                ("markers: {m: {}}\n", "'markers' is not a key of a mechanism file; here it is called 'nodes'"),
                ("sensors: {m: t}\n", "here it is called 'measures'"), ("requests: {m: t}\n", "here it is called 'measures'"),
                ("analysis: [{type: transient, end: 1, step: 0.1}]\n", "'transient' is not a type of analysis; here it is called 'dynamic'"),
                ("analysis: [{type: dynamic, end: 1, step: 0.1}]\n", "here it is called 'duration'"),
                ("analysis: [{type: eigen, modes: 3}]\n", "'modes' is not a key of the analysis 'eigen'; here it is called 'count'"),
                (hinge + "drives: {d: {joint: h, velocity: 1}}\n", "here it is called 'rate' or 'speed'"),
                (hinge.replace("nodes: [a, b]", "i: a, j: b"), "'i' is not a key of a hinge; here both nodes are in one list: `nodes: [first, second]`"),
                ("joints: {b: {type: bushing, nodes: [a, b], k: 3}}\n", "'k' is not a key of a bushing; here it is called 'stiffness'"),
                (contact.replace("SHAPE", "sphere: 0.1, position: [0, 0, 1]"), "here it is called 'at'"),
                (contact.replace("SHAPE", "shape: cylinder, radius: 0.1"), "here the name of the shape is the key: `cylinder: [radius, length]`"),
                (contact.replace("SHAPE", "sphere: 0.1").replace("1e5", "1e5, friction: 0.5"),
                 "expected the friction of a contact as keys with values (`friction: {coefficient: 0.5}`)")):
            self.write("model.yaml", bodies + text)
            self.expect_refusal(1, "model.yaml", "--check", says=[says])

    def test_keys_are_asked_for_in_words_of_other_programs(self):
        for word, says in (("revolute", "'revolute'; here it is called 'hinge'\n\nhinge\n"), ("marker", "\n\nnode\n"), ("sensor", "\n\nmeasure\n"),
                           ("transient", "\n\nanalysis 'dynamic'\n"), ("campbell", "analysis 'campbell'\n"), ("analysis 'campbell'", "analysis 'campbell'\n")):
            done = subprocess.run([os.path.join(PROGRAMS, "bielle-mechanism"), "--keys", word], capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn(says, done.stdout)

    def test_names_under_which_no_results_can_stand(self):
        for name in (".", "/", "", "a//b", "a/./b"):
            self.write("model.yaml", PENDULUM.replace("nodes:\n", f'nodes:\n  "{name}": {{position: [0, 0, 0], fixed: true}}\n'))
            self.expect_refusal(1, "model.yaml", says=["model.yaml:5: nodes", "name"])

    def test_walls_of_no_thickness(self):
        beam = ("nodes: {a: {fixed: true}, b: {position: [1, 0, 0]}}\nelements: {beam: {type: beam, nodes: [a, b], section: "
                "{SECTION, young: 2e11, poisson: 0.3, density: 7800}}}\n")
        for section in ("box: {width: 0.05, height: 0.1, thickness: 1e-300}", "l: {width: 0.05, height: 0.1, thickness: 1e-300}",
                        "i: {width: 0.05, height: 0.1, web: 1e-300, flange: 0.01}",
                        "t: {width: 0.05, height: 0.1, web: 0.01, flange: 1e-300}"):
            self.write("model.yaml", beam.replace("SECTION", section))
            self.expect_refusal(1, "model.yaml", "--check", says=["its thinnest part"])


class Streams(CommandTest):
    program = "bielle-mechanism"

    def start(self, *arguments, **options):
        return subprocess.Popen([os.path.join(PROGRAMS, self.program), *arguments], cwd=self.folder, text=True,
                                stdin=subprocess.DEVNULL, **options)

    def complete(self, name):
        with h5py.File(os.path.join(self.folder, name)) as results:
            return results.attrs["complete"]

    def test_closed_streams_get_into_no_file(self):
        self.write("model.yaml", PENDULUM)
        command = f"'{os.path.join(PROGRAMS, self.program)}' model.yaml <&- >&- 2>&-"
        self.assertEqual(subprocess.run(["bash", "-c", command], cwd=self.folder, timeout=120, check=False).returncode, 0)
        self.assertEqual(self.complete("model.h5"), 1)

    def test_a_reader_of_messages_that_goes_away_ends_no_run(self):
        self.write("model.yaml", PENDULUM)
        ends = os.pipe()
        os.close(ends[0])
        run = self.start("model.yaml", stdout=subprocess.DEVNULL, stderr=ends[1])
        os.close(ends[1])
        self.assertEqual(run.wait(timeout=120), 0)
        self.assertEqual(self.complete("model.h5"), 1)

    def test_the_end_of_the_terminal_is_an_interruption(self):
        self.write("model.yaml", PENDULUM.replace("duration: 0.1", "duration: 1000"))
        run = self.start("model.yaml", stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        time.sleep(1.5)
        run.send_signal(signal.SIGHUP)
        self.assertIn("interrupted at t = ", run.communicate(timeout=60)[1])
        self.assertEqual(run.returncode, 2)

    def test_a_second_interruption_ends_an_analysis_without_steps(self):
        links = range(6000)
        parts = ["nodes:", *(f"  b{k}: {{position: [{k + 0.5}, 0, 0]}}" for k in links), "elements:"]
        parts += [f"  m{k}: {{type: rigid_body, node: b{k}, mass: 1, inertia: [0.001, 0.08, 0.08]}}" for k in links]
        parts += ["joints:", *(f"  j{k}: {{type: hinge, nodes: [{f'b{k - 1}' if k else 'ground'}, b{k}], position: [{k}, 0, 0], axis: [0, 1, 0], stiffness: 9}}" for k in links)]
        self.write("chain.yaml", "\n".join(parts) + "\nanalysis: [{type: eigen, count: 300}]\n")
        run = self.start("chain.yaml", stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        while not os.path.exists(self.path("chain.h5")) and run.poll() is None:
            time.sleep(0.02)
        time.sleep(1)
        run.send_signal(signal.SIGINT)
        run.send_signal(signal.SIGINT)  # one interruption, as by `timeout`
        time.sleep(1)
        self.assertIsNone(run.poll(), "the first one waits for the end of a step")
        run.send_signal(signal.SIGINT)
        self.assertEqual(run.wait(timeout=60), -signal.SIGINT)

    def test_too_little_address_space_ends_at_once(self):
        self.write("model.yaml", PENDULUM)
        for megabytes in (150, 200, 250):
            limit = megabytes << 20
            run = self.start("model.yaml", stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                             preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)))
            self.assertIn("error", run.communicate(timeout=60)[1])
            self.assertIn(run.returncode, (2, 127))  # 127 is the status of the loader if the libraries do not fit


class Tampered(CommandTest):
    program = "bielle-reduce"

    def test_numbers_that_no_body_has_and_numbers_that_were_changed(self):
        self.write("bar.geo", BAR)
        self.write("body.yaml", BODY.replace("size: 0.02, order: 2", "size: 0.04, order: 1") + "damping: {ratio: 0.01}\n")
        self.assertEqual(self.run_program("body.yaml", "-o", "good.h5", "--quiet").returncode, 0)
        path = os.path.join(self.folder, "bad.h5")
        for dataset, factor, says in (("stiffness", 1000, "mode 1 has"), ("mass", 4, "mode 1 has"), ("damping", -1, "gain energy"),
                                      ("stiffness", -1, "release energy"), ("mass", -1, "not positive definite"),
                                      ("damping", 2, "not those that were written")):
            shutil.copy(os.path.join(self.folder, "good.h5"), path)
            rewrite(path, "reduced/" + dataset, lambda v, f=factor: f * v)
            self.expect_refusal(1, "--inspect", "bad.h5", says=["bad.h5", says])
        with h5py.File(path, "r+") as file:
            del file.attrs["checksum"]
        self.assertEqual(self.run_program("--inspect", "bad.h5").returncode, 0)

    def test_two_reductions_into_one_file(self):
        self.write("bar.geo", BAR)
        self.write("body.yaml", BODY)
        runs = [subprocess.Popen([os.path.join(PROGRAMS, self.program), "body.yaml", "--quiet"], cwd=self.folder,
                                 stdin=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) for _ in range(4)]
        for run in runs:
            said = run.communicate(timeout=300)[1]
            self.assertEqual(run.returncode, 0, said)
        self.assertEqual(self.run_program("--inspect", "body.h5").returncode, 0)
        self.assertEqual([name for name in os.listdir(self.folder) if ".partial" in name], [])


if __name__ == "__main__":
    unittest.main()
