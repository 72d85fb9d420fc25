// Sparse patterns and factors: solutions against dense ones, pivots that degenerate, rows of any units, singular
// matrices.
#include <cmath>

#include <Eigen/LU>
#include <catch2/catch.hpp>

#include "mechanism/math/sparse.hpp"
#include "tests/support/random.hpp"

using namespace bielle::mechanism;
using bielle::test::Random;

namespace {

/// A dense matrix as a pattern with values; zeros stay out but on the diagonal where `diagonal`.
struct Sparse {
  SparsePattern pattern;
  std::vector<double> values;
  explicit Sparse(const MatrixX& A) : pattern(pattern_of(A)) { set(A); }
  void set(const MatrixX& A) {
    values.clear();
    for (int column = 0; column < pattern.size(); ++column)
      for (int k = pattern.column_start()[static_cast<std::size_t>(column)];
           k < pattern.column_start()[static_cast<std::size_t>(column) + 1]; ++k)
        values.push_back(A(pattern.row()[static_cast<std::size_t>(k)], column));
  }
  static SparsePattern pattern_of(const MatrixX& A) {
    std::vector<std::pair<int, int>> entries;
    for (int j = 0; j < A.cols(); ++j)
      for (int i = 0; i < A.rows(); ++i)
        if (A(i, j) != 0) entries.insert(entries.end(), 2, {i, j});  // repeated entries count once
    return SparsePattern(static_cast<int>(A.rows()), entries);
  }
};

/// Largest residual beside |A| |x|, row by row: of the order of rounding for a stable solution.
double backward_error(const MatrixX& A, const VectorX& x, const VectorX& b) {
  return ((A * x - b).cwiseAbs().array() / (A.cwiseAbs() * x.cwiseAbs()).array()).maxCoeff();
}

/// [M B^T; B 0] with a random positive M and full-rank B: zeros on the diagonal.
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
    // Rows in other units: [N] and [MPa], say; the scale D is what the caller knows of its unknowns.
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

TEST_CASE("no equations have an empty solution") {
  const SparsePattern none(0, {});
  SparseLU lu(none);
  CHECK(lu.factor({}, VectorX()) == FactorStatus::good);
  VectorX x;
  lu.solve(x);
  CHECK(lu.reciprocal_condition() == 1);
}
