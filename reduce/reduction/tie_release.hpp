// Stiffening of a body by rigid ties: its modes are computed with the surfaces of rigid ties free to deform, as with
// average ties.
//
// In a free mode u the rigid ties of a surface carry forces R = K u - lambda M u on its nodes, whose sum and moment are
// those of the interface. Without the ties the surface deforms by w, whose mean translation and rotation (ties.hpp) are
// zero, and the interior follows statically: y = w - K_ii^-1 K_is w. A few steps of the conjugate gradient method for S
// w = -R in these w, S w = (K y)_s, cost one block of solutions each. With y added to its shapes (enrichment.hpp) the
// body has frequencies that are not below those with average ties: rigid ties stiffen the body at least by the
// difference.
#pragma once

#include "reduce/reduction/adequacy.hpp"

namespace bielle::reduce {

/// @param forces  K u - lambda M u (3 points, k) [N] of k modes
/// @returns y (3 points, k); no columns if there are no rigid ties
RowMatrix deformation_without_rigid_ties(const FullModel& model, const RowMatrix& forces);

}  // namespace bielle::reduce
