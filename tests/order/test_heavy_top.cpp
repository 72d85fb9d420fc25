// Order of the index-3 generalised-alpha scheme on the heavy top. Reference at t = 1 s: Euler-Poinsot equations in
// quaternions, DOP853 with rtol 1e-13 (energy drift below 2e-10 J of 5436 J).
#include <catch2/catch.hpp>

#include "tests/order/heavy_top.hpp"
#include "tests/support/run_model.hpp"

using namespace bielle::mechanism;
using bielle::test::EulerPoinsot;
using bielle::test::integrate;
using bielle::test::ReadyModel;

namespace {

const Vector3 x_reference(0.17334396410, 0.64008859207, -0.74849079113);
const Vector3 Omega_reference(-0.822078102, 150, -5.923291348);
const Vector3 force_reference(-517.6007395, -396.8431015, 404.5749252);  // force of the pivot on the body

struct Errors {
  double x, Omega, lambda;
};

/// @param corrected  with the start values of A and v that make multipliers of second order from the first step
Errors errors_at_one_second(const Scheme& scheme, double h, bool corrected = true,
                            ConstraintForm form = ConstraintForm::corrected) {
  const ReadyModel model(bielle::test::heavy_top);
  TimeIntegration integration(model.system, model.environment(), scheme, model.system.start(0), form);
  if (corrected) integration.start(h);
  for (long k = 0; k < std::lround(1 / h); ++k) integration.step(h);
  const State& state = integration.state();
  const NodeState& node = model.node(state, "top");
  // The joint's frame stays parallel to the inertial axes: its multipliers are B^T lambda of the body, the negative of
  // the force on it.
  const Vector3 force = -state.multiplier;
  return {(node.x - x_reference).norm(), (node.Omega - Omega_reference).norm(), (force - force_reference).norm()};
}

double order(double coarse, double fine) { return std::log2(coarse / fine); }

}  // namespace

TEST_CASE("the heavy top converges with order 2 in positions, velocities and multipliers over four halvings") {
  double h = 2e-3;
  Errors coarse = errors_at_one_second(Scheme::generalized_alpha(0.8), h, true, ConstraintForm::position);
  for (int halving = 0; halving < 4; ++halving) {
    h /= 2;
    const Errors fine = errors_at_one_second(Scheme::generalized_alpha(0.8), h, true, ConstraintForm::position);
    INFO("h = " << h);
    // The asymptotic order is 2; at these steps the next term of the error is below 5 %.
    CHECK(order(coarse.x, fine.x) == Approx(2).margin(0.05));
    CHECK(order(coarse.Omega, fine.Omega) == Approx(2).margin(0.05));
    CHECK(order(coarse.lambda, fine.lambda) == Approx(2).margin(0.1));
    coarse = fine;
  }
}

TEST_CASE("the heavy top's errors at one second are those of an independent implementation, scheme by scheme") {
  // Lie-group integrators, index 3, A_0 = a_0, in Python with dense algebra; references good to three to four digits.
  struct Row {
    const char* name;
    Scheme scheme;
    double h;
    Errors expected;
  };
  const Row rows[] = {
      {"rho = 0.9", Scheme::generalized_alpha(0.9), 1e-3, {7.2742e-3, 1.0170e-1, 8.7231}},
      {"rho = 0.9", Scheme::generalized_alpha(0.9), 5e-4, {1.8144e-3, 2.5333e-2, 2.1733}},
      {"rho = 0.9", Scheme::generalized_alpha(0.9), 2.5e-4, {4.5335e-4, 6.3274e-3, 5.4286e-1}},
      {"rho = 0.8", Scheme::generalized_alpha(0.8), 1e-3, {7.4243e-3, 1.0399e-1, 8.9008}},
      {"HHT, rho = 0.9", Scheme::hht(0.1 / 1.9), 1e-3, {7.5659e-3, 1.0676e-1, 9.0509}},
  };
  for (const Row& row : rows) {
    const Errors found = errors_at_one_second(row.scheme, row.h, false, ConstraintForm::position);
    INFO(row.name << ", h = " << row.h);
    CHECK(found.x == Approx(row.expected.x).epsilon(5e-4));
    CHECK(found.Omega == Approx(row.expected.Omega).epsilon(5e-4));
    CHECK(found.lambda == Approx(row.expected.lambda).epsilon(5e-4));
  }
}

namespace {

struct LargestErrors : bielle::test::TopErrors {
  double a = 0;  ///< error of the centre's acceleration
};

/// Over all steps until `end`.
LargestErrors largest_errors(double rho, double h, double end, bool corrected) {
  const ReadyModel model(bielle::test::heavy_top);
  TimeIntegration integration(model.system, model.environment(), Scheme::generalized_alpha(rho), model.system.start(0),
                              ConstraintForm::position);
  EulerPoinsot reference;
  LargestErrors errors;
  if (corrected) integration.start(h);
  for (long k = 0; k < std::lround(end / h); ++k) {
    integration.step(h);
    reference.advance(h, 20);
    const NodeState& top = model.node(integration.state(), "top");
    const Vector3 a = reference.force() / 15 + Vector3(0, 0, -9.81);
    errors.note(top, integration.state().multiplier, reference);
    errors.a = std::max(errors.a, (top.a - a).norm());
  }
  return errors;
}

}  // namespace

TEST_CASE("without corrected start values the multipliers' error in the transient is that of the literature: order 1") {
  // Independent implementation, rho = 0.9, largest error in [0, 0.1 s]: 122.4, 60.1, 29.9.
  for (const auto& [h, expected] : {std::pair(1e-3, 122.4), std::pair(5e-4, 60.1), std::pair(2.5e-4, 29.9)})
    CHECK(largest_errors(0.9, h, 0.1, false).lambda == Approx(expected).epsilon(2e-3));
  // rho = 0.8, h = 1e-3, over one second, without the corrections and with them: x, v, lambda.
  const LargestErrors plain = largest_errors(0.8, 1e-3, 1, false), corrected = largest_errors(0.8, 1e-3, 1, true);
  CHECK(plain.x == Approx(7.42e-3).epsilon(1e-3));
  CHECK(plain.v == Approx(1.25e-1).epsilon(5e-3));
  CHECK(plain.lambda == Approx(58.2).epsilon(2e-3));
  CHECK(corrected.x == Approx(7.43e-3).epsilon(1e-3));
  CHECK(corrected.v == Approx(1.25e-1).epsilon(5e-3));
  CHECK(corrected.lambda == Approx(8.91).epsilon(2e-3));
}

TEST_CASE("with corrected start values multipliers and accelerations are second order in the transient too") {
  // Largest error over all steps of the first 0.1 s (M. Arnold, O. Bruls, A. Cardona, Numer. Math. 129 (2015) 149). The
  // transient decays per step, so that each run is judged at its own steps.
  double h = 5e-4;
  LargestErrors coarse = largest_errors(0.8, h, 0.1, true);
  for (int halving = 0; halving < 4; ++halving) {
    h /= 2;
    const LargestErrors fine = largest_errors(0.8, h, 0.1, true);
    INFO("h = " << h << ": lambda " << coarse.lambda << " -> " << fine.lambda << ", a " << coarse.a << " -> "
                << fine.a);
    CHECK(order(coarse.x, fine.x) == Approx(2).margin(0.1));
    CHECK(order(coarse.v, fine.v) == Approx(2).margin(0.1));
    CHECK(order(coarse.lambda, fine.lambda) == Approx(2).margin(0.1));
    CHECK(order(coarse.a, fine.a) == Approx(2).margin(0.1));
    coarse = fine;
  }
}
