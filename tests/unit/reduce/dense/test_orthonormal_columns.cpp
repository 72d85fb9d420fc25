// Tests of orthonormal columns that span the columns of a matrix: real and complex, of full and of lower rank.
#include <cmath>
#include <complex>
#include <limits>

#include <Eigen/Core>
#include <catch2/catch.hpp>

#include "reduce/dense/dense_products.hpp"
#include "reduce/dense/orthonormal_columns.hpp"

namespace test_orthonormal_columns {

using namespace bielle;
using Complex = std::complex<double>;

/// Returns pseudo-random numbers.
Eigen::MatrixXd numbers(Eigen::Index rows, Eigen::Index columns) {
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [](Eigen::Index i, Eigen::Index k) {
    const auto along = static_cast<double>(i), across = static_cast<double>(k);
    return std::sin(1 + 3.7 * along + 11.3 * across * across + 0.9 * along * across);
  });
}

Eigen::MatrixXcd complex_numbers(Eigen::Index rows, Eigen::Index columns) {
  Eigen::MatrixXcd result(rows, columns);
  result.real() = numbers(rows, columns);
  result.imag() = numbers(rows, columns + 1).rightCols(columns);
  return result;
}

/// Returns the largest entry of Q^H Q - I and of the part of A orthogonal to Q.
template <class Matrix>
double worst(const Matrix& A, const Matrix& Q) {
  const Matrix gram = Q.adjoint().lazyProduct(Q);
  const Matrix within = Q.adjoint().lazyProduct(A);
  const Matrix rest = A - Q.lazyProduct(within);
  return (gram - Matrix::Identity(Q.cols(), Q.cols())).cwiseAbs().maxCoeff() + rest.cwiseAbs().maxCoeff();
}

TEST_CASE("orthonormal columns span those of a matrix, real and complex") {
  for (const Eigen::Index columns : {1, 2, 7, 40, 41}) {
    CAPTURE(columns);
    const Eigen::MatrixXd A = numbers(41, columns);
    const Eigen::MatrixXd Q = orthonormal_columns(A);
    CHECK(Q.cols() == columns);
    CHECK(worst(A, Q) < 1e-12);
    const Eigen::MatrixXcd B = complex_numbers(41, columns);
    const Eigen::MatrixXcd P = orthonormal_columns(B);
    CHECK(P.cols() == columns);
    CHECK(worst(B, P) < 1e-12);
  }
}

TEST_CASE("dependent columns add nothing to an orthonormal basis") {
  Eigen::MatrixXd A(30, 9);
  A << numbers(30, 5), product(numbers(30, 5), numbers(5, 4));
  const Eigen::MatrixXd Q = orthonormal_columns(A);
  CHECK(Q.cols() == 5);
  CHECK(worst(A, Q) < 1e-12);
  Eigen::MatrixXcd B(30, 6);
  B << complex_numbers(30, 3), complex_numbers(30, 3) * Complex(0, 2);
  const Eigen::MatrixXcd P = orthonormal_columns(B);
  CHECK(P.cols() == 3);
  CHECK(worst(B, P) < 1e-12);
  CHECK(orthonormal_columns(numbers(4, 9)).cols() == 4);
}

TEST_CASE("a matrix of zeros, or without rows or columns, has no orthonormal columns") {
  CHECK(orthonormal_columns(Eigen::MatrixXd(Eigen::MatrixXd::Zero(5, 3))).cols() == 0);
  CHECK(orthonormal_columns(Eigen::MatrixXcd(Eigen::MatrixXcd::Zero(5, 3))).rows() == 5);
  CHECK(orthonormal_columns(Eigen::MatrixXd(5, 0)).rows() == 5);
  CHECK(orthonormal_columns(Eigen::MatrixXcd(0, 3)).cols() == 0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(orthonormal_columns(Eigen::MatrixXd(Eigen::MatrixXd::Constant(5, 3, nan))).cols() == 0);
}

}  // namespace test_orthonormal_columns
