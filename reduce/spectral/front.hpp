// Elimination of the columns of one supernode, dense, by the threads of a team together.
#pragma once

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
};

/// A -> L, the columns up to the diagonal apart. With `pivots` (width) A -> L D L^T.
/// @returns  the first column whose pivot is not positive; -1: none, or `pivots` given
std::int64_t eliminate_columns(const Front& front, double* pivots, Team& team);

/// U <- U - L21 D L21^T. @param is_empty  U is not read: it was zero
void add_to_update(const Front& front, bool is_empty, Team& team);

}  // namespace bielle
