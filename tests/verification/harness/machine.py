"""The program, its libraries and the machine on which the report was computed."""

import datetime
import os
import platform
import re
import subprocess

LIBRARIES = ("openblas", "blas", "lapack", "cholmod", "umfpack", "spqr", "arpack", "hdf5", "gmsh", "yaml", "fmt",
             "stdc++")


def described(programs):
    """Pairs of a name and a text for the head of the report."""
    program = os.path.join(programs, "bielle-mechanism")
    version, *more = _output([program, "--version"]).splitlines() or [""]
    facts = [("program", version), *(tuple(line.split(maxsplit=1)) for line in more if not line.startswith("libraries")),
             ("date", datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%d %H:%M UTC")),
             ("processor", _first(r"^model name\s*:\s*(.*)$", "/proc/cpuinfo") or platform.machine()),
             ("cores", f"{len(os.sched_getaffinity(0))} available of {os.cpu_count()}; load before the run "
                       f"{os.getloadavg()[0]:.1f}"),
             ("memory", _memory()),
             ("system", " ".join(filter(None, (_first(r'^PRETTY_NAME="(.*)"$', "/etc/os-release"),
                                               f"Linux {platform.release()}")))),
             ("libraries", ", ".join(libraries(program)))]
    return [(what, text) for what, text in facts if text]


def libraries(program):
    """File names with versions of the numerical libraries that a program is linked with."""
    found = set()
    for line in _output(["ldd", program]).splitlines():
        path = line.partition("=>")[2].partition("(")[0].strip()
        if path and any(name in os.path.basename(path) for name in LIBRARIES):
            found.add(os.path.basename(os.path.realpath(path)))
    return sorted(found)


def _output(command):
    try:
        return subprocess.run(command, capture_output=True, text=True, timeout=20, check=False).stdout.strip()
    except OSError:
        return ""


def _first(pattern, path):
    """The first match of a pattern in the lines of a file; empty without one."""
    try:
        with open(path, encoding="utf-8") as file:
            match = re.search(pattern, file.read(), re.MULTILINE)
    except OSError:
        return ""
    return match.group(1) if match else ""


def _memory():
    total = _first(r"^MemTotal:\s*(\d+) kB$", "/proc/meminfo")
    return f"{int(total) / 2**20:.1f} GiB" if total else ""
