// Sparse matrices with a fixed pattern, and their factorisation by KLU with the symbolic analysis kept.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "mechanism/math/types.hpp"

namespace bielle::mechanism {

/// Pattern of a square matrix in compressed columns, rows ascending.
class SparsePattern {
 public:
  SparsePattern() = default;
  /// @param entries  (row, column) pairs in any order, repeated or not
  SparsePattern(int size, std::vector<std::pair<int, int>> entries);
  int size() const { return size_; }
  int entry_count() const { return static_cast<int>(row_.size()); }
  const std::vector<int>& column_start() const { return column_start_; }
  const std::vector<int>& row() const { return row_; }
  /// Place of an entry among the values, or -1.
  int find(int row, int column) const;

 private:
  int size_ = 0;
  std::vector<int> column_start_, row_;
};

enum class FactorStatus { good, singular };

/// LU factors of a sparse unsymmetric matrix (KLU: fill-reducing ordering of diagonal blocks, partial pivoting).
///
/// `factor` reuses the pivot sequence of the previous call and falls back on fresh pivoting when that has grown
/// inaccurate; the ordering is found once per pattern.
class SparseLU {
 public:
  explicit SparseLU(const SparsePattern& pattern);  ///< the pattern must outlive the factors
  SparseLU(SparseLU&&) noexcept;
  ~SparseLU();

  /// @param values  in the order of the pattern
  FactorStatus factor(const std::vector<double>& values);
  /// Solves in place. Only after a good factorisation.
  void solve(Eigen::Ref<VectorX> b) const;
  /// Column (an unknown) at which the last factorisation found no pivot, or -1.
  int singular_column() const { return singular_column_; }
  /// Cheap estimate of the reciprocal condition number: smallest over largest pivot.
  double reciprocal_condition() const;

 private:
  struct Factors;
  const SparsePattern& pattern_;
  std::unique_ptr<Factors> factors_;
  int singular_column_ = -1;
};

}  // namespace bielle::mechanism
