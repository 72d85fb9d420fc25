"""Tests that every header compiles alone, so that including it needs nothing else.

The compiler is called as for a source of the same folder (`compile_commands.json` of the build), but for a file that holds the
header twice, and to check it only. Headers that include Eigen's core, themselves or by others, get it precompiled: they have
it in any case, and it takes half of the time.

BIELLE_HEADERS=K/N, with K from 0 to N - 1, checks every N-th header only, beginning with number K.
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
    """Returns the sources that a file of the build compiles: itself, or those of a batch (`BIELLE_UNITY`)."""
    if "/Unity/" not in file:
        return [file]
    with open(file, encoding="utf-8") as batch:
        return re.findall(r'^#include "(.*\.cpp)"$', batch.read(), re.MULTILINE)


def without_help(words):
    """Returns a compiler call without ccache (`env NAME=VALUE ccache`) and without the precompiled header at its
    begin."""
    while os.path.basename(words[0]) in ("env", "ccache") or re.match(r"\w+=", words[0]):
        words = words[1:]
    while "-include" in words:
        at = words.index("-include")
        words = words[:at] + words[at + 2:]
    return [word for word in words if word != "-Winvalid-pch"]


def includes_of(header, known):
    """The headers, of Bielle and of others, that a header of Bielle includes, itself or by others. known: those found so far"""
    if header not in known:
        known[header] = set()
        with open(os.path.join(ROOT, header), encoding="utf-8") as file:
            for name, bracket in re.findall(r'^\s*#\s*include\s*[<"]([^">]+)([">])', file.read(), re.MULTILINE):
                known[header].add(name)
                if bracket == '"':
                    known[header] |= includes_of(name, known)
    return known[header]


def flags_of(call):
    """Returns the arguments of a compiler call on which a precompiled header depends: all except the folders of
    includes."""
    return tuple(word for before, word in zip(["", *call], call) if "-isystem" not in (before, word) and not word.startswith("-I"))


def precompiled(calls, folder, pool):
    """Compiles Eigen's core once for each kind of compiler call. @returns flags -> the arguments that use it"""
    def compile_core(numbered):
        number, call = numbered
        header = os.path.join(folder, f"eigen_{number}.hpp")
        with open(header, "w", encoding="utf-8") as file:
            file.write("#include <Eigen/Core>\n")
        subprocess.run([*call, "-x", "c++-header", header, "-o", header + ".gch"], check=True)
        return ["-include", header]
    kinds = {flags_of(call): call for call in calls}
    return dict(zip(kinds, pool.map(compile_core, enumerate(kinds.values()))))


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
        turn, turns = map(int, os.environ.get("BIELLE_HEADERS", "0/1").split("/"))
        known = {}
        jobs = [(h, calls[os.path.dirname(h)], "Eigen/Core" in includes_of(h, known)) for h in sorted(headers)[turn::turns]]
        with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            eigen = precompiled([call for _, call, heavy in jobs if heavy], folder, pool)
            errors = list(pool.map(lambda job: errors_of(job[0], [*job[1], *(eigen[flags_of(job[1])] if job[2] else [])], folder), jobs))
        self.assertEqual([e for e in errors if e], [])


if __name__ == "__main__":
    unittest.main()
