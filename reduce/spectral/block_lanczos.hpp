// Eigenpairs by a block Lanczos method with thick restarts and full orthogonalisation.
//
// A solution reads the whole factor, for one right-hand side as for many: a block of vectors costs little more than
// one. Block Krylov spaces need more vectors than those of single ones, but far fewer readings. They hold as many
// copies of a multiple eigenvalue as the block has columns; where as many are found, a search with another random block
// says whether there are more. Reference: R. G. Grimes, J. G. Lewis, H. D. Simon, A shifted block Lanczos algorithm for
// solving sparse symmetric generalized eigenproblems, SIAM J. Matrix Anal. Appl. 15 (1994) 228.
#pragma once

#include "reduce/spectral/eigenpairs.hpp"

namespace bielle {

/// The `count` eigenpairs nearest to the shift, in no order, vectors M-orthonormal, residuals not measured; fewer where
/// there are no more.
/// @throws ComputationError when the iteration does not converge: how many pairs did, of how many
Eigenpairs block_lanczos_eigenpairs(const ShiftInvertProblem& problem, int count, const EigenpairOptions& options);

}  // namespace bielle
