// Eigenpairs by ARPACK's implicitly restarted Lanczos method with single vectors (mode 3). A search that does not
// converge is repeated once in a space of twice the size. Reference: R. B. Lehoucq, D. C. Sorensen, C. Yang, ARPACK
// Users' Guide, SIAM 1998.
#pragma once

#include "reduce/common/error.hpp"
#include "reduce/spectral/eigenpairs.hpp"

namespace bielle {

/// There are fewer eigenpairs than requested, or hardly more: ARPACK needs additional directions.
class TooFewDirections : public ComputationError {
 public:
  using ComputationError::ComputationError;
};

/// The `count` eigenpairs nearest to the shift, unordered; vectors are not normalised, and residuals are not computed.
/// @param count  less than about half of the size
/// @throws TooFewDirections; ComputationError if ARPACK does not converge: the number of converged pairs and of
/// requested ones
Eigenpairs arpack_eigenpairs(const ShiftInvertProblem& problem, int count, const EigenpairOptions& options);

}  // namespace bielle
