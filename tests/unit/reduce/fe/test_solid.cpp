#include <algorithm>

#include <catch2/catch.hpp>

#include "reduce/common/error.hpp"
#include "reduce/fe/assembly.hpp"
#include "reduce/fe/solid.hpp"
#include "reduce/fe/surface.hpp"
#include "tests/support/box_mesh.hpp"
#include "tests/support/cell_box.hpp"

using namespace bielle;
using namespace bielle::reduce;
using Catch::Contains;

namespace {

const std::map<std::string, Material> metals{{"steel", Material::isotropic(210e9, 0.3, 7800)},
                                             {"copper", Material::isotropic(120e9, 0.34, 8900)}};

/// Returns a box whose left half is the group "left".
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

TEST_CASE("Regions give cells their material; 'all' stands for the remaining cells") {
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

TEST_CASE("Mass, centre and inertia of a box equal the closed form") {
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
  // The map y -> y + 0.3 x^2 + 0.1 x z preserves volumes; second moments follow by integration over the unit cube.
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

TEST_CASE("Points that no cell uses are recognised") {
  Mesh mesh = test::box_mesh({{1, 1, 1}, {1, 1, 1}});
  mesh.points.conservativeResize(Eigen::NoChange, mesh.points.cols() + 1);
  mesh.points.rightCols<1>().setConstant(7);
  const std::vector<bool> inside = points_of_solid(make_solid(mesh, metals, {{"all", "steel"}}));
  CHECK(std::count(inside.begin(), inside.end(), true) == mesh.point_count() - 1);
  CHECK_FALSE(inside.back());
}

TEST_CASE("A coated box has the mass, centre and inertia of a box and its plates") {
  const Eigen::Vector3d size(0.7, 0.3, 0.2);
  const CellType type = GENERATE(CellType::tet4, CellType::hex20, CellType::wedge15, CellType::pyramid13);
  const Mesh mesh = test::cell_box(type, size, {3, 2, 2}, test::distortion(size, 0.1));
  Solid solid = make_solid(mesh, metals, {{"all", "steel"}});
  const double per_area = 40, steel = 7800 * size.prod(), plate = per_area * size.y() * size.z(),
               top = per_area * size.x() * size.y();
  solid.coatings = {{surface_group(mesh, "x1"), per_area}, {surface_group(mesh, "z0"), per_area}};
  const MassProperties body = mass_properties(solid);
  CHECK(body.mass == Approx(steel + plate + top).epsilon(1e-12));
  CHECK(body.volume == Approx(size.prod()).epsilon(1e-12));
  const Eigen::Vector3d centre = (steel * size / 2 + plate * Eigen::Vector3d(size.x(), size.y() / 2, size.z() / 2) +
                                  top * Eigen::Vector3d(size.x() / 2, size.y() / 2, 0)) /
                                 body.mass;
  CHECK((body.centre - centre).norm() < 1e-13);
  // The inertia about y is the sum over the parts, each about its own centre, plus Steiner's terms.
  const double about_y =
      steel / 12 * (size.x() * size.x() + size.z() * size.z()) + plate / 12 * size.z() * size.z() +
      top / 12 * size.x() * size.x() +
      steel * (Eigen::Vector2d(size.x(), size.z()) / 2 - Eigen::Vector2d(centre.x(), centre.z())).squaredNorm() +
      plate * (Eigen::Vector2d(size.x(), size.z() / 2) - Eigen::Vector2d(centre.x(), centre.z())).squaredNorm() +
      top * (Eigen::Vector2d(size.x() / 2, 0) - Eigen::Vector2d(centre.x(), centre.z())).squaredNorm();
  CHECK(body.inertia(1, 1) == Approx(about_y).epsilon(1e-12));
}

TEST_CASE("A lumped solid has a diagonal mass matrix, positive, with the mass of the solid and its coatings") {
  const Eigen::Vector3d size(0.7, 0.3, 0.2);
  const CellType type = GENERATE(CellType::tet4, CellType::tet10, CellType::hex8, CellType::hex20, CellType::hex27,
                                 CellType::wedge6, CellType::wedge15, CellType::pyramid5, CellType::pyramid13);
  const Mesh mesh = test::cell_box(type, size, {2, 2, 1}, test::distortion(size, 0.1));
  Solid solid = make_solid(mesh, metals, {{"all", "steel"}});
  solid.coatings = {{surface_group(mesh, "y1"), 100}};
  solid.lumped = true;
  const NodeGraph graph = node_graph(mesh);
  const NodeMatrix m = assemble_mass(solid, graph);
  const RowMatrix ones = RowMatrix::Ones(solid.points(), 1), products = m.multiply(ones, 1);
  double total = 0;
  for (int a = 0; a < solid.points(); ++a) {
    RowMatrix unit = RowMatrix::Zero(solid.points(), 1);
    unit(a, 0) = 1;
    const RowMatrix column = m.multiply(unit, 1);
    CHECK(column(a, 0) > 0);
    CHECK(column(a, 0) == products(a, 0));
    CHECK(column.cwiseAbs().sum() == column(a, 0));
    total += column(a, 0);
  }
  const MassProperties body = mass_properties(solid);
  CHECK(total == Approx(7800 * size.prod() + 100 * size.x() * size.z()).epsilon(1e-12));
  CHECK(body.mass == Approx(total).epsilon(1e-13));
  CHECK((body.centre - mesh.points * products / total).norm() < 1e-13);
}
