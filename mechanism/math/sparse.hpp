// Sparse matrices with a fixed pattern, and their factorisation by KLU with the symbolic analysis kept.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "mechanism/math/types.hpp"

namespace bielle::mechanism {

class FillOrderings;

/// Pattern of a square matrix in compressed columns, rows ascending.
class SparsePattern {
 public:
  SparsePattern() : SparsePattern(0, {}) {}
  /// @param entries  (row, column) pairs in any order, repeated or not
  SparsePattern(int size, std::vector<std::pair<int, int>> entries);
  /// @param column_start  (size + 1)
  /// @param row  of each entry, ascending within a column, each once
  SparsePattern(std::vector<int> column_start, std::vector<int> row);
  int size() const { return size_; }
  int entry_count() const { return static_cast<int>(row_.size()); }
  const std::vector<int>& column_start() const { return column_start_; }
  const std::vector<int>& row() const { return row_; }
  /// Calls act(place, row, column) for each entry, by columns.
  template <class Act>
  void for_each(const Act& act) const {
    for (int column = 0; column < size_; ++column)
      for (int k = column_start_[static_cast<std::size_t>(column)];
           k < column_start_[static_cast<std::size_t>(column) + 1]; ++k)
        act(k, row_[static_cast<std::size_t>(k)], column);
  }
  /// Place of an entry among the values, or -1.
  int find(int row, int column) const;
  /// Entries that are zero most of the time (of bodies that may touch): factors leave out those that are zero.
  /// @param places  ascending
  void set_passing(std::vector<int> places) { passing_ = std::move(places); }
  const std::vector<int>& passing() const { return passing_; }
  /// Fill-reducing orderings: functions of the pattern alone, found when first asked for and shared by all factors and
  /// copies, in any number of threads.
  const FillOrderings& orderings() const { return *orderings_; }

 private:
  int size_ = 0;
  std::vector<int> column_start_, row_, passing_;
  std::shared_ptr<const FillOrderings> orderings_;
};

enum class FactorStatus { good, singular };

/// What factors cost.
struct FactorCost {
  double operations = 0;  ///< of one factorisation with known pivots
  double entries = 0;     ///< of both factors
};

/// LU factors of a sparse unsymmetric matrix (KLU with partial pivoting).
///
/// The fill-reducing ordering is chosen with the first matrix. Column minimum degree (COLAMD) bounds the fill whatever
/// rows the pivots come from. Minimum degree (AMD) makes fewer operations where pivots stay on the diagonal, and
/// any number more where they leave it, as constraints make them: of loops, a thousand times as many. It is tried where
/// its estimate, which knows of no pivoting, promises fewer operations, given up as soon as its factors need as much
/// memory as those of COLAMD, and taken where it has made fewer operations. So the choice is a function of this matrix,
/// not of any before.
///
/// `factor` keeps the pivot sequence as long as its pivots do not degenerate. Rows are brought to entries of size one
/// when pivots are chosen, whatever their units.
///
/// Of a pattern with passing entries those are factorised that are not zero, and those that have not been before, until
/// they are many: what comes in makes ordering and pivots new.
class SparseLU {
 public:
  explicit SparseLU(const SparsePattern& pattern);  ///< the pattern must outlive the factors
  SparseLU(SparseLU&&) noexcept;
  ~SparseLU();

  /// Factorises D A D with a diagonal D.
  /// @param values  of A, in the order of the pattern
  /// @param scale   the diagonal of D (size)
  /// @param row_floor  where rows of D A D are what is left of larger ones: their sizes before (size). Rows that have
  ///                   cancelled then stay small, and so do their pivots
  FactorStatus factor(const std::vector<double>& values, const VectorX& scale, const VectorX* row_floor = nullptr);
  /// The next factorisation chooses ordering and pivots anew.
  void forget();
  /// b <- A^-1 b. Only after a good factorisation.
  void solve(Eigen::Ref<VectorX> b) const;
  /// Column (an unknown) at which the last factorisation found no pivot, or -1.
  int singular_column() const { return singular_column_; }
  /// Sign of the determinant of the matrix last factorised: -1 or 1. Its rows must be scaled by positive numbers.
  int determinant_sign() const;
  FactorCost cost() const;  ///< of the last good factorisation
  /// Cheap estimate of the reciprocal condition number of the scaled matrix: smallest over largest pivot.
  double reciprocal_condition() const;

 private:
  struct Factors;
  bool refactor(const std::vector<double>& values);  ///< with the pivots of before; false where they fail
  bool factor_afresh(const std::vector<double>& values, const VectorX* row_floor);  ///< false where singular
  bool choose_ordering();
  void try_minimum_degree();
  /// Neighbouring places.
  struct Range {
    int begin, end;
  };
  static bool any_in(const std::vector<double>& values, const Range& range);
  void choose_present(const std::vector<double>& values);
  const SparsePattern& used() const { return present_ ? *present_ : pattern_; }
  const SparsePattern& pattern_;
  std::unique_ptr<const SparsePattern> present_;  ///< of a pattern with passing entries: those that are factorised
  std::vector<int> present_from_;                 ///< their places in the whole
  std::vector<int> present_passing_;              ///< places of the passing ones among them, ascending
  std::vector<Range> absent_;                     ///< of the others
  std::vector<double> present_values_;
  std::unique_ptr<Factors> factors_;
  int singular_column_ = -1;
};

}  // namespace bielle::mechanism
