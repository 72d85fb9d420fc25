// Eigenpairs by ARPACK's implicitly restarted Lanczos method with single vectors (mode 3). What the block method is
// compared with. Reference: R. B. Lehoucq, D. C. Sorensen, C. Yang, ARPACK Users' Guide, SIAM 1998.
#pragma once

#include "reduce/spectral/eigenpairs.hpp"

namespace bielle {

/// The `count` eigenpairs nearest to the shift, in no order, vectors neither normalised nor their residuals measured.
/// @param count  below half of the size or so
/// @throws ComputationError when ARPACK does not converge: how many pairs did, of how many
Eigenpairs arpack_eigenpairs(const ShiftInvertProblem& problem, int count, const EigenpairOptions& options);

}  // namespace bielle
