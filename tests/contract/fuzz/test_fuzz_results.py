"""Fuzz of the tools with results and superelement files: damaged bytes, structures and numbers."""

import copy
import gc
import importlib.machinery
import importlib.util
import os
import resource
import shutil
import sys
import unittest

import h5py
import numpy as np

from fuzzing import KEEP, NEVER, FuzzTest, damaged_bytes
from test_fuzz_hdf5 import changed, near_structures, rewritten
import drawn_results
import synthetic_modes
import synthetic_results as synthetic
from box_mesh import REPOSITORY

TOOLS = os.path.join(REPOSITORY, "tools")
sys.path.insert(0, TOOLS)
from bielle_tools import messages  # noqa: E402
from bielle_tools.figures import plot_style  # noqa: E402
from shares import share_of_tests as load_tests  # noqa: E402,F401

ARGUMENTS = {"bielle-plot": ["-o", "plots"], "bielle-animate": ["-o", "run.png", "--frames", "2"],
             "bielle-paraview": ["-o", "run.pvd", "--frames", "2"],
             "bielle-rainflow": ["joints/main/reaction", "--component", "6"], "bielle-table": ["--peaks"]}


def module_of(name):
    """A tool as a module. It is imported once, and a process is forked for each case."""
    loader = importlib.machinery.SourceFileLoader(name.replace("-", "_"), os.path.join(TOOLS, name))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
    loader.exec_module(module)
    return module


def changed_item(rng, item):
    """Returns an item of a drawing. One in three has a value that does not fit, or lacks it."""
    if rng.random() < 0.67:
        return item
    holder, key = item, rng.choice(sorted(set(item) - {"entry"}))
    while isinstance(holder[key], (dict, list)) and holder[key] and rng.random() < 0.7:
        holder, inside = holder[key], holder[key]
        key = rng.choice(sorted(inside)) if isinstance(inside, dict) else rng.randrange(len(inside))
    if rng.random() < 0.2 and isinstance(holder, dict):
        del holder[key]
    else:
        holder[key] = rng.choice([None, -1, 0, 1e300, 1e-300, float("nan"), "text", [], {}, [1, 2], [[0, 0, 0]], True, 2**70, 10**400])
    return item


class Results(FuzzTest):
    @classmethod
    def setUpClass(cls):
        cls.modules = {name: module_of(name) for name in ARGUMENTS}
        plot_style.plt.rcParams.update({"figure.dpi": 15, "savefig.dpi": 15, "figure.constrained_layout.use": False})
        gc.freeze()  # prevents garbage collection in the forked processes from copying the pages of imported modules

    def setUp(self):
        super().setUp()
        synthetic.write_superelement(self.path("sound_box.h5"))
        synthetic.write_results(self.path("sound.h5"), "box.h5", rows=7, analysis="dynamic")
        shutil.copy(self.path("sound.h5"), self.path("sound_stacked.h5"))
        synthetic.stack(self.path("sound_stacked.h5"))

    def run_tool(self, name, more=()):
        """@returns the exit status, negative for a signal, and the messages."""
        said = os.open(self.path("said"), os.O_RDWR | os.O_CREAT | os.O_TRUNC)
        child = os.fork()
        if not child:
            resource.setrlimit(resource.RLIMIT_CPU, (20, 20))
            os.chdir(self.folder)
            os.dup2(os.open(os.devnull, os.O_RDWR), 1)
            os.dup2(said, 2)
            sys.stdout, sys.stderr = os.fdopen(1, "w", closefd=False), os.fdopen(2, "w", closefd=False)
            sys.argv = [name, "run.h5", *ARGUMENTS[name], *more]
            status, messages.longest_reading = 0, 3
            try:
                messages.run(name, self.modules[name].main)
            except SystemExit as end:
                status = end.code or 0
            sys.stderr.flush()
            os._exit(status)
        status = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
        os.close(said)
        return status, self.read("said").decode(errors="replace")

    def judge_tools(self, case, note, names=tuple(ARGUMENTS), more=()):
        note = f"{case} {note}"
        for name in names:
            if name == "bielle-plot" and case % 3:  # this tool takes ten times as long as the others
                continue
            status, said = self.run_tool(name, more if name != "bielle-plot" else ())
            sentences = [line for line in said.splitlines() if line.startswith(name + ": ")]
            # The waiting process reports a crash of the HDF5 library in a sentence.
            fine = -status in messages.CRASHES or (status in (0, 1) and len(sentences) == status)
            fine = fine and not any(word in said for word in NEVER)
            if not fine and KEEP:
                for file in filter(lambda name: os.path.exists(self.path(name)), ("run.h5", "box.h5")):
                    shutil.copy(self.path(file), os.path.join(KEEP, f"{name}_{note.split()[0]}_{file}"))
            with self.subTest(case=note):
                self.assertTrue(fine, f"{name}: case {note}: status {status}: {said[-600:]}")

    def damaged(self, rng, source, target):
        way = rng.random()
        if way < 0.6:
            shutil.copy(self.path(source), self.path(target))
            return changed(rng, self.path(target))
        data, note = (near_structures if way < 0.8 else damaged_bytes)(rng, self.read(source))
        self.write(target, data)
        return note

    def test_the_sound_files_are_shown(self):
        shutil.copy(self.path("sound_box.h5"), self.path("box.h5"))
        for source in ("sound.h5", "sound_stacked.h5"):
            shutil.copy(self.path(source), self.path("run.h5"))
            for name in ARGUMENTS:
                status, said = self.run_tool(name)
                self.assertEqual((status, said), (0, ""))

    def test_results(self):
        shutil.copy(self.path("sound_box.h5"), self.path("box.h5"))
        for case, rng in self.cases(14):
            source = rng.choice(["sound.h5", "sound_stacked.h5"])
            self.judge_tools(case, f"{source} {self.damaged(rng, source, 'run.h5')}")

    def test_modes(self):
        synthetic_modes.write_whirl(self.path("sound_modes.h5"))
        for case, rng in self.cases(10):
            self.judge_tools(case, self.damaged(rng, "sound_modes.h5", "run.h5"), ["bielle-plot", "bielle-animate", "bielle-paraview"],
                             ["--mode", "1"])

    def test_drawings(self):
        nodes, items, meshes = drawn_results.every_shape(7)
        for case, rng in self.cases(12):
            drawn_results.write_results(self.path("run.h5"), nodes, [changed_item(rng, item) for item in copy.deepcopy(items)], meshes=meshes)
            note = changed(rng, self.path("run.h5")) if rng.random() < 0.5 else "items"
            self.judge_tools(case, note, ["bielle-animate"], ["--size", "100x100", "--labels"])

    def test_superelements(self):
        shutil.copy(self.path("sound.h5"), self.path("run.h5"))
        for case, rng in self.cases(8):
            self.judge_tools(case, self.damaged(rng, "sound_box.h5", "box.h5"),
                             ["bielle-plot", "bielle-animate", "bielle-paraview", "bielle-table"])

    def test_cells_without_a_surface(self):
        """All cells of the superelement have the same nodes, so that none of their faces belongs to one cell only."""
        shutil.copy(self.path("sound.h5"), self.path("run.h5"))
        shutil.copy(self.path("sound_box.h5"), self.path("box.h5"))
        with h5py.File(self.path("box.h5"), "r+") as file:
            cells = file["mesh/cells/11"][()]
            for number, damaged in enumerate((np.zeros_like(cells), np.tile(cells[:1], (2, 1)))):
                rewritten(file, "mesh/cells/11", damaged)
                file.flush()
                for name in ("bielle-animate", "bielle-paraview"):
                    status, said = self.run_tool(name)
                    with self.subTest(case=number, name=name):
                        self.assertEqual(status, 1, said)
                        self.assertRegex(said, f"^{name}: 'box.h5' is damaged: the cells of its mesh have no surface[^\\n]*\n$")


if __name__ == "__main__":
    unittest.main()
