// Motions and equilibria with condensed amplitudes against the same equations with a component that adds nothing and
// prevents the condensation.
#include <catch2/catch.hpp>

#include "mechanism/solvers/dynamics/time_integration.hpp"
#include "tests/support/superelement_arms.hpp"

using namespace bielle::mechanism;
using bielle::test::ArmsSystem;
using bielle::test::SuperelementArms;

namespace {

struct Run {
  State state;
  int iterations = 0;
};

Run integrate(const ArmsSystem& arms, ConstraintForm form, bool reuse) {
  NewtonOptions options;
  options.tangent = reuse ? Tangent::reused : Tangent::renewed;
  TimeIntegration integration(arms.system, arms.file.model.environment, Scheme::generalized_alpha(0.8),
                              arms.system.start(0), form, options);
  constexpr double h = 2e-3;
  integration.start(h);
  Run run;
  for (int k = 0; k < 50; ++k) run.iterations += integration.step(h).iterations;
  run.state = integration.state();
  return run;
}

}  // namespace

TEST_CASE("a motion is the same with condensed amplitudes, in every form of the constraints") {
  const SuperelementArms arms;
  const ArmsSystem condensed(arms, true), whole(arms, false);
  REQUIRE(condensed.system.condensed_pattern().blocks().size() == 2);
  REQUIRE(whole.system.condensed_pattern().blocks().empty());
  const auto form = GENERATE(ConstraintForm::corrected, ConstraintForm::position, ConstraintForm::stabilised);
  const bool reuse = GENERATE(false, true);
  const Run a = integrate(condensed, form, reuse), b = integrate(whole, form, reuse);
  // Newton's tolerance is 1e-9 of the forces in each of 50 steps.
  constexpr double tolerance = 1e-7;
  for (std::size_t k = 0; k < a.state.nodes.size(); ++k) {
    CHECK((a.state.nodes[k].x - b.state.nodes[k].x).norm() < tolerance);
    CHECK((a.state.nodes[k].R - b.state.nodes[k].R).norm() < tolerance);
  }
  CHECK((a.state.amplitude - b.state.amplitude).norm() < tolerance * b.state.amplitude.norm());
  CHECK(b.state.amplitude.norm() > 1e-5);  // they bend
  if (!reuse) CHECK(a.iterations == b.iterations);
}
