#!/usr/bin/python3
"""Writes a wheel of the Python package out of a build: write_wheel.py BUILD FOLDER. `tools/package --wheel` calls it.

The wheel is for the version of Python with which the package was built, and for systems with the shared libraries that it
was linked with: Debian's packages, which METADATA names (`Requires-External`). It contains no library of others.
Reference: PEP 427 (wheels), core metadata 2.1.
"""

import base64
import glob
import hashlib
import os
import re
import subprocess
import sys
import tempfile
import zipfile

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.realpath(__file__))))
OF_EVERY_SYSTEM = ("libc.so", "libm.so", "libgcc_s.so", "libstdc++.so", "ld-linux")
EARLIEST = (1980, 1, 1, 0, 0, 0)  # the same time for all files: the same build makes the same wheel


def version_of(build):
    with open(os.path.join(build, "CMakeCache.txt"), encoding="utf-8") as file:
        return re.search(r"^CMAKE_PROJECT_VERSION:STATIC=(.+)$", file.read(), re.MULTILINE)[1]


def installed(build, prefix):
    """Installs the component of the package below a prefix. @returns the folder of its modules"""
    subprocess.run(["cmake", "--install", build, "--component", "python", "--prefix", prefix, "--strip"], check=True,
                   stdout=subprocess.DEVNULL)
    found = glob.glob(os.path.join(prefix, "lib", "python3*", "dist-packages"))
    if not found:
        sys.exit(f"write_wheel.py: '{build}' has no Python package; configure it with -DBIELLE_PYTHON=ON")
    return found[0]


def external_packages(module):
    """Debian's packages with the shared libraries that a module is linked with; names of libraries without dpkg."""
    headers = subprocess.run(["objdump", "-p", module], check=True, capture_output=True, text=True).stdout
    needed = [name for name in re.findall(r"NEEDED\s+(\S+)", headers) if not name.startswith(OF_EVERY_SYSTEM)]
    paths = dict(re.findall(r"(\S+) => (\S+)", subprocess.run(["ldd", module], check=True, capture_output=True, text=True).stdout))
    packages = set()
    for name in needed:
        try:
            owner = subprocess.run(["dpkg-query", "-S", os.path.realpath(paths.get(name, name))], capture_output=True, text=True).stdout
        except OSError:
            owner = ""
        packages.add(owner.partition(":")[0] or name)
    return sorted(packages)


def metadata(version, python, module):
    """METADATA. NumPy 2 changed structures that pybind11 knows from its version 2.12 on; Debian 12 has 2.10."""
    minor = int(re.search(r"cpython-3(\d+)", os.path.basename(module))[1])
    lines = ["Metadata-Version: 2.1", "Name: bielle", f"Version: {version}",
             "Summary: Flexible mechanisms by finite elements: models, motions step by step, results as arrays of NumPy",
             "License: BSD-3-Clause; linked with libraries under the GPL, see LICENSES.md",
             "License-File: LICENSE", "License-File: LICENSES.md",
             "Classifier: Operating System :: POSIX :: Linux", f"Requires-Python: >=3.{minor},<3.{minor + 1}",
             "Requires-Dist: numpy (>=1.24,<2)", "Requires-Dist: h5py ; extra == 'files'", "Requires-Dist: PyYAML ; extra == 'files'",
             "Provides-Extra: files", *(f"Requires-External: {name}" for name in external_packages(module)),
             "Description-Content-Type: text/markdown"]
    with open(os.path.join(python, "README.md"), encoding="utf-8") as file:
        return "\n".join(lines) + "\n\n" + file.read()


def digest(data):
    return "sha256=" + base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()


def write_wheel(build, folder):
    """@returns the path of the wheel"""
    with tempfile.TemporaryDirectory() as prefix:
        modules = installed(build, prefix)
        core, = glob.glob(os.path.join(modules, "bielle", "_core.*.so"))
        python, machine = re.search(r"cpython-(\d+)-(\w+)-linux", os.path.basename(core)).groups()
        tag = f"cp{python}-cp{python}-linux_{machine}"
        version = version_of(build)
        information = f"bielle-{version}.dist-info"
        files = {}
        for place, folders, names in os.walk(modules):
            folders.sort()
            for name in sorted(names):
                path = os.path.join(place, name)
                with open(path, "rb") as file:
                    files[os.path.relpath(path, modules)] = file.read()
        for name in "LICENSE", "LICENSES.md":
            with open(os.path.join(ROOT, name), "rb") as file:
                files[f"{information}/{name}"] = file.read()
        files[f"{information}/METADATA"] = metadata(version, os.path.join(ROOT, "mechanism", "python"), core).encode()
        files[f"{information}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: write_wheel.py\nRoot-Is-Purelib: false\nTag: {tag}\n".encode()
    record = f"{information}/RECORD"
    lines = [f"{name},{digest(data)},{len(data)}" for name, data in files.items()] + [f"{record},,"]
    files[record] = ("\n".join(lines) + "\n").encode()
    os.makedirs(folder, exist_ok=True)
    path = os.path.join(folder, f"bielle-{version}-{tag}.whl")
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as wheel:
        for name, data in files.items():
            entry = zipfile.ZipInfo(name, EARLIEST)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = (0o755 if name.endswith(".so") else 0o644) << 16
            wheel.writestr(entry, data)
    return path


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit("write_wheel.py: expected two arguments, the folder of a build and a folder for the wheel")
    print(write_wheel(sys.argv[1], sys.argv[2]))
