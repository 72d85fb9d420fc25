#include <algorithm>

#include <catch2/catch.hpp>

#include "reduce/common/error.hpp"
#include "reduce/fe/solid.hpp"
#include "tests/support/box_mesh.hpp"

using namespace bielle;
using namespace bielle::reduce;
using Catch::Contains;

namespace {

const std::map<std::string, Material> metals{{"steel", Material::isotropic(210e9, 0.3, 7800)},
                                             {"copper", Material::isotropic(120e9, 0.34, 8900)}};

/// A box whose left half is the group "left".
Mesh two_halves() {
  Mesh mesh = test::box_mesh({{2, 1, 1}, {2, 1, 1}});
  Group left{3, {{CellType::tet10, {}}}, {}};
  for (Eigen::Index e = 0; e < mesh.blocks[0].nodes.cols(); ++e) {
    if (mesh.points(0, mesh.blocks[0].nodes.col(e)).maxCoeff() < 1.5) {
      left.parts[0].cells.push_back(static_cast<int>(e));
    }
  }
  mesh.groups["left"] = left;
  return mesh;
}

}  // namespace

TEST_CASE("Regions give cells their material, 'all' the rest") {
  const Mesh mesh = two_halves();
  const Solid solid = make_solid(mesh, metals, {{"left", "copper"}, {"all", "steel"}});
  const MassProperties body = mass_properties(solid);
  CHECK(body.mass == Approx(8900 + 7800).epsilon(1e-14));
  CHECK(body.volume == Approx(2).epsilon(1e-14));
  CHECK(body.centre.x() == Approx((8900 * 0.5 + 7800 * 1.5) / (8900 + 7800)).epsilon(1e-14));
  CHECK(body.centre.y() == Approx(0.5).epsilon(1e-14));
}

TEST_CASE("Wrong regions are refused with the nearest name") {
  const Mesh mesh = two_halves();
  CHECK_THROWS_WITH(make_solid(mesh, metals, {{"left", "steel"}}), Contains("6 of 12 cells have no material"));
  CHECK_THROWS_WITH(make_solid(mesh, metals, {{"letf", "steel"}}),
                    Contains("no volume group 'letf'; did you mean 'left'?"));
  CHECK_THROWS_WITH(make_solid(mesh, metals, {{"x0", "steel"}}), Contains("no volume group 'x0'"));
  CHECK_THROWS_WITH(make_solid(mesh, metals, {{"all", "stell"}}),
                    Contains("no material 'stell'; did you mean 'steel'?"));
  CHECK_THROWS_WITH(make_solid(mesh, metals, {{"left", "steel"}, {"solid", "copper"}}),
                    Contains("regions.solid: its cells belong to region 'left' too"));
  CHECK_THROWS_AS(make_solid(Mesh{}, metals, {{"all", "steel"}}), InputError);
}

TEST_CASE("Mass, centre and inertia of a box are those of the closed form") {
  const double a = 0.7, b = 0.3, c = 0.2;
  const Mesh mesh = test::distorted_box_mesh({{a, b, c}, {4, 3, 2}}, 0.2);
  const MassProperties body = mass_properties(make_solid(mesh, metals, {{"all", "steel"}}));
  const double mass = 7800 * a * b * c;
  CHECK(body.mass == Approx(mass).epsilon(1e-13));
  CHECK((body.centre - Eigen::Vector3d(a, b, c) / 2).norm() < 1e-14);
  const Eigen::Vector3d inertia = mass / 12 * Eigen::Vector3d(b * b + c * c, a * a + c * c, a * a + b * b);
  CHECK((body.inertia - Eigen::Matrix3d(inertia.asDiagonal())).norm() < 1e-13 * inertia.norm());
}

TEST_CASE("Curved cells have the mass properties of the curved body") {
  // y -> y + 0.3 x^2 + 0.1 x z keeps volumes; its second moments follow by integration over the unit cube.
  const Mesh mesh = test::box_mesh({{1, 1, 1}, {2, 2, 2}}, [](const Eigen::Vector3d& x) {
    return Eigen::Vector3d(x.x(), x.y() + 0.3 * x.x() * x.x() + 0.1 * x.x() * x.z(), x.z());
  });
  const MassProperties body =
      mass_properties(make_solid(mesh, {{"unit", Material::isotropic(1, 0, 1)}}, {{"all", "unit"}}));
  CHECK(body.mass == Approx(1).epsilon(1e-14));
  const double mean_y = 0.5 + 0.3 / 3 + 0.1 / 4;
  CHECK((body.centre - Eigen::Vector3d(0.5, mean_y, 0.5)).norm() < 1e-14);
  // int (y + 0.3 x^2 + 0.1 x z)^2 = 1/3 + 0.09/5 + 0.01/9 + 0.3/3 + 0.1/4 + 0.06/8
  const double yy = 1.0 / 3 + 0.09 / 5 + 0.01 / 9 + 0.3 / 3 + 0.1 / 4 + 0.06 / 8 - mean_y * mean_y;
  CHECK(body.inertia(0, 0) == Approx(yy + 1.0 / 12).epsilon(1e-13));
  CHECK(body.inertia(2, 2) == Approx(yy + 1.0 / 12).epsilon(1e-13));
  // int x y = 1/4 + 0.3/4 + 0.1/6 less the product of the means
  CHECK(body.inertia(0, 1) == Approx(-(0.25 + 0.075 + 0.1 / 6 - 0.5 * mean_y)).epsilon(1e-13));
}

TEST_CASE("Points that no cell uses are told apart") {
  Mesh mesh = test::box_mesh({{1, 1, 1}, {1, 1, 1}});
  mesh.points.conservativeResize(Eigen::NoChange, mesh.points.cols() + 1);
  mesh.points.rightCols<1>().setConstant(7);
  const std::vector<bool> inside = points_of_solid(make_solid(mesh, metals, {{"all", "steel"}}));
  CHECK(std::count(inside.begin(), inside.end(), true) == mesh.point_count() - 1);
  CHECK_FALSE(inside.back());
}
