// Pattern of a sparse square matrix; its values are kept apart, in the order of the pattern.
#pragma once

#include <memory>
#include <utility>
#include <vector>

namespace bielle::mechanism {

class FillOrderings;

/// Pattern of a square matrix in compressed columns, rows ascending.
class SparsePattern {
 public:
  SparsePattern() : SparsePattern(0, {}) {}
  /// @param entries  (row, column) pairs in any order; they may be repeated
  SparsePattern(int size, std::vector<std::pair<int, int>> entries);
  /// @param column_start  (size + 1)
  /// @param row  row of each entry, ascending within a column, each once
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
  /// Sets the entries that are zero most of the time (bodies that may touch): the factorisation omits those that are
  /// zero.
  /// @param places  ascending
  void set_intermittent(std::vector<int> places) { intermittent_ = std::move(places); }
  const std::vector<int>& intermittent() const { return intermittent_; }
  /// Fill-reducing orderings: they depend on the pattern only, are computed on first use and shared by all factors and
  /// copies, in any number of threads.
  const FillOrderings& orderings() const { return *orderings_; }

 private:
  int size_ = 0;
  std::vector<int> column_start_, row_, intermittent_;
  std::shared_ptr<const FillOrderings> orderings_;
};

}  // namespace bielle::mechanism
