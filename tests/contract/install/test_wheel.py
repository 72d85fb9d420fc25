"""Tests of the wheel of the Python package (`tools/package --wheel`): its contents, its record, and a run of a
model."""

import base64
import csv
import hashlib
import io
import os
import re
import subprocess
import sys
import tempfile
import unittest
import zipfile

REPOSITORY = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", "..", ".."))
BUILD = os.environ["BIELLE_BUILD"]
sys.path.insert(0, os.path.join(REPOSITORY, "tools", "cmake"))

from write_wheel import write_wheel  # noqa: E402


@unittest.skipUnless(os.path.exists(os.path.join(BUILD, "python", "bielle")), "this build has no Python package")
class Wheel(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.path = write_wheel(BUILD, os.path.join(cls.folder.name, "wheels"))
        with zipfile.ZipFile(cls.path) as wheel:
            cls.files = {name: wheel.read(name) for name in wheel.namelist()}

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def information(self, name):
        found, = [data for path, data in self.files.items() if re.fullmatch(rf"bielle-[\d.]+\.dist-info/{name}", path)]
        return found.decode()

    def test_name_and_tags_agree(self):
        version, tag = re.fullmatch(r"bielle-([\d.]+)-(cp3\d+-cp3\d+-linux_\w+)\.whl", os.path.basename(self.path)).groups()
        self.assertIn(f"\nVersion: {version}\n", self.information("METADATA"))
        self.assertIn(f"\nTag: {tag}\n", self.information("WHEEL"))
        self.assertEqual(tag.split("-")[0], f"cp3{sys.version_info.minor}")

    def test_the_record_lists_each_file_with_its_sum(self):
        rows = list(csv.reader(io.StringIO(self.information("RECORD"))))
        self.assertEqual([row[0] for row in rows], list(self.files))
        for name, digest, size in rows[:-1]:
            made = base64.urlsafe_b64encode(hashlib.sha256(self.files[name]).digest()).rstrip(b"=").decode()
            self.assertEqual((digest, int(size)), (f"sha256={made}", len(self.files[name])), name)
        self.assertEqual(rows[-1][1:], ["", ""])

    def test_it_has_the_package_and_no_library_of_others(self):
        libraries = [name for name in self.files if ".so" in name]
        self.assertEqual(len(libraries), 1)
        self.assertRegex(libraries[0], r"^bielle/_core\.cpython-\w+-\w+-linux-gnu\.so$")
        for name in "bielle/__init__.py", "bielle/_core.pyi", "bielle/py.typed", "bielle_tools/__init__.py":
            self.assertIn(name, self.files)
        self.assertIn("GPL", self.information("LICENSES.md"))
        external = re.findall(r"^Requires-External: (.+)$", self.information("METADATA"), re.MULTILINE)
        self.assertIn("libcholmod3", external)
        self.assertFalse([name for name in external if "gmsh" in name], external)

    def test_the_same_build_makes_the_same_wheel(self):
        again = write_wheel(BUILD, os.path.join(self.folder.name, "again"))
        with open(again, "rb") as one, open(self.path, "rb") as other:
            self.assertEqual(one.read(), other.read())

    def test_a_model_runs_from_it(self):
        if subprocess.run(["/usr/bin/python3", "-m", "pip", "--version"], capture_output=True).returncode:
            self.skipTest("pip is not installed (Debian package python3-pip)")
        target = os.path.join(self.folder.name, "target")
        subprocess.run(["/usr/bin/python3", "-m", "pip", "install", "--quiet", "--no-index", "--no-deps", "--target", target, self.path],
                       check=True, capture_output=True)
        script = ("import bielle; run = bielle.run({'nodes': {'a': {'velocity': [0, 0, 4], 'fixed': ['rx', 'ry', 'rz']}}, 'gravity': [0, 0, -10], 'elements': {'a': "
                  "{'type': 'point_mass', 'node': 'a', 'mass': 1}}, 'analysis': [{'type': 'dynamic', 'duration': 0.5, 'step': 0.01}]}); "
                  "print(bielle.__file__); print(round(run['nodes/a/position'][-1, 2], 9))")
        done = subprocess.run(["/usr/bin/python3", "-c", script], capture_output=True, text=True, cwd=self.folder.name,
                              env={**os.environ, "PYTHONPATH": target})
        self.assertEqual(done.stdout.split(), [os.path.join(target, "bielle", "__init__.py"), "0.75"], done.stderr)


if __name__ == "__main__":
    unittest.main()
