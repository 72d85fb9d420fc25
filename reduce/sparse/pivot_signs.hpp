// Signs of the pivots of L D L^T, which are those of the eigenvalues (Sylvester's law): CHOLMOD's simplicial
// factorisation, whose rows are not interchanged. It runs in one thread and takes a multiple of the time of a
// supernodal L L^T.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "reduce/sparse/symmetric_matrix.hpp"

namespace bielle {

struct PivotSigns {
  std::int64_t negative = 0;
  /// Largest L_ij^2 |D_jj| over the scale of i. At the most 1 where A is definite and scaled by its diagonal; rounding
  /// errors are as many times those of a Cholesky factorisation. Infinite where a pivot is zero.
  double growth = 0;
};

/// @param a      not necessarily definite
/// @param order  of elimination, all unknowns of a
/// @param scale  of each unknown, the size of its diagonal entry: growth is measured by it
/// @throws ComputationError when memory does not suffice
PivotSigns pivot_signs(const SymmetricMatrix& a, std::span<const std::int64_t> order, const std::vector<double>& scale);

}  // namespace bielle
