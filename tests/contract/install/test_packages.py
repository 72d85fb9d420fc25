"""Tests of the Debian packages (`tools/package`). They are unpacked into an empty folder and must contain the manual,
the examples and their copyright; the commands of Getting started must print what its pages show.

The libraries and Debian's Python packages are those of the system; the programs, the tools and the Python package are those
of the folder."""

import glob
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

REPOSITORY = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", "..", ".."))
BUILD = os.environ["BIELLE_BUILD"]
sys.path.insert(0, os.path.join(REPOSITORY, "tools"))

from bielle_tools.manual import pages  # noqa: E402

NEEDED = ("cpack", "dpkg-deb", "dpkg-shlibdeps")
MISSING = [program for program in NEEDED if not shutil.which(program)]


@unittest.skipIf(MISSING, f"the programs {' '.join(MISSING)} are not installed (Debian packages cmake, dpkg, dpkg-dev)")
@unittest.skipUnless(os.path.exists(os.path.join(BUILD, "python", "bielle")), "this build has no Python package")
class Packages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        done = subprocess.run(["cpack", "--config", os.path.join(BUILD, "CPackConfig.cmake"), "-B", folder.name], capture_output=True,
                              text=True, check=False)
        if done.returncode:
            raise AssertionError(done.stdout + done.stderr)
        cls.packages = {os.path.basename(path).split("_")[0]: path for path in glob.glob(os.path.join(folder.name, "*.deb"))}
        cls.root = os.path.join(folder.name, "root")
        for path in cls.packages.values():
            subprocess.run(["dpkg-deb", "--extract", path, cls.root], check=True)
        cls.documents = os.path.join(cls.root, "usr", "share", "doc", "bielle")
        package = os.path.join(cls.root, "usr", "lib", "python3", "dist-packages")
        cls.environment = {name: value for name, value in os.environ.items() if not name.startswith("BIELLE")}
        cls.environment |= {"PATH": os.path.join(cls.root, "usr", "bin") + ":/usr/bin:/bin", "PYTHONPATH": package, "BIELLE": cls.documents}

    def field(self, package, name):
        return subprocess.run(["dpkg-deb", "--field", self.packages[package], name], capture_output=True, text=True, check=True).stdout.strip()

    def test_each_package_has_its_copyright(self):
        self.assertLessEqual({"bielle", "python3-bielle", "libbielle-dev"}, set(self.packages))
        for package in self.packages:
            with open(os.path.join(self.root, "usr", "share", "doc", package, "copyright"), encoding="utf-8") as file:
                self.assertIn("License: BSD-3-Clause\n Redistribution", file.read())

    def test_programs_depend_on_what_they_load(self):
        depends = self.field("bielle", "Depends")
        for package in "libc6", "libgmsh", "python3-h5py", "python3-matplotlib":
            self.assertIn(package, depends)
        self.assertIn("python3-vtk9", self.field("bielle", "Recommends"))

    def test_the_manual_and_its_meshes_are_there(self):
        for path in "mechanism/manual/README.md", "mechanism/manual/how_do_i/models.md", "mechanism/keys.md", "mechanism/mechanism.schema.json", \
                "mechanism/examples/slider_crank.yaml", "reduce/README.md", "tools/guide/quantities.md", "meshes/conrod.step", "LICENSES.md":
            self.assertTrue(os.path.exists(os.path.join(self.documents, path)), path)
        self.assertEqual(glob.glob(os.path.join(self.documents, "**", "*.h5"), recursive=True), [])

    def test_links_between_the_pages_lead_somewhere(self):
        for path in glob.glob(os.path.join(self.documents, "mechanism", "manual", "**", "*.md"), recursive=True):
            with open(path, encoding="utf-8") as file:
                for target in re.findall(r"\]\(([^)\s#]+\.md)", file.read()):
                    if "://" not in target:
                        found = os.path.normpath(os.path.join(os.path.dirname(path), target))
                        self.assertTrue(os.path.exists(found), f"{path}: {target}")

    def test_getting_started_is_followed(self):
        found = sorted(glob.glob(os.path.join(self.documents, "mechanism", "manual", "getting_started", "*.md")))
        self.assertEqual(len(found), 5)
        with tempfile.TemporaryDirectory() as folder:
            for page in found:
                pages.run_page(page, folder, self.environment)

    def test_tools_name_packages_of_debian(self):
        done = subprocess.run(["/usr/bin/python3", "-S", os.path.join(self.root, "usr", "share", "bielle", "tools", "bielle-plot")],
                              capture_output=True, text=True, check=False, env=self.environment)
        self.assertEqual(done.returncode, 2)
        self.assertIn("apt install", done.stderr)


if __name__ == "__main__":
    unittest.main()
