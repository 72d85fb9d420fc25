// A supernode of a factor as solutions read it: cut into panels of some rows, which are gone through one after the
// other.
#pragma once

#include <algorithm>
#include <cstdint>

#include "reduce/spectral/few_vectors.hpp"

namespace bielle {

/// From `first` on, `count` of something.
struct Range {
  std::int64_t first, count;
};

/// What one of some parts gets.
inline Range share_of(std::int64_t count, int part, int parts) {
  const std::int64_t first = count * part / parts;
  return {first, count * (part + 1) / parts - first};
}

/// L11 over L21: rows of its own, with their triangle, over those below. Panels do not go across the border between the
/// two. Each stands where its rows would stand if the supernode were stored by rows, all of its columns: panels of own
/// rows have room to spare.
struct Supernode {
  std::int64_t first, width, below;  ///< number of its first column, own columns, rows below
  const std::int64_t* rows_below;
  const double* values;

  std::int64_t panels_below() const { return (below + lines_abreast - 1) / lines_abreast; }
  /// Rows of a panel of the rows below, counted from the first row below.
  Range rows_of_panel(std::int64_t panel) const {
    const std::int64_t first_row = panel * lines_abreast;
    return {first_row, std::min<std::int64_t>(lines_abreast, below - first_row)};
  }
  /// @param rows     below, of one panel
  /// @param columns  of the supernode
  FactorPanel panel_below(Range rows, Range columns) const {
    return {static_cast<int>(rows.count), columns.count,
            values + (width + rows.first) * width + columns.first * rows.count};
  }

  /// own <- L11^-1 own, by rows from the first own row on
  void substitute_forwards(double* own, const Vectors& vectors) const;
  /// own <- L11^-T own
  void substitute_backwards(double* own, const Vectors& vectors) const;

 private:
  FactorPanel own_panel(std::int64_t first_row) const {
    return {static_cast<int>(std::min<std::int64_t>(lines_abreast, width - first_row)), first_row,
            values + first_row * width};
  }
};

/// Rearranges a supernode that is stored as a dense matrix by columns, in its place; the upper triangle of its own
/// columns may hold anything.
/// @param room  for as many numbers as it has
void cut_into_panels(std::int64_t rows, std::int64_t width, double* values, double* room);

}  // namespace bielle
