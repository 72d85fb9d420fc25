// The tangent and the power of a joint that slips by Coulomb's law: the laws test it before its motion has begun, this
// test on its two branches of slipping.
#include <catch2/catch.hpp>

#include "tests/laws/subject.hpp"
#include "tests/support/finite_difference.hpp"

using namespace bielle::laws;

TEST_CASE("friction that slips has the tangents of its force, and takes power") {
  int checked = 0;
  for (const Sample& sample : samples()) {
    if (sample.variant != "stick and slip" && sample.variant != "clutch") continue;
    for (const Subject& subject : subjects(sample)) {
      const DenseModel& dense = *subject.dense;
      const auto& rows = dense.declarations().front().multipliers;
      if (rows.empty() || !rows.front().yields) continue;  // the joint itself
      for (unsigned seed = 2; seed <= 5; ++seed)
        for (const double direction : {1.0, -1.0}) {
          State state = subject.random_state(1, seed);
          state.memory[0] = direction;  // its own come first
          state.multiplier[0] = 0;      // it does not stick
          CAPTURE(title(sample), seed, direction);
          const auto moved = [&](auto move) {
            return bielle::test::jacobian(
                [&](const VectorX& step) -> VectorX {
                  State other = state;
                  (dense.*move)(other, step);
                  return dense.residual(other);
                },
                dense.size(), 0.005);
          };
          const auto K = dense.tangent(state, DenseModel::Part::K), C = dense.tangent(state, DenseModel::Part::C);
          CHECK((moved(&DenseModel::move) - K).cwiseAbs().maxCoeff() < 1e-8 * (1 + K.cwiseAbs().maxCoeff()));
          CHECK((moved(&DenseModel::move_rates) - C).cwiseAbs().maxCoeff() < 1e-8 * (1 + C.cwiseAbs().maxCoeff()));
          // The force of the joint opposes motion along `direction` at any velocity.
          const VectorX r = dense.residual(state), v = dense.rates(state);
          const double power = r.dot(v);
          CHECK_THAT(power, Catch::WithinAbs(dense.energy(state).dissipation, 1e-12 * (1 + std::abs(power))));
          ++checked;
        }
    }
  }
  CHECK(checked >= 6 * 8);
}
