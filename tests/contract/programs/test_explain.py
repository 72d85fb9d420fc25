"""Tests of --explain, of the hint after an error on a terminal, and of --version."""

import os
import pty
import re
import subprocess
import unittest

import h5py

from command import PROGRAMS, CommandTest
from in_folder import REPOSITORY

FALLING = "{nodes: {a: {fixed: [rx, ry, rz]}}, elements: {a: {type: point_mass, node: a, mass: 1}}, analysis: [{type: dynamic, duration: 0.1, step: 0.1}]}"
WITHOUT_ANALYSIS = "{nodes: {a: {}}, elements: {a: {type: point_mass, node: a, mass: 1}}}\n"


class Explain(CommandTest):
    program = "bielle-mechanism"

    def explain(self, *arguments, program="bielle-mechanism"):
        return subprocess.run([os.path.join(PROGRAMS, program), "--explain", *arguments], capture_output=True, text=True, timeout=60)

    def on_a_terminal(self, *arguments):
        """Returns the output of the program if its standard error is a terminal."""
        ours, theirs = pty.openpty()
        with subprocess.Popen([os.path.join(PROGRAMS, self.program), *arguments], stderr=theirs, stdout=subprocess.PIPE, cwd=self.folder) as process:
            os.close(theirs)
            text = b""
            while True:
                try:
                    part = os.read(ours, 4096)
                except OSError:  # the program has ended
                    break
                if not part:
                    break
                text += part
            process.wait(timeout=60)
        os.close(ours)
        return process.returncode, text.decode().replace("\r\n", "\n")

    def test_both_programs_explain_by_name_and_message(self):
        for program in "bielle-mechanism", "bielle-reduce":
            for asked in "nothing-to-do", "bielle-mechanism: error: m.yaml: nothing to do: the file has no `analysis`":
                done = self.explain(asked, program=program)
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                self.assertTrue(done.stdout.startswith("nothing-to-do\n\n    nothing to do: the file has no `analysis`\n\nCause. "), done.stdout)
                self.assertIn("\nCure. ", done.stdout)

    def test_all_pages_are_compiled_in(self):
        listed = {line.split()[0] for line in self.explain("all").stdout.splitlines()}
        folder = os.path.join(REPOSITORY, "mechanism", "manual", "messages")
        named = set()
        for page in os.listdir(folder):
            if page != "README.md":
                with open(os.path.join(folder, page), encoding="utf-8") as file:
                    named |= set(re.findall(r"^## (.+)$", file.read(), re.MULTILINE))
        self.assertEqual(listed, named)
        self.assertGreater(len(listed), 100)

    def test_wrong_requests(self):
        for asked, says in ("singular-equatons", "did you mean 'singular-equations'?"), ("", "no explanation fits"):
            self.expect_refusal(1, "--explain", asked, says=[says])
        self.expect_refusal(1, "--explain", says=["--explain"])

    def test_a_terminal_gets_the_name_of_the_explanation(self):
        self.write("model.yaml", WITHOUT_ANALYSIS)
        status, text = self.on_a_terminal("model.yaml")
        self.assertEqual(status, 1)
        error, hint = text.splitlines()
        self.assertIn("error: model.yaml: nothing to do", error)
        self.assertEqual(hint, "bielle-mechanism --explain nothing-to-do says more")
        self.write("slow.yaml", FALLING.replace("duration: 0.1", "duration: -1"))
        status, text = self.on_a_terminal("slow.yaml")
        self.assertEqual((status, len(text.splitlines())), (1, 1), text)  # this message has no explanation

    def test_scripts_get_the_error_alone(self):
        self.write("model.yaml", WITHOUT_ANALYSIS)
        done = self.run_program("model.yaml")
        self.assertEqual((done.returncode, done.stderr.count("\n")), (1, 1), done.stderr)

    def test_version_tells_commit_build_and_libraries(self):
        for program, library in ("bielle-mechanism", "SuiteSparse"), ("bielle-reduce", "gmsh"):
            lines = subprocess.run([os.path.join(PROGRAMS, program), "--version"], capture_output=True, text=True, check=True).stdout.splitlines()
            self.assertRegex(lines[0], rf"^{program} \d+\.\d+\.\d+$")
            self.assertRegex(lines[1], r"^commit     ([0-9a-f]{12}(-modified)?|unknown)$")
            self.assertRegex(lines[2], r"^build      \w+, \w+ [\d.]+, \w+$")
            self.assertIn(library, lines[3])
            for part in lines[3].removeprefix("libraries  ").split(", "):
                self.assertRegex(part, r"^[\w -]+ \d+(\.\d+)+$")
            self.assertEqual(len(lines), 4)
            self.assertEqual("gmsh" in lines[3], program == "bielle-reduce")  # the other one does not link it

    def test_the_commit_is_that_of_the_repository(self):
        if not os.path.exists(os.path.join(REPOSITORY, ".git")):
            self.skipTest("no repository")
        told = self.run_program("--version").stdout.splitlines()[1].split()[1].removesuffix("-modified")
        known = subprocess.run(["git", "-C", REPOSITORY, "cat-file", "-t", told], capture_output=True, text=True)
        self.assertEqual(known.stdout.strip(), "commit", known.stderr)

    def test_results_name_their_program_and_commit(self):
        self.summary(FALLING)
        version, commit = self.run_program("--version").stdout.splitlines()[:2]
        with h5py.File(self.path("model.h5")) as results:
            self.assertEqual(results.attrs["created_by"], f"{version} (commit {commit.split()[1]})")


if __name__ == "__main__":
    unittest.main()
