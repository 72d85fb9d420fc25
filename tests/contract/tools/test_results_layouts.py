"""Tests that the tools give the same results for a file by names and for a stacked one."""

import os
import sys
import unittest

import h5py
import numpy as np

import synthetic_results as synthetic
from box_mesh import REPOSITORY
from test_results_tools import ResultsTool as _ResultsTool

sys.path.insert(0, os.path.join(REPOSITORY, "tools"))
from bielle_tools.results import Results  # noqa: E402


class Layouts(_ResultsTool):
    def setUp(self):
        super().setUp()
        for name in ("named.h5", "stacked.h5"):
            synthetic.write_results(self.path(name), "box.h5", analysis="dynamic")
            with h5py.File(self.path(name), "r+") as file:  # two equal ones, and one with another motion
                nodes = file["analysis_1/nodes"]
                for other, shift in (("rim", 0.1), ("axle", 0.2)):
                    nodes.copy("hub", other)
                    nodes[other]["position"][:, 1] += shift
                nodes["rim"].attrs["carrier"] = "hub"
        synthetic.stack(self.path("stacked.h5"))

    def test_everything_is_read_by_the_same_names(self):
        with Results(self.path("named.h5")) as named, Results(self.path("stacked.h5")) as stacked:
            for section in ("nodes", "elements", "joints", "energy"):
                self.assertEqual(sorted(stacked.names(section)), sorted(named.names(section)))
            for section in ("nodes", "elements", "joints"):
                for name in named.names(section):
                    place = f"{section}/{name}"
                    self.assertTrue(stacked.has(place))
                    self.assertEqual(sorted(stacked.datasets(place)), sorted(named.datasets(place)))
                    for attribute in named.root[place].attrs:
                        self.assertEqual(stacked.text(place, attribute), named.text(place, attribute))
                    self.assertEqual(stacked.text(place, "no_such"), "")
                    for field in named.datasets(place):
                        dataset = f"{place}/{field}"
                        self.assertEqual(stacked.shape(dataset), named.shape(dataset))
                        self.assertEqual(stacked.units(dataset), named.units(dataset))
                        for rows in (None, 3, np.array([0, 2, 5])):
                            np.testing.assert_array_equal(stacked.rows(dataset, rows), named.rows(dataset, rows))
            for place in ("nodes/no_such", "nodes/hub/no_such", "contacts/a", "joints/main/spring_force"):
                self.assertFalse(stacked.has(place))
                self.assertFalse(named.has(place))
            self.assertEqual(stacked.elements_with("frame"), ["rod"])

    def test_paraview_gets_the_same_files(self):
        for name in ("named", "stacked"):
            self.succeed("bielle-paraview", self.path(f"{name}.h5"), "--frames", "3")
        files = sorted(os.listdir(self.path("named")))
        self.assertEqual(sorted(os.listdir(self.path("stacked"))), files)
        self.assertGreater(len(files), 3 * 4)
        for file in files:
            with open(self.path(f"named/{file}"), "rb") as one, open(self.path(f"stacked/{file}"), "rb") as other:
                self.assertEqual(one.read(), other.read(), file)

    def test_figures_and_pictures_are_drawn_of_both(self):
        written = {}
        for name in ("named", "stacked"):
            figures = self.succeed("bielle-plot", self.path(f"{name}.h5"), "-o", self.path(f"{name}_plots")).stdout.split()
            written[name] = {os.path.basename(path) for path in figures}
            self.succeed("bielle-animate", self.path(f"{name}.h5"), "-o", self.path(f"{name}.png"), "--frames", "2")
        self.assertEqual(written["stacked"], written["named"])
        self.assertIn("element_ram.png", written["stacked"])


if __name__ == "__main__":
    unittest.main()
