// Eigenpairs by ARPACK's implicitly restarted Lanczos method with single vectors (mode 3). A search that does not
// converge is made once more in a space of twice the size. Reference: R. B. Lehoucq, D. C. Sorensen, C. Yang, ARPACK
// Users' Guide, SIAM 1998.
#pragma once

#include "reduce/common/error.hpp"
#include "reduce/spectral/eigenpairs.hpp"

namespace bielle {

/// There are hardly more eigenpairs than are wanted, or fewer: ARPACK needs room for others.
class TooFewDirections : public ComputationError {
 public:
  using ComputationError::ComputationError;
};

/// The `count` eigenpairs nearest to the shift, in no order, vectors neither normalised nor their residuals measured.
/// @param count  below half of the size or so
/// @throws TooFewDirections; ComputationError when ARPACK does not converge: how many pairs did, of how many
Eigenpairs arpack_eigenpairs(const ShiftInvertProblem& problem, int count, const EigenpairOptions& options);

}  // namespace bielle
