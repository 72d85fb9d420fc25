// NAFEMS LE11: a solid of revolution, cylinder, taper and sphere, under a linear temperature.
//
// NAFEMS, The Standard NAFEMS Benchmarks (1990), LE11: in the plane of r and z [m] the inner side runs round the origin
// at a radius of 1 from A = (1, 0) to 45 degrees and then along the axis to z = 1.79, the outer side at a radius of 1.4
// to 30 degrees, then straight to (1, 1.39), and along the axis to z = 1.79. E = 210 GPa, nu = 0.3, thermal expansion
// 2.3e-4 per degree, temperature r + z; both ends are held along z. Target: sigma_zz = -105 MPa at A. Bielle has no
// temperatures: the forces of an expansion that is held back everywhere stand for them, and its stress is added.
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include <Eigen/LU>
#include <catch2/catch.hpp>

#include "reduce/fe/stress.hpp"
#include "reduce/mesh/quadrature.hpp"
#include "reduce/mesh/shape_functions.hpp"
#include "tests/support/cell_box.hpp"
#include "tests/support/solid_model.hpp"

using namespace bielle;
using namespace bielle::reduce;

namespace test_tapered_cylinder {
namespace {

constexpr double young = 210e9, poisson = 0.3, expansion = 2.3e-4, height = 1.79, radius = 1, outer_radius = 1.4;
constexpr double target = -105e6;  // sigma_zz at A [Pa]

/// Returns a point (r, z) between the sides. @param across  0 inside, 1 outside @param along  0..4, one for each part
Eigen::Vector2d section_point(double across, double along) {
  const double right_angle = std::numbers::pi / 2, foot = radius / std::sqrt(2.0);
  const auto arc = [](double r, double angle) { return Eigen::Vector2d(r * std::cos(angle), r * std::sin(angle)); };
  const auto between = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b, double t) {
    return Eigen::Vector2d((1 - t) * a + t * b);
  };
  const Eigen::Vector2d inside =
      along < 2 ? arc(radius, along * right_angle / 4) : between({foot, foot}, {foot, height}, (along - 2) / 2);
  const Eigen::Vector2d taper = arc(outer_radius, right_angle / 3), cylinder(1, 1.39);
  const Eigen::Vector2d outside = along < 1   ? arc(outer_radius, along * right_angle / 3)
                                  : along < 3 ? between(taper, cylinder, (along - 1) / 2)
                                              : between(cylinder, {1, height}, along - 3);
  return between(inside, outside, across);
}

/// Returns the nodal forces of a stress beta T in all directions: int beta T dN_a/dx_i dV.
RowMatrix thermal_forces(const Mesh& mesh, double beta, const std::function<double(const Eigen::Vector3d&)>& T) {
  RowMatrix forces = RowMatrix::Zero(3 * mesh.point_count(), 1);
  for (const auto& block : mesh.blocks) {
    if (dimension(block.type) != 3) continue;
    const Quadrature rule = cell_quadrature(block.type, 5);
    for (Eigen::Index e = 0; e < block.nodes.cols(); ++e) {
      const Eigen::Matrix3Xd x = mesh.points(Eigen::all, block.nodes.col(e));
      for (Eigen::Index p = 0; p < rule.weights.size(); ++p) {
        const Eigen::MatrixXd local = shape_gradients(block.type, rule.points.col(p));
        const Eigen::Matrix3d jacobian = x * local;
        const Eigen::MatrixXd gradients = local * jacobian.inverse();
        const double stress = beta * T(x * shape_values(block.type, rule.points.col(p)));
        const double volume = rule.weights(p) * jacobian.determinant();
        for (Eigen::Index a = 0; a < x.cols(); ++a)
          forces.middleRows<3>(3 * block.nodes(a, e)) += stress * volume * gradients.row(a).transpose();
      }
    }
  }
  return forces;
}

/// Returns sigma_zz at A [Pa]. @param bricks  numbers of bricks across, along and round the quarter
double stress_at_A(CellType type, const std::array<int, 3>& bricks) {
  const Mesh mesh = test::cell_box(type, {1, 4, 1}, bricks, {}, [](const Eigen::Vector3d& x) -> Eigen::Vector3d {
    const Eigen::Vector2d rz = section_point(x.x(), x.y());
    const double angle = std::numbers::pi / 2 * x.z();
    return {rz.x() * std::cos(angle), -rz.x() * std::sin(angle), rz.y()};
  });
  const test::SolidModel model(mesh, Material::isotropic(young, poisson, 1), [](const Eigen::Vector3d& x, int i) {
    return i == 2 ? x.z() < 1e-9 || x.z() > height - 1e-9 : std::abs(x(i)) < 1e-9;
  });
  const double beta = young * expansion / (1 - 2 * poisson);
  const auto temperature = [](const Eigen::Vector3d& x) { return std::hypot(x.x(), x.y()) + x.z(); };
  const RowMatrix u = model.solve(thermal_forces(mesh, beta, temperature));
  int A = 0;
  for (int p = 0; p < mesh.point_count(); ++p)
    if ((mesh.points.col(p) - Eigen::Vector3d(radius, 0, 0)).norm() < 1e-9) A = p;
  REQUIRE((mesh.points.col(A) - Eigen::Vector3d(radius, 0, 0)).norm() < 1e-9);
  return nodal_stress(model.solid, u, {A})(2, 0) - beta * temperature(mesh.points.col(A));
}

}  // namespace

TEST_CASE("Cylinder, taper and sphere under a temperature (NAFEMS LE11): the stress at A approaches the target") {
  const CellType type = GENERATE(CellType::hex20, CellType::hex27, CellType::wedge15, CellType::tet10);
  CAPTURE(cell_name(type));
  const double coarse = stress_at_A(type, {2, 16, 3}), fine = stress_at_A(type, {4, 32, 3});
  CAPTURE(coarse / target, fine / target);
  CHECK(std::abs(fine - target) < 0.5 * std::abs(coarse - target));
  CHECK(fine == Approx(target).epsilon(0.035));
  if (type == CellType::hex20) CHECK(stress_at_A(type, {8, 64, 3}) == Approx(target).epsilon(0.01));
}

}  // namespace test_tapered_cylinder
