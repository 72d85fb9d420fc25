"""Installs Bielle into a folder and uses it from there: programs, tools, and the libraries from another project."""

import glob
import math
import os
import re
import subprocess
import tempfile
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
BUILD = os.environ["BIELLE_BUILD"]
PENDULUM = re.compile(r"(\d+) steps, angle (\S+) rad, tip speed (\S+) m/s, kinetic energy (\S+) J, gravity (\S+) J")


def run(*command, cwd=None):
    done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=cwd)
    if done.returncode != 0:
        raise AssertionError(f"{' '.join(command)}: status {done.returncode}\n{done.stdout}\n{done.stderr}")
    return done.stdout


class Install(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.prefix = os.path.join(cls.folder.name, "bielle")
        run("cmake", "--install", BUILD, "--prefix", cls.prefix)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def installed(self, *parts):
        return os.path.join(self.prefix, *parts)

    def test_programs_run(self):
        for program in "bielle-reduce", "bielle-mechanism":
            self.assertIn(program, run(self.installed("bin", program), "--version"))

    def test_the_module_of_gmsh_is_the_installed_one(self):
        geometry = os.path.join(self.folder.name, "box.geo")
        with open(geometry, "w", encoding="utf-8") as file:
            file.write('SetFactory("OpenCASCADE");\nBox(1) = {0, 0, 0, 1, 2, 3};\n')
        command = self.installed("bin", "bielle-reduce"), "--list", geometry
        self.assertIn("volume 1: 6 m^3", run(*command))
        module = self.installed("lib", "bielle", "bielle-gmsh.so")
        os.rename(module, module + ".sound")
        try:
            with open(module, "w", encoding="utf-8") as file:
                file.write("no library")
            self.assertIn("volume 1: 6 m^3", run(*command), "the one of the build is taken")
        finally:
            os.rename(module + ".sound", module)

    def test_tools_run_from_the_folder_of_programs(self):
        for tool in "bielle-plot", "bielle-animate", "bielle-paraview", "bielle-loads", "bielle-exchange", "bielle-rainflow", "bielle-table", "bielle-view", "bielle-study":
            self.assertIn("usage", run(self.installed("bin", tool), "--help").lower())
        self.assertTrue(os.access(self.installed("share", "bielle", "tools", "convert_mesh.py"), os.X_OK))

    def test_the_python_package_runs_from_there(self):
        if not os.path.exists(os.path.join(BUILD, "python", "bielle")):
            self.skipTest("this build has no Python package")
        package, = glob.glob(self.installed("lib", "python3*", "dist-packages"))
        model = {"nodes": {"stone": {"velocity": [0, 0, 4], "fixed": ["rx", "ry", "rz"]}}, "gravity": [0, 0, -10],
                 "elements": {"stone": {"type": "point_mass", "node": "stone", "mass": 1}},
                 "analysis": [{"type": "dynamic", "duration": 0.5, "step": 0.01}]}
        script = f"import bielle; run = bielle.run({model!r}); print(bielle.__file__); print(round(run['nodes/stone/position'][-1, 2], 9))"
        done = subprocess.run(["/usr/bin/python3", "-c", script], capture_output=True, text=True, check=True, cwd=self.folder.name,
                              env={**os.environ, "PYTHONPATH": package})
        self.assertEqual(done.stdout.split(), [os.path.join(package, "bielle", "__init__.py"), "0.75"])
        self.assertEqual(sorted(os.listdir(os.path.join(package, "bielle"))), sorted(
            name for name in os.listdir(os.path.join(BUILD, "python", "bielle")) if name != "__pycache__"))
        self.assertFalse(os.path.exists(self.installed("include", "bielle", "mechanism", "python")))

    def test_headers_keep_their_folders(self):
        self.assertTrue(os.path.exists(self.installed("include", "bielle", "reduce", "common", "error.hpp")))

    def test_another_project_links_the_libraries(self):
        build = os.path.join(self.folder.name, "build")
        run("cmake", "-S", os.path.join(HERE, "consumer"), "-B", build, f"-DCMAKE_PREFIX_PATH={self.prefix}",
            "-DCMAKE_BUILD_TYPE=Release")
        run("cmake", "--build", build)
        self.assertEqual(run(os.path.join(build, "consumer"), cwd=build), "rigid 0.100\n")
        before = sorted(os.listdir(build))
        steps, stop, restored = run(os.path.join(build, "pendulum"), cwd=build).splitlines()
        self.assertEqual(sorted(os.listdir(build)), before, "a session needs no file")
        self.check_pendulum(*PENDULUM.fullmatch(steps).groups())
        # The time is half a period with an amplitude of 90 degrees, 2 K(sin 45) / omega_0, without the last 0.04 rad,
        # rounded to steps.
        omega_squared = 1.5 * 9.81
        time = 2 * 1.8540747 / math.sqrt(omega_squared) - math.sqrt(2 * (math.pi - 3.1) / omega_squared)
        found = re.fullmatch(r"stopped at the other side after (\S+) s", stop).group(1)
        self.assertAlmostEqual(float(found), time, delta=0.0011)
        self.assertEqual(restored, "restored: the same to the last bit")

    def check_pendulum(self, steps, angle, speed, kinetic, gravity):
        self.assertEqual(steps, "500")
        # The tip of a rod of 1 m that falls from the horizontal has speed^2 = 3 g sin(angle), by the conservation of
        # energy.
        self.assertAlmostEqual(float(speed) ** 2, 3 * 9.81 * math.sin(float(angle)), delta=0.03)
        self.assertAlmostEqual(float(gravity), -9.81 * math.sin(float(angle)), delta=0.02)
        self.assertAlmostEqual(float(kinetic) + float(gravity), 0, delta=0.01)

    def test_the_example_in_the_documentation_is_the_one_that_is_compiled(self):
        with open(os.path.join(HERE, "consumer", "pendulum.cpp"), encoding="utf-8") as file:
            source = file.read()
        with open(os.path.join(HERE, "..", "..", "..", "mechanism", "README.md"), encoding="utf-8") as file:
            shown = re.search(r"```cpp\n(.*?)```", file.read(), re.DOTALL).group(1)
        self.assertIn(shown, source)


if __name__ == "__main__":
    unittest.main()
