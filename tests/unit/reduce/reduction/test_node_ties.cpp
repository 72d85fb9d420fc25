// Tests of ties of nodes with weights, which come from decks.
#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "reduce/common/error.hpp"
#include "reduce/reduction/rigid_motions.hpp"
#include "reduce/reduction/ties.hpp"
#include "tests/unit/reduce/reduction/bodies.hpp"

using namespace bielle;
using namespace bielle::reduce;
using Catch::Contains;

namespace {

/// Returns the nodes of a surface, with weights 1, 2, 3, .. in place of areas.
Group weighted(const Mesh& mesh, const std::string& surface) {
  Group group;
  group.nodes = mesh.groups.at(surface).nodes;
  for (std::size_t k = 0; k < group.nodes.size(); ++k) group.weights.push_back(1.0 + static_cast<double>(k));
  return group;
}

Mesh block_with_nodes() {
  Mesh mesh = test::twisted_block();
  mesh.groups["hub"] = weighted(mesh, "x1");
  return mesh;
}

InterfaceRequest turned_interface(Tie tie) {
  InterfaceRequest request = test::interface("a", "hub", tie);
  request.position = Eigen::Vector3d(0.7, -0.2, 0.3);
  request.rotation = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  return request;
}

}  // namespace

TEST_CASE("An average of weighted nodes follows rigid motions exactly, and preserves force and moment") {
  const Mesh mesh = block_with_nodes();
  InterfaceRequest request = turned_interface(Tie::average);
  const Eigen::Vector3d about(0.1, 0.2, 0.3);
  const Ties turned = make_ties(test::steel_solid(mesh), {request});
  const RowMatrix u = rigid_motions(mesh.points, about);
  CHECK((turned.spread.transpose() * u - interface_rigid_motions(turned.interfaces, about)).norm() < 1e-12);
  request.rotation.setIdentity();
  const Ties ties = make_ties(test::steel_solid(mesh), {request});
  const Eigen::MatrixXd resultants = rigid_motions(mesh.points, *request.position).transpose() * ties.spread;
  CHECK((resultants - Eigen::MatrixXd::Identity(6, 6)).norm() < 1e-12);  // terms of the order arm / width = 10
}

TEST_CASE("A force on the centroid of nodes is shared by their weights, and a moment as in a bolt pattern") {
  // The forces of a plane bolt pattern are F_a = w_a / W F, and w_a M x r_a / sum w |r|^2 for a moment normal to its
  // plane.
  Mesh mesh = test::box_mesh({{1, 1, 1}, {2, 2, 2}});
  mesh.groups["hub"] = weighted(mesh, "x1");
  const Group& group = mesh.groups.at("hub");
  double W = 0, J = 0;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < group.nodes.size(); ++k) {
    W += group.weights[k];
    centre += group.weights[k] * mesh.points.col(group.nodes[k]);
  }
  centre /= W;
  for (std::size_t k = 0; k < group.nodes.size(); ++k)
    J += group.weights[k] * (mesh.points.col(group.nodes[k]) - centre).squaredNorm();
  InterfaceRequest request = test::interface("a", "hub", Tie::average);
  const Ties ties = make_ties(test::steel_solid(mesh), {request});
  CHECK((ties.interfaces[0].position - centre).norm() < 1e-15);
  const Eigen::MatrixXd spread = ties.spread;
  for (std::size_t k = 0; k < group.nodes.size(); ++k) {
    const int node = group.nodes[k];
    const Eigen::Vector3d r = mesh.points.col(node) - centre;
    CHECK((spread.block<3, 3>(3 * node, 0) - group.weights[k] / W * Eigen::Matrix3d::Identity()).norm() < 1e-14);
    const Eigen::Vector3d bolt = group.weights[k] / J * Eigen::Vector3d::UnitX().cross(r);
    CHECK((spread.block<3, 1>(3 * node, 3) - bolt).norm() < 1e-14);
  }
}

TEST_CASE("A rigid tie of nodes moves these nodes, and no others of their surface") {
  Mesh mesh = block_with_nodes();
  Group& group = mesh.groups.at("hub");
  const int left_out = group.nodes.back();
  group.nodes.pop_back();
  group.weights.pop_back();
  const InterfaceRequest request = turned_interface(Tie::rigid);
  const Ties ties = make_ties(test::steel_solid(mesh), {request});
  const RowMatrix u = rigid_motions(mesh.points, *request.position);
  const RowMatrix carried = ties.carry_kept * interface_rigid_motions(ties.interfaces, *request.position);
  for (const int node : group.nodes) CHECK((carried - u).middleRows<3>(3 * node).norm() < 1e-14);
  CHECK_FALSE(ties.tied[left_out]);
}

TEST_CASE("Nodes in one line, and fewer than three, are refused as an interface") {
  Mesh mesh = test::box_mesh({{1, 1, 1}, {2, 2, 2}});
  Group& edge = mesh.groups["hub"];
  for (int node = 0; node < mesh.point_count(); ++node)
    if (mesh.points(0, node) == 1 && mesh.points(1, node) == 0) edge.nodes.push_back(node);
  edge.weights.assign(edge.nodes.size(), 1.0);
  REQUIRE(edge.nodes.size() >= 3);
  for (const Tie tie : {Tie::rigid, Tie::average})
    CHECK_THROWS_WITH(make_ties(test::steel_solid(mesh), {test::interface("a", "hub", tie)}),
                      Contains("in one line along (0, 0, 1)"));
  edge.nodes.resize(2);
  edge.weights.resize(2);
  CHECK_THROWS_WITH(make_ties(test::steel_solid(mesh), {test::interface("a", "hub", Tie::rigid)}),
                    Contains("the hub are 2 nodes of the solid"));
}
