"""A stand-in for bielle-mechanism in tests of tools/bielle-study, whose results are known in closed form."""

import os
import stat

from box_mesh import REPOSITORY, InFolder
from python_tool import run_python_tool

STUDY = os.path.join(REPOSITORY, "tools", "bielle-study")
# Takes the arguments of bielle-mechanism; doubles the parameter `speed`, fails when `mass` is negative; keeps a log of its runs.
STAND_IN = """#!/usr/bin/python3
import os, sys, time, h5py
arguments = sys.argv[1:]
values = dict(a.split("=", 1) for k, a in enumerate(arguments) if arguments[k - 1] == "--set")
with open(os.path.join(os.path.dirname(sys.argv[0]), "log"), "a") as log:
    log.write(" ".join(values.values()) + "\\n")
if "sped" in values:
    print("bielle-mechanism: error: --set sped=1: model.yaml has no parameter 'sped'; did you mean 'speed'?", file=sys.stderr)
    sys.exit(1)
if values["speed"] == "13":
    os.kill(os.getpid(), 9)
if values["speed"] == "1000":
    time.sleep(60)
if float(values["mass"]) < 0:
    print("model.yaml:3: mass: expected a positive number", file=sys.stderr)
    sys.exit(1)
speed = float(eval(values["speed"]))
if "--quiet" not in arguments:
    print("static ...\\nstatic: 0.1 s", file=sys.stderr)
    print(f"static, 3 points\\n  limit point at load factor {10 * speed}\\n  limit point at load factor {20 * speed}")
with h5py.File(arguments[arguments.index("-o") + 1], "w") as file:
    file.attrs.update({"format": "bielle results", "created_by": "bielle-mechanism 0.0 (commit stand-in)"})
    file["analysis_1/time"] = [0.0, 1.0]
    file["analysis_1/joints/main/rate"] = [[0.0], [2 * speed]]
    file["analysis_1/nodes/hub/position"] = [[0.0, 0, 0], [1, 0, speed * float(values["mass"])]]
    file["analysis_1/measures/power"] = [0.0, 1.0]
    file["analysis_1/events/time"] = [0.5]
    file["analysis_2/eigen/frequency"] = [speed, 3 * speed]
    file["analysis_2/eigen/frequency"].attrs["units"] = "Hz"
    file["crossings"] = "event 'landed'"
    for name in ("time", "joints", "nodes", "measures", "events"):
        file[name] = h5py.SoftLink("/analysis_1/" + name)
    file["eigen"] = h5py.SoftLink("/analysis_2/eigen")
"""


class WithStandIn(InFolder):
    def setUp(self):
        super().setUp()
        self.write("bielle-mechanism", STAND_IN)
        os.chmod(self.path("bielle-mechanism"), stat.S_IRWXU)
        self.write("model.yaml", "mechanism: a\nparameters: {speed: 1, mass: 2}\n")

    def call(self, *arguments):
        return run_python_tool(STUDY, arguments, self.folder, {**os.environ, "BIELLE_BIN": self.folder}, timeout=120)

    def study(self, table, *options):
        self.write("table.csv", table, errors="surrogatepass")
        return self.call(self.path("model.yaml"), self.path("table.csv"), "-o", self.path("study.h5"), *options)

    def runs(self):
        """Calls of the stand-in since the last time."""
        if not os.path.exists(self.path("log")):
            return []
        with open(self.path("log"), encoding="utf-8") as file:
            lines = sorted(file.read().splitlines())
        os.remove(self.path("log"))
        return lines
