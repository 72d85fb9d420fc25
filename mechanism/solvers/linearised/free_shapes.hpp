// Independent shapes of zero eigenvalues, for equations with first-order unknowns: these have different units, for
// which the rank decisions of indifferent_motions.hpp are not possible.
//
// Double zeros occur as pairs of nearly equal vectors, from which their number is hard to determine. A shape without
// stiffness is unchanged by D(sigma)^-1 (D(sigma) - D(0)); all others become shorter.
#pragma once

#include <vector>

#include "mechanism/solvers/linearised/eigenpairs_around.hpp"

namespace bielle::mechanism {

/// @param shifted  operator with a real shift of the size of the slowest nonzero mode
/// @param zeros    eigenpairs that are zero up to rounding
/// @returns the shapes (unknowns, number)
MatrixX find_free_shapes(const LinearisedEquations& equations, const ShiftedOperator& shifted,
                         const std::vector<Eigenpair>& zeros);

}  // namespace bielle::mechanism
