// Dense matrices as sparse ones, and the residual of their equations at a solution.
#pragma once

#include <utility>
#include <vector>

#include "mechanism/math/sparse_pattern.hpp"
#include "mechanism/math/types.hpp"

namespace bielle::test {

/// A dense matrix as a pattern with values; zeros stay out.
struct SparseValues {
  mechanism::SparsePattern pattern;
  std::vector<double> values;
  explicit SparseValues(const mechanism::MatrixX& A) : pattern(pattern_of(A)) { set(A); }
  /// Values of another matrix at the same places.
  void set(const mechanism::MatrixX& A) {
    values.clear();
    for (int column = 0; column < pattern.size(); ++column)
      for (int k = pattern.column_start()[static_cast<std::size_t>(column)];
           k < pattern.column_start()[static_cast<std::size_t>(column) + 1]; ++k)
        values.push_back(A(pattern.row()[static_cast<std::size_t>(k)], column));
  }
  static mechanism::SparsePattern pattern_of(const mechanism::MatrixX& A) {
    std::vector<std::pair<int, int>> entries;
    for (int j = 0; j < A.cols(); ++j)
      for (int i = 0; i < A.rows(); ++i)
        if (A(i, j) != 0) entries.insert(entries.end(), 2, {i, j});  // repeated entries count once
    return mechanism::SparsePattern(static_cast<int>(A.rows()), entries);
  }
};

/// Returns the largest residual relative to |A| |x|, row by row: of the order of rounding for a stable solution.
inline double backward_error(const mechanism::MatrixX& A, const mechanism::VectorX& x, const mechanism::VectorX& b) {
  return ((A * x - b).cwiseAbs().array() / (A.cwiseAbs() * x.cwiseAbs()).array()).maxCoeff();
}

}  // namespace bielle::test
