// What cuts do to a body: its pieces, joined again, against the body in one piece.
//
// A rigidly tied cut keeps its section plane and undeformed: warping and Poisson's contraction are suppressed there,
// and the body becomes stiffer. Where the ties are averages the sections warp apart, and it becomes softer.
#pragma once

#include <vector>

#include "reduce/superelement/superelement.hpp"

namespace bielle::reduce {

/// Least and largest stiffness of one body over that of another among all deformations of the interfaces that they have
/// in common: eigenvalues of S_a v = lambda S_b v, S the static stiffness of those interfaces, rigid motions split off.
/// Exact, since modes do not change statics.
/// @param pieces  assembled: has all interfaces of the uncut body, and others
/// @returns empty where the interfaces can move rigidly only
std::vector<double> stiffness_ratios(const Superelement& pieces, const Superelement& uncut);

}  // namespace bielle::reduce
