// Tests of the eigenpairs of largest magnitude of unsymmetric operators, by dense algebra and by ARPACK, on operators
// with known eigenvalues.
#include <cmath>

#include <catch2/catch.hpp>

#include "reduce/spectral/operator_eigenpairs.hpp"

using namespace bielle;
using Complex = std::complex<double>;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

namespace {

/// Returns a block triangular matrix, far from normal, with blocks [a b; -b a] and single numbers on its diagonal.
MatrixXd operator_with(const std::vector<Complex>& upper, int size) {
  MatrixXd T = MatrixXd::Zero(size, size);
  int row = 0;
  for (const Complex value : upper) {
    T(row, row) = value.real();
    if (value.imag() != 0) {
      T(row, row + 1) = value.imag();
      T(row + 1, row) = -value.imag();
      T(row + 1, row + 1) = value.real();
      ++row;
    }
    ++row;
  }
  for (int k = row; k < size; ++k) T(k, k) = 0.5 / (1 + k - row);
  for (int k = 0; k + 3 < size; ++k) T(k, k + 3) = 0.2;
  // Other coordinates hide the eigenvalues, which are no longer on the diagonal.
  MatrixXd mirror = MatrixXd::Identity(size, size);
  const VectorXd v = VectorXd::LinSpaced(size, -1, 1.3).normalized();
  mirror -= 2 * v * v.transpose();
  return mirror * T * mirror;
}

const std::vector<Complex> largest = {{3, 1}, {-2.5, 0}, {0, 2}, {1.5, 0}, {0.9, 0.3}};

template <class Scalar>
OperatorEigenpairs pairs_of(const MatrixXd& T, Eigen::Index count, Eigen::Index dense) {
  OperatorEigenOptions options;
  options.dense = dense;
  const Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> A = T.cast<Scalar>();
  return largest_eigenpairs(LinearOperator<Scalar>{T.rows(),
                                                   [&](const Eigen::Vector<Scalar, Eigen::Dynamic>& x) {
                                                     return Eigen::Vector<Scalar, Eigen::Dynamic>(A * x);
                                                   }},
                            count, options);
}

template <class Scalar>
void check_largest(Eigen::Index dense) {
  const MatrixXd T = operator_with(largest, 200);
  const OperatorEigenpairs pairs = pairs_of<Scalar>(T, 8, dense);
  REQUIRE(pairs.values.size() >= 8);
  CHECK(pairs.all == (dense > 0));
  int found = 0;
  for (const Complex value : largest)
    for (const Complex each : {value, std::conj(value)}) {
      for (Eigen::Index k = 0; k < pairs.values.size(); ++k)
        if (std::abs(pairs.values[k] - each) < 1e-9) {
          const VectorXcd x = pairs.vectors.col(k);
          CHECK((T.cast<Complex>() * x - pairs.values[k] * x).norm() < 1e-9);
          CHECK(pairs.residuals[k] < 1e-9);
          ++found;
          break;
        }
      if (value.imag() == 0) break;
    }
  CHECK(found == 8);
  for (Eigen::Index k = 1; k < pairs.values.size(); ++k)
    CHECK(std::abs(pairs.values[k]) <= std::abs(pairs.values[k - 1]) * (1 + 1e-9));
}

}  // namespace

TEST_CASE("the largest eigenpairs of an unsymmetric operator, real and complex, densely and by ARPACK") {
  check_largest<double>(300);
  check_largest<double>(0);
  check_largest<Complex>(300);
  check_largest<Complex>(0);
}

TEST_CASE("all copies of a multiple eigenvalue are found") {
  MatrixXd T = MatrixXd::Zero(300, 300);
  for (int k = 0; k < 300; ++k) T(k, k) = k < 9 ? 2 : 1.0 / (1 + k);
  for (int k = 9; k + 1 < 300; ++k) T(k, k + 1) = 0.1;
  const OperatorEigenpairs pairs = pairs_of<double>(T, 9, 0);
  long copies = 0;
  for (const Complex value : pairs.values) copies += std::abs(value - 2.0) < 1e-9 ? 1 : 0;
  CHECK(copies == 9);
}

TEST_CASE("an operator of dimension 0 has no eigenpairs") {
  const OperatorEigenpairs none = pairs_of<double>(MatrixXd(0, 0), 3, 300);
  CHECK(none.values.size() == 0);
  CHECK(none.all);
}
