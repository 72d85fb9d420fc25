"""Tests of stress of Exudyn's .npz files with a pickled dictionary, which is read without Exudyn's modules and without
running code."""

import os
import pickle
import sys
import types
import unittest
import zipfile

import numpy as np

from exchange_bodies import Exchange, cloud_body, rigid_of
from bielle_tools.exchange import formats
from bielle_tools.messages import InputError

NODES, MODES_OF_STRESS = 12, 1 << 29


class OutputVariableType:
    """An enumerator as pybind11 pickles it: the class in exudyn.exudynCPP, and its number as the state."""

    __module__ = "exudyn.exudynCPP"

    def __init__(self, value):
        self.value = value

    def __getstate__(self):
        return self.value

    def __setstate__(self, value):
        self.value = value


class Shell:
    """An object whose pickle runs a command when it is loaded."""

    def __init__(self, path):
        self.path = path

    def __reduce__(self):
        return os.system, (f"touch '{self.path}'",)


class Pickled(Exchange):
    def setUp(self):
        super().setUp()
        formats.module_of("exudyn").write(cloud_body(nodes=2, scalars=6, damping=False), self.path("a.npz"), self.options())
        with np.load(self.path("a.npz")) as file:
            self.keys = {name: file[name] for name in file.files if name != "postProcessingModes"}
        self.stress = np.random.default_rng(6).normal(size=(NODES, 6 * self.keys["modeBasis"].shape[1]))
        # pickle finds the class by its name, which the reader must not need.
        sys.modules["exudyn"], sys.modules["exudyn.exudynCPP"] = types.ModuleType("exudyn"), types.ModuleType("exudyn.exudynCPP")
        sys.modules["exudyn.exudynCPP"].OutputVariableType = OutputVariableType

    def tearDown(self):
        self.forget()
        super().tearDown()

    @staticmethod
    def forget():
        for name in ("exudyn.exudynCPP", "exudyn"):
            sys.modules.pop(name, None)

    def write_file(self, recovery, protocol=4):
        """Writes the file as numpy.savez does, with a given protocol of pickle."""
        whole = np.empty((), object)
        whole[()] = recovery
        with zipfile.ZipFile(self.path("b.npz"), "w") as archive:
            for name, array in self.keys.items():
                with archive.open(name + ".npy", "w") as stream:
                    np.lib.format.write_array(stream, array)
            with archive.open("postProcessingModes.npy", "w") as stream:
                np.lib.format.write_array_header_1_0(stream, {"descr": "|O", "fortran_order": False, "shape": ()})
                stream.write(pickle.dumps(whole, protocol))

    def found(self, recovery, protocol=4):
        """Returns the body of the file."""
        self.write_file(recovery, protocol)
        return self.read("exudyn", self.path("b.npz"), interfaces=[1, 2, 3])

    def test_orders_and_enumerators(self):
        """Asserts that all forms of the same stress give the same body."""
        expected = self.found({"matrix": self.stress, "outputVariableType": "OutputVariableType.StressLocal"}).shapes.stress
        for matrix in (np.asfortranarray(self.stress), self.stress.astype(">f8")):
            for kind in (OutputVariableType(MODES_OF_STRESS), MODES_OF_STRESS, "OutputVariableType.StressLocal"):
                for protocol in (3, 4):
                    got = self.found({"matrix": matrix, "outputVariableType": kind}, protocol).shapes.stress
                    np.testing.assert_array_equal(got, expected)
        self.write_file({"matrix": self.stress, "outputVariableType": OutputVariableType(MODES_OF_STRESS)})
        self.forget()  # as on a machine without Exudyn
        np.testing.assert_array_equal(self.read("exudyn", self.path("b.npz"), interfaces=[1, 2, 3]).shapes.stress, expected)

    def test_modes_have_the_stress_of_the_file(self):
        file = self.found({"matrix": self.stress, "outputVariableType": MODES_OF_STRESS})
        shapes = self.keys["modeBasis"].reshape(NODES, 3, -1)
        rows = file.unknown_nodes >= 0
        at = np.zeros((9, file.size))
        at[3 * file.unknown_nodes[rows] + file.unknown_components[rows], np.flatnonzero(rows)] = 1
        motions = np.concatenate([at, file.shapes.displacement])
        unknowns = np.linalg.lstsq(motions, shapes.reshape(3 * NODES, -1), rcond=None)[0]
        expected = self.stress.reshape(NODES, -1, 6).transpose(0, 2, 1)[3:]
        np.testing.assert_allclose((file.shapes.stress @ unknowns).reshape(expected.shape), expected, atol=1e-8)
        rigid = np.linalg.lstsq(motions, rigid_of(self.keys["xRef"].reshape(-1, 3), 3), rcond=None)[0]
        np.testing.assert_allclose(file.shapes.stress @ rigid, 0, atol=1e-9)

    def test_an_object_of_the_file_is_not_made(self):
        """Names of other objects are not looked up at any depth: no code of the file runs, and the other values are
        read."""
        trap = Shell(self.path("ran"))
        for recovery in ({"matrix": trap}, {"matrix": self.stress, "outputVariableType": trap}, trap, [trap]):
            self.assertIsNone(self.found(recovery).shapes.stress)
            self.assertFalse(os.path.exists(self.path("ran")))

    def test_other_quantities_and_faults(self):
        for recovery in ({}, {"matrix": self.stress, "outputVariableType": OutputVariableType(1 << 28)}, {"matrix": self.stress}):
            self.assertIsNone(self.found(recovery).shapes.stress)
        known = {"outputVariableType": MODES_OF_STRESS}
        for recovery, told in (([1, 2], "it is no dictionary"), ({"matrix": self.stress[:, 1:]} | known, "has the shape (12, "),
                               ({"matrix": self.stress.astype(complex)} | known, "it holds an array of c16"),
                               ({"matrix": self.stress.astype(object)} | known, "has the shape"), ({"matrix": "much"} | known, "has the shape"),
                               ({"matrix": np.full(self.stress.shape, np.nan)} | known, "finite numbers are expected")):
            with self.subTest(told):
                self.write_file(recovery)
                self.refuse("exudyn", self.path("b.npz"), told, interfaces=[1, 2, 3])
        with open(self.path("b.npz"), "rb") as file:
            whole = file.read()
        place = whole.rindex(b"postProcessingModes.npy", 0, len(whole) - 200)
        with open(self.path("c.npz"), "wb") as file:
            file.write(whole[:place + 400] + bytes([whole[place + 400] ^ 1]) + whole[place + 401:])
        self.refuse("exudyn", self.path("c.npz"), "'postProcessingModes' cannot be read", interfaces=[1, 2, 3])


if __name__ == "__main__":
    unittest.main()
