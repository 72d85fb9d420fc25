#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "reduce/common/error.hpp"
#include "reduce/reduction/rigid_motions.hpp"
#include "reduce/reduction/ties.hpp"
#include "tests/unit/reduce/reduction/bodies.hpp"

using namespace bielle;
using namespace bielle::reduce;
using Catch::Contains;

TEST_CASE("An average interface follows rigid motions of its surface exactly, for any position of its node") {
  const Mesh mesh = test::twisted_block();
  InterfaceRequest request = test::interface("a", "x1", Tie::average);
  request.position = Eigen::Vector3d(0.7, -0.2, 0.3);
  request.rotation = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  const Ties ties = make_ties(test::steel_solid(mesh), {request});
  const RowMatrix u = rigid_motions(mesh.points, Eigen::Vector3d(0.1, 0.2, 0.3));
  const Eigen::MatrixXd q = interface_rigid_motions(ties.interfaces, Eigen::Vector3d(0.1, 0.2, 0.3));
  CHECK((ties.spread.transpose() * u - q).norm() < 1e-12);  // terms of the order arm / width of the surface = 10
}

TEST_CASE("A load on an average interface is distributed without loss of force or moment") {
  const Mesh mesh = test::twisted_block();
  InterfaceRequest request = test::interface("a", "x1", Tie::average);
  request.position = Eigen::Vector3d(0.7, -0.2, 0.3);
  const Ties ties = make_ties(test::steel_solid(mesh), {request});
  // The resultants about the interface's node are the work on rigid motions about it.
  const Eigen::MatrixXd resultants = rigid_motions(mesh.points, *request.position).transpose() * ties.spread;
  CHECK((resultants - Eigen::MatrixXd::Identity(6, 6)).norm() < 1e-12);  // terms of the order arm / width = 10
}

TEST_CASE("The mean displacement of a surface is weighted by area, on any mesh") {
  // The field u = (y^2, 0, 0) on the side x = 1 of a unit box has the mean 1/3 and no mean rotation about y. The mean
  // rotation about z is -int (y - 1/2) y^2 / int (y - 1/2)^2 = -(1/4 - 1/6) / (1/12) = -1.
  const Mesh mesh = test::distorted_box_mesh({{1, 1, 1}, {2, 3, 2}}, 0.2);
  const Ties ties = make_ties(test::steel_solid(mesh), {test::interface("a", "x1", Tie::average)});
  Eigen::VectorXd u = Eigen::VectorXd::Zero(3 * mesh.point_count());
  for (Eigen::Index a = 0; a < mesh.point_count(); ++a) {
    u(3 * a) = mesh.points(1, a) * mesh.points(1, a);
  }
  Eigen::VectorXd expected(6);
  expected << 1.0 / 3, 0, 0, 0, 0, -1;
  CHECK((ties.spread.transpose() * u - expected).norm() < 1e-13);
}

TEST_CASE("A rigid interface moves its surface, in its own axes, and has its node at the centroid by default") {
  const Mesh mesh = test::twisted_block();
  InterfaceRequest request = test::interface("a", "x0", Tie::rigid);
  request.rotation = Eigen::AngleAxisd(1.1, Eigen::Vector3d(0, 2, 1).normalized()).toRotationMatrix();
  request.kept = {true, true, false, true, true, true};
  const Ties ties = make_ties(test::steel_solid(mesh), {request});
  CHECK(ties.interfaces[0].position == integrate_surface(mesh, "x0").centroid);
  REQUIRE(ties.kept.size() == 5);
  REQUIRE(ties.released.size() == 1);
  CHECK(ties.released[0].axis == 2);
  const Eigen::MatrixXd q = interface_rigid_motions(ties.interfaces, Eigen::Vector3d::Zero());
  const Eigen::Matrix<double, 1, 6> released = interface_rigid_motion(ties.interfaces[0], 2, Eigen::Vector3d::Zero());
  const RowMatrix u = rigid_motions(mesh.points, Eigen::Vector3d::Zero());
  const RowMatrix carried = ties.carry_kept * q + ties.carry_released * Eigen::MatrixXd(released);
  for (const int node : ties.surfaces[0].nodes) {
    CHECK((carried - u).middleRows<3>(3 * node).norm() < 1e-14);
    CHECK(ties.tied[node]);
  }
}

TEST_CASE("A free interface has a node for each node of the mesh") {
  const Mesh mesh = test::box_mesh({{1, 1, 1}, {2, 1, 1}});
  const Ties ties = make_ties(test::steel_solid(mesh), {test::interface("foot", "x0", Tie::free)});
  REQUIRE(ties.interfaces.size() == 9);
  CHECK(ties.kept.size() == 27);
  const int node = ties.surfaces[3].nodes[0];
  CHECK(ties.interfaces[3].name == "foot_" + std::to_string(node));
  CHECK(ties.interfaces[3].position == mesh.points.col(node));
  CHECK(ties.interfaces[3].kept == std::array<bool, 6>{true, true, true, false, false, false});
}

TEST_CASE("Impossible interfaces are refused with their key") {
  const Mesh mesh = test::box_mesh({{1, 1, 1}, {2, 2, 2}});
  const Solid solid = test::steel_solid(mesh);
  const auto a = test::interface("a", "x0", Tie::rigid);
  CHECK_THROWS_WITH(make_ties(solid, {}), Contains("interfaces: there is none"));
  CHECK_THROWS_WITH(
      make_ties(solid, {a, test::interface("b", "y0", Tie::average)}),
      Contains("interfaces.b: surface 'y0' shares 5 points with interface 'a'") && Contains("leave a row of elements"));
  CHECK_THROWS_WITH(make_ties(solid, {test::interface("b", "y3", Tie::rigid)}),
                    Contains("interfaces.b: the mesh has no surface group 'y3'"));
  auto none = a;
  none.kept.fill(false);
  CHECK_THROWS_WITH(make_ties(solid, {none}), Contains("no direction of the interface is kept"));
  auto twin = test::interface("a", "x1", Tie::rigid);
  CHECK_THROWS_WITH(make_ties(solid, {a, twin}), Contains("there are two interfaces 'a'"));

  Mesh loose = mesh;
  loose.points.conservativeResize(Eigen::NoChange, loose.points.cols() + 1);
  loose.points.rightCols<1>() << -1, 0, 0;
  loose.blocks[1].nodes(0, loose.groups.at("x0").parts[0].cells[0]) = static_cast<int>(loose.points.cols()) - 1;
  CHECK_THROWS_WITH(make_ties(test::steel_solid(loose), {a}), Contains("is no point of the solid"));
}
