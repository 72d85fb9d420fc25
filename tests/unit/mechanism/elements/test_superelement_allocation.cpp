// Evaluations of a superelement do not touch the heap once they have been made.
#include <catch2/catch.hpp>

#include "tests/support/allocations.hpp"
#include "tests/support/superelement_alone.hpp"

using namespace bielle::mechanism;
using namespace bielle::test;

TEST_CASE("residual and tangents of a superelement allocate nothing behind the first evaluation") {
  Random random(1);
  BeamChain chain = bent_chain();
  chain.modes = 30;
  const SuperelementAlone alone(chain.reduced().body, {},
                                {{"push", bielle::Expression(1.5), true}, {"spread", bielle::Expression(2.0), false}});
  const State first = alone.random_state(random, 0.02, 2, 3), second = alone.random_state(random, 0.02, 2, 3);
  VectorX r = VectorX::Zero(alone.size());
  MatrixX K = MatrixX::Zero(alone.size(), alone.size()), C = K, M = K;
  LocalTangent tangent{K, C, M};
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
