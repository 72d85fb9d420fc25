#include <cmath>

#include <Eigen/LU>
#include <catch2/catch.hpp>

#include "reduce/fe/mesh_error.hpp"
#include "reduce/mesh/quadrature.hpp"
#include "reduce/mesh/shape_functions.hpp"
#include "tests/support/box_mesh.hpp"
#include "tests/support/solid_model.hpp"
#include "tests/unit/reduce/fe/field.hpp"

using namespace bielle;
using namespace bielle::reduce;
using bielle::test::field;

namespace {

constexpr double young = 2e5, nu = 0.3;
const Material material = Material::isotropic(young, nu, 1);

/// Saint-Venant's bending about z with unit curvature, whose only stress is sigma_xx = -E y.
Eigen::Vector3d bending(const Eigen::Vector3d& x) {
  return {-x.x() * x.y(), (x.x() * x.x() + nu * (x.y() * x.y() - x.z() * x.z())) / 2, nu * x.y() * x.z()};
}

}  // namespace

TEST_CASE("Fields that the cells represent have no mesh error, on a distorted mesh as well") {
  const Mesh quadratic = test::distorted_box_mesh({{1, 1, 1}, {3, 3, 3}}, 0.25);
  const Mesh linear = test::distorted_box_mesh({{1, 1, 1}, {3, 3, 3}, false}, 0.25);
  const auto stretch = [](const Eigen::Vector3d& x) { return Eigen::Vector3d(x.x() + 2 * x.y(), -x.z(), 3 * x.x()); };
  const auto error = [](const Mesh& mesh, const RowMatrix& u) {
    return estimate_mesh_error(make_solid(mesh, {{"m", material}}, {{"all", "m"}}), u, 2).relative(0);
  };
  // The square of the error is a sum of roundings of 1e-16; terms that a regular mesh does not determine are stabilised
  // by 1e-9.
  CHECK(error(quadratic, field(quadratic, bending)) < 1e-6);
  CHECK(error(linear, field(linear, stretch)) < 1e-6);
  CHECK(error(linear, field(linear, bending)) > 0.1);  // these cells have constant strain
  CHECK(
      estimate_mesh_error(make_solid(linear, {{"m", material}}, {{"all", "m"}}), RowMatrix(3 * linear.point_count(), 0))
          .relative.size() == 0);
  CHECK(error(linear, field(linear, [](const Eigen::Vector3d&) { return Eigen::Vector3d(0, 0, 0); })) == 0);
}

TEST_CASE("A jump of stress between two materials is not a mesh error") {
  Mesh mesh = test::box_mesh({{4, 1, 1}, {4, 2, 2}});
  Group stiff{3, {{CellType::tet10, {}}}, {}};
  for (Eigen::Index e = 0; e < mesh.blocks[0].nodes.cols(); ++e)
    if (mesh.points(0, mesh.blocks[0].nodes.col(e)).minCoeff() > 1.9)
      stiff.parts[0].cells.push_back(static_cast<int>(e));
  mesh.groups["stiff"] = stiff;
  const Solid solid = make_solid(mesh, {{"a", Material::isotropic(1, 0, 1)}, {"b", Material::isotropic(10, 0, 1)}},
                                 {{"all", "a"}, {"stiff", "b"}});
  // sigma_yy jumps, since both materials have the same strain.
  const RowMatrix u = field(mesh, [](const Eigen::Vector3d& x) { return Eigen::Vector3d(0, x.y(), 0); });
  CHECK(estimate_mesh_error(solid, u).relative(0) < 1e-6);
}

TEST_CASE("The estimate for a bent cantilever is within a factor of 1.5 of the true error, 2 with few tet4") {
  // The field is Saint-Venant's flexure by a shear force at the tip. Displacements are prescribed on the whole
  // boundary, so that there is no singularity at a clamp. Without lateral contraction sigma = E strain: sigma_xx = E (L
  // - x) y, sigma_xy = E (y^2 - h^2/4) / 2.
  constexpr double length = 2, height = 1, width = 0.5;
  const auto exact = [&](const Eigen::Vector3d& x) {
    const double X = x.x(), Y = x.y() - height / 2;
    return Eigen::Vector3d((length * X - X * X / 2) * Y + Y * Y * Y / 3 - height * height * Y / 4,
                           -(length * X * X / 2 - X * X * X / 6), 0);
  };
  const auto exact_strain = [&](const Eigen::Vector3d& x) {
    const double Y = x.y() - height / 2;
    Eigen::Matrix3d strain = Eigen::Matrix3d::Zero();
    strain(0, 0) = (length - x.x()) * Y;
    strain(0, 1) = strain(1, 0) = (Y * Y - height * height / 4) / 2;
    return strain;
  };
  const auto fixed = [&](const Eigen::Vector3d& x, int) {
    return x.x() < 1e-9 || x.x() > length - 1e-9 || x.y() < 1e-9 || x.y() > height - 1e-9 || x.z() < 1e-9 ||
           x.z() > width - 1e-9;
  };
  const bool quadratic = GENERATE(true, false);
  const int n = GENERATE(2, 4);
  const test::SolidModel model(test::box_mesh({{length, height, width}, {2 * n, n, n}, quadratic}),
                               Material::isotropic(young, 0, 1), fixed);
  const auto& [type, cells] = model.mesh.blocks.front();
  RowMatrix u = field(model.mesh, exact);
  for (Eigen::Index a = 0; a < model.mesh.point_count(); ++a)
    if (!fixed(model.mesh.points.col(a), 0)) u.middleRows<3>(3 * a).setZero();
  u -= model.solve(model.stiffness.multiply(u));

  double error = 0, all = 0;  // squares of strains
  const Quadrature rule = simplex_quadrature(3, 6);
  for (Eigen::Index e = 0; e < cells.cols(); ++e)
    for (Eigen::Index p = 0; p < rule.weights.size(); ++p) {
      Eigen::Matrix3Xd x(3, cells.rows()), v(3, cells.rows());
      for (Eigen::Index a = 0; a < cells.rows(); ++a) {
        x.col(a) = model.mesh.points.col(cells(a, e));
        v.col(a) = u.block<3, 1>(3 * cells(a, e), 0);
      }
      const Eigen::MatrixXd local = shape_gradients(type, rule.points.col(p));
      const Eigen::Matrix3d jacobian = x * local, gradient = v * local * jacobian.inverse();
      const Eigen::Matrix3d strain = exact_strain(x * shape_values(type, rule.points.col(p)));
      const double weight = rule.weights(p) * jacobian.determinant();
      error += weight * ((gradient + gradient.transpose()) / 2 - strain).squaredNorm();
      all += weight * strain.squaredNorm();
    }
  const double truth = std::sqrt(error / all), estimate = estimate_mesh_error(model.solid, u, 2).relative(0);
  INFO(cell_name(type) << ", n = " << n << ": true " << truth << ", estimated " << estimate);
  CHECK(estimate > truth / (quadratic || n > 2 ? 1.5 : 2));
  CHECK(estimate < truth * 1.5);
}
