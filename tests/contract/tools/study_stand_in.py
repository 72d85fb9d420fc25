"""A stand-in for bielle-mechanism in tests of tools/bielle-study, whose results are known in closed form.

It does not import h5py, which would take nine tenths of its time. It copies results that are written once, and replaces
numbers and the name of the program.
"""

import io
import os
import stat

import h5py

from box_mesh import REPOSITORY, InFolder
from python_tool import prepare_figures, run_python_tool

# The modules of bielle-study are imported once for all of its calls.
import bielle_tools.figures.plot_style  # noqa: F401
import bielle_tools.study.figures  # noqa: F401
import bielle_tools.study.jobs  # noqa: F401
import bielle_tools.study.study  # noqa: F401

STUDY = os.path.join(REPOSITORY, "tools", "bielle-study")
SPEED, MASS = 1.0123456789, 2.3456789012  # numbers of the results that are copied
PROGRAM = "bielle-mechanism 0.0 (commit stand-in)"
# The script has the arguments of bielle-mechanism. It doubles the parameter `speed`, fails if `mass` is negative, and
# writes a log of its runs.
STAND_IN = f"""#!/usr/bin/python3 -SE
import os, struct, sys
PROGRAM = "{PROGRAM}"
folder, arguments = os.path.dirname(sys.argv[0]), sys.argv[1:]
values = dict(a.split("=", 1) for k, a in enumerate(arguments) if arguments[k - 1] == "--set")
with open(os.path.join(folder, "log"), "a") as log:
    log.write(" ".join(values.values()) + "\\n")
if "sped" in values:
    print("bielle-mechanism: error: --set sped=1: model.yaml has no parameter 'sped'; did you mean 'speed'?", file=sys.stderr)
    sys.exit(1)
if values["speed"] == "13":
    os.kill(os.getpid(), 9)
if values["speed"] == "1000":
    import time
    time.sleep(60)
if float(values["mass"]) < 0:
    print("model.yaml:3: mass: expected a positive number", file=sys.stderr)
    sys.exit(1)
speed, mass = float(eval(values["speed"])), float(values["mass"])
if "--quiet" not in arguments:
    print("static ...\\nstatic: 0.1 s", file=sys.stderr)
    print(f"static, 3 points\\n  limit point at load factor {{10 * speed}}\\n  limit point at load factor {{20 * speed}}")
with open(os.path.join(folder, "stand_in"), "rb") as file:
    results = file.read()
number = lambda value: struct.pack("<d", value)
for before, after in [("{PROGRAM}".encode(), PROGRAM.encode()),
                      *((number(f({SPEED}, {MASS})), number(f(speed, mass)))
                        for f in (lambda v, m: 2 * v, lambda v, m: v * m, lambda v, m: v, lambda v, m: 3 * v))]:
    if results.count(before) != 1 or len(after) != len(before):
        sys.exit("the stand-in's results have not this value once: " + repr(before))
    results = results.replace(before, after)
with open(arguments[arguments.index("-o") + 1], "wb") as file:
    file.write(results)
"""


def stand_in_results():
    """Writes the file that the stand-in copies, with the numbers for SPEED and MASS."""
    memory = io.BytesIO()
    with h5py.File(memory, "w") as file:
        file.attrs.update({"format": "bielle results", "created_by": PROGRAM})
        file["analysis_1/time"] = [0.0, 1.0]
        file["analysis_1/joints/main/rate"] = [[0.0], [2 * SPEED]]
        file["analysis_1/nodes/hub/position"] = [[0.0, 0, 0], [1, 0, SPEED * MASS]]
        file["analysis_1/measures/power"] = [0.0, 1.0]
        file["analysis_1/events/time"] = [0.5]
        file["analysis_2/eigen/frequency"] = [SPEED, 3 * SPEED]
        file["analysis_2/eigen/frequency"].attrs["units"] = "Hz"
        file["crossings"] = "event 'landed'"
        for name in ("time", "joints", "nodes", "measures", "events"):
            file[name] = h5py.SoftLink("/analysis_1/" + name)
        file["eigen"] = h5py.SoftLink("/analysis_2/eigen")
    return memory.getvalue()


class WithStandIn(InFolder):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        prepare_figures()
        cls.results = stand_in_results()

    def setUp(self):
        super().setUp()
        self.write("bielle-mechanism", STAND_IN)
        os.chmod(self.path("bielle-mechanism"), stat.S_IRWXU)
        with open(self.path("stand_in"), "wb") as file:
            file.write(self.results)
        self.write("model.yaml", "mechanism: a\nparameters: {speed: 1, mass: 2}\n")

    def call(self, *arguments):
        return run_python_tool(STUDY, arguments, self.folder, {**os.environ, "BIELLE_BIN": self.folder}, timeout=120)

    def study(self, table, *options):
        self.write("table.csv", table, errors="surrogatepass")
        return self.call(self.path("model.yaml"), self.path("table.csv"), "-o", self.path("study.h5"), *options)

    def runs(self):
        """Returns the calls of the stand-in since the previous query."""
        if not os.path.exists(self.path("log")):
            return []
        with open(self.path("log"), encoding="utf-8") as file:
            lines = sorted(file.read().splitlines())
        os.remove(self.path("log"))
        return lines
