#include "reduce/dense/tall_products.hpp"

#include <algorithm>
#include <vector>

#include <omp.h>

#include "reduce/dense/blas.hpp"
#include "reduce/dense/dense_products.hpp"

namespace bielle {

namespace {

constexpr Eigen::Index fewest_rows = 2000;  // with fewer rows, a further thread is not worth its cost

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

}  // namespace

Eigen::MatrixXd tall_inner_products(const ConstMatrixRef& A, const ConstMatrixRef& B, int threads) {
  const BlasThreads one(1);
  const int shares = sensible_threads(A.rows(), threads);
  std::vector<Eigen::MatrixXd> parts(static_cast<std::size_t>(shares), Eigen::MatrixXd::Zero(A.cols(), B.cols()));
#pragma omp parallel num_threads(shares)
  {
    const auto [first, count] = own_rows(A.rows());
    add_transposed_product(parts[static_cast<std::size_t>(omp_get_thread_num())], A.middleRows(first, count),
                           B.middleRows(first, count));
  }
  for (std::size_t k = 1; k < parts.size(); ++k) parts[0] += parts[k];
  return parts[0];
}

void add_tall_product(MatrixRef Y, const ConstMatrixRef& A, const Eigen::MatrixXd& C, double scale, int threads) {
  if (C.size() == 0) return;
  const BlasThreads one(1);
#pragma omp parallel num_threads(sensible_threads(A.rows(), threads))
  {
    const auto [first, count] = own_rows(A.rows());
    add_product(Y.middleRows(first, count), A.middleRows(first, count), C, scale);
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
