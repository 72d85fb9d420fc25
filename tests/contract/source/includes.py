"""Which folder may include which: the layout of the project as a rule.

A folder includes only from itself and from those before it in its program's list. `mechanism` knows of `reduce` the common floor,
the superelement and the sparse solvers; `reduce` knows nothing of `mechanism`.
"""

import os
import re

# "" is the program's own folder: what stands beside main.
FOLDERS = {
    "reduce": ["common", "superelement", "spectral", "mesh", "fe", "reduction", ""],
    "mechanism": ["math", "system", "measures", "elements", "joints", "solvers", "session", "analyses", "io", ""],
}
SHARED = ["common", "superelement", "spectral"]
# Integration schemes know no measure, no element and no joint.
FORBIDDEN = {("mechanism", "solvers"): ["measures", "elements", "joints"]}

INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"')


def place_of(path):
    """Program and folder of a file or include path: ("reduce", "mesh"), ("mechanism", "")."""
    program, *rest = path.split("/")
    return program, rest[0] if len(rest) > 1 else ""


def fault_of(path, included):
    """Why the file at `path` must not include `included`, or None. Both are relative to the project."""
    program, folder = place_of(path)
    other, wanted = place_of(included)
    if other not in FOLDERS or "/" not in included:
        return "write project includes from the root: \"reduce/...\" or \"mechanism/...\""
    if wanted not in FOLDERS[other]:
        return f"'{other}/{wanted}' is not in the list of folders"
    if other != program:
        if program == "reduce":
            return "reduce must not know mechanism"
        if wanted not in SHARED:
            return f"mechanism may include {', '.join('reduce/' + f for f in SHARED)} only"
        return None
    order = FOLDERS[program]
    if order.index(wanted) > order.index(folder):
        return f"'{program}/{folder}' stands below '{program}/{wanted}'"
    if wanted in FORBIDDEN.get((program, folder), []):
        return f"'{program}/{folder}' must not know '{program}/{wanted}'"
    return None


def sources(root):
    """Paths of all C++ files of both programs, relative to the project."""
    for program in FOLDERS:
        for folder, _, files in os.walk(os.path.join(root, program)):
            for name in sorted(files):
                if name.endswith((".hpp", ".cpp")):
                    yield os.path.relpath(os.path.join(folder, name), root)


def faults(root):
    """All includes that break the rule, as `file:line: include: why`."""
    found = []
    for path in sources(root):
        with open(os.path.join(root, path), encoding="utf-8") as file:
            for number, line in enumerate(file, 1):
                match = INCLUDE.match(line)
                fault = match and fault_of(path, match.group(1))
                if fault:
                    found.append(f"{path}:{number}: \"{match.group(1)}\": {fault}")
    return found
