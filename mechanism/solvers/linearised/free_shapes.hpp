// Independent shapes of eigenvalues that are zero, for equations with first-order unknowns: those have units of their
// own, by which the rank decisions of indifferent_motions.hpp cannot be taken.
//
// Double zeros come as pairs of nearly the same vector, which tell their number badly. A shape that costs nothing is
// one that D(sigma)^-1 (D(sigma) - D(0)) leaves as it is; all others become shorter.
#pragma once

#include <vector>

#include "mechanism/solvers/linearised/eigenpairs_around.hpp"

namespace bielle::mechanism {

/// @param shifted  with a real shift of the size of the slowest mode that is not zero
/// @param zeros    eigenpairs that are zero to rounding
/// @returns (unknowns, number)
MatrixX find_free_shapes(const LinearisedEquations& equations, const ShiftedOperator& shifted,
                         const std::vector<Eigenpair>& zeros);

}  // namespace bielle::mechanism
