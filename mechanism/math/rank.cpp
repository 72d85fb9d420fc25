#include "mechanism/math/rank.hpp"

#include <algorithm>
#include <cmath>
#include <queue>
#include <stdexcept>

#include <SuiteSparseQR.hpp>
#include <fmt/format.h>

#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

/// Owner of the memory that CHOLMOD and SPQR allocate.
class Workspace {
 public:
  Workspace() { cholmod_l_start(&common); }
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;
  ~Workspace() {
    cholmod_l_free_sparse(&matrix, &common);
    cholmod_l_free_sparse(&R, &common);
    if (order) cholmod_l_free(columns, sizeof(SuiteSparse_long), order, &common);
    cholmod_l_finish(&common);
  }

  cholmod_common common;
  cholmod_sparse *matrix = nullptr, *R = nullptr;
  SuiteSparse_long* order = nullptr;
  std::size_t columns = 0;
};

void copy(const Matrix& A, Workspace& work) {
  work.columns = static_cast<std::size_t>(A.cols());
  work.matrix = cholmod_l_allocate_sparse(static_cast<std::size_t>(A.rows()), work.columns,
                                          static_cast<std::size_t>(A.nonZeros()), 1, 1, 0, CHOLMOD_REAL, &work.common);
  if (!work.matrix) throw std::bad_alloc();
  auto* starts = static_cast<SuiteSparse_long*>(work.matrix->p);
  auto* rows = static_cast<SuiteSparse_long*>(work.matrix->i);
  auto* values = static_cast<double*>(work.matrix->x);
  SuiteSparse_long count = 0;
  for (Eigen::Index column = 0; column < A.cols(); ++column) {
    starts[column] = count;
    for (Matrix::InnerIterator entry(A, column); entry; ++entry, ++count) {
      rows[count] = entry.row();
      values[count] = entry.value();
    }
  }
  starts[A.cols()] = count;
}

/// The factor R of a QR factorisation: a staircase with a step for each column that has a pivot.
struct Staircase {
  struct Entry {
    int row;
    double value;
  };
  std::vector<std::vector<Entry>> live;       ///< columns with a pivot, by their steps; rows ascending, the pivot last
  std::vector<std::vector<Entry>> dead;       ///< columns without a pivot
  std::vector<int> live_column, dead_column;  ///< their numbers in A
};

/// @param ordering  ordering of SPQR
Staircase eliminate(const Matrix& A, double tolerance, int ordering) {
  Staircase result;
  if (A.cols() == 0) return result;
  Workspace work;
  copy(A, work);
  if (SuiteSparseQR<double>(ordering, tolerance, A.cols(), work.matrix, &work.R, &work.order, &work.common) < 0)
    throw ComputationError(fmt::format(
        "the redundancy of the constraints could not be found: SPQR could not factorise their matrix (status {})",
        work.common.status));
  const auto* starts = static_cast<const SuiteSparse_long*>(work.R->p);
  const auto* rows = static_cast<const SuiteSparse_long*>(work.R->i);
  const auto* values = static_cast<const double*>(work.R->x);
  for (SuiteSparse_long k = 0; k < A.cols(); ++k) {
    std::vector<Staircase::Entry> entries;
    for (SuiteSparse_long e = starts[k]; e < starts[k + 1]; ++e)
      entries.push_back({static_cast<int>(rows[e]), values[e]});
    std::sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) { return a.row < b.row; });
    const int column = static_cast<int>(work.order ? work.order[k] : k);
    const bool has_pivot = !entries.empty() && entries.back().row == static_cast<int>(result.live.size());
    (has_pivot ? result.live : result.dead).push_back(std::move(entries));
    (has_pivot ? result.live_column : result.dead_column).push_back(column);
  }
  return result;
}

/// Returns the circuits as rows, with the columns of A counted from the last. @param least  coefficients smaller than
/// this count as zero
Matrix circuits_reversed(const Staircase& R, Eigen::Index columns, double least) {
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<double> left(R.live.size(), 0.0);
  std::vector<bool> waits(R.live.size(), false);
  for (std::size_t circuit = 0; circuit < R.dead.size(); ++circuit) {
    const auto add = [&](int column, double coefficient) {
      entries.emplace_back(static_cast<int>(circuit), static_cast<int>(columns) - 1 - column, coefficient);
    };
    add(R.dead_column[circuit], -1);
    // Back substitution visits only the few rows that take part.
    std::priority_queue<int> rows;
    const auto subtract = [&](int row, double value) {
      const auto i = static_cast<std::size_t>(row);
      left[i] += value;
      if (waits[i]) return;
      waits[i] = true;
      rows.push(row);
    };
    for (const auto [row, value] : R.dead[circuit]) subtract(row, value);
    while (!rows.empty()) {
      const auto step = static_cast<std::size_t>(rows.top());
      rows.pop();
      const auto& column = R.live[step];
      const double coefficient = left[step] / column.back().value;
      left[step] = 0;
      waits[step] = false;
      if (!(std::abs(coefficient) > least)) continue;
      add(R.live_column[step], coefficient);
      for (std::size_t k = 0; k + 1 < column.size(); ++k) subtract(column[k].row, -coefficient * column[k].value);
    }
  }
  Matrix circuits(static_cast<Eigen::Index>(R.dead.size()), columns);
  circuits.setFromTriplets(entries.begin(), entries.end());
  return circuits;
}

/// Returns A without some of its columns. @param without  numbers of these columns, ascending
Matrix remaining(const Matrix& A, const std::vector<int>& without) {
  std::vector<Eigen::Triplet<double>> entries;
  int kept = 0;
  for (int column = 0; column < A.cols(); ++column) {
    if (std::binary_search(without.begin(), without.end(), column)) continue;
    for (Matrix::InnerIterator entry(A, column); entry; ++entry)
      entries.emplace_back(static_cast<int>(entry.row()), kept, entry.value());
    ++kept;
  }
  Matrix result(A.rows(), kept);
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

}  // namespace

std::vector<int> dependent_columns(const Matrix& A, double tolerance) {
  const Staircase R = eliminate(A, tolerance, SPQR_ORDERING_COLAMD);
  if (R.dead.empty()) return {};
  const Staircase dual = eliminate(circuits_reversed(R, A.cols(), tolerance), tolerance, SPQR_ORDERING_FIXED);
  std::vector<int> dependent;
  for (const int column : dual.live_column) dependent.push_back(static_cast<int>(A.cols()) - 1 - column);
  std::sort(dependent.begin(), dependent.end());
  if (eliminate(remaining(A, dependent), tolerance, SPQR_ORDERING_COLAMD).dead.empty()) return dependent;
  // The remainder is so close to the tolerance that the order of elimination decides: the given order is used.
  dependent = eliminate(A, tolerance, SPQR_ORDERING_FIXED).dead_column;
  std::sort(dependent.begin(), dependent.end());
  return dependent;
}

}  // namespace bielle::mechanism
