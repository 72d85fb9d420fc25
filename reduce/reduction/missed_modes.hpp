// Proof that no fixed-boundary mode was missed: the number of modes below some frequency is counted independently of
// the search and compared with the number found.
//
// By Sylvester's law the number of eigenvalues of K phi = lambda M phi below sigma equals the number of negative
// eigenvalues of K - sigma M. With conditions C z = 0 the matrix [K - sigma M, C^T; C, 0] has one more negative
// eigenvalue for each of them. (B. N. Parlett, The Symmetric Eigenvalue Problem, ch. 3; K.-J. Bathe, Finite Element
// Procedures, 11.4.3.)
#pragma once

#include <optional>

#include "reduce/reduction/basis.hpp"
#include "reduce/reduction/fixed_interface_body.hpp"

namespace bielle::reduce {

struct ModeCount {
  double below = 0;  ///< [Hz]: between a mode that was found and the next
  std::int64_t found = 0, counted = 0;
  double growth = 0;  ///< growth of the factors' entries, see PivotSigns
};

/// Counts at the highest possible frequency: just above the last mode, or below it if modes are too close to each other
/// or pivots too small.
/// @returns nothing if the count is impossible: no modes, too few separated ones, or matrices that are not in this
/// process
std::optional<ModeCount> count_modes(const BodyMatrices& matrices, const FixedInterfaceBody& held, const Basis& basis);

}  // namespace bielle::reduce
