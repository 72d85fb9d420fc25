// Longitudinal frequencies of a reduced bar: fixed-boundary modes and the free reduced body against closed forms.
//
// Without lateral contraction u_x(x) alone solves the equations of elasticity, held ends included: with
// c = sqrt(E / rho), a bar held at both ends has k c / (2 L), at one end (2 k - 1) c / (4 L), the free bar k c / (2 L)
// again. The free bar reduced to its two ends and n fixed-boundary modes follows from the rod's own reduction with
// shapes 1 - s, s, sqrt(2) sin(k pi s).
#include <cmath>
#include <numbers>

#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>

#include "reduce/dense/symmetric_eigenpairs.hpp"
#include "reduce/reduction/reduce_body.hpp"
#include "reduce/reduction/reduced_matrices.hpp"
#include "reduce/reduction/rigid_motions.hpp"
#include "tests/benchmarks/solids/orders.hpp"
#include "tests/support/box_mesh.hpp"

using namespace bielle;
using namespace bielle::reduce;
using bielle::test::orders;

namespace test_reduced_bar {
namespace {

constexpr double length = 1, young = 210e9, density = 7800;
const double speed = std::sqrt(young / density);

/// Returns a stout bar, 1 m x 0.2 m x 0.2 m with n bricks along it, held at the named ends.
Superelement bar(int n, const std::vector<std::string>& ends) {
  ReductionOptions options;
  options.name = "bar";
  options.materials = {{"m", Material::isotropic(young, 0, density)}};
  options.regions = {{"all", "m"}};
  for (const std::string& end : ends) {
    options.interfaces.emplace_back();
    options.interfaces.back().name = options.interfaces.back().group = end;
  }
  options.modes.count = 24;
  options.stress_recovery = RecoveryExtent::none;
  Progress quiet(true);
  return reduce_body(test::box_mesh({{length, 0.2, 0.2}, {n, 1, 1}}), options, quiet, 2);
}

/// Frequencies [Hz] of the modes (columns, unit modal mass) whose mass lies along x.
Eigen::VectorXd longitudinal(const Superelement& body, const Eigen::MatrixXd& modes, const Eigen::VectorXd& hertz) {
  std::vector<Eigen::Index> found;
  for (Eigen::Index k = 0; k < modes.cols(); ++k) {
    if (modes.col(k).dot(body.inertia_components[0] * modes.col(k)) > 0.9) {
      found.push_back(k);
    }
  }
  return hertz(found);
}

Eigen::VectorXd fixed_boundary(const Superelement& body) {
  return longitudinal(body, Eigen::MatrixXd::Identity(body.size(), body.size()).rightCols(body.modes()),
                      body.frequencies);
}

Eigen::VectorXd free_free(const Superelement& body) {
  Eigen::MatrixXd rigid = Eigen::MatrixXd::Zero(body.size(), 6);
  rigid.topRows(body.interface_directions()) = interface_rigid_motions(body.interfaces, body.centre);
  const FreeModes modes = free_modes(body.stiffness, body.mass, rigid);
  return longitudinal(body, modes.vectors, modes.omega / (2 * std::numbers::pi));
}

/// Returns the free rod with its two ends and n exact fixed-boundary modes.
Eigen::VectorXd reduced_rod(int n, int count) {
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(n + 2, n + 2), m = Eigen::MatrixXd::Identity(n + 2, n + 2);
  k.topLeftCorner<2, 2>() << 1, -1, -1, 1;
  m.topLeftCorner<2, 2>() << 1. / 3, 1. / 6, 1. / 6, 1. / 3;
  for (int j = 1; j <= n; ++j) {
    const double wave = j * std::numbers::pi;
    k(j + 1, j + 1) = wave * wave;
    m(0, j + 1) = m(j + 1, 0) = std::sqrt(2.0) / wave;
    m(1, j + 1) = m(j + 1, 1) = (j % 2 ? 1 : -1) * std::sqrt(2.0) / wave;
  }
  const bielle::SymmetricEigenpairs eigen = bielle::symmetric_eigenpairs(k, m).value();
  return eigen.values.segment(1, count).cwiseSqrt() * speed / (2 * std::numbers::pi * length);
}

}  // namespace

TEST_CASE("Fixed-boundary frequencies of a bar, held at both ends and at one: from above with order four") {
  Eigen::MatrixXd errors(4, 4);  // two of each
  for (int level = 0; level < 4; ++level) {
    const int n = 3 << level;
    const Eigen::VectorXd both = fixed_boundary(bar(n, {"x0", "x1"})), one = fixed_boundary(bar(n, {"x0"}));
    REQUIRE(std::min(both.size(), one.size()) >= 2);
    for (int k = 0; k < 2; ++k) {
      errors(level, k) = both(k) / ((k + 1) * speed / (2 * length)) - 1;
      errors(level, 2 + k) = one(k) / ((2 * k + 1) * speed / (4 * length)) - 1;
    }
  }
  INFO(errors);
  CHECK(errors.minCoeff() > 0);
  for (int k = 0; k < 4; ++k) {
    CHECK(orders(errors.col(k)).tail(2).minCoeff() > 3.8);
    CHECK(orders(errors.col(k)).tail(2).maxCoeff() < 4.2);
  }
}

TEST_CASE("The free reduced bar has the frequencies of the rod's reduction, and both lie above those of the free bar") {
  Eigen::MatrixXd mesh_errors(3, 2);
  for (int level = 0; level < 3; ++level) {
    const Superelement body = bar(6 << level, {"x0", "x1"});
    const Eigen::VectorXd found = free_free(body).head(2);
    // Modes that respond to a push on the end, of the 24: sqrt(2 m) / (k pi). Warping sections do not.
    const auto modes = static_cast<int>(
        (body.mass.row(0).tail(body.modes()).array().abs() > 0.05 * std::sqrt(body.total_mass)).count());
    REQUIRE(modes >= 2);
    const Eigen::VectorXd truncated = reduced_rod(modes, 2);
    mesh_errors.row(level) = (found.cwiseQuotient(truncated).array() - 1).matrix().transpose();
    for (int k = 0; k < 2; ++k) {
      CHECK(found(k) > (k + 1) * speed / (2 * length));
    }
  }
  INFO(mesh_errors);
  // The sign is arbitrary: the mesh changes the kept modes and the motions that they can represent.
  CHECK(mesh_errors.bottomRows<1>().cwiseAbs().maxCoeff() < 1e-6);
  for (int k = 0; k < 2; ++k) {
    CHECK(orders(mesh_errors.col(k).cwiseAbs()).tail(1)(0) > 3.8);
  }
}

}  // namespace test_reduced_bar
