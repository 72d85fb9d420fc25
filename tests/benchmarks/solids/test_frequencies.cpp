// Natural frequencies of solids with exact solutions of three-dimensional elasticity, and the order with which
// quadratic tetrahedra approach them.
#include <cmath>

#include <catch2/catch.hpp>

#include "tests/benchmarks/solids/orders.hpp"
#include "tests/support/box_mesh.hpp"
#include "tests/support/reference_table.hpp"
#include "tests/support/solid_model.hpp"

using namespace bielle;
using namespace bielle::reduce;
using bielle::test::orders;

TEST_CASE("A bar that moves along itself: exact frequencies from above with order four") {
  // Fixed at x = 0, free at x = L, no lateral motion: f_k = (2 k - 1) / (4 L) sqrt(C_11 / rho), eigenvalues of order 2
  // p.
  const double length = 1, density = 7800;
  const Material steel = Material::isotropic(210e9, 0.3, density);
  const double speed = std::sqrt(steel.elasticity(0, 0) / density);
  Eigen::MatrixXd errors(4, 3);
  for (int level = 0; level < 4; ++level) {
    const int n = 3 << level;
    const test::SolidModel bar(test::box_mesh({{length, 0.1, 0.1}, {n, 1, 1}}), steel,
                               [](const Eigen::Vector3d& x, int i) { return i != 0 || x.x() < 1e-12; });
    const Eigen::VectorXd found = bar.frequencies(3);
    for (int k = 0; k < 3; ++k) {
      errors(level, k) = found(k) / ((2 * k + 1) / (4 * length) * speed) - 1;
    }
  }
  CHECK(errors.minCoeff() > 0);
  for (int k = 0; k < 3; ++k) {
    INFO(errors.col(k).transpose());
    CHECK(orders(errors.col(k)).tail(2).minCoeff() > 3.8);
    CHECK(orders(errors.col(k)).tail(2).maxCoeff() < 4.4);
  }
}

TEST_CASE("A simply supported thick plate: exact elasticity from above with order four") {
  // 10 x 10 x 1 m, side faces free to move along their normal only: waves of Lamb's type fit exactly between them, and
  // the dispersion relation of the infinite plate at k = pi sqrt(m^2 + n^2) / a gives the frequencies
  // (tests/references/elastic_bodies.py). In-plane shear (0,1): f = sqrt(G / rho) / (2 a).
  const double side = 10;
  const Material material = Material::isotropic(200e9, 0.3, 8000);
  const double shear = std::sqrt(200e9 / 2.6 / 8000) / (2 * side);
  Eigen::VectorXd exact(9);
  const test::ReferenceTable table("elastic_bodies");
  for (int k = 0; k < 9; ++k) exact(k) = table("plate_" + std::to_string(k + 1));
  CHECK(shear == Approx(exact(3)).epsilon(1e-12));
  Eigen::MatrixXd errors(3, exact.size());
  for (int level = 0; level < 3; ++level) {
    const int n = 4 << level;
    const test::SolidModel plate(test::box_mesh({{side, side, 1}, {n, n, 1 << level}}), material,
                                 [&](const Eigen::Vector3d& x, int i) {
                                   const bool on_x = x.x() < 1e-9 || x.x() > side - 1e-9;
                                   const bool on_y = x.y() < 1e-9 || x.y() > side - 1e-9;
                                   return (on_x && i != 0) || (on_y && i != 1);
                                 });
    errors.row(level) = plate.frequencies(static_cast<int>(exact.size())).cwiseQuotient(exact).transpose().array() - 1;
  }
  INFO(errors);
  CHECK(errors.minCoeff() > 0);
  for (Eigen::Index k = 0; k < exact.size(); ++k) {
    CHECK(orders(errors.col(k))(1) > 3.5);
  }
}

TEST_CASE("Torsion of a thick tube, its walls curved: exact for any wall, with order four") {
  // Fixed-free: f_k = (2 k - 1) / (4 L) sqrt(G / rho). A quarter with antisymmetric sides, whose lowest modes are those
  // of torsion; cells follow the circle by parabolas.
  const double length = 1, inner = 0.05, outer = 0.1;
  const Material steel = Material::isotropic(210e9, 0.3, 7800);
  Eigen::MatrixXd errors(3, 2);
  for (int level = 0; level < 3; ++level) {
    const int n = 1 << level;
    const Mesh mesh = test::box_mesh({{length, 1, 1}, {4 * n, n, 2 * n}}, [&](const Eigen::Vector3d& x) {
      const double radius = inner + (outer - inner) * x.y(), angle = std::acos(0.0) * x.z();
      return Eigen::Vector3d(x.x(), radius * std::cos(angle), radius * std::sin(angle));
    });
    const test::SolidModel tube(mesh, steel, [](const Eigen::Vector3d& x, int i) {
      return x.x() < 1e-9 || (x.z() < 1e-9 && i != 2) || (x.y() < 1e-9 && i != 1);
    });
    const Eigen::VectorXd found = tube.frequencies(2);
    for (int k = 0; k < 2; ++k) {
      errors(level, k) = std::abs(found(k) / ((2 * k + 1) / (4 * length) * std::sqrt(210e9 / 2.6 / 7800)) - 1);
    }
  }
  INFO(errors);
  for (int k = 0; k < 2; ++k) {
    CHECK(orders(errors.col(k))(1) > 3.5);
  }
}
