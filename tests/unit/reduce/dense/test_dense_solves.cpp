#include <cmath>
#include <limits>

#include <catch2/catch.hpp>

#include "reduce/dense/dense_solves.hpp"
#include "reduce/dense/small_lu.hpp"
#include "reduce/dense/symmetric_factors.hpp"

using namespace bielle;
using Eigen::MatrixXd;

namespace {

/// The matrix is well-conditioned, and requires row exchanges.
MatrixXd general_matrix(Eigen::Index n) {
  MatrixXd A(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) A(i, j) = std::sin(1.0 + 3 * i + 7 * j * j) + (i == (j + 1) % n ? 4 : 0);
  return A;
}

}  // namespace

TEST_CASE("dense solves: LU with row exchanges", "[common]") {
  LUFactors factors;
  for (const Eigen::Index n : {1, 2, 7, 40, 3}) {
    CAPTURE(n);
    const MatrixXd A = general_matrix(n), B = MatrixXd::Random(n, 5);
    factors.compute(A);
    MatrixXd X(n, 5), inverse(n, n);
    factors.solve(B, X);
    CHECK((A * X - B).norm() < 1e-12 * B.norm());
    Eigen::VectorXd x(n);
    factors.solve(B.col(2), x);
    CHECK((x - X.col(2)).norm() < 1e-14 * X.norm());
    factors.set_inverse(inverse);
    CHECK((A * inverse - MatrixXd::Identity(n, n)).norm() < 1e-12);
    CHECK(factors.determinant() == Approx(A.determinant()));
    CHECK(factors.sign() == (A.determinant() < 0 ? -1 : 1));
    CHECK(std::abs(factors.pivots().prod()) == Approx(std::abs(A.determinant())));
  }
}

TEST_CASE("dense solves: LU of few rows", "[common]") {
  SmallLU factors;
  for (const Eigen::Index n : {1, 2, 7, 12, 40, 3}) {
    CAPTURE(n);
    const MatrixXd A = general_matrix(n), B = MatrixXd::Random(n, 5);
    factors.compute(A);
    CHECK(factors.determinant() == Approx(A.determinant()));
    Eigen::VectorXd x = B.col(0);
    factors.solve(x);
    CHECK((A * x - B.col(0)).norm() < 1e-12 * B.norm());
    x = B.col(1);
    factors.solve_transposed(x);
    CHECK((A.transpose() * x - B.col(1)).norm() < 1e-12 * B.norm());
    MatrixXd X = B;
    factors.solve_columns(X);
    CHECK((A * X - B).norm() < 1e-12 * B.norm());
  }
  MatrixXd singular = general_matrix(5);
  singular.col(2) = 2 * singular.col(0);
  factors.compute(singular);
  CHECK_FALSE(factors.determinant() > 1e-10);
  factors.compute(MatrixXd::Zero(3, 3));
  CHECK_FALSE(factors.determinant() > 0);
  factors.compute(MatrixXd::Constant(3, 3, std::numeric_limits<double>::quiet_NaN()));
  CHECK_FALSE(factors.determinant() > 0);
}

TEST_CASE("dense solves: symmetric matrices, definite or not", "[common]") {
  const MatrixXd G = general_matrix(6), A = G * G.transpose(), b = MatrixXd::Random(6, 2);
  CHECK(is_positive_definite(A));
  CHECK((A * solve_symmetric(A, b) - b).norm() < 1e-10 * b.norm());
  CHECK_FALSE(is_positive_definite(-A));
  MatrixXd indefinite = A;
  indefinite.row(2) *= -1;
  indefinite.col(2) *= -1;
  CHECK(is_positive_definite(indefinite));  // congruent to A, with the same inertia
  indefinite(2, 2) *= -1;
  CHECK_FALSE(is_positive_definite(indefinite));
  indefinite(0, 0) = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(is_positive_definite(indefinite));
  // A semidefinite matrix solves for the part of b in its range.
  const MatrixXd half = G.leftCols(3), S = half * half.transpose(), reached = S * b;
  CHECK((S * solve_symmetric(S, reached) - reached).norm() < 1e-8 * reached.norm());
}

TEST_CASE("dense solves: the inverse of a regular matrix", "[common]") {
  MatrixXd A = general_matrix(5);
  const auto inverse = regular_inverse(A);
  REQUIRE(inverse);
  CHECK((*inverse * A - MatrixXd::Identity(5, 5)).norm() < 1e-12);
  A.row(3) = A.row(0) - 2 * A.row(1);
  CHECK_FALSE(regular_inverse(A));
}
