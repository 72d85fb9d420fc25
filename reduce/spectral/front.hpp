// Elimination of the columns of one supernode, dense, by the threads of a team together.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "reduce/spectral/team.hpp"
#include "reduce/spectral/update_matrices.hpp"

namespace bielle {

/// A supernode while it is eliminated: a dense matrix (rows,width) by columns, its own rows first.
struct Front {
  std::int64_t rows = 0, width = 0;
  double* columns = nullptr;  ///< A, then L of L L^T; where `scaled` is given, L D below each panel's own rows
  double* scaled = nullptr;   ///< of the same shape: L of L D L^T below the diagonal; none: L L^T
  double* update = nullptr;   ///< U in the panels of `UpdatePanels`

  std::int64_t below() const { return rows - width; }
  UpdatePanels panels() const { return {below()}; }
  /// Where row 0 of a column would be: in the supernode's own columns, or in the update matrix, which has the rows from
  /// the diagonal on.
  double* column(std::int64_t k) const {
    if (k < width) return columns + k * rows;
    const UpdatePanels all = panels();
    const std::int64_t panel = (k - width) / all.width(), above = panel * all.width();
    return update + all.offset(panel) + (k - width - above) * all.rows(panel) - above - width;
  }
  /// Sets column k >= width of the update matrix to zero.
  void clear_update(std::int64_t k) const {
    const std::int64_t first = k - (k - width) % panels().width();
    std::fill_n(column(k) + first, rows - first, 0.0);
  }
};

/// A -> L, the columns up to the diagonal apart. With `pivots` (width) A -> L D L^T.
/// @returns  the first column whose pivot is not positive; -1: none, or `pivots` given
std::int64_t eliminate_columns(const Front& front, double* pivots, Team& team);

/// U <- U - L21 D L21^T. @param is_empty  U is not read: it was zero
void add_to_update(const Front& front, bool is_empty, Team& team);

}  // namespace bielle
