"""Tests that includes follow the list of folders, and that sources include the modules of Eigen that they use."""

import os
import unittest

from eigen_modules import missing_modules, modules_included, modules_used
from includes import FOLDERS, faults, fault_of, place_of, sources

ROOT = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", "..", ".."))


class Includes(unittest.TestCase):
    def test_no_include_climbs(self):
        self.assertGreater(len(list(sources(ROOT))), 50)
        self.assertEqual(faults(ROOT), [])

    def test_every_folder_is_in_the_list(self):
        for program, folders in FOLDERS.items():
            there = {place_of(path)[1] for path in sources(ROOT) if path.startswith(program)}
            self.assertLessEqual(there, set(folders))

    def test_the_rule_itself(self):
        allowed = [("reduce/mesh/a.cpp", "reduce/mesh/b.hpp"), ("reduce/fe/a.hpp", "reduce/common/error.hpp"),
                   ("reduce/main.cpp", "reduce/reduction/a.hpp"), ("mechanism/io/a.cpp", "mechanism/math/so3.hpp"),
                   ("mechanism/elements/beam/a.cpp", "reduce/superelement/superelement.hpp"),
                   ("mechanism/solvers/start/a.cpp", "reduce/spectral/a.hpp"), ("mechanism/analyses/a.cpp", "mechanism/session/session.hpp"),
                   ("mechanism/io/a.cpp", "mechanism/analyses/analysis.hpp"), ("mechanism/python/a.cpp", "mechanism/io/a.hpp"),
                   ("mechanism/joints/a.cpp", "mechanism/measures/a.hpp"),
                   ("mechanism/joints/pairs/a.cpp", "mechanism/joints/actions/a.hpp"),
                   ("mechanism/solvers/dynamics/a.cpp", "mechanism/solvers/start/a.hpp"),
                   ("mechanism/elements/superelement/a.cpp", "mechanism/elements/superelement/recovery/a.hpp"),
                   ("mechanism/io/a.cpp", "mechanism/elements/beam/beam.hpp")]
        refused = [("reduce/common/a.hpp", "reduce/mesh/mesh.hpp"), ("reduce/mesh/a.hpp", "reduce/body_file/body_file.hpp"),
                   ("mechanism/model/a.cpp", "mechanism/elements/beam/beam.hpp"), ("mechanism/io/a.cpp", "reduce/fe/a.hpp"),
                   ("mechanism/io/a.cpp", "reduce/sparse/a.hpp"), ("reduce/dense/a.cpp", "reduce/sparse/a.hpp"), ("reduce/sparse/a.cpp", "reduce/spectral/a.hpp"),
                   ("mechanism/session/a.cpp", "mechanism/io/mechanism_file.hpp"), ("mechanism/results/a.cpp", "mechanism/session/session.hpp"),
                   ("mechanism/laws/a.cpp", "mechanism/contacts/a.hpp"), ("mechanism/contacts/a.cpp", "mechanism/joints/a.hpp"),
                   ("reduce/common/a.cpp", "reduce/common/files/a.hpp"), ("reduce/body_file/a.cpp", "reduce/report/a.hpp"), ("mechanism/io/a.cpp", "mechanism/python/a.hpp"),
                   ("mechanism/session/a.cpp", "mechanism/analyses/analysis.hpp"),
                   ("mechanism/joints/a.cpp", "reduce/body_file/body_file.hpp"), ("reduce/fe/a.cpp", "mechanism/math/so3.hpp"),
                   ("mechanism/solvers/start/a.cpp", "mechanism/joints/a.hpp"),
                   ("mechanism/system/a.cpp", "mechanism/measures/a.hpp"), ("mechanism/system/a.cpp", "mechanism/reading/a.hpp"),
                   ("mechanism/solvers/newton/a.cpp", "mechanism/solvers/start/a.hpp"),
                   ("mechanism/solvers/dynamics/a.cpp", "mechanism/solvers/statics/a.hpp"),
                   ("mechanism/elements/superelement/a.cpp", "mechanism/elements/beam/a.hpp"),
                   ("mechanism/elements/superelement/recovery/a.cpp", "mechanism/elements/superelement/a.hpp"),
                   ("mechanism/joints/a.cpp", "mechanism/elements/forces/a.hpp"),
                   ("mechanism/joints/a.cpp", "mechanism/joints/pairs/a.hpp"), ("mechanism/measures/a.cpp", "mechanism/joints/a.hpp"),
                   ("reduce/fe/a.cpp", "material.hpp"),
                   ("reduce/fe/a.cpp", "../mesh/mesh.hpp"), ("reduce/fe/a.cpp", "tests/support/a.hpp"),
                   ("reduce/fe/a.cpp", "reduce/elsewhere/a.hpp")]
        for path, included in allowed:
            self.assertIsNone(fault_of(path, included), (path, included))
        for path, included in refused:
            self.assertIsNotNone(fault_of(path, included), (path, included))

    def test_every_module_of_eigen_in_use_is_included(self):
        self.assertEqual(missing_modules(ROOT), [])

    def test_what_uses_and_brings_a_module(self):
        self.assertEqual(modules_used("w.cross(v) + m.determinant()"), {"Geometry", "LU"})
        self.assertEqual(modules_used("Eigen::SelfAdjointEigenSolver<Matrix3d> s; q.inverse();"), {"Eigenvalues"})
        self.assertEqual(modules_included("#include <Eigen/Core>\n"), {"Core"})
        self.assertLessEqual({"Geometry", "LU", "SVD"}, modules_included("#include <vector>\n#include <Eigen/Geometry>\n"))


if __name__ == "__main__":
    unittest.main()
