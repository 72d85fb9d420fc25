// The tangents of damped ropes that slip with friction: within a step, with a slip since the last one, and at the
// beginning of a branch, with its rate as unknown.
#include <cmath>

#include <catch2/catch.hpp>

#include "mechanism/joints/cables/rope_friction.hpp"
#include "tests/laws/subject.hpp"
#include "tests/support/finite_difference.hpp"

using namespace bielle::laws;

TEST_CASE("damped ropes that slip have the tangents of their forces") {
  const bool within_step = GENERATE(true, false);
  constexpr double step = 0.1;
  int sections = 0, slipping = 0, sticking = 0;
  for (const Sample& sample : samples()) {
    if (sample.variant != "that slips") continue;
    Sample damped = sample;
    damped.model.replace(damped.model.find("EA: 6"), 5, "EA: 6, damping: 0.3");
    for (const Subject& subject : subjects(damped)) {
      const DenseModel& dense = *subject.dense;
      for (unsigned seed = 2; seed <= 13; ++seed) {
        State state = subject.random_state(1, seed);
        // Memories of times are not known before the first step.
        for (double& each : state.memory)
          if (std::isnan(each) && within_step) each = state.time - step;
        CAPTURE(title(sample), seed, within_step);
        const auto moved = [&](auto move) {
          return bielle::test::jacobian(
              [&](const VectorX& change) -> VectorX {
                State other = state;
                (dense.*move)(other, change);
                return dense.residual(other);
              },
              dense.size(), 1e-5);  // few states are so near to a kink
        };
        const auto K = dense.tangent(state, DenseModel::Part::K), C = dense.tangent(state, DenseModel::Part::C);
        CHECK((moved(&DenseModel::move) - K).cwiseAbs().maxCoeff() < 1e-6 * (1 + K.cwiseAbs().maxCoeff()));
        CHECK((moved(&DenseModel::move_rates) - C).cwiseAbs().maxCoeff() < 1e-6 * (1 + C.cwiseAbs().maxCoeff()));
        const int first = dense.first_order_begin(), count = dense.multiplier_begin() - first;
        const VectorX rows = dense.residual(state).segment(first, count);
        if (rows.isZero(0)) {
          ++sections;  // the friction provides their equation of the slip
          continue;
        }
        Eigen::Index row = 0;
        rows.cwiseAbs().maxCoeff(&row);
        // The equation of a slip that sticks is its increment times a stiffness, which depends on the free lengths
        // alone; the second equation of a damped rope defines the rate.
        (C.middleRows(first, count).isZero(0) ? sticking : slipping) += 1;
      }
    }
  }
  CHECK(sections > 0);
  CHECK(slipping > 5);
  CHECK(sticking > 0);
}
