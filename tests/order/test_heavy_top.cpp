// Order of the index-3 generalised-alpha scheme on the heavy top. Reference at t = 1 s: Euler-Poinsot equations in
// quaternions (tests/references/heavy_top.py).
#include <catch2/catch.hpp>

#include "tests/order/heavy_top.hpp"
#include "tests/support/reference_table.hpp"
#include "tests/support/run_model.hpp"

using namespace bielle::mechanism;
using bielle::test::EulerPoinsot;
using bielle::test::integrate;
using bielle::test::ReadyModel;

namespace {

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
  const bielle::test::ReferenceTable exact("heavy_top");
  return {(node.x - exact.vector("1.centre")).norm(), (node.Omega - exact.vector("1.Omega")).norm(),
          (force - exact.vector("1.force")).norm()};
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
  // Lie-group integrators, index 3, A_0 = a_0 (tests/references/index_three.py).
  struct Row {
    const char* name;
    Scheme scheme;
    double h;
  };
  const Row rows[] = {{"rho_0.9.0.001", Scheme::generalized_alpha(0.9), 1e-3},
                      {"rho_0.9.0.0005", Scheme::generalized_alpha(0.9), 5e-4},
                      {"rho_0.9.0.00025", Scheme::generalized_alpha(0.9), 2.5e-4},
                      {"rho_0.8.0.001", Scheme::generalized_alpha(0.8), 1e-3},
                      {"hht.0.001", Scheme::hht(0.1 / 1.9), 1e-3}};
  const bielle::test::ReferenceTable table("index_three");
  for (const Row& row : rows) {
    const Errors found = errors_at_one_second(row.scheme, row.h, false, ConstraintForm::position);
    const std::string name = std::string("top.") + row.name;
    INFO(name);
    CHECK(found.x == Approx(table(name + ".x")).epsilon(5e-4));
    CHECK(found.Omega == Approx(table(name + ".Omega")).epsilon(5e-4));
    CHECK(found.lambda == Approx(table(name + ".lambda")).epsilon(5e-4));
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
  // Largest error in [0, 0.1 s] of the other implementation, rho = 0.9.
  const bielle::test::ReferenceTable table("index_three");
  for (const auto& [h, step] : {std::pair(1e-3, "0.001"), std::pair(5e-4, "0.0005"), std::pair(2.5e-4, "0.00025")})
    CHECK(largest_errors(0.9, h, 0.1, false).lambda ==
          Approx(table(std::string("top.transient.") + step)).epsilon(2e-3));
  // rho = 0.8, h = 1e-3, over one second, without the corrections and with them: x, v, lambda.
  const LargestErrors plain = largest_errors(0.8, 1e-3, 1, false), corrected = largest_errors(0.8, 1e-3, 1, true);
  CHECK(plain.x == Approx(table("top.rho_0.8.0.001.largest_x")).epsilon(1e-3));
  CHECK(plain.v == Approx(table("top.rho_0.8.0.001.largest_v")).epsilon(5e-3));
  CHECK(plain.lambda == Approx(table("top.rho_0.8.0.001.largest_lambda")).epsilon(2e-3));
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
