"""The rule that says which folders a folder may include, which is the layout of the project.

A folder includes only from itself and from the previous ones in its program's list. `mechanism` may include the common
code, the superelement, dense algebra and eigenpairs from `reduce`; `reduce` includes nothing of `mechanism`. Moving
parts (elements, joints) and solving parts (systems, solvers) share the model, and include nothing of each other.
"""

import os
import re

# "" is the program's own folder, which contains main.
FOLDERS = {
    "reduce": ["common", "common/process", "common/files", "common/formula", "common/input", "dense", "sparse", "spectral", "superelement", "mesh", "mesh/gmsh", "fe", "reduction", "matrices", "distributed", "distributed/ranks",
               "body_file", "report", ""],
    "mechanism": ["math", "drawing", "model", "reading", "language", "measures", "laws", "contacts", "drawing/reading",
                  "elements/beam", "elements/control", "elements/forces", "elements/rigid_body",
                  "elements/superelement/recovery", "elements/superelement",
                  "joints", "joints/friction", "joints/actions", "joints/cables", "joints/couplings", "joints/flexible", "joints/gears", "joints/pairs", "joints/cams", "joints/tyres",
                  "hydraulics/circuit", "hydraulics/lines", "hydraulics/actuators", "hydraulics/reading",
                  "system", "solvers/newton", "solvers/constraints", "solvers/start", "solvers/linearised", "solvers/statics", "solvers/dynamics",
                  "results", "session", "analyses", "io", "python", ""],
}
SHARED = ["common", "common/process", "common/files", "common/formula", "common/input", "dense", "spectral", "superelement"]
COMPONENTS = [f for f in FOLDERS["mechanism"] if f.split("/")[0] in ("measures", "laws", "contacts", "elements", "joints", "hydraulics")]
SOLVING = [f for f in FOLDERS["mechanism"] if f.split("/")[0] in ("system", "solvers")]


def forbidden(folder, wanted):
    """Tells whether a folder of the mechanism must not include a previous one of the list."""
    if folder in SOLVING:
        return wanted in COMPONENTS + ["reading"] or {folder, wanted} == {"solvers/statics", "solvers/dynamics"}
    if folder.split("/")[0] in ("elements", "joints", "hydraulics") and wanted.startswith("elements/"):
        return not (wanted + "/").startswith(folder + "/")
    return False


INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"')


def place_of(path):
    """Returns program and folder of a file or include path: ("reduce", "mesh"), ("mechanism", "joints/pairs"),
    ("mechanism", "")."""
    program, *rest = path.split("/")
    return program, "/".join(rest[:-1])


def fault_of(path, included):
    """Returns the reason why the file at `path` must not include `included`, or None. Both are relative to the
    project."""
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
    if program == "mechanism" and forbidden(folder, wanted):
        return f"'{program}/{folder}' must not know '{program}/{wanted}'"
    return None


def sources(root):
    """Returns the paths of all C++ files of both programs, relative to the project."""
    for program in FOLDERS:
        for folder, _, files in os.walk(os.path.join(root, program)):
            for name in sorted(files):
                if name.endswith((".hpp", ".cpp")):
                    yield os.path.relpath(os.path.join(folder, name), root)


def faults(root):
    """Returns all includes that break the rule, as `file:line: include: why`."""
    found = []
    for path in sources(root):
        with open(os.path.join(root, path), encoding="utf-8") as file:
            for number, line in enumerate(file, 1):
                match = INCLUDE.match(line)
                fault = match and fault_of(path, match.group(1))
                if fault:
                    found.append(f"{path}:{number}: \"{match.group(1)}\": {fault}")
    return found
