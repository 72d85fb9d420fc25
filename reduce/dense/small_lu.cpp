#include "reduce/dense/small_lu.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace bielle {

using Eigen::Index;

void SmallLU::compute(const Eigen::MatrixXd& A) {
  n_ = A.rows();
  values_.assign(A.data(), A.data() + A.size());
  exchange_.resize(static_cast<std::size_t>(n_));
  determinant_ = 1;
  for (Index k = 0; k < n_; ++k) {
    double* pivots = values_.data() + k * n_;
    Index best = k;
    for (Index i = k + 1; i < n_; ++i)
      if (std::abs(pivots[i]) > std::abs(pivots[best])) best = i;
    exchange_[static_cast<std::size_t>(k)] = best;
    if (best != k) {
      for (Index j = 0; j < n_; ++j)
        std::swap(values_[static_cast<std::size_t>(k + j * n_)], values_[static_cast<std::size_t>(best + j * n_)]);
      determinant_ = -determinant_;
    }
    determinant_ *= pivots[k];
    const double reciprocal = 1 / pivots[k];
    for (Index i = k + 1; i < n_; ++i) pivots[i] *= reciprocal;
    Index j = k + 1;
    for (; j + 1 < n_; j += 2) {  // columns in pairs share the values of the pivot's column
      double *first = values_.data() + j * n_, *second = first + n_;
      const double a = first[k], b = second[k];
      for (Index i = k + 1; i < n_; ++i) {
        first[i] -= a * pivots[i];
        second[i] -= b * pivots[i];
      }
    }
    if (j < n_) {
      double* column = values_.data() + j * n_;
      for (Index i = k + 1; i < n_; ++i) column[i] -= column[k] * pivots[i];
    }
  }
}

void SmallLU::solve(Eigen::Ref<Eigen::VectorXd> x) const {
  for (Index k = 0; k < n_; ++k) std::swap(x[k], x[exchange_[static_cast<std::size_t>(k)]]);
  for (Index j = 0; j < n_; ++j) {
    const double* column = values_.data() + j * n_;
    const double factor = x[j];
    for (Index i = j + 1; i < n_; ++i) x[i] -= factor * column[i];
  }
  for (Index j = n_; j-- > 0;) {
    const double* column = values_.data() + j * n_;
    const double factor = x[j] /= column[j];
    for (Index i = 0; i < j; ++i) x[i] -= factor * column[i];
  }
}

void SmallLU::solve_transposed(Eigen::Ref<Eigen::VectorXd> x) const {
  for (Index j = 0; j < n_; ++j) {
    const double* column = values_.data() + j * n_;
    double sum = x[j];
    for (Index i = 0; i < j; ++i) sum -= column[i] * x[i];
    x[j] = sum / column[j];
  }
  for (Index j = n_; j-- > 0;) {
    const double* column = values_.data() + j * n_;
    double sum = x[j];
    for (Index i = j + 1; i < n_; ++i) sum -= column[i] * x[i];
    x[j] = sum;
  }
  for (Index k = n_; k-- > 0;) std::swap(x[k], x[exchange_[static_cast<std::size_t>(k)]]);
}

void SmallLU::solve_columns(Eigen::MatrixXd& X) const {
  for (Index j = 0; j < X.cols(); ++j) solve(X.col(j));
}

}  // namespace bielle
