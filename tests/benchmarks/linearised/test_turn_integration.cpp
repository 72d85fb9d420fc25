// Time integration of periodic equations over one turn, against multipliers in closed form.
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "mechanism/solvers/linearised/turn_integration.hpp"

using namespace bielle::mechanism;

namespace test_turn_integration {
namespace {

using Complex = std::complex<double>;
constexpr double rate = 2.5, two_pi = 2 * std::numbers::pi;
const double duration = two_pi / rate;

LinearisedEquations::Sparse sparse(const MatrixX& A) { return A.sparseView(); }

/// Returns the equations of a point of mass 1 in a plane without forces.
LinearisedEquations plane_point(int constraints) {
  LinearisedEquations e;
  e.dofs = 2;
  e.M = sparse(MatrixX::Identity(2, 2));
  e.C = e.K = e.W = sparse(MatrixX::Zero(2, 2));
  e.B = e.S = sparse(MatrixX::Zero(constraints, 2));
  e.F = sparse(MatrixX::Zero(2, constraints));
  e.nonholonomic.assign(static_cast<std::size_t>(constraints), 0);
  e.multiplier.assign(static_cast<std::size_t>(constraints), 0);
  e.turns.assign(2, 0);
  e.left_over = VectorX::Zero(2);
  return e;
}

/// Returns periodic equations that `change` derives from the given ones for each azimuth.
template <class Change>
PeriodicEquations over_turn(const LinearisedEquations& e, double sense, const Change& change) {
  constexpr int count = 8;
  std::vector<LinearisedEquations> azimuths(count, e);
  for (int k = 0; k < count; ++k) change(azimuths[static_cast<std::size_t>(k)], two_pi * k / count);
  return {azimuths, sense * rate, 1};
}

std::vector<Complex> multipliers(const PeriodicEquations& equations, int steps) {
  const int states = equations.first().states();
  const MatrixX after = TurnIntegration(equations, steps).after_turn(MatrixX::Identity(states, states));
  const Eigen::VectorXcd values = Eigen::EigenSolver<MatrixX>(after, false).eigenvalues();
  return {values.begin(), values.end()};
}

double distance(const std::vector<Complex>& found, Complex expected) {
  double least = INFINITY;
  for (const Complex each : found) least = std::min(least, std::abs(each - expected));
  return least;
}

/// Checks that errors fall with the fifth power of the step.
void check_order(const PeriodicEquations& equations, const std::vector<Complex>& expected) {
  constexpr int steps = 30;
  const std::vector<Complex> coarse = multipliers(equations, steps), fine = multipliers(equations, 2 * steps);
  for (const Complex each : expected) {
    CAPTURE(each, distance(coarse, each), distance(fine, each));
    CHECK(distance(fine, each) < 1e-4);
    CHECK(distance(fine, each) * 26 < distance(coarse, each) + 1e-11);
  }
}

}  // namespace

TEST_CASE("a point on a line that turns has the multipliers of the closed form", "[linearised]") {
  // With k > rate^2 the distance along the line oscillates at sqrt(k - rate^2 - c^2/4) with the damping c.
  const double k = 20, c = 0.3;
  LinearisedEquations e = plane_point(1);
  e.K = sparse(k * MatrixX::Identity(2, 2));
  e.C = sparse(c * MatrixX::Identity(2, 2));
  const PeriodicEquations equations = over_turn(e, 1, [](LinearisedEquations& at, double psi) {
    at.B = sparse(MatrixX(Eigen::RowVector2d(-std::sin(psi), std::cos(psi))));
  });
  const Complex s(-c / 2, std::sqrt(k - rate * rate - c * c / 4));
  check_order(equations, {std::exp(s * duration), std::exp(std::conj(s) * duration)});
}

TEST_CASE("a point that rolls along a direction that turns loses its speed alone", "[linearised]") {
  const double c = 0.4;
  LinearisedEquations e = plane_point(1);
  e.C = sparse(c * MatrixX::Identity(2, 2));
  e.nonholonomic.assign(1, 1);
  const PeriodicEquations equations = over_turn(e, -1, [](LinearisedEquations& at, double psi) {
    at.B = sparse(MatrixX(Eigen::RowVector2d(-std::sin(psi), std::cos(psi))));
  });
  const std::vector<Complex> found = multipliers(equations, 40);
  CHECK(distance(found, std::exp(-c * duration)) < 1e-5);
  CHECK(std::count_if(found.begin(), found.end(), [](Complex mu) { return std::abs(mu - 1.0) < 1e-9; }) == 2);
}

TEST_CASE("a point on springs has its frequency in axes that turn, and more by unequal springs", "[linearised]") {
  // W and the part M W of C belong to axes that turn with the rate.
  const double k = 30;
  LinearisedEquations e = plane_point(0);
  MatrixX W(2, 2);
  W << 0, -rate, rate, 0;
  e.W = e.C = sparse(W);
  e.K = sparse(k * MatrixX::Identity(2, 2));
  const PeriodicEquations constant = over_turn(e, 1, [](LinearisedEquations&, double) {});
  check_order(constant, {std::exp(Complex(0, (std::sqrt(k) - rate) * duration)),
                         std::exp(Complex(0, (std::sqrt(k) + rate) * duration))});
  // Unequal springs that stand still are periodic in these axes; both motions are uncoupled in standing ones.
  const PeriodicEquations unequal = over_turn(e, 1, [k](LinearisedEquations& at, double psi) {
    const Eigen::Rotation2Dd turned(psi);
    const Eigen::Matrix2d R = turned.toRotationMatrix();
    at.K = sparse(MatrixX(R.transpose() * Eigen::DiagonalMatrix<double, 2>(k, 1.7 * k) * R));
  });
  check_order(unequal,
              {std::exp(Complex(0, std::sqrt(k) * duration)), std::exp(Complex(0, std::sqrt(1.7 * k) * duration))});
}

TEST_CASE("a first-order unknown decays over a turn by the mean of its rate", "[linearised]") {
  LinearisedEquations e = plane_point(0);
  e.dofs = 1;  // y' + a y = 0 for the second unknown
  e.K = sparse(MatrixX(Eigen::Vector2d(9, 0).asDiagonal()));
  e.C = sparse(MatrixX(Eigen::Vector2d(0, 1).asDiagonal()));
  e.M = sparse(MatrixX(Eigen::Vector2d(1, 0).asDiagonal()));
  const double mean = 0.6;
  const PeriodicEquations equations = over_turn(e, 1, [mean](LinearisedEquations& at, double psi) {
    at.K = sparse(MatrixX(Eigen::Vector2d(9, mean + 0.9 * std::sin(psi)).asDiagonal()));
  });
  check_order(equations, {std::exp(-mean * duration), std::exp(Complex(0, 3 * duration))});
}

TEST_CASE("motions that are too fast for the step vanish in a turn", "[linearised]") {
  LinearisedEquations e = plane_point(0);
  e.K = sparse(MatrixX(Eigen::Vector2d(16, 1e10).asDiagonal()));
  const PeriodicEquations equations = over_turn(e, 1, [](LinearisedEquations&, double) {});
  const std::vector<Complex> found = multipliers(equations, 80);
  CHECK(distance(found, std::exp(Complex(0, 4 * duration))) < 1e-6);
  CHECK(std::count_if(found.begin(), found.end(), [](Complex mu) { return std::abs(mu) < 1e-20; }) == 2);
}

}  // namespace test_turn_integration
