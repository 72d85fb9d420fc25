"""Fuzz of superelement files, and of results files from which runs continue: damaged bytes, structures and numbers."""

import re
import shutil
import unittest

import h5py
import numpy as np

from fuzzing import FuzzTest, damaged_bytes
from test_reduce import BAR, BODY

MODEL = """\
gravity: [0, 0, -9.81]
nodes: {a: {fixed: true}, b: {position: [0.2, 0, 0]}}
elements: {bar: {type: superelement, file: FILE, position: [0, -0.01, -0.01], nodes: {left: a, right: b}}}
analysis: [{type: dynamic, duration: 0.002, step: 0.001}]
output: {fields: {bar: [displacement, von_mises]}, checkpoint: 1}
"""


def rewritten(file, name, data, **options):
    attributes = dict(file[name].attrs)
    del file[name]
    dataset = file.create_dataset(name, data=data, **options)
    for key, value in attributes.items():
        dataset.attrs[key] = value


def change_numbers(rng, file, name, values):
    values = np.array(values, dtype=float)
    flat = values.reshape(-1)
    place = rng.randrange(flat.size)
    kind = rng.choice(["one", "all", "shape"])
    if kind == "one":
        flat[place] = rng.choice([np.nan, np.inf, 1e300, -1e300, -1, 0, 2.0**31, 2.0**40, 1.1 * flat[place] + 1])
    elif kind == "all":
        values *= rng.choice([-1, 0, 1000])
    else:
        values = rng.choice([values.T.copy(), values[:-1], np.concatenate([values, values[:1]]), values[None], flat.copy(),
                             np.zeros((0,) * values.ndim)])
    rewritten(file, name, values, **rng.choice([{}, {}, {"chunks": True, "compression": "gzip"} if values.size else {}]))
    return f"{kind} {name}"


def changed(rng, path):
    """Changes the content of a file as a script would. @returns a description of the change"""
    with h5py.File(path, "r+") as file:
        names = []
        file.visititems(lambda name, item: names.append(name) if isinstance(item, h5py.Dataset) else None)
        name = rng.choice(names)
        values = file[name][()]
        if np.size(values) and np.ndim(values) and file[name].dtype.kind in "fiu" and rng.random() < 0.6:
            return change_numbers(rng, file, name, values)
        kind = rng.choice(["delete", "group", "nowhere", "outside", "text", "compound", "vast", "attribute", "scalar", "link to itself"])
        if kind == "attribute":
            key = rng.choice(["format", "version", "complete", "name", "created_by", "checksum", "layout"])
            file.attrs.pop(key, None)
            value = rng.choice([None, 2, -1, "text", 1.5, [1, 2]])
            if value is not None:
                file.attrs[key] = value
            return f"attribute {key} {value}"
        del file[name]
        if kind == "group":
            file.create_group(name)
        elif kind == "nowhere":
            file[name] = h5py.SoftLink("/nowhere")
        elif kind == "outside":
            file[name] = h5py.ExternalLink(rng.choice(["/dev/zero", "nowhere.h5"]), "/x")
        elif kind == "text":
            file[name] = "hello"
        elif kind == "compound":
            file[name] = np.zeros(3, dtype=[("a", "f8"), ("b", "i4")])
        elif kind == "vast":
            file.create_dataset(name, shape=(2**20, 2**20), chunks=(1024, 1024), dtype="f8")
        elif kind == "scalar":
            file[name] = rng.choice([float("nan"), -1.0, 0.0, 1e300])
        elif kind == "link to itself":
            file[name] = h5py.SoftLink("/" + name)
        return f"{kind} {name}"


def near_structures(rng, data):
    """The damage is close to the signatures of the structures that describe groups and texts."""
    data = bytearray(data)
    start = rng.choice([found.start() for found in re.finditer(rb"TREE|SNOD|HEAP|GCOL|OHDR|FRHP|FSHD|\x89HDF", data)])
    for _ in range(rng.choice([1, 1, 2, 4])):
        place = start + rng.randrange(160)
        if place < len(data):
            data[place] = rng.choice([0, 1, 255, 127, 128, rng.randrange(256)])
    return bytes(data), f"structure at {start}"


class Hdf5(FuzzTest):
    def setUp(self):
        super().setUp()
        self.write("bar.geo", BAR)
        self.write("body.yaml", BODY.replace("size: 0.02, order: 2", "size: 0.04, order: 1"))
        self.assertEqual(self.judge("sound", [], "bielle-reduce", "body.yaml", "-o", "bar.h5", "--quiet"), 0)

    def damaged(self, rng, source, target):
        way = rng.random()
        if way < 0.4:
            shutil.copy(self.path(source), self.path(target))
            return changed(rng, self.path(target))
        data, note = (near_structures if way < 0.75 else damaged_bytes)(rng, self.read(source))
        self.write(target, data)
        return note

    def test_superelements(self):
        self.write("model.yaml", MODEL.replace("FILE", "bad.h5"))
        for case, rng in self.cases(60):
            note = f"{case} {self.damaged(rng, 'bar.h5', 'bad.h5')}"
            self.judge(note, ["bad.h5"], "bielle-mechanism", "model.yaml", "-o", "out.h5", "--quiet")
            if case % 3 == 0:
                self.judge(note, ["bad.h5"], "bielle-reduce", "--inspect", "bad.h5")

    def test_results_to_go_on_from(self):
        self.write("model.yaml", MODEL.replace("FILE", "bar.h5"))
        self.assertEqual(self.judge("sound", [], "bielle-mechanism", "model.yaml", "-o", "results.h5", "--quiet"), 0)
        self.write("model.yaml", MODEL.replace("FILE", "bar.h5").replace("duration: 0.002", "duration: 0.004"))
        for case, rng in self.cases(60):
            note = f"{case} {self.damaged(rng, 'results.h5', 'bad.h5')}"
            self.judge(note, ["bad.h5"], "bielle-mechanism", "model.yaml", "--restart", "bad.h5", "-o", "out.h5", "--quiet")


if __name__ == "__main__":
    unittest.main()
