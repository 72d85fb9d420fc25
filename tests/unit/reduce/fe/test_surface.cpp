#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "reduce/common/error.hpp"
#include "reduce/fe/surface.hpp"
#include "tests/support/box_mesh.hpp"

using namespace bielle;
using namespace bielle::reduce;

namespace {

Eigen::Vector3d moment(const Mesh& mesh, const SurfaceIntegrals& surface, const Eigen::Matrix3Xd& forces) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < surface.nodes.size(); ++k) {
    sum += mesh.points.col(surface.nodes[k]).cross(forces.col(k));
  }
  return sum;
}

}  // namespace

TEST_CASE("Area, centroid and moments of a side of a box are those of a rectangle") {
  const bool quadratic = GENERATE(true, false);
  const Mesh mesh = test::box_mesh({{2, 3, 0.5}, {2, 3, 2}, quadratic});
  const SurfaceIntegrals side = integrate_surface(mesh, "z1");
  CHECK(side.nodes == mesh.groups.at("z1").nodes);
  CHECK(side.area == Approx(6).epsilon(1e-14));
  CHECK((side.centroid - Eigen::Vector3d(1, 1.5, 0.5)).norm() < 1e-14);
  const Eigen::Vector3d second(6 * 4 / 12.0, 6 * 9 / 12.0, 0);
  CHECK((side.second_moment - Eigen::Matrix3d(second.asDiagonal())).norm() < 1e-13);
  CHECK(side.weights.sum() == Approx(6).epsilon(1e-14));
  CHECK(side.first_moments.rowwise().sum().norm() < 1e-13);  // sums of moments of order area x length = 18
  CHECK((side.normals.rowwise().sum() - Eigen::Vector3d(0, 0, 6)).norm() < 1e-14);
}

TEST_CASE("A pressure on a bulged face has the resultant of its plane outline, and the moment of the enclosed volume") {
  // Side x = 1 bulges by 0.3 y (1 - y) z (1 - z), which changes neither its edge nor the resultant. The map is
  // quadratic along edges in y and z only, so that faces are parabolic and the closed surface is that of the mesh.
  const Mesh mesh = test::box_mesh({{1, 1, 1}, {1, 3, 3}}, [](const Eigen::Vector3d& x) {
    return Eigen::Vector3d(x.x() * (1 + 0.3 * x.y() * (1 - x.y()) * x.z() * (1 - x.z())), x.y(), x.z());
  });
  const SurfaceIntegrals bulge = integrate_surface(mesh, "x1");
  CHECK(bulge.area > 1);
  const Eigen::Matrix3Xd forces = pressure_forces(bulge, 2e5);
  CHECK((forces.rowwise().sum() - Eigen::Vector3d(-2e5, 0, 0)).norm() < 1e-9);
  // int x x n dA (a vector product) over a closed surface is zero: the moments of the five plane sides and of the bulge
  // balance.
  Eigen::Vector3d all = moment(mesh, bulge, forces);
  for (const char* side : {"x0", "y0", "y1", "z0", "z1"}) {
    const SurfaceIntegrals plane = integrate_surface(mesh, side);
    all += moment(mesh, plane, pressure_forces(plane, 2e5));
  }
  CHECK(all.norm() < 1e-9);
}

TEST_CASE("Tractions and distributed forces have the requested resultants") {
  const Mesh mesh = test::box_mesh({{1, 2, 1}, {2, 2, 2}});
  const SurfaceIntegrals side = integrate_surface(mesh, "x1");
  const Eigen::Vector3d traction(3, -2, 5);
  const Eigen::Matrix3Xd forces = traction_forces(side, traction);
  CHECK((forces.rowwise().sum() - 2 * traction).norm() < 1e-13);
  CHECK((moment(mesh, side, forces) - side.centroid.cross(2 * traction)).norm() < 1e-13);
  CHECK((spread_force(side, traction).rowwise().sum() - traction).norm() < 1e-14);
}

TEST_CASE("The message about a missing surface names the nearest one") {
  const Mesh mesh = test::box_mesh({{1, 1, 1}, {1, 1, 1}});
  CHECK_THROWS_WITH(integrate_surface(mesh, "x2"), Catch::Contains("no surface group 'x2'"));
  CHECK_THROWS_AS(integrate_surface(mesh, "solid"), InputError);
}
