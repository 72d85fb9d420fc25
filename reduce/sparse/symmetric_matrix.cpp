#include "reduce/sparse/symmetric_matrix.hpp"

#include <algorithm>
#include <array>

namespace bielle {

namespace {

constexpr Eigen::Index widest = 8;  // columns at a time: their sums stay in registers

/// Computes y = A x for `width` columns. @param x  rows `stride` apart @param y  rows next to each other, zero to begin
/// with
template <int width>
void add_product_of(const SymmetricMatrix& a, const double* x, Eigen::Index stride, double* y) {
  using Row = Eigen::Array<double, width, 1>;
  for (std::int64_t j = 0; j < a.size; ++j) {
    const Row xj = Eigen::Map<const Row>(x + j * stride);
    Row sum = a.values[a.starts[j]] * xj;
    for (std::int64_t p = a.starts[j] + 1; p < a.starts[j + 1]; ++p) {
      const double entry = a.values[p];
      Eigen::Map<Row>(y + a.rows[p] * width) += entry * xj;
      sum += entry * Eigen::Map<const Row>(x + a.rows[p] * stride);
    }
    Eigen::Map<Row>(y + j * width) += sum;
  }
}

using Product = void (*)(const SymmetricMatrix&, const double*, Eigen::Index, double*);
constexpr std::array<Product, widest> products{add_product_of<1>, add_product_of<2>, add_product_of<3>,
                                               add_product_of<4>, add_product_of<5>, add_product_of<6>,
                                               add_product_of<7>, add_product_of<8>};

}  // namespace

RowMatrix SymmetricMatrix::multiply(const RowMatrix& x, int threads) const {
  // Threads divide the columns of x rather than the matrix, so that no two write the same number and sums keep their
  // order. Each writes into its own memory, since threads that write to the same cache lines wait for each other.
  RowMatrix y(x.rows(), x.cols());
  const Eigen::Index parts =
      std::min(x.cols(), std::max<Eigen::Index>((x.cols() + widest - 1) / widest, std::max(1, threads)));
#pragma omp parallel num_threads(std::max(1, threads))
  {
    RowMatrix own;
#pragma omp for schedule(static, 1)
    for (Eigen::Index part = 0; part < parts; ++part) {
      const Eigen::Index first = x.cols() * part / parts, width = x.cols() * (part + 1) / parts - first;
      own.setZero(x.rows(), width);
      products[static_cast<std::size_t>(width - 1)](*this, x.data() + first, x.cols(), own.data());
      y.middleCols(first, width) = own;
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
