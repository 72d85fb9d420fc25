// The order of the index-3 scheme across changes of the step: without the correction of v and A at a change,
// multipliers are of first order in the steps that follow (formula in time_integration.hpp).
#include <catch2/catch.hpp>

#include "tests/order/heavy_top.hpp"
#include "tests/support/run_model.hpp"

using namespace bielle::mechanism;
using bielle::test::EulerPoinsot;
using bielle::test::ReadyModel;
using bielle::test::TopErrors;

namespace {

/// Returns the largest errors in the 0.1 s after the step changed from h to `factor` h at t = 0.1 s.
TopErrors errors_after_change(double h, double factor, double rho, ConstraintForm form) {
  const ReadyModel model(bielle::test::heavy_top);
  TimeIntegration integration(model.system, model.environment(), Scheme::generalized_alpha(rho), model.system.start(0),
                              form);
  EulerPoinsot reference;
  TopErrors errors;
  integration.start(h);
  for (int k = 0; k < std::lround(0.1 / h); ++k) {
    integration.step(h);
    reference.advance(h, 20);
  }
  integration.change_step(factor * h);
  for (int k = 0; k < std::lround(0.1 / (factor * h)); ++k) {
    integration.step(factor * h);
    reference.advance(factor * h, 20);
    errors.note(model.node(integration.state(), "top"), integration.state().multiplier, reference);
  }
  return errors;
}

}  // namespace

TEST_CASE("positions and multipliers stay second order in the transient after the step is halved or doubled") {
  // With corrected velocities: rho = 0.98, so that they are corrected in all of these steps.
  for (const auto& [form, rho] : {std::pair(ConstraintForm::position, 0.8), std::pair(ConstraintForm::corrected, 0.98)})
    for (const double factor : {0.5, 2.0}) {
      // The step is not below 3e-5, since the multipliers contain the rounding of positions times m/(beta h^2).
      double h = 1e-3;
      TopErrors coarse = errors_after_change(h, factor, rho, form);
      for (int halving = 0; halving < 4; ++halving) {
        h /= 2;
        const TopErrors fine = errors_after_change(h, factor, rho, form);
        INFO("rho " << rho << ", factor " << factor << ", h = " << h << ": lambda " << coarse.lambda << " -> "
                    << fine.lambda);
        CHECK(std::log2(coarse.x / fine.x) == Approx(2).margin(0.1));
        CHECK(std::log2(coarse.lambda / fine.lambda) == Approx(2).margin(0.15));
        coarse = fine;
      }
    }
}
