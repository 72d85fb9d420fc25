// Each test introduces one error into correct matrices; the verification must name it.
#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "tests/unit/reduce/matrices/matrix_bodies.hpp"
#include "tests/unit/reduce/matrices/verified.hpp"

using namespace bielle;
using namespace bielle::reduce;
using Catch::Contains;

namespace {

MatrixSet declared(MatrixSet set) {
  set.has_units = true;
  return set;
}

/// Returns a beam of ten elements along x, with nodes 10 to 110.
MatrixSet sound_beam() { return declared(test::beam_set(10)); }

void exchange_positions(MatrixSet& set, Eigen::Index a, Eigen::Index b) {
  set.positions.col(a).swap(set.positions.col(b));
}

/// Rotates the unknowns of a node in the matrices, but not its declared axes.
void turn_matrices_at(MatrixSet& set, int node, const Eigen::Matrix3d& turn) {
  Eigen::MatrixXd all = Eigen::MatrixXd::Identity(set.size(), set.size());
  for (const int first : {0, 3}) {
    std::vector<Eigen::Index> at;
    for (Eigen::Index k = 0; k < set.size(); ++k) {
      const NodalUnknown& u = set.unknowns[static_cast<std::size_t>(k)];
      if ((node < 0 || u.node == node) && u.component / 3 == first / 3) at.push_back(k);
    }
    for (std::size_t k = 0; k + 2 < at.size(); k += 3) all.block<3, 3>(at[k], at[k]) = turn;
  }
  set.stiffness = test::sparse(all.transpose() * set.stiffness * all);
  set.mass = test::sparse(all.transpose() * set.mass * all);
}

const Eigen::Matrix3d quarter_turn = Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ()).toRotationMatrix();

}  // namespace

TEST_CASE("An entry that is not symmetric is named by its unknowns") {
  MatrixSet set = sound_beam();
  test::add_to(set.stiffness, 6 + 1, 12 + 1, 0.01 * set.stiffness.coeff(7, 7));
  CHECK_THAT(test::faults_of(set), Contains("the stiffness is not symmetric: between node 20 y and node 30 y") ||
                                       Contains("the stiffness is not symmetric: between node 30 y and node 20 y"));
}

TEST_CASE("A negative mass is named") {
  MatrixSet set = sound_beam();
  test::add_to(set.mass, 26, 26, -3 * set.mass.coeff(26, 26));  // node 50 z
  CHECK_THAT(test::faults_of(set), Contains("the mass is not positive") && Contains("node 50 z has the largest part"));
}

TEST_CASE("A spring to the ground is found at its unknown, with the number of motions that it holds") {
  MatrixSet set = sound_beam();
  // Node 30 rx holds the rotation about x alone.
  test::add_to(set.stiffness, 15, 15, 1e-3 * set.stiffness.coeff(15, 15));
  const std::string faults = test::faults_of(set);
  CHECK_THAT(
      faults,
      Contains("the stiffness holds the body to the ground: 1 of 6 rigid motions cause force; most at node 30 rx"));
  CHECK_THAT(faults, Contains("1 of the six lowest modes vibrate"));
  CHECK_THAT(faults, !Contains("positions"));
}

TEST_CASE("If a node is held, all rigid motions cause force") {
  MatrixSet set = sound_beam();
  for (int c = 0; c < 6; ++c) test::add_to(set.stiffness, c, c, set.stiffness.coeff(c, c));
  CHECK_THAT(test::faults_of(set), Contains("6 of 6 rigid motions cause force; most at node 10"));
}

TEST_CASE("If positions and matrices have different units of length, both units are named") {
  MatrixSet set = sound_beam();
  const auto [factor, words] =
      GENERATE(table<double, std::string>({{1e3, "positions look like millimetres where the matrices are in metres"},
                                           {1e-3, "positions look like metres where the matrices are in millimetres"},
                                           {1 / 0.0254, "positions look like inches where the matrices are in metres"},
                                           {7, "lengths of the matrices are 0.142857 times those of the positions"}}));
  set.positions *= factor;
  set.has_units = false;  // suppresses the second finding about units
  const std::string faults = test::faults_of(set);
  CHECK_THAT(faults, Contains(words) && Contains("the positions or axes of the nodes do not fit the stiffness"));
  CHECK_THAT(faults, !Contains("--units"));
}

TEST_CASE("Exchanged nodes are named") {
  MatrixSet set = sound_beam();
  exchange_positions(set, 2, 7);
  CHECK_THAT(test::faults_of(set), Contains("2 nodes are not where the matrices have them") &&
                                       Contains("node 30 1 m off (where node 80 stands)") &&
                                       Contains("node 80 1 m off (where node 30 stands)"));
}

TEST_CASE("Exchanged nodes are named in a mesh as well, whose nodes have no rotations") {
  MatrixSet set = declared(test::matrices_of(test::twisted_block()));
  REQUIRE(test::faults_of(set) == "");
  exchange_positions(set, 3, 30);
  CHECK_THAT(test::faults_of(set),
             Contains("2 nodes are not where the matrices have them") && Contains("node 4 ") && Contains("node 31 "));
}

TEST_CASE("Positions in rotated axes are reported with the angle") {
  MatrixSet mesh = declared(test::matrices_of(test::twisted_block()));
  mesh.positions = quarter_turn * mesh.positions;
  CHECK_THAT(test::faults_of(mesh), Contains("positions are turned by 90 deg against the axes of the unknowns"));
  MatrixSet beam = sound_beam();
  turn_matrices_at(beam, -1, quarter_turn);
  CHECK_THAT(test::faults_of(beam), Contains("positions are turned by 90 deg against the axes of the unknowns"));
}

TEST_CASE("A node whose unknowns have undeclared axes is named") {
  MatrixSet set = sound_beam();
  turn_matrices_at(set, 4, quarter_turn);
  CHECK_THAT(test::faults_of(set),
             Contains("the axes of node 50 are turned by 90 deg against those of its unknowns\n"));
}

TEST_CASE("Mass without stiffness is named") {
  MatrixSet set = sound_beam();
  set.unknowns.push_back({-1, 0});
  for (SparseColumns* matrix : {&set.stiffness, &set.mass}) matrix->conservativeResize(67, 67);
  test::add_to(set.mass, 66, 66, 1);
  CHECK_THAT(test::faults_of(set), Contains("1 unknown has mass but no stiffness"));
  CHECK_THAT(test::faults_of(set), Contains("scalar 1"));
}

TEST_CASE("Stiffness without mass is reported, but is not an error") {
  MatrixSet set = declared(test::beam_set(4));
  for (SparseColumns* matrix : {&set.mass}) {
    Eigen::MatrixXd lumped = Eigen::MatrixXd::Zero(30, 30);
    for (int a = 0; a < 5; ++a)
      for (int i = 0; i < 3; ++i) lumped(6 * a + i, 6 * a + i) = a == 0 || a == 4 ? 0.75 : 1.5;
    for (int a = 0; a < 5; ++a) lumped(6 * a + 3, 6 * a + 3) = 0.004;
    *matrix = test::sparse(lumped);
  }
  const Verification found = verify(set);
  CHECK(test::faults_of(found) == "");
  CHECK(found.subjects[1].lines ==
        std::vector<std::string>{
            "10 unknowns have stiffness but no mass: node 10 ry, node 10 rz, node 20 ry, node 20 rz and 6 more"});
}

namespace {

/// Factors from SI units to the units of a set of translations.
void in_units(double length, double mass, double time, MatrixSet& set) {
  set.positions *= length;
  set.stiffness *= mass / (time * time);
  set.mass *= mass;
  set.has_units = false;
}

}  // namespace

TEST_CASE("Units that were not declared are guessed") {
  MatrixSet set = test::matrices_of(test::twisted_block());
  REQUIRE(test::faults_of(set) == "");  // numbers in SI units are plausible
  const auto [name, length, mass, time] = GENERATE(table<std::string, double, double, double>(
      {{"mm-t-s", 1e3, 1e-3, 1}, {"mm-kg-ms", 1e3, 1, 1e3}, {"in-slinch-s", 1 / 0.0254, 1 / 175.126836, 1}}));
  in_units(length, mass, time, set);
  CHECK_THAT(test::faults_of(set), Contains("its units are probably " + name + ": `--units " + name + "`"));
  set.has_units = true;  // declared units are not questioned
  CHECK_THAT(test::faults_of(set), !Contains("--units"));
}

TEST_CASE("If the stated mass differs from that of the matrix, both are reported") {
  MatrixSet set = sound_beam();
  set.stated = StatedMass{5, {1, 0, 0}, Eigen::Vector3d(0.02, 2, 2).asDiagonal()};
  CHECK_THAT(test::faults_of(set), Contains("the mass matrix has 6 kg, the file states 5 kg"));
}

TEST_CASE("Damping proportional to the mass damps rigid motions, which is reported") {
  MatrixSet set = sound_beam();
  set.damping = 1e-4 * set.stiffness;
  CHECK(test::faults_of(set) == "");
  set.damping = 0.1 * set.mass;
  CHECK_THAT(test::faults_of(set), Contains("the damping resists rigid motions"));
}
