#include "reduce/spectral/symmetric_matrix.hpp"

#include <algorithm>

#include <omp.h>

namespace bielle {

RowMatrix SymmetricMatrix::multiply(const RowMatrix& x, int threads) const {
  RowMatrix y = RowMatrix::Zero(x.rows(), x.cols());
  const Eigen::Index columns = x.cols();
  // Threads take columns of x rather than of A, so that no two write the same number and sums keep their order.
#pragma omp parallel num_threads(std::max(1, std::min <int>(threads, static_cast <int>(columns))))
  {
    const Eigen::Index count = omp_get_num_threads(), thread = omp_get_thread_num();
    const Eigen::Index first = columns * thread / count, width = columns * (thread + 1) / count - first;
    for (std::int64_t j = 0; j < size; ++j) {
      const double* xj = &x.coeffRef(j, 0) + first;
      double* yj = &y.coeffRef(j, 0) + first;
      const double diagonal_entry = values[starts[j]];
      for (Eigen::Index c = 0; c < width; ++c) {
        yj[c] += diagonal_entry * xj[c];
      }
      for (std::int64_t p = starts[j] + 1; p < starts[j + 1]; ++p) {
        const double a = values[p];
        const double* xi = &x.coeffRef(rows[p], 0) + first;
        double* yi = &y.coeffRef(rows[p], 0) + first;
        for (Eigen::Index c = 0; c < width; ++c) {
          yi[c] += a * xj[c];
          yj[c] += a * xi[c];
        }
      }
    }
  }
  return y;
}

Eigen::VectorXd SymmetricMatrix::diagonal() const {
  Eigen::VectorXd result(size);
  for (std::int64_t j = 0; j < size; ++j) {
    result(j) = values[starts[j]];
  }
  return result;
}

SymmetricMatrix principal_submatrix(const SymmetricMatrix& a, std::span<const std::int64_t> kept) {
  std::vector<std::int64_t> number(a.size, -1);
  for (std::size_t k = 0; k < kept.size(); ++k) {
    number[kept[k]] = static_cast<std::int64_t>(k);
  }
  SymmetricMatrix result;
  result.size = static_cast<std::int64_t>(kept.size());
  result.starts.reserve(kept.size() + 1);
  std::int64_t entries = 0;
  for (const std::int64_t j : kept) {
    for (std::int64_t p = a.starts[j]; p < a.starts[j + 1]; ++p) {
      entries += number[a.rows[p]] >= 0;
    }
    result.starts.push_back(entries);
  }
  result.rows.reserve(entries);
  result.values.reserve(entries);
  for (const std::int64_t j : kept) {
    for (std::int64_t p = a.starts[j]; p < a.starts[j + 1]; ++p) {
      if (const std::int64_t i = number[a.rows[p]]; i >= 0) {
        result.rows.push_back(i);
        result.values.push_back(a.values[p]);
      }
    }
  }
  return result;
}

SymmetricMatrix bordered(const SymmetricMatrix& a, const Eigen::MatrixXd& b, const Eigen::MatrixXd& c) {
  const std::int64_t k = b.cols();
  SymmetricMatrix result;
  result.size = a.size + k;
  result.rows.reserve(a.rows.size() + b.size() + k * (k + 1) / 2);
  result.values.reserve(result.rows.capacity());
  for (std::int64_t j = 0; j < a.size; ++j) {
    result.rows.insert(result.rows.end(), a.rows.begin() + a.starts[j], a.rows.begin() + a.starts[j + 1]);
    result.values.insert(result.values.end(), a.values.begin() + a.starts[j], a.values.begin() + a.starts[j + 1]);
    for (std::int64_t i = 0; i < k; ++i) {
      if (b(j, i) != 0) {
        result.rows.push_back(a.size + i);
        result.values.push_back(b(j, i));
      }
    }
    result.starts.push_back(static_cast<std::int64_t>(result.rows.size()));
  }
  for (std::int64_t j = 0; j < k; ++j) {
    for (std::int64_t i = j; i < k; ++i) {
      result.rows.push_back(a.size + i);
      result.values.push_back(c(i, j));
    }
    result.starts.push_back(static_cast<std::int64_t>(result.rows.size()));
  }
  return result;
}

SymmetricMatrix sparse_lower(const Eigen::MatrixXd& a) {
  SymmetricMatrix result;
  result.size = a.rows();
  for (Eigen::Index j = 0; j < a.cols(); ++j) {
    for (Eigen::Index i = j; i < a.rows(); ++i) {
      if (i == j || a(i, j) != 0) {
        result.rows.push_back(i);
        result.values.push_back(a(i, j));
      }
    }
    result.starts.push_back(static_cast<std::int64_t>(result.rows.size()));
  }
  return result;
}

}  // namespace bielle
