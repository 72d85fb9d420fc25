// The stabilised form of constraints: order, errors, and steps for which the index-3 form is unstable.
#include <catch2/catch.hpp>

#include "tests/order/heavy_top.hpp"
#include "tests/support/run_model.hpp"

using namespace bielle::mechanism;
using bielle::test::EulerPoinsot;
using bielle::test::integrate;
using bielle::test::ReadyModel;

namespace test_stabilised {
namespace {

struct Errors : bielle::test::TopErrors {
  double rate = 0;  ///< largest velocity of the pivot's point
};

/// Returns the largest errors of the heavy top over [0, end].
Errors top_errors(double h, double end) {
  const ReadyModel model(bielle::test::heavy_top);
  EulerPoinsot reference;
  Errors errors;
  const auto record = [&](const State& state) {
    if (state.time > 0) reference.advance(h, 20);
    const NodeState& top = model.node(state, "top");
    errors.note(top, state.multiplier, reference);
    errors.rate = std::max(errors.rate, (top.v - top.R * top.Omega.cross(Vector3(0, 1, 0))).norm());
  };
  integrate(model, Scheme::generalized_alpha(0.8), h, end, record, ConstraintForm::stabilised);
  return errors;
}

}  // namespace

TEST_CASE("the stabilised form keeps the constraints of velocities and is of order 2 from the first step") {
  double h = 1e-3;
  Errors coarse = top_errors(h, 0.2);
  CHECK(coarse.rate < 1e-8);  // relative to 15 m/s
  for (int halving = 0; halving < 4; ++halving) {
    h /= 2;
    const Errors fine = top_errors(h, 0.2);
    INFO("h = " << h << ": x " << coarse.x << " -> " << fine.x << ", lambda " << coarse.lambda << " -> "
                << fine.lambda);
    CHECK(std::log2(coarse.x / fine.x) == Approx(2).margin(0.1));
    CHECK(std::log2(coarse.lambda / fine.lambda) == Approx(2).margin(0.15));
    coarse = fine;
  }
}

TEST_CASE("the stabilised form's errors on the heavy top are those of an independent implementation") {
  // Lie-group generalised-alpha in Python with dense algebra, rho = 0.8, h = 1e-3, largest errors over [0, 1 s]:
  // x 1.31e-3, lambda 1.60.
  const Errors errors = top_errors(1e-3, 1);
  CHECK(errors.x == Approx(1.31e-3).epsilon(0.01));
  CHECK(errors.lambda == Approx(1.60).epsilon(0.02));
}

TEST_CASE("the stabilised form takes steps at which the index-3 form is unstable") {
  // A pendulum that turns at omega = 2 pi without gravity: the multiplier is m L omega^2. With rho = 0.9 the index-3
  // form is unstable from omega h = 0.075 on.
  const double pi = std::acos(-1.0), exact = 4 * pi * pi;
  const ReadyModel model(R"yaml(
nodes: {m: {position: [1, 0, 0], velocity: [0, "2*pi", 0], angular_velocity: [0, 0, "2*pi"]}}
elements: {m: {type: rigid_body, node: m, mass: 1, inertia: [1e-9, 1e-9, 1e-9]}}
joints: {pin: {type: spherical, nodes: [ground, m], position: [0, 0, 0]}}
)yaml");
  const auto worst = [&](ConstraintForm form) {
    double error = 0;
    const auto record = [&](const State& state) {
      error = std::max(error, std::abs(state.multiplier.norm() / exact - 1));
    };
    integrate(model, Scheme::generalized_alpha(0.9), 0.03, 15, record, form);
    return error;
  };
  CHECK(worst(ConstraintForm::stabilised) < 0.1);
  double unstable = 0;
  try {
    unstable = worst(ConstraintForm::position);
  } catch (const bielle::ComputationError&) {
    unstable = 1e9;  // the run may fail before its end
  }
  CHECK(unstable > 1);
}

}  // namespace test_stabilised
