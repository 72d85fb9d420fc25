// The records of a joint at every step equal its measures with all their derivatives.
#include <catch2/catch.hpp>

#include "mechanism/measures/pair_measure.hpp"
#include "tests/support/random.hpp"

using namespace bielle::mechanism;
using bielle::test::Random;

namespace {

NodeState random_node(Random& random) {
  NodeState node;
  node.x = random.vector3();
  node.R = exp_so3(random.vector3(3));
  node.v = random.vector3();
  node.Omega = random.vector3(5);
  return node;
}

void check_same(const PairMeasureRate& alone, const PairMeasure& whole, const NodeState& first,
                const NodeState& second) {
  CHECK_THAT(alone.value, Catch::WithinAbs(whole.value, 1e-14));
  CHECK_THAT(alone.rate, Catch::WithinAbs(whole.rate(pair_rate(first, second)), 1e-12));
}

}  // namespace

TEST_CASE("values and rates of measures are those of the measures with derivatives") {
  Random random(7);
  for (int k = 0; k < 20; ++k) {
    const NodeState first = random_node(random), second = random_node(random);
    const Vector3 e = random.vector_of_length(1), c_1 = random.vector3(), c_2 = random.vector3();
    check_same(measure_position_rate(first, second, e, c_1, c_2), measure_position(first, second, e, c_1, c_2), first,
               second);
    const Matrix3 A = exp_so3(random.vector3(3)), B = exp_so3(random.vector3(3));
    check_same(measure_angle_rate(first, second, A, B), measure_angle(first, second, A, B), first, second);
  }
}
