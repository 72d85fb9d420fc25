#include "reduce/spectral/symmetric_matrix.hpp"

#include <algorithm>

#include "reduce/spectral/wide_products.hpp"

namespace bielle {

namespace {

/// y += A x for `width` columns, which a row of x and y consists of.
template <int width>
void add_product_of(const SymmetricMatrix& a, const double* x, double* y) {
  using Row = Eigen::Array<double, width, 1>;
  for (std::int64_t j = 0; j < a.size; ++j) {
    const Row xj = Eigen::Map<const Row>(x + j * width);
    Row sum = a.values[a.starts[j]] * xj;
    for (std::int64_t p = a.starts[j] + 1; p < a.starts[j + 1]; ++p) {
      const double entry = a.values[p];
      const std::int64_t at = a.rows[p] * width;
      Eigen::Map<Row>(y + at) += entry * xj;
      sum += entry * Eigen::Map<const Row>(x + at);
    }
    Eigen::Map<Row>(y + j * width) += sum;
  }
}

/// Y = A X for a number of columns that can be divided by four. Threads take columns of X rather than of A, so that no
/// two write the same number and sums keep their order. Each writes into its own: threads that write to the same lines
/// of the cache wait for each other.
void multiply_quads(const SymmetricMatrix& a, const RowMatrix& x, RowMatrix& y, int threads) {
  const Eigen::Index quads = x.cols() / vectors_in_quad, sharing = std::clamp<Eigen::Index>(threads, 1, quads);
  const Eigen::Index parts = (quads + most_quads * sharing - 1) / (most_quads * sharing) * sharing;
#pragma omp parallel num_threads(static_cast <int>(sharing))
  {
    RowMatrix own;
#pragma omp for schedule(static, 1)
    for (Eigen::Index part = 0; part < parts; ++part) {
      const Eigen::Index first = quads * part / parts, width = quads * (part + 1) / parts - first;
      if (width == 0) continue;
      own.setZero(x.rows(), vectors_in_quad * width);
      add_symmetric_product(a, static_cast<int>(width), x.data() + vectors_in_quad * first, x.cols(), own.data(),
                            own.cols());
      y.middleCols(vectors_in_quad * first, own.cols()) = own;
    }
  }
}

}  // namespace

RowMatrix SymmetricMatrix::multiply(const RowMatrix& x, int threads) const {
  RowMatrix y(x.rows(), x.cols());
  if (x.size() == 0) return y;
  if (x.cols() % vectors_in_quad == 0) {
    multiply_quads(*this, x, y, threads);
  } else if (x.cols() < vectors_in_quad) {
    y.setZero();
    (x.cols() == 1   ? add_product_of<1>
     : x.cols() == 2 ? add_product_of<2>
                     : add_product_of<3>)(*this, x.data(), y.data());
  } else {
    RowMatrix wider = RowMatrix::Zero(x.rows(), (x.cols() / vectors_in_quad + 1) * vectors_in_quad);
    wider.leftCols(x.cols()) = x;
    y = multiply(wider, threads).leftCols(x.cols());
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
