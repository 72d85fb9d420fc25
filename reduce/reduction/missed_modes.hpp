// Proof that no fixed-boundary mode was missed: how many there are below some frequency, counted independently of their
// search, against how many were found.
//
// By Sylvester's law as many eigenvalues of K phi = lambda M phi lie below sigma as K - sigma M has negative ones. With
// conditions C z = 0 the matrix [K - sigma M, C^T; C, 0] has one negative eigenvalue more for each of them. (B. N.
// Parlett, The Symmetric Eigenvalue Problem, ch. 3; K.-J. Bathe, Finite Element Procedures, 11.4.3.)
#pragma once

#include <optional>

#include "reduce/reduction/basis.hpp"
#include "reduce/reduction/held_body.hpp"

namespace bielle::reduce {

struct ModeCount {
  double below = 0;  ///< [Hz]: between a mode that was found and the next
  std::int64_t found = 0, counted = 0;
  double growth = 0;  ///< of the factors' entries, see PivotSigns
};

/// Counts as high up as it can be done: just above the last mode, or where modes are too close to each other or pivots
/// too small, below it.
/// @returns nothing where it cannot be done: no modes, too few of them apart from each other, or matrices that are not
/// in this process
std::optional<ModeCount> count_modes(const BodyMatrices& matrices, const HeldBody& held, const Basis& basis);

}  // namespace bielle::reduce
