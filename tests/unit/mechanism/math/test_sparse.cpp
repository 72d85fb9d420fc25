// Sparse patterns and factors: solutions against dense ones, pivots that degenerate, rows of any units, singular
// matrices; the ordering that is cheapest.
#include <algorithm>
#include <cmath>
#include <complex>

#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <klu.h>

#include "mechanism/math/sparse_factors.hpp"
#include "tests/support/random.hpp"
#include "tests/support/sparse_values.hpp"

using namespace bielle::mechanism;
using bielle::test::backward_error;
using bielle::test::Random;
using Sparse = bielle::test::SparseValues;

namespace {

/// Returns [M B^T; B 0] with a random positive M and full-rank B: zeros on the diagonal.
MatrixX saddle(Random& random, int n, int m) {
  MatrixX A = MatrixX::Zero(n + m, n + m);
  A.topLeftCorner(n, n) = random.positive_matrix(n);
  A.bottomLeftCorner(m, n) = random.matrix(m, n);
  A.topRightCorner(n, m) = A.bottomLeftCorner(m, n).transpose();
  return A;
}

}  // namespace

TEST_CASE("a sparse pattern finds its entries") {
  MatrixX A(3, 3);
  A << 1, 0, 2, 0, 3, 0, 4, 0, 0;
  const Sparse sparse(A);
  CHECK(sparse.pattern.entry_count() == 4);
  CHECK(sparse.values == std::vector<double>{1, 4, 3, 2});
  CHECK(sparse.pattern.find(2, 0) == 1);
  CHECK(sparse.pattern.find(2, 2) == -1);
}

TEST_CASE("factors solve equations with constraints, whatever the scale of unknowns and equations") {
  Random random(1);
  for (const double size : {1.0, 1e8, 1e-8}) {
    // Rows in other units, such as [N] and [MPa]; the scale D contains the caller's knowledge of its unknowns.
    MatrixX A = saddle(random, 12, 4);
    for (int i = 0; i < 16; i += 3) A.row(i) *= size;
    const Sparse sparse(A);
    SparseLU lu(sparse.pattern);
    VectorX scale = VectorX::Ones(16);
    scale.tail(4).setConstant(1e3);
    REQUIRE(lu.factor(sparse.values, scale) == FactorStatus::good);
    const VectorX b = random.vector(16);
    VectorX x = b;
    lu.solve(x);
    CHECK(backward_error(A, x, b) < 1e-13);
    CHECK(lu.singular_column() == -1);
    CHECK(lu.reciprocal_condition() > 1e-9);  // D brings 1e-6 between pivots
  }
}

TEST_CASE("factors stay good while the matrix changes and old pivots vanish") {
  Random random(2);
  const MatrixX start = saddle(random, 8, 2);
  const Sparse sparse(start);
  SparseLU lu(sparse.pattern);
  const VectorX scale = VectorX::Ones(10), b = random.vector(10);
  for (int k = 0; k <= 40; ++k) {
    // The diagonal, on which the first pivots stand, fades away over fourteen decades.
    MatrixX A = start;
    A.diagonal() *= std::pow(10.0, -0.35 * k);
    Sparse now = sparse;
    now.set(A);
    REQUIRE(lu.factor(now.values, scale) == FactorStatus::good);
    VectorX x = b;
    lu.solve(x);
    INFO("step " << k);
    CHECK((A * x - b).norm() < 1e-10 * (A.norm() * x.norm() + b.norm()));
  }
}

TEST_CASE("a singular matrix names a column, and the factors recover") {
  Random random(3);
  const MatrixX good = saddle(random, 6, 2);
  const Sparse sparse(good);
  const VectorX scale = VectorX::Ones(8), b = random.vector(8);
  MatrixX bad = good;
  bad.col(3).setZero();
  bad.row(3).setZero();
  Sparse singular = sparse;
  singular.set(bad);
  const auto check_good = [&](SparseLU& lu) {
    REQUIRE(lu.factor(sparse.values, scale) == FactorStatus::good);
    VectorX x = b;
    lu.solve(x);
    CHECK(backward_error(good, x, b) < 1e-13);
  };
  {
    SparseLU lu(sparse.pattern);
    CHECK(lu.factor(singular.values, scale) == FactorStatus::singular);
    CHECK(lu.singular_column() == 3);
    check_good(lu);
  }
  {
    SparseLU lu(sparse.pattern);
    check_good(lu);
    CHECK(lu.factor(singular.values, scale) == FactorStatus::singular);
    CHECK(lu.singular_column() == 3);
    check_good(lu);
  }
}

TEST_CASE("complex factors solve complex equations, also with old pivots and equations of any scale") {
  Random random(7);
  const int n = 16;
  const MatrixX real = saddle(random, 12, 4), imaginary = saddle(random, 12, 4);
  const Sparse sparse(real);
  ComplexSparseLU lu(sparse.pattern);
  VectorX scale = VectorX::Ones(n);
  scale.tail(4).setConstant(1e3);
  const Eigen::VectorXcd b = random.vector(n) + std::complex<double>(0, 1) * random.vector(n);
  for (const double share : {1.0, 0.9, -1e6, 0.0}) {
    const Eigen::MatrixXcd A = real + std::complex<double>(0, share) * imaginary;
    std::vector<std::complex<double>> values;
    sparse.pattern.for_each([&](int, int row, int column) { values.push_back(A(row, column)); });
    REQUIRE(lu.factor(values, scale) == FactorStatus::good);
    Eigen::VectorXcd x = b;
    lu.solve(x);
    CHECK((A * x - b).norm() < 1e-12 * (A.norm() * x.norm() + b.norm()));
    CHECK(lu.reciprocal_condition() > 1e-9);
  }
  std::vector<std::complex<double>> singular(static_cast<std::size_t>(sparse.pattern.entry_count()), {1, 2});
  sparse.pattern.for_each([&](int k, int row, int column) {
    if (row == 3 || column == 3) singular[static_cast<std::size_t>(k)] = 0;
  });
  CHECK(lu.factor(singular, scale) == FactorStatus::singular);
}

TEST_CASE("no equations have an empty solution") {
  const SparsePattern none(0, {});
  SparseLU lu(none);
  CHECK(lu.factor({}, VectorX()) == FactorStatus::good);
  VectorX x;
  lu.solve(x);
  CHECK(lu.reciprocal_condition() == 1);
}

namespace {

/// Returns the cost of factors by one of KLU's orderings alone.
FactorCost cost_by(const Sparse& sparse, int ordering) {
  const SparsePattern& pattern = sparse.pattern;
  int *start = const_cast<int*>(pattern.column_start().data()), *row = const_cast<int*>(pattern.row().data());
  std::vector<double> values = sparse.values, largest(static_cast<std::size_t>(pattern.size()), 0.0);
  pattern.for_each([&](int k, int i, int) {
    double& most = largest[static_cast<std::size_t>(i)];
    most = std::max(most, std::abs(values[static_cast<std::size_t>(k)]));
  });
  pattern.for_each(
      [&](int k, int i, int) { values[static_cast<std::size_t>(k)] /= largest[static_cast<std::size_t>(i)]; });
  klu_common common;
  klu_defaults(&common);
  common.scale = -1;
  common.btf = 0;
  common.ordering = ordering;
  klu_symbolic* symbolic = klu_analyze(pattern.size(), start, row, &common);
  klu_numeric* numeric = klu_factor(start, row, values.data(), symbolic, &common);
  klu_flops(symbolic, numeric, &common);
  const FactorCost cost{common.flops, static_cast<double>(numeric->lnz) + static_cast<double>(numeric->unz)};
  klu_free_numeric(&numeric, &common);
  klu_free_symbolic(&symbolic, &common);
  return cost;
}

FactorCost cost_of(const Sparse& sparse) {
  SparseLU lu(sparse.pattern);
  REQUIRE(lu.factor(sparse.values, VectorX::Ones(sparse.pattern.size())) == FactorStatus::good);
  return lu.cost();
}

/// Returns the stiffness of a square net of n by n springs: pivots stay on the diagonal.
MatrixX net(int n) {
  MatrixX A = MatrixX::Identity(n * n, n * n);
  const auto spring = [&](int a, int b) {
    A(a, a) += 1;
    A(b, b) += 1;
    A(a, b) = A(b, a) = -1;
  };
  for (int i = 0; i < n; ++i)
    for (int k = 0; k + 1 < n; ++k) {
      spring(n * i + k, n * i + k + 1);
      spring(n * k + i, n * k + n + i);
    }
  return A;
}

/// Returns a ladder of four-bars: an upper bar, a lower one and a rung for each loop, of six unknowns each, all upper
/// hinges first; the last hinge of each loop has two rows, since three repeat others. Rows of constraints have no
/// diagonal.
MatrixX four_bars(Random& random, int loops) {
  const int dofs = 18 * loops, rows = 17 * loops;
  MatrixX A = MatrixX::Zero(dofs + rows, dofs + rows);
  A.diagonal().head(dofs).setOnes();
  int row = dofs;
  const auto add_hinge = [&](int a, int b, int count) {
    for (const int body : {a, b}) {
      if (body < 0) continue;  // the ground
      A.block(row, 6 * body, count, 6) = random.matrix(count, 6);
      A.block(6 * body, row, 6, count) = A.block(row, 6 * body, count, 6).transpose();
    }
    row += count;
  };
  for (const int side : {0, 1})
    for (int k = 0; k < loops; ++k) {
      add_hinge(3 * k - 1, 3 * k + side, 5);
      add_hinge(3 * k + side, 3 * k + 2, side == 0 ? 5 : 2);
    }
  return A;
}

}  // namespace

TEST_CASE("of two orderings the one that makes fewer operations of the matrix is taken") {
  constexpr int minimum_degree = 0, column_minimum_degree = 1;
  Random random(4);
  const Sparse springs(net(20)), bars(four_bars(random, 24));
  // Minimum degree is suitable for the net.
  CHECK(cost_by(springs, minimum_degree).operations < 0.7 * cost_by(springs, column_minimum_degree).operations);
  CHECK(cost_of(springs).operations == cost_by(springs, minimum_degree).operations);
  // Constraints require pivots off the diagonal: the best ordering is measured.
  CHECK(cost_of(bars).operations ==
        std::min(cost_by(bars, minimum_degree).operations, cost_by(bars, column_minimum_degree).operations));
}

TEST_CASE("minimum degree is left where pivots leave the diagonal later") {
  // At first the diagonal is large, and minimum degree is chosen. Later the constraints have no diagonal.
  Random random(5);
  constexpr int loops = 24, size = 35 * loops;
  MatrixX A = four_bars(random, loops);
  const Sparse before(A + 100 * MatrixX::Identity(size, size));
  Sparse after = before;
  after.set(A);
  SparseLU lu(before.pattern);
  const VectorX scale = VectorX::Ones(size), b = random.vector(size);
  REQUIRE(lu.factor(before.values, scale) == FactorStatus::good);
  REQUIRE(lu.cost().operations == cost_by(before, 0).operations);
  REQUIRE(lu.factor(after.values, scale) == FactorStatus::good);
  // The bound is twice the number of entries that column minimum degree needed before.
  CHECK(lu.cost().entries <= 2 * cost_by(before, 1).entries + 2 * size);
  VectorX x = b;
  lu.solve(x);
  CHECK((A * x - b).norm() < 1e-10 * (A.norm() * x.norm() + b.norm()));
}

TEST_CASE("factors that forget are those of a new start") {
  Random random(6);
  const Sparse first(four_bars(random, 20)), other(four_bars(random, 20));
  const VectorX scale = VectorX::Ones(first.pattern.size()), b = random.vector(first.pattern.size());
  SparseLU used(first.pattern), fresh(first.pattern);
  REQUIRE(used.factor(first.values, scale) == FactorStatus::good);
  used.forget();
  REQUIRE(used.factor(other.values, scale) == FactorStatus::good);
  REQUIRE(fresh.factor(other.values, scale) == FactorStatus::good);
  VectorX x = b, y = b;
  used.solve(x);
  fresh.solve(y);
  CHECK(x == y);
}

TEST_CASE("entries that are zero most of the time come into the factors and leave them") {
  // Blocks of three on the diagonal; the coupling terms are intermittent.
  Random random(5);
  constexpr int n = 24;
  MatrixX A = random.matrix(n, n);  // every entry in the pattern
  Sparse sparse(A);
  std::vector<int> intermittent;
  sparse.pattern.for_each([&](int place, int row, int column) {
    if (row / 3 != column / 3) intermittent.push_back(place);
  });
  sparse.pattern.set_intermittent(intermittent);
  SparseLU lu(sparse.pattern);
  const VectorX b = random.vector(n);
  double entries_alone = 0;
  for (const int coupled : {0, 2, 5, 1, 0}) {
    // The first few blocks are coupled with each other.
    MatrixX now = MatrixX::Zero(n, n);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        if (i / 3 == j / 3 || (i / 3 < coupled && j / 3 < coupled)) now(i, j) = A(i, j) + (i == j ? 5 : 0);
    std::vector<double> values;
    sparse.pattern.for_each([&](int, int row, int column) { values.push_back(now(row, column)); });
    REQUIRE(lu.factor(values, VectorX::Ones(n)) == FactorStatus::good);
    VectorX x = b;
    lu.solve(x);
    CHECK(backward_error(now, x, b) < 1e-13);
    if (entries_alone == 0) entries_alone = lu.cost().entries;
    CHECK(lu.cost().entries < n * n);
  }
  CHECK(entries_alone == 8 * 12);  // both triangles of 3 x 3, with their diagonals
  lu.forget();
}
