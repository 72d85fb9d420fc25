// Newmark's trapezoidal rule on a constrained system is weakly unstable for any step; dissipation removes this
// instability.
#include <catch2/catch.hpp>

#include "tests/support/run_model.hpp"

using namespace bielle::mechanism;
using bielle::test::integrate;
using bielle::test::ReadyModel;

namespace {

/// A mass of 1 kg that circles at 1 m, once a second, without gravity: the multiplier is m L omega^2.
const char* const circling = R"yaml(
nodes: {m: {position: [1, 0, 0], velocity: [0, "2*pi", 0], angular_velocity: [0, 0, "2*pi"]}}
elements: {m: {type: rigid_body, node: m, mass: 1, inertia: [1e-9, 1e-9, 1e-9]}}
joints: {pin: {type: spherical, nodes: [ground, m], position: [0, 0, 0]}}
)yaml";

/// Returns the largest relative error of the multiplier in each revolution.
std::vector<double> errors_by_revolution(const Scheme& scheme, double h, int revolutions,
                                         ConstraintForm form = ConstraintForm::position) {
  const double pi = std::acos(-1.0), exact = 4 * pi * pi;
  const ReadyModel model(circling);
  std::vector<double> errors(static_cast<std::size_t>(revolutions), 0.0);
  integrate(
      model, scheme, h, revolutions,
      [&](const State& state) {
        const auto revolution = std::min(static_cast<std::size_t>(state.time), errors.size() - 1);
        errors[revolution] = std::max(errors[revolution], std::abs(state.multiplier.norm() / exact - 1));
      },
      form);
  return errors;
}

}  // namespace

TEST_CASE("Newmark's rule lets rounding errors of multipliers grow by exp(2 pi) per revolution, whatever the step") {
  // A. Cardona, M. Geradin, Comput. Struct. 33 (1989) 801. The amplification is that of the index-3 equations:
  // exp(omega h) per step, 535 per revolution.
  for (const double h : {0.01, 0.005}) {
    const std::vector<double> errors = errors_by_revolution(Scheme::newmark(), h, 4);
    INFO("h = " << h << ": " << errors[0] << " " << errors[1] << " " << errors[2] << " " << errors[3]);
    CHECK(errors[2] / errors[1] > 100);
    CHECK(errors[3] / errors[2] > 100);
  }
}

TEST_CASE("numerical dissipation keeps the multipliers at the size of the scheme's error") {
  const double pi = std::acos(-1.0), h = 0.005;
  for (const Scheme& scheme : {Scheme::generalized_alpha(0.9), Scheme::generalized_alpha(0.5), Scheme::hht(0.1)}) {
    // (omega h)^2 is 1e-3: the error of a second-order scheme, without growth.
    for (const double error : errors_by_revolution(scheme, h, 6)) CHECK(error < 2 * (2 * pi * h) * (2 * pi * h));
  }
}

TEST_CASE("corrected velocities cure Newmark's rule, too") {
  const double pi = std::acos(-1.0), h = 0.01;
  for (const double error : errors_by_revolution(Scheme::newmark(), h, 6, ConstraintForm::corrected))
    CHECK(error < (2 * pi * h) * (2 * pi * h));
}
