// Condensation does not allocate after its first evaluation.
#include <catch2/catch.hpp>

#include "mechanism/math/condensed.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/random.hpp"
#include "tests/support/sparse_values.hpp"

using namespace bielle::mechanism;
using bielle::test::AllocationCount;
using bielle::test::Random;
using bielle::test::SparseValues;

TEST_CASE("blocks of 10, 50 and 100 unknowns are condensed without the heap") {
  const int block = GENERATE(10, 50, 100), size = 2 * block + 12;
  Random random(1);
  MatrixX A = MatrixX::Zero(size, size);
  A.topLeftCorner(block + 12, block + 12) = random.positive_matrix(block + 12);
  A.bottomRightCorner(block + 12, block + 12) += random.positive_matrix(block + 12);
  std::vector<int> first, second;
  for (int k = 0; k < block; ++k) {
    first.push_back(k);
    second.push_back(block + 12 + k);
  }
  const SparseValues sparse(A);
  const CondensedPattern pattern(sparse.pattern, {first, second});
  REQUIRE(pattern.blocks().size() == 2);
  CondensedLU factors(pattern);
  Workers workers(2);
  const VectorX scale = VectorX::Ones(size);
  VectorX b = VectorX::Ones(size);
  // KLU's memory does not change after the second factorisation.
  for (int k = 0; k < 3; ++k) factors.factor(sparse.values, scale, workers);
  factors.solve(b);
  REQUIRE(factors.condensed());
  const AllocationCount count;
  factors.factor(sparse.values, scale, workers);
  factors.solve(b);
  CHECK(count.calls() == 0);
}
