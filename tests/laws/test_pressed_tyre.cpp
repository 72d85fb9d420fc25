// The tangent of a tyre that is pressed on the road: the laws meet it with any reaction, this test with pushes.
#include <catch2/catch.hpp>

#include "mechanism/joints/pairs/tyre_force.hpp"
#include "tests/laws/subject.hpp"
#include "tests/support/finite_difference.hpp"

using namespace bielle::laws;

TEST_CASE("the tangent of a tyre in partial and in full sliding is the derivative of its force") {
  const Sample* sample = nullptr;
  for (const Sample& each : samples())
    if (each.type == "wheel" && each.variant == "saturating tyre") sample = &each;
  REQUIRE(sample);
  const std::vector<Subject> list = subjects(*sample);
  int partial = 0, full = 0;
  for (const Subject& subject : list) {
    const DenseModel& dense = *subject.dense;
    for (unsigned seed = 1; seed <= 6; ++seed)
      for (const double push : {0.4, 6.0}) {
        State state = subject.random_state(1, seed);
        state.multiplier.setConstant(push);
        const VectorX r = dense.residual(state);
        (push < 1 ? full : partial) += r.head(12).norm() > 0 ? 1 : 0;
        const MatrixX K = dense.tangent(state, DenseModel::Part::K), C = dense.tangent(state, DenseModel::Part::C);
        const auto moved = [&](const VectorX& step) -> VectorX {
          State other = state;
          dense.move(other, step);
          return dense.residual(other);
        };
        const auto faster = [&](const VectorX& step) -> VectorX {
          State other = state;
          dense.move_rates(other, step);
          return dense.residual(other);
        };
        CAPTURE(seed, push);
        CHECK((bielle::test::jacobian(moved, dense.size(), 0.002) - K).cwiseAbs().maxCoeff() < 1e-8 * (1 + K.cwiseAbs().maxCoeff()));
        CHECK((bielle::test::jacobian(faster, 12, 0.002) - C.leftCols(12)).cwiseAbs().maxCoeff() <
              1e-8 * (1 + C.cwiseAbs().maxCoeff()));
      }
  }
  CHECK(partial > 0);
  CHECK(full > 0);
}
