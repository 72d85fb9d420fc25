// Signs of the pivots of L D L^T, which are those of the eigenvalues (Sylvester's law), by CHOLMOD's simplicial
// factorisation without interchange of rows. It runs in one thread and takes several times as long as a supernodal L
// L^T.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "reduce/sparse/symmetric_matrix.hpp"

namespace bielle {

struct PivotSigns {
  std::int64_t negative = 0;
  /// Largest L_ij^2 |D_jj| over the scale of i. It is at most 1 if A is definite and scaled by its diagonal; rounding
  /// errors exceed those of a Cholesky factorisation by this factor. It is infinite if a pivot is zero.
  double growth = 0;
};

/// @param a      not necessarily definite
/// @param order  order of elimination of all unknowns of a
/// @param scale  absolute value of the diagonal entry of each unknown, the reference for growth
/// @throws ComputationError when memory does not suffice
PivotSigns pivot_signs(const SymmetricMatrix& a, std::span<const std::int64_t> order, const std::vector<double>& scale);

}  // namespace bielle
