// Sizes of forces with which residuals of equations of motion are compared.
#pragma once

#include "mechanism/solvers/linearised/equations.hpp"
#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

/// Returns for each unknown the size of forces relative to which its residual is judged: the largest one of its kind,
/// at least the rounding errors of the stiffness. All forces on amplitudes may be rounding errors: one of them is
/// compared with the other forces by the energies at which each deforms its own stiffness.
/// @param K  stiffness (n, n) @param scale  largest force of each kind @param length  size of the mechanism [m]
/// @param share  fraction of the size up to which a residual counts as zero
VectorX residual_sizes(const System& system, const LinearisedEquations::Sparse& K, ResidualScale scale, double length,
                       double share);

}  // namespace bielle::mechanism
