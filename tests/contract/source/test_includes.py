"""Includes go upwards in the list of folders only."""

import os
import unittest

from includes import FOLDERS, faults, fault_of, sources

ROOT = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", "..", ".."))


class Includes(unittest.TestCase):
    def test_no_include_climbs(self):
        self.assertGreater(len(list(sources(ROOT))), 50)
        self.assertEqual(faults(ROOT), [])

    def test_every_folder_is_in_the_list(self):
        for program, folders in FOLDERS.items():
            there = {path.split("/")[1] for path in sources(ROOT) if path.startswith(program) and path.count("/") > 1}
            self.assertLessEqual(there, set(folders))

    def test_the_rule_itself(self):
        allowed = [("reduce/mesh/a.cpp", "reduce/mesh/b.hpp"), ("reduce/fe/a.hpp", "reduce/common/error.hpp"),
                   ("reduce/main.cpp", "reduce/reduction/a.hpp"), ("mechanism/io/a.cpp", "mechanism/math/so3.hpp"),
                   ("mechanism/elements/a.cpp", "reduce/superelement/superelement.hpp"),
                   ("mechanism/solvers/a.cpp", "reduce/spectral/a.hpp"), ("mechanism/analyses/a.cpp", "mechanism/session/session.hpp"),
                   ("mechanism/io/a.cpp", "mechanism/analyses/analysis.hpp"),
                   ("mechanism/joints/a.cpp", "mechanism/measures/a.hpp")]
        refused = [("reduce/common/a.hpp", "reduce/mesh/mesh.hpp"), ("reduce/mesh/a.hpp", "reduce/body_file.hpp"),
                   ("mechanism/system/a.cpp", "mechanism/elements/beam.hpp"), ("mechanism/io/a.cpp", "reduce/fe/a.hpp"),
                   ("mechanism/session/a.cpp", "mechanism/io/results_file.hpp"),
                   ("mechanism/session/a.cpp", "mechanism/analyses/analysis.hpp"),
                   ("mechanism/joints/a.cpp", "reduce/body_file.hpp"), ("reduce/fe/a.cpp", "mechanism/math/so3.hpp"),
                   ("mechanism/solvers/a.cpp", "mechanism/joints/a.hpp"),
                   ("mechanism/solvers/a.cpp", "mechanism/measures/a.hpp"), ("mechanism/measures/a.cpp", "mechanism/joints/a.hpp"),
                   ("reduce/fe/a.cpp", "material.hpp"),
                   ("reduce/fe/a.cpp", "../mesh/mesh.hpp"), ("reduce/fe/a.cpp", "tests/support/a.hpp"),
                   ("reduce/fe/a.cpp", "reduce/elsewhere/a.hpp")]
        for path, included in allowed:
            self.assertIsNone(fault_of(path, included), (path, included))
        for path, included in refused:
            self.assertIsNotNone(fault_of(path, included), (path, included))


if __name__ == "__main__":
    unittest.main()
