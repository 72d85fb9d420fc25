// Tests of named points: means of a surface with the weights of the average tie, and places in the mesh.
#include <catch2/catch.hpp>

#include "reduce/common/error.hpp"
#include "reduce/reduction/point_ties.hpp"
#include "reduce/reduction/rigid_motions.hpp"
#include "tests/support/messages.hpp"
#include "tests/unit/reduce/reduction/bodies.hpp"

using namespace bielle;
using namespace bielle::reduce;
using bielle::test::message_of;
using Catch::Contains;

TEST_CASE("A point on a surface moves as the node of an average tie does") {
  const Mesh mesh = test::twisted_block();
  const Solid solid = test::steel_solid(mesh);
  const Eigen::Vector3d place(0.7, -0.2, 0.3);
  for (const bool off_centre : {false, true}) {
    InterfaceRequest tie = test::interface("a", "y1", Tie::average);
    PointRequest request = test::point_on("pad", "y1");
    if (off_centre) tie.position = request.position = place;
    const Ties ties = make_ties(solid, {tie});
    const TiedPoint point = tie_points(solid, {request}, "box").front();
    CHECK(point.position == ties.interfaces.front().position);
    CHECK((point.spread - ties.spread).norm() == 0);
  }
}

TEST_CASE("Points follow rigid motions exactly, and preserve the resultants of loads") {
  const Mesh mesh = test::twisted_block();
  const Solid solid = test::steel_solid(mesh);
  // The places are at a node, between nodes, and slightly outside of the surface.
  std::vector<PointRequest> requests = {test::point_at("node", mesh.points.col(40)),
                                        test::point_at("inside", mass_properties(solid).centre),
                                        test::point_on("pad", "z1")};
  requests.push_back(test::point_at("beside", mesh.points.rowwise().maxCoeff() + Eigen::Vector3d(0.01, -0.03, -0.03)));
  for (const TiedPoint& point : tie_points(solid, requests, "box")) {
    CAPTURE(point.request.name);
    // Terms are of the order arm / distance of the nodes = 10.
    const Eigen::MatrixXd resultants = point.spread.transpose() * rigid_motions(mesh.points, point.position);
    CHECK((resultants - Eigen::MatrixXd::Identity(6, 6)).norm() < 1e-11);
  }
}

TEST_CASE("The point of a surface has the mean of a field over the area") {
  // The field is u = (y^2, 0, 0) on the side x = 1 of a unit box, as in the test of the average tie.
  const Mesh mesh = test::distorted_box_mesh({{1, 1, 1}, {2, 3, 2}}, 0.2);
  RowMatrix field = RowMatrix::Zero(3 * mesh.point_count(), 1);
  for (Eigen::Index a = 0; a < mesh.point_count(); ++a) field(3 * a, 0) = mesh.points(1, a) * mesh.points(1, a);
  const auto points = named_points(tie_points(test::steel_solid(mesh), {test::point_on("pad", "x1")}, "box"), field);
  Eigen::VectorXd expected(6);
  expected << 1.0 / 3, 0, 0, 0, 0, -1;
  CHECK((points.at("pad").shapes - expected).norm() < 1e-13);
  CHECK((points.at("pad").position - Eigen::Vector3d(1, 0.5, 0.5)).norm() < 1e-14);
}

TEST_CASE("The displacement and rotation of a point in the mesh are exact for a field that is linear in space") {
  const Mesh mesh = test::twisted_block();
  const Eigen::Vector3d place = mesh.points.rowwise().mean();
  Eigen::Matrix3d gradient;
  gradient << 1, 2, 3, -4, 5, 6, 7, -8, 9;
  RowMatrix field(3 * mesh.point_count(), 1);
  for (Eigen::Index a = 0; a < mesh.point_count(); ++a) field.middleRows<3>(3 * a) = gradient * mesh.points.col(a);
  const auto points = named_points(tie_points(test::steel_solid(mesh), {test::point_at("p", place)}, "box"), field);
  Eigen::VectorXd expected(6);
  expected << gradient * place, Eigen::Vector3d(-8 - 6, 3 - 7, -4 - 2) / 2;  // half the curl
  CHECK((points.at("p").shapes - expected).norm() < 1e-11 * expected.norm());
}

TEST_CASE("Impossible points are refused with their key") {
  const Mesh mesh = test::box_mesh({{1, 1, 1}, {2, 2, 2}});
  const auto refusal = [&](const std::vector<PointRequest>& requests) {
    return message_of<InputError>([&] { tie_points(test::steel_solid(mesh), requests, "box"); });
  };
  CHECK_THAT(refusal({test::point_on("p", "y3")}), Contains("points.p: the mesh has no surface group 'y3'"));
  CHECK_THAT(refusal({test::point_at("p", {3, 0, 0})}),
             Contains("points.p: stands 2 m away from the nearest node of the mesh of 'box'"));
  CHECK_THAT(refusal({test::point_on("p", "y1"), test::point_on("p", "y0")}), Contains("there are two points 'p'"));
  PointRequest far = test::point_on("p", "y1");
  far.position = Eigen::Vector3d(300, 0, 0);
  CHECK_THAT(refusal({far}), Contains("more than a hundred times the body's size"));
}
