"""Tests of tools/tidy: the files that it checks, lists or omits, and its exit status. Stand-ins replace CMake and
clang-tidy: one lists the sources of this test, the other reports an error in files that contain `fault`."""

import os
import shutil
import stat
import subprocess
import unittest

from box_mesh import REPOSITORY, InFolder

CMAKE = """mkdir -p build/tidy
for file in one two three; do echo "\\"file\\": \\"$PWD/$file.cpp\\""; done > build/tidy/compile_commands.json"""
CLANG_TIDY = """file=${@: -1}; echo "$file" >> "$LOG"
if grep -q fault "$file"; then echo "$file:1: error: a fault"; exit 1; fi"""


class Tidy(InFolder):
    def setUp(self):
        super().setUp()
        self.log = self.path("log")
        os.mkdir(self.path("stand_ins"))
        for name, script in (("cmake", CMAKE), ("clang-tidy-14", CLANG_TIDY)):
            path = self.write(os.path.join("stand_ins", name), "#!/usr/bin/bash\n" + script + "\n")
            os.chmod(path, stat.S_IRWXU)
        os.makedirs(self.path("repository/tools"))
        shutil.copy(os.path.join(REPOSITORY, "tools", "tidy"), self.path("repository/tools/tidy"))
        self.git("init", "--quiet", "--initial-branch=main")
        self.commit({"one.cpp": "", "one.hpp": "", "two.cpp": "", "note.md": ""})

    def git(self, *arguments):
        identity = ("-c", "user.name=a", "-c", "user.email=a@localhost")
        subprocess.run(["git", *identity, *arguments], cwd=self.path("repository"), check=True, capture_output=True)

    def commit(self, files):
        for name, text in files.items():
            self.write(os.path.join("repository", name), text)
        self.git("add", "--all")
        self.git("commit", "--quiet", "-m", "x")

    def tidy(self, *arguments, status=0):
        """@returns the files that were checked, and the whole output"""
        if os.path.exists(self.log):
            os.remove(self.log)
        environment = dict(os.environ, LOG=self.log, PATH=self.path("stand_ins") + os.pathsep + os.environ["PATH"])
        done = subprocess.run([self.path("repository/tools/tidy"), *arguments], capture_output=True, text=True, timeout=60,
                              stdin=subprocess.DEVNULL, env=environment)
        said = done.stdout + done.stderr
        self.assertEqual(done.returncode, status, said)
        if not os.path.exists(self.log):
            return [], said
        with open(self.log, encoding="utf-8") as file:
            return sorted(file.read().split()), said

    def test_the_first_commit_has_nothing_before_it(self):
        checked, said = self.tidy()
        self.assertEqual(checked, [])
        self.assertIn("not checked: this clone has no commit before the last", said)

    def test_changes_of_the_last_commit_and_after_it(self):
        self.commit({"one.cpp": "1\n", "note.md": "1\n"})
        self.assertEqual(self.tidy()[0], ["one.cpp"])
        self.write("repository/two.cpp", "1\n")
        self.assertEqual(self.tidy()[0], ["one.cpp", "two.cpp"])

    def test_changes_since_a_commit(self):
        self.git("switch", "--quiet", "-c", "branch")
        self.commit({"one.cpp": "1\n"})
        self.commit({"two.cpp": "1\n"})
        self.assertEqual(self.tidy()[0], ["two.cpp"])
        self.assertEqual(self.tidy("--since", "main")[0], ["one.cpp", "two.cpp"])

    def test_a_header_is_checked_with_its_source_or_by_itself(self):
        self.commit({"one.hpp": "1\n", "alone.hpp": "1\n"})
        self.assertEqual(self.tidy()[0], ["alone.hpp", "one.hpp"])
        self.write("repository/one.cpp", "1\n")
        self.assertEqual(self.tidy()[0], ["alone.hpp", "one.cpp"])

    def test_removed_files_and_those_of_other_builds_are_left_out(self):
        self.git("rm", "--quiet", "two.cpp")
        self.commit({"elsewhere.cpp": "1\n"})
        checked, said = self.tidy()
        self.assertEqual(checked, [])
        self.assertIn("not checked: elsewhere.cpp is not compiled here", said)
        self.assertIn("no file to check", said)

    def test_no_more_than_a_number_of_files_and_the_others_are_listed(self):
        self.commit({"one.cpp": "1\n", "two.cpp": "1\n2\n3\n", "three.cpp": "1\n2\n"})
        checked, said = self.tidy("--most", "2")
        self.assertEqual(checked, ["three.cpp", "two.cpp"])
        self.assertIn("not checked: one.cpp\n", said)

    def test_a_finding_fails_and_all_files_are_checked(self):
        self.commit({"one.cpp": "fault\n", "two.cpp": "1\n", "three.cpp": "1\n"})
        checked, said = self.tidy(status=1)
        self.assertEqual(checked, ["one.cpp", "three.cpp", "two.cpp"])
        self.assertIn("one.cpp:1: error: a fault", said)
        self.assertEqual(self.tidy("two.cpp")[0], ["two.cpp"])

    def test_wrong_arguments(self):
        for arguments, says in ((["--since"], "--since needs a commit"), (["--since", "nothing"], "'nothing' is not a commit"),
                                (["--most"], "--most needs a number"), (["--most", "0"], "--most needs a number"),
                                (["--most", "-1"], "--most needs a number"), (["--most", "x"], "--most needs a number"),
                                (["--other"], "'--other' is not an option"), (["four.cpp"], "there is no file 'four.cpp'")):
            with self.subTest(arguments=arguments):
                self.assertIn(says, self.tidy(*arguments, status=1)[1])

    def test_a_missing_clang_tidy_is_said(self):
        os.remove(self.path("stand_ins/clang-tidy-14"))
        for name in ("bash", "dirname", "readlink"):
            os.symlink(f"/usr/bin/{name}", self.path(f"stand_ins/{name}"))
        done = subprocess.run([self.path("repository/tools/tidy")], capture_output=True, text=True, timeout=60,
                              env={"PATH": self.path("stand_ins")})
        self.assertEqual(done.returncode, 1)
        self.assertIn("tools/install --with-checks", done.stderr)


if __name__ == "__main__":
    unittest.main()
