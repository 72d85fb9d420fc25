"""Tests of tools/install: it is silent if everything is installed, installs missing packages, and gives advice if it
cannot. Stand-ins replace apt."""

import os
import stat
import subprocess
import unittest

from box_mesh import REPOSITORY, InFolder

INSTALL = os.path.join(REPOSITORY, "tools", "install")
ALL_THERE = "echo installed"
ONE_MISSING = 'case "$*" in *libgmsh-dev*) exit 1 ;; esac; echo installed'
LOGGED = 'echo "$*" >> "$LOG"'


class Install(InFolder):
    def setUp(self):
        super().setUp()
        self.log = os.path.join(self.folder, "log")
        for name in ("bash", "sed", "env", "mktemp", "rm", "tail", "readlink", "dirname"):
            os.symlink(f"/usr/bin/{name}", os.path.join(self.folder, name))

    def stand_in(self, name, script):
        path = os.path.join(self.folder, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write("#!/usr/bin/bash\n" + script + "\n")
        os.chmod(path, stat.S_IRWXU)

    def install(self, *arguments, **stand_ins):
        for name, script in stand_ins.items():
            self.stand_in(name.replace("_", "-"), script)
        return subprocess.run([INSTALL, *arguments], capture_output=True, text=True, timeout=60, stdin=subprocess.DEVNULL,
                              env={"PATH": self.folder, "LOG": self.log})

    def commands(self):
        if not os.path.exists(self.log):
            return []
        with open(self.log, encoding="utf-8") as file:
            return file.read().splitlines()

    def test_silent_when_all_is_there(self):
        done = self.install(dpkg_query=ALL_THERE, apt_get=LOGGED, id="echo 0")
        self.assertEqual((done.returncode, done.stdout, done.stderr, self.commands()), (0, "", "", []))

    def test_root_installs_what_is_missing(self):
        done = self.install(dpkg_query=ONE_MISSING, apt_get=LOGGED, id="echo 0")
        self.assertEqual(done.returncode, 0, done.stderr)
        update, install = self.commands()
        self.assertTrue(update.endswith(" update"))
        self.assertTrue(install.endswith(" libgmsh-dev"))
        self.assertIn(" install -y ", install)

    def test_what_several_machines_need_is_installed_on_request(self):
        one_missing = ONE_MISSING.replace("libgmsh-dev", "libslepc-real-dev")
        self.assertEqual(self.install(dpkg_query=one_missing, apt_get=LOGGED, id="echo 0").returncode, 0)
        self.assertEqual(self.commands(), [])
        self.assertEqual(self.install("--with-mpi").returncode, 0)
        self.assertTrue(self.commands()[-1].endswith(" libslepc-real-dev"))

    def test_others_install_through_sudo(self):
        done = self.install(dpkg_query=ONE_MISSING, apt_get=LOGGED, id="echo 1000", sudo='[ "$1" = -n ] || "$@"')
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(len(self.commands()), 2)

    def test_without_sudo_says_what_root_must_run(self):
        for sudo in ({}, {"sudo": "exit 1"}):  # no sudo, or a sudo that would ask for a password
            done = self.install(dpkg_query=ONE_MISSING, apt_get=LOGGED, id="echo 1000", **sudo)
            self.assertEqual(done.returncode, 1)
            self.assertIn("As root, run", done.stderr)
            self.assertTrue(done.stderr.rstrip().endswith(" libgmsh-dev"), done.stderr)
            self.assertEqual(self.commands(), [])

    def test_without_apt_lists_the_packages(self):
        done = self.install()
        self.assertEqual(done.returncode, 1)
        self.assertIn("Debian 12", done.stderr)
        self.assertIn("libsuitesparse-dev", done.stderr)

    def test_failure_of_apt_shows_its_words(self):
        done = self.install(dpkg_query=ONE_MISSING, apt_get="echo no such package >&2; exit 100", id="echo 0")
        self.assertEqual(done.returncode, 1)
        self.assertIn("no such package", done.stderr)
        self.assertIn("apt-get failed", done.stderr)

    def test_list_and_wrong_options(self):
        done = self.install("--list")
        self.assertEqual(done.returncode, 0)
        self.assertIn("libgmsh-dev", done.stdout.split())
        done = self.install("--lsit")
        self.assertEqual(done.returncode, 1)
        self.assertIn("'--lsit'", done.stderr)


if __name__ == "__main__":
    unittest.main()
