// Negative eigenvalues of K on the null space of B: against dense eigenvalues on a basis of that space.
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <catch2/catch.hpp>

#include "mechanism/math/negative_directions.hpp"
#include "reduce/dense/orthogonal_factors.hpp"
#include "reduce/dense/symmetric_eigenpairs.hpp"
#include "tests/support/random.hpp"

using namespace bielle::mechanism;
using bielle::test::Random;

namespace test_negative_directions {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

std::vector<int> each_alone(Eigen::Index n) {
  std::vector<int> group(static_cast<std::size_t>(n));
  for (std::size_t i = 0; i < group.size(); ++i) group[i] = static_cast<int>(i);
  return group;
}

std::optional<int> count(const MatrixX& K, const MatrixX& B, const std::vector<int>& group) {
  const Sparse sparse = K.sparseView(), rows = B.sparseView();
  return count_negative_directions(sparse, rows, group_sizes(sparse, rows, group));
}

std::optional<int> count(const MatrixX& K, const MatrixX& B) { return count(K, B, each_alone(K.rows())); }

}  // namespace

TEST_CASE("negative directions are those of K on the null space of B, in any units") {
  Random random(3);
  for (int trial = 0; trial < 20; ++trial) {
    CAPTURE(trial);
    constexpr int n = 12;
    const int m = trial % 6;
    const MatrixX A = random.matrix(n, n), B = random.matrix(m, n);
    const MatrixX K = A + A.transpose();
    const MatrixX Q = bielle::orthogonal_basis(B.transpose());
    const MatrixX allowed = Q.rightCols(n - m);
    const VectorX exact = bielle::symmetric_eigenpairs(allowed.transpose() * K * allowed).values;
    const int negative = static_cast<int>((exact.array() < 0).count());
    CHECK(count(K, B, {}) == count(K, B));
    CHECK(count(K, B) == negative);
    for (const double unit : {1e-6, 1e6}) {
      VectorX units = VectorX::Ones(n);
      for (int i = 0; i < n; i += 2) units[i] = unit;
      CHECK(count(units.asDiagonal() * K * units.asDiagonal(), unit * B * units.asDiagonal()) == negative);
    }
  }
}

TEST_CASE("a pendulum, which resists no displacement itself, is counted whatever its length") {
  // x = l phi and nothing but the stiffness m g l of the turn, negative if it stands.
  for (const double length : {1e-6, 1e-3, 1.0, 1e3, 1e6})
    for (const double sign : {1.0, -1.0}) {
      CAPTURE(length, sign);
      MatrixX K = MatrixX::Zero(4, 4), B = MatrixX::Zero(2, 4);
      K.diagonal() << 0, sign * length, 0, sign * length;  // two of them, the second on the first
      B << 1, -length, 0, 0, -1, 0, 1, -length;
      CHECK(count(K, B) == (sign < 0 ? 2 : 0));
      CHECK(count(K, MatrixX(3 * B)) == (sign < 0 ? 2 : 0));
      MatrixX repeated(4, 4);
      repeated << B, B;
      CHECK(count(K, repeated) == (sign < 0 ? 2 : 0));
    }
}

TEST_CASE("what rows of B hold does not give, however soft the rest is") {
  // A weight that slides without stiffness (1e-9, held) on a bar that would tilt under it: the bar is held.
  MatrixX K(2, 2), B(1, 2);
  K << 1e-9, 1, 1, 1;
  B << 0, 1;
  CHECK(count(K, B) == 0);
  K(0, 0) = -1e-9;
  CHECK(count(K, B) == 1);
}

TEST_CASE("what resists nothing is not negative, and small pivots do not decide") {
  CHECK(count(MatrixX(0, 0), MatrixX(0, 0)) == 0);
  CHECK(count(-MatrixX::Identity(1, 1), MatrixX(0, 1)) == 1);
  CHECK(count(MatrixX::Zero(2, 2), MatrixX(0, 2)) == 0);
  CHECK(count(MatrixX::Zero(2, 2), MatrixX::Identity(2, 2)) == 0);
  CHECK(count(MatrixX::Zero(2, 2), MatrixX::Zero(1, 2)) == 0);
  // Saddles without diagonal entries, which elimination in any order meets with a zero pivot.
  for (const double zero : {0.0, 1e-18, -1e-18}) {
    MatrixX saddle(3, 3);
    saddle << zero, 1, 0, 1, zero, 1, 0, 1, zero;
    CHECK(count(saddle, MatrixX(0, 3), {0, 1, 2}) == 1);  // 0 and +- sqrt(2)
    CHECK(count(saddle, MatrixX(0, 3), {0, 0, 0}) == 1);
  }
}

}  // namespace test_negative_directions
