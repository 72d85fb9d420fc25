// Tests that wrong matrices are refused, and that messages name the wrong entry.
#include <catch2/catch.hpp>

#include "reduce/common/error.hpp"
#include "tests/unit/reduce/matrices/matrix_bodies.hpp"

using namespace bielle;
using namespace bielle::reduce;
using Catch::Contains;

TEST_CASE("Unsymmetric matrices are refused with the worst pair of entries") {
  MatrixSet set = test::beam_set();
  set.stiffness.coeffRef(1, 5) *= 1.001;
  CHECK_THROWS_WITH(test::reduced(set, {}),
                    Contains("stiffness is not symmetric") && Contains("node 10 y") && Contains("node 10 rz"));
  set = test::beam_set();
  set.mass = SparseColumns(set.mass.triangularView<Eigen::Lower>());
  CHECK_THROWS_WITH(test::reduced(set, {}), Contains("mass is not symmetric") && Contains("one triangle"));
}

TEST_CASE("A stiffness that is connected to the ground is refused, and so are wrong positions") {
  MatrixSet set = test::beam_set();
  set.stiffness.coeffRef(8, 8) += 1e6;
  CHECK_THROWS_WITH(test::reduced(set, {}),
                    Contains("rigid rotation about y") && Contains("held to the ground") && Contains("node_20 z"));
  set = test::beam_set();
  set.positions *= 1000;  // positions in millimetres
  CHECK_THROWS_WITH(test::reduced(set, {}), Contains("positions, axes and units"));
  set = test::beam_set();
  std::swap(set.unknowns[7], set.unknowns[8]);
  CHECK_THROWS_WITH(test::reduced(set, {}), Contains("rigid"));
}

TEST_CASE("A part without stiffness is named") {
  MatrixSet set = test::beam_set(2);
  MatrixOptions options;
  options.interfaces = {test::tied("a", {10})};
  Eigen::MatrixXd K = set.stiffness;
  K.row(15).setZero();
  K.col(15).setZero();  // rx of the third node
  set.stiffness = test::sparse(K);
  CHECK_THROWS_WITH(test::reduced(set, options), Contains("singular at node 30 rx"));
}

TEST_CASE("Requests that do not fit the nodes are refused") {
  const MatrixSet set = test::beam_set(2);
  const auto refused = [&](const NodeInterface& a, const NodeInterface& b, const std::string& words) {
    MatrixOptions options;
    options.interfaces = {a, b};
    CHECK_THROWS_WITH(test::reduced(set, options), Contains(words));
  };
  refused(test::tied("a", {10}), test::tied("b", {11}), "no node 11; the nearest are 10, 20, 30");
  refused(test::tied("a", {10}), test::tied("a", {20}), "two interfaces 'a'");
  refused(test::tied("a", {10}), test::tied("b", {20, 10}), "belongs to the interface 'a' already");
  refused(test::tied("a", {10}), test::tied("b", {20, 20}), "stands twice");
  refused(test::tied("a", {10}), test::tied("b", {20, 30}, Tie::average), "2 nodes");
  MatrixOptions options;
  options.points.resize(1);
  options.points[0].node = 99;
  options.points[0].subject = "points.tip";
  CHECK_THROWS_WITH(test::reduced(set, options), Contains("points.tip") && Contains("no node 99"));
}

TEST_CASE("Directions that a node does not have are named") {
  const Mesh mesh = test::twisted_block();
  MatrixOptions options;
  options.interfaces = {test::tied("a", {1})};
  options.interfaces[0].kept = {true, true, true, true, true, true};
  CHECK_THROWS_WITH(test::reduced(test::matrices_of(mesh), options),
                    Contains("node 1 has no unknown for the direction rx; it has x, y, z"));
  options.interfaces[0].kept.reset();
  CHECK_THROWS_WITH(test::reduced(test::matrices_of(mesh), options), Contains("singular"));
}

TEST_CASE("A negative mass is refused with its entry, or with the mass that remains at the interfaces") {
  MatrixSet set = test::beam_set(5);
  MatrixOptions options;
  options.interfaces = {test::tied("a", {10}), test::tied("b", {60})};
  set.mass = -set.mass;
  CHECK_THROWS_WITH(test::reduced(set, options), Contains("negative entry on its diagonal") && Contains("node 10 x"));
  set.mass = -set.mass;
  set.mass.coeffRef(0, 30) = set.mass.coeffRef(30, 0) = 10 * set.mass.coeff(0, 0);  // the entry couples both ends
  CHECK_THROWS_WITH(test::reduced(set, options), Contains("the mass is not positive: reduced and scaled"));
}

TEST_CASE("A body with mass only at its interfaces has no modes") {
  MatrixSet set = test::beam_set(2);
  MatrixOptions options;
  options.interfaces = {test::tied("a", {10}), test::tied("b", {30})};
  Eigen::MatrixXd M = set.mass;
  M.setZero();
  M.diagonal().head(6).setConstant(2);
  M.diagonal().tail(6).setConstant(2);
  set.mass = test::sparse(M);
  const Superelement body = test::reduced(set, options);
  CHECK(body.frequencies.size() == 0);
  CHECK(body.total_mass == Approx(4));
}

TEST_CASE("Matrices without mass, and empty ones, are refused") {
  MatrixSet set = test::beam_set();
  set.mass.setZero();
  CHECK_THROWS_WITH(test::reduced(set, {}), Contains("a mass matrix is needed"));
  set.stiffness.setZero();
  CHECK_THROWS_WITH(test::reduced(set, {}), Contains("stiffness and mass are zero"));
}
