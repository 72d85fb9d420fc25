// The tangent of a tyre that is pressed on the road: the laws use any reaction, this test only pushes.
#include <catch2/catch.hpp>

#include "mechanism/joints/pairs/tyre_force.hpp"
#include "tests/laws/subject.hpp"

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
        // Each unknown is changed by itself, along positions and along rates.
        double wrong_K = 0, wrong_C = 0;
        for (int k = 0; k < 12; ++k) {
          VectorX by_position = VectorX::Zero(dense.size()), by_rate = by_position;
          for (const double h : {0.002, -0.002}) {
            const VectorX step = h * VectorX::Unit(dense.size(), k);
            State moved = state, faster = state;
            dense.move(moved, step);
            dense.move_rates(faster, step);
            by_position += dense.residual(moved) / (2 * h);
            by_rate += dense.residual(faster) / (2 * h);
          }
          wrong_K = std::max(wrong_K, (by_position - K.col(k)).cwiseAbs().maxCoeff());
          wrong_C = std::max(wrong_C, (by_rate - C.col(k)).cwiseAbs().maxCoeff());
        }
        CAPTURE(seed, push);
        // Central differences: h^2 times third derivatives of a force that varies over slips of order one.
        CHECK(wrong_K < 1e-3 * (1 + K.cwiseAbs().maxCoeff()));
        CHECK(wrong_C < 1e-3 * (1 + C.cwiseAbs().maxCoeff()));
        // Derivative with respect to the push, in which the force is smooth.
        VectorX by_push = VectorX::Zero(dense.size());
        for (const double h : {1e-4, -1e-4}) {
          State pushed = state;
          pushed.multiplier.array() += h;
          by_push += dense.residual(pushed) / (2 * h);
        }
        CHECK((by_push - K.col(dense.size() - 1)).head(12).norm() < 1e-6 * (1 + K.cwiseAbs().maxCoeff()));
      }
  }
  CHECK(partial > 0);
  CHECK(full > 0);
}
