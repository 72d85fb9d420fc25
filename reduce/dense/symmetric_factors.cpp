#include "reduce/dense/symmetric_factors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <cblas.h>

extern "C" {
void dpotrf_(const char* triangle, const int* n, double* a, const int* stride, int* info);
void dsytrf_(const char* triangle, const int* n, double* a, const int* stride, int* pivots, double* work,
             const int* size, int* info);
}

namespace bielle {

namespace {

/// Eigenvalues of a block of D, which has one row or two. @param second  whether the block has two rows
struct BlockValues {
  double low, high;
  BlockValues(const Eigen::MatrixXd& D, Eigen::Index k, bool two) : low(D(k, k)), high(D(k, k)) {
    if (!two) return;
    const double mean = (D(k, k) + D(k + 1, k + 1)) / 2, half = (D(k, k) - D(k + 1, k + 1)) / 2;
    const double radius = std::hypot(half, D(k + 1, k));
    low = mean - radius;
    high = mean + radius;
  }
};

}  // namespace

std::optional<Eigen::Index> factorise_definite(Eigen::MatrixXd& A) {
  const int n = static_cast<int>(A.rows()), stride = std::max(1, n);
  int info = 0;
  dpotrf_("L", &n, A.data(), &stride, &info);
  if (info > 0) return info - 1;
  for (Eigen::Index k = 0; k < n; ++k)
    if (!std::isfinite(A(k, k))) return k;  // OpenBLAS accepts pivots that are not numbers
  return {};
}

bool is_positive_definite(const ConstMatrixRef& A) {
  Eigen::MatrixXd L = A;
  return !factorise_definite(L);
}

void solve_definite(const Eigen::MatrixXd& L, Eigen::MatrixXd& B) {
  const int n = static_cast<int>(L.rows()), columns = static_cast<int>(B.cols());
  if (n == 0 || columns == 0) return;
  for (const auto order : {CblasNoTrans, CblasTrans})
    if (columns == 1)
      cblas_dtrsv(CblasColMajor, CblasLower, order, CblasNonUnit, n, L.data(), n, B.data(), 1);
    else
      cblas_dtrsm(CblasColMajor, CblasLeft, CblasLower, order, CblasNonUnit, n, columns, 1, L.data(), n, B.data(), n);
}

EigenvalueSigns eigenvalue_signs(Eigen::MatrixXd A, const Eigen::VectorXd& scale) {
  const int n = static_cast<int>(A.rows());
  if (n == 0) return {};
  const Eigen::ArrayXd shrink = scale.array().rsqrt();
  double largest = 0;
  for (Eigen::Index j = 0; j < n; ++j) {
    A.col(j).tail(n - j).array() *= shrink(j) * shrink.tail(n - j);
    const double of_column = A.col(j).tail(n - j).lpNorm<Eigen::Infinity>();
    if (!std::isfinite(of_column)) return {0, n};
    largest = std::max(largest, of_column);
  }
  std::vector<int> pivots(static_cast<std::size_t>(n));
  int info = 0, asked = -1;
  double best = 0;
  dsytrf_("L", &n, A.data(), &n, pivots.data(), &best, &asked, &info);
  std::vector<double> work(static_cast<std::size_t>(std::max(1.0, best)));
  const int size = static_cast<int>(work.size());
  dsytrf_("L", &n, A.data(), &n, pivots.data(), work.data(), &size, &info);
  // Rounding error of n products of numbers of that size.
  const double negligible = n * std::numeric_limits<double>::epsilon() * largest;
  EigenvalueSigns signs;
  const auto count = [&](double value) {
    signs.negative += value < 0;
    signs.unknown += !(std::abs(value) > negligible);
  };
  for (Eigen::Index k = 0; k < n; ++k) {
    const bool two = pivots[static_cast<std::size_t>(k)] < 0;
    const BlockValues block(A, k, two);
    count(block.low);
    if (two) count(block.high);
    k += two;
  }
  return signs;
}

}  // namespace bielle
