// Tests that correct matrices pass every check, and that their mass properties are those of the body.
#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "reduce/matrices/matrix_study.hpp"
#include "reduce/matrices/set_mass.hpp"
#include "reduce/matrices/superelement_set.hpp"
#include "tests/unit/reduce/matrices/matrix_bodies.hpp"
#include "tests/unit/reduce/matrices/verified.hpp"

using namespace bielle;
using namespace bielle::reduce;

namespace {

MatrixSet in_SI(MatrixSet set) {
  set.has_units = true;
  return set;
}

Superelement reduced_block(int modes) {
  return test::reduced(test::twisted_block(), test::steel_body(Tie::rigid, Tie::average, modes));
}

}  // namespace

TEST_CASE("A beam of two nodes passes every check") {
  const int elements = GENERATE(1, 2, 10);
  const Verification found = verify(in_SI(test::beam_set(elements)));
  CHECK(test::faults_of(found) == "");
  CHECK(found.checks() >= 12);
  CHECK(test::value_of(found, "rigid_motion_force") < 1e-12);
  CHECK(test::value_of(found, "static_rigid_motions") < 1e-10);
  CHECK(test::value_of(found, "modal_rigid_motions") < 1e-6);
  CHECK(test::value_of(found, "positions") < 1e-9);
}

TEST_CASE("The mass properties of a beam are those of a uniform line") {
  const MatrixSet set = test::beam_set(10);
  const SetMass mass = mass_of(study_matrices(set, 1));
  CHECK(mass.mass() == Approx(6).epsilon(1e-12));  // 3 kg/m, 2 m
  CHECK((mass.centre - Eigen::Vector3d(1, 0, 0)).norm() < 1e-12);
  CHECK(mass.inertia(0, 0) == Approx(2e-4).epsilon(1e-12));           // 0.01 kg m, 2 m
  CHECK(mass.inertia(1, 1) == Approx(6 * 4.0 / 12).epsilon(1e-12));   // m L^2 / 12
  CHECK(mass.at_origin(2, 2) == Approx(6 * 4.0 / 3).epsilon(1e-12));  // m L^2 / 3
  CHECK(mass.odd < 1e-12);
}

TEST_CASE("The matrices of a mesh pass with any axes of their nodes") {
  MatrixSet set = in_SI(test::matrices_of(test::twisted_block()));
  CHECK(test::faults_of(set) == "");
  test::turn_nodes(set);
  CHECK(test::faults_of(set) == "");
}

TEST_CASE("A reduced body is verified with the numbers of its file") {
  const int modes = GENERATE(0, 6);
  const Superelement body = reduced_block(modes);
  const MatrixSet set = matrix_set_of(body);
  CHECK(set.scalars() == modes);
  const Verification found = verify(set);
  CHECK(test::faults_of(found) == "");
  CHECK(test::value_of(found, "stated_mass") < 1e-10);
  CHECK(test::value_of(found, "inertia_components_rigid") < 1e-9);
  CHECK(test::value_of(found, "shape_rigid_motions") < 1e-10);
}

TEST_CASE("Empty unknowns are left out and named") {
  MatrixSet set = in_SI(test::beam_set(2));
  for (SparseColumns* matrix : {&set.stiffness, &set.mass}) {
    Eigen::MatrixXd larger = Eigen::MatrixXd::Zero(19, 19);
    larger.topLeftCorner(18, 18) = *matrix;
    *matrix = test::sparse(larger);
  }
  set.numbers.push_back(77);
  set.positions.conservativeResize(3, 4);
  set.positions.col(3) = Eigen::Vector3d(5, 0, 0);
  set.axes.emplace_back(Eigen::Matrix3d::Identity());
  set.unknowns.push_back({3, 1});
  const Verification found = verify(set);
  CHECK(test::faults_of(found) == "");
  REQUIRE(found.subjects[0].lines.size() == 1);
  CHECK(found.subjects[0].lines[0] == "1 unknown has neither stiffness nor mass: node 77 y");
}

TEST_CASE("A body that has only modes, including rigid ones, is verified by its shapes") {
  const MatrixSet beam = test::beam_set(10);
  const MatrixStudy study = study_matrices(beam, 1);
  REQUIRE(study.modes);
  MatrixSet modal;
  modal.name = "modal beam";
  modal.source = "modes of the test";
  modal.has_units = true;
  modal.positions.resize(3, 0);
  const Eigen::Index count = study.modes->eigenvalues.size();
  for (int k = 0; k < count; ++k) modal.unknowns.push_back({-1, k});
  Eigen::VectorXd squares = study.modes->eigenvalues;
  squares.head(6).setZero();
  modal.stiffness = test::sparse(squares.asDiagonal());
  modal.mass = test::sparse(Eigen::MatrixXd::Identity(count, count));
  NodalShapes shapes;
  // Each section has four points, with u = u_node + theta x arm.
  const Eigen::MatrixXd u = nodal_motions(beam, false) * study.modes->vectors;
  const Eigen::MatrixXd theta = nodal_motions(beam, true) * study.modes->vectors;
  shapes.points.resize(3, 44);
  shapes.displacement.resize(132, count);
  for (Eigen::Index a = 0; a < 11; ++a)
    for (Eigen::Index p = 0; p < 4; ++p) {
      const Eigen::Vector3d arm = 0.1 * Eigen::Vector3d(0, p % 2 == 0 ? 1 : -1, p / 2 == 0 ? 1 : -1);
      shapes.points.col(4 * a + p) = beam.positions.col(a) + arm;
      for (Eigen::Index k = 0; k < count; ++k)
        shapes.displacement.col(k).segment<3>(3 * (4 * a + p)) =
            u.col(k).segment<3>(3 * a) + Eigen::Vector3d(theta.col(k).segment<3>(3 * a)).cross(arm);
    }
  for (int p = 0; p < 44; ++p) shapes.numbers.push_back(p + 1);
  modal.shapes = shapes;
  const Verification found = verify(modal);
  CHECK(test::faults_of(found) == "");
  CHECK(mass_of(study_matrices(modal, 1)).mass() == Approx(6).epsilon(1e-6));
  modal.shapes->points.col(3).swap(modal.shapes->points.col(40));
  CHECK_THAT(test::faults_of(modal), Catch::Contains("move point 4 of the shapes otherwise") ||
                                         Catch::Contains("move point 41 of the shapes otherwise"));
}
