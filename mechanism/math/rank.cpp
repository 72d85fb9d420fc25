#include "mechanism/math/rank.hpp"

#include <algorithm>
#include <stdexcept>

#include <SuiteSparseQR.hpp>

namespace bielle::mechanism {

std::vector<int> dependent_columns(const Eigen::SparseMatrix<double>& A, double tolerance) {
  if (A.cols() == 0) return {};
  cholmod_common common;
  cholmod_l_start(&common);
  cholmod_sparse* matrix =
      cholmod_l_allocate_sparse(static_cast<std::size_t>(A.rows()), static_cast<std::size_t>(A.cols()),
                                static_cast<std::size_t>(A.nonZeros()), 1, 1, 0, CHOLMOD_REAL, &common);
  if (!matrix) throw std::bad_alloc();
  auto* starts = static_cast<SuiteSparse_long*>(matrix->p);
  auto* rows = static_cast<SuiteSparse_long*>(matrix->i);
  auto* values = static_cast<double*>(matrix->x);
  SuiteSparse_long count = 0;
  for (Eigen::Index column = 0; column < A.cols(); ++column) {
    starts[column] = count;
    for (Eigen::SparseMatrix<double>::InnerIterator entry(A, column); entry; ++entry, ++count) {
      rows[count] = entry.row();
      values[count] = entry.value();
    }
  }
  starts[A.cols()] = count;
  // In the given order R is a staircase: a column that does not reach one row deeper than those before it is dependent.
  cholmod_sparse* R = nullptr;
  SuiteSparse_long* order = nullptr;
  const SuiteSparse_long rank =
      SuiteSparseQR<double>(SPQR_ORDERING_FIXED, tolerance, A.cols(), matrix, &R, &order, &common);
  std::vector<int> dependent;
  if (rank >= 0) {
    const auto* R_starts = static_cast<const SuiteSparse_long*>(R->p);
    const auto* R_rows = static_cast<const SuiteSparse_long*>(R->i);
    SuiteSparse_long live = 0;
    for (SuiteSparse_long k = 0; k < A.cols(); ++k) {
      SuiteSparse_long deepest = -1;
      for (SuiteSparse_long e = R_starts[k]; e < R_starts[k + 1]; ++e) deepest = std::max(deepest, R_rows[e]);
      if (deepest == live)
        ++live;
      else
        dependent.push_back(static_cast<int>(order ? order[k] : k));
    }
  }
  std::sort(dependent.begin(), dependent.end());
  cholmod_l_free_sparse(&R, &common);
  if (order) cholmod_l_free(static_cast<std::size_t>(A.cols()), sizeof(SuiteSparse_long), order, &common);
  cholmod_l_free_sparse(&matrix, &common);
  cholmod_l_finish(&common);
  if (rank < 0) throw std::runtime_error("SPQR could not factorise the constraint matrix");
  return dependent;
}

}  // namespace bielle::mechanism
