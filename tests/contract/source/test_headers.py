"""Every header compiles alone: whoever includes it needs to know nothing else.

The compiler is called as for a source of the same folder (`compile_commands.json` of the build), but for a file that holds the
header twice, and to check it only.
"""

import concurrent.futures
import json
import os
import re
import shlex
import subprocess
import tempfile
import unittest

from includes import sources

ROOT = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", "..", ".."))
BUILD = os.environ["BIELLE_BUILD"]
OPTIONAL = {"mechanism/python", "reduce/distributed/ranks"}  # built where pybind11 is, and MPI


def compilers():
    """Folder -> compiler call without output and source, for each folder that is built."""
    calls = {}
    with open(os.path.join(BUILD, "compile_commands.json"), encoding="utf-8") as file:
        for entry in json.load(file):
            words = without_help(shlex.split(entry["command"]))
            for source in compiled_by(entry["file"]):
                calls.setdefault(os.path.relpath(os.path.dirname(source), ROOT), words[:words.index("-o")])
    return calls


def compiled_by(file):
    """The sources that a file of the build compiles: itself, or those of a batch (`BIELLE_UNITY`)."""
    if "/Unity/" not in file:
        return [file]
    with open(file, encoding="utf-8") as batch:
        return re.findall(r'^#include "(.*\.cpp)"$', batch.read(), re.MULTILINE)


def without_help(words):
    """A compiler call without ccache (`env NAME=VALUE ccache`) and without the precompiled header that goes first."""
    while os.path.basename(words[0]) in ("env", "ccache") or re.match(r"\w+=", words[0]):
        words = words[1:]
    while "-include" in words:
        at = words.index("-include")
        words = words[:at] + words[at + 2:]
    return [word for word in words if word != "-Winvalid-pch"]


def errors_of(header, call, folder):
    source = os.path.join(folder, re.sub(r"\W", "_", header) + ".cpp")
    with open(source, "w", encoding="utf-8") as file:
        file.write(f'#include "{header}"\n#include "{header}"\n')
    run = subprocess.run([*call, "-Werror", "-fsyntax-only", source], capture_output=True, text=True, check=False)
    return "" if run.returncode == 0 else f"{header} does not compile alone:\n{run.stderr[:2000]}"


class Headers(unittest.TestCase):
    def test_every_header_compiles_alone(self):
        calls = compilers()
        left_out = OPTIONAL - set(calls)
        headers = [path for path in sources(ROOT) if path.endswith(".hpp") and os.path.dirname(path) not in left_out]
        self.assertGreater(len(headers), 20)
        self.assertEqual({os.path.dirname(h) for h in headers} - set(calls), set(), "folders that are not built")
        with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            errors = list(pool.map(lambda h: errors_of(h, calls[os.path.dirname(h)], folder), headers))
        self.assertEqual([e for e in errors if e], [])


if __name__ == "__main__":
    unittest.main()
