// The effect of cuts on a body: its pieces, joined again, are compared with the body in one piece.
//
// A rigidly tied cut keeps its section plane and undeformed: warping and Poisson's contraction are suppressed there,
// and the body becomes stiffer. With average ties the sections warp independently, and the body becomes softer.
#pragma once

#include <vector>

#include "reduce/superelement/superelement.hpp"

namespace bielle::reduce {

/// Least and largest ratio of the stiffness of one body to that of another among all deformations of the common
/// interfaces: eigenvalues of S_a v = lambda S_b v, where S is the static stiffness of those interfaces without rigid
/// motions. The ratios are exact, since modes do not affect statics.
/// @param pieces  assembled body with all interfaces of the uncut body, and others
/// @returns empty if the interfaces allow rigid motions only
std::vector<double> stiffness_ratios(const Superelement& pieces, const Superelement& uncut);

}  // namespace bielle::reduce
