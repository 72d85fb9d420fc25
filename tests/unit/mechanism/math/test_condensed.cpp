// Condensed blocks: solutions against the matrix itself and against factors of the whole, the choice of condensed
// blocks, singular blocks; any number of threads.
#include <cmath>

#include <Eigen/LU>
#include <catch2/catch.hpp>

#include "mechanism/math/condensed.hpp"
#include "tests/support/random.hpp"
#include "tests/support/sparse_values.hpp"

using namespace bielle::mechanism;
using bielle::test::backward_error;
using bielle::test::Random;
using bielle::test::SparseValues;

namespace {

constexpr int block = CondensedPattern::least_block + 3, outer = 5, constraints = 2;
constexpr int size = 2 * block + outer + constraints;

std::vector<int> numbers(int begin, int count) {
  std::vector<int> result;
  for (int k = 0; k < count; ++k) result.push_back(begin + k);
  return result;
}

/// Returns two dense blocks on common unknowns, which constraints hold: zeros on the diagonal. The second block's
/// unknowns come last. None of it symmetric.
MatrixX two_blocks(Random& random) {
  MatrixX A = MatrixX::Zero(size, size);
  const auto couple = [&](int begin) {
    A.block(begin, begin, block, block) = random.positive_matrix(block) + 0.3 * random.matrix(block, block);
    A.block(begin, block, block, outer) = random.matrix(block, outer);
    A.block(block, begin, outer, block) = random.matrix(outer, block);
  };
  couple(0);
  couple(block + outer + constraints);
  A.block(block, block, outer, outer) = 5 * random.positive_matrix(outer) + random.matrix(outer, outer);
  A.block(block, block + outer, outer, constraints) = random.matrix(outer, constraints);
  A.block(block + outer, block, constraints, outer) = random.matrix(constraints, outer);
  return A;
}

const std::vector<std::vector<int>> both_blocks = {numbers(0, block), numbers(block + outer + constraints, block)};

/// D of the factors: the constraints have their own size.
VectorX scale_of(double constraint) {
  VectorX scale = VectorX::Ones(size);
  scale.segment(block + outer, constraints).setConstant(constraint);
  return scale;
}

/// A pattern with its blocks, factors with and without them.
struct Both {
  SparseValues sparse;
  CondensedPattern pattern;
  CondensedLU condensed;
  SparseLU whole;
  explicit Both(const MatrixX& A, const std::vector<std::vector<int>>& candidates = both_blocks)
      : sparse(A), pattern(sparse.pattern, candidates), condensed(pattern), whole(sparse.pattern) {}
  FactorStatus factor(const VectorX& scale, int threads = 1) {
    Workers workers(threads);
    whole.factor(sparse.values, scale);
    return condensed.factor(sparse.values, scale, workers);
  }
};

template <class Factors>
VectorX solve(const Factors& factors, VectorX b) {
  factors.solve(b);
  return b;
}

constexpr double singular = 1e-13;  // NewtonMatrix::nearly_singular
constexpr double rounding = 1e-13;  // some hundred terms in a row, and the growth of a random matrix

}  // namespace

TEST_CASE("condensed blocks give the solution of the whole") {
  Random random(3);
  const double k = GENERATE(1.0, 1e6);
  const MatrixX A = two_blocks(random);
  Both both(A);
  REQUIRE(both.pattern.blocks().size() == 2);
  CHECK(both.pattern.rest().size() == outer + constraints);
  REQUIRE(both.factor(scale_of(k)) == FactorStatus::good);
  REQUIRE(both.condensed.condensed());
  CHECK(both.condensed.determinant_sign() == both.whole.determinant_sign());
  CHECK(both.condensed.reciprocal_condition() > singular);
  for (int j = 0; j < 3; ++j) {
    const VectorX b = random.vector(size);
    const VectorX x = solve(both.condensed, b);
    CHECK(backward_error(A, x, b) < rounding);
    // The condition of A stands between backward and forward error.
    const double condition = A.norm() * A.inverse().norm();
    CHECK((x - solve(both.whole, b)).norm() < condition * rounding * x.norm());
  }
}

TEST_CASE("the cost of factors counts the blocks that are condensed, and what is left") {
  Random random(4);
  const MatrixX A = two_blocks(random);
  Both condensed(A), whole(A, {});
  REQUIRE(condensed.factor(scale_of(1)) == FactorStatus::good);
  REQUIRE(whole.factor(scale_of(1)) == FactorStatus::good);
  const FactorCost cost = condensed.condensed.cost(), of_whole = whole.condensed.cost();
  CHECK(cost.dense_entries == 2 * block * (block + 2 * outer));
  CHECK(cost.dense_operations > 2 * 2 * block * outer * outer);
  CHECK(cost.entries < of_whole.entries);
  CHECK(cost.operations < of_whole.operations);
  CHECK(of_whole.dense_entries == 0);
  CHECK(of_whole.operations == whole.whole.cost().operations);
}

TEST_CASE("condensed blocks keep their solution when rows have units of their own") {
  Random random(4);
  MatrixX A = two_blocks(random);
  for (int i = 0; i < size; ++i) A.row(i) *= std::pow(10.0, 12 * (i % 3) - 12);
  Both both(A);
  REQUIRE(both.factor(scale_of(1)) == FactorStatus::good);
  REQUIRE(both.condensed.condensed());
  const VectorX b = random.vector(size);
  CHECK(backward_error(A, solve(both.condensed, b), b) < rounding);
}

TEST_CASE("the sign of the determinant is that of the whole, whatever the blocks' pivots") {
  Random random(5);
  int negative = 0;
  for (int sample = 0; sample < 20; ++sample) {
    MatrixX A = two_blocks(random);
    A.topLeftCorner(block, block) = random.matrix(block, block);  // elements of either sign
    Both both(A);
    REQUIRE(both.factor(scale_of(1)) == FactorStatus::good);
    if (!both.condensed.condensed()) continue;
    CHECK(both.condensed.determinant_sign() == (A.determinant() < 0 ? -1 : 1));
    negative += A.determinant() < 0;
  }
  CHECK(negative > 3);  // both signs were met
  CHECK(negative < 17);
}

TEST_CASE("a singular block is left to the factorisation of the whole") {
  Random random(6);
  MatrixX A = two_blocks(random);
  const double left = GENERATE(0.0, 1e-14, 1e-9);  // remaining part of a row: none, rounding, too little for its
                                                   // neighbours
  A.row(2).head(block) = A.row(1).head(block) + left * random.matrix(1, block);
  Both both(A);
  REQUIRE(both.pattern.blocks().size() == 2);
  REQUIRE(both.factor(scale_of(1)) == FactorStatus::good);
  CHECK_FALSE(both.condensed.condensed());
  const VectorX b = random.vector(size);
  CHECK(backward_error(A, solve(both.condensed, b), b) < rounding);
  CHECK(both.condensed.determinant_sign() == both.whole.determinant_sign());
  // The next matrix is condensed again.
  both.sparse.set(two_blocks(random));
  REQUIRE(both.factor(scale_of(1)) == FactorStatus::good);
  CHECK(both.condensed.condensed());
}

TEST_CASE("a singular matrix names the same unknown, condensed or not") {
  Random random(7);
  MatrixX A = two_blocks(random);
  Both both(A);
  REQUIRE(both.factor(scale_of(1)) == FactorStatus::good);
  const int without = GENERATE(3, block + 1, size - 1);  // in a block, outside of them, in the other block
  A.col(without).setZero();
  both.sparse.set(A);
  CHECK(both.factor(scale_of(1)) == FactorStatus::singular);
  CHECK(both.condensed.singular_column() == both.whole.singular_column());
  CHECK(both.condensed.singular_column() >= 0);
}

TEST_CASE("what cancels when blocks are condensed is seen in the condition") {
  // The first outer unknown moves with the first block along `shape` without resistance: after condensation only
  // rounding is left in its column.
  Random random(8);
  MatrixX A = two_blocks(random);
  const VectorX shape = random.vector(block);
  VectorX column = VectorX::Zero(size);
  column.head(block) = -A.topLeftCorner(block, block) * shape;
  column.segment(block, outer) = -A.block(block, 0, outer, block) * shape;
  A.col(block) = column;
  Both both(A);
  REQUIRE(both.pattern.blocks().size() == 2);
  REQUIRE(both.factor(scale_of(1)) == FactorStatus::good);
  REQUIRE(both.condensed.condensed());
  CHECK(both.condensed.reciprocal_condition() < singular);
  CHECK(both.whole.reciprocal_condition() < singular);
}

TEST_CASE("blocks that are small, sparse or coupled are not condensed") {
  Random random(9);
  const MatrixX A = two_blocks(random);
  const auto condensed = [](const MatrixX& matrix, const std::vector<std::vector<int>>& candidates) {
    const SparseValues sparse(matrix);
    return CondensedPattern(sparse.pattern, candidates).blocks().size();
  };
  CHECK(condensed(A, both_blocks) == 2);
  CHECK(condensed(A, {}) == 0);
  CHECK(condensed(A, {numbers(0, CondensedPattern::least_block)}) == 1);
  CHECK(condensed(A, {numbers(0, CondensedPattern::least_block - 1)}) == 0);
  MatrixX diagonal = A;
  diagonal.topLeftCorner(block, block) = MatrixX::Identity(block, block);
  CHECK(condensed(diagonal, both_blocks) == 1);
  MatrixX coupled = A;
  coupled(2, size - 1) = 1;
  CHECK(condensed(coupled, both_blocks) == 1);  // the first; the other goes with the rest
  const VectorX b = random.vector(size);
  Both both(coupled);
  REQUIRE(both.factor(scale_of(1)) == FactorStatus::good);
  CHECK(both.condensed.condensed());
  CHECK(backward_error(coupled, solve(both.condensed, b), b) < rounding);
}

TEST_CASE("condensed factors depend on neither threads nor matrices before, once these are forgotten") {
  Random random(10);
  const MatrixX first = two_blocks(random), second = two_blocks(random);
  const VectorX b = random.vector(size);
  Both fresh(second);
  fresh.factor(scale_of(1));
  const VectorX expected = solve(fresh.condensed, b);
  const int threads = GENERATE(1, 2, 5);
  Both used(first);
  used.factor(scale_of(1), threads);
  used.sparse.set(second);
  used.condensed.forget();
  used.factor(scale_of(1), threads);
  CHECK(solve(used.condensed, b) == expected);
}
