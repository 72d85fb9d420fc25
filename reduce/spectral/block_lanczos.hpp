// Eigenpairs by a block Lanczos method with thick restarts and full orthogonalisation.
//
// A solution reads the whole factor for any number of right-hand sides: a block of vectors costs little more than one.
// Block Krylov spaces need more vectors than those of single ones, but far fewer passes over the factor. They contain
// as many copies of a multiple eigenvalue as the block has columns; if as many are found, a search with another random
// block tells whether there are more. Reference: R. G. Grimes, J. G. Lewis, H. D. Simon, A shifted block Lanczos
// algorithm for solving sparse symmetric generalized eigenproblems, SIAM J. Matrix Anal. Appl. 15 (1994) 228.
#pragma once

#include "reduce/spectral/eigenpairs.hpp"

namespace bielle {

/// The `count` eigenpairs nearest to the shift, unordered; vectors are M-orthonormal, and residuals are not computed;
/// fewer if there are no more.
/// @throws ComputationError if the iteration does not converge: the number of converged pairs and of requested ones
Eigenpairs block_lanczos_eigenpairs(const ShiftInvertProblem& problem, int count, const EigenpairOptions& options);

}  // namespace bielle
