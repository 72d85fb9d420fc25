"""Tests of bielle-table: its numbers are those that h5py reads, its peaks those of the data, and its RPC files are read
back."""

import csv
import importlib.util
import io
import os
import re
import struct
import subprocess
import sys
import types
import unittest
import unittest.mock

import h5py
import numpy as np

import synthetic_results as synthetic
from box_mesh import REPOSITORY, InFolder
from python_tool import run_python_tool  # box_mesh sets the path

from bielle_tools.messages import InputError
from bielle_tools.quantities.rpc_file import write_rpc
from bielle_tools.quantities.table_file import write_columns
from shares import share_of_tests as load_tests  # noqa: E402,F401

PROGRAMS = os.environ["BIELLE_PROGRAMS"]
TOOL = os.path.join(REPOSITORY, "tools", "bielle-table")
MODEL = """\
gravity: [0, 0, -9.81]
nodes:
  bob: {position: [1, 0, 0]}
  'a, "b"': {position: [2, 0, 0]}
elements:
  bob: {type: point_mass, node: bob, mass: 1}
  'a, "b"': {type: point_mass, node: 'a, "b"', mass: 1}
joints:
  main: {type: hinge, nodes: [ground, bob], position: [0, 0, 0], axis: [0, 1, 0]}
  'a, "b"': {type: hinge, nodes: [bob, 'a, "b"'], position: [1, 0, 0], axis: [0, 1, 0]}
analysis: [{type: dynamic, duration: 0.3, step: 1e-3}]
output: {layout: LAYOUT}
"""


def read_rpc(path):
    """Returns step, {channel: (unit, values)} of an RPC III file of floating-point numbers, by the description of the
    format."""
    with open(path, "rb") as file:
        data = file.read()
    text = [tuple(part.partition(b"\0")[0].decode("latin-1") for part in struct.unpack("32s96s", data[k:k + 128])) for k in range(0, 384, 128)]
    head = dict(text)
    head = dict(tuple(part.partition(b"\0")[0].decode("latin-1") for part in struct.unpack("32s96s", data[128 * k:128 * (k + 1)]))
                for k in range(int(head["NUM_PARAMS"])))
    assert [name for name, _ in text] == ["FORMAT", "NUM_HEADER_BLOCKS", "NUM_PARAMS"] and head["DATA_TYPE"] == "FLOATING_POINT"
    frame, group, frames, channels = (int(head[name]) for name in ("PTS_PER_FRAME", "PTS_PER_GROUP", "FRAMES", "CHANNELS"))
    groups = -(-frames // (group // frame))
    numbers = np.frombuffer(data[512 * int(head["NUM_HEADER_BLOCKS"]):], "<f4")
    assert numbers.size == groups * channels * group
    values = numbers.reshape(groups, channels, group).transpose(1, 0, 2).reshape(channels, -1)[:, :frames * frame]
    return float(head["DELTA_T"]), {head[f"DESC.CHAN_{k + 1}"]: (head[f"UNITS.CHAN_{k + 1}"], values[k]) for k in range(channels)}


class TableTool(InFolder):
    def run_tool(self, *arguments):
        return run_python_tool(TOOL, arguments, self.folder)

    def succeed(self, *arguments):
        done = self.run_tool(*arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def refuse(self, arguments, part, status=1):
        done = self.run_tool(*arguments)
        self.assertEqual((done.returncode, len([line for line in done.stderr.splitlines() if not line.startswith("note:")])), (status, 1), done.stderr)
        self.assertIn(part, done.stderr)


class OfSynthetic(TableTool):
    def setUp(self):
        super().setUp()
        synthetic.write_superelement(self.path("box.h5"))
        self.time = synthetic.write_results(self.path("run.h5"), "box.h5")

    def peaks(self, *options):
        """Returns {quantity: [value, unit, time, place]}."""
        rows = list(csv.DictReader(io.StringIO(self.succeed("run.h5", "--peaks", "--csv", "-", *options).stdout)))
        return {row["quantity"]: [float(row["value"]), row["unit"], float(row["time [s]"]), row["place"]] for row in rows}

    def test_peaks_are_those_of_the_closed_form_with_time_and_place(self):
        found = self.peaks()
        self.assertEqual(found["joints/main/reaction.force"], [5.0, "N", 0.0, ""])
        self.assertEqual(found["joints/main/reaction.moment"][:3], [np.sin(0.1), "N m", 0.1])
        self.assertEqual(found["elements/shaft/von_mises"], [4e7, "Pa", 0.0, "element 4, stress point 1 at (0, 0, 0.175) m"])
        value, unit, time, place = found["elements/rod/von_mises"]
        self.assertAlmostEqual(value / (synthetic.YOUNG * synthetic.STRAIN), 1, delta=1e-12)
        self.assertEqual((unit, time), ("Pa", 0.025))  # a quarter of the period
        self.assertRegex(place, r"node \d+ of the mesh at \(.*\) m in the body")
        self.assertEqual(found["joints/main/drive_force.angle"][:3], [7.1, "N m", 0.1])
        self.assertEqual(found["elements/ram/pressure[2]"][:3], [2e5, "Pa", 0.0])
        self.assertEqual(self.peaks("--span", "0.05:")["elements/rod/von_mises"][2], 0.075)

    def test_a_stress_without_any_number_is_told(self):
        with h5py.File(self.path("run.h5"), "r+") as file:
            file["elements/shaft/von_mises"][...] = np.nan
        done = self.succeed("run.h5", "--peaks")
        self.assertEqual(done.stderr, "note: no stress of 'elements/shaft/von_mises': none of its values is a number\n")
        self.assertNotIn("shaft", done.stdout)

    def test_peaks_of_recorded_fields_supports_contacts_and_of_all_steps(self):
        with h5py.File(self.path("run.h5"), "r+") as file:
            rows = len(self.time)
            field = np.zeros((rows, 90))
            field[7, 11] = 3e8
            file["elements/rod/von_mises"] = field
            file["supports/hub/reaction"] = np.tile([0, 3.0, 4, 0, 0, 2], (rows, 1))
            force = np.zeros((rows, 2, 3))
            force[5, 1] = [1, 2, 2]
            for place, tension in (("elements/strut/force", [-6.0, 2]), ("joints/rope/tension", [3.0, 7])):
                file[place] = np.repeat(tension, (4, rows - 4))
                file[place].attrs["units"] = "N"
            file["contacts/floor/force"], file["contacts/floor/point"] = force, np.tile([1.0, 2, 3], (rows, 1))
            for name, value in (("value", 4e8), ("time", 0.0123), ("node", 5), ("position", [0.1, 0, 0])):
                file[f"peaks/rod/all/von_mises/{name}"] = value
            file["peaks/rod/all/von_mises/value"].attrs["units"] = "Pa"
        found = self.peaks()
        self.assertEqual(found["elements/rod/von_mises"][::2], [3e8, self.time[7]])
        with h5py.File(self.path("box.h5")) as file:
            node = file["recovery/stress_nodes"][11]
        self.assertIn(f"node {node} of the mesh", found["elements/rod/von_mises"][3])
        self.assertEqual(found["supports/hub/reaction.force"][0], 5)
        self.assertEqual(found["elements/strut/force"], [6.0, "N", 0.0, ""])
        self.assertEqual(found["joints/rope/tension"], [7.0, "N", self.time[4], ""])
        self.assertEqual(found["contacts/floor/force.norm[2]"], [3.0, "", self.time[5], "shape 2 of 2, smallest gap at (1, 2, 3) m"])
        self.assertEqual(found["peaks/rod/all/von_mises"][:3], [4e8, "Pa", 0.0123])

    def test_peaks_without_the_file_of_a_body_leave_it_out_with_a_note(self):
        os.remove(self.path("box.h5"))
        done = self.succeed("run.h5", "--peaks")
        self.assertIn("no stress of 'rod'", done.stderr)
        self.assertIn("elements/shaft/von_mises", done.stdout)

    def test_the_list_has_names_shapes_and_units(self):
        for layout in ("named", "stacked"):
            rows = {row["quantity"]: row for row in csv.DictReader(io.StringIO(self.succeed("run.h5", "--list", "--csv", "-").stdout))}
            self.assertEqual((rows["joints/main/reaction"]["shape"], rows["joints/main/reaction"]["unit"]), ("6", "N, N m"))
            self.assertEqual((rows["elements/shaft/von_mises"]["shape"], rows["elements/shaft/von_mises"]["unit"]), ("4 x 2", "Pa"))
            self.assertEqual((rows["elements/rod/radiated_power"]["shape"], rows["elements/rod/radiated_power"]["unit"]), ("made", "W"))
            self.assertIn("R = Rx(a) Ry(b) Rz(c)", rows["nodes/hub/bryant"]["description"])
            for place, short in (("joints/main/reaction", "main.reaction"), ("joints/main/coordinate", "main.displacement, main.angle"),
                                 ("joints/main/rate", "main.displacement.rate, main.angle.rate"), ("elements/shaft/von_mises", "shaft.von_mises"), ("time", "")):
                self.assertEqual(rows[place]["short name"], short)
            if layout == "named":
                synthetic.stack(self.path("run.h5"))
        self.assertIn("joints/main/reaction ", self.succeed("run.h5").stdout)

    def test_rpc_files_read_back(self):
        self.succeed("run.h5", "--quantity", "main.angle, ram.pressure, rod.von_mises.max", "--rpc", "run.rsp")
        step, channels = read_rpc(self.path("run.rsp"))
        self.assertAlmostEqual(step, 0.0025, delta=1e-15)
        self.assertEqual(list(channels), ["main.angle", "ram.pressure[1]", "ram.pressure[2]", "rod.von_mises.max"])
        unit, values = channels["main.angle"]
        self.assertEqual((unit, len(values)), ("rad", 1024))
        np.testing.assert_array_equal(values[:41], (synthetic.OMEGA * self.time).astype("f4"))
        np.testing.assert_array_equal(values[41:], values[40])

    def test_rpc_of_many_frames_and_names(self):
        values = np.random.default_rng(1).normal(size=(2500, 3))
        with open(self.path("x.rsp"), "wb") as file:
            self.assertEqual(write_rpc(file, 1e-3, ["a" * 200, "b\u03a9", "c"], ["N", "", "m/s^2"], values), 3 * 1024 - 2500)
        step, channels = read_rpc(self.path("x.rsp"))
        self.assertEqual((step, list(channels)), (1e-3, ["a" * 95, "b?", "c"]))
        for column, (_, found) in zip(values.T, channels.values()):
            np.testing.assert_array_equal(found[:2500], column.astype("f4"))

    def test_one_row_two_rows_none(self):
        for rows in (1, 2):
            synthetic.write_results(self.path("few.h5"), "box.h5", rows=rows)
            self.assertEqual(len(self.succeed("few.h5", "--quantity", "main.angle").stdout.splitlines()), 1 + rows)
            self.succeed("few.h5", "--peaks")
            self.assertEqual(len(self.succeed("few.h5", "--csv", "-").stdout.splitlines()), 1 + rows)
        self.succeed("few.h5", "--rpc", "few.rsp")
        synthetic.write_results(self.path("few.h5"), "box.h5", rows=1)
        self.refuse(("few.h5", "--rpc", "few.rsp"), "there is one time only")
        self.refuse(("few.h5", "--quantity", "rod.radiated_power"), "velocities need several")

    def test_parquet_by_the_library_if_it_is_installed(self):
        columns = [("time [s]", np.array([0.0, 0.1, 0.2])), ("main, angle [rad]", np.array([1 / 3, np.nan])), ("time [s]", np.array([5.0]))]
        try:
            import pyarrow.parquet
        except ImportError:
            self.parquet_by_a_stand_in(columns)
            return
        write_columns(self.path("x.parquet"), columns)
        table = pyarrow.parquet.read_table(self.path("x.parquet"))
        self.assertEqual(table.column_names, [name for name, _ in columns])
        self.assertEqual([column.to_pylist() for column in table.columns], [[0.0, 0.1, 0.2], [1 / 3, None, None], [5.0, None, None]])

    def parquet_by_a_stand_in(self, columns):
        """Tests calls of the library, by the signatures in its reference."""
        library, parquet = types.ModuleType("pyarrow"), types.ModuleType("pyarrow.parquet")
        library.parquet = parquet
        library.array = lambda values, mask: [None if left_out else value for value, left_out in zip(values.tolist(), mask)]
        library.Table = types.SimpleNamespace(from_arrays=lambda arrays, names: dict(enumerate(zip(names, arrays))))
        parquet.write_table = lambda table, where: where.write(repr(table).encode())
        with unittest.mock.patch.dict(sys.modules, {"pyarrow": library, "pyarrow.parquet": parquet}):
            write_columns(self.path("x.parquet"), columns)
            with self.assertRaisesRegex(InputError, "is an input"):
                write_columns(self.path("x.parquet"), columns, [self.path("x.parquet")])
        with open(self.path("x.parquet"), encoding="utf-8") as file:
            self.assertEqual(file.read(), repr(dict(enumerate(zip([name for name, _ in columns], ([0.0, 0.1, 0.2], [1 / 3, None, None], [5.0, None, None]))))))

    def test_slips_are_answered_with_one_sentence(self):
        self.write("empty.h5", "")
        with h5py.File(self.path("run.h5"), "r+") as file:
            file["elements/ram/pressure"][3, 1] = np.nan
        for arguments, part in ((("run.h5", "--quantity", "main.angel"), "did you mean 'main.angle'?"), (("empty.h5",), "it is empty"), (("no.h5",), "does not exist"),
                                (("run.h5", "--peaks", "--list"), "say one of"), (("run.h5", "--span", "0:1"), "the list has none"),
                                (("run.h5", "--peaks", "--csv", "x.parquet"), "is written as CSV"),
                                (("run.h5", "--peaks", "--csv", "run.h5"), "is an input"), (("run.h5", "--quantity", "time", "--rpc", "-"), "say a name"),
                                (("run.h5", "--csv", "no/x.csv"), "cannot write 'no/x.csv'"), (("run.h5", "--analysis", "7"), "holds no analysis 7"),
                                (("run.h5", "box.h5"), "a superelement"), (("run.h5", "--quantity", "time", "--every", "-1"), "from 1 on")):
            with self.subTest(arguments=arguments):
                self.refuse(arguments, part)
        self.refuse(("run.h5", "--quantity", "main.angle", "--csv", "/dev/full"), "No space left on device", 2)
        if not importlib.util.find_spec("pyarrow"):
            self.refuse(("run.h5", "--quantity", "main.angle", "--csv", "x.parquet"), "Parquet needs the Python package pyarrow")
        done = self.run_tool("run.h5", "--quantity", "ram.pressure", "--rpc", "x.rsp")
        self.assertIn("'ram.pressure[2]' has no number at 0.0075 s", done.stderr)
        self.assertFalse(os.path.exists(self.path("x.rsp")))
        self.write("old.csv", "an older table")
        self.succeed("run.h5", "--quantity", "main.angle", "--csv", "old.csv")
        with open(self.path("old.csv"), encoding="utf-8") as file:
            self.assertEqual(file.readline(), "time [s],main.angle [rad]\n")
        self.assertEqual([name for name in os.listdir(self.folder) if name.endswith(".part")], [])


class OfRuns(TableTool):
    def test_all_numbers_are_those_of_h5py_to_the_bit_and_names_survive(self):
        tables = []
        for layout in ("named", "stacked"):
            self.write("model.yaml", MODEL.replace("LAYOUT", layout))
            subprocess.run([os.path.join(PROGRAMS, "bielle-mechanism"), "model.yaml", "-o", f"{layout}.h5", "--quiet"], cwd=self.folder, check=True, timeout=60)
            self.succeed(f"{layout}.h5", "--csv", "all.csv")
            with open(self.path("all.csv"), newline="", encoding="utf-8") as file:
                rows = list(csv.reader(file))
            tables.append({re.sub(r" \[[^\[\]]*\]$", "", head) if "] [" in head or "." in head or " " in head else head: column
                           for head, column in zip(rows[0], np.array(rows[1:], float).T)})
        self.assertEqual(set(tables[0]), set(tables[1]))
        compared = 0
        with h5py.File(self.path("named.h5")) as file:
            datasets = {}
            file["analysis_1"].visititems(lambda name, found: datasets.update({name: found[()]}) if isinstance(found, h5py.Dataset) else None)
        for table in tables:
            for name, values in datasets.items():
                columns = values.reshape(len(values), -1)
                found = [column for head, column in table.items() if head == name or head.startswith((name + ".", name + "["))]
                self.assertEqual(len(found), columns.shape[1], name)
                np.testing.assert_array_equal(np.array(found).T, columns, name)
                compared += columns.shape[1]
        self.assertEqual(compared, sum(len(table) for table in tables))
        self.assertIn('joints/a, "b"/reaction.x', tables[0])


class Files(InFolder):
    def test_cells_quote_and_gaps_are_empty(self):
        write_columns(self.path("x.csv"), [('a, "b" [N]', np.array([1.0, np.nan, 1e-300])), ("c", np.array([0.1]))])
        with open(self.path("x.csv"), encoding="utf-8") as file:
            self.assertEqual(file.read(), '"a, ""b"" [N]",c\n1.0,0.1\n,\n1e-300,\n')


if __name__ == "__main__":
    unittest.main()
