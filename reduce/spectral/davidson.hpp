// The lowest eigenpairs of K phi = lambda M phi by a block Davidson method: for where K^-1 b is dear, and something
// near it is not.
#pragma once

#include "reduce/spectral/eigenpairs.hpp"

namespace bielle {

/// @param problem  with a preconditioner; shift 0
/// @returns  residuals as well
/// @throws ComputationError when it does not converge
Eigenpairs davidson_eigenpairs(const ShiftInvertProblem& problem, int count, const EigenpairOptions& options);

}  // namespace bielle
