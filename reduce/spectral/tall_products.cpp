#include "reduce/spectral/tall_products.hpp"

#include <algorithm>
#include <vector>

#include <omp.h>

#include "reduce/spectral/blas.hpp"
#include "reduce/spectral/dense_products.hpp"
#include "reduce/spectral/few_vectors.hpp"
#include "reduce/spectral/symmetric_matrix.hpp"

namespace bielle {

namespace {

constexpr Eigen::Index fewest_rows = 2000;  // fewer are not worth a thread

int sensible_threads(Eigen::Index rows, int threads) {
  return static_cast<int>(std::clamp<Eigen::Index>(rows / fewest_rows, 1, std::max(1, threads)));
}

struct RowRange {
  Eigen::Index first, count;
};

RowRange own_rows(Eigen::Index rows) {
  const Eigen::Index threads = omp_get_num_threads(), thread = omp_get_thread_num();
  const Eigen::Index first = rows * thread / threads;
  return {first, rows * (thread + 1) / threads - first};
}

/// More vectors than these are left to dgemm.
constexpr Eigen::Index few = 32;

/// Rows at a time: their vectors, by rows, stay in the nearer caches.
constexpr Eigen::Index strip = 512;

int padded(Eigen::Index vectors) {
  return static_cast<int>((vectors + vectors_abreast - 1) / vectors_abreast) * vectors_abreast;
}

/// Vectors by rows, as many as `padded` says, the last ones zero.
class Strip {
 public:
  explicit Strip(Eigen::Index vectors, Eigen::Index rows = strip) : rows_(RowMatrix::Zero(rows, padded(vectors))) {}
  double* data() { return rows_.data(); }
  Vectors vectors() const { return {0, static_cast<int>(rows_.cols()), static_cast<int>(rows_.cols())}; }
  void take(const ConstMatrixRef& columns) {
    each_number(columns.rows(), columns.cols(), columns.data(), columns.outerStride(),
                [](double& of_row, const double& of_column) { of_row = of_column; });
  }
  void give(MatrixRef columns) {
    each_number(columns.rows(), columns.cols(), columns.data(), columns.outerStride(),
                [](const double& of_row, double& of_column) { of_column = of_row; });
  }

 private:
  /// A few rows at a time, so that lines of the cache are written as a whole.
  template <class Number, class Work>
  void each_number(Eigen::Index rows, Eigen::Index count, Number* columns, Eigen::Index stride, const Work& work) {
    constexpr Eigen::Index few_rows = 8;
    for (Eigen::Index first = 0; first < rows; first += few_rows)
      for (Eigen::Index c = 0; c < count; ++c)
        for (Eigen::Index i = first; i < std::min(rows, first + few_rows); ++i)
          work(rows_.coeffRef(i, c), columns[c * stride + i]);
  }

  RowMatrix rows_;
};

/// Calls work(columns, first) for some columns of A at a time.
template <class Work>
void for_columns(const ConstMatrixRef& A, const Work& work) {
  for (Eigen::Index first = 0; first < A.cols(); first += lines_abreast) {
    const Eigen::Index columns = std::min<Eigen::Index>(lines_abreast, A.cols() - first);
    work(TallColumns{A.rows(), static_cast<int>(columns), A.data() + first * A.outerStride(), A.outerStride()}, first);
  }
}

/// X += A^T B
void add_inner_products(const ConstMatrixRef& A, const ConstMatrixRef& B, Eigen::MatrixXd& X) {
  if (B.cols() > few) return add_transposed_product(X, A, B);
  Strip y(B.cols()), x(B.cols(), A.cols());
  for (Eigen::Index row = 0; row < A.rows(); row += strip) {
    const Eigen::Index rows = std::min(strip, A.rows() - row);
    y.take(B.middleRows(row, rows));
    for_columns(A.middleRows(row, rows), [&](const TallColumns& columns, Eigen::Index first) {
      FewVectors::fastest().add_inner_products(columns, y.data(), x.data() + first * x.vectors().stride, x.vectors());
    });
  }
  x.give(X);
}

/// Y += A C
void add_few_columns(MatrixRef Y, const ConstMatrixRef& A, const Eigen::MatrixXd& C) {
  if (C.cols() > few) return add_product(Y, A, C, 1);
  Strip y(C.cols()), x(C.cols(), A.cols());
  x.take(C);
  for (Eigen::Index row = 0; row < A.rows(); row += strip) {
    const Eigen::Index rows = std::min(strip, A.rows() - row);
    y.take(Y.middleRows(row, rows));
    for_columns(A.middleRows(row, rows), [&](const TallColumns& columns, Eigen::Index first) {
      FewVectors::fastest().add_product(columns, x.data() + first * x.vectors().stride, y.data(), x.vectors());
    });
    y.give(Y.middleRows(row, rows));
  }
}

}  // namespace

Eigen::MatrixXd tall_inner_products(const ConstMatrixRef& A, const ConstMatrixRef& B, int threads) {
  const BlasThreads one(1);
  const int shares = sensible_threads(A.rows(), threads);
  std::vector<Eigen::MatrixXd> parts(static_cast<std::size_t>(shares), Eigen::MatrixXd::Zero(A.cols(), B.cols()));
#pragma omp parallel num_threads(shares)
  {
    const auto [first, count] = own_rows(A.rows());
    add_inner_products(A.middleRows(first, count), B.middleRows(first, count),
                       parts[static_cast<std::size_t>(omp_get_thread_num())]);
  }
  for (std::size_t k = 1; k < parts.size(); ++k) parts[0] += parts[k];
  return parts[0];
}

void add_tall_product(MatrixRef Y, const ConstMatrixRef& A, const Eigen::MatrixXd& C, double scale, int threads) {
  if (C.size() == 0) return;
  const BlasThreads one(1);
  const Eigen::MatrixXd scaled = scale * C;
#pragma omp parallel num_threads(sensible_threads(A.rows(), threads))
  {
    const auto [first, count] = own_rows(A.rows());
    add_few_columns(Y.middleRows(first, count), A.middleRows(first, count), scaled);
  }
}

void combine_columns(MatrixRef A, const Eigen::MatrixXd& C, int threads) {
  constexpr Eigen::Index panel = 512;
  const BlasThreads one(1);
  const int shares = sensible_threads(A.rows(), threads);
  std::vector<Eigen::MatrixXd> rooms(static_cast<std::size_t>(shares), Eigen::MatrixXd(panel, C.cols()));
#pragma omp parallel num_threads(shares)
  {
    const auto [first, count] = own_rows(A.rows());
    Eigen::MatrixXd& room = rooms[static_cast<std::size_t>(omp_get_thread_num())];
    for (Eigen::Index row = first; row < first + count; row += panel) {
      const Eigen::Index rows = std::min(panel, first + count - row);
      room.setZero();
      add_product(room.topRows(rows), A.block(row, 0, rows, C.rows()), C);
      A.block(row, 0, rows, C.cols()) = room.topRows(rows);
    }
  }
}

}  // namespace bielle
