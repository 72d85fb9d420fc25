// Evaluations of a superelement do not touch the heap once they have been made.
#include <catch2/catch.hpp>

#include "mechanism/elements/superelement/recovery/stress_peaks.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/superelement_alone.hpp"

using namespace bielle::mechanism;
using namespace bielle::test;

TEST_CASE("residual and tangents of a superelement allocate nothing after the first evaluation") {
  Random random(1);
  BeamChain chain = bent_chain();
  chain.modes = 30;
  const SuperelementAlone alone(chain.reduced().body, {},
                                {{"push", bielle::Expression(1.5), true}, {"spread", bielle::Expression(2.0), false}});
  const State first = alone.random_state(random, 0.02, 2), second = alone.random_state(random, 0.02, 2);
  VectorX r = VectorX::Zero(alone.size());
  MatrixX K = MatrixX::Zero(alone.size(), alone.size()), C = K, M = K;
  LocalTangent tangent{LocalMatrix(K), LocalMatrix(C), LocalMatrix(M)};
  alone.body().add_residual(alone.local(first), r);
  alone.body().add_tangent(alone.local(first), tangent);

  const LocalState local = alone.local(second);
  int calls = 0;
  {
    const AllocationCount count;
    alone.body().add_residual(local, r);
    alone.body().add_tangent(local, tangent);
    calls = count.calls();
  }
  CHECK(calls == 0);
}

TEST_CASE("what is gathered of a superelement's deformation allocates nothing after the first step") {
  Random random(2);
  bielle::Superelement body = bent_chain().reduced().body;
  body.strains = MatrixX::Random(6 * 9, body.size());
  const SuperelementAlone alone(body);
  const State first = alone.random_state(random, 0.02, 2), second = alone.random_state(random, 0.02, 2);
  const auto recorder = alone.body().make_step_recorder();
  recorder->begin();
  recorder->add(alone.local(first));
  const LocalState local = alone.local(second);
  int calls = 0;
  {
    const AllocationCount count;
    recorder->add(local);
    calls = count.calls();
  }
  CHECK(calls == 0);
}

TEST_CASE("peaks allocate nothing once the first steps have been looked at") {
  bielle::Superelement body;
  constexpr int coordinates = 20, nodes = 50;
  body.mesh.points = Eigen::Matrix3Xd::Random(3, nodes);
  body.stress_recovery = MatrixX::Random(6 * nodes, coordinates);
  for (int k = 0; k < nodes; ++k) body.stress_nodes.push_back(k);
  StressPeaks peaks("rod", std::make_shared<const StressRecovery>(body), StressPeaks::names(),
                    [](const LocalState& state, double* q) { std::fill_n(q, coordinates, state.time()); });
  State state;
  const Slots slots;
  const Environment environment;
  peaks.begin();
  const auto add = [&](int steps) {
    for (int k = 0; k < steps; ++k) {
      state.time += 0.1;
      peaks.add(LocalState(state, slots, environment));
    }
  };
  add(40);  // looked at by sixteens
  int calls = 0;
  {
    const AllocationCount count;
    add(40);
    calls = count.calls();
  }
  CHECK(calls == 0);
}
