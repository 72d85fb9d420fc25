// The flying spaghetti at late times, where errors have grown.
#include "tests/benchmarks/beams/flying_spaghetti.hpp"

using namespace bielle::test::spaghetti;

TEST_CASE("flying spaghetti in the plane at late times converges to the reference") {
  check(100, true, 0.01, {{15, {32.425897, 4.518096, 0}, {23.771001, 5.922268, 0}}}, 5e-4);
  check(500, true, 0.01, {{15, {25.6901515, -0.4332959, 0}, {30.1902357, 8.4949399, 0}}}, 5e-4);
}

TEST_CASE("flying spaghetti in space at a late time converges to the reference") {
  check(500, false, 0.005, {{10, {44.402384, 1.669030, -2.065274}, {36.408950, 6.335486, 1.678987}}}, 5e-4);
}
