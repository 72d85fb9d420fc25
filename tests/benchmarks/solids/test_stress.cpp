// Lame's thick cylinder: displacements and recovered stresses on curved quadratic cells.
#include <cmath>

#include <catch2/catch.hpp>

#include "reduce/fe/stress.hpp"
#include "reduce/fe/surface.hpp"
#include "tests/support/box_mesh.hpp"
#include "tests/support/solid_model.hpp"

using namespace bielle;
using namespace bielle::reduce;

TEST_CASE("A thick cylinder under internal pressure: Lame's displacements and stresses") {
  // a = 0.1 m, b = 0.2 m, p = 100 MPa, plane strain, E = 210 GPa, nu = 0.3. With A = p a^2 / (b^2 - a^2):
  // sigma_theta = A (1 + b^2 / r^2), sigma_r = A (1 - b^2 / r^2), u = (1 + nu) / E A ((1 - 2 nu) r + b^2 / r).
  const double a = 0.1, b = 0.2, pressure = 100e6, young = 210e9, nu = 0.3;
  const double lame = pressure * a * a / (b * b - a * a);
  Eigen::MatrixXd errors(3, 3);  // u(a), u(b), hoop stress at a
  for (int level = 0; level < 3; ++level) {
    const int n = 2 << level;
    const Mesh mesh = test::box_mesh({{1, 1, 1}, {n, n, 1}}, [&](const Eigen::Vector3d& x) {
      const double radius = a + (b - a) * x.x(), angle = std::acos(0.0) * x.y();
      return Eigen::Vector3d(radius * std::cos(angle), radius * std::sin(angle), 0.05 * x.z() / n);
    });
    const test::SolidModel model(mesh, Material::isotropic(young, nu, 7800), [](const Eigen::Vector3d& x, int i) {
      return i == 2 || (i == 0 && x.x() < 1e-9) || (i == 1 && x.y() < 1e-9);
    });
    const SurfaceIntegrals bore = integrate_surface(mesh, "x0");
    const Eigen::Matrix3Xd forces = pressure_forces(bore, pressure);
    RowMatrix load = RowMatrix::Zero(3 * mesh.point_count(), 1);
    for (std::size_t k = 0; k < bore.nodes.size(); ++k) {
      load.middleRows<3>(3 * bore.nodes[k]) = forces.col(static_cast<Eigen::Index>(k));
    }
    const RowMatrix u = model.solve(load);
    const RowMatrix stress = nodal_stress(model.solid, u, bore.nodes);
    errors.row(level).setZero();
    for (Eigen::Index p = 0; p < mesh.point_count(); ++p) {
      const Eigen::Vector3d x = mesh.points.col(p);
      const double r = std::hypot(x.x(), x.y());
      for (const auto& [radius, column] : {std::pair{a, 0}, {b, 1}}) {
        if (std::abs(r - radius) < 1e-9) {
          const double exact = (1 + nu) / young * lame * ((1 - 2 * nu) * r + b * b / r);
          const double radial = (u(3 * p) * x.x() + u(3 * p + 1) * x.y()) / r;
          errors(level, column) = std::max(errors(level, column), std::abs(radial / exact - 1));
        }
      }
    }
    const double exact_hoop = lame * (1 + b * b / (a * a));
    for (std::size_t k = 0; k < bore.nodes.size(); ++k) {
      const Eigen::Vector3d t = Eigen::Vector3d(-mesh.points(1, bore.nodes[k]), mesh.points(0, bore.nodes[k]), 0) / a;
      const auto s = stress.middleRows<6>(6 * static_cast<Eigen::Index>(k)).col(0);
      const double hoop = t.x() * t.x() * s(0) + t.y() * t.y() * s(1) + 2 * t.x() * t.y() * s(5);
      errors(level, 2) = std::max(errors(level, 2), std::abs(hoop / exact_hoop - 1));
    }
  }
  INFO(errors);
  CHECK(errors.row(2).head(2).maxCoeff() < 2e-4);
  CHECK(errors(2, 2) < 2e-2);
  // Displacements of order three, stresses at the nodes of order two.
  CHECK(std::log2(errors(1, 0) / errors(2, 0)) > 2.5);
  CHECK(std::log2(errors(1, 2) / errors(2, 2)) > 1.5);
}
